// The part of MixedContact that looks back on a converged step.
#include <algorithm>
#include <cmath>

#include "solver/contact/extent.hpp"
#include "solver/linear/largest_component.hpp"
#include "solver/nonlinear/mixed_contact.hpp"

namespace comma::solver {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

/// Slips below this share of the largest displacement are no slips.
constexpr double negligible_slip = 1e-6;
/// Imposed displacements may overlap by this share of the face's size.
constexpr double overlap_share = 1e-9;

}  // namespace

void MixedContact::note_doubts(const Eigen::VectorXd& u, ContactDoubts& doubts) {
  if (rubs_by_shears_) note_unshared_friction(doubts);
  if (augmentation_share_ < 1.0) note_lowered_augmentation(doubts);
  if (rows_.full().rows() == 0) return;
  note_coarse_faces(u, doubts);
  note_friction_between_nodes(doubts);
  const auto is_penalised = [](const ContactZone& zone) {
    return zone.mixed.penalised || zone.mixed.friction_penalised;
  };
  if (std::ranges::none_of(definition_.zones, is_penalised)) return;
  const Eigen::VectorXd now = jumps(u);
  note_held_overlaps(now, doubts);
  // What another zone presses on a body would not press on this one without it.
  for (int zone = 0; zone < static_cast<int>(definition_.zones.size()); ++zone) {
    const MixedZone& mixed = definition_.zones[static_cast<std::size_t>(zone)].mixed;
    if (mixed.penalised) note_depth(zone, now, jumps_without(forces_of(zone, forces_), u), doubts);
    if (mixed.friction_penalised) note_creep(zone, u, now, jumps_without(forces_of(zone, shears()), u), doubts);
  }
}

Eigen::VectorXd MixedContact::forces_of(int zone, Eigen::VectorXd forces) const {
  for (std::size_t p = 0; p < points().size(); ++p)
    if (points()[p].zone != zone && problem_.points[p].rows > 0)
      forces.segment(problem_.points[p].first_row, problem_.points[p].rows).setZero();
  return forces;
}

void MixedContact::note_loose_bodies(ContactDoubts& doubts) const {
  if (tangent_.springs().empty() || rows_.reduced().rows() == 0) return;
  std::vector<Eigen::Triplet<double>> entries;
  int count = 0;
  for (std::size_t p = 0; p < points().size(); ++p) {
    const CondensedPoint& point = problem_.points[p];
    if (point.rows == 0 || state_.statuses[p] == ContactStatus::open || is_free_of_force(p)) continue;
    const int held = point.law.friction > 0.0 ? point.rows : 1;  // the limit of what slides goes with the pressure
    for (int c = 0; c < held; ++c, ++count) {
      const int row = point.first_row + c;
      const double size = std::sqrt(rows_.reduced().row(row).squaredNorm());
      for (RowMatrix::InnerIterator it(rows_.reduced(), row); it && size > 0.0; ++it)
        entries.emplace_back(count, static_cast<int>(it.col()), it.value() / size);
    }
  }
  RowMatrix rows(count, rows_.reduced().cols());
  rows.setFromTriplets(entries.begin(), entries.end());
  doubts.note_loose(tangent_.unheld_beside(&rows));
}

/// The part of the contact forces along the surfaces.
Eigen::VectorXd MixedContact::shears() const {
  Eigen::VectorXd shears = forces_;
  for (const CondensedPoint& point : problem_.points)
    if (point.rows > 0) shears[point.first_row] = 0.0;
  return shears;
}

/// Where the present loads and the rest of the contact forces would take the points if these did not hold them.
Eigen::VectorXd MixedContact::jumps_without(const Eigen::VectorXd& contact_forces, const Eigen::VectorXd& u) {
  if (!schur_) {
    Eigen::MatrixXd push = rows_.reduced().transpose() * contact_forces;
    tangent_.solve_once(push);
    return jumps(u) - rows_.reduced() * push;
  }
  return jumps(u) - pushed_by(contact_forces);
}

Eigen::VectorXd MixedContact::pushed_by(const Eigen::VectorXd& contact_forces) {
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(schur_->size());
  forces.head(contact_forces.size()) = contact_forces;
  return schur_->times(forces).head(contact_forces.size());
}

