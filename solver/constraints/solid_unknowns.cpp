#include "solver/constraints/solid_unknowns.hpp"

#include <algorithm>
#include <array>

#include "solver/mesh/disjoint_sets.hpp"

namespace comma::solver {
namespace {

/// A face by its three smallest corners, which no other face of a sound mesh shares.
struct Face {
  std::array<int, 3> corners;
  int cell;

  bool operator<(const Face& other) const { return corners < other.corners; }
};

void add_faces(const Mesh& mesh, int cell, std::vector<Face>& faces) {
  const auto nodes = mesh.cell(cell);
  for (const BoundaryFacet& facet : boundary_facets(mesh.cell_types[cell])) {
    std::array<int, 4> corners{};
    const int count = corner_count(facet.type);
    for (int k = 0; k < count; ++k) corners[k] = nodes[facet.nodes[k]];
    std::sort(corners.begin(), corners.begin() + count);
    faces.push_back({{corners[0], corners[1], corners[2]}, cell});
  }
}

/// The cells of the solid; empty where any cell carries another element.
std::vector<int> solid_cells(const Model& model) {
  std::vector<int> cells;
  for (int cell = 0; cell < model.mesh->cell_count(); ++cell) {
    if (model.components_of(cell) == 0 || model.is_skin(cell)) continue;
    if (model.formulations[cell] != Formulation::solid) return {};
    cells.push_back(cell);
  }
  return cells;
}

bool hang_together(const Mesh& mesh, const std::vector<int>& cells) {
  std::vector<Face> faces;
  for (const int cell : cells) add_faces(mesh, cell, faces);
  std::sort(faces.begin(), faces.end());
  DisjointSets sets(mesh.cell_count());
  for (std::size_t k = 1; k < faces.size(); ++k)
    if (faces[k].corners == faces[k - 1].corners) sets.join(faces[k].cell, faces[k - 1].cell);
  return std::ranges::all_of(cells, [&](int cell) { return sets.root(cell) == sets.root(cells.front()); });
}

}  // namespace

std::shared_ptr<const SolidUnknowns> solid_unknowns(const Model& model, const DofMap& dofs,
                                                    const Elimination& elimination) {
  const Mesh& mesh = *model.mesh;
  const std::vector<int> cells = solid_cells(model);
  if (cells.empty() || !hang_together(mesh, cells)) return nullptr;
  auto result = std::make_shared<SolidUnknowns>();
  std::vector<int> number(static_cast<std::size_t>(mesh.node_count()), -1);
  for (const int dof : elimination.kept()) {
    const int node = dofs.node_of(dof);
    if (number[node] < 0) {
      number[node] = static_cast<int>(result->places.size());
      result->places.emplace_back(mesh.nodes[node][0], mesh.nodes[node][1], mesh.nodes[node][2]);
    }
    result->nodes.push_back(number[node]);
    result->axes.push_back(static_cast<int>(dofs.component_of(dof)));
  }
  return result;
}

}  // namespace comma::solver
