#include "solver/nonlinear/contact/mixed_contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "solver/error.hpp"
#include "solver/linear/largest_component.hpp"
#include "solver/model/deformed_places.hpp"
#include "solver/nonlinear/contact/contact_doubts.hpp"
#include "solver/nonlinear/contact/geometry_updates.hpp"
#include "solver/nonlinear/contact/resumed_contact.hpp"
#include "solver/nonlinear/failure.hpp"
#include "solver/unilateral/conditions.hpp"
#include "solver/unilateral/rounds.hpp"

namespace comma::solver {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

/// A gap below this share of the face's size counts as closed at the start (CONTACT_INIT='INTERPENETRE').
constexpr double touching = 1e-6;
constexpr int most_condensed_iterations = 60;

bool has_friction(const ContactDefinition& definition) {
  return std::ranges::any_of(definition.zones, [](const ContactZone& zone) { return zone.mixed.friction > 0.0; });
}

/// With which a point begins that is taken as closed.
ContactStatus closed(const ContactLaw& law) {
  return law.friction > 0.0 ? ContactStatus::sticking : ContactStatus::sliding;
}

}  // namespace

MixedContact::MixedContact(const ContactDefinition& definition, const Model& model, const DofMap& dofs,
                           const Elimination& elimination, TangentSystem& tangent, Counters& counters,
                           std::vector<int> support)
    : contact_{.definition = definition,
               .mesh = *model.mesh,
               .dofs = dofs,
               .elimination = elimination,
               .rows = ContactRows(definition, model, dofs, elimination),
               .reference = Eigen::VectorXd::Zero(dofs.size())},
      tangent_(tangent),
      counters_(counters),
      augmentations_(contact_, tangent),
      penalties_(contact_, augmentations_),
      compliance_(contact_, tangent, std::move(support)),
      secants_(contact_),
      rubbing_(contact_) {
  CondensedProblem& problem = contact_.problem;
  problem.smooth = contact_.rows.smooth();
  problem.node_count = static_cast<int>(problem.smooth.size());
  problem.components = has_friction(definition) ? contact_.rows.dimension() : 1;
  problem.max_iterations = most_condensed_iterations;
  problem.memory = &memory_;
  problem.near_inverse = &near_inverse_;
  problem.interpolated_solver = &interpolated_solver_;
  problem.share_search = &share_search_;
  contact_.state.multipliers = Eigen::VectorXd::Zero(problem.node_count * problem.components);
  rates_ = start_ = contact_.state.multipliers;
}

void MixedContact::restore() {
  contact_.state = remembered_->state;
  penalties_.take_back_to(remembered_->penalties);
  started_ = remembered_->started;
  resumed_ = remembered_->resumed;
  secants_ = remembered_->secants;
}

std::shared_ptr<const ContactMemory> MixedContact::memory() const {
  return contact_memory(contact_, penalties_.raised());
}

void MixedContact::begin_at(const Eigen::VectorXd& u, std::shared_ptr<const ContactMemory> memory) {
  contact_.reference = u;
  if (memory) resume_penalties(contact_.definition, *memory, penalties_.raised());
  resumed_ = std::move(memory);
}

void MixedContact::start_step(const Eigen::VectorXd& u, double duration) {
  secants_.start_step(is_secant(), started_);
  contact_.reference = faced_at_ = u;
  step_begins_ = true;
  if (started_) {
    began_closed_ = closed_points();
    hold_points();
  }
  augmentations_.start_step();
  penalties_.start_step(closed_count() > 0);
  penalties_.apply();
  contact_.problem.expected = contact_.state.multipliers + duration * rates_;
  start_ = contact_.state.multipliers;
  contact_.rows.count_slips(contact_.problem.points, contact_.reference);
}

void MixedContact::accept_step(double from, double instant) {
  rates_ = (contact_.state.multipliers - start_) / (instant - from);
  course_.begin(from, start_);
  course_.note(instant, contact_.state.multipliers);
  if (is_secant()) secants_.accept_step();
}

