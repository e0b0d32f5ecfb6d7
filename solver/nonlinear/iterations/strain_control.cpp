#include "solver/nonlinear/iterations/strain_control.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <fmt/format.h>

#include "solver/error.hpp"
#include "solver/fields/points/continuum_points.hpp"
#include "solver/fields/stresses/strains.hpp"
#include "solver/fields/stresses/tensor_reader.hpp"

namespace comma::solver {
namespace {

/// Strains below this share of the largest have no direction of their own.
constexpr double least_share = 1e-9;

/// Of tensors, whose shears count twice.
double product(const Vector6d& a, const Vector6d& b) {
  return a.head<3>().dot(b.head<3>()) + 2.0 * a.tail<3>().dot(b.tail<3>());
}

std::vector<int> continuum_cells(const StaticProblem& problem, std::vector<int> cells) {
  const Model& model = *problem.model;
  if (cells.empty()) {
    cells.resize(static_cast<std::size_t>(model.mesh->cell_count()));
    std::iota(cells.begin(), cells.end(), 0);
  }
  const ContinuumPoints continuum(model);
  std::erase_if(cells, [&](int cell) { return !continuum.covers(cell); });
  if (cells.empty())
    throw Error("missing-cells", "no cell that the path is to control is part of a solid or plane body",
                "name cells of a body");
  for (const int cell : cells)
    if (problem.behaviours && (*problem.behaviours)[static_cast<std::size_t>(cell)].kinematics != Kinematics::small)
      throw Error("unsupported",
                  fmt::format("cell {}: strains control the path in small strains alone", model.mesh->cell_name(cell)),
                  "control a displacement (DDL_IMPO, LONG_ARC)");
  return cells;
}

}  // namespace

StrainControl::StrainControl(const StaticProblem& problem, const DofMap& dofs, const Assembler& assembler,
                             const std::vector<int>& cells, const Eigen::VectorXd& u)
    : problem_(problem), dofs_(dofs), state_(assembler.state()) {
  const ElementField field = strains_of(u);
  const TensorReader strain(field, strain_components);
  double largest = 0.0;
  for (const int cell : continuum_cells(problem, cells))
    for (int point = 0; point < field.points(cell); ++point) {
      points_.push_back({cell, point, strain.at(cell, point)});
      if (is_plane_stress(problem.model->formulations[static_cast<std::size_t>(cell)]))
        points_.back().direction[2] = 0.0;
      largest = std::max(largest, product(points_.back().direction, points_.back().direction));
    }
  std::erase_if(points_, [&](const Point& point) {
    return product(point.direction, point.direction) <= least_share * least_share * largest;
  });
  if (points_.empty())
    throw Error("missing-strain",
                "strains are to control the path, and there are none yet whose direction it could keep",
                "load the body before, or begin with another control");
  for (Point& point : points_) point.direction /= std::sqrt(product(point.direction, point.direction));
}

ElementField StrainControl::strains_of(const Eigen::VectorXd& u) const {
  return strains({*problem_.model, *problem_.materials, *problem_.properties, state_}, to_field(u, dofs_, "DEPL_R"),
                 StrainKind::total);
}

/// Each point admits a half line of intensities; what all admit ends where one reaches what is wanted.
std::vector<double> StrainControl::intensities(double wanted, const Eigen::VectorXd& constant,
                                               const Eigen::VectorXd& linear) const {
  const ElementField by_constant = strains_of(constant), by_linear = strains_of(linear);
  const TensorReader constant_strain(by_constant, strain_components), linear_strain(by_linear, strain_components);
  double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
  for (const Point& point : points_) {
    const double left = wanted - product(point.direction, constant_strain.at(point.cell, point.point));
    const double slope = product(point.direction, linear_strain.at(point.cell, point.point));
    if (slope > 0.0)
      high = std::min(high, left / slope);
    else if (slope < 0.0)
      low = std::max(low, left / slope);
    else if (left < 0.0)
      return {};
  }
  if (!(low <= high)) return {};
  std::vector<double> found;
  for (const double each : {low, high})
    if (std::isfinite(each)) found.push_back(each);
  return found;
}

}  // namespace comma::solver
