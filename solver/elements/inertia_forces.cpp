#include "solver/elements/inertia_forces.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "solver/elements/slender/slender_forces.hpp"
#include "solver/elements/slender/varying_section.hpp"
#include "solver/error.hpp"
#include "solver/mesh/place.hpp"

namespace comma::solver {

namespace {

/// What a cosine of a right angle leaves.
constexpr double rounding_of_direction = 1e-12;

using Vector6 = Eigen::Matrix<double, 6, 1>;

bool any_axisymmetric(const Model& model, std::span<const int> cells) {
  return std::any_of(cells.begin(), cells.end(), [&](int cell) { return is_axisymmetric(model.formulations[cell]); });
}

void add_continuum(const ForceInput& input, int cell, const AccelerationField& field, double factor,
                   CellSamples& samples, std::span<long double> forces) {
  const double per_volume = factor * density(elasticity_of(input, cell), material_point_of(input, cell));
  if (per_volume == 0.0) return;
  const Mesh& mesh = *input.model.mesh;
  const CellType type = mesh.cell_types[cell];
  const bool axisymmetric = is_axisymmetric(input.model.formulations[cell]);
  const int components = dimension(type);
  const NodeColumns places = node_places(mesh, cell);
  NodeColumns nodal = NodeColumns::Zero(3, places.cols());
  // Code_Aster integrates them where stresses are: rotation on the one point of a TETRA4.
  for (const CellSample& sample : samples.of_stiffness(type, input.model.formulations[cell])) {
    const CellPoint point = locate(places, sample);
    const double mass = per_volume * sample.weight * point.measure(components) * (axisymmetric ? point.at[0] : 1.0);
    nodal += (mass * field.at(point.at)).lazyProduct(sample.values.transpose());
  }
  for (Eigen::Index a = 0; a < nodal.cols(); ++a) {
    const int first = input.dofs.dof(mesh.cell(cell)[a], Component::dx);
    for (int c = 0; c < components; ++c) forces[first + c] += nodal(c, a);
  }
}

/// On the surface of the mesh, where Code_Aster has the mass of a plate whose middle lies apart from it too.
void add_plate(const ForceInput& input, int cell, const AccelerationField& field, double factor, CellSamples& samples,
               std::span<long double> forces) {
  const Mesh& mesh = *input.model.mesh;
  const auto section = input.properties.plates.find(cell);
  if (section == input.properties.plates.end()) {
    throw Error("missing-properties", fmt::format("plate {} has no thickness", mesh.cell_name(cell)));
  }
  const double per_area =
      factor * section->second.thickness * density(elasticity_of(input, cell), material_point_of(input, cell));
  const NodeColumns places = node_places(mesh, cell);
  for (const CellSample& sample : samples.of(mesh.cell_types[cell], CellRole::body)) {
    const CellPoint point = locate(places, sample);
    const Eigen::Vector3d force = per_area * sample.weight * point.measure(2) * field.at(point.at);
    for (Eigen::Index a = 0; a < places.cols(); ++a) {
      const int first = input.dofs.dof(mesh.cell(cell)[static_cast<std::size_t>(a)], Component::dx);
      for (int c = 0; c < 3; ++c) forces[static_cast<std::size_t>(first + c)] += sample.values[a] * force[c];
    }
  }
}

void add_slender(const ForceInput& input, int cell, const AccelerationField& field, double factor,
                 std::span<long double> forces) {
  const double per_volume = factor * density(elasticity_of(input, cell), material_point_of(input, cell));
  const BeamSection& section = section_of(input, cell);
  const auto nodes = input.model.mesh->cell(cell);
  const Eigen::Matrix3d axes = slender_axes(input, cell);
  std::array<Vector6, 2> at_ends = {Vector6::Zero(), Vector6::Zero()};
  for (int end = 0; end < 2; ++end) {
    at_ends[end].head<3>() = per_volume * (axes * field.at(place(*input.model.mesh, nodes[end])));
  }
  const auto load = [&](double s) -> Vector6 {
    return section_at(section, s).area * ((1.0 - s) * at_ends[0] + s * at_ends[1]);
  };
  add_slender_load(input, cell, load, forces);
}

/// What a body around a node adds in an acceleration that varies over it: the integrals of G r and of r x G r over its
/// mass.
Vector6 force_of_gradient(const Eigen::MatrixXd& mass, const Eigen::Matrix3d& gradient) {
  Vector6 force = Vector6::Zero();
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  if (mass.rows() == 3) {
    first << mass(2, 1), -mass(2, 0), 0.0;
    if (mass(0, 0) > 0.0) second = first * first.transpose() / mass(0, 0);
  } else {
    first << mass(5, 1), mass(3, 2), mass(4, 0);
    const Eigen::Matrix3d inertia = mass.bottomRightCorner<3, 3>();
    second = 0.5 * inertia.trace() * Eigen::Matrix3d::Identity() - inertia;
  }
  const Eigen::Matrix3d turning = gradient * second;
  force.head<3>() = gradient * first;
  force.tail<3>() << turning(2, 1) - turning(1, 2), turning(0, 2) - turning(2, 0), turning(1, 0) - turning(0, 1);
  return force;
}

/// Its mass matrix times the accelerations of its nodes, and what a mass beside its node meets there.
void add_discrete(const ForceInput& input, int cell, const AccelerationField& field, double factor,
                  std::span<long double> forces) {
  const auto found = input.properties.masses.find(cell);
  if (found == input.properties.masses.end()) return;
  const auto nodes = input.model.mesh->cell(cell);
  const ComponentMask mask = input.model.components_of(cell);
  std::vector<int> dofs;
  std::vector<double> accelerations;
  for (const int node : nodes) {
    const Eigen::Vector3d a = field.at(place(*input.model.mesh, node));
    for (int c = 0; c < component_count; ++c) {
      if (!contains(mask, static_cast<Component>(c))) continue;
      dofs.push_back(input.dofs.dof(node, static_cast<Component>(c)));
      accelerations.push_back(c < 3 ? factor * a[c] : 0.0);
    }
  }
  const auto size = static_cast<Eigen::Index>(dofs.size());
  if (found->second.rows() != size || found->second.cols() != size) {
    throw Error("wrong-size",
                fmt::format("the mass of the discrete element on cell {} is {} x {}, not {} x {}",
                            input.model.mesh->cell_name(cell), found->second.rows(), found->second.cols(), size, size));
  }
  Eigen::VectorXd force = found->second * Eigen::Map<const Eigen::VectorXd>(accelerations.data(), size);
  const auto of_node = size / static_cast<Eigen::Index>(nodes.size());
  if (contains(mask, Component::drz)) {
    for (Eigen::Index first = 0; first < size; first += of_node) {
      const Vector6 more =
          factor * force_of_gradient(found->second.block(first, first, of_node, of_node), field.gradient);
      if (of_node == 3)
        force.segment<3>(first) += Eigen::Vector3d(more[0], more[1], more[5]);
      else
        force.segment<6>(first) += more;
    }
  }
  for (Eigen::Index i = 0; i < size; ++i) forces[dofs[i]] += force[i];
}

}  // namespace

AccelerationField gravity_field(const GravityLoad& load, const Model& model) {
  Eigen::Vector3d acceleration(load.acceleration.data());
  if (std::abs(acceleration[0]) <= rounding_of_direction * acceleration.norm()) acceleration[0] = 0.0;
  if (acceleration[0] != 0.0 && any_axisymmetric(model, load.cells)) {
    throw Error("unsupported", "gravity in an axisymmetric model can only act along its axis Y",
                "give it the direction (0, -1, 0)");
  }
  return {acceleration, Eigen::Matrix3d::Zero()};
}

AccelerationField centrifugal_field(const RotationLoad& load, const Model& model) {
  const Eigen::Vector3d given(load.axis.data());
  if (!(given.norm() > 0.0)) throw Error("zero-vector", "the axis of a rotation has no length");
  const Eigen::Vector3d axis = given.normalized();
  const Eigen::Vector3d centre(load.centre.data());
  const bool about_y = std::hypot(axis[0], axis[2]) <= rounding_of_direction &&
                       std::hypot(centre[0], centre[2]) <= rounding_of_direction * centre.norm();
  if (!about_y && any_axisymmetric(model, load.cells)) {
    throw Error("unsupported", "an axisymmetric model can only turn about its axis Y",
                "give the axis (0, 1, 0) and a centre on it");
  }
  const Eigen::Matrix3d gradient = load.speed * load.speed * (Eigen::Matrix3d::Identity() - axis * axis.transpose());
  return {-gradient * centre, gradient};
}

void add_inertia_forces(const ForceInput& input, int cell, const AccelerationField& field, double factor,
                        CellSamples& samples, std::span<long double> forces) {
  if (input.model.components_of(cell) == 0 || input.model.is_skin(cell)) return;
  const Formulation formulation = input.model.formulations[cell];
  if (continuum_dimension(formulation) > 0) return add_continuum(input, cell, field, factor, samples, forces);
  if (is_bar(formulation) || is_beam(formulation)) return add_slender(input, cell, field, factor, forces);
  if (is_plate(formulation)) return add_plate(input, cell, field, factor, samples, forces);
  add_discrete(input, cell, field, factor, forces);
}

}  // namespace comma::solver
