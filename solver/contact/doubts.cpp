#include "solver/contact/doubts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/contact/extent.hpp"
#include "solver/mesh/cell_type.hpp"

namespace comma::solver {
namespace {

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

}  // namespace comma::solver
