#include "reference_cells.hpp"

namespace comma::solver::tests {

std::vector<Vector> reference_nodes(CellType type) {
  std::vector<Vector> points;
  for (const Point& point : reference_points(type)) points.push_back(Vector(point.data()));
  return points;
}

double reference_volume(CellType type) {
  switch (corner_count(type) * 10 + dimension(type)) {
    case 10:
      return 0.0;
    case 21:
      return 2.0;
    case 32:
      return 0.5;
    case 42:
      return 4.0;
    case 43:
      return 1.0 / 6.0;
    case 53:
      return 2.0 / 3.0;
    case 63:
      return 1.0;
    default:
      return 8.0;
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
    for (const Vector& point : tests::reference_nodes(type)) {
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
