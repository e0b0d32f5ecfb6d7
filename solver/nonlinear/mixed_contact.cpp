#include "solver/nonlinear/mixed_contact.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "solver/contact/extent.hpp"
#include "solver/error.hpp"
#include "solver/linear/largest_component.hpp"
#include "solver/model/deformed_places.hpp"
#include "solver/nonlinear/contact_doubts.hpp"
#include "solver/nonlinear/failure.hpp"
#include "solver/nonlinear/geometry_updates.hpp"
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
    : definition_(definition),
      mesh_(*model.mesh),
      dofs_(dofs),
      elimination_(elimination),
      tangent_(tangent),
      counters_(counters),
      support_(std::move(support)),
      rows_(definition, model, dofs, elimination),
      penalties_(definition.zones.size()),
      reference_(Eigen::VectorXd::Zero(dofs.size())) {
  problem_.smooth = rows_.smooth();
  problem_.node_count = static_cast<int>(rows_.smooth().size());
  problem_.components = has_friction(definition_) ? rows_.dimension() : 1;
  problem_.max_iterations = most_condensed_iterations;
  problem_.memory = &memory_;
  problem_.near_inverse = &near_inverse_;
  problem_.interpolated_solver = &interpolated_solver_;
  problem_.share_search = &share_search_;
  state_.multipliers = Eigen::VectorXd::Zero(problem_.node_count * problem_.components);
  rates_ = start_ = state_.multipliers;
}

void MixedContact::pair(Positions positions, double time, double margin) {
  if (is_secant() && secants_.linearisations > 0)
    next_geometry_ = {{positions.begin(), positions.end()}, time, margin};
  else
    face(positions, time, margin);
}

void MixedContact::face(Positions positions, double time, double margin) {
  const std::vector<Vector3d> held = is_secant() ? forces_of_points(secants_.held) : std::vector<Vector3d>();
  rows_.face(positions, time, margin);
  ++counters_.pairings;
  problem_.points = rows_.build(reference_);
  adapted_.face(definition_, points(), mesh_);
  apply_penalties();
  share_friction();
  if (!started_) start_statuses(jumps(reference_));
  if (!started_ || (!step_begins_ && !definition_.joint_iterations)) began_closed_ = closed_points();
  started_ = true;
  hold_points();
  if (secants_.predicts) begin_secants();
  secants_.held = forces_on_rows(held);
  hold_back_points();
  for (std::size_t p = 0; p < points().size(); ++p)
    if (problem_.points[p].rows == 0) state_.statuses[p] = ContactStatus::open;
  close_slides();
  start_forces(time);
}

/// Friction in the mixed formulation has shares of its limit for multipliers. Where all points that rub on a multiplier
/// lie on its node, and no penalty lets them creep, the solution is that of shears, which need no scale.
void MixedContact::share_friction() {
  if (definition_.formulation != ContactFormulation::mixed || problem_.components == 1) return;
  const std::vector<char> shared = shared_multipliers(problem_);
  for (std::size_t p = 0; p < points().size(); ++p) {
    CondensedPoint& point = problem_.points[p];
    if (!(point.law.friction > 0.0) || point.node_count == 0) continue;
    const MixedZone& mixed = definition_.zones[static_cast<std::size_t>(points()[p].zone)].mixed;
    if (point.law.friction_penalised)
      point.share_augmentation = point.law.friction_augmentation;
    else if (shared[static_cast<std::size_t>(point.nodes[0])])
      point.share_augmentation = mixed.friction_augmentation;
  }
}

bool MixedContact::is_faced_again() const {
  if (definition_.geometry_update == GeometryUpdate::controlled) return definition_.controlled_updates > 1;
  return definition_.geometry_update == GeometryUpdate::automatic && definition_.max_geometry_updates > 1;
}

/// Code_Aster 17.3, in scenes of two blocks: Newton's method on contact holds what is closed once none changes.
void MixedContact::hold_points() {
  if (!definition_.contact_by_newton) return;
  for (std::size_t p = 0; p < points().size(); ++p)
    problem_.points[p].bilateral =
        definition_.zones[static_cast<std::size_t>(points()[p].zone)].mixed.bilateral && began_closed_[p] != 0;
}

