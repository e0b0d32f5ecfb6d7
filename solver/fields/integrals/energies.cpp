#include "solver/fields/integrals/energies.hpp"

#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "solver/elements/cell_quadrature.hpp"
#include "solver/elements/solids/hourglass.hpp"
#include "solver/error.hpp"
#include "solver/fields/stresses/plastic_points.hpp"
#include "solver/fields/stresses/tensor_reader.hpp"
#include "solver/materials/behaviour/hardening_energy.hpp"
#include "solver/mesh/place.hpp"
#include "solver/model/stress_names.hpp"

namespace comma::solver {

namespace {

/// Beside stretches; they have some 1e-16.
constexpr double pressure_of_roundings = 1e-9;

/// A scalar field on the points of a tensor field.
template <class ValueAt>
ElementField scalar_field(const ElementField& like, const TensorReader& reader, ValueAt&& value_at) {
  ElementField result{"ENER_R", like.support, {"TOTALE"}, {0}, {}};
  for (int cell = 0; cell + 1 < static_cast<int>(like.starts.size()); ++cell) {
    const int points = reader.has(cell) ? like.points(cell) : 0;
    for (int point = 0; point < points; ++point) result.values.push_back(value_at(cell, point));
    result.starts.push_back(result.starts.back() + points);
  }
  return result;
}

void check_points(const Model& model, const ElementField& field, int cell, std::size_t expected) {
  if (static_cast<std::size_t>(field.points(cell)) == expected) return;
  throw Error("incompatible-field", fmt::format("the field has {} values on cell {}, not {}", field.points(cell),
                                                model.mesh->cell_name(cell), expected));
}

/// What the material knows at the points of a field.
class MaterialAtPoints {
 public:
  MaterialAtPoints(const FieldInput& input, const ElementField& field)
      : input_(input), field_(field), points_(input.model) {}

  bool covers(int cell) const { return points_.covers(cell); }

  MaterialPoint at(int cell, int g) {
    check_points(input_.model, field_, cell, points_.samples(cell).size());
    return points_.material_point(cell, input_.state, g);
  }

