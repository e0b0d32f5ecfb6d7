// The compliance seen by inequality rows: S = A K^-1 A^T, computed column by column as rows become active.
#pragma once

#include <algorithm>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Dense>
#include <Eigen/Sparse>

#include "solver/linear/dense_solve.hpp"
#include "solver/linear/row_matrix.hpp"

namespace comma::solver {

/// S F (rows x forces' unknowns): where S is kept as its factors A C A^T, so is this.
class Responses {
 public:
  explicit Responses(Eigen::MatrixXd whole) : moved_(std::move(whole)) {}
  /// A (C A^T F) and what the rows give way by themselves.
  Responses(RowMatrix rows, Eigen::MatrixXd moved, Eigen::SparseMatrix<double> own)
      : rows_(std::move(rows)), moved_(std::move(moved)), own_(std::move(own)) {}

  Eigen::VectorXd operator*(const Eigen::VectorXd& x) const;
  /// L times this.
  Eigen::MatrixXd weighed_by(const Eigen::SparseMatrix<double>& weights) const;
  Eigen::MatrixXd whole() const;

 private:
  bool has_factors() const { return rows_.rows() > 0; }

  RowMatrix rows_;  ///< A, or nothing: the identity
  Eigen::MatrixXd moved_;
  Eigen::SparseMatrix<double> own_;
};

/// A column costs one solve with K and is then kept: over all steps that share the stiffness and the rows, a row that
/// is active again is free. Rows change (geometry updates turn normals and shift weights), and so may K:
///  - where few unknowns are touched by rows (the support), what is kept is the compliance C = K^-1 between them: S = A
///  C A^T then
///    follows for any rows without another solve;
///  - where rows are many more than the unknowns they touch, as with many points a face, S is never made: its products
///  are those of A, C and A^T;
///  - where unknowns are many, S stays that of the earlier rows and stiffness: it is not exact any more, but so near
///  that whoever
///    corrects with it again, after a look at what is left, needs a few solves instead of one a row.
/// S is in unknown / multiplier (a length a force, for contact).
class SchurComplement {
 public:
  /// Overwrites the columns (n x k) by K^-1 times them.
  using ApplyInverse = std::function<void(Eigen::Ref<Eigen::MatrixXd>)>;
  /// The whole of S for these rows at once, or an empty matrix where that is no gain.
  using WholeCompliance = std::function<Eigen::MatrixXd(const RowMatrix& rows)>;

  /// `rows`: A, m x n. `support`: unknowns, rising; rows on others are taken, but cost a solve whenever they change.
  /// `keys`: what each row is about, all different, by which rows are known again when others take their place; empty:
  /// their numbers.
  SchurComplement(RowMatrix rows, ApplyInverse inverse, std::vector<int> support = {}, std::vector<int> keys = {});

  /// What rows give way by a unit of their multiplier, which is added to their own entries of S from now on: one a row,
  /// always the same for a key; empty: nothing. To be called before columns are asked for, and before other rows come.
  void soften(Eigen::VectorXd softness) { softness_ = std::move(softness); }

  /// Another way to many columns.
  void use_whole(WholeCompliance whole) { whole_ = std::move(whole); }

  int size() const { return static_cast<int>(rows_.rows()); }
  const RowMatrix& rows() const { return rows_; }

  /// Makes the columns of these rows known, those that are not yet in batches of `batch_size` right-hand sides.
  void require(std::span<const int> indices);
  using Column = Eigen::Map<const Eigen::VectorXd>;
  /// Column of S (m); it must have been required.
  Column column(int index) const;
  /// An entry of the diagonal; its column must have been required.
  double own(int index) const;
  /// S x (m); columns of entries that are not zero are required.
  Eigen::VectorXd times(const Eigen::VectorXd& x);
  /// The same to single precision, in half the time or less where all columns are known and many.
  Eigen::VectorXd times_roughly(const Eigen::VectorXd& x);
  /// S F between some rows (n), for forces F on these rows alone (n x k); their columns must have been required.
  Responses responses(const std::vector<int>& rows, const Eigen::SparseMatrix<double>& forces) const;
  /// C, where S = A C A^T is kept so and rows do not give way by themselves; otherwise null.
  const Eigen::MatrixXd* kept_compliance() const { return has_factors() && softness_.size() == 0 ? &factor_ : nullptr; }
  /// A of these rows over the support, where S is kept so.
  RowMatrix on_support(const std::vector<int>& rows) const;
  /// The entries on some rows of S x for an x on these rows alone (one a row).
  Eigen::VectorXd times_roughly(const std::vector<int>& rows, const Eigen::VectorXd& x);
  bool known(int index) const {
    return has_factors() || whole_matrix_.size() != 0 || columns_[index].size() != 0 || size() == 0;
  }

