// The part of MixedContact that chooses augmentations.
#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/contact_law/nodal_step.hpp"
#include "solver/nonlinear/mixed_contact.hpp"

namespace comma::solver {
namespace {

/// An augmentation between nodes of this share of the stiffness of the bodies changes the solution by less than figures
/// are compared by (2e-8 in a block that opens), and pressures keep enough digits in it.
constexpr double least_augmentation = 1e-10;
/// By this it is lowered at a time.
constexpr double softer_augmentation = 1e-2;

}  // namespace

/// Where all points that share a multiplier lie on its node the solution does not depend on the augmentation; one as
/// stiff as the bodies suits any unit of length. Where points lie between nodes it does, but the softer the less: one
/// too soft beside the bodies is raised to where the solution hardly changes, and pressures no longer lose their digits
/// in it.
void MixedContact::add_natural_augmentation() {
  const std::vector<char> shared = shared_multipliers(problem_);
  std::vector<double> least(definition_.zones.size(),
                            std::numeric_limits<double>::infinity());  // of points that share multipliers: one a zone,
                                                                       // in which points weigh by it
  const auto is_shared = [&](const CondensedPoint& point) {
    return shared[static_cast<std::size_t>(point.nodes[0])] != 0;
  };
  for (std::size_t p = 0; p < points().size(); ++p) {
    CondensedPoint& point = problem_.points[p];
    if (point.rows == 0 || point.node_count == 0) continue;
    if (is_shared(point)) {
      double& softest = least[static_cast<std::size_t>(points()[p].zone)];
      softest = std::min(softest, resistance_at(p));
    } else if (points()[p].node >= 0) {
      point.stiffness = stiffness_at(p);
      if (!point.law.penalised) point.law.augmentation = point.stiffness;
      if (!point.law.friction_penalised) point.law.friction_augmentation = point.stiffness;
    }
  }
  for (std::size_t p = 0; p < points().size(); ++p) {
    CondensedPoint& point = problem_.points[p];
    if (point.rows == 0 || point.node_count == 0 || !is_shared(point)) continue;
    const double lowest = least_augmentation * least[static_cast<std::size_t>(points()[p].zone)];
    const double present =
        std::max(augmentation_of(definition_.zones[static_cast<std::size_t>(points()[p].zone)]), lowest);
    if (!point.law.penalised) point.law.augmentation = present;
    if (!point.law.friction_penalised) point.law.friction_augmentation = present;
  }
}

double MixedContact::augmentation_of(const ContactZone& zone) const {
  return zone.mixed.keeps_augmentation ? zone.mixed.augmentation : augmentation_share_ * zone.mixed.augmentation;
}

/// A point between nodes that opens while these press on loses friction at once, since its limit is that of the
/// pressure without the augmentation: no statuses need hold the law then. A softer augmentation makes that jump
/// smaller. Whether any became softer.
bool MixedContact::lower_augmentation() {
  if (problem_.components == 1) return false;
  const auto all = [this] {
    std::vector<double> values;
    for (const CondensedPoint& point : problem_.points) values.push_back(point.law.augmentation);
    return values;
  };
  const std::vector<double> before = all();
  augmentation_share_ *= softer_augmentation;
  add_natural_augmentation();
  return all() != before;
}

/// Between nodes the pressure of a penalty is that of the states of all points of the face, and these are by it: there
/// may be none that go together. Gaps alone are closed or not. Whether any point has such a law.
bool MixedContact::open_by_gaps() {
  if (opens_by_gaps_ || has_points_on_nodes(problem_) || !has_penalties()) return false;
  opens_by_gaps_ = true;
  apply_penalties();
  return true;
}

/// With the augmentations given; where there is no solution, with softer ones.
CondensedSolution MixedContact::solve_law() {
  if (is_rubbing()) return step_by_shares();
  const CondensedState earlier = state_;
  CondensedSolution solution = solve_condensed(*schur_, problem_, state_);
  while (solution.verdict == CondensedVerdict::too_many_iterations && schur_->is_exact() && lower_augmentation()) {
    state_ = earlier;
    const int iterations = solution.iterations;
    solution = solve_condensed(*schur_, problem_, state_);
    solution.iterations += iterations;
  }
  if (solution.verdict == CondensedVerdict::too_many_iterations && schur_->is_exact() && open_by_gaps()) {
    state_ = earlier;
    solution = solve_condensed(*schur_, problem_, state_);
  }
  return solution;
}

/// By what pressure a length the bodies at a point resist together, to which the softer one gives way.
double MixedContact::resistance_at(std::size_t p) const {
  const CondensedPoint& point = problem_.points[p];
  const Eigen::VectorXd& sizes = tangent_.row_sizes();
  double compliance = 0.0;
  for (RowMatrix::InnerIterator it(rows_.reduced(), point.first_row); it; ++it)
    if (sizes[it.col()] > 0.0) compliance += it.value() * it.value() / sizes[it.col()];
  return compliance > 0.0 ? 1.0 / (compliance * std::abs(point.weight)) : 0.0;
}

/// What the unknowns that move a point resist by: a pressure a length.
double MixedContact::stiffness_at(std::size_t p) const {
  const CondensedPoint& point = problem_.points[p];
  const Eigen::VectorXd& sizes = tangent_.row_sizes();
  double stiffness = 0.0;
  for (RowMatrix::InnerIterator it(rows_.reduced(), point.first_row); it; ++it)
    stiffness = std::max(stiffness, std::abs(it.value()) * sizes[it.col()]);
  return stiffness / std::abs(point.weight);
}

}  // namespace comma::solver
