#include "solver/elements/slender/section.hpp"

#include <cmath>

#include <fmt/format.h>

#include "solver/error.hpp"

namespace comma::solver {

namespace {

/// Directions (in radians) closer than this are the same but for rounding.
constexpr double smallest_roll = 1e-12;
/// A segment that leans less (sine of the angle) is vertical: turns and rounded coordinates leave such leans in
/// columns.
constexpr double smallest_lean = 1e-9;

void check_count(std::size_t given, std::size_t expected, const Mesh& mesh, int cell) {
  if (given == expected) return;
  throw Error("wrong-size", fmt::format("the matrix of the discrete element on {} takes {} values, not {}",
                                        mesh.cell_name(cell), expected, given));
}

int matrix_size(const Mesh& mesh, int cell, Formulation formulation) {
  return static_cast<int>(mesh.cell(cell).size()) * discrete_components(formulation);
}

/// Rotation from global to local components of one node: translations, then rotations.
Eigen::MatrixXd node_rotation(Formulation formulation, const Eigen::Matrix3d& axes) {
  const int k = discrete_components(formulation);
  Eigen::MatrixXd rotation = Eigen::MatrixXd::Identity(k, k);
  const int translations =
      formulation == Formulation::spring_2d || formulation == Formulation::spring_rotation_2d ? 2 : 3;
  rotation.topLeftCorner(translations, translations) = axes.topLeftCorner(translations, translations);
  if (k == 6) rotation.bottomRightCorner<3, 3>() = axes;
  return rotation;
}

/// A matrix of the element, given in its own axes, in global ones.
Eigen::MatrixXd to_global(Formulation formulation, const Eigen::Matrix3d& axes, Eigen::MatrixXd matrix) {
  if (axes.isIdentity(0.0)) return matrix;
  const bool symmetric = matrix == matrix.transpose();
  const Eigen::MatrixXd rotation = node_rotation(formulation, axes);
  const auto k = rotation.rows();
  for (Eigen::Index i = 0; i < matrix.rows(); i += k) {
    for (Eigen::Index j = 0; j < matrix.cols(); j += k) {
      matrix.block(i, j, k, k) = (rotation.transpose() * matrix.block(i, j, k, k) * rotation).eval();
    }
  }
  if (!symmetric) return matrix;
  return 0.5 * (matrix + matrix.transpose());
}

DiscreteStiffness finish(const Mesh& mesh, int cell, Formulation formulation, Eigen::MatrixXd matrix,
                         DiscreteFrame frame, const Orientation& orientation) {
  DiscreteStiffness result{.matrix = {}, .axes = discrete_axes(mesh, cell, orientation)};
  result.matrix =
      frame == DiscreteFrame::local ? to_global(formulation, result.axes, std::move(matrix)) : std::move(matrix);
  return result;
}

/// The symmetric matrix whose upper triangle is given column by column.
Eigen::MatrixXd from_upper_triangle(const Mesh& mesh, int cell, Formulation formulation,
                                    std::span<const double> values) {
  const int size = matrix_size(mesh, cell, formulation);
  check_count(values.size(), static_cast<std::size_t>(size * (size + 1) / 2), mesh, cell);
  Eigen::MatrixXd matrix(size, size);
  auto value = values.begin();
  for (int j = 0; j < size; ++j) {
    for (int i = 0; i <= j; ++i) matrix(i, j) = matrix(j, i) = *value++;
  }
  return matrix;
}

/// The matrix of which all entries are given column by column.
Eigen::MatrixXd from_columns(const Mesh& mesh, int cell, Formulation formulation, std::span<const double> values) {
  const int size = matrix_size(mesh, cell, formulation);
  check_count(values.size(), static_cast<std::size_t>(size * size), mesh, cell);
  return Eigen::Map<const Eigen::MatrixXd>(values.data(), size, size);
}

DiscreteMass finish_mass(const Mesh& mesh, int cell, Formulation formulation, Eigen::MatrixXd matrix,
                         DiscreteFrame frame, const Orientation& orientation) {
  if (frame == DiscreteFrame::global) return matrix;
  return to_global(formulation, discrete_axes(mesh, cell, orientation), std::move(matrix));
}

Eigen::Vector3d along_segment(const Mesh& mesh, int cell) {
  const auto nodes = mesh.cell(cell);
  return Eigen::Map<const Eigen::Vector3d>(mesh.nodes[nodes[1]].data()) -
         Eigen::Map<const Eigen::Vector3d>(mesh.nodes[nodes[0]].data());
}

}  // namespace

Eigen::Matrix3d level_axes(const Eigen::Vector3d& along, double roll) {
  Eigen::Vector3d x = along.normalized(), y = Eigen::Vector3d::UnitY();
  const double level = std::hypot(x[0], x[1]);
  if (level > smallest_lean)
    y << -x[1] / level, x[0] / level, 0.0;
  else
    x << 0.0, 0.0, std::copysign(1.0, x[2]);
  const Eigen::Vector3d z = x.cross(y);
  Eigen::Matrix3d axes;
  axes << x.transpose(), (std::cos(roll) * y + std::sin(roll) * z).transpose(),
      (std::cos(roll) * z - std::sin(roll) * y).transpose();
  return axes;
}

Eigen::Matrix3d own_axes(const Mesh& mesh, int cell, double roll) {
  const auto nodes = mesh.cell(cell);
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  if (nodes.size() > 1) {
    const Eigen::Vector3d along = along_segment(mesh, cell);
    const double length = along.norm();
    if (!(length > 0.0)) {
      throw Error("distorted-cell",
                  fmt::format("segment {} has no length, so its own axes are not defined", mesh.cell_name(cell)),
                  "give the stiffness of a spring in global axes");
    }
    return level_axes(along, roll);
  }
  if (roll == 0.0) return axes;
  return (Eigen::AngleAxisd(roll, axes.row(0).transpose()).toRotationMatrix() * axes.transpose()).transpose();
}

bool has_direction(const Mesh& mesh, int cell, double no_length) {
  return mesh.cell(cell).size() > 1 && along_segment(mesh, cell).norm() > no_length;
}

Eigen::Matrix3d discrete_axes(const Mesh& mesh, int cell, const Orientation& orientation) {
  return has_direction(mesh, cell, orientation.no_length) ? own_axes(mesh, cell, orientation.roll)
                                                          : orientation.point_axes;
}

double roll_towards(const Mesh& mesh, int cell, const Eigen::Vector3d& y) {
  const Eigen::Vector3d wanted = own_axes(mesh, cell) * y;  // in the axes without roll
  if (!(std::hypot(wanted[1], wanted[2]) > smallest_roll * wanted.norm())) {
    throw Error(
        "zero-vector",
        fmt::format("the direction of the second axis of {} lies along the cell, or is zero", mesh.cell_name(cell)),
        "give a direction across the cell");
  }
  return std::atan2(wanted[2], wanted[1]);
}

Eigen::Matrix3d axes_along(const Eigen::Vector3d& x, const Eigen::Vector3d& y) {
  const Eigen::Vector3d z = x.cross(y);
  if (!(z.norm() > smallest_roll * x.norm() * y.norm())) {
    throw Error("zero-vector", "the two directions of a frame lie along each other, or one is zero",
                "give two different directions");
  }
  Eigen::Matrix3d axes;
  axes << x.normalized().transpose(), z.cross(x).normalized().transpose(), z.normalized().transpose();
  return axes;
}

int discrete_components(Formulation formulation) {
  switch (formulation) {
    case Formulation::spring_2d:
      return 2;
    case Formulation::spring_3d:
    case Formulation::spring_rotation_2d:
      return 3;
    case Formulation::spring_rotation_3d:
      return 6;
    default:
      return 0;
  }
}

DiscreteStiffness diagonal_stiffness(const Mesh& mesh, int cell, Formulation formulation,
                                     std::span<const double> values, DiscreteFrame frame,
                                     const Orientation& orientation) {
  const int k = discrete_components(formulation);
  check_count(values.size(), static_cast<std::size_t>(k), mesh, cell);
  const int size = matrix_size(mesh, cell, formulation);
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(size, size);
  for (int i = 0; i < size; ++i) {
    for (int j = i % k; j < size; j += k) matrix(i, j) = i == j ? values[i % k] : -values[i % k];
  }
  return finish(mesh, cell, formulation, std::move(matrix), frame, orientation);
}

DiscreteStiffness symmetric_stiffness(const Mesh& mesh, int cell, Formulation formulation,
                                      std::span<const double> values, DiscreteFrame frame,
                                      const Orientation& orientation) {
  return finish(mesh, cell, formulation, from_upper_triangle(mesh, cell, formulation, values), frame, orientation);
}

DiscreteStiffness unsymmetric_stiffness(const Mesh& mesh, int cell, Formulation formulation,
                                        std::span<const double> values, DiscreteFrame frame,
                                        const Orientation& orientation) {
  return finish(mesh, cell, formulation, from_columns(mesh, cell, formulation, values), frame, orientation);
}

DiscreteMass symmetric_mass(const Mesh& mesh, int cell, Formulation formulation, std::span<const double> values,
                            DiscreteFrame frame, const Orientation& orientation) {
  return finish_mass(mesh, cell, formulation, from_upper_triangle(mesh, cell, formulation, values), frame, orientation);
}

DiscreteMass unsymmetric_mass(const Mesh& mesh, int cell, Formulation formulation, std::span<const double> values,
                              DiscreteFrame frame, const Orientation& orientation) {
  return finish_mass(mesh, cell, formulation, from_columns(mesh, cell, formulation, values), frame, orientation);
}

DiscreteMass rigid_mass(const Mesh& mesh, int cell, Formulation formulation, const DiscreteInertia& inertia,
                        DiscreteFrame frame, const Orientation& orientation) {
  const int k = discrete_components(formulation);
  const bool segment = mesh.cell(cell).size() == 2;
  const bool turns = formulation == Formulation::spring_rotation_3d || formulation == Formulation::spring_rotation_2d;
  if (!inertia.offset.isZero(0.0) && (segment || !turns)) {
    throw Error("unsupported", fmt::format("the mass on {} has an offset, which only a point with rotations can have",
                                           mesh.cell_name(cell)));
  }
  const Eigen::Matrix3d axes =
      frame == DiscreteFrame::local ? discrete_axes(mesh, cell, orientation) : Eigen::Matrix3d::Identity();
  const Eigen::Vector3d e = axes.transpose() * inertia.offset;
  Eigen::Matrix3d lever;  // lever * a = e x a
  lever << 0, -e[2], e[1], e[2], 0, -e[0], -e[1], e[0], 0;
  Eigen::Matrix<double, 6, 6> full;
  full << inertia.mass * Eigen::Matrix3d::Identity(), -inertia.mass * lever,  //
      inertia.mass * lever, axes.transpose() * inertia.tensor * axes - inertia.mass * lever * lever;
  const std::vector<int> kept = k == 2   ? std::vector{0, 1}
                                : !turns ? std::vector{0, 1, 2}
                                : k == 3 ? std::vector{0, 1, 5}
                                         : std::vector{0, 1, 2, 3, 4, 5};
  const Eigen::MatrixXd node = full(kept, kept);
  if (!segment) return node;
  DiscreteMass result = DiscreteMass::Zero(2 * k, 2 * k);
  result.topLeftCorner(k, k) = result.bottomRightCorner(k, k) = node;
  return result;
}

}  // namespace comma::solver
