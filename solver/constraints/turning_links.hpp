// Rigid bodies of nodes in large rotations (LIAISON_SOLIDE with TYPE_CHARGE='SUIV', U4.51.03).
#pragma once

#include <span>
#include <vector>

#include <Eigen/Dense>

#include "solver/loads/load.hpp"
#include "solver/model/model.hpp"

namespace comma::solver {

/// The displacements that a rigid body may have are no linear space: at displacements u the relations are those of
/// small motions from the rigid motion that is nearest to u, in the sense of least squares over the nodes (Kabsch, Acta
/// Crystallographica A 32, 1976). Newton's method that takes them anew after each correction arrives at a rigid motion,
/// which it misses by the square of the last correction.
class TurningLinks {
 public:
  /// Keeps references to its arguments. Throws Error `unsupported` naming a node with rotations.
  TurningLinks(const Mesh& mesh, const DofMap& dofs, std::span<const RigidLink> links);

  bool empty() const { return links_.empty(); }
  std::vector<LinearRelation> at(const Eigen::VectorXd& u) const;
  /// How far a node is from the nearest rigid motion at most, as a share of the size of its body.
  double violation(const Eigen::VectorXd& u) const;

 private:
  std::vector<Eigen::Vector3d> initial_places(const RigidLink& link) const;
  std::vector<Eigen::Vector3d> nearest_places(const RigidLink& link, std::span<const Eigen::Vector3d> initial,
                                              const Eigen::VectorXd& u) const;

  const Mesh& mesh_;
  const DofMap& dofs_;
  std::span<const RigidLink> links_;
};

}  // namespace comma::solver
