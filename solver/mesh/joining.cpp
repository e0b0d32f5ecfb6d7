#include "solver/mesh/joining.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <unordered_set>

#include <fmt/format.h>

#include "solver/error.hpp"
#include "solver/mesh/groups.hpp"
#include "solver/mesh/nearest_node.hpp"
#include "solver/mesh/place.hpp"

namespace comma::solver {

namespace {

double shortest_distance(const Mesh& mesh) {
  double shortest = std::numeric_limits<double>::infinity();
  for (int cell = 0; cell < mesh.cell_count(); ++cell) {
    const auto nodes = mesh.cell(cell);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const double apart = distance(mesh.nodes[nodes[i]], mesh.nodes[nodes[j]]);
        if (apart > 0.0) shortest = std::min(shortest, apart);
      }
    }
  }
  return shortest;
}

/// Where the parts of one mesh come to stand in the other; -1: nowhere.
struct Places {
  std::vector<int> nodes, cells;
};

void append_cells(Mesh& target, const Mesh& source, std::span<const int> left_out, Places& places) {
  std::vector<char> gone(static_cast<std::size_t>(source.cell_count()), 0);
  for (const int cell : left_out) gone[static_cast<std::size_t>(cell)] = 1;
  std::vector<int> nodes;
  for (int cell = 0; cell < source.cell_count(); ++cell) {
    places.cells.push_back(-1);
    if (gone[static_cast<std::size_t>(cell)]) continue;
    nodes.clear();
    for (const int node : source.cell(cell)) nodes.push_back(places.nodes[static_cast<std::size_t>(node)]);
    places.cells.back() = target.add_cell(source.cell_types[cell], nodes);
  }
}

std::string free_name(const Groups& groups, const std::string& name) {
  if (!groups.contains(name)) return name;
  int number = 2;
  while (groups.contains(fmt::format("{}_{}", name, number))) ++number;
  return fmt::format("{}_{}", name, number);
}

/// Groups that lose all of their members go.
void append_groups(Groups& target, const Groups& source, const std::vector<int>& places,
                   std::vector<std::pair<std::string, std::string>>& renamed) {
  for (const auto& [name, members] : source) {
    std::vector<int> kept;
    std::unordered_set<int> seen;
    for (const int member : members) {
      const int place = places[static_cast<std::size_t>(member)];
      if (place >= 0 && seen.insert(place).second) kept.push_back(place);
    }
    if (kept.empty()) continue;
    const std::string own = free_name(target, name);
    if (own != name) renamed.emplace_back(name, own);
    target.try_emplace(own, std::move(kept));
  }
}

/// Patches that lose a face go.
void append_patches(Mesh& target, const Mesh& source, const std::vector<int>& places) {
  for (const auto& patch : source.slave_patches) {
    std::vector<int> faces;
    for (const int face : patch) faces.push_back(places[static_cast<std::size_t>(face)]);
    if (std::ranges::find(faces, -1) == faces.end()) target.slave_patches.push_back(std::move(faces));
  }
}

/// `partners`: the node of the first mesh that stands for each of the second's, -1 for most.
JoinedMesh joined(const Mesh& first, const Mesh& second, const std::vector<int>& partners,
                  std::span<const int> first_gone) {
  JoinedMesh result;
  Mesh& mesh = result.mesh;
  mesh.dimension = std::max(first.dimension, second.dimension);
  mesh.nodes = first.nodes;
  mesh.nodes.insert(mesh.nodes.end(), second.nodes.begin(), second.nodes.end());
  leave_plane(mesh);
  Places here, there;
  here.nodes.resize(first.nodes.size());
  std::iota(here.nodes.begin(), here.nodes.end(), 0);
  for (int node = 0; node < second.node_count(); ++node) {
    const int partner = partners[static_cast<std::size_t>(node)];
    there.nodes.push_back(partner >= 0 ? partner : first.node_count() + node);
  }
  append_cells(mesh, first, first_gone, here);
  append_cells(mesh, second, {}, there);
  append_groups(mesh.node_groups, first.node_groups, here.nodes, result.renamed);
  append_groups(mesh.cell_groups, first.cell_groups, here.cells, result.renamed);
  append_groups(mesh.node_groups, second.node_groups, there.nodes, result.renamed);
  append_groups(mesh.cell_groups, second.cell_groups, there.cells, result.renamed);
  append_patches(mesh, first, here.cells);
  append_patches(mesh, second, there.cells);
  return result;
}

}  // namespace

JoinedMesh superposed(const Mesh& first, const Mesh& second) {
  return joined(first, second, std::vector<int>(second.nodes.size(), -1), {});
}

JoinedMesh glued(const Mesh& first, const Mesh& second, std::span<const int> first_cells,
                 std::span<const int> second_cells) {
  const double reach = gluing_tolerance * std::min(shortest_distance(first), shortest_distance(second));
  const NearestNode nearest(first, first.nodes_of_cells(first_cells));
  std::vector<int> partners(second.nodes.size(), -1);
  for (const int node : second.nodes_of_cells(second_cells)) {
    const int partner = nearest(place(second, node), reach);
    partners[static_cast<std::size_t>(node)] = partner;
    if (partner >= 0) continue;
    throw Error(
        "not-coincident",
        fmt::format(
            "node {} of the second mesh lies on no node of the first mesh's group: the nearest must be within {:.3g}",
            second.node_name(node), reach),
        "glue groups whose nodes coincide");
  }
  return joined(first, second, partners, first_cells);
}

}  // namespace comma::solver
