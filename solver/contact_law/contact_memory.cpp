#include "solver/contact_law/contact_memory.hpp"

#include <algorithm>

#include "solver/mesh/place.hpp"

namespace comma::solver {
namespace {

bool share_cells(const ZoneMemory& a, const ZoneMemory& b) {
  return std::ranges::any_of(a.slave_cells, [&](int cell) { return std::ranges::binary_search(b.slave_cells, cell); });
}

}  // namespace

Eigen::Vector3d initial_place(const ContactPoint& point, const Mesh& mesh) {
  if (point.node >= 0) return place(mesh, point.node);
  Eigen::Vector3d at = Eigen::Vector3d::Zero();
  const auto nodes = mesh.cell(point.cell);
  for (std::size_t i = 0; i < nodes.size(); ++i) at += point.shape[i] * place(mesh, nodes[i]);
  return at;
}

std::optional<std::size_t> ContactMemory::zone_like(const ZoneMemory& zone, std::size_t number) const {
  if (number < zones.size() && share_cells(zone, zones[number])) return number;
  const auto found = std::ranges::find_if(zones, [&](const ZoneMemory& other) { return share_cells(zone, other); });
  if (found == zones.end()) return std::nullopt;
  return static_cast<std::size_t>(found - zones.begin());
}

std::vector<char> ContactMemory::held(std::span<const RememberedPoint> points, const ZoneMemory& zone,
                                      std::span<const double> reach) const {
  std::vector<const ZoneMemory*> candidates;
  for (const ZoneMemory& before : zones)
    if (share_cells(zone, before)) candidates.push_back(&before);
  std::vector<char> result(points.size(), 0);
  for (std::size_t p = 0; p < points.size(); ++p) {
    double nearest = reach[p];
    bool is_of_cell = false;
    for (const ZoneMemory* before : candidates)
      for (const RememberedPoint& other : before->points) {
        const double distance = (other.place - points[p].place).norm();
        const bool of_cell = other.cell == points[p].cell;
        if (distance > nearest || (distance == nearest && (is_of_cell || !of_cell))) continue;
        nearest = distance;
        is_of_cell = of_cell;
        result[p] = before->bilateral && other.closed;
      }
  }
  return result;
}

}  // namespace comma::solver
