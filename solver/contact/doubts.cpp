#include "solver/contact/doubts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/contact/extent.hpp"
#include "solver/mesh/cell_type.hpp"

namespace comma::solver {
namespace {

/// Places are exact to this share of a facet's size.
constexpr double rounding_of_place = 1e-10;

double mean_size(const Mesh& mesh, const std::vector<int>& cells) {
  double sum = 0.0;
  for (const int cell : cells) sum += extent(mesh, cell);
  return sum / static_cast<double>(cells.size());
}

bool is_held(const Mesh& mesh, const std::vector<int>& cells, const std::function<bool(int)>& gives_way) {
  return std::ranges::none_of(cells, [&](int cell) { return std::ranges::any_of(mesh.cell(cell), gives_way); });
}

}  // namespace

void ContactDoubts::note(const ContactDoubt& doubt) {
  const auto found = std::ranges::find_if(all_, [&](const ContactDoubt& each) { return each.kind == doubt.kind && each.zone == doubt.zone; });
  if (found == all_.end()) {
    all_.push_back(doubt);
  } else if (doubt.length > found->length) {
    *found = doubt;
  }
}

double wanted_penalty(double penalty, double share) {
  const double stuck = std::max(1.0 - share, std::numeric_limits<double>::epsilon());
  return std::pow(10.0, std::ceil(std::log10(penalty * share * (1.0 - penalty_goal) / (penalty_goal * stuck))));
}

void note_sparse_points(const ContactDefinition& definition, const Mesh& mesh, const std::vector<int>& point_counts,
                        const std::vector<std::vector<int>>& facets, const std::function<bool(int)>& gives_way, ContactDoubts& doubts) {
  for (std::size_t zone = 0; zone < definition.zones.size(); ++zone) {
    const std::vector<int>& slave = definition.zones[zone].slave_cells;
    // Local averages see all of the master side.
    if (!definition.zones[zone].resolved || definition.zones[zone].mixed.local_average || point_counts[zone] == 0 || facets[zone].empty()) continue;
    if (is_held(mesh, facets[zone], gives_way)) continue;
    const int across = dimension(mesh.cell_types[static_cast<std::size_t>(slave.front())]);
    const double points_a_face = static_cast<double>(point_counts[zone]) / static_cast<double>(slave.size());
    const double spacing = mean_size(mesh, slave) * std::pow(points_a_face, -1.0 / std::max(1, across));
    const double ratio = spacing / mean_size(mesh, facets[zone]);
    if (ratio > sparse_spacing) doubts.note({.kind = DoubtKind::sparse_points, .zone = static_cast<int>(zone), .share = ratio, .length = spacing});
  }
}

double gap_at(const ContactPair& pair, const Mesh& mesh, Positions positions) {
  Eigen::Vector3d apart = positions[static_cast<std::size_t>(pair.slave)];
  const auto facet = mesh.cell(pair.facet);
  for (std::size_t a = 0; a < facet.size(); ++a) apart -= pair.weights[a] * positions[static_cast<std::size_t>(facet[a])];
  return apart.dot(pair.normal) - pair.thickness;
}

void note_stale_geometry(const ContactDefinition& definition, const Mesh& mesh, Positions positions, const StaleGaps& gaps, ContactDoubts& doubts) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  const double tolerance = doubtful_share * gaps.pushed_back;
  for (std::size_t k = 0; k < gaps.before.size() && k < gaps.now.size(); ++k) {
    const ContactPair& before = gaps.before[k];
    const ContactPair& now = gaps.now[k];
    if (now.status != PairingStatus::paired || !definition.zones[static_cast<std::size_t>(now.zone)].resolved) continue;
    // What faced nothing then is as good as open.
    const double solved = before.status == PairingStatus::paired ? gap_at(before, mesh, positions) : infinite;
    const double is = gap_at(now, mesh, positions);
    const double error = std::isfinite(solved) ? std::abs(is - solved) : std::max(0.0, -is);
    const double size = extent(mesh, now.facet);
    if (std::min(is, solved) > tolerance || error <= tolerance || error <= rounding_of_place * size) continue;
    const double share = gaps.pushed_back > 0.0 ? std::min(1.0, error / gaps.pushed_back) : 1.0;
    doubts.note({.kind = DoubtKind::stale_geometry, .zone = now.zone, .share = share, .length = error, .node = now.slave});
  }
}

}  // namespace comma::solver
