#include "solver/mesh/groups.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <unordered_set>

#include "solver/error.hpp"
#include "solver/mesh/place.hpp"

namespace comma::solver {
namespace {

using Vector = Eigen::Vector3d;

template <typename Predicate>
std::vector<int> nodes_where(const Mesh& mesh, Predicate predicate) {
  std::vector<int> result;
  for (int node = 0; node < mesh.node_count(); ++node) {
    if (predicate(place(mesh, node))) result.push_back(node);
  }
  return result;
}

template <typename Predicate>
std::vector<int> filtered(std::span<const int> members, Predicate predicate) {
  std::vector<int> result;
  std::ranges::copy_if(members, std::back_inserter(result), predicate);
  return result;
}

/// Distance from the axis through `point` along the unit vector `axis`.
double distance_from_axis(const Vector& position, const Vector& point, const Vector& axis) {
  return axis.cross(position - point).norm();
}

/// Along the normal of a face or of a line in the plane; its length is no matter.
Vector normal_of(const Mesh& mesh, int cell) {
  const auto nodes = mesh.cell(cell);
  const auto at = [&](int i) { return to_vector(mesh.nodes[nodes[static_cast<std::size_t>(i)]]); };
  if (dimension(mesh.cell_types[cell]) == 1) return (at(1) - at(0)).cross(Vector::UnitZ());
  const int corners = corner_count(mesh.cell_types[cell]);
  Vector sum = Vector::Zero();
  for (int i = 1; i + 1 < corners; ++i) sum += (at(i) - at(0)).cross(at(i + 1) - at(0));
  return sum;
}

bool plays(CellType type, int local, NodeRole role) {
  const int corners = corner_count(type);
  if (local < corners) return role == NodeRole::corner;
  const int edges = dimension(type) < 2    ? node_count(type) - corners
                    : dimension(type) == 2 ? corners
                                           : static_cast<int>(boundary_facets(type).size()) + corners - 2;  // Euler
  return role == (local < corners + edges ? NodeRole::mid_edge : NodeRole::centre);
}

}  // namespace

std::vector<std::string> names_of(const Groups& groups) {
  std::vector<std::string> names;
  for (const auto& [name, members] : groups) names.push_back(name);
  return names;
}

std::vector<int> union_of(std::span<const std::vector<int>> groups) {
  std::vector<int> result;
  std::unordered_set<int> seen;
  for (const auto& group : groups) {
    std::ranges::copy_if(group, std::back_inserter(result), [&](int member) { return seen.insert(member).second; });
  }
  return result;
}

std::vector<int> intersection_of(std::span<const std::vector<int>> groups) {
  if (groups.empty()) return {};
  std::vector<int> result = groups.front();
  for (const auto& group : groups.subspan(1)) {
    const std::unordered_set<int> other(group.begin(), group.end());
    result = filtered(result, [&](int member) { return other.contains(member); });
  }
  return result;
}

std::vector<int> difference_of(std::span<const std::vector<int>> groups) {
  if (groups.empty()) return {};
  std::unordered_set<int> others;
  for (const auto& group : groups.subspan(1)) others.insert(group.begin(), group.end());
  return filtered(groups.front(), [&](int member) { return !others.contains(member); });
}

std::vector<std::string> add_node_groups_of_all_cell_groups(Mesh& mesh) {
  std::vector<std::string> kept;
  for (const auto& [name, cells] : mesh.cell_groups) {
    const std::vector<int> nodes = mesh.nodes_of_cells(cells);
    const auto [group, is_new] = mesh.node_groups.try_emplace(name, nodes);
    if (is_new) continue;
    std::vector<int> existing = group->second;
    std::ranges::sort(existing);
    if (existing != nodes) kept.push_back(name);
  }
  return kept;
}

std::vector<int> nodes_of_cells(const Mesh& mesh, std::span<const int> cells, NodeRole role) {
  std::vector<bool> chosen(mesh.nodes.size(), false);
  for (const int cell : cells) {
    const auto nodes = mesh.cell(cell);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (plays(mesh.cell_types[cell], static_cast<int>(i), role)) chosen[static_cast<std::size_t>(nodes[i])] = true;
    }
  }
  std::vector<int> result;
  for (int node = 0; node < mesh.node_count(); ++node) {
    if (chosen[static_cast<std::size_t>(node)]) result.push_back(node);
  }
  return result;
}