MixedContact::Iterations MixedContact::iterations_like_code_aster(bool whole_newton) const {
  if (SecantIterations::suit(contact_.definition)) return Iterations::secant;
  if (RubbingIterations::suit(contact_.definition)) return Iterations::rubbing;
  const bool is_standard = std::ranges::none_of(contact_.definition.zones, [](const ContactZone& zone) {
    return zone.mixed.local_average || zone.mixed.penalised || zone.mixed.friction > 0.0;
  });
  return whole_newton && is_standard ? Iterations::joint : Iterations::settled;
}

void MixedContact::iterate(Iterations iterations) {
  iterations_ = iterations;
  rubbing_.forget();
  contact_.problem.one_step = iterations != Iterations::settled;
}

void MixedContact::pair(Positions positions, double time, double margin) {
  if (!is_secant() || !secants_.keeps(positions, time, margin)) face(positions, time, margin);
}

void MixedContact::face(Positions positions, double time, double margin) {
  if (is_secant()) secants_.before_facing();
  contact_.rows.face(positions, time, margin);
  ++counters_.pairings;
  contact_.problem.points = contact_.rows.build(contact_.reference);
  penalties_.note_faced();
  penalties_.apply();
  share_friction();
  if (!started_) start_statuses(contact_.jumps(contact_.reference));
  if (!started_ || (!step_begins_ && !contact_.definition.joint_iterations)) began_closed_ = closed_points();
  started_ = true;
  hold_points();
  if (is_secant()) secants_.after_facing();
  hold_back_points();
  for (std::size_t p = 0; p < points().size(); ++p)
    if (contact_.problem.points[p].rows == 0) contact_.state.statuses[p] = ContactStatus::open;
  close_slides();
  start_forces(time);
}

/// Any would do for the next correction to start from; with a compliance that is not exact the nearest cost least.
void MixedContact::start_forces(double time) {
  CondensedState state = contact_.state;
  if (contact_.problem.components == 1 && !is_linear() && tangent_.is_constant() && compliance_.is_known()) {
    update_compliance();
    if (!compliance_.schur().is_exact()) state.multipliers = course_.expected(time, state.multipliers);
  }
  contact_.forces = multiplier_forces(contact_.problem, state, contact_.rows.full().rows());
}

/// Friction in the mixed formulation has shares of its limit for multipliers. Where all points that rub on a multiplier
/// lie on its node, and no penalty lets them creep, the solution is that of shears, which need no scale.
void MixedContact::share_friction() {
  if (contact_.definition.formulation != ContactFormulation::mixed || contact_.problem.components == 1) return;
  const std::vector<char> shared = shared_multipliers(contact_.problem);
  for (std::size_t p = 0; p < points().size(); ++p) {
    CondensedPoint& point = contact_.problem.points[p];
    if (!(point.law.friction > 0.0) || point.node_count == 0) continue;
    const MixedZone& mixed = contact_.mixed_zone_of(p);
    if (point.law.friction_penalised)
      point.share_augmentation = point.law.friction_augmentation;
    else if (shared[static_cast<std::size_t>(point.nodes[0])])
      point.share_augmentation = mixed.friction_augmentation;
  }
}

bool MixedContact::is_faced_again() const {
  if (contact_.definition.geometry_update == GeometryUpdate::controlled)
    return contact_.definition.controlled_updates > 1;
  return contact_.definition.geometry_update == GeometryUpdate::automatic &&
         contact_.definition.max_geometry_updates > 1;
}

/// Code_Aster 17.3, in scenes of two blocks: Newton's method on contact holds what is closed once none changes.
void MixedContact::hold_points() {
  if (!contact_.definition.contact_by_newton) return;
  for (std::size_t p = 0; p < points().size(); ++p)
    contact_.problem.points[p].bilateral = contact_.mixed_zone_of(p).bilateral && began_closed_[p] != 0;
}