 private:
  const FieldInput& input_;
  const ElementField& field_;
  ContinuumPoints points_;
};

Hourglass::Stresses varying_stresses(const ElementField& stresses, int cell) {
  Hourglass::Stresses varying;
  for (std::size_t i = 0; i < hourglass_stress_names.size(); ++i)
    varying(static_cast<Eigen::Index>(i / 12), static_cast<Eigen::Index>(i % 12)) =
        stresses.at(cell, 0, stresses.component(std::string(hourglass_stress_names[i])));
  return varying;
}

Vector6d stress_at_the_middle(const ElementField& stresses, int cell) {
  Vector6d stress;
  for (std::size_t i = 0; i < solid_stress_names.size(); ++i)
    stress[static_cast<Eigen::Index>(i)] = stresses.at(cell, 0, stresses.component(std::string(solid_stress_names[i])));
  return stress;
}

/// Of a field at nodes, less what the first node has: patterns do not see it, and digits would be lost to it.
Hourglass::Places relative_values(const Mesh& mesh, int cell, const NodalField& field) {
  static constexpr std::string_view names[3] = {"DX", "DY", "DZ"};
  const auto nodes = mesh.cell(cell);
  Hourglass::Places values;
  for (int a = 0; a < 8; ++a)
    for (int axis = 0; axis < 3; ++axis)
      values(a, axis) = field.at(nodes[static_cast<std::size_t>(a)], field.component(names[axis]));
  values.rowwise() -= values.row(0).eval();
  return values;
}

Hourglass::Places places(const Mesh& mesh, int cell) {
  Hourglass::Places values;
  for (int a = 0; a < 8; ++a) {
    const Point& node = mesh.nodes[static_cast<std::size_t>(mesh.cell(cell)[static_cast<std::size_t>(a)])];
    values.row(a) = Eigen::Map<const Eigen::RowVector3d>(node.data());
  }
  return values;
}

template <class EnergyOf>
void add_of_stabilised_cells(const Model& model, const ElementField& stresses, ElementField& densities,
                             EnergyOf&& energy_of) {
  ContinuumPoints points(model);
  for (int cell = 0; cell < model.mesh->cell_count(); ++cell) {
    if (!is_stabilised(stresses, cell) || densities.points(cell) != 1) continue;
    const double volume = points.locate(cell, points.samples(cell).front()).weight;
    densities.values[static_cast<std::size_t>(densities.starts[static_cast<std::size_t>(cell)])] +=
        energy_of(cell) / volume;
  }
}

}  // namespace

bool is_stabilised(const ElementField& stresses, int cell) {
  const int first = stresses.component("FSTAB1");
  return first >= 0 && stresses.points(cell) == 1 && !std::isnan(stresses.at(cell, 0, first));
}

void add_stabilisation_energy(const FieldInput& input, const ElementField& stresses, ElementField& densities) {
  if (stresses.component("FSTAB1") < 0) return;
  MaterialAtPoints points(input, stresses);
  const Mesh& mesh = *input.model.mesh;
  add_of_stabilised_cells(input.model, stresses, densities, [&](int cell) {
    const Matrix6d law = solid_stiffness(material_of(input, cell), points.at(cell, 0));
    return Hourglass(places(mesh, cell), Hourglass::Projection::bending, poisson_of(law))
        .energy(law, varying_stresses(stresses, cell), stress_at_the_middle(stresses, cell));
  });
}

void add_stabilisation_work(const FieldInput& input, const ElementField& stresses, const NodalField& displacements,
                            const ElementField* stresses_before, const NodalField* displacements_before,
                            ElementField& densities) {
  if (stresses.component("FSTAB1") < 0) return;
  MaterialAtPoints points(input, stresses);
  const Mesh& mesh = *input.model.mesh;
  add_of_stabilised_cells(input.model, stresses, densities, [&](int cell) {
    Hourglass::Stresses varying = 0.5 * varying_stresses(stresses, cell);
    Vector6d middle = 0.5 * stress_at_the_middle(stresses, cell);
    Hourglass::Places moved = relative_values(mesh, cell, displacements);
    if (stresses_before && is_stabilised(*stresses_before, cell)) {
      varying += 0.5 * varying_stresses(*stresses_before, cell);
      middle += 0.5 * stress_at_the_middle(*stresses_before, cell);
    }
    if (displacements_before) moved -= relative_values(mesh, cell, *displacements_before);
    // What patterns make in a body that flows has no pressure.
    const bool flows =
        varying.topRows<3>().colwise().sum().norm() < pressure_of_roundings * varying.topRows<3>().norm();
    const double poisson = flows ? 0.0 : poisson_of(solid_stiffness(material_of(input, cell), points.at(cell, 0)));
    const auto projection = flows ? Hourglass::Projection::deviatoric : Hourglass::Projection::bending;
    return Hourglass(places(mesh, cell), projection, poisson).forces(varying, middle).cwiseProduct(moved).sum();
  });
}

ElementField bar_work(const Model& model, std::span<const int> bars, const ElementField& forces,
                      const NodalField& displacements, const ElementField* forces_before,
                      const NodalField* displacements_before) {
  const Mesh& mesh = *model.mesh;
  const auto elongation = [&](const NodalField& moved, int cell) {
    const auto ends = mesh.cell(cell);
    const Eigen::Vector3d axis = (place(mesh, ends[1]) - place(mesh, ends[0])).normalized();
    double sum = 0.0;
    for (const auto& [name, direction] : {std::pair("DX", 0), std::pair("DY", 1), std::pair("DZ", 2)}) {
      const int component = moved.component(name);
      if (component >= 0 && axis[direction] != 0.0)
        sum += axis[direction] * (moved.at(ends[1], component) - moved.at(ends[0], component));
    }
    return sum;
  };
  ElementField work{
      "ENER_R", Support::cell, {"TOTALE"}, std::vector<int>(static_cast<std::size_t>(mesh.cell_count()) + 1, 0), {}};
  for (const int cell : bars) work.starts[static_cast<std::size_t>(cell) + 1] = 1;
  std::partial_sum(work.starts.begin(), work.starts.end(), work.starts.begin());
  work.values.resize(bars.size());
  for (const int cell : bars) {
    double force = forces.at(cell, 0, forces.component("N"));
    double change = elongation(displacements, cell);
    if (forces_before) force += forces_before->at(cell, 0, forces_before->component("N"));
    if (displacements_before) change -= elongation(*displacements_before, cell);
    work.values[static_cast<std::size_t>(work.starts[cell])] = 0.5 * force * change;
  }
  return work;
}

ElementField elastic_energy_density(const FieldInput& input, const ElementField& stresses) {
  const TensorReader stress(stresses, stress_components);
  MaterialAtPoints points(input, stresses);
  return scalar_field(stresses, stress, [&](int cell, int g) {
    const Vector6d value = stress.at(cell, g);
    return 0.5 * value.dot(solid_compliance(material_of(input, cell), points.at(cell, g)) * value);
  });
}

ElementField strain_energy_density(const FieldInput& input, const ElementField& strains) {
  const TensorReader strain(strains, strain_components);
  MaterialAtPoints points(input, strains);
  return scalar_field(strains, strain, [&](int cell, int g) {
    if (!points.covers(cell)) return absent;
    Vector6d value = strain.at(cell, g);
    value.tail<3>() *= 2.0;
    if (is_plane_stress(input.model.formulations[static_cast<std::size_t>(cell)]))
      return 0.5 * value.head<4>().dot(plane_stress_stiffness(material_of(input, cell), points.at(cell, g)) *
                                       value.head<4>());
    return 0.5 * value.dot(solid_stiffness(material_of(input, cell), points.at(cell, g)) * value);
  });
}

ElementField total_energy_density(const ElementField& stresses, const ElementField& strains,
                                  const ElementField* stresses_before, const ElementField* strains_before,
                                  const ElementField* previous) {
  const TensorReader stress(stresses, stress_components);
  const TensorReader strain(strains, strain_components);
  const TensorReader stress_before(stresses_before ? *stresses_before : stresses, stress_components);
  const TensorReader strain_before(strains_before ? *strains_before : strains, strain_components);
  const auto lacks = [&](const ElementField* field, int cell) {
    return field != nullptr && field->points(cell) != stresses.points(cell);
  };
  for (int cell = 0; cell + 1 < static_cast<int>(stresses.starts.size()); ++cell)
    if (stress.has(cell) &&
        (lacks(stresses_before, cell) || lacks(strains_before, cell) || lacks(previous, cell) || lacks(&strains, cell)))
      throw Error("incompatible-field",
                  "stresses, strains and energies of two steps, of which the total energy adds up, lie on different "
                  "cells",
                  "compute SIEF_ELGA of all steps on the whole model, and with one model");
  return scalar_field(stresses, stress, [&](int cell, int point) {
    Vector6d mean = 0.5 * stress.at(cell, point);
    Vector6d change = strain.at(cell, point);
    if (stresses_before) mean += 0.5 * stress_before.at(cell, point);
    if (strains_before) change -= strain_before.at(cell, point);
    change.tail<3>() *= 2;
    return mean.dot(change) + (previous ? previous->at(cell, point, 0) : 0.0);
  });
}

ElementField hardening_energy_density(const FieldInput& input, const ElementField& variables,
                                      const BehaviourOfCells& behaviours) {
  const int p = variables.component("V1");
  ContinuumPoints points(input.model);
  ElementField energies{"ENER_R", Support::gauss_point, {"TOTALE"}, {0}, {}};
  for (int cell = 0; cell < input.model.mesh->cell_count(); ++cell) {
    const CellBehaviour& behaviour = behaviours[static_cast<std::size_t>(cell)];
    const bool hardens =
        points.covers(cell) && is_isotropic(behaviour.relation) && has_small_strains(behaviour.kinematics);
    const int count = hardens ? variables.points(cell) : 0;
    energies.starts.push_back(energies.starts.back() + count);
    if (count == 0) continue;
    for (int g = 0; g < count; ++g)
      energies.values.push_back(hardening_energy(plastic_point_at(input, points, behaviour.relation, cell, g).curve,
                                                 variables.at(cell, g, p)));
  }
  return energies;
}

ElementField integrate_cells(const Model& model, const ElementField& field) {
  const std::size_t width = field.components.size();
  ContinuumPoints points(model);
  ElementField result{field.quantity, Support::cell, field.components, {0}, {}};
  for (int cell = 0; cell < model.mesh->cell_count(); ++cell) {
    const bool carries = points.covers(cell) && field.points(cell) > 0;
    result.starts.push_back(result.starts.back() + (carries ? 1 : 0));
    if (!carries) continue;
    const auto& samples = points.samples(cell);
    const auto nodes = model.mesh->cell(cell);
    const bool nodal = field.support == Support::element_node;
    if (field.support != Support::cell) check_points(model, field, cell, nodal ? nodes.size() : samples.size());
    const std::size_t start = result.values.size();
    result.values.resize(start + width, 0.0);
    for (std::size_t g = 0; g < samples.size(); ++g) {
      const double weight = points.locate(cell, samples[g]).weight;
      for (std::size_t c = 0; c < width; ++c) {
        const auto at = [&](std::size_t p) { return field.at(cell, static_cast<int>(p), static_cast<int>(c)); };
        double value = 0.0;
        if (nodal) {
          for (std::size_t a = 0; a < nodes.size(); ++a)
            value += samples[g].values[static_cast<Eigen::Index>(a)] * at(a);
        } else {
          value = at(field.support == Support::cell ? 0 : g);
        }
        result.values[start + c] += weight * value;
      }
    }
  }
  return result;
}

ElementField integrate_skin(const Model& model, const NodalField& field, std::span<const int> cells) {
  const Mesh& mesh = *model.mesh;
  CellSamples samples;
  std::vector<bool> chosen(static_cast<std::size_t>(mesh.cell_count()), false);
  for (const int cell : cells) chosen[static_cast<std::size_t>(cell)] = true;
  ElementField result{field.quantity, Support::cell, field.components, {0}, {}};
  for (int cell = 0; cell < mesh.cell_count(); ++cell) {
    if (chosen[static_cast<std::size_t>(cell)]) {
      const auto nodes = mesh.cell(cell);
      const std::size_t start = result.values.size();
      result.values.resize(start + field.components.size(), 0.0);
      for (const CellSample& sample : samples.of(mesh.cell_types[cell], CellRole::skin)) {
        const CellPoint point = locate(mesh, cell, sample);
        const double weight = sample.weight * point.measure(dimension(mesh.cell_types[cell])) *
                              (is_axisymmetric(model.formulations[cell]) ? point.at[0] : 1.0);
        for (std::size_t c = 0; c < field.components.size(); ++c)
          for (std::size_t a = 0; a < nodes.size(); ++a)
            result.values[start + c] +=
                weight * sample.values[static_cast<Eigen::Index>(a)] * field.at(nodes[a], static_cast<int>(c));
      }
    }
    result.starts.push_back(static_cast<int>(result.values.size() / field.components.size()));
  }
  return result;
}

ElementField line_lengths(const Mesh& mesh) {
  ElementField lengths{"NEUT_R", Support::cell, {"VOL"}, {0}, {}};
  for (int cell = 0; cell < mesh.cell_count(); ++cell) {
    if (mesh.cell_types[cell] == CellType::seg2) {
      const auto nodes = mesh.cell(cell);
      lengths.values.push_back(
          (Eigen::Vector3d(mesh.nodes[nodes[1]].data()) - Eigen::Vector3d(mesh.nodes[nodes[0]].data())).norm());
    }
    lengths.starts.push_back(static_cast<int>(lengths.values.size()));
  }
  return lengths;
}

ElementField integrate_lines(const Mesh& mesh, const ElementField& field, std::span<const int> cells) {
  const std::size_t width = field.components.size();
  const ElementField lengths = line_lengths(mesh);
  std::vector<bool> chosen(static_cast<std::size_t>(mesh.cell_count()), false);
  for (const int cell : cells) chosen[static_cast<std::size_t>(cell)] = true;
  ElementField result{field.quantity, Support::cell, field.components, {0}, {}};
  for (int cell = 0; cell < mesh.cell_count(); ++cell) {
    const int points = field.points(cell);
    const bool carries = chosen[static_cast<std::size_t>(cell)] && lengths.points(cell) > 0 && points > 0;
    for (std::size_t c = 0; carries && c < width; ++c) {
      double sum = 0.0;
      for (int point = 0; point < points; ++point) sum += field.at(cell, point, static_cast<int>(c));
      result.values.push_back(lengths.at(cell, 0, 0) * sum / points);
    }
    result.starts.push_back(static_cast<int>(result.values.size() / width));
  }
  return result;
}

ElementField cell_volumes(const Model& model) {
  ContinuumPoints points(model);
  ElementField unit{"NEUT_R", Support::cell, {"VOL"}, {0}, {}};
  for (int cell = 0; cell < model.mesh->cell_count(); ++cell) {
    if (points.covers(cell)) unit.values.push_back(1.0);
    unit.starts.push_back(static_cast<int>(unit.values.size()));
  }
  return integrate_cells(model, unit);
}

double sum_over_cells(const ElementField& field, int component, std::optional<std::span<const int>> cells) {
  double sum = 0.0;
  const auto add = [&](int cell) {
    for (int point = 0; point < field.points(cell); ++point) {
      const double value = field.at(cell, point, component);
      if (!std::isnan(value)) sum += value;
    }
  };
  if (cells) {
    for (const int cell : *cells) add(cell);
  } else {
    for (int cell = 0; cell + 1 < static_cast<int>(field.starts.size()); ++cell) add(cell);
  }
  return sum;
}

}  // namespace comma::solver
