// Smoothed aggregation for elastic solids: a preconditioner whose quality does not depend on the mesh size.
#pragma once

#include <memory>
#include <vector>

#include <Eigen/Dense>

#include "solver/linear/linear_solver.hpp"

namespace comma::solver {

/// A V-cycle of smoothed aggregation (Vanek, Mandel, Brezina, Computing 56, 1996): aggregates of nodes, each moving as
/// a rigid body on the coarse grid; prolongators smoothed by one damped Jacobi step; block Gauss-Seidel forwards before
/// and backwards after the coarse correction, so that the cycle is symmetric; a dense factor on the coarsest grid.
class Multigrid {
 public:
  /// `matrix`: lower triangle, positive definite. `places`: the node of each of its rows.
  Multigrid(const SymmetricMatrix& matrix, const SolidUnknowns& places);
  ~Multigrid();
  Multigrid(const Multigrid&) = delete;
  Multigrid& operator=(const Multigrid&) = delete;

  /// False where the coarsest grid's matrix is not positive definite: nothing else of this class may be used then.
  bool usable() const;

  /// The sizes below count padded unknowns: three for each node.
  Eigen::Index size() const;
  Eigen::VectorXd padded(const Eigen::Ref<const Eigen::VectorXd>& x) const;
  Eigen::VectorXd unpadded(const Eigen::VectorXd& x) const;
  /// y = A x.
  void multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const;
  /// x = one cycle's approximation of A^-1 b.
  void precondition(const Eigen::VectorXd& b, Eigen::VectorXd& x);

 private:
  struct Hierarchy;
  std::unique_ptr<Hierarchy> hierarchy_;
};

}  // namespace comma::solver
