// Where displacements bring the nodes of a mesh.
#pragma once

#include <vector>

#include <Eigen/Dense>

#include "solver/model/model.hpp"

namespace comma::solver {

/// DX, DY, DZ of a node (m) in displacements u (one a degree of freedom); 0 where the node has none.
Eigen::Vector3d displacement_of(int node, const Eigen::VectorXd& u, const DofMap& dofs);

/// The place of each node of the mesh (m) when it is displaced by u.
std::vector<Eigen::Vector3d> positions_at(const Eigen::VectorXd& u, const Mesh& mesh, const DofMap& dofs);

}  // namespace comma::solver
