// One instance of MUMPS, sequential and silent, for matrices that are scaled already.
#pragma once

#include <vector>

#include <dmumps_c.h>
#include <Eigen/Dense>
#include <Eigen/Sparse>

#include "solver/linear/blas_threads.hpp"
#include "solver/linear/shared_library.hpp"

namespace comma::solver {

/// What MUMPS may take for granted of a matrix: SYM of "MUMPS 5.5.1 Users' guide", section 5. It has another number for
/// a positive definite one, where it takes every pivot on trust.
enum class MumpsSymmetry { none = 0, general = 2 };

/// Sections and numbers are those of that guide.
class MumpsInstance {
 public:
  /// Throws Error `missing-library`.
  explicit MumpsInstance(MumpsSymmetry symmetry);
  ~MumpsInstance();
  MumpsInstance(const MumpsInstance&) = delete;
  MumpsInstance& operator=(const MumpsInstance&) = delete;

  /// ICNTL(number), CNTL(number).
  int& control(int number) { return data_.icntl[number - 1]; }
  double& threshold(int number) { return data_.cntl[number - 1]; }
  DMUMPS_STRUC_C& data() const { return data_; }
  const BlasThreads& threads() const { return threads_; }

  /// Symbolic analysis of a matrix with the pattern of this one; of a symmetric one, one triangle. Throws as check().
  void analyse(const Eigen::SparseMatrix<double>& matrix);
  /// Where a pivot counts as null that has lost more than `digits` decimal digits (none where negative) of what its
  /// row or column is measured against: MUMPS knows one threshold for all, and the smallest of the `references` (n)
  /// keeps it from calling a sound pivot null. References lie between 1/2 and 4, so some pivot may lose up to a digit
  /// more before it is noticed.
  void note_null_pivots(const Eigen::VectorXd& references, int digits);
  /// Numeric factorisation of the values of a matrix of the pattern analysed; null pivots are noted and passed over
  /// (ICNTL(24)), with more workspace where pivots were delayed. Throws as check().
  void factorise(const Eigen::SparseMatrix<double>& matrix);
  /// rhs: n x k, overwritten by the solution. Throws as check().
  void solve(Eigen::Ref<Eigen::MatrixXd> rhs) const;
  /// The rows behind the null pivots of the last factorisation, rising, from 0 on.
  std::vector<int> null_rows() const;

  void run(int job) const;
  /// Throws Error `out-of-memory` with `hint`, `linear-solver` where MUMPS refuses the matrix.
  void check(const char* hint = "coarsen the mesh") const;

 private:
  SharedLibrary library_{COMMA_MUMPS_LIBRARY};
  BlasThreads threads_{library_};
  decltype(&dmumps_c) mumps_ = library_.function<decltype(dmumps_c)>("dmumps_c");
  mutable DMUMPS_STRUC_C data_{};
  std::vector<int> rows_, columns_;
  std::vector<double> values_;
};

}  // namespace comma::solver
