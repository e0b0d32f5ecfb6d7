#include "solver/fields/stresses/loading_indicators.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "solver/error.hpp"
#include "solver/fields/stresses/plastic_points.hpp"
#include "solver/fields/stresses/tensor_reader.hpp"
#include "solver/materials/behaviour/hardening_energy.hpp"
#include "solver/materials/behaviour/von_mises.hpp"

namespace comma::solver {

namespace {

Vector6d deviator(Vector6d tensor) {
  tensor.head<3>().array() -= tensor.head<3>().sum() / 3.0;
  return tensor;
}

double inner(const Vector6d& a, const Vector6d& b) {
  return a.head<3>().dot(b.head<3>()) + 2.0 * a.tail<3>().dot(b.tail<3>());
}

double norm(const Vector6d& tensor) { return std::sqrt(1.5 * inner(tensor, tensor)); }

double ratio(double part, double whole) { return whole == 0.0 ? 0.0 : part / whole; }

double change_of_norm(const Vector6d& before, const Vector6d& after) {
  return ratio(norm(after) - norm(before), norm(after));
}

double loss_of_direction(const Vector6d& before, const Vector6d& after) {
  const Vector6d change = after - before;
  const double product = std::sqrt(inner(before, before) * inner(change, change));
  return product == 0.0 ? 0.0 : 1.0 - std::abs(inner(before, change)) / product;
}

/// The components of DERA_ELGA.
constexpr std::array<std::string_view, 12> loading_names = {
    "DCHA_V", "DCHA_T", "IND_DCHA", "VAL_DCHA", "X11", "X22", "X33", "X12", "X13", "X23", "RADI_V", "ERR_RADI"};
enum LoadingColumn { change_of_deviator, change_of_all, indicator_column, excess, centre, turning = 10, turned_normal };

/// IND_DCHA.
namespace indicator_value {
constexpr double elastic = 1.0, flows = 2.0, unloads = -1.0, unloads_too_far = -2.0;
}

/// Where the yield surface of a relation is among the internal variables.
struct YieldPlaces {
  int flowing = -1;      ///< the indicator of flow; -1: nothing flows
  int back_stress = -1;  ///< the first of its six components
};

YieldPlaces yield_places(Relation relation) {
  switch (relation) {
    case Relation::isotropic_linear:
    case Relation::isotropic_traction:
    case Relation::isotropic_power:
    case Relation::isotropic_nonlinear:
      return {1, -1};
    case Relation::kinematic_linear:
      return {6, 0};
    case Relation::mixed_linear:
    case Relation::mixed_traction:
      return {1, 2};
    default:
      return {};
  }
}

bool has_indicators(Relation relation) { return relation == Relation::elastic || is_isotropic(relation); }

CellBehaviour behaviour_of(const FieldInput& input, const PlasticFields& fields, int cell) {
  CellBehaviour behaviour;
  if (fields.behaviours != nullptr && !fields.behaviours->empty())
    behaviour = (*fields.behaviours)[static_cast<std::size_t>(cell)];
  if (has_indicators(behaviour.relation) && behaviour.kinematics == Kinematics::small) return behaviour;
  throw Error(
      "unsupported",
      fmt::format("indicators of the loading are asked for on cell {}, whose {}", input.model.mesh->cell_name(cell),
                  has_indicators(behaviour.relation) ? "strains are large" : "hardening is not isotropic"),
      "they are known for isotropic von Mises plasticity in small strains; name the cells that have it");
}

/// What an indicator is made from at a point.
struct PointState {
  Vector6d stress, plastic_strain;
  double p = 0.0;
  PlasticPoint constants;
  Matrix6d compliance;
};

template <class ValueOf>
ElementField indicator(const FieldInput& input, const PlasticFields& fields, ValueOf&& value_of) {
  ContinuumPoints points(input.model);
  const TensorReader stress(fields.stresses, stress_components);
  const TensorReader plastic(fields.plastic_strains, strain_components);
  const int p = fields.variables.component("V1");
  ElementField result{"NEUT_R", Support::gauss_point, {"X1"}, {0}, {}};
  for (int cell = 0; cell < input.model.mesh->cell_count(); ++cell) {
    const int count = points.covers(cell) && stress.has(cell) ? fields.stresses.points(cell) : 0;
    result.starts.push_back(result.starts.back() + count);
    if (count == 0) continue;
    const Relation relation = behaviour_of(input, fields, cell).relation;
    const Material& material = *input.materials.by_cell[static_cast<std::size_t>(cell)];
    const bool may_flow =
        relation != Relation::elastic && std::holds_alternative<IsotropicElasticity>(*material.elasticity);
    for (int g = 0; g < count; ++g) {
      if (!may_flow) {
        result.values.push_back(0.0);
        continue;
      }
      const MaterialPoint at = points.material_point(cell, input.state, g);
      result.values.push_back(value_of(PointState{
          stress.at(cell, g), plastic.at(cell, g), fields.variables.at(cell, g, p),
          plastic_point_at(input, points, relation, cell, g), solid_compliance(material_of(input, cell), at)}));
    }
  }
  return result;
}

double yield_value(const PointState& point) {
  if (!(point.p > 0.0)) return 0.0;
  return 1.0 - std::abs(inner(point.stress, point.plastic_strain)) /
                   (hardening(point.constants.curve, point.p).first * point.p);
}

/// The energy on the straight way to a strain (Hencky and Mises): elastic up to the yield stress, then along R(p).
double energy_of_straight_way(const PointState& point, const Vector6d& strain) {
  const PlasticPoint& now = point.constants;
  const double trace = strain.head<3>().sum();
  const double trial = 2.0 * now.shear * norm(deviator(strain));
  const double volume = 0.5 * now.bulk * trace * trace;
  const double yield = hardening(now.curve, 0.0).first;
  if (!(trial > yield)) return volume + trial * trial / (6.0 * now.shear);
  const double p = plastic_increment(now.curve, trial, 3.0 * now.shear, 0.0);
  const double radius = hardening(now.curve, p).first;
  return volume + radius * radius / (6.0 * now.shear) + hardening_energy(now.curve, p);
}

double energy_value(const PointState& point) {
  Vector6d elastic = point.compliance * point.stress;
  elastic.tail<3>() *= 0.5;
  const double taken = 0.5 * inner(point.stress, elastic) + hardening_energy(point.constants.curve, point.p);
  return taken == 0.0 ? 0.0 : 1.0 - energy_of_straight_way(point, elastic + point.plastic_strain) / taken;
}

using LoadingValues = std::array<double, loading_names.size()>;

/// A point at a step and the next.
struct LoadingPoint {
  Vector6d from, to;
  Vector6d back_from = Vector6d::Zero(), back_to = Vector6d::Zero();
  double p = 0.0;  ///< cumulated plastic strain at the step
  bool flows_from = false, flows_to = false;
  double yield = 0.0, kept_yield = 0.0;  ///< initial radius; that of the part of the stress that X11 ... leave out
  bool is_plane = false;
};

Vector6d back_stress(const ElementField& variables, int cell, int point, int first) {
  Vector6d tensor = Vector6d::Zero();
  for (int i = 0; i < 6 && first >= 0; ++i) tensor[i] = variables.at(cell, point, first + i);
  return tensor;
}

/// What Code_Aster takes for the centre of the yield surface in VAL_DCHA: components of the step before, two places
/// off.
Vector6d shifted_centre(const LoadingValues& before, bool is_plane) {
  Vector6d tensor = Vector6d::Zero();
  for (int i = 0; i < (is_plane ? 4 : 6); ++i) tensor[i] = before[static_cast<std::size_t>(indicator_column + i)];
  return tensor;
}

/// IND_DCHA, VAL_DCHA and X11 ... X23.
void follow_unloading(const LoadingPoint& point, const LoadingValues& before, LoadingValues& values) {
  const double last = before[indicator_column];
  if (last == indicator_value::unloads_too_far) {
    std::copy(before.begin() + indicator_column, before.begin() + turning, values.begin() + indicator_column);
    return;
  }
  if (!(point.p > 0.0) || point.flows_to) {
    values[indicator_column] = point.p > 0.0 ? indicator_value::flows : indicator_value::elastic;
    return;
  }
  values[indicator_column] = indicator_value::unloads;
  if (last != indicator_value::unloads) {
    const Vector6d kept = (1.0 - ratio(point.kept_yield, norm(deviator(point.from)))) * point.from;
    std::copy(kept.begin(), kept.end(), values.begin() + centre);
    return;
  }
  const Vector6d reach = deviator(point.from - shifted_centre(before, point.is_plane));
  const double beyond = ratio(std::sqrt(inner(reach, reach)), point.yield);
  if (!(beyond > 1.0)) return;
  std::copy(before.begin() + centre, before.begin() + turning, values.begin() + centre);
  values[indicator_column] = indicator_value::unloads_too_far;
  values[excess] = beyond;
}

double distance_of_normals(const LoadingPoint& point) {
  const Vector6d from = deviator(point.from) - point.back_from, to = deviator(point.to) - point.back_to;
  const double product = norm(from) * norm(to);
  if (!point.flows_from || !point.flows_to || product == 0.0) return 0.0;
  const Vector6d change = to / norm(to) - from / norm(from);
  return 0.5 * std::sqrt(1.5) * std::sqrt(inner(change, change));
}

LoadingValues loading_values(const LoadingPoint& point, Relation relation, const LoadingValues& before) {
  LoadingValues values{};
  const bool about_centre = relation == Relation::kinematic_linear;
  const Vector6d from = deviator(point.from), to = deviator(point.to);
  values[change_of_deviator] =
      about_centre ? change_of_norm(from - point.back_from, to - point.back_to) : change_of_norm(from, to);
  values[change_of_all] = change_of_norm(point.from, point.to);
  if (yield_places(relation).flowing < 0) return values;
  values[turned_normal] = distance_of_normals(point);
  if (!is_isotropic(relation)) return values;
  values[turning] = loss_of_direction(from, to);
  follow_unloading(point, before, values);
  return values;
}

/// Reads the points of one cell.
class LoadingOfCell {
 public:
  LoadingOfCell(const FieldInput& input, const LoadingFields& fields, ContinuumPoints& points, int cell)
      : input_(input), fields_(fields), points_(points), cell_(cell) {
    const bool remembers = fields.variables != nullptr && fields.behaviours != nullptr && !fields.behaviours->empty() &&
                           fields.variables->points(cell) > 0 && fields.next_variables->points(cell) > 0;
    if (remembers) relation_ = (*fields.behaviours)[static_cast<std::size_t>(cell)].relation;
    const int across = fields.stresses.component("SIXZ");
    is_plane_ = across < 0 || std::isnan(fields.stresses.at(cell, 0, across));
  }

