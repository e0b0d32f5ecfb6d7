#include "solver/linear/cholmod_solver.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include <cholmod.h>

#include "solver/error.hpp"
#include "solver/linear/blas_threads.hpp"
#include "solver/linear/large_pages.hpp"
#include "solver/linear/quotient_pattern.hpp"
#include "solver/linear/refined_solver.hpp"
#include "solver/linear/shared_library.hpp"
#include "solver/linear/supernodal_compliance.hpp"

namespace comma::solver {

namespace {

/// CHOLMOD's loops over the entries of a front ask for four threads, whatever the machine has, and those that wait do
/// so at work: with one thread the same factorisation takes a fifth less time, and a third less of processors that
/// others share.
void keep_loops_single(const SharedLibrary& library) {
  if (auto* set_levels = library.function_if_any<void(int)>("omp_set_max_active_levels")) set_levels(0);
}

void use_large_pages(const SharedLibrary& library) {
  if (auto* memory = library.variable_if_any<SuiteSparse_config_struct>("SuiteSparse_config"))
    memory->malloc_func = allocate_in_large_pages;
}

struct Cholmod {
  Cholmod() {
    keep_loops_single(library);
    use_large_pages(library);
  }

  SharedLibrary library{COMMA_CHOLMOD_LIBRARY};
  decltype(&cholmod_start) start = library.function<decltype(cholmod_start)>("cholmod_start");
  decltype(&cholmod_finish) finish = library.function<decltype(cholmod_finish)>("cholmod_finish");
  decltype(&cholmod_analyze_p) analyse = library.function<decltype(cholmod_analyze_p)>("cholmod_analyze_p");
  decltype(&cholmod_factorize_p) factorise = library.function<decltype(cholmod_factorize_p)>("cholmod_factorize_p");
  decltype(&cholmod_solve) solve = library.function<decltype(cholmod_solve)>("cholmod_solve");
  decltype(&cholmod_free_factor) free_factor = library.function<decltype(cholmod_free_factor)>("cholmod_free_factor");
  decltype(&cholmod_free_dense) free_dense = library.function<decltype(cholmod_free_dense)>("cholmod_free_dense");
  BlasThreads threads{library};
};

/// From so many operations an entry of L on, and so many entries of L one of the matrix, nested dissection is tried
/// (CHOLMOD's own rule).
constexpr double dissected_operations = 500.0, dissected_fill = 5.0;

/// CHOLMOD's view of a lower triangle's pattern; it copies nothing and writes nothing.
cholmod_sparse view_of(std::size_t size, const int* column_starts, const int* rows) {
  cholmod_sparse view{};
  view.nrow = view.ncol = size;
  view.nzmax = static_cast<std::size_t>(column_starts[size]);
  view.p = const_cast<int*>(column_starts);
  view.i = const_cast<int*>(rows);
  view.stype = -1;
  view.itype = CHOLMOD_INT;
  view.xtype = CHOLMOD_PATTERN;
  view.dtype = CHOLMOD_DOUBLE;
  view.sorted = 1;
  view.packed = 1;
  return view;
}

cholmod_sparse view_of(const SymmetricMatrix& matrix) {
  cholmod_sparse view =
      view_of(static_cast<std::size_t>(matrix.rows()), matrix.outerIndexPtr(), matrix.innerIndexPtr());
  view.x = const_cast<double*>(matrix.valuePtr());
  view.xtype = CHOLMOD_REAL;
  return view;
}

SupernodalFactor view_of(const cholmod_factor& factor) {
  return {
      static_cast<int>(factor.n),           static_cast<int>(factor.nsuper),     static_cast<const int*>(factor.super),
      static_cast<const int*>(factor.pi),   static_cast<const int*>(factor.px),  static_cast<const int*>(factor.s),
      static_cast<const double*>(factor.x), static_cast<const int*>(factor.Perm)};
}

void read_supernodal_pivots(const cholmod_factor& factor, Eigen::VectorXd& pivots) {
  const auto* columns = static_cast<const int*>(factor.super);
  const auto* row_starts = static_cast<const int*>(factor.pi);
  const auto* value_starts = static_cast<const int*>(factor.px);
  const auto* values = static_cast<const double*>(factor.x);
  for (std::size_t node = 0; node < factor.nsuper; ++node) {
    const int rows = row_starts[node + 1] - row_starts[node];
    for (int k = 0; k < columns[node + 1] - columns[node]; ++k) {
      const double diagonal = values[value_starts[node] + k + k * rows];
      pivots[columns[node] + k] = diagonal * diagonal;
    }
  }
}

void read_simplicial_pivots(const cholmod_factor& factor, Eigen::VectorXd& pivots) {
  const auto* starts = static_cast<const int*>(factor.p);
  const auto* values = static_cast<const double*>(factor.x);
  for (Eigen::Index k = 0; k < pivots.size(); ++k) {
    const double diagonal = values[starts[k]];
    pivots[k] = factor.is_ll ? diagonal * diagonal : diagonal;
  }
}

Eigen::VectorXd pivots_by_row(const cholmod_factor& factor) {
  Eigen::VectorXd ordered(static_cast<Eigen::Index>(factor.n));
  if (factor.is_super)
    read_supernodal_pivots(factor, ordered);
  else
    read_simplicial_pivots(factor, ordered);
  const auto* order = static_cast<const int*>(factor.Perm);
  Eigen::VectorXd pivots(ordered.size());
  for (Eigen::Index k = 0; k < ordered.size(); ++k) pivots[order[k]] = ordered[k];
  return pivots;
}

class CholmodSolver final : public RefinedSolver {
 public:
  explicit CholmodSolver(const LinearOptions& options) : RefinedSolver(options) {
    cholmod_.start(&common_);
    common_.print = 0;
    common_.error_handler = nullptr;
  }

