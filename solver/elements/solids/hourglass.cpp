#include "solver/elements/solids/hourglass.hpp"

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

void add_bending(const Eigen::Matrix<double, 4, 3>& g, double poisson, StrainRows& rows) {
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

/// B of the middle on (x, y, z) by node.
Eigen::Matrix<double, 6, 24> strain_rows(const Hourglass::Places& gradients) {
  Eigen::Matrix<double, 6, 24> rows = Eigen::Matrix<double, 6, 24>::Zero();
  for (int a = 0; a < 8; ++a) {
    const auto g = gradients.row(a);
    auto own = rows.middleCols<3>(3 * a);
    own.diagonal() = g.transpose();
    own.row(3) << g(1), g(0), 0.0;
    own.row(4) << g(2), 0.0, g(0);
    own.row(5) << 0.0, g(2), g(1);
  }
  return rows;
}

Matrix3d tensor(const Vector6d& stress) {
  Matrix3d result;
  result << stress(0), stress(3), stress(4), stress(3), stress(1), stress(5), stress(4), stress(5), stress(2);
  return result;
}

Eigen::Matrix<double, 12, 1> in_a_column(const Hourglass::Patterns& patterns) {
  return patterns.reshaped<Eigen::RowMajor>();
}

}  // namespace

double poisson_of(const Matrix6d& law) { return law(0, 1) / (law(0, 0) + law(0, 1)); }

// In a body that flows Code_Aster 17.3 takes the displacements of the patterns by the mean gradients over the cell, and
// the derivatives of the patterns by the inverse of the transposed derivatives of the places; so does comma, for the
// same numbers. Both are the same in a box along the axes. The point at the middle counts for the whole volume there,
// and for that of its own weight in elasticity.
Hourglass::Hourglass(const Places& places, Projection projection, double poisson)
    : projection_(projection), poisson_(poisson) {
  constexpr ReferencePoint centre = {0.0, 0.0, 0.0};
  const bool flows = projection == Projection::deviatoric;
  const Matrix3d middle = jacobian(places, centre);
  gradients_ = shape_derivatives(CellType::hexa8, centre) * middle.inverse().transpose();
  Places mean = Places::Zero();
  double volume = 0.0;
  std::size_t k = 0;
  for (const QuadraturePoint& point : quadrature(CellType::hexa8, "FPG8")) {
    const Matrix3d map = jacobian(places, point.at);
    const Matrix3d inverse = map.inverse();
    const double weight = point.weight * std::abs(map.determinant());
    const Matrix3d taken = flows ? inverse : Matrix3d(inverse.transpose());
    points_[k++] = {weight, pattern_derivatives(point.at) * taken};
    mean += weight * shape_derivatives(CellType::hexa8, point.at) * inverse.transpose();
    volume += weight;
  }
  if (flows) missing_volume_ = volume - 8.0 * std::abs(middle.determinant());
  const auto corners = reference_nodes(CellType::hexa8);
  for (int a = 0; a < 8; ++a) gamma_.row(a) = patterns_at(corners[static_cast<std::size_t>(a)]).transpose();
  const Places& linear = flows ? (mean /= volume) : gradients_;
  gamma_ = (0.125 * (gamma_ - linear * (places.transpose() * gamma_))).eval();
}

Hourglass::StrainRows Hourglass::rows(const Patterns& derivatives) const {
  StrainRows sum = StrainRows::Zero();
  add_shears(derivatives, sum);
  if (projection_ == Projection::bending)
    add_bending(derivatives, poisson_, sum);
  else
    add_deviatoric(derivatives, sum);
  return sum;
}

// The shears of patterns in a body that flows have twice the stiffness in Code_Aster 17.3, and couplings of shears and
// stretches the square root of that.
Matrix6d Hourglass::counting(const Matrix6d& law) const {
  if (projection_ == Projection::bending) return law;
  Vector6d factors = Vector6d::Ones();
  factors.tail<3>().setConstant(std::sqrt(2.0));
  return factors.asDiagonal() * law * factors.asDiagonal();
}

Hourglass::Stresses Hourglass::stresses(const Matrix6d& law, const Patterns& amplitudes) const {
  Stresses strains;
  for (int factor = 0; factor < 12; ++factor) {
    Patterns one = Patterns::Zero();
    one(factor / 3, factor % 3) = 1.0;
    strains.col(factor) = rows(one) * in_a_column(amplitudes);
  }
  return counting(law) * strains;
}

Hourglass::Places Hourglass::forces(const Stresses& stresses, const Vector6d& middle) const {
  Eigen::Matrix<double, 12, 1> on_patterns = Eigen::Matrix<double, 12, 1>::Zero();
  Vector6d sum = missing_volume_ * middle;
  for (const Point& point : points_) {
    const Vector6d varying = stresses * in_a_column(point.derivatives);
    sum += point.weight * varying;
    on_patterns += point.weight * rows(point.derivatives).transpose() * (varying + middle);
  }
  const Patterns patterns = on_patterns.reshaped<Eigen::RowMajor>(4, 3);
  return gamma_ * patterns + gradients_ * tensor(sum);
}

Hourglass::Stiffness Hourglass::stiffness(const Matrix6d& law) const {
  const Matrix6d counted = counting(law);
  StrainRows sum = StrainRows::Zero();
  Eigen::Matrix<double, 12, 12> of_patterns = Eigen::Matrix<double, 12, 12>::Zero();
  for (const Point& point : points_) {
    const StrainRows here = rows(point.derivatives);
    sum += point.weight * here;
    of_patterns += point.weight * here.transpose() * counted * here;
  }
  Eigen::Matrix<double, 12, 24> spread = Eigen::Matrix<double, 12, 24>::Zero();
  for (int a = 0; a < 8; ++a)
    for (int pattern = 0; pattern < 4; ++pattern)
      for (int axis = 0; axis < 3; ++axis) spread(3 * pattern + axis, 3 * a + axis) = gamma_(a, pattern);
  const Eigen::Matrix<double, 6, 24> strains = strain_rows(gradients_);
  const Eigen::Matrix<double, 6, 24> patterns = sum * spread;
  return spread.transpose() * of_patterns * spread + strains.transpose() * counted * patterns +
         patterns.transpose() * law * strains + missing_volume_ * strains.transpose() * law * strains;
}

double Hourglass::energy(const Matrix6d& law, const Stresses& stresses, const Vector6d& middle) const {
  const Eigen::Matrix<double, 6, 12> strains = counting(law).inverse() * stresses;
  double sum = 0.5 * missing_volume_ * middle.dot(law.inverse() * middle);
  for (const Point& point : points_) {
    const auto derivatives = in_a_column(point.derivatives);
    sum += point.weight * (0.5 * stresses * derivatives + middle).dot(strains * derivatives);
  }
  return sum;
}

}  // namespace comma::solver
