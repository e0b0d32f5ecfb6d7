#include "solver/elements/plates/flat_plate.hpp"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "solver/elements/plates/plate_axes.hpp"
#include "solver/error.hpp"

namespace comma::solver {

namespace {

const PlateSection& section_of(const BlockInput& input, int cell) {
  const std::string name = input.model.mesh->cell_name(cell);
  const auto found = input.properties.plates.find(cell);
  if (found == input.properties.plates.end()) {
    throw Error("missing-properties", fmt::format("the plate on cell {} has no thickness", name));
  }
  if (!(found->second.thickness > 0.0) || !(found->second.shear_factor > 0.0)) {
    throw Error("invalid-properties",
                fmt::format("the plate on cell {} needs a positive thickness and shear factor", name));
  }
  return found->second;
}

/// Corners relative to the first, one a column.
template <int Nodes>
Eigen::Matrix<double, 3, Nodes> relative_corners(const Mesh& mesh, int cell) {
  Eigen::Matrix<double, 3, Nodes> places;
  const auto nodes = mesh.cell(cell);
  for (int i = 0; i < Nodes; ++i) places.col(i) = Eigen::Map<const Eigen::Vector3d>(mesh.nodes[nodes[i]].data());
  return places.colwise() - places.col(0).eval();
}

template <int Nodes>
bool is_convex(const Eigen::Matrix<double, 2, Nodes>& corners) {
  for (int i = 0; i < Nodes; ++i) {
    const Eigen::Vector2d before = corners.col(i) - corners.col((i + Nodes - 1) % Nodes);
    const Eigen::Vector2d after = corners.col((i + 1) % Nodes) - corners.col(i);
    if (!(before[0] * after[1] - before[1] * after[0] > 0.0)) return false;
  }
  return true;
}

/// Holds the rotations about the normal by a share of the least of the resistances to rotations in the plane, about the
/// first direction of the cell and across it.
template <int Nodes>
void hold_normal_rotations(Eigen::Matrix<double, 6 * Nodes, 6 * Nodes>& k, double share, const Eigen::Vector2d& first) {
  const Eigen::Vector2d across(-first[1], first[0]);
  double smallest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < Nodes; ++i) {
    const Eigen::Matrix2d rotations = k.template block<2, 2>(6 * i + 3, 6 * i + 3);
    smallest = std::min({smallest, first.dot(rotations * first), across.dot(rotations * across)});
  }
  for (int i = 0; i < Nodes; ++i) k(6 * i + 5, 6 * i + 5) += share * smallest;
}

}  // namespace

template <int Nodes>
FlatPlate<Nodes> flat_plate(const BlockInput& input, int cell) {
  const Mesh& mesh = *input.model.mesh;
  const auto corners = relative_corners<Nodes>(mesh, cell);
  const PlateSection& section = section_of(input, cell);
  FlatPlate<Nodes> plate{plate_axes(mesh, cell, section), {}, &section, &isotropic_material(input, cell)};
  plate.corners = plate.axes.template topRows<2>() * corners;
  if (!is_convex<Nodes>(plate.corners))
    throw Error("distorted-cell", fmt::format("plate {} is not convex", mesh.cell_name(cell)));
  return plate;
}

template <int Nodes>
double area_of(const FlatPlate<Nodes>& plate) {
  double twice = 0.0;
  for (int i = 0; i < Nodes; ++i) {
    const auto a = plate.corners.col(i), b = plate.corners.col((i + 1) % Nodes);
    twice += a[0] * b[1] - a[1] * b[0];
  }
  return 0.5 * twice;
}

template <int Nodes>
Eigen::Vector2d first_direction(const FlatPlate<Nodes>& plate) {
  const auto& at = plate.corners;
  const Eigen::Vector2d along = Nodes == 3 ? Eigen::Vector2d(at.col(1) - at.col(0))
                                           : Eigen::Vector2d(at.col(1) + at.col(2) - at.col(0) - at.col(Nodes - 1));
  return along.normalized();
}

PlateRigidity rigidity_of(const PlateSection& section, const IsotropicModuli& material, bool shears) {
  const double h = section.thickness;
  const double plane = material.young / (1.0 - material.poisson * material.poisson);
  const double shear_modulus = 0.5 * material.young / (1.0 + material.poisson);
  return {plane * h, plane * h * h * h / 12.0, material.poisson, section.offset,
          shears ? 1.0 / (section.shear_factor * shear_modulus * h) : 0.0};
}

Eigen::Matrix3d plane_law(double rigidity, double poisson) {
  Eigen::Matrix3d law;
  law << 1, poisson, 0, poisson, 1, 0, 0, 0, 0.5 * (1 - poisson);
  return rigidity * law;
}

template <int Nodes>
Eigen::Matrix<double, 6 * Nodes, 6 * Nodes> plate_stiffness(const FlatPlate<Nodes>& plate,
                                                            const PlateRigidity& rigidity, double young,
                                                            const Quadrature& points) {
  constexpr int size = 6 * Nodes;
  using Matrix = Eigen::Matrix<double, size, size>;
  const PlateSection& section = *plate.section;
  const PlateKinematics<Nodes> kinematics(plate.corners, rigidity);
  const Eigen::Matrix3d membrane = plane_law(rigidity.membrane, rigidity.poisson);
  const Eigen::Matrix3d bending = plane_law(rigidity.bending, rigidity.poisson);
  const bool shears = rigidity.shear_compliance > 0.0;
  const double tie = section.drilling < 0.0 ? -section.drilling * young * section.thickness : 0.0;
  Matrix k = Matrix::Zero();
  for (const QuadraturePoint& point : points) {
    const PlateRows<Nodes> rows = kinematics.at(point.at);
    const double area = point.weight * rows.measure;
    const Eigen::Matrix<double, 3, size> strain = rows.membrane + section.offset * rows.curvature;
    k += area * (strain.transpose() * membrane * strain + rows.curvature.transpose() * bending * rows.curvature);
    if (shears) k += area * rigidity.shear_compliance * rows.shear_force.transpose() * rows.shear_force;
    if (tie > 0.0) k += area * tie * rows.spin.transpose() * rows.spin;
  }
  if (section.drilling > 0.0) hold_normal_rotations<Nodes>(k, section.drilling, first_direction(plate));
  return k;
}

template FlatPlate<3> flat_plate<3>(const BlockInput& input, int cell);
template FlatPlate<4> flat_plate<4>(const BlockInput& input, int cell);
template double area_of(const FlatPlate<3>& plate);
template double area_of(const FlatPlate<4>& plate);
template Eigen::Vector2d first_direction(const FlatPlate<3>& plate);
template Eigen::Vector2d first_direction(const FlatPlate<4>& plate);
template Eigen::Matrix<double, 18, 18> plate_stiffness(const FlatPlate<3>& plate, const PlateRigidity& rigidity,
                                                       double young, const Quadrature& points);
template Eigen::Matrix<double, 24, 24> plate_stiffness(const FlatPlate<4>& plate, const PlateRigidity& rigidity,
                                                       double young, const Quadrature& points);

}  // namespace comma::solver