/// Zone by zone, by all forces or by its own alone: those of another zone may push the other way, and where a zone has
/// none they are no measure of it.
std::vector<double> MixedContact::pushed_back() {
  std::vector<double> result(definition_.zones.size(), 0.0);
  if (!schur_ || forces_.size() == 0) return result;
  const Eigen::VectorXd pushed_by_all = pushed_by(forces_);
  for (int zone = 0; zone < static_cast<int>(result.size()); ++zone) {
    const Eigen::VectorXd own = forces_of(zone, forces_);
    if (own.isZero(0.0)) continue;
    const Eigen::VectorXd pushed = result.size() > 1 ? pushed_by(own) : pushed_by_all;
    for (std::size_t p = 0; p < points().size(); ++p) {
      if (points()[p].zone != zone || problem_.points[p].rows == 0) continue;
      const auto rows = Eigen::seqN(problem_.points[p].first_row, problem_.points[p].rows);
      double& most = result[static_cast<std::size_t>(zone)];
      most = std::max({most, largest_component(pushed(rows)), largest_component(pushed_by_all(rows))});
    }
  }
  return result;
}

/// How far the surfaces of a zone have moved, at most.
double MixedContact::motion_of(int zone, const Eigen::VectorXd& u) const {
  const ContactZone& definition = definition_.zones[static_cast<std::size_t>(zone)];
  double most = 0.0;
  for (const std::vector<int>* cells : {&definition.slave_cells, &definition.master_cells})
    for (const int cell : *cells)
      for (const int node : mesh_.cell(cell))
        for (const Component component : {Component::dx, Component::dy, Component::dz})
          if (const int dof = dofs_.dof(node, component); dof >= 0) most = std::max(most, std::abs(u[dof]));
  return most;
}

/// Between nodes the law holds in the mean over the points of a face: one that is pressed at few of its points cannot
/// press there alone, and lets the master in.
void MixedContact::note_coarse_faces(const Eigen::VectorXd& u, ContactDoubts& doubts) {
  const auto counts = [](const CondensedPoint& point) {
    return point.rows > 0 && point.node_count > 1 && !point.law.penalised;
  };
  if (std::ranges::none_of(problem_.points, counts)) return;
  const Eigen::VectorXd now = jumps(u);
  std::vector<double> overlap(definition_.zones.size(), 0.0), area = overlap;
  for (std::size_t p = 0; p < points().size(); ++p) {
    if (!counts(problem_.points[p])) continue;
    const double depth = -now[problem_.points[p].first_row];
    if (depth <= overlap_share * extent(mesh_, points()[p].cell)) continue;
    const auto zone = static_cast<std::size_t>(points()[p].zone);
    overlap[zone] += points()[p].weight * depth;
    area[zone] += points()[p].weight;
  }
  if (std::ranges::all_of(area, [](double each) { return each == 0.0; })) return;
  const std::vector<double> pushed = pushed_back();
  for (std::size_t zone = 0; zone < area.size(); ++zone) {
    if (!(area[zone] > 0.0)) continue;
    const double mean = overlap[zone] / area[zone],
                 reach = std::max(pushed[zone], doubtful_share * motion_of(static_cast<int>(zone), u));
    if (mean > doubtful_passage * reach)
      doubts.note(
          {.kind = DoubtKind::coarse_face, .zone = static_cast<int>(zone), .share = mean / reach, .length = mean});
  }
}

/// The limit of friction is that of the multiplier, without the augmentation by the gap, and a face that is partly in
/// contact has little of the multiplier where it presses, or more of it than presses.
void MixedContact::note_friction_between_nodes(ContactDoubts& doubts) const {
  struct Friction {
    double limit = 0.0, missing = 0.0;              ///< of points between nodes, and what those that slide lack
    double limit_of_all = 0.0, shear_of_all = 0.0;  ///< with points on nodes, which share multipliers with them
  };
  std::vector<Friction> zones(definition_.zones.size());
  for (std::size_t p = 0; p < points().size(); ++p) {
    const CondensedPoint& point = problem_.points[p];
    if (point.rows < 2 || state_.statuses[p] == ContactStatus::open) continue;
    Friction& zone = zones[static_cast<std::size_t>(points()[p].zone)];
    const double own_limit = point.law.friction * std::abs(forces_[point.first_row]);
    const double shear = forces_.segment(point.first_row + 1, point.rows - 1).norm();
    zone.limit_of_all += own_limit;
    zone.shear_of_all += shear;
    if (point.node_count < 2) continue;
    zone.limit += own_limit;
    if (state_.statuses[p] == ContactStatus::sliding) zone.missing += own_limit - shear;
  }
  for (std::size_t k = 0; k < zones.size(); ++k) {
    const Friction& zone = zones[k];
    const int number = static_cast<int>(k);
    if (zone.missing > doubtful_friction * zone.limit)
      doubts.note({.kind = DoubtKind::weak_friction, .zone = number, .share = zone.missing / zone.limit});
    const double beyond = zone.shear_of_all - zone.limit_of_all;
    if (zone.limit > 0.0 && beyond > doubtful_friction * zone.limit_of_all)
      doubts.note({.kind = DoubtKind::strong_friction, .zone = number, .share = beyond / zone.limit_of_all});
  }
}

