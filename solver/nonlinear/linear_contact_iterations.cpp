// The part of MixedContact whose iterations are one linear solve each: joint ones, and secants of friction.
#include <algorithm>
#include <map>

#include "solver/contact_law/secant_friction.hpp"
#include "solver/linear/largest_component.hpp"
#include "solver/model/deformed_places.hpp"
#include "solver/nonlinear/geometry_updates.hpp"
#include "solver/nonlinear/mixed_contact.hpp"

namespace comma::solver {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Below this share of the loads the part along the slip is left out of secants wholly (Code_Aster 17.3), which
/// converges faster near the solution.
constexpr double accelerated_below = 1e-3;

bool rubs_between_nodes(const ContactDefinition& definition) {
  const auto& zones = definition.zones;
  return definition.formulation == ContactFormulation::discrete &&
         std::ranges::any_of(zones, [](const ContactZone& zone) { return zone.mixed.friction > 0.0; }) &&
         std::ranges::all_of(zones, [](const ContactZone& zone) {
           return !zone.resolved || (zone.mixed.penalised && !zone.mixed.bilateral &&
                                     (zone.mixed.friction_penalised || !(zone.mixed.friction > 0.0)));
         });
}

}  // namespace

MixedContact::Iterations MixedContact::iterations_like_code_aster(bool whole_newton) const {
  if (rubs_between_nodes(definition_)) return Iterations::secant;
  if (rubs_loosely()) return Iterations::rubbing;
  const bool is_standard = std::ranges::none_of(definition_.zones, [](const ContactZone& zone) {
    return zone.mixed.local_average || zone.mixed.penalised || zone.mixed.friction > 0.0;
  });
  return whole_newton && is_standard ? Iterations::joint : Iterations::settled;
}

void MixedContact::iterate(Iterations iterations) {
  iterations_ = iterations;
  rubbing_ = {};
  problem_.one_step = iterations != Iterations::settled;
}

int MixedContact::linearise(const Eigen::VectorXd& u, double time) {
  if (is_rubbing()) return linearise_friction(u);
  return is_secant() ? linearise_secants(u) : face_and_linearise(u, time);
}

bool MixedContact::may_end(int changes) const {
  if (iterations_ == Iterations::joint) return changes == 0 && geometry_change_ <= definition_.joint_geometry_tolerance;
  if (is_rubbing()) return rubbing_.change <= definition_.friction_tolerance;
  if (!is_secant()) return true;
  for (std::size_t p = 0; p < points().size(); ++p)
    if (state_.statuses[p] != ContactStatus::open && problem_.points[p].law.friction > 0.0 && secants_.rubs[p] == 0)
      return false;
  return true;
}

int MixedContact::face_and_linearise(const Eigen::VectorXd& u, double time) {
  geometry_change_ = geometry_change(mesh_, dofs_, reference_, faced_at_, u).share;
  faced_at_ = u;
  face(positions_at(u, mesh_, dofs_), time, 0.0);
  const Eigen::VectorXd now = jumps(u);
  int changes = 0;
  forces_.setZero();
  for (std::size_t p = 0; p < points().size(); ++p) {
    const CondensedPoint& point = problem_.points[p];
    if (point.rows == 0) continue;
    const Vector3d pressure = multiplier_at(problem_, state_, point);
    const Vector3d gap(now[point.first_row], 0.0, 0.0);
    const bool stays_closed = point.bilateral && state_.statuses[p] != ContactStatus::open;
    const ContactStatus status = contact_status(point.law, stays_closed, pressure, gap);
    changes += status != state_.statuses[p];
    state_.statuses[p] = status;
    forces_[point.first_row] = point.weight * contact_law(point.law, status, pressure, gap).traction[0];
  }
  return changes;
}

/// Another geometry within a step acts from here on: the solve before was still that of the last one.
int MixedContact::linearise_secants(const Eigen::VectorXd& u) {
  const auto next = std::exchange(next_geometry_, std::nullopt);
  if (next) face(next->places, next->time, next->margin);
  Eigen::VectorXd now = jumps(u);
  if (!next && secants_.linearisations > 0) take_solved_gaps(now);
  const bool accelerated = secants_.last_residual < accelerated_below;
  ++secants_.linearisations;
  secants_.reliefs.clear();
  state_.multipliers.setZero();
  int changes = 0;
  for (std::size_t p = 0; p < points().size(); ++p) {
    if (problem_.points[p].rows == 0) continue;
    const ContactStatus status = take_secant(p, now, accelerated);
    changes += status != state_.statuses[p];
    state_.statuses[p] = status;
  }
  forces_ = multiplier_forces(problem_, state_, rows_.full().rows());
  Eigen::VectorXd shears = forces_;
  for (const CondensedPoint& point : problem_.points)
    if (point.rows > 0) shears[point.first_row] = 0.0;
  secants_.shears = rows_.full().transpose() * shears;
  return changes;
}

/// Where the last solve pressed by a penalty its force tells the gap to all digits; the displacements of a body on weak
/// springs tell it to their own rounding, which a stiff penalty makes a force.
void MixedContact::take_solved_gaps(Eigen::VectorXd& jumps) const {
  for (std::size_t p = 0; p < points().size(); ++p) {
    const CondensedPoint& point = problem_.points[p];
    if (point.rows > 0 && secants_.was_closed[p] != 0)
      jumps[point.first_row] = -secants_.held[point.first_row] / (point.weight * point.law.penalty());
  }
}

