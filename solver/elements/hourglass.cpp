#include "solver/elements/hourglass.hpp"

#include <cmath>

#include "solver/elements/quadrature.hpp"

namespace comma::solver {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using StrainRows = Eigen::Matrix<double, 6, 12>;  // xx yy zz, twice xy xz yz

Eigen::Vector4d patterns_at(const ReferencePoint& at) {
  return {at[1] * at[2], at[0] * at[2], at[0] * at[1], at[0] * at[1] * at[2]};
}

/// A pattern a row, a reference coordinate a column.
Eigen::Matrix<double, 4, 3> pattern_derivatives(const ReferencePoint& at) {
  const auto [r, s, t] = at;
  Eigen::Matrix<double, 4, 3> derivatives;
  derivatives << 0, t, s, t, 0, r, s, r, 0, s * t, r * t, r * s;
  return derivatives;
}

Matrix3d jacobian(const Hourglass::Places& places, const ReferencePoint& at) {
  return shape_derivatives(CellType::hexa8, at).transpose() * places;
}

/// The orthonormal axes nearest to the reference axes at the middle, one a row. Whichever corner the cell is numbered
/// from, they are the same but for their names and signs.
Matrix3d own_axes(const Matrix3d& jacobian) {
  const Eigen::JacobiSVD<Matrix3d> svd(jacobian.rowwise().normalized(), Eigen::ComputeFullU | Eigen::ComputeFullV);
  return svd.matrixU() * svd.matrixV().transpose();
}

/// Poisson's ratio of an isotropic law.
double poisson_of(const Matrix6d& law) { return law(0, 1) / (law(0, 0) + law(0, 1)); }

/// The patterns 1 to 4 that go along an axis with the numbers in `which`, as digits.
void add(StrainRows& rows, int strain, int axis, const Eigen::Matrix<double, 4, 3>& gradients, int derivative,
         int which, double factor) {
  for (; which > 0; which /= 10)
    rows(strain, 3 * (which % 10 - 1) + axis) += factor * gradients(which % 10 - 1, derivative);
}

void add_shears(const Eigen::Matrix<double, 4, 3>& g, StrainRows& rows) {
  enum { x, y, z, xy = 3, xz = 4, yz = 5 };
  add(rows, xy, x, g, y, 12, 1.0);
  add(rows, xy, y, g, x, 12, 1.0);
  add(rows, yz, y, g, z, 23, 1.0);
  add(rows, yz, z, g, y, 23, 1.0);
  add(rows, xz, x, g, z, 13, 1.0);
  add(rows, xz, z, g, x, 13, 1.0);
}

void add_bending_patterns(const Eigen::Matrix<double, 4, 3>& g, double poisson, StrainRows& rows) {
  enum { x, y, z };
  const double in_plane = poisson / (1.0 - poisson);
  for (const int axis : {x, y, z}) add(rows, axis, axis, g, axis, 1234, 1.0);
  // Of each axis: the pattern that bends it in the plane of a face, and the rest.
  const auto contract = [&](int strain, int axis, int bent, int others) {
    add(rows, strain, axis, g, axis, bent, -in_plane);
    add(rows, strain, axis, g, axis, others, -poisson);
  };
  contract(y, x, 3, 14);
  contract(z, x, 2, 14);
  contract(x, y, 3, 24);
  contract(z, y, 1, 24);
  contract(x, z, 2, 34);
  contract(y, z, 1, 34);
}

void add_deviatoric(const Eigen::Matrix<double, 4, 3>& g, StrainRows& rows) {
  for (int strain = 0; strain < 3; ++strain)
    for (int axis = 0; axis < 3; ++axis)
      add(rows, strain, axis, g, axis, 1234, strain == axis ? 2.0 / 3.0 : -1.0 / 3.0);
}

}  // namespace

Hourglass::Hourglass(const Places& places) {
  constexpr ReferencePoint centre = {0.0, 0.0, 0.0};
  const Matrix3d middle = jacobian(places, centre);
  axes_ = own_axes(middle);
  const Places gradients = shape_derivatives(CellType::hexa8, centre) * middle.inverse().transpose();
  const auto corners = reference_nodes(CellType::hexa8);
  for (int a = 0; a < 8; ++a) gamma_.row(a) = patterns_at(corners[static_cast<std::size_t>(a)]).transpose();
  gamma_ = (0.125 * (gamma_ - gradients * (places.transpose() * gamma_))).eval();
  std::size_t k = 0;
  for (const QuadraturePoint& point : quadrature(CellType::hexa8, "FPG8")) {
    const Matrix3d map = jacobian(places, point.at);
    points_[k++] = {point.weight * std::abs(map.determinant()),
                    pattern_derivatives(point.at) * map.inverse().transpose() * axes_.transpose()};
  }
}

Hourglass::Stiffness Hourglass::stiffness(const Matrix6d& law, Projection projection) const {
  const Matrix6d to_global = strain_rotation(axes_.transpose());
  const Matrix6d own_law = to_global.transpose() * law * to_global;
  Stiffness sum = Stiffness::Zero();
  for (const Point& point : points_) {
    StrainRows rows = StrainRows::Zero();
    add_shears(point.gradients, rows);
    if (projection == Projection::bending)
      add_bending_patterns(point.gradients, poisson_of(own_law), rows);
    else
      add_deviatoric(point.gradients, rows);
    sum += point.weight * rows.transpose() * own_law * rows;
  }
  Stiffness turned;
  for (int row = 0; row < 12; row += 3)
    for (int column = 0; column < 12; column += 3)
      turned.block<3, 3>(row, column) = axes_.transpose() * sum.block<3, 3>(row, column) * axes_;
  return turned;
}

Eigen::Matrix<double, 24, 24> Hourglass::nodal_stiffness(const Stiffness& stiffness) const {
  Eigen::Matrix<double, 12, 24> spread = Eigen::Matrix<double, 12, 24>::Zero();
  for (int a = 0; a < 8; ++a)
    for (int pattern = 0; pattern < 4; ++pattern)
      for (int axis = 0; axis < 3; ++axis) spread(3 * pattern + axis, 3 * a + axis) = gamma_(a, pattern);
  return spread.transpose() * stiffness * spread;
}

}  // namespace comma::solver
