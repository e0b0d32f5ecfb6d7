// Entries of rows over the displacements of contact surfaces.
#pragma once

#include <vector>

#include <Eigen/Dense>
#include <Eigen/SparseCore>

#include "solver/model/model.hpp"

namespace comma::solver {

/// Keeps references to its arguments.
class RowEntries {
 public:
  RowEntries(const Mesh& mesh, const DofMap& dofs) : mesh_(mesh), dofs_(dofs) {}

  /// What a row takes of the displacement of a node; nothing along an axis whose coefficient is 0. Throws Error
  /// `unknown-dof` where the node lacks a displacement that is asked for.
  void add(int row, int node, const Eigen::Vector3d& coefficients);

  /// `rows` x all degrees of freedom.
  Eigen::SparseMatrix<double, Eigen::RowMajor> matrix(Eigen::Index rows) const;

 private:
  const Mesh& mesh_;
  const DofMap& dofs_;
  std::vector<Eigen::Triplet<double>> entries_;
};

}  // namespace comma::solver