/// Where a point has just closed friction does not act yet. The first solve of a step, which leaves contact as it was,
/// opens none.
ContactStatus MixedContact::take_secant(std::size_t p, const Eigen::VectorXd& jumps, bool accelerated) {
  CondensedPoint& point = problem_.points[p];
  point.law.linear_shear.reset();
  const Vector3d jump = at_point(point, jumps);
  const double pressure = -point.law.penalty() * jump[0];
  const bool is_closed = pressure > 0.0;
  const bool counts_from_start = secants_.linearisations <= 2;
  secants_.rubs[p] = secants_.was_closed[p] || (counts_from_start && secants_.began_closed[p]);
  secants_.was_closed[p] = is_closed;
  if (!is_closed) return ContactStatus::open;
  SecantShear shear;
  if (point.law.friction > 0.0 && secants_.rubs[p] != 0) {
    const double relief =
        accelerated ? 1.0 : definition_.zones[static_cast<std::size_t>(points()[p].zone)].mixed.secant_relief;
    const Vector2d slip = live_part(point.law, jump).tail<2>();
    shear = secant_shear(point.law, pressure, slip, relief);
    if (shear.status == ContactStatus::sliding && relief > 0.0)
      secants_.reliefs.push_back({p, relief * point.weight * shear.value.norm() / slip.norm(), slip.normalized(),
                                  point.weight * shear.value.norm()});
  }
  point.law.linear_shear = shear.linear;
  const Vector3d multiplier(pressure, shear.value[0], shear.value[1]);
  state_.multipliers.segment(Eigen::Index{point.nodes[0]} * problem_.components, point.rows) =
      multiplier.head(point.rows);
  return shear.status;
}

/// Of each point, as the rows at hand have them; zero where there are none.
std::vector<Vector3d> MixedContact::forces_of_points(const Eigen::VectorXd& on_rows) const {
  std::vector<Vector3d> forces(problem_.points.size(), Vector3d::Zero());
  if (on_rows.size() != rows_.full().rows()) return forces;
  for (std::size_t p = 0; p < forces.size(); ++p)
    if (problem_.points[p].rows > 0) forces[p] = at_point(problem_.points[p], on_rows);
  return forces;
}

/// Points come in the same order at every pairing.
Eigen::VectorXd MixedContact::forces_on_rows(const std::vector<Vector3d>& of_points) const {
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(rows_.full().rows());
  for (std::size_t p = 0; p < of_points.size(); ++p) {
    const CondensedPoint& point = problem_.points[p];
    if (point.rows > 0) forces.segment(point.first_row, point.rows) = of_points[p].head(point.rows);
  }
  return forces;
}

/// Contact as an accepted step leaves it, with which the next one begins: its forces stay for one solve.
void MixedContact::carry_contact() {
  const bool is_known = forces_.size() == rows_.full().rows();
  secants_.carried = is_known ? Eigen::VectorXd(rows_.full().transpose() * forces_) : Eigen::VectorXd();
  secants_.end_closed = closed_points();
}

/// Of points that are faced for the first time in a step.
void MixedContact::begin_secants() {
  const bool are_new = definition_.geometry_update != GeometryUpdate::none || secants_.end_closed.empty();
  secants_.began_closed = are_new ? std::vector<char>(points().size(), 0) : secants_.end_closed;
  secants_.was_closed = secants_.began_closed;
  secants_.rubs.assign(points().size(), 0);
  secants_.solved = secants_.carried.size() ? secants_.carried : Eigen::VectorXd(Eigen::VectorXd::Zero(dofs_.size()));
}

/// Code_Aster 17.3 relieves a secant along the friction of all points at the nodes of this one, not of this one alone:
/// where conditions hold the master that is in their reactions, and so in the residual that ends the iterations.
void MixedContact::note_solved(const Eigen::VectorXd& before, const Eigen::VectorXd& after) {
  secants_.held = forces_;
  secants_.solved = rows_.full().transpose() * forces_;
  const Eigen::VectorXd moved = jumps(after) - jumps(before);
  for (const Secants::Relief& relief : secants_.reliefs) {
    const CondensedPoint& point = problem_.points[relief.point];
    const double along = relief.along.dot(at_point(point, moved).tail<2>());
    std::map<int, double> own;
    for (int c = 1; c < point.rows; ++c)
      for (RowMatrix::InnerIterator it(rows_.full(), point.first_row + c); it; ++it)
        own[static_cast<int>(it.col())] -= relief.along[c - 1] * it.value();
    for (const auto& [dof, share] : own)
      secants_.solved[dof] -= relief.stiffness * along * (secants_.shears[dof] / relief.shear - share);
  }
}

/// Nothing is known of a body that contact alone is to hold before it does.
bool MixedContact::can_predict() const { return tangent_.springs().empty() && !tangent_.is_indefinite(); }

Eigen::VectorXd MixedContact::forces_left_out() const {
  if (!is_secant() || secants_.predicts) return Eigen::VectorXd::Zero(elimination_.reduced_size());
  return rows_.reduced().transpose() * (forces_ - secants_.held);
}

MixedContact::HeldImbalance MixedContact::held_imbalance(const Eigen::VectorXd& balance) const {
  HeldImbalance result;
  if (!is_secant() && !is_rubbing()) return result;
  const Eigen::VectorXd& solved = is_secant() ? secants_.solved : rubbing_.solved;
  Eigen::VectorXd left = rows_.full().transpose() * forces_ - solved;
  Eigen::VectorXd reactions = balance + solved;
  for (const int dof : elimination_.kept()) left[dof] = reactions[dof] = 0.0;
  result.largest = largest_component(is_secant() ? left : reactions);
  for (const int dof : eliminated_) left[dof] = 0.0;
  result.counted = largest_component(left);
  return result;
}

void MixedContact::note_residual(double share) {
  if (share >= 0.0) secants_.last_residual = share;
}

}  // namespace comma::solver
