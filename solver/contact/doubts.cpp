#include "solver/contact/doubts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "solver/contact/contact_points.hpp"
#include "solver/contact/extent.hpp"
#include "solver/contact/face_rule.hpp"
#include "solver/contact/patch_points.hpp"
#include "solver/error.hpp"
#include "solver/mesh/cell_type.hpp"
#include "solver/mesh/place.hpp"

namespace comma::solver {
namespace {

/// How far outside a slave face, in its reference coordinates, a master node still faces it.
constexpr double border = 1e-6;

/// Of the motion of a node.
constexpr double negligible_passage = 1e-6;

/// The same surfaces the other way round, master nodes facing slave faces: watched, so that the middle nodes of
/// quadratic faces count too.
ContactDefinition turned(const ContactDefinition& definition, const ContactZone& zone) {
  ContactDefinition result;
  result.smooth_normals = definition.smooth_normals;
  ContactZone& other = result.zones.emplace_back();
  other.master_cells = zone.slave_cells;
  other.slave_cells = zone.master_cells;
  other.master_normal = zone.slave_normal;
  other.master_vector = zone.slave_vector;
  other.master_thickness = zone.slave_thickness;
  other.slave_thickness = zone.master_thickness;
  other.half_thickness = zone.half_thickness;
  other.projection_tolerance = border;
  other.resolved = false;
  return result;
}

/// The same surfaces as they are, slave nodes facing master facets, watched.
ContactDefinition watched(const ContactDefinition& definition, const ContactZone& zone) {
  ContactDefinition result;
  result.smooth_normals = definition.smooth_normals;
  ContactZone& other = result.zones.emplace_back(zone);
  other.mixed = {};
  other.projection_tolerance = border;
  other.resolved = false;
  return result;
}

/// Averages see all of the master side, but what lies beyond a pairing distance is let in altogether.
bool is_held_in_the_mean(const ContactZone& zone) { return zone.mixed.local_average && zone.pairing_distance < 0.0; }

/// A gap that was solved for, and what it is.
struct StaleGap {
  int zone = 0;
  int node = -1;
  double solved = std::numeric_limits<double>::infinity();  ///< of what faced nothing: as good as open
  double is = 0.0;
  double size = 0.0;  ///< of the facet
};

void note_stale_gap(const StaleGap& gap, double pushed_back, ContactDoubts& doubts) {
  const double tolerance = doubtful_share * pushed_back;
  const double error = std::isfinite(gap.solved) ? std::abs(gap.is - gap.solved) : std::max(0.0, -gap.is);
  if (std::min(gap.is, gap.solved) > tolerance || error <= tolerance || error <= rounding_of_place * gap.size) return;
  const double share = pushed_back > 0.0 ? std::min(1.0, error / pushed_back) : 1.0;
  doubts.note({.kind = DoubtKind::stale_geometry, .zone = gap.zone, .share = share, .length = error, .node = gap.node});
}

}  // namespace

void ContactDoubts::note(const ContactDoubt& doubt) {
  const auto found = std::ranges::find_if(
      all_, [&](const ContactDoubt& each) { return each.kind == doubt.kind && each.zone == doubt.zone; });
  if (found == all_.end()) {
    all_.push_back(doubt);
  } else if (std::pair(doubt.length, doubt.share) > std::pair(found->length, found->share)) {
    *found = doubt;
  }
}

double wanted_penalty(double penalty, double share) {
  const double stuck = std::max(1.0 - share, std::numeric_limits<double>::epsilon());
  return std::pow(10.0, std::ceil(std::log10(penalty * share * (1.0 - penalty_goal) / (penalty_goal * stuck))));
}

void note_soft_penalty(ContactDoubt doubt, double reach, double size, ContactDoubts& doubts) {
  if (doubt.length <= doubtful_share * reach || doubt.length <= rounding_of_length * size) return;
  doubt.share = std::min(1.0, doubt.length / reach);
  doubt.wanted = wanted_penalty(doubt.penalty, doubt.share);
  doubts.note(doubt);
}

PassedMaster::Depths PassedMaster::depths(const ContactZone& zone, Positions positions, double time) const {
  Depths result;
  const ContactDefinition looked_at =
      is_held_in_the_mean(zone) ? watched(definition_, zone) : turned(definition_, zone);
  for (const ContactPair& pair : pair_surfaces(looked_at, mesh_, positions, time)) {
    if (pair.status != PairingStatus::watched) continue;
    result.size = std::max(result.size, extent(mesh_, pair.facet));
    result.depth.emplace(pair.slave, -gap_at(pair, mesh_, positions));
  }
  return result;
}

void PassedMaster::look(Positions positions, std::span<const double> pushed_back, double time) {
  for (int index = 0; index < static_cast<int>(definition_.zones.size()); ++index) {
    const ContactZone& zone = definition_.zones[static_cast<std::size_t>(index)];
    if (!zone.resolved) continue;
    const double pushed = pushed_back[static_cast<std::size_t>(index)];
    pushed_back_[index] = std::max(pushed_back_[index], pushed);
    try {
      look_at(index, positions, pushed, time);
    } catch (const Error&) {
      continue;  // surfaces that cannot be paired the other way round, such as points, tell nothing; others do
    }
  }
}

const std::unordered_map<int, double>& PassedMaster::shares(int index) {
  const auto [known, is_new] = shares_.try_emplace(index);
  if (!is_new) return known->second;
  const ContactZone& zone = definition_.zones[static_cast<std::size_t>(index)];
  for (const int cell : is_held_in_the_mean(zone) ? zone.slave_cells : zone.master_cells) {
    const CellType type = mesh_.cell_types[static_cast<std::size_t>(cell)];
    const auto nodes = mesh_.cell(cell);
    std::array<double, max_facet_nodes> own{};
    for (const FacePoint& at : face_rule(type, ContactRule::gauss, 0)) {
      const FacetShape shape = facet_shape(type, at.xi);
      const double area = at.weight * initial_stretch(mesh_, cell, at.xi, false);
      for (std::size_t i = 0; i < nodes.size(); ++i) own[i] += area * shape.values[i];
    }
    for (std::size_t i = 0; i < nodes.size(); ++i) known->second[nodes[i]] += std::abs(own[i]);
  }
  return known->second;
}

void PassedMaster::look_at(int index, Positions positions, double pushed, double time) {
  const ContactZone& zone = definition_.zones[static_cast<std::size_t>(index)];
  if (!initial_.contains(index)) initial_.emplace(index, depths(zone, places(mesh_), time));
  const Depths& before = initial_.at(index);
  const Depths now = depths(zone, positions, time);
  const std::unordered_map<int, double>& share = shares(index);
  double sum = 0.0, touching = 0.0, moved = 0.0;
  for (const auto& [node, depth] : now.depth) {
    if (depth < -doubtful_share * pushed) continue;
    const auto known = before.depth.find(node);
    // Where nothing pushes back nothing tells touching nodes from those that other parts of the bodies hide: what lay
    // in front does.
    if (!(pushed > 0.0) && (known == before.depth.end() || known->second > 0.0)) continue;
    const double passed = std::max(0.0, depth - (known == before.depth.end() ? 0.0 : std::max(0.0, known->second)));
    sum += share.at(node) * passed;
    touching += share.at(node);
    moved = std::max(moved, (positions[node] - place(mesh_, node)).norm());
  }
  const double mean = touching > 0.0 ? sum / touching : 0.0;
  // Without a push to compare with, what is nothing beside the motion is rounding.
  const double rounding = std::max(rounding_of_place * now.size, pushed > 0.0 ? 0.0 : negligible_passage * moved);
  if (mean > rounding) deepest_[index] = std::max(deepest_[index], mean);
}

void PassedMaster::conclude(ContactDoubts& doubts) const {
  for (const auto& [zone, depth] : deepest_) {
    const bool is_soft = std::ranges::any_of(doubts.all(), [zone = zone](const ContactDoubt& each) {
      return each.zone == zone && (each.kind == DoubtKind::soft_penalty || each.kind == DoubtKind::deep_penalty);
    });
    const double pushed = pushed_back_.at(zone);
    if (is_soft || depth <= doubtful_passage * pushed) continue;
    const bool is_average = is_held_in_the_mean(definition_.zones[static_cast<std::size_t>(zone)]);
    doubts.note({.kind = is_average ? DoubtKind::passed_average : DoubtKind::passed_master,
                 .zone = zone,
                 .share = pushed > 0.0 ? depth / pushed : std::numeric_limits<double>::infinity(),
                 .length = depth});
  }
}

double gap_at(const ContactPair& pair, const Mesh& mesh, Positions positions) {
  Eigen::Vector3d apart = positions[static_cast<std::size_t>(pair.slave)];
  const auto facet = mesh.cell(pair.facet);
  for (std::size_t a = 0; a < facet.size(); ++a)
    apart -= pair.weights[a] * positions[static_cast<std::size_t>(facet[a])];
  return apart.dot(pair.normal) - pair.thickness;
}

void note_stale_geometry(const ContactDefinition& definition, const Mesh& mesh, Positions positions,
                         const StaleGaps& gaps, ContactDoubts& doubts) {
  for (std::size_t k = 0; k < gaps.before.size() && k < gaps.now.size(); ++k) {
    const ContactPair& before = gaps.before[k];
    const ContactPair& now = gaps.now[k];
    const ContactZone& zone = definition.zones[static_cast<std::size_t>(now.zone)];
    if (now.status != PairingStatus::paired || !zone.resolved || zone.mixed.local_average) continue;
    StaleGap gap{
        .zone = now.zone, .node = now.slave, .is = gap_at(now, mesh, positions), .size = extent(mesh, now.facet)};
    if (before.status == PairingStatus::paired) gap.solved = gap_at(before, mesh, positions);
    note_stale_gap(gap, gaps.pushed_back[static_cast<std::size_t>(now.zone)], doubts);
  }
}

void note_stale_averages(const ContactDefinition& definition, const Mesh& mesh, Positions positions,
                         std::span<const ContactPoint> before, std::span<const ContactPoint> now,
                         std::span<const double> pushed_back, ContactDoubts& doubts) {
  for (std::size_t p = 0; p < before.size() && p < now.size(); ++p) {
    const ContactZone& zone = definition.zones[static_cast<std::size_t>(now[p].zone)];
    if (now[p].status != PairingStatus::paired || !zone.resolved || !zone.mixed.local_average) continue;
    StaleGap gap{.zone = now[p].zone,
                 .node = now[p].node,
                 .is = mean_gap(now[p], positions),
                 .size = extent(mesh, now[p].facet)};
    if (before[p].status == PairingStatus::paired) gap.solved = mean_gap(before[p], positions);
    note_stale_gap(gap, pushed_back[static_cast<std::size_t>(now[p].zone)], doubts);
  }
}

}  // namespace comma::solver