/// What never opens again does not close on a surface as it lay before the step: points of bilateral zones wait for the
/// next geometry (the mixed formulation alone; ssnv104e tells). A body that touches nothing yet must not pass through
/// the other.
void MixedContact::hold_back_points() {
  held_back_.clear();
  const bool waits = step_begins_ && is_faced_again() && contact_.definition.formulation == ContactFormulation::mixed &&
                     closed_count() > 0;
  step_begins_ = false;
  for (std::size_t p = 0; p < points().size() && waits; ++p) {
    CondensedPoint& point = contact_.problem.points[p];
    if (!point.bilateral || point.rows == 0 || contact_.is_closed(p)) continue;
    point.rows = 0;
    held_back_.push_back(p);
  }
}

bool MixedContact::leaves_overlap(const Eigen::VectorXd& u) const {
  if (held_back_.empty()) return false;
  const Eigen::VectorXd now = contact_.jumps(u);
  return std::ranges::any_of(held_back_, [&](std::size_t p) {
    return now[contact_.problem.points[p].first_row] < -overlap_tolerance * contact_.size_at(p);
  });
}

void MixedContact::check_blocked_points(const Eigen::VectorXd& jumps) const {
  for (const std::size_t p : contact_.rows.blocked()) {
    const double gap = jumps[contact_.problem.points[p].first_row];
    if (contact_.mixed_zone_of(p).penalised) continue;
    if (gap >= -overlap_tolerance * contact_.size_at(p)) continue;
    throw Error(
        "contradictory-conditions",
        fmt::format("imposed displacements push slave face {} into facet {} by {:.6g}",
                    contact_.mesh.cell_name(points()[p].cell), contact_.mesh.cell_name(points()[p].facet), -gap),
        "free the nodes along the normal, or take them out of the contact (SANS_GROUP_NO)");
  }
}

void MixedContact::start_statuses(const Eigen::VectorXd& jumps) {
  contact_.state.statuses.assign(points().size(), ContactStatus::open);
  const auto memory = std::exchange(resumed_, nullptr);
  const std::vector<char> held = memory ? held_points(contact_, *memory) : std::vector<char>(points().size(), 0);
  for (std::size_t p = 0; p < points().size(); ++p) {
    const CondensedPoint& point = contact_.problem.points[p];
    if (point.rows == 0) continue;
    const MixedZone& zone = contact_.mixed_zone_of(p);
    const bool touches = jumps[point.first_row] <= touching * contact_.size_at(p);
    if (held[p] != 0 || zone.initial == InitialContact::all ||
        (zone.initial == InitialContact::interpenetrating && touches))
      contact_.state.statuses[p] = closed(point.law);
  }
}

/// GLISSIERE of the discrete formulation is a condition on all points that face the master.
void MixedContact::close_slides() {
  if (contact_.definition.formulation != ContactFormulation::discrete) return;
  const Eigen::VectorXd now = contact_.jumps(contact_.reference);
  for (std::size_t p = 0; p < points().size(); ++p) {
    const CondensedPoint& point = contact_.problem.points[p];
    const MixedZone& zone = contact_.mixed_zone_of(p);
    if (!zone.bilateral || point.rows == 0 || contact_.is_closed(p)) continue;
    contact_.state.statuses[p] = closed(point.law);
    const double gap = now[point.first_row];
    if (gap > std::max(zone.unnoticed_gap, touching * contact_.size_at(p)))
      bridged_.push_back({.kind = DoubtKind::bridged_gap,
                          .zone = points()[p].zone,
                          .share = gap,
                          .length = gap,
                          .node = points()[p].node});
  }
}

/// A body that contact alone holds needs some to begin with.
void MixedContact::close_nearest(const Eigen::VectorXd& jumps) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t p = 0; p < points().size(); ++p) {
    if (contact_.is_closed(p)) return;
    if (contact_.problem.points[p].rows > 0) nearest = std::min(nearest, jumps[contact_.problem.points[p].first_row]);
  }
  for (std::size_t p = 0; p < points().size(); ++p) {
    const CondensedPoint& point = contact_.problem.points[p];
    if (point.rows > 0 && jumps[point.first_row] <= nearest + touching * contact_.size_at(p))
      contact_.state.statuses[p] = closed(point.law);
  }
}