/// What never opens again does not close on a surface as it lay before the step: points of bilateral zones wait for the
/// next geometry (the mixed formulation alone; ssnv104e tells). A body that touches nothing yet must not pass through
/// the other.
void MixedContact::hold_back_points() {
  held_back_.clear();
  const bool waits =
      step_begins_ && is_faced_again() && definition_.formulation == ContactFormulation::mixed && closed_count() > 0;
  step_begins_ = false;
  for (std::size_t p = 0; p < points().size() && waits; ++p) {
    CondensedPoint& point = problem_.points[p];
    if (!point.bilateral || point.rows == 0 || state_.statuses[p] != ContactStatus::open) continue;
    point.rows = 0;
    held_back_.push_back(p);
  }
}

bool MixedContact::leaves_overlap(const Eigen::VectorXd& u) const {
  if (held_back_.empty()) return false;
  const Eigen::VectorXd now = jumps(u);
  return std::ranges::any_of(held_back_, [&](std::size_t p) {
    return now[problem_.points[p].first_row] < -overlap_tolerance * extent(mesh_, points()[p].cell);
  });
}

void MixedContact::check_blocked_points(const Eigen::VectorXd& jumps) const {
  for (const std::size_t p : rows_.blocked()) {
    const double gap = jumps[problem_.points[p].first_row];
    if (definition_.zones[static_cast<std::size_t>(points()[p].zone)].mixed.penalised) continue;
    if (gap >= -overlap_tolerance * extent(mesh_, points()[p].cell)) continue;
    throw Error("contradictory-conditions",
                fmt::format("imposed displacements push slave face {} into facet {} by {:.6g}",
                            mesh_.cell_name(points()[p].cell), mesh_.cell_name(points()[p].facet), -gap),
                "free the nodes along the normal, or take them out of the contact (SANS_GROUP_NO)");
  }
}

void MixedContact::start_statuses(const Eigen::VectorXd& jumps) {
  state_.statuses.assign(points().size(), ContactStatus::open);
  const std::vector<char> held = held_points();
  for (std::size_t p = 0; p < points().size(); ++p) {
    const CondensedPoint& point = problem_.points[p];
    if (point.rows == 0) continue;
    const MixedZone& zone = definition_.zones[static_cast<std::size_t>(points()[p].zone)].mixed;
    const bool touches = jumps[point.first_row] <= touching * extent(mesh_, points()[p].cell);
    if (held[p] != 0 || zone.initial == InitialContact::all ||
        (zone.initial == InitialContact::interpenetrating && touches))
      state_.statuses[p] = closed(point.law);
  }
}

/// GLISSIERE of the discrete formulation is a condition on all points that face the master.
void MixedContact::close_slides() {
  if (definition_.formulation != ContactFormulation::discrete) return;
  const Eigen::VectorXd now = jumps(reference_);
  for (std::size_t p = 0; p < points().size(); ++p) {
    const CondensedPoint& point = problem_.points[p];
    const MixedZone& zone = definition_.zones[static_cast<std::size_t>(points()[p].zone)].mixed;
    if (!zone.bilateral || point.rows == 0 || state_.statuses[p] != ContactStatus::open) continue;
    state_.statuses[p] = closed(point.law);
    const double gap = now[point.first_row];
    if (gap > std::max(zone.unnoticed_gap, touching * extent(mesh_, points()[p].cell)))
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
    if (state_.statuses[p] != ContactStatus::open) return;
    if (problem_.points[p].rows > 0) nearest = std::min(nearest, jumps[problem_.points[p].first_row]);
  }
  for (std::size_t p = 0; p < points().size(); ++p) {
    const CondensedPoint& point = problem_.points[p];
    if (point.rows > 0 && jumps[point.first_row] <= nearest + touching * extent(mesh_, points()[p].cell))
      state_.statuses[p] = closed(point.law);
  }
}

Eigen::VectorXd MixedContact::forces() const {
  if (secants_.predicts) return elimination_.transformation().transpose() * secants_.solved;
  return rows_.reduced().transpose() * forces_;
}

/// Points come in the same order at every pairing.
std::vector<int> MixedContact::row_keys() const {
  std::vector<int> keys(static_cast<std::size_t>(rows_.full().rows()));
  for (std::size_t p = 0; p < problem_.points.size(); ++p) {
    const CondensedPoint& point = problem_.points[p];
    for (int c = 0; c < point.components && point.first_row >= 0; ++c)
      keys[static_cast<std::size_t>(point.first_row + c)] = 3 * static_cast<int>(p) + c;
  }
  return keys;
}