void MixedContact::note_depth(int zone, const Eigen::VectorXd& now, const Eigen::VectorXd& without,
                              ContactDoubts& doubts) const {
  const ContactZone& definition = definition_.zones[static_cast<std::size_t>(zone)];
  double depth = 0.0;
  double reach = 0.0;
  for (std::size_t p = 0; p < points().size(); ++p) {
    const CondensedPoint& point = problem_.points[p];
    if (points()[p].zone != zone || point.rows == 0 || state_.statuses[p] == ContactStatus::open || is_free_of_force(p))
      continue;
    depth = std::max(depth, -now[point.first_row]);
    reach = std::max(reach, -without[point.first_row]);
  }
  ContactDoubt doubt{.kind = DoubtKind::soft_penalty,
                     .zone = zone,
                     .length = depth,
                     .penalty = penalties_.contact_penalty(definition.mixed, zone)};
  // What nothing but contact holds has no depth to compare with, and its forces do not depend on the penalty.
  if (problem_.springs.empty()) note_soft_penalty(doubt, reach, doubts);
  const double size = extent(mesh_, definition.slave_cells);
  if (depth <= doubtful_depth * size) return;
  doubt.kind = DoubtKind::deep_penalty;
  doubt.share = depth / size;
  doubt.wanted = std::pow(10.0, std::ceil(std::log10(doubt.penalty * doubt.share / penalty_goal)));
  doubts.note(doubt);
}

void MixedContact::note_creep(int zone, const Eigen::VectorXd& u, const Eigen::VectorXd& now,
                              const Eigen::VectorXd& without, ContactDoubts& doubts) const {
  const double least = negligible_slip * motion_of(zone, u);
  double creep = 0.0;
  double reach = 0.0;
  double limit = 0.0;
  for (std::size_t p = 0; p < points().size(); ++p) {
    if (points()[p].zone != zone || problem_.points[p].rows < 2 || state_.statuses[p] != ContactStatus::sticking)
      continue;
    const CondensedPoint& point = problem_.points[p];
    creep = std::max(creep, slip_of(point, now));
    limit = std::max(limit, point.share_augmentation > 0.0 ? 1.0 : point.law.friction * forces_[point.first_row]);
    reach = std::max(reach, slip_of(point, without));
  }
  const MixedZone& mixed = definition_.zones[static_cast<std::size_t>(zone)].mixed;
  const bool is_allowed = mixed.largest_slip && creep <= *mixed.largest_slip;
  if (is_allowed || creep <= least || creep <= doubtful_share * reach) return;
  ContactDoubt doubt{
      .kind = DoubtKind::soft_friction, .zone = zone, .share = std::min(1.0, creep / reach), .length = creep};
  doubt.penalty = penalties_.friction_penalty(mixed, zone);
  // With it, friction is at its limit after a small share of the present creep.
  doubt.wanted = std::pow(10.0, std::ceil(std::log10(std::max(doubt.penalty, limit / (penalty_goal * creep)))));
  doubts.note(doubt);
}

void MixedContact::note_unshared_friction(ContactDoubts& doubts) const {
  for (std::size_t p = 0; p < points().size(); ++p)
    if (problem_.points[p].rows > 1 && problem_.points[p].share_augmentation > 0.0)
      doubts.note({.kind = DoubtKind::unshared_friction, .zone = points()[p].zone});
}

void MixedContact::note_lowered_augmentation(ContactDoubts& doubts) const {
  const std::vector<char> shared = shared_multipliers();
  for (std::size_t p = 0; p < points().size(); ++p) {
    const CondensedPoint& point = problem_.points[p];
    const double given = definition_.zones[static_cast<std::size_t>(points()[p].zone)].mixed.augmentation;
    if (point.rows == 0 || point.law.penalised || !shared[static_cast<std::size_t>(point.nodes[0])] ||
        !(point.law.augmentation < given))
      continue;
    doubts.note({.kind = DoubtKind::lowered_augmentation,
                 .zone = points()[p].zone,
                 .share = given / point.law.augmentation,
                 .penalty = given,
                 .wanted = point.law.augmentation});
  }
}

void MixedContact::note_held_overlaps(const Eigen::VectorXd& now, ContactDoubts& doubts) const {
  for (const std::size_t p : rows_.blocked()) {
    const double depth = -now[problem_.points[p].first_row];
    const double size = extent(mesh_, points()[p].cell);
    if (depth <= overlap_share * size) continue;
    doubts.note({.kind = DoubtKind::held_overlap,
                 .zone = points()[p].zone,
                 .share = depth / size,
                 .length = depth,
                 .cell = points()[p].cell});
  }
}

}  // namespace comma::solver