  ~CholmodSolver() override {
    cholmod_.free_factor(&factor_, &common_);
    cholmod_.free_factor(&indefinite_factor_, &common_);
    cholmod_.finish(&common_);
  }

  CholmodSolver(const CholmodSolver&) = delete;
  CholmodSolver& operator=(const CholmodSolver&) = delete;

  LinearMethod method() const override { return LinearMethod::cholmod; }

  Eigen::MatrixXd compliance(const Eigen::SparseMatrix<double, Eigen::RowMajor>& rows) const override {
    if (!current_ || !current_->is_super) return {};
    choose_threads();
    return supernodal_compliance(view_of(*current_), BlasKernels(cholmod_.library), rows * factors().asDiagonal());
  }

 protected:
  void analyse_pattern(const SymmetricMatrix& matrix) override {
    cholmod_.free_factor(&factor_, &common_);
    cholmod_.free_factor(&indefinite_factor_, &common_);
    order_ = least_filling_order(matrix);
    factor_ = symbolic_factor(matrix, CHOLMOD_AUTO);
    operations_ = common_.fl;
  }

  FactorReport factorise_scaled(const SymmetricMatrix& matrix, const Eigen::VectorXd& references) override {
    int digits = options().singular_digits;
    choose_threads();
    current_ = factor_;
    if (!factorised(matrix, 0.0)) {
      if (!indefinite_factor_) indefinite_factor_ = symbolic_factor(matrix, CHOLMOD_SIMPLICIAL);
      current_ = indefinite_factor_;
      if (!factorised(matrix, 0.0)) {
        factorised(matrix, zero_pivot_shift);
        digits = digits < 0 ? zero_pivot_digits : std::min(digits, zero_pivot_digits);
      }
    }
    return judge_pivots(pivots_by_row(*current_), references, digits);
  }

