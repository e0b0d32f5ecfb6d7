#include "solver/fields/loading_indicators.hpp"

#include <cmath>

#include <fmt/format.h>

#include "solver/error.hpp"
#include "solver/fields/tensor_reader.hpp"
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

bool is_isotropic(Relation relation) {
  switch (relation) {
    case Relation::elastic:
    case Relation::isotropic_linear:
    case Relation::isotropic_traction:
    case Relation::isotropic_power:
    case Relation::isotropic_nonlinear:
      return true;
    default:
      return false;
  }
}

CellBehaviour behaviour_of(const FieldInput& input, const PlasticFields& fields, int cell) {
  CellBehaviour behaviour;
  if (fields.behaviours != nullptr && !fields.behaviours->empty())
    behaviour = (*fields.behaviours)[static_cast<std::size_t>(cell)];
  if (is_isotropic(behaviour.relation) && behaviour.kinematics == Kinematics::small) return behaviour;
  throw Error(
      "unsupported",
      fmt::format("indicators of the loading are asked for on cell {}, whose {}", input.model.mesh->cell_name(cell),
                  is_isotropic(behaviour.relation) ? "strains are large" : "hardening is not isotropic"),
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
    const auto* elasticity = std::get_if<IsotropicElasticity>(&*material.elasticity);
    for (int g = 0; g < count; ++g) {
      if (relation == Relation::elastic || elasticity == nullptr) {
        result.values.push_back(0.0);
        continue;
      }
      const ContinuumSample& sample = points.samples(cell)[static_cast<std::size_t>(g)];
      const MaterialPoint at = points.material_point(cell, input.state, sample, points.locate(cell, sample).at, g);
      result.values.push_back(
          value_of(PointState{stress.at(cell, g), plastic.at(cell, g), fields.variables.at(cell, g, p),
                              plastic_point(*elasticity, material.plasticity, relation, at),
                              solid_compliance(material_of(input, cell), at)}));
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

}  // namespace

ElementField local_indicators(const ElementField& before, const ElementField& after) {
  if (before.starts != after.starts)
    throw Error("incompatible-field", "the stresses of one step and the next lie at different points");
  const TensorReader first(before, stress_components);
  const TensorReader second(after, stress_components);
  ElementField result{"DERA_R", before.support, {"DCHA_V", "DCHA_T", "RADI_V"}, {0}, {}};
  for (int cell = 0; cell + 1 < static_cast<int>(before.starts.size()); ++cell) {
    const int points = first.has(cell) ? before.points(cell) : 0;
    result.starts.push_back(result.starts.back() + points);
    for (int point = 0; point < points; ++point) {
      const Vector6d from = first.at(cell, point), to = second.at(cell, point);
      result.values.insert(result.values.end(), {change_of_norm(deviator(from), deviator(to)), change_of_norm(from, to),
                                                 loss_of_direction(deviator(from), deviator(to))});
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
