#include "solver/nonlinear/contact/secant_iterations.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "solver/contact_law/secant_friction.hpp"

namespace comma::solver {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// Below this share of the loads the part along the slip is left out of secants wholly (Code_Aster 17.3), which
/// converges faster near the solution.
constexpr double accelerated_below = 1e-3;

}  // namespace

bool SecantIterations::suit(const ContactDefinition& definition) {
  const auto& zones = definition.zones;
  return definition.formulation == ContactFormulation::discrete &&
         std::ranges::any_of(zones, [](const ContactZone& zone) { return zone.mixed.friction > 0.0; }) &&
         std::ranges::all_of(zones, [](const ContactZone& zone) {
           return !zone.resolved || (zone.mixed.penalised && !zone.mixed.bilateral &&
                                     (zone.mixed.friction_penalised || !(zone.mixed.friction > 0.0)));
         });
}

void SecantIterations::start_step(bool by_secants, bool are_faced) {
  predicts_ = by_secants;
  if (by_secants) held_ = contact_->forces;
  linearisations_ = 0;
  kept_.reset();
  if (by_secants && are_faced) begin();
}

void SecantIterations::accept_step() {
  const bool is_known = contact_->forces.size() == contact_->rows.full().rows();
  carried_ = is_known ? VectorXd(contact_->rows.full().transpose() * contact_->forces) : VectorXd();
  end_closed_ = contact_->closed_points();
}

/// Of points that are faced for the first time in a step.
void SecantIterations::begin() {
  const bool are_new = contact_->definition.geometry_update != GeometryUpdate::none || end_closed_.empty();
  began_closed_ = are_new ? std::vector<char>(contact_->points().size(), 0) : end_closed_;
  was_closed_ = began_closed_;
  rubs_.assign(contact_->points().size(), 0);
  solved_ = carried_.size() ? carried_ : VectorXd(VectorXd::Zero(contact_->dofs.size()));
}

void SecantIterations::before_facing() { held_of_points_ = forces_of_points(held_); }

void SecantIterations::after_facing() {
  if (predicts_) begin();
  held_ = forces_on_rows(std::exchange(held_of_points_, {}));
}

bool SecantIterations::keeps(Positions positions, double time, double margin) {
  if (linearisations_ == 0) return false;
  kept_ = {{positions.begin(), positions.end()}, time, margin};
  return true;
}

std::optional<ContactGeometry> SecantIterations::take_kept() { return std::exchange(kept_, std::nullopt); }

int SecantIterations::linearise(const VectorXd& u, bool faced_anew) {
  const CondensedProblem& problem = contact_->problem;
  CondensedState& state = contact_->state;
  VectorXd now = contact_->jumps(u);
  if (!faced_anew && linearisations_ > 0) take_solved_gaps(now);
  const bool accelerated = last_residual_ < accelerated_below;
  ++linearisations_;
  reliefs_.clear();
  state.multipliers.setZero();
  int changes = 0;
  for (std::size_t p = 0; p < problem.points.size(); ++p) {
    if (problem.points[p].rows == 0) continue;
    const ContactStatus status = take_secant(p, now, accelerated);
    changes += status != state.statuses[p];
    state.statuses[p] = status;
  }
  contact_->forces = multiplier_forces(problem, state, contact_->rows.full().rows());
  VectorXd shears = contact_->forces;
  for (const CondensedPoint& point : problem.points)
    if (point.rows > 0) shears[point.first_row] = 0.0;
  shears_ = contact_->rows.full().transpose() * shears;
  return changes;
}

bool SecantIterations::may_end() const {
  for (std::size_t p = 0; p < contact_->points().size(); ++p)
    if (contact_->is_closed(p) && contact_->problem.points[p].law.friction > 0.0 && rubs_[p] == 0) return false;
  return true;
}

