// The inverse of the linearised contact of a surface, as it is seen from near each point.
#pragma once

#include <vector>

#include <Eigen/Dense>

#include "solver/unilateral/schur_complement.hpp"

namespace comma::solver {

/// What a point that lies on a node, or a spring, has of A_f f + A_d S f = b, block by block.
struct ForceBlock {
  int place = 0;                                       ///< of its first force among the unknown ones
  int row = 0;                                         ///< of S, the first
  int size = 1;                                        ///< rows and forces
  Eigen::Matrix3d by_force = Eigen::Matrix3d::Zero();  ///< A_f
  Eigen::Matrix3d by_jump = Eigen::Matrix3d::Zero();   ///< A_d
};

/// The compliance of a surface falls off with the distance, and so does the inverse: its rows at a point are nearly
/// those of the inverse of A_f + A_d S on the point and its nearest neighbours alone (the mesh-neighbour preconditioner
/// of dense systems: Vavasis, SIAM Journal on Matrix Analysis and Applications 13, 1992). Neighbours are those that a
/// force along the first row moves most. What neither the blocks around a point nor S have changed much is kept.
class NearInverse {
 public:
  /// `blocks` cover all unknown forces; columns of S of their rows are known.
  void update(const SchurComplement& schur, std::vector<ForceBlock> blocks);
  Eigen::VectorXd operator()(const Eigen::VectorXd& b) const;

  /// Beside the block: two rings of nodes on a regular grid. With 12, products are five times as many where cells are
  /// higher than wide.
  static constexpr int neighbours = 24;

 private:
  /// Of the inverse, at a block.
  struct Rows {
    std::vector<int> near;   ///< blocks
    Eigen::MatrixXd values;  ///< its size x forces of those blocks
  };

  std::vector<int> nearest(const SchurComplement& schur, int block) const;
  Eigen::MatrixXd inverse_rows(const SchurComplement& schur, int block) const;

  std::vector<ForceBlock> blocks_;
  std::vector<Rows> rows_;
  long version_ = -1;  ///< of S
};

}  // namespace comma::solver