int MixedContact::linearise(const Eigen::VectorXd& u, double time) {
  if (is_rubbing()) return rubbing_.linearise(u);
  if (!is_secant()) return face_and_linearise(u, time);
  const auto kept = secants_.take_kept();
  if (kept) face(kept->places, kept->time, kept->margin);
  return secants_.linearise(u, kept.has_value());
}

int MixedContact::face_and_linearise(const Eigen::VectorXd& u, double time) {
  geometry_change_ = geometry_change(contact_.mesh, contact_.dofs, contact_.reference, faced_at_, u).share;
  faced_at_ = u;
  face(positions_at(u, contact_.mesh, contact_.dofs), time, 0.0);
  const Eigen::VectorXd now = contact_.jumps(u);
  int changes = 0;
  contact_.forces.setZero();
  for (std::size_t p = 0; p < points().size(); ++p) {
    const CondensedPoint& point = contact_.problem.points[p];
    if (point.rows == 0) continue;
    const Vector3d pressure = multiplier_at(contact_.problem, contact_.state, point);
    const Vector3d gap(now[point.first_row], 0.0, 0.0);
    const bool stays_closed = point.bilateral && contact_.is_closed(p);
    const ContactStatus status = contact_status(point.law, stays_closed, pressure, gap);
    changes += status != contact_.state.statuses[p];
    contact_.state.statuses[p] = status;
    contact_.forces[point.first_row] = point.weight * contact_law(point.law, status, pressure, gap).traction[0];
  }
  return changes;
}

bool MixedContact::may_end(int changes) const {
  if (is_joint()) return changes == 0 && geometry_change_ <= contact_.definition.joint_geometry_tolerance;
  if (is_rubbing()) return rubbing_.may_end();
  return !is_secant() || secants_.may_end();
}

MixedContact::HeldImbalance MixedContact::held_imbalance(const Eigen::VectorXd& balance) const {
  HeldImbalance result;
  if (!is_secant() && !is_rubbing()) return result;
  const Eigen::VectorXd& solved = is_secant() ? secants_.solved() : rubbing_.solved();
  Eigen::VectorXd left = contact_.rows.full().transpose() * contact_.forces - solved;
  Eigen::VectorXd reactions = balance + solved;
  for (const int dof : contact_.elimination.kept()) left[dof] = reactions[dof] = 0.0;
  result.largest = largest_component(is_secant() ? left : reactions);
  for (const int dof : eliminated_) left[dof] = 0.0;
  result.counted = largest_component(left);
  return result;
}

Eigen::VectorXd MixedContact::forces() const {
  if (secants_.predicts()) return contact_.elimination.transformation().transpose() * secants_.solved();
  return contact_.rows.reduced().transpose() * contact_.forces;
}

Eigen::VectorXd MixedContact::forces_left_out() const {
  if (!is_secant() || secants_.predicts()) return Eigen::VectorXd::Zero(contact_.elimination.reduced_size());
  return contact_.rows.reduced().transpose() * (contact_.forces - secants_.held());
}

void MixedContact::update_compliance() {
  if (!compliance_.update()) return;
  near_inverse_ = {};
  interpolated_solver_ = {};
}