/// The rows of the points and those of the springs.
void MixedContact::update_schur() {
  const auto& springs = tangent_.springs();
  std::vector<Eigen::Triplet<double>> entries;
  for (int row = 0; row < rows_.reduced().outerSize(); ++row)
    for (RowMatrix::InnerIterator it(rows_.reduced(), row); it; ++it)
      entries.emplace_back(row, static_cast<int>(it.col()), it.value());
  int next = static_cast<int>(rows_.reduced().rows());
  std::vector<int> keys = row_keys();
  problem_.springs.clear();
  for (const auto& [unknown, stiffness] : springs) {
    keys.push_back(-1 - unknown);
    entries.emplace_back(next, unknown, 1.0);
    problem_.springs.push_back({next++, stiffness});
  }
  RowMatrix rows(next, elimination_.reduced_size());
  rows.setFromTriplets(entries.begin(), entries.end());
  if (!schur_ || spring_count_ != springs.size()) {
    std::set<int> support(support_.begin(), support_.end());
    for (const auto& spring : springs) support.insert(spring.first);
    schur_ = std::make_unique<SchurComplement>(
        std::move(rows), [this](Eigen::Ref<Eigen::MatrixXd> columns) { tangent_.solve_once(columns); },
        std::vector<int>(support.begin(), support.end()), std::move(keys));
    schur_->use_whole([this](const RowMatrix& all) { return tangent_.compliance(all); });
    spring_count_ = springs.size();
    near_inverse_ = {};
    interpolated_solver_ = {};
  } else {
    schur_->replace_rows(std::move(rows), std::move(keys));
  }
}

void MixedContact::forget() {
  if (schur_) schur_->forget();
}

int MixedContact::correct(const Eigen::VectorXd& before, const Eigen::VectorXd& offset, Eigen::VectorXd& corrected) {
  if (secants_.predicts && !can_predict()) {
    secants_.predicts = false;
    iterate(Iterations::settled);
  }
  if (std::exchange(secants_.predicts, false)) return 0;
  update_schur();
  // One step a time, statuses depend on the augmentation, and so does whether the iterations converge: it is the
  // user's.
  if (!is_linear()) add_natural_augmentation();
  const std::vector<ContactStatus> statuses = state_.statuses;
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(schur_->size());
  forces.head(forces_.size()) = is_secant() ? secants_.held : forces_;
  settle_in_rounds(*schur_, tangent_.negligible_rest(), [&] { return settle(before, offset, forces, corrected); });
  forces_ = forces.head(forces_.size());
  if (is_secant())
    note_solved(elimination_.transformation() * before + offset, elimination_.transformation() * corrected + offset);
  if (is_rubbing()) rubbing_.solved = rows_.full().transpose() * forces_;
  int changes = 0;
  for (std::size_t p = 0; p < statuses.size(); ++p) changes += statuses[p] != state_.statuses[p];
  return changes;
}

/// Jumps begin as they were before the loads of this iteration were applied: bodies that contact alone holds are taken
/// far by these, and the law of friction is not linear on the way back.
void MixedContact::begin_near(const Eigen::VectorXd& before, const Eigen::VectorXd& offset) {
  problem_.begin.resize(0);
  if (problem_.components == 1) return;
  const Eigen::VectorXd now = jumps(elimination_.transformation() * before + offset);
  problem_.begin = Eigen::VectorXd::Zero(problem_.free.size());
  problem_.begin.head(now.size()) = now;
  if (!is_secant()) return;
  // Linear laws are found from anywhere, and to most digits from where a stiff penalty gives the forces at hand.
  for (const CondensedPoint& point : problem_.points)
    if (point.rows > 0)
      problem_.begin[point.first_row] = -problem_.held[point.first_row] / (point.weight * point.law.penalty());
}

/// The largest that gaps are differences of.
double MixedContact::displacement_of_surfaces(const Eigen::VectorXd& u) const {
  const Eigen::VectorXd magnitudes = tangent_.magnitudes(u);
  double largest = 0.0;
  for (int row = 0; row < rows_.full().outerSize(); ++row)
    for (RowMatrix::InnerIterator it(rows_.full(), row); it; ++it) largest = std::max(largest, magnitudes[it.col()]);
  return largest;
}

