// The compliance seen by inequality rows: S = A K^-1 A^T, computed column by column as rows become active.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include <Eigen/Dense>
#include <Eigen/Sparse>

namespace comma::solver {

using RowMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// A column costs one solve with K and is then kept: over all steps that share the stiffness and the rows, a row that is
/// active again is free. Once rows have changed (geometry updates turn normals and shift weights), what is kept is the
/// compliance C = K^-1 between the unknowns that rows can touch, the support: S = A C A^T then follows for any rows without
/// another solve. S is in unknown / multiplier (a length a force, for contact).
class SchurComplement {
 public:
  /// Overwrites the columns (n x k) by K^-1 times them.
  using ApplyInverse = std::function<void(Eigen::Ref<Eigen::MatrixXd>)>;

  /// `rows`: A, m x n. `support`: unknowns, rising; rows on others are taken, but cost a solve whenever they change.
  SchurComplement(RowMatrix rows, ApplyInverse inverse, std::vector<int> support = {});

  int size() const { return static_cast<int>(rows_.rows()); }
  const RowMatrix& rows() const { return rows_; }

  /// Makes the columns of these rows known, those that are not yet in batches of `batch_size` right-hand sides.
  void require(std::span<const int> indices);
  /// Column of S (m); it must have been required.
  const Eigen::VectorXd& column(int index) const;
  bool known(int index) const { return columns_[index].size() != 0 || size() == 0; }

  /// Takes other rows. Columns are kept when the rows are the same to the last bit, which they are as long as pairing
  /// finds the same places on flat facets.
  void replace_rows(RowMatrix rows);
  /// Forgets columns and compliance, as after a new factorisation.
  void forget();

  /// Memory held while columns are computed: this many right-hand sides at once.
  static constexpr int batch_size = 32;
  /// The compliance is kept up to this many unknowns (128 MB); beyond, changed rows are solved for again.
  static constexpr std::size_t largest_support = 4000;

 private:
  void solve_rows(const std::vector<int>& missing);
  bool build_from_compliance(const std::vector<int>& missing);
  int support_index(int unknown) const;

  RowMatrix rows_;
  ApplyInverse inverse_;
  std::vector<Eigen::VectorXd> columns_;
  std::vector<int> support_;
  std::vector<Eigen::VectorXd> compliance_;  ///< one an unknown of the support: its column of C over the support, or empty
  bool rows_change_ = false;
};

}  // namespace comma::solver