int MixedContact::correct(const Eigen::VectorXd& before, const Eigen::VectorXd& offset, Eigen::VectorXd& corrected) {
  if (secants_.predicts()) {
    secants_.end_prediction();
    // Nothing is known of a body that contact alone is to hold before it does.
    if (tangent_.springs().empty() && !tangent_.is_indefinite()) return 0;
    iterate(Iterations::settled);
  }
  update_compliance();
  // One step a time, statuses depend on the augmentation, and so does whether the iterations converge: it is the
  // user's.
  if (!is_linear()) augmentations_.apply();
  const std::vector<ContactStatus> statuses = contact_.state.statuses;
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(compliance_.schur().size());
  forces.head(contact_.forces.size()) = is_secant() ? secants_.held() : contact_.forces;
  settle_in_rounds(compliance_.schur(), tangent_.negligible_rest(),
                   [&] { return settle(before, offset, forces, corrected); });
  contact_.forces = forces.head(contact_.forces.size());
  const auto& transformation = contact_.elimination.transformation();
  if (is_secant()) secants_.note_solved(transformation * before + offset, transformation * corrected + offset);
  if (is_rubbing()) rubbing_.note_solved();
  int changes = 0;
  for (std::size_t p = 0; p < statuses.size(); ++p) changes += statuses[p] != contact_.state.statuses[p];
  return changes;
}

/// Jumps begin as they were before the loads of this iteration were applied: bodies that contact alone holds are taken
/// far by these, and the law of friction is not linear on the way back.
void MixedContact::begin_near(const Eigen::VectorXd& before, const Eigen::VectorXd& offset) {
  contact_.problem.begin.resize(0);
  if (contact_.problem.components == 1) return;
  const Eigen::VectorXd now = contact_.jumps(contact_.elimination.transformation() * before + offset);
  contact_.problem.begin = Eigen::VectorXd::Zero(contact_.problem.free.size());
  contact_.problem.begin.head(now.size()) = now;
  if (!is_secant()) return;
  // Linear laws are found from anywhere, and to most digits from where a stiff penalty gives the forces at hand.
  for (const CondensedPoint& point : contact_.problem.points)
    if (point.rows > 0)
      contact_.problem.begin[point.first_row] =
          -contact_.problem.held[point.first_row] / (point.weight * point.law.penalty());
}

/// The largest that gaps are differences of.
double MixedContact::displacement_of_surfaces(const Eigen::VectorXd& u) const {
  const Eigen::VectorXd magnitudes = tangent_.magnitudes(u);
  double largest = 0.0;
  for (int row = 0; row < contact_.rows.full().outerSize(); ++row)
    for (RowMatrix::InnerIterator it(contact_.rows.full(), row); it; ++it)
      largest = std::max(largest, magnitudes[it.col()]);
  return largest;
}

/// Solves the law of contact with the compliance at hand and moves the bodies. By how much forces on the rows change,
/// as a share of the largest; nothing where a compliance that is not exact finds no solution.
std::optional<double> MixedContact::settle(const Eigen::VectorXd& before, const Eigen::VectorXd& offset,
                                           Eigen::VectorXd& forces, Eigen::VectorXd& corrected) {
  const Eigen::VectorXd u = contact_.elimination.transformation() * corrected + offset;
  const Eigen::VectorXd free = contact_.jumps(u);
  contact_.problem.displacement = displacement_of_surfaces(u);
  check_blocked_points(free);
  const Index point_rows = contact_.rows.full().rows();
  contact_.problem.held = forces;
  contact_.problem.free.resize(compliance_.schur().size());
  contact_.problem.free.head(point_rows) = free;
  for (std::size_t k = 0; k < tangent_.springs().size(); ++k) {
    const int unknown = tangent_.springs()[k].first;
    contact_.problem.free[point_rows + static_cast<Index>(k)] = corrected[unknown] - before[unknown];
  }
  begin_near(before, offset);
  contact_.problem.indefinite = tangent_.is_indefinite();
  contact_.problem.farthest = contact_.problem.springs.empty() ? std::numeric_limits<double>::infinity()
                                                               : farthest_motion * extent(contact_.mesh);
  if (!contact_.problem.springs.empty() || contact_.problem.indefinite) close_nearest(free);

  const CondensedState earlier = contact_.state;
  const CondensedSolution solution = solve_law();
  counters_.contact_iterations += solution.iterations;
  contact_.problem.expected.resize(0);
  rubs_by_shears_ = solution.by_shears;
  if (solution.verdict == CondensedVerdict::too_many_iterations) {
    if (compliance_.schur().is_exact()) {
      const bool negative =
          std::ranges::any_of(contact_.problem.points, [](const CondensedPoint& point) { return point.weight < 0.0; });
      throw_condensed_limit(contact_.problem.max_iterations, contact_.definition, negative, tangent_.unheld());
    }
    contact_.state = earlier;
    return std::nullopt;
  }
  const Eigen::VectorXd change = solution.forces - forces;
  const double most = largest_component(change);
  if (most > 0.0) {
    Eigen::MatrixXd push = compliance_.schur().rows().transpose() * change;
    tangent_.solve_correction(push, u);
    corrected += push;
  }
  forces = solution.forces;
  const double size = largest_component(forces);
  return size > 0.0 ? most / size : most;
}

