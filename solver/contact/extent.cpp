#include "solver/contact/extent.hpp"

#include "solver/mesh/box_tree.hpp"

namespace comma::solver {

double extent(const Mesh& mesh, std::span<const int> cells) {
  Box box;
  for (const int cell : cells)
    for (const int node : mesh.cell(cell))
      box.extend(Eigen::Vector3d(mesh.nodes[node][0], mesh.nodes[node][1], mesh.nodes[node][2]));
  return box.diagonal().norm();
}

double extent(const Mesh& mesh) {
  Box box;
  for (const Point& node : mesh.nodes) box.extend(Eigen::Vector3d(node[0], node[1], node[2]));
  return box.diagonal().norm();
}

}  // namespace comma::solver
