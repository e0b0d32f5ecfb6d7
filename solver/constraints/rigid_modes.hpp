// The space of rigid motions of a set of degrees of freedom, and the motions in it that cost no energy.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <Eigen/Dense>

#include "solver/constraints/elimination.hpp"
#include "solver/linear/linear_solver.hpp"
#include "solver/mesh/mesh.hpp"
#include "solver/model/model.hpp"

namespace comma::solver {

/// A rigid motion u(x) = translation + rotation x (x - centre).
struct RigidMotion {
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
  Eigen::Vector3d rotation = Eigen::Vector3d::Zero();
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  bool anywhere = false;  ///< the axis may lie anywhere: the translations across it are free as well

  bool is_rotation() const;
  /// "translation along Y", "translation along (0.6, 0.8)", "rotation about Z", "rotation about (0, 0.6, 0.8) through
  /// (1, 2, 3)".
  std::string text(int dimension) const;
};

/// The free rigid motions of a part: `unknowns` are its rows of the reduced stiffness. A rigid motion must also be one
/// of the nodes that follow by way of the conditions. Motions along and about the axes come first, where they are free.
/// A motion q is free when n q.Kq <= tolerance max|K_ii| q.q, n the number of unknowns: the left side is about the
/// stiffness of the support that holds it.
std::vector<RigidMotion> free_rigid_motions(const Mesh& mesh, const DofMap& dofs, const Elimination& elimination,
                                            const SymmetricMatrix& stiffness, std::span<const int> unknowns,
                                            double tolerance);

/// The nodes that move when the unknowns of a part do, by way of the conditions too; rising.
std::vector<int> nodes_moved(const DofMap& dofs, const Elimination& elimination, std::span<const int> unknowns);

}  // namespace comma::solver