/// Solves the law of contact with the compliance at hand and moves the bodies. By how much forces on the rows change,
/// as a share of the largest; nothing where a compliance that is not exact finds no solution.
std::optional<double> MixedContact::settle(const Eigen::VectorXd& before, const Eigen::VectorXd& offset,
                                           Eigen::VectorXd& forces, Eigen::VectorXd& corrected) {
  const Eigen::VectorXd u = elimination_.transformation() * corrected + offset;
  const Eigen::VectorXd free = jumps(u);
  problem_.displacement = displacement_of_surfaces(u);
  check_blocked_points(free);
  const Index point_rows = rows_.full().rows();
  problem_.held = forces;
  problem_.free.resize(schur_->size());
  problem_.free.head(point_rows) = free;
  for (std::size_t k = 0; k < tangent_.springs().size(); ++k) {
    const int unknown = tangent_.springs()[k].first;
    problem_.free[point_rows + static_cast<Index>(k)] = corrected[unknown] - before[unknown];
  }
  begin_near(before, offset);
  problem_.indefinite = tangent_.is_indefinite();
  problem_.farthest =
      problem_.springs.empty() ? std::numeric_limits<double>::infinity() : farthest_motion * extent(mesh_);
  if (!problem_.springs.empty() || problem_.indefinite) close_nearest(free);

  const CondensedState earlier = state_;
  const CondensedSolution solution = solve_law();
  counters_.contact_iterations += solution.iterations;
  problem_.expected.resize(0);
  rubs_by_shears_ = solution.by_shears;
  if (solution.verdict == CondensedVerdict::too_many_iterations) {
    if (schur_->is_exact()) {
      const bool negative =
          std::ranges::any_of(problem_.points, [](const CondensedPoint& point) { return point.weight < 0.0; });
      throw_condensed_limit(problem_.max_iterations, definition_, negative, tangent_.unheld());
    }
    state_ = earlier;
    return std::nullopt;
  }
  const Eigen::VectorXd change = solution.forces - forces;
  const double most = largest_component(change);
  if (most > 0.0) {
    Eigen::MatrixXd push = schur_->rows().transpose() * change;
    tangent_.solve_correction(push, u);
    corrected += push;
  }
  forces = solution.forces;
  const double size = largest_component(forces);
  return size > 0.0 ? most / size : most;
}

bool MixedContact::stiffen_penalties(const Eigen::VectorXd& u) {
  const Eigen::VectorXd now = jumps(u);
  const std::size_t zones = definition_.zones.size();
  Excess excess{std::vector<double>(zones, 0.0), std::vector<double>(zones, 0.0), std::vector<double>(zones, 1.0)};
  for (std::size_t p = 0; p < points().size(); ++p) {
    const auto zone = static_cast<std::size_t>(points()[p].zone);
    const MixedZone& mixed = definition_.zones[zone].mixed;
    const CondensedPoint& point = problem_.points[p];
    if (point.rows == 0 || is_free_of_force(points()[p], problem_.points[p])) continue;
    const std::optional<double> deepest = penalties_.allowed_depth();
    const double given = std::min(mixed.penalised ? mixed.augmentation : mixed.friction_penalty,
                                  mixed.friction_penalised ? mixed.friction_penalty : mixed.augmentation);
    excess.softness[zone] =
        std::max(excess.softness[zone], (points()[p].node >= 0 ? stiffness_at(p) : resistance_at(p)) / given);
    if (mixed.penalised && deepest) excess.depth[zone] = std::max(excess.depth[zone], -now[point.first_row] / *deepest);
    if (mixed.friction_penalised && mixed.largest_slip && state_.statuses[p] == ContactStatus::sticking)
      excess.slip[zone] = std::max(excess.slip[zone], slip_of(point, now) / *mixed.largest_slip);
  }
  if (!penalties_.raise(excess)) return false;
  apply_penalties();
  return true;
}

/// A depth that an event of the step limits stands for all others.
bool MixedContact::adapts(std::size_t zone) const {
  return definition_.zones[zone].mixed.adapts_penalty && !penalties_.allowed_depth();
}

