#include "solver/nonlinear/contact/contact_doubts.hpp"

#include <algorithm>
#include <cmath>

#include "solver/contact/extent.hpp"
#include "solver/linear/largest_component.hpp"

namespace comma::solver {
namespace {

using Eigen::Vector3d;

/// Slips below this share of the largest displacement are no slips.
constexpr double negligible_slip = 1e-6;

/// The forces without those of other zones.
Eigen::VectorXd forces_of(const SolvedContact& contact, int zone, Eigen::VectorXd forces) {
  for (std::size_t p = 0; p < contact.faced.points().size(); ++p)
    if (contact.faced.points()[p].zone != zone && contact.faced.problem.points[p].rows > 0)
      forces.segment(contact.faced.problem.points[p].first_row, contact.faced.problem.points[p].rows).setZero();
  return forces;
}

/// The part of the contact forces along the surfaces.
Eigen::VectorXd shears(const SolvedContact& contact) {
  Eigen::VectorXd shears = contact.faced.forces;
  for (const CondensedPoint& point : contact.faced.problem.points)
    if (point.rows > 0) shears[point.first_row] = 0.0;
  return shears;
}

/// How far the surfaces of a zone have moved, at most.
double motion_of(const SolvedContact& contact, int zone) {
  const ContactZone& definition = contact.faced.definition.zones[static_cast<std::size_t>(zone)];
  double most = 0.0;
  for (const std::vector<int>* cells : {&definition.slave_cells, &definition.master_cells})
    for (const int cell : *cells)
      for (const int node : contact.faced.mesh.cell(cell))
        for (const Component component : {Component::dx, Component::dy, Component::dz})
          if (const int dof = contact.faced.dofs.dof(node, component); dof >= 0)
            most = std::max(most, std::abs(contact.u[dof]));
  return most;
}

/// Between nodes the law holds in the mean over the points of a face: one that is pressed at few of its points cannot
/// press there alone, and lets the master in.
void note_coarse_faces(const SolvedContact& contact, const ContactResponse& response, ContactDoubts& doubts) {
  const auto counts = [](const CondensedPoint& point) {
    return point.rows > 0 && point.node_count > 1 && !point.law.penalised;
  };
  if (std::ranges::none_of(contact.faced.problem.points, counts)) return;
  std::vector<double> overlap(contact.faced.definition.zones.size(), 0.0), area = overlap;
  for (std::size_t p = 0; p < contact.faced.points().size(); ++p) {
    if (!counts(contact.faced.problem.points[p])) continue;
    const double depth = -contact.jumps[contact.faced.problem.points[p].first_row];
    if (depth <= overlap_tolerance * extent(contact.faced.mesh, contact.faced.points()[p].cell)) continue;
    const auto zone = static_cast<std::size_t>(contact.faced.points()[p].zone);
    overlap[zone] += contact.faced.points()[p].weight * depth;
    area[zone] += contact.faced.points()[p].weight;
  }
  if (std::ranges::all_of(area, [](double each) { return each == 0.0; })) return;
  const std::vector<double> pushed = response.pushed_back();
  for (std::size_t zone = 0; zone < area.size(); ++zone) {
    if (!(area[zone] > 0.0)) continue;
    const double mean = overlap[zone] / area[zone],
                 reach = std::max(pushed[zone], doubtful_share * motion_of(contact, static_cast<int>(zone)));
    if (mean > doubtful_passage * reach)
      doubts.note(
          {.kind = DoubtKind::coarse_face, .zone = static_cast<int>(zone), .share = mean / reach, .length = mean});
  }
}

/// The limit of friction is that of the multiplier, without the augmentation by the gap, and a face that is partly in
/// contact has little of the multiplier where it presses, or more of it than presses.
void note_friction_between_nodes(const SolvedContact& contact, ContactDoubts& doubts) {
  struct Friction {
    double limit = 0.0, missing = 0.0;              ///< of points between nodes, and what those that slide lack
    double limit_of_all = 0.0, shear_of_all = 0.0;  ///< with points on nodes, which share multipliers with them
  };
  std::vector<Friction> zones(contact.faced.definition.zones.size());
  for (std::size_t p = 0; p < contact.faced.points().size(); ++p) {
    const CondensedPoint& point = contact.faced.problem.points[p];
    if (point.rows < 2 || !contact.faced.is_closed(p)) continue;
    Friction& zone = zones[static_cast<std::size_t>(contact.faced.points()[p].zone)];
    const double own_limit = point.law.friction * std::abs(contact.faced.forces[point.first_row]);
    const double shear = contact.faced.forces.segment(point.first_row + 1, point.rows - 1).norm();
    zone.limit_of_all += own_limit;
    zone.shear_of_all += shear;
    if (point.node_count < 2) continue;
    zone.limit += own_limit;
    if (contact.faced.state.statuses[p] == ContactStatus::sliding) zone.missing += own_limit - shear;
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

void note_depth(const SolvedContact& contact, const ContactResponse& response, int zone, const Eigen::VectorXd& without,
                ContactDoubts& doubts) {
  const ContactZone& definition = contact.faced.definition.zones[static_cast<std::size_t>(zone)];
  double depth = 0.0;
  double reach = 0.0;
  double penalty = response.penalties.contact_penalty(definition.mixed, zone);
  for (std::size_t p = 0; p < contact.faced.points().size(); ++p) {
    const CondensedPoint& point = contact.faced.problem.points[p];
    if (contact.faced.points()[p].zone != zone || point.rows == 0 || !contact.faced.is_closed(p) ||
        contact.faced.is_free_of_force(p))
      continue;
    if (-contact.jumps[point.first_row] > depth) penalty = point.law.augmentation;
    depth = std::max(depth, -contact.jumps[point.first_row]);
    reach = std::max(reach, -without[point.first_row]);
  }
  ContactDoubt doubt{.kind = DoubtKind::soft_penalty, .zone = zone, .length = depth, .penalty = penalty};
  // What nothing but contact holds has no depth to compare with, and its forces do not depend on the penalty; nor has
  // it where the stresses of large displacements make its stiffness indefinite.
  if (contact.faced.problem.springs.empty() && !contact.faced.problem.indefinite)
    note_soft_penalty(doubt, reach, extent(contact.faced.mesh), doubts);
  const double size = extent(contact.faced.mesh, definition.slave_cells);
  if (depth <= doubtful_depth * size) return;
  doubt.kind = DoubtKind::deep_penalty;
  doubt.share = depth / size;
  doubt.wanted = std::pow(10.0, std::ceil(std::log10(doubt.penalty * doubt.share / penalty_goal)));
  doubts.note(doubt);
}

void note_creep(const SolvedContact& contact, const ContactResponse& response, int zone, const Eigen::VectorXd& without,
                ContactDoubts& doubts) {
  const double least =
      std::max(negligible_slip * motion_of(contact, zone), rounding_of_length * extent(contact.faced.mesh));
  double creep = 0.0;
  double reach = 0.0;
  double limit = 0.0;
  for (std::size_t p = 0; p < contact.faced.points().size(); ++p) {
    if (contact.faced.points()[p].zone != zone || contact.faced.problem.points[p].rows < 2 ||
        contact.faced.state.statuses[p] != ContactStatus::sticking)
      continue;
    const CondensedPoint& point = contact.faced.problem.points[p];
    creep = std::max(creep, slip_of(point, contact.jumps));
    limit = std::max(limit,
                     point.share_augmentation > 0.0 ? 1.0 : point.law.friction * contact.faced.forces[point.first_row]);
    reach = std::max(reach, slip_of(point, without));
  }
  const MixedZone& mixed = contact.faced.definition.zones[static_cast<std::size_t>(zone)].mixed;
  const bool is_allowed = mixed.largest_slip && creep <= *mixed.largest_slip;
  if (is_allowed || creep <= least || creep <= doubtful_share * reach) return;
  ContactDoubt doubt{
      .kind = DoubtKind::soft_friction, .zone = zone, .share = std::min(1.0, creep / reach), .length = creep};
  doubt.penalty = response.penalties.friction_penalty(mixed, zone);
  // With it, friction is at its limit after a small share of the present creep.
  doubt.wanted = std::pow(10.0, std::ceil(std::log10(std::max(doubt.penalty, limit / (penalty_goal * creep)))));
  doubts.note(doubt);
}

void note_unshared_friction(const SolvedContact& contact, ContactDoubts& doubts) {
  for (std::size_t p = 0; p < contact.faced.points().size(); ++p)
    if (contact.faced.problem.points[p].rows > 1 && contact.faced.problem.points[p].share_augmentation > 0.0)
      doubts.note({.kind = DoubtKind::unshared_friction, .zone = contact.faced.points()[p].zone});
}

void note_lowered_augmentation(const SolvedContact& contact, ContactDoubts& doubts) {
  const std::vector<char> shared = shared_multipliers(contact.faced.problem);
  for (std::size_t p = 0; p < contact.faced.points().size(); ++p) {
    const CondensedPoint& point = contact.faced.problem.points[p];
    const double given = contact.faced.zone_of(p).mixed.augmentation;
    if (point.rows == 0 || point.law.penalised || !shared[static_cast<std::size_t>(point.nodes[0])] ||
        !(point.law.augmentation < given))
      continue;
    doubts.note({.kind = DoubtKind::lowered_augmentation,
                 .zone = contact.faced.points()[p].zone,
                 .share = given / point.law.augmentation,
                 .penalty = given,
                 .wanted = point.law.augmentation});
  }
}

void note_opening_by_gaps(const SolvedContact& contact, ContactDoubts& doubts) {
  for (std::size_t p = 0; p < contact.faced.points().size(); ++p)
    if (contact.faced.problem.points[p].node_count > 1 && contact.faced.problem.points[p].law.penalised)
      doubts.note({.kind = DoubtKind::opening_by_gaps, .zone = contact.faced.points()[p].zone});
}

void note_held_overlaps(const SolvedContact& contact, ContactDoubts& doubts) {
  for (const std::size_t p : contact.faced.rows.blocked()) {
    const double depth = -contact.jumps[contact.faced.problem.points[p].first_row];
    const double size = extent(contact.faced.mesh, contact.faced.points()[p].cell);
    if (depth <= overlap_tolerance * size) continue;
    doubts.note({.kind = DoubtKind::held_overlap,
                 .zone = contact.faced.points()[p].zone,
                 .share = depth / size,
                 .length = depth,
                 .cell = contact.faced.points()[p].cell});
  }
}

}  // namespace

void note_doubts(const SolvedContact& contact, const ContactResponse& response, ContactDoubts& doubts) {
  if (response.by_shears) note_unshared_friction(contact, doubts);
  if (response.opens_by_gaps) note_opening_by_gaps(contact, doubts);
  if (response.augmentation_is_lowered) note_lowered_augmentation(contact, doubts);
  if (contact.faced.rows.full().rows() == 0) return;
  note_coarse_faces(contact, response, doubts);
  note_friction_between_nodes(contact, doubts);
  const auto is_penalised = [](const ContactZone& zone) {
    return zone.mixed.penalised || zone.mixed.friction_penalised;
  };
  if (std::ranges::none_of(contact.faced.definition.zones, is_penalised)) return;
  note_held_overlaps(contact, doubts);
  // Where the rest of the contact forces would take the points if these did not hold them. What another zone presses on
  // a body would not press on this one without it.
  const auto without = [&](int zone, const Eigen::VectorXd& forces) -> Eigen::VectorXd {
    return contact.jumps - response.pushed_by(forces_of(contact, zone, forces));
  };
  for (int zone = 0; zone < static_cast<int>(contact.faced.definition.zones.size()); ++zone) {
    const MixedZone& mixed = contact.faced.definition.zones[static_cast<std::size_t>(zone)].mixed;
    if (mixed.penalised) note_depth(contact, response, zone, without(zone, contact.faced.forces), doubts);
    if (mixed.friction_penalised) note_creep(contact, response, zone, without(zone, shears(contact)), doubts);
  }
}

RowMatrix closed_rows(const SolvedContact& contact) {
  std::vector<Eigen::Triplet<double>> entries;
  int count = 0;
  for (std::size_t p = 0; p < contact.faced.points().size(); ++p) {
    const CondensedPoint& point = contact.faced.problem.points[p];
    if (point.rows == 0 || !contact.faced.is_closed(p) || contact.faced.is_free_of_force(p)) continue;
    const Eigen::MatrixXd resisting = resisting_rows(point);  // the limit of what slides goes with the pressure
    for (int r = 0; r < static_cast<int>(resisting.rows()); ++r, ++count)
      for (int c = 0; c < point.rows; ++c)
        if (resisting(r, c) != 0.0) entries.emplace_back(count, point.first_row + c, resisting(r, c));
  }
  RowMatrix combinations(count, contact.faced.rows.reduced().rows());
  combinations.setFromTriplets(entries.begin(), entries.end());
  RowMatrix rows = combinations * contact.faced.rows.reduced();
  for (int row = 0; row < count; ++row)
    if (const double size = rows.row(row).norm(); size > 0.0) rows.row(row) /= size;
  return rows;
}

std::vector<double> pushed_back(const SolvedContact& contact, const PushedBy& pushed_by) {
  std::vector<double> result(contact.faced.definition.zones.size(), 0.0);
  if (contact.faced.forces.size() == 0) return result;
  const Eigen::VectorXd pushed_by_all = pushed_by(contact.faced.forces);
  for (int zone = 0; zone < static_cast<int>(result.size()); ++zone) {
    const Eigen::VectorXd own = forces_of(contact, zone, contact.faced.forces);
    if (own.isZero(0.0)) continue;
    const Eigen::VectorXd pushed = result.size() > 1 ? pushed_by(own) : pushed_by_all;
    for (std::size_t p = 0; p < contact.faced.points().size(); ++p) {
      if (contact.faced.points()[p].zone != zone || contact.faced.problem.points[p].rows == 0) continue;
      const auto rows = Eigen::seqN(contact.faced.problem.points[p].first_row, contact.faced.problem.points[p].rows);
      double& most = result[static_cast<std::size_t>(zone)];
      most = std::max({most, largest_component(pushed(rows)), largest_component(pushed_by_all(rows))});
    }
  }
  return result;
}

}  // namespace comma::solver