std::vector<int> cells_on_nodes(const Mesh& mesh, std::span<const int> nodes, NodeCriterion criterion) {
  std::vector<bool> chosen(mesh.nodes.size(), false);
  for (const int node : nodes) chosen[static_cast<std::size_t>(node)] = true;
  std::vector<int> result;
  for (int cell = 0; cell < mesh.cell_count(); ++cell) {
    auto own = mesh.cell(cell);
    if (criterion == NodeCriterion::corners)
      own = own.first(static_cast<std::size_t>(corner_count(mesh.cell_types[cell])));
    const auto hits = std::ranges::count_if(own, [&](int node) { return chosen[static_cast<std::size_t>(node)]; });
    const auto size = static_cast<std::ptrdiff_t>(own.size());
    const bool wanted = criterion == NodeCriterion::any        ? hits > 0
                        : criterion == NodeCriterion::majority ? 2 * hits >= size
                                                               : hits == size;
    if (wanted) result.push_back(cell);
  }
  return result;
}

std::vector<int> cells_with_normal(const Mesh& mesh, const Point& direction, double angle, bool either_sense) {
  const Vector wanted = unit(to_vector(direction));
  std::vector<int> result;
  for (int cell = 0; cell < mesh.cell_count(); ++cell) {
    if (const int own = dimension(mesh.cell_types[cell]); own != 2 && own != mesh.dimension - 1) continue;
    const Vector normal = normal_of(mesh, cell);
    const double along = wanted.dot(normal);
    const double between = std::atan2(wanted.cross(normal).norm(), either_sense ? std::abs(along) : along);
    if (between <= angle) result.push_back(cell);
  }
  return result;
}

std::vector<int> nodes_in_ball(const Mesh& mesh, const Point& centre, double radius) {
  return nodes_where(mesh, [&](const Vector& position) { return (position - to_vector(centre)).norm() <= radius; });
}

std::vector<int> nodes_on_sphere(const Mesh& mesh, const Point& centre, double radius, double tolerance) {
  return nodes_where(mesh, [&](const Vector& position) {
    return std::abs((position - to_vector(centre)).norm() - radius) <= tolerance;
  });
}

std::vector<int> nodes_in_cylinder(const Mesh& mesh, const Point& point, const Point& axis, double radius) {
  const Vector direction = unit(to_vector(axis));
  return nodes_where(mesh, [&](const Vector& position) {
    return distance_from_axis(position, to_vector(point), direction) <= radius;
  });
}

std::vector<int> nodes_on_cylinder(const Mesh& mesh, const Point& point, const Point& axis, double radius,
                                   double tolerance) {
  const Vector direction = unit(to_vector(axis));
  return nodes_where(mesh, [&](const Vector& position) {
    return std::abs(distance_from_axis(position, to_vector(point), direction) - radius) <= tolerance;
  });
}

std::vector<int> nodes_on_plane(const Mesh& mesh, const Point& point, const Point& normal, double tolerance) {
  const Vector direction = unit(to_vector(normal));
  return nodes_where(
      mesh, [&](const Vector& position) { return std::abs(direction.dot(position - to_vector(point))) <= tolerance; });
}

double distance(const Point& a, const Point& b) { return (to_vector(a) - to_vector(b)).norm(); }

std::vector<int> nodes_along_segment(const Mesh& mesh, std::span<const int> nodes, int start, int end,
                                     double tolerance) {
  const Vector origin = place(mesh, start);
  const Vector chord = place(mesh, end) - origin;
  const Vector direction = unit(chord);
  std::vector<std::pair<double, int>> places;
  for (const int node : nodes) {
    const Vector position = place(mesh, node);
    const double off = distance_from_axis(position, origin, direction);
    if (off > tolerance) {
      throw Error("not-a-line",
                  fmt::format("node {} is {:g} off the line from {} to {}, more than the tolerance {:g}",
                              mesh.node_name(node), off, mesh.node_name(start), mesh.node_name(end), tolerance));
    }
    places.emplace_back(direction.dot(position - origin), node);
  }
  std::ranges::sort(places);
  std::vector<int> result;
  for (const auto& [distance, node] : places) result.push_back(node);
  return result;
}

}  // namespace comma::solver