  LoadingValues at(int g, const Vector6d& from, const Vector6d& to) const {
    LoadingPoint point{from, to};
    point.is_plane = is_plane_;
    const YieldPlaces places = yield_places(relation_);
    if (places.flowing >= 0) {
      const ElementField &now = *fields_.variables, &next = *fields_.next_variables;
      point.flows_from = now.at(cell_, g, places.flowing) > 0.5;
      point.flows_to = next.at(cell_, g, places.flowing) > 0.5;
      point.back_from = back_stress(now, cell_, g, places.back_stress);
      point.back_to = back_stress(next, cell_, g, places.back_stress);
      if (is_isotropic(relation_)) {
        point.p = now.at(cell_, g, 0);
        point.yield = initial_yield(g);
        point.kept_yield = relation_ == Relation::isotropic_power ? 0.0 : point.yield;
      }
    }
    return loading_values(point, relation_, before(g));
  }

 private:
  LoadingValues before(int g) const {
    LoadingValues values{};
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double value = fields_.before->at(cell_, g, static_cast<int>(i));
      values[i] = std::isnan(value) ? 0.0 : value;
    }
    return values;
  }
  double initial_yield(int g) const {
    return hardening(plastic_point_at(input_, points_, relation_, cell_, g).curve, 0.0).first;
  }

