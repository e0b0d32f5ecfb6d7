#include "solver/linear/dense_solve.hpp"

#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "solver/linear/blas_threads.hpp"
#include "solver/linear/shared_library.hpp"

namespace comma::solver {
namespace {

/// A pivot below this share of the largest leaves the solution to the least-squares method.
constexpr double singular_pivot = 1e-14;

/// The LAPACK that CHOLMOD is built on.
struct Lapack {
  SharedLibrary library{COMMA_CHOLMOD_LIBRARY};
  using Factorise = void(const int* rows, const int* columns, double* a, const int* lda, int* interchanges, int* info);
  using Solve = void(const char* transposed, const int* n, const int* columns, const double* a, const int* lda, const int* interchanges, double* b, const int* ldb,
                     int* info);
  using Cholesky = void(const char* triangle, const int* n, double* a, const int* lda, int* info);
  Factorise* factorise = library.function<Factorise>("dgetrf_");
  Solve* solve = library.function<Solve>("dgetrs_");
  Cholesky* cholesky = library.function<Cholesky>("dpotrf_");
  BlasThreads threads{library};
};

const Lapack& lapack() {
  static const Lapack loaded;
  return loaded;
}

/// P M = L U.
class DenseLu {
 public:
  explicit DenseLu(const Eigen::MatrixXd& matrix);
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;
  /// The diagonal of U.
  Eigen::VectorXd pivots() const { return small_ ? small_->matrixLU().diagonal() : factors_.diagonal(); }

 private:
  std::optional<Eigen::PartialPivLU<Eigen::MatrixXd>> small_;
  Eigen::MatrixXd factors_;
  std::vector<int> interchanges_;
};

DenseLu::DenseLu(const Eigen::MatrixXd& matrix) {
  if (matrix.rows() < large_dense) {
    small_.emplace(matrix);
    return;
  }
  factors_ = matrix;
  const int n = static_cast<int>(factors_.rows());
  interchanges_.resize(static_cast<std::size_t>(n));
  int info = 0;
  lapack().threads.use_all();
  lapack().factorise(&n, &n, factors_.data(), &n, interchanges_.data(), &info);
  lapack().threads.use(1);
}

Eigen::VectorXd DenseLu::solve(const Eigen::VectorXd& b) const {
  if (small_) return small_->solve(b);
  Eigen::VectorXd x = b;
  const int n = static_cast<int>(factors_.rows()), one = 1;
  int info = 0;
  lapack().solve("N", &n, &one, factors_.data(), &n, interchanges_.data(), x.data(), &n, &info);
  return x;
}

}  // namespace

bool factorise_dense(Eigen::MatrixXd& lower) {
  if (lower.rows() < large_dense) return Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>>(lower).info() == Eigen::Success;
  const int n = static_cast<int>(lower.rows());
  int info = 0;
  lapack().threads.use_all();
  lapack().cholesky("L", &n, lower.data(), &n, &info);
  lapack().threads.use(1);
  return info == 0;
}

Eigen::VectorXd solve_dense(Eigen::MatrixXd matrix, Eigen::VectorXd rhs) {
  constexpr double tiny = std::numeric_limits<double>::min();
  const Eigen::VectorXd columns = matrix.cwiseAbs().colwise().maxCoeff().transpose().cwiseMax(tiny).cwiseInverse();
  matrix = matrix * columns.asDiagonal();
  const Eigen::VectorXd rows = matrix.cwiseAbs().rowwise().maxCoeff().cwiseMax(tiny).cwiseInverse();
  matrix = rows.asDiagonal() * matrix;
  rhs = rows.asDiagonal() * rhs;
  const DenseLu factor(matrix);
  const Eigen::VectorXd pivots = factor.pivots().cwiseAbs();
  Eigen::VectorXd solution;
  if (pivots.minCoeff() > singular_pivot * pivots.maxCoeff()) {
    solution = factor.solve(rhs);
    solution += factor.solve(rhs - matrix * solution);
  } else {
    solution = matrix.completeOrthogonalDecomposition().solve(rhs);
  }
  return columns.asDiagonal() * solution;
}

}  // namespace comma::solver