  void solve_scaled(Eigen::Ref<Eigen::MatrixXd> rhs) const override {
    cholmod_dense view{};
    view.nrow = static_cast<std::size_t>(rhs.rows());
    view.ncol = static_cast<std::size_t>(rhs.cols());
    view.d = static_cast<std::size_t>(rhs.outerStride());
    view.nzmax = view.d * view.ncol;
    view.x = rhs.data();
    view.xtype = CHOLMOD_REAL;
    view.dtype = CHOLMOD_DOUBLE;
    cholmod_.threads.use(1);
    cholmod_dense* solution = cholmod_.solve(CHOLMOD_A, current_, &view, &common_);
    check();
    rhs = Eigen::Map<const Eigen::MatrixXd>(static_cast<const double*>(solution->x), rhs.rows(), rhs.cols());
    cholmod_.free_dense(&solution, &common_);
  }

 private:
  void choose_threads() const {
    if (operations_ > many_operations)
      cholmod_.threads.use_all();
    else
      cholmod_.threads.use(1);
  }

  cholmod_factor* symbolic_factor(const SymmetricMatrix& matrix, int kind) {
    return analysed(view_of(matrix), CHOLMOD_GIVEN, kind, order_.data());
  }

  cholmod_factor* analysed(cholmod_sparse view, int ordering, int kind, int* order = nullptr) {
    common_.nmethods = 1;
    common_.method[0].ordering = ordering;
    common_.supernodal = kind;
    cholmod_factor* factor = cholmod_.analyse(&view, order, nullptr, 0, &common_);
    check();
    return factor;
  }

  /// Which row comes i-th: by minimum degree, or by nested dissection where that leads to much work and to more entries
  /// of L. Both order groups of unknowns, whose factor has fewer entries by the square of their size.
  std::vector<int> least_filling_order(const SymmetricMatrix& matrix) {
    const QuotientPattern pattern = quotient_pattern(matrix);
    const double members = static_cast<double>(matrix.rows()) / pattern.size();
    const cholmod_sparse view =
        view_of(static_cast<std::size_t>(pattern.size()), pattern.column_starts.data(), pattern.rows.data());
    std::vector<int> best;
    double least = std::numeric_limits<double>::infinity();
    for (const int ordering : {CHOLMOD_AMD, CHOLMOD_METIS}) {
      cholmod_factor* factor = analysed(view, ordering, CHOLMOD_SIMPLICIAL);
      if (common_.lnz < least) best = pattern.expanded(static_cast<const int*>(factor->Perm));
      least = std::min(least, common_.lnz);
      cholmod_.free_factor(&factor, &common_);
      if (members * common_.fl < dissected_operations * common_.lnz ||
          members * members * common_.lnz < dissected_fill * static_cast<double>(matrix.nonZeros()))
        break;
    }
    return best;
  }

  /// False where a pivot stopped the factorisation.
  bool factorised(const SymmetricMatrix& matrix, double shift) {
    cholmod_sparse view = view_of(matrix);
    double beta[2] = {shift, 0.0};
    cholmod_.factorise(&view, beta, nullptr, 0, current_, &common_);
    check();
    return common_.status != CHOLMOD_NOT_POSDEF && current_->minor == current_->n;
  }

  void check() const {
    if (common_.status == CHOLMOD_OUT_OF_MEMORY || common_.status == CHOLMOD_TOO_LARGE) {
      throw Error("out-of-memory", "the factors of the stiffness matrix do not fit into memory", "coarsen the mesh");
    }
    if (common_.status < 0) throw Error("linear-solver", "CHOLMOD refuses the matrix");
  }

  Cholmod cholmod_;
  mutable cholmod_common common_{};
  cholmod_factor* factor_ = nullptr;
  cholmod_factor* indefinite_factor_ = nullptr;
  cholmod_factor* current_ = nullptr;
  std::vector<int> order_;
  double operations_ = 0.0;
};

}  // namespace

std::unique_ptr<LinearSolver> make_cholmod_solver(const LinearOptions& options) {
  return std::make_unique<CholmodSolver>(options);
}

}  // namespace comma::solver