  /// Takes other rows. Columns are kept when the rows are the same to the last bit, which they are as long as pairing
  /// finds the same places on flat facets.
  void replace_rows(RowMatrix rows, std::vector<int> keys = {}, Eigen::VectorXd softness = {});
  /// After a new factorisation.
  void forget();

  /// Whether known columns are those of the present rows and stiffness.
  bool is_exact() const { return exact_; }
  /// Makes it so, at the price of all columns.
  void start_anew();
  /// The largest share of a change that rounds of corrections with these columns have left to the next one; 1 before
  /// any has been noted.
  double most_left() const { return most_left_.value_or(1.0); }
  void note_left(double share) { most_left_ = std::max(share, most_left_.value_or(0.0)); }
  /// Another one whenever a known entry may have changed, or its row's number.
  long version() const { return version_; }

  /// Memory held while columns are computed: this many right-hand sides at once.
  static constexpr int batch_size = 32;
  /// The compliance is kept up to this many unknowns (8 MB): beyond, its solves cost more than corrections with an
  /// earlier S.
  static constexpr std::size_t largest_support = 1000;
  /// Of as many columns products are made in single precision where that does.
  static constexpr int many_products = 2000;
  /// From this many columns on, if they are this share of all, the whole is asked for at once.
  static constexpr std::size_t many_columns = 100;
  static constexpr double many_share = 0.25;
  /// So many rows, and so many times as many as unknowns, are never multiplied out; nor are there more unknowns than so
  /// many (290 MB).
  static constexpr int factored_rows = 600;
  static constexpr double factored_share = 1.2;
  static constexpr std::size_t largest_factor = 6000;
  /// Of more unknowns than the compliance is kept of, columns are made one by one up to this share.
  static constexpr double few_columns = 0.25;

 private:
  bool keeps_compliance() const { return support_.size() <= largest_support; }
  bool has_columns() const;
  bool has_factors() const { return factor_.size() != 0; }
  void choose_form();
  bool replace_factored_rows(RowMatrix& rows, std::vector<int>& keys);
  void solve_factor();
  bool prefers_columns(std::span<const int> indices) const;
  Eigen::VectorXd times_factors(const Eigen::VectorXd& x) const;
  Eigen::VectorXd column_of_factors(int row) const;
  void take_columns(const std::vector<int>& origin);
  void clear();
  bool take_over(const RowMatrix& rows, const std::vector<int>& keys);
  void store(int row, Eigen::VectorXd column);
  Eigen::Map<Eigen::VectorXd> entries(int row);
  void complete_columns(const std::vector<int>& added);
  void solve_rows(const std::vector<int>& missing);
  bool solve_whole(const std::vector<int>& missing);
  bool build_from_compliance(const std::vector<int>& missing);
  int support_index(int unknown) const;

  RowMatrix rows_;
  RowMatrix source_;  ///< the rows of which S is made; empty: rows_
  std::vector<int> keys_;
  ApplyInverse inverse_;
  WholeCompliance whole_;
  mutable std::vector<Eigen::VectorXd> columns_;
  bool is_factored_ = false;
  RowMatrix on_support_;          ///< the rows over the support, where S is kept as its factors
  Eigen::MatrixXd factor_;        ///< C over the support, or nothing as yet
  Eigen::MatrixXd whole_matrix_;  ///< all columns, or none
  SingleTriangle single_;         ///< of whole_matrix_, or nothing
  Eigen::VectorXd softness_;
  std::vector<int> support_;
  /// One an unknown of the support: its column of C over the support, or empty.
  std::vector<Eigen::VectorXd> compliance_;
  bool rows_change_ = false;
  bool exact_ = true;
  std::optional<double> most_left_;
  long version_ = 0;
};

}  // namespace comma::solver