/// Where the last solve pressed by a penalty its force tells the gap to all digits; the displacements of a body on weak
/// springs tell it to their own rounding, which a stiff penalty makes a force.
void SecantIterations::take_solved_gaps(VectorXd& jumps) const {
  for (std::size_t p = 0; p < contact_->points().size(); ++p) {
    const CondensedPoint& point = contact_->problem.points[p];
    if (point.rows > 0 && was_closed_[p] != 0)
      jumps[point.first_row] = -held_[point.first_row] / (point.weight * point.law.penalty());
  }
}

/// Where a point has just closed friction does not act yet. The first solve of a step, which leaves contact as it was,
/// opens none.
ContactStatus SecantIterations::take_secant(std::size_t p, const VectorXd& jumps, bool accelerated) {
  CondensedPoint& point = contact_->problem.points[p];
  point.law.linear_shear.reset();
  const Vector3d jump = at_point(point, jumps);
  const double pressure = -point.law.penalty() * jump[0];
  const bool is_closed = pressure > 0.0;
  const bool counts_from_start = linearisations_ <= 2;
  rubs_[p] = was_closed_[p] || (counts_from_start && began_closed_[p]);
  was_closed_[p] = is_closed;
  if (!is_closed) return ContactStatus::open;
  SecantShear shear;
  if (point.law.friction > 0.0 && rubs_[p] != 0) {
    const double relief = accelerated ? 1.0 : contact_->mixed_zone_of(p).secant_relief;
    const Vector2d slip = live_part(point.law, jump).tail<2>();
    shear = secant_shear(point.law, pressure, slip, relief);
    if (shear.status == ContactStatus::sliding && relief > 0.0)
      reliefs_.push_back({p, relief * point.weight * shear.value.norm() / slip.norm(), slip.normalized(),
                          point.weight * shear.value.norm()});
  }
  point.law.linear_shear = shear.linear;
  const Vector3d multiplier(pressure, shear.value[0], shear.value[1]);
  contact_->state.multipliers.segment(Eigen::Index{point.nodes[0]} * contact_->problem.components, point.rows) =
      multiplier.head(point.rows);
  return shear.status;
}

/// Of each point, as the rows at hand have them; zero where there are none.
std::vector<Vector3d> SecantIterations::forces_of_points(const VectorXd& on_rows) const {
  const auto& points = contact_->problem.points;
  std::vector<Vector3d> forces(points.size(), Vector3d::Zero());
  if (on_rows.size() != contact_->rows.full().rows()) return forces;
  for (std::size_t p = 0; p < forces.size(); ++p)
    if (points[p].rows > 0) forces[p] = at_point(points[p], on_rows);
  return forces;
}

VectorXd SecantIterations::forces_on_rows(const std::vector<Vector3d>& of_points) const {
  VectorXd forces = VectorXd::Zero(contact_->rows.full().rows());
  for (std::size_t p = 0; p < of_points.size(); ++p) {
    const CondensedPoint& point = contact_->problem.points[p];
    if (point.rows > 0) forces.segment(point.first_row, point.rows) = of_points[p].head(point.rows);
  }
  return forces;
}

/// Code_Aster 17.3 relieves a secant along the friction of all points at the nodes of this one, not of this one alone:
/// where conditions hold the master that is in their reactions, and so in the residual that ends the iterations.
void SecantIterations::note_solved(const VectorXd& before, const VectorXd& after) {
  const RowMatrix& rows = contact_->rows.full();
  held_ = contact_->forces;
  solved_ = rows.transpose() * held_;
  const VectorXd moved = contact_->jumps(after) - contact_->jumps(before);
  for (const Relief& relief : reliefs_) {
    const CondensedPoint& point = contact_->problem.points[relief.point];
    const double along = relief.along.dot(at_point(point, moved).tail<2>());
    std::map<int, double> own;
    for (int c = 1; c < point.rows; ++c)
      for (RowMatrix::InnerIterator it(rows, point.first_row + c); it; ++it)
        own[static_cast<int>(it.col())] -= relief.along[c - 1] * it.value();
    for (const auto& [dof, share] : own)
      solved_[dof] -= relief.stiffness * along * (shears_[dof] / relief.shear - share);
  }
}

}  // namespace comma::solver
