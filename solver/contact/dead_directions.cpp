#include "solver/contact/dead_directions.hpp"

#include <Eigen/Eigenvalues>

namespace comma::solver {
namespace {

/// Of the squares of all rows of a point: what is less along a direction is the rounding of conditions.
constexpr double dead_share = 1e-14;

}  // namespace

void find_dead_directions(const RowMatrix& reduced_rows, std::vector<CondensedPoint>& points) {
  for (CondensedPoint& point : points) {
    if (point.rows < 3 || !(point.law.friction > 0.0)) continue;
    const auto row = [&](int c) { return reduced_rows.row(point.first_row + c); };
    const double both = row(1).dot(row(2));
    Eigen::Matrix2d squares;
    squares << row(1).squaredNorm(), both, both, row(2).squaredNorm();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> motions(squares);
    const double dead = dead_share * (row(0).squaredNorm() + squares.trace());
    if (motions.eigenvalues()[1] <= dead) point.law.friction = 0.0;
    else if (motions.eigenvalues()[0] <= dead) point.law.dead = motions.eigenvectors().col(0);
  }
}

}  // namespace comma::solver
