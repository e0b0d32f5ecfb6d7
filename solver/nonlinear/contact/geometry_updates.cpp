#include "solver/nonlinear/contact/geometry_updates.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/model/deformed_places.hpp"

namespace comma::solver {
namespace {

using Eigen::Vector3d;

/// Pairings that return within this many updates are in a cycle.
constexpr std::size_t cycle_length_limit = 4;
/// Updates in which the geometry should come twice as near to rest.
constexpr std::size_t patience = 10;
/// After this many updates they are relaxed where the last one moves the geometry by more than half of any before, and
/// points keep their facets within a margin: within the widest one after `updates_to_widest`, and a hundredth less in
/// each before. That leaves `updates_at_widest` at least to settle.
constexpr int free_updates = 5;
constexpr int updates_to_widest = 11;
constexpr int updates_at_widest = 3;
constexpr double widest_margin = 0.05;
/// A margin beyond which points that were kept are told of.
constexpr double telling_margin = 1e-3;
/// Of a correction of the geometry at least this share is made.
constexpr double least_relaxation = 0.05;
/// Of the displacement of a step: what solutions may differ by from one update to the next although nothing has moved.
constexpr double rounding_of_solutions = 1e-10;
/// Updates are accelerated where less than this is tolerated and the last one moved less than that, by this share of
/// the one before at most; so many moves are combined.
constexpr double accelerated_tolerance = 1e-8;
constexpr double accelerated_change = 1e-2;
constexpr double nearing_share = 0.9;
constexpr std::size_t accelerated_moves = 3;
/// Displacements of a step below this share of the whole ones are rounding.
constexpr double negligible_displacement = 1e-11;

bool same_facets(const std::vector<ContactPair>& a, const std::vector<ContactPair>& b) {
  return std::ranges::equal(a, b, [](const ContactPair& one, const ContactPair& other) {
    return one.facet == other.facet && one.status == other.status;
  });
}

}  // namespace

GeometryChange geometry_change(const Mesh& mesh, const DofMap& dofs, const Eigen::VectorXd& start,
                               const Eigen::VectorXd& paired, const Eigen::VectorXd& now) {
  GeometryChange change;
  double moved = 0.0;
  double largest = 0.0, largest_before = 0.0;
  double whole = 0.0;
  double reach = 0.0;
  for (int node = 0; node < mesh.node_count(); ++node) {
    const Vector3d at = displacement_of(node, now, dofs);
    const Vector3d before = displacement_of(node, paired, dofs), at_start = displacement_of(node, start, dofs);
    const double here = (at - before).norm();
    if (here > moved) change.worst = node;
    moved = std::max(moved, here);
    whole = std::max(whole, at.norm());
    for (const double coordinate : mesh.nodes[static_cast<std::size_t>(node)])
      reach = std::max(reach, std::abs(coordinate));
    largest = std::max(largest, (at - at_start).norm());
    largest_before = std::max(largest_before, (before - at_start).norm());
  }
  // Nothing is asked of a step that only rounding moves, of displacements or of places.
  const double rounding = std::max(negligible_displacement * whole, std::numeric_limits<double>::epsilon() * reach);
  if (moved > rounding) change.share = moved / (largest_before > rounding ? largest_before : largest);
  return change;
}

GeometryUpdates::GeometryUpdates(const ContactDefinition& contact, const Mesh& mesh, const DofMap& dofs,
                                 const Eigen::VectorXd& start)
    : contact_(contact), mesh_(mesh), dofs_(dofs), start_(start) {}

bool GeometryUpdates::settled(const Eigen::VectorXd& paired, const Eigen::VectorXd& now) {
  const GeometryChange change = geometry_change(mesh_, dofs_, start_, paired, now);
  if (change.worst >= 0) worst_ = change.worst;
  history_.changes.push_back(change.share);
  if (worst_ >= 0) history_.worst = mesh_.node_name(worst_);
  if (contact_.geometry_update == GeometryUpdate::controlled)
    return static_cast<int>(history_.changes.size()) >= std::max(1, contact_.controlled_updates);
  if (history_.changes.back() <= contact_.geometry_tolerance || only_rounding_moves()) return true;
  if (!goes_to_and_fro()) return false;
  restless_ = history_.changes.back();
  return true;
}

double GeometryUpdates::margin() const { return margin_of(static_cast<int>(history_.changes.size())); }

double GeometryUpdates::margin_of(int done) const {
  if (contact_.geometry_update != GeometryUpdate::automatic || done < free_updates) return 0.0;
  const int to_go = std::min(updates_to_widest, contact_.max_geometry_updates - updates_at_widest) - done;
  return widest_margin * std::pow(100.0, -std::max(0, to_go));
}

Eigen::VectorXd GeometryUpdates::relaxed(const Eigen::VectorXd& paired, const Eigen::VectorXd& now) {
  const auto& changes = history_.changes;
  if (contact_.geometry_update != GeometryUpdate::automatic || changes.empty()) return now;
  if (auto combined = accelerated(paired, now)) {
    last_move_ = now - paired;
    return *std::move(combined);
  }
  Eigen::VectorXd move = now - paired;
  const Eigen::VectorXd turn = last_move_.size() ? Eigen::VectorXd(move - last_move_) : Eigen::VectorXd();
  const bool nears = static_cast<int>(changes.size()) < free_updates ||
                     changes.back() < 0.5 * *std::min_element(changes.begin(), changes.end() - 1);
  if (!nears && turn.squaredNorm() > 0.0)
    relaxation_ = std::clamp(-relaxation_ * last_move_.dot(turn) / turn.squaredNorm(), least_relaxation, 1.0);
  last_move_ = std::move(move);
  return relaxation_ < 1.0 ? Eigen::VectorXd(paired + relaxation_ * last_move_) : now;
}

/// Where updates that hardly move anything no longer come nearer to rest what is left is the rounding of solutions.
bool GeometryUpdates::only_rounding_moves() const {
  const auto& changes = history_.changes;
  if (changes.size() < 3) return false;
  const double before = *std::min_element(changes.begin(), changes.end() - 1);
  return changes.back() <= rounding_of_solutions && changes.back() > 0.5 * before;
}

/// Anderson's acceleration (Walker and Ni, SIAM Journal on Numerical Analysis 49, 2011) of updates that come nearer to
/// rest, each by about as much, where many digits are wanted: the combination of the last moves that is the least.
std::optional<Eigen::VectorXd> GeometryUpdates::accelerated(const Eigen::VectorXd& paired, const Eigen::VectorXd& now) {
  const auto& changes = history_.changes;
  const bool nears = changes.size() > 1 && changes.back() < nearing_share * *(changes.end() - 2);
  if (contact_.geometry_tolerance > accelerated_tolerance || changes.back() > accelerated_change || !nears) {
    earlier_.clear();
    return std::nullopt;
  }
  earlier_.emplace_back(paired, now);
  if (earlier_.size() > accelerated_moves + 1) earlier_.pop_front();
  const auto count = static_cast<Eigen::Index>(earlier_.size()) - 1;
  if (count == 0) return std::nullopt;
  Eigen::MatrixXd moves(paired.size(), count), places(paired.size(), count);
  const Eigen::VectorXd move = now - paired;
  for (Eigen::Index k = 0; k < count; ++k) {
    const auto& [from, to] = earlier_[static_cast<std::size_t>(k)];
    places.col(k) = now - to;
    moves.col(k) = move - (to - from);
  }
  return now - places * moves.colPivHouseholderQr().solve(move).eval();
}

bool GeometryUpdates::goes_to_and_fro() const {
  const auto& changes = history_.changes;
  if (!(contact_.restless_tolerance > 0.0) || changes.size() < 2 * patience) return false;
  const auto recent = changes.end() - static_cast<std::ptrdiff_t>(patience);
  const auto [least, most] = std::minmax_element(recent, changes.end());
  return *most <= contact_.restless_tolerance && *least > 0.5 * *std::min_element(changes.begin(), recent);
}

void GeometryUpdates::note_doubts(const std::vector<ContactPair>& pairs, const std::vector<ContactPoint>& points,
                                  ContactDoubts& doubts) const {
  if (restless_ > std::sqrt(contact_.geometry_tolerance))
    doubts.note({.kind = DoubtKind::restless_geometry, .share = restless_, .node = worst_});
  const double margin = margin_of(static_cast<int>(history_.changes.size()) - 1);
  if (margin < telling_margin) return;
  const auto note = [&](int zone, int node) {
    doubts.note({.kind = DoubtKind::kept_facet, .zone = zone, .share = margin, .node = node});
  };
  for (const ContactPair& pair : pairs)
    if (pair.kept) note(pair.zone, pair.slave);
  for (const ContactPoint& point : points)
    if (point.kept) note(point.zone, point.node >= 0 ? point.node : mesh_.cell(point.cell)[0]);
}

void GeometryUpdates::note_cycle(const std::vector<ContactPair>& pairs) {
  const std::size_t count = visited_.size();
  history_.cycles = false;
  for (std::size_t back = 2; back <= std::min(cycle_length_limit, count); ++back)
    history_.cycles |= same_facets(visited_[count - back], pairs) && !same_facets(visited_[count - 1], pairs);
  visited_.push_back(pairs);
}

void GeometryUpdates::require_more(double time) const {
  if (contact_.geometry_update != GeometryUpdate::automatic ||
      static_cast<int>(history_.changes.size()) < std::max(1, contact_.max_geometry_updates))
    return;
  throw_geometry_failure(time, history_, contact_);
}

}  // namespace comma::solver
