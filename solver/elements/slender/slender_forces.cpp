#include "solver/elements/slender/slender_forces.hpp"

#include <array>

#include <fmt/format.h>

#include "solver/elements/slender/varying_section.hpp"
#include "solver/error.hpp"
#include "solver/mesh/reference_element.hpp"

namespace comma::solver {

namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Vector12 = Eigen::Matrix<double, 12, 1>;

double length_of(const Mesh& mesh, int cell) {
  const auto nodes = mesh.cell(cell);
  return (Eigen::Map<const Eigen::Vector3d>(mesh.nodes[nodes[1]].data()) -
          Eigen::Map<const Eigen::Vector3d>(mesh.nodes[nodes[0]].data()))
      .norm();
}

/// The load of a bar is linear.
Vector12 bar_end_forces(const Mesh& mesh, int cell, const LineLoad& load) {
  const Vector6 first = load(0.0);
  const Vector6 second = load(1.0);
  if (!first.tail<3>().isZero(0.0) || !second.tail<3>().isZero(0.0)) {
    throw Error("unsupported", fmt::format("moments act on bar {}, which does not bend", mesh.cell_name(cell)));
  }
  const double share = length_of(mesh, cell) / 6.0;
  Vector12 own = Vector12::Zero();
  own.head<3>() = share * (2.0 * first + second).head<3>();
  own.segment<3>(6) = share * (first + 2.0 * second).head<3>();
  return own;
}

Vector12 beam_end_forces(const ForceInput& input, int cell, const LineLoad& load) {
  const double length = length_of(*input.model.mesh, cell);
  if (input.model.formulations[cell] == Formulation::euler_beam) return end_forces({length, 0.0, 0.0}, load);
  const auto* isotropic = std::get_if<IsotropicElasticity>(&elasticity_of(input, cell));
  if (isotropic == nullptr) {
    throw Error("unsupported",
                fmt::format("the beam on cell {} has an anisotropic material, but needs an isotropic one",
                            input.model.mesh->cell_name(cell)));
  }
  const IsotropicModuli material = moduli(*isotropic, material_point_of(input, cell));
  return end_forces(timoshenko_interpolation(section_at(section_of(input, cell), 0.5), material, length), load);
}

}  // namespace

const BeamSection& section_of(const ForceInput& input, int cell) {
  const auto found = input.properties.sections.find(cell);
  if (found != input.properties.sections.end()) return found->second;
  throw Error("missing-properties",
              fmt::format("the bar or beam on cell {} has no cross-section", input.model.mesh->cell_name(cell)));
}

const Elasticity& elasticity_of(const ForceInput& input, int cell) {
  const Material* material = input.materials.by_cell.empty() ? nullptr : input.materials.by_cell[cell].get();
  if (material != nullptr && material->elasticity) return *material->elasticity;
  throw Error("missing-material", fmt::format("a load depends on the material of cell {}, which has none",
                                              input.model.mesh->cell_name(cell)));
}

MaterialPoint material_point_of(const ForceInput& input, int cell) {
  const Mesh& mesh = *input.model.mesh;
  const auto nodes = mesh.cell(cell);
  std::array<double, max_nodes> shares;
  shares.fill(1.0 / static_cast<double>(nodes.size()));
  MaterialPoint at;
  if (input.state != nullptr) input.state->sample(cell, nodes, std::span(shares).first(nodes.size()), 0, at);
  Point place{};
  for (const int node : nodes) {
    for (int j = 0; j < 3; ++j) place[j] += mesh.nodes[node][j] / static_cast<double>(nodes.size());
  }
  at.place(place);
  return at;
}

Eigen::Matrix3d slender_axes(const ForceInput& input, int cell) {
  const double roll = is_beam(input.model.formulations[cell]) ? section_of(input, cell).roll : 0.0;
  return own_axes(*input.model.mesh, cell, roll);
}

namespace {

void add_at_ends(const ForceInput& input, int cell, const Vector12& own, std::span<long double> forces) {
  const Mesh& mesh = *input.model.mesh;
  const Eigen::Matrix3d axes = slender_axes(input, cell);
  const ComponentMask carried = input.model.components_of(cell);
  for (int part = 0; part < 4; ++part) {  // forces and moments of the first end, then of the second
    const Eigen::Vector3d global = axes.transpose() * own.segment<3>(3 * part);
    const int node = mesh.cell(cell)[part / 2];
    for (int c = 0; c < 3; ++c) {
      const auto component = static_cast<Component>(3 * (part % 2) + c);
      if (contains(carried, component)) forces[input.dofs.dof(node, component)] += global[c];
    }
  }
}

}  // namespace

void add_slender_load(const ForceInput& input, int cell, const LineLoad& load, std::span<long double> forces) {
  const bool bar = is_bar(input.model.formulations[cell]);
  add_at_ends(input, cell, bar ? bar_end_forces(*input.model.mesh, cell, load) : beam_end_forces(input, cell, load),
              forces);
}

void add_force_per_length(const ForceInput& input, int cell, const std::array<Vector6, 2>& at_ends,
                          std::span<long double> forces) {
  if (is_bar(input.model.formulations[cell]) || !varies(section_of(input, cell))) {
    const auto linear = [&](double s) -> Vector6 { return (1.0 - s) * at_ends[0] + s * at_ends[1]; };
    return add_slender_load(input, cell, linear, forces);
  }
  Vector12 own;
  for (int end = 0; end < 2; ++end) {
    const auto constant = [&](double) { return at_ends[end]; };
    own.segment<6>(6 * end) = beam_end_forces(input, cell, constant).segment<6>(6 * end);
  }
  add_at_ends(input, cell, own, forces);
}

}  // namespace comma::solver
