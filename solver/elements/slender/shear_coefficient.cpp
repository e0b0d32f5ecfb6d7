#include "solver/elements/slender/shear_coefficient.hpp"

#include <cmath>
#include <vector>

#include <Eigen/Dense>
#include <Eigen/SparseCholesky>

namespace comma::solver {

namespace {

constexpr int degree = 4, nodes = degree + 1;
constexpr int layers = 5;  // of elements from the corner of the hole outwards, each a fifth of the next one
constexpr double grading = 0.2;

using Matrix = Eigen::Matrix<double, nodes, nodes>;
using Vector = Eigen::Matrix<double, nodes, 1>;

/// Polynomials on [-1, 1] through Gauss and Lobatto's points: integrals of their products and of their derivatives'.
struct LineElement {
  Vector at;
  Matrix mass, stiffness;
};

LineElement line_element() {
  const double inner = std::sqrt(3.0 / 7.0), near = std::sqrt(5.0 - 2.0 * std::sqrt(10.0 / 7.0)) / 3.0,
               far = std::sqrt(5.0 + 2.0 * std::sqrt(10.0 / 7.0)) / 3.0, root = 13.0 * std::sqrt(70.0);
  const Vector gauss(-far, -near, 0.0, near, far);
  const Vector weights((322.0 - root) / 900.0, (322.0 + root) / 900.0, 128.0 / 225.0, (322.0 + root) / 900.0,
                       (322.0 - root) / 900.0);
  LineElement line{Vector(-1.0, -inner, 0.0, inner, 1.0), {}, {}};
  Matrix powers, values, slopes;  // by point and power; by Gauss point and power
  for (int i = 0; i < nodes; ++i) {
    for (int k = 0; k < nodes; ++k) {
      powers(i, k) = std::pow(line.at[i], k);
      values(i, k) = std::pow(gauss[i], k);
      slopes(i, k) = k == 0 ? 0.0 : k * std::pow(gauss[i], k - 1);
    }
  }
  const Matrix inverse = powers.inverse();
  values *= inverse;
  slopes *= inverse;
  line.mass = values.transpose() * weights.asDiagonal() * values;
  line.stiffness = slopes.transpose() * weights.asDiagonal() * slopes;
  return line;
}

/// Ends of elements from 0 to the side of the hole and on to the outer side.
std::vector<double> graded_ends(double hole, double outer) {
  std::vector<double> ends(2 * layers + 1, hole);
  double share = 1.0;
  for (int i = 0; i < layers; ++i, share *= grading) {
    ends[static_cast<std::size_t>(i)] = hole * (1.0 - share);
    ends[static_cast<std::size_t>(2 * layers - i)] = hole + (outer - hole) * share;
  }
  return ends;
}

}  // namespace

double shear_coefficient_along_z(const HollowRectangle& section) {
  const LineElement line = line_element();
  const auto y_ends = graded_ends(section.hole_y, section.y), z_ends = graded_ends(section.hole_z, section.z);
  constexpr int across = 2 * layers * degree;  // unknowns along z, without those at z = 0, where w is 0
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd load = Eigen::VectorXd::Zero((across + 1) * across);
  for (int i = 0; i < 2 * layers; ++i) {
    for (int j = i < layers ? layers : 0; j < 2 * layers; ++j) {
      const double half_y = 0.5 * (y_ends[i + 1] - y_ends[i]), half_z = 0.5 * (z_ends[j + 1] - z_ends[j]);
      const Vector z = Vector::Constant(z_ends[j] + half_z) + half_z * line.at;
      const Vector load_y = half_y * line.mass.rowwise().sum(), load_z = half_z * line.mass * z;
      for (int a = 0; a < nodes * nodes; ++a) {
        const int y_a = a / nodes, z_a = a % nodes, row_z = degree * j + z_a - 1;
        if (row_z < 0) continue;
        const int row = (degree * i + y_a) * across + row_z;
        load[row] += load_y[y_a] * load_z[z_a];
        for (int b = 0; b < nodes * nodes; ++b) {
          const int y_b = b / nodes, z_b = b % nodes, column_z = degree * j + z_b - 1;
          if (column_z < 0) continue;
          entries.emplace_back(row, (degree * i + y_b) * across + column_z,
                               half_z / half_y * line.stiffness(y_a, y_b) * line.mass(z_a, z_b) +
                                   half_y / half_z * line.mass(y_a, y_b) * line.stiffness(z_a, z_b));
        }
      }
    }
  }
  // What lies inside the hole has no element.
  constexpr int hole = layers * degree;
  for (int i = 0; i < hole; ++i)
    for (int j = 0; j + 1 < hole; ++j) entries.emplace_back(i * across + j, i * across + j, 1.0);
  Eigen::SparseMatrix<double> stiffness(load.size(), load.size());
  stiffness.setFromTriplets(entries.begin(), entries.end());
  const Eigen::VectorXd w = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(stiffness).solve(load);
  const double area = 4.0 * (section.y * section.z - section.hole_y * section.hole_z);
  const double inertia =
      4.0 / 3.0 * (section.y * std::pow(section.z, 3) - section.hole_y * std::pow(section.hole_z, 3));
  return area / (inertia * inertia) * 4.0 * w.dot(load);
}

}  // namespace comma::solver