bool MixedContact::adapt_penalties(const Eigen::VectorXd& u) {
  std::vector<char> zones;
  for (std::size_t zone = 0; zone < definition_.zones.size(); ++zone) zones.push_back(adapts(zone) ? 1 : 0);
  if (std::ranges::find(zones, 1) == zones.end()) return false;
  const Eigen::VectorXd now = jumps(u);
  const auto depths = [&](const Eigen::VectorXd& gaps) {
    std::vector<double> result(points().size(), -std::numeric_limits<double>::infinity());
    for (std::size_t p = 0; p < points().size(); ++p)
      if (problem_.points[p].rows > 0 && !is_free_of_force(points()[p], problem_.points[p]))
        result[p] = -gaps[problem_.points[p].first_row];
    return result;
  };
  const std::vector<double> present = depths(now);
  const bool is_deep = adapted_.is_too_deep(zones, present);
  // What contact alone holds would lie infinitely deep.
  if (is_deep && !began_adapted() && tangent_.springs().empty()) adapted_.note_depths(depths(now - pushed_by(forces_)));
  if (!adapted_.adapt(zones, present, is_deep ? tangent_.largest_term(u) : 0.0, !definition_.contact_by_newton))
    return false;
  apply_penalties();
  return true;
}

void MixedContact::apply_penalties() {
  for (std::size_t p = 0; p < points().size(); ++p) {
    const auto zone = static_cast<std::size_t>(points()[p].zone);
    penalties_.apply(definition_.zones[zone].mixed, points()[p].zone, problem_.points[p]);
    if (adapts(zone)) problem_.points[p].law.augmentation = adapted_.penalty(p);
    problem_.points[p].law.opens_by_gap = opens_by_gaps_;
  }
}

bool MixedContact::has_penalties() const {
  return std::ranges::any_of(definition_.zones, [](const ContactZone& zone) { return zone.mixed.penalised; });
}

std::vector<char> MixedContact::closed_points() const {
  std::vector<char> closed;
  for (const ContactStatus status : state_.statuses) closed.push_back(status != ContactStatus::open);
  return closed;
}

int MixedContact::closed_count() const {
  return static_cast<int>(
      std::ranges::count_if(state_.statuses, [](ContactStatus each) { return each != ContactStatus::open; }));
}

double MixedContact::penetration(const Eigen::VectorXd& u, bool of_penalties) const {
  const Eigen::VectorXd now = jumps(u);
  double deepest = 0.0;
  for (std::size_t p = 0; p < points().size(); ++p)
    if (problem_.points[p].rows > 0 && !is_free_of_force(points()[p], problem_.points[p]) &&
        (problem_.points[p].law.penalised || !of_penalties))
      deepest = std::max(deepest, -now[problem_.points[p].first_row]);
  return deepest;
}

SolvedContact MixedContact::solved(const Eigen::VectorXd& u) const {
  return {definition_, mesh_, dofs_, rows_, problem_, state_, forces_, u, jumps(u)};
}

void MixedContact::note_doubts(const Eigen::VectorXd& u, ContactDoubts& doubts) {
  const ContactResponse response{[this](const Eigen::VectorXd& forces) { return pushed_by(forces); },
                                 [this, &u] { return pushed_back(u); },
                                 penalties_,
                                 rubs_by_shears_,
                                 augmentation_share_ < 1.0,
                                 opens_by_gaps_};
  comma::solver::note_doubts(solved(u), response, doubts);
  for (const ContactDoubt& doubt : bridged_) doubts.note(doubt);
  note_coarse_friction(doubts);
}

void MixedContact::note_loose_bodies(const Eigen::VectorXd& u, ContactDoubts& doubts) const {
  if (tangent_.springs().empty() || rows_.reduced().rows() == 0) return;
  const RowMatrix held = closed_rows(solved(u));
  doubts.note_loose(tangent_.unheld_beside(held));
}

std::vector<double> MixedContact::pushed_back(const Eigen::VectorXd& u) {
  if (!schur_) return std::vector<double>(definition_.zones.size(), 0.0);
  return comma::solver::pushed_back(solved(u), [this](const Eigen::VectorXd& forces) { return pushed_by(forces); });
}

Eigen::VectorXd MixedContact::pushed_by(const Eigen::VectorXd& contact_forces) {
  if (!schur_) {
    Eigen::MatrixXd push = rows_.reduced().transpose() * contact_forces;
    tangent_.solve_once(push);
    return rows_.reduced() * push;
  }
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(schur_->size());
  forces.head(contact_forces.size()) = contact_forces;
  return schur_->times(forces).head(contact_forces.size());
}

}  // namespace comma::solver