  const FieldInput& input_;
  const LoadingFields& fields_;
  ContinuumPoints& points_;
  int cell_;
  Relation relation_ = Relation::elastic;
  bool is_plane_ = false;
};

}  // namespace

ElementField local_indicators(const FieldInput& input, const LoadingFields& fields) {
  if (fields.stresses.starts != fields.next_stresses.starts)
    throw Error("incompatible-field", "the stresses of one step and the next lie at different points");
  const ElementField& stresses = fields.stresses;
  const TensorReader first(stresses, stress_components), second(fields.next_stresses, stress_components);
  ContinuumPoints points(input.model);
  ElementField result{"DERA_R", stresses.support, {loading_names.begin(), loading_names.end()}, {0}, {}};
  for (int cell = 0; cell + 1 < static_cast<int>(stresses.starts.size()); ++cell) {
    const int count = first.has(cell) ? stresses.points(cell) : 0;
    result.starts.push_back(result.starts.back() + count);
    if (count == 0) continue;
    const LoadingOfCell loading(input, fields, points, cell);
    for (int g = 0; g < count; ++g) {
      const auto values =
          fields.before == nullptr ? LoadingValues{} : loading.at(g, first.at(cell, g), second.at(cell, g));
      result.values.insert(result.values.end(), values.begin(), values.end());
    }
  }
  return result;
}

ElementField yield_indicator(const FieldInput& input, const PlasticFields& fields) {
  return indicator(input, fields, yield_value);
}

ElementField energy_indicator(const FieldInput& input, const PlasticFields& fields) {
  return indicator(input, fields, energy_value);
}

}  // namespace comma::solver
