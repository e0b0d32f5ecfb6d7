// The numbers of controls are those of the "MUMPS 5.5.1 Users' guide", sections 5 and 6.
#include "solver/linear/mumps_solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <dmumps_c.h>
#include <fmt/format.h>

#include "solver/error.hpp"
#include "solver/linear/bordered_compliance.hpp"
#include "solver/linear/mumps_controls.hpp"
#include "solver/linear/refined_solver.hpp"
#include "solver/linear/shared_library.hpp"

namespace comma::solver {

namespace {

constexpr int job_analyse = 1;
constexpr int job_factorise = 2;
constexpr int job_solve = 3;

constexpr int error_workspace = -9;
constexpr int error_memory = -13;
constexpr int error_index_overflow = -51;
constexpr int first_extra_workspace = 30;   // per cent
constexpr int most_extra_workspace = 2000;  // a matrix that needs more delays nearly all its pivots

class MumpsSolver final : public RefinedSolver {
 public:
  explicit MumpsSolver(const LinearOptions& options) : RefinedSolver(options) {
    data_.par = 1;
    data_.sym = general_symmetric;
    data_.comm_fortran = whole_communicator;
    data_.job = job_initialise;
    mumps_(&data_);
    for (int stream = 1; stream <= 3; ++stream) control(stream) = -1;
    control(4) = 0;  // print nothing
    control(6) = 0;  // the matrix is scaled already, and the analysis must hold for other values of the same pattern
    control(8) = 0;
    control(12) = 1;
    control(13) = 1;  // the last front too counts its null pivots
    control(10) = 0;  // refinement is RefinedSolver's
    control(24) = 1;  // note null pivots and go on
  }

  ~MumpsSolver() override {
    data_.job = job_destroy;
    mumps_(&data_);
  }

  MumpsSolver(const MumpsSolver&) = delete;
  MumpsSolver& operator=(const MumpsSolver&) = delete;

  LinearMethod method() const override { return LinearMethod::mumps; }
  Eigen::MatrixXd compliance(const Eigen::SparseMatrix<double, Eigen::RowMajor>& rows) const override {
    return bordered_compliance(matrix(), rows);
  }
  bool factorises_for_compliance() const override { return true; }

 protected:
  void analyse_pattern(const SymmetricMatrix& matrix) override {
    rows_.clear();
    columns_.clear();
    for (int column = 0; column < matrix.outerSize(); ++column) {
      for (SymmetricMatrix::InnerIterator entry(matrix, column); entry; ++entry) {
        rows_.push_back(static_cast<int>(entry.row()) + 1);
        columns_.push_back(column + 1);
      }
    }
    data_.n = static_cast<int>(matrix.rows());
    data_.nnz = matrix.nonZeros();
    data_.irn = rows_.data();
    data_.jcn = columns_.data();
    data_.a = nullptr;
    control(14) = first_extra_workspace;
    run(job_analyse);
    check();
  }

  FactorReport factorise_scaled(const SymmetricMatrix& matrix, const Eigen::VectorXd& references) override {
    values_.assign(matrix.valuePtr(), matrix.valuePtr() + matrix.nonZeros());
    data_.a = values_.data();
    data_.cntl[2] = -null_threshold(references);
    run(job_factorise);
    while (data_.infog[0] == error_workspace && control(14) < most_extra_workspace) {
      control(14) *= 2;
      run(job_factorise);
    }
    check();
    return report();
  }

  /// The inverse's largest diagonal entry may belong to a row that was eliminated early, whose pivot lost less
  /// (ssna102a: 4 by the entry, 3 by pivots).
  int digits_above_pivots() const override { return 1; }

  void solve_scaled(Eigen::Ref<Eigen::MatrixXd> rhs) const override {
    data_.rhs = rhs.data();
    data_.nrhs = static_cast<int>(rhs.cols());
    data_.lrhs = static_cast<int>(rhs.outerStride());
    run(job_solve);
    check();
  }

 private:
  int& control(int number) const { return data_.icntl[number - 1]; }

  /// MUMPS knows one threshold for all rows; the smallest reference keeps it from calling a sound pivot null.
  /// References lie between 1/2 and 4, so some pivot may lose up to a digit more than `singular_digits` before it is
  /// noticed.
  double null_threshold(const Eigen::VectorXd& references) const {
    const double least = std::numeric_limits<double>::min();
    if (options().singular_digits < 0) return least;
    return std::max(least, references.minCoeff() * std::pow(10.0, -options().singular_digits - 1));
  }

  FactorReport report() {
    FactorReport result;
    const int null_pivots = data_.infog[27];
    const int negative_pivots = data_.infog[11];
    if (null_pivots > 0) {
      result.verdict = FactorVerdict::singular;
      result.null_rows.assign(data_.pivnul_list, data_.pivnul_list + null_pivots);
      for (int& row : result.null_rows) --row;
      std::sort(result.null_rows.begin(), result.null_rows.end());
      result.lost_digits = std::max(options().singular_digits, 0) + 1;
      return result;
    }
    if (negative_pivots > 0) result.verdict = FactorVerdict::indefinite;
    result.lost_digits = estimated_digits();
    return result;
  }

  /// The largest diagonal entry of the scaled inverse is one over the pivot of a row eliminated last. Two steps of
  /// inverse iteration from an irregular vector give the eigenvector v that dominates it, so the entry is about v_i^2 /
  /// (lambda v.v).
  int estimated_digits() const {
    constexpr double golden_section = 0.6180339887498949;  // its multiples fill the unit interval without a pattern
    constexpr int all = std::numeric_limits<double>::max_digits10;
    Eigen::MatrixXd probe(data_.n, 1);
    for (int row = 0; row < data_.n; ++row) probe(row, 0) = std::fmod(golden_section * (row + 1), 1.0) - 0.3;
    double entry = 0.0;
    for (int step = 0; step < 2; ++step) {
      const double size = probe.lpNorm<Eigen::Infinity>();
      if (!(size > 0.0 && std::isfinite(size))) return all;
      probe /= size;
      const double length = probe.squaredNorm();
      solve_scaled(probe);
      entry = probe.lpNorm<Eigen::Infinity>() / length;
    }
    return std::isfinite(entry) && entry > 0.0 ? std::clamp(static_cast<int>(std::floor(std::log10(entry))), 0, all)
                                               : all;
  }

  void run(int job) const {
    data_.job = job;
    mumps_(&data_);
  }

  void check() const {
    const int status = data_.infog[0];
    if (status >= 0) return;
    if (status == error_workspace || status == error_memory || status == error_index_overflow || status == -8 ||
        status == -19) {
      throw Error("out-of-memory", "the factors of the stiffness matrix do not fit into memory", "coarsen the mesh");
    }
    throw Error("linear-solver",
                fmt::format("MUMPS refuses the matrix (INFOG(1) = {}, INFOG(2) = {})", status, data_.infog[1]));
  }

  SharedLibrary library_{COMMA_MUMPS_LIBRARY};
  decltype(&dmumps_c) mumps_ = library_.function<decltype(dmumps_c)>("dmumps_c");
  mutable DMUMPS_STRUC_C data_{};
  std::vector<int> rows_, columns_;
  std::vector<double> values_;
};

}  // namespace

std::unique_ptr<LinearSolver> make_mumps_solver(const LinearOptions& options) {
  return std::make_unique<MumpsSolver>(options);
}

}  // namespace comma::solver
