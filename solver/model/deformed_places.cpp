#include "solver/model/deformed_places.hpp"

#include <array>

namespace comma::solver {

Eigen::Vector3d displacement_of(int node, const Eigen::VectorXd& u, const DofMap& dofs) {
  constexpr std::array<Component, 3> translations = {Component::dx, Component::dy, Component::dz};
  Eigen::Vector3d result = Eigen::Vector3d::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    const int dof = dofs.dof(node, translations[static_cast<std::size_t>(axis)]);
    if (dof >= 0) result[axis] = u[dof];
  }
  return result;
}

std::vector<Eigen::Vector3d> positions_at(const Eigen::VectorXd& u, const Mesh& mesh, const DofMap& dofs) {
  std::vector<Eigen::Vector3d> positions;
  positions.reserve(static_cast<std::size_t>(mesh.node_count()));
  for (int node = 0; node < mesh.node_count(); ++node)
    positions.push_back(Eigen::Vector3d(mesh.nodes[static_cast<std::size_t>(node)].data()) +
                        displacement_of(node, u, dofs));
  return positions;
}

}  // namespace comma::solver
