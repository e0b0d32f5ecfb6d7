#include "reference_cells.hpp"

#include <array>
#include <cstddef>

namespace comma::solver::tests {
namespace {

using enum CellType;
using Edges = std::vector<std::array<int, 2>>;
using Faces = std::vector<std::array<int, 4>>;

std::vector<Vector> corners_of(CellType type) {
  switch (corner_count(type) * 10 + dimension(type)) {
    case 10: return {{0, 0, 0}};
    case 21: return {{-1, 0, 0}, {1, 0, 0}};
    case 32: return {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    case 42: return {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    case 43: return {{0, 1, 0}, {0, 0, 1}, {0, 0, 0}, {1, 0, 0}};
    case 53: return {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}};
    case 63: return {{-1, 1, 0}, {-1, 0, 1}, {-1, 0, 0}, {1, 1, 0}, {1, 0, 1}, {1, 0, 0}};
    default: return {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}};
  }
}

Edges edges_of(CellType type) {
  switch (type) {
    case seg3: return {{0, 1}};
    case tria6:
    case tria7: return {{0, 1}, {1, 2}, {2, 0}};
    case quad8:
    case quad9: return {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
    case tetra10: return {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}};
    case pyram13: return {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 4}, {2, 4}, {3, 4}};
    case penta15:
    case penta18: return {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 4}, {2, 5}, {3, 4}, {4, 5}, {5, 3}};
    case hexa20:
    case hexa27:
      return {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 5}, {2, 6}, {3, 7}, {4, 5}, {5, 6}, {6, 7}, {7, 4}};
    default: return {};
  }
}

Faces faces_of(CellType type) {
  if (type == penta18) return {{0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}};
  if (type == hexa27) return {{0, 1, 2, 3}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}, {4, 5, 6, 7}};
  return {};
}

bool has_centre(CellType type) { return type == tria7 || type == quad9 || type == hexa27; }

}  // namespace

std::vector<Vector> reference_nodes(CellType type) {
  std::vector<Vector> points = corners_of(type);
  if (type == seg4) {
    points.insert(points.end(), {Vector(-1.0 / 3.0, 0, 0), Vector(1.0 / 3.0, 0, 0)});
    return points;
  }
  for (const auto& [a, b] : edges_of(type)) points.push_back(Vector(0.5 * (points[a] + points[b])));
  for (const auto& [a, b, c, d] : faces_of(type)) {
    points.push_back(Vector(0.25 * (points[a] + points[b] + points[c] + points[d])));
  }
  if (has_centre(type)) points.push_back(corner_mean(points, corner_count(type)));
  return points;
}

double reference_volume(CellType type) {
  switch (corner_count(type) * 10 + dimension(type)) {
    case 10: return 0.0;
    case 21: return 2.0;
    case 32: return 0.5;
    case 42: return 4.0;
    case 43: return 1.0 / 6.0;
    case 53: return 2.0 / 3.0;
    case 63: return 1.0;
    default: return 8.0;
  }
}

Vector corner_mean(std::span<const Vector> points, int corners) {
  Vector sum = Vector::Zero();
  for (int i = 0; i < corners; ++i) sum += points[i];
  return sum / corners;
}

Vector corner_mean(std::span<const Vector> points, const BoundaryFacet& facet) {
  Vector sum = Vector::Zero();
  const int corners = corner_count(facet.type);
  for (int i = 0; i < corners; ++i) sum += points[facet.nodes[i]];
  return sum / corners;
}

Vector area_vector(std::span<const Vector> points, const BoundaryFacet& facet) {
  const auto at = [&](int i) { return points[facet.nodes[i]]; };
  if (corner_count(facet.type) == 3) return 0.5 * (at(1) - at(0)).cross(at(2) - at(0));
  return 0.5 * (at(2) - at(0)).cross(at(3) - at(1));
}

Mesh mesh_of_reference_cells(double spacing) {
  Mesh mesh;
  for (int i = 0; i < cell_type_count; ++i) {
    const auto type = static_cast<CellType>(i);
    std::vector<int> nodes;
    for (const Vector& point : reference_nodes(type)) {
      nodes.push_back(mesh.node_count());
      mesh.nodes.push_back({point.x() + i * spacing, point.y(), point.z()});
    }
    mesh.add_cell(type, nodes);
  }
  return mesh;
}

double solid_volume(const Mesh& mesh, int cell) {
  std::vector<Vector> points;
  for (const int node : mesh.cell(cell)) points.push_back(Vector(mesh.nodes[node].data()));
  const Vector origin = points.front();
  for (Vector& point : points) point -= origin;
  double volume = 0.0;
  for (const BoundaryFacet& facet : boundary_facets(mesh.cell_types[cell])) {
    volume += area_vector(points, facet).dot(corner_mean(points, facet)) / 3.0;
  }
  return volume;
}

}  // namespace comma::solver::tests
