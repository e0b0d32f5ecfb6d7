#include "solver/mesh/boundary.hpp"

#include <Eigen/Dense>
#include <algorithm>

namespace comma::solver {
namespace {

using Vector = Eigen::Vector3d;

const BoundaryFacet& facet_of(const Mesh& mesh, CellFacet facet) {
  return boundary_facets(mesh.cell_types[facet.cell])[static_cast<std::size_t>(facet.facet)];
}

/// Coordinates from the cell's first node, so that the distance of the cell from the origin costs no digits.
Vector relative(const Mesh& mesh, int node, int origin) {
  return Vector(mesh.nodes[node].data()) - Vector(mesh.nodes[origin].data());
}

/// Six times the volume between a facet and the origin: the facet is cut into triangles from the mean of its corners,
/// so that neighbours cut a warped face alike.
double six_cone_volumes(const Mesh& mesh, std::span<const int> nodes, const BoundaryFacet& facet) {
  const int corners = corner_count(facet.type);
  std::array<Vector, 4> points;
  Vector middle = Vector::Zero();
  for (int i = 0; i < corners; ++i) {
    points[i] = relative(mesh, nodes[facet.nodes[i]], nodes[0]);
    middle += points[i] / corners;
  }
  double sum = 0.0;
  for (int i = 0; i < corners; ++i) sum += middle.dot(points[i].cross(points[(i + 1) % corners]));
  return sum;
}

double signed_area(const Mesh& mesh, std::span<const int> nodes, int corners) {
  double twice = 0.0;
  for (int i = 0; i < corners; ++i) {
    const Vector a = relative(mesh, nodes[i], nodes[0]);
    const Vector b = relative(mesh, nodes[(i + 1) % corners], nodes[0]);
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return twice / 2.0;
}

}  // namespace

std::size_t FacetKeyHash::operator()(const FacetKey& key) const {
  std::size_t hash = 0;
  for (const int node : key) hash = hash * 1000003u + static_cast<std::size_t>(node + 1);
  return hash ^ (hash >> 17);
}

FacetKey facet_key(const Mesh& mesh, CellFacet facet) {
  const BoundaryFacet& local = facet_of(mesh, facet);
  const auto nodes = mesh.cell(facet.cell);
  const int corners = corner_count(local.type);
  FacetKey key = {-1, -1, -1, -1};
  for (int i = 0; i < corners; ++i) key[i] = nodes[local.nodes[i]];
  std::ranges::sort(key);
  return key;
}

FacetKey facet_key(const Mesh& mesh, int cell) {
  const auto nodes = mesh.cell(cell);
  const int corners = std::min(corner_count(mesh.cell_types[cell]), 4);
  FacetKey key = {-1, -1, -1, -1};
  std::copy_n(nodes.begin(), corners, key.begin());
  std::ranges::sort(key);
  return key;
}

std::vector<int> nodes_of_facet(const Mesh& mesh, CellFacet facet) {
  const BoundaryFacet& local = facet_of(mesh, facet);
  const auto nodes = mesh.cell(facet.cell);
  std::vector<int> result(static_cast<std::size_t>(node_count(local.type)));
  for (std::size_t i = 0; i < result.size(); ++i) result[i] = nodes[local.nodes[i]];
  return result;
}

FacetMap map_facets(const Mesh& mesh, std::span<const int> cells) {
  FacetMap map;
  for (const int cell : cells) {
    const int facets = static_cast<int>(boundary_facets(mesh.cell_types[cell]).size());
    for (int facet = 0; facet < facets; ++facet) map[facet_key(mesh, {cell, facet})].push_back({cell, facet});
  }
  return map;
}

std::vector<CellFacet> boundary_of(const Mesh& mesh, std::span<const int> cells) {
  const FacetMap map = map_facets(mesh, cells);
  std::vector<CellFacet> result;
  for (const auto& [key, owners] : map) {
    if (owners.size() == 1) result.push_back(owners.front());
  }
  std::ranges::sort(result,
                    [](CellFacet a, CellFacet b) { return a.cell != b.cell ? a.cell < b.cell : a.facet < b.facet; });
  return result;
}

double signed_size(const Mesh& mesh, int cell) {
  const CellType type = mesh.cell_types[cell];
  const auto nodes = mesh.cell(cell);
  if (dimension(type) == 2) return signed_area(mesh, nodes, corner_count(type));
  double sum = 0.0;
  if (dimension(type) == 3) {
    for (const BoundaryFacet& facet : boundary_facets(type)) sum += six_cone_volumes(mesh, nodes, facet);
  }
  return sum / 6.0;
}

}  // namespace comma::solver