/// With the augmentations given; where there is no solution, with softer ones.
CondensedSolution MixedContact::solve_law() {
  SchurComplement& schur = compliance_.schur();
  if (is_rubbing()) return rubbing_.solve(schur);
  const CondensedState earlier = contact_.state;
  CondensedSolution solution = solve_condensed(schur, contact_.problem, contact_.state);
  while (solution.verdict == CondensedVerdict::too_many_iterations && schur.is_exact() && augmentations_.lower()) {
    contact_.state = earlier;
    const int iterations = solution.iterations;
    solution = solve_condensed(schur, contact_.problem, contact_.state);
    solution.iterations += iterations;
  }
  if (solution.verdict == CondensedVerdict::too_many_iterations && schur.is_exact() && penalties_.open_by_gaps()) {
    contact_.state = earlier;
    solution = solve_condensed(schur, contact_.problem, contact_.state);
  }
  return solution;
}

bool MixedContact::adapt_penalties(const Eigen::VectorXd& u) {
  const auto without_contact = [&]() -> Eigen::VectorXd {
    // What contact alone holds would lie infinitely deep.
    if (!tangent_.springs().empty()) return {};
    return contact_.jumps(u) - compliance_.pushed_by(contact_.forces);
  };
  return penalties_.adapt(u, without_contact, [&] { return tangent_.largest_term(u); });
}

double MixedContact::penetration(const Eigen::VectorXd& u, bool of_penalties) const {
  const Eigen::VectorXd now = contact_.jumps(u);
  double deepest = 0.0;
  for (std::size_t p = 0; p < points().size(); ++p)
    if (contact_.problem.points[p].rows > 0 && !contact_.is_free_of_force(p) &&
        (contact_.problem.points[p].law.penalised || !of_penalties))
      deepest = std::max(deepest, -now[contact_.problem.points[p].first_row]);
  return deepest;
}

void MixedContact::note_doubts(const Eigen::VectorXd& u, ContactDoubts& doubts) {
  const ContactResponse response{[this](const Eigen::VectorXd& forces) { return compliance_.pushed_by(forces); },
                                 [this, &u] { return pushed_back(u); },
                                 penalties_.raised(),
                                 rubs_by_shears_,
                                 augmentations_.are_lowered(),
                                 penalties_.opens_by_gaps()};
  comma::solver::note_doubts(solved(u), response, doubts);
  for (const ContactDoubt& doubt : bridged_) doubts.note(doubt);
  if (is_rubbing()) rubbing_.note_doubts(doubts);
}

void MixedContact::note_loose_bodies(const Eigen::VectorXd& u, ContactDoubts& doubts) const {
  if (tangent_.springs().empty() || contact_.rows.reduced().rows() == 0) return;
  const RowMatrix held = closed_rows(solved(u));
  doubts.note_loose(tangent_.unheld_beside(held));
}

std::vector<double> MixedContact::pushed_back(const Eigen::VectorXd& u) {
  if (!compliance_.is_known()) return std::vector<double>(contact_.definition.zones.size(), 0.0);
  return comma::solver::pushed_back(solved(u),
                                    [this](const Eigen::VectorXd& forces) { return compliance_.pushed_by(forces); });
}

}  // namespace comma::solver
