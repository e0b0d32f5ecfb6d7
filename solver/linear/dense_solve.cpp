#include "solver/linear/dense_solve.hpp"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "solver/linear/blas_threads.hpp"
#include "solver/linear/largest_component.hpp"
#include "solver/linear/shared_library.hpp"

namespace comma::solver {
namespace {

/// A pivot below this share of the largest leaves the solution to the least-squares method.
constexpr double singular_pivot = 1e-14;
/// Rows from which products and factors gain by more than one thread: threads that wait for each other over less take
/// longer than one where the machine is shared.
constexpr Eigen::Index large_product = 1000, large_factor = 800;

/// The LAPACK that CHOLMOD is built on.
struct Lapack {
  SharedLibrary library{COMMA_CHOLMOD_LIBRARY};
  using Factorise = void(const int* rows, const int* columns, double* a, const int* lda, int* interchanges, int* info);
  using Solve = void(const char* transposed, const int* n, const int* columns, const double* a, const int* lda,
                     const int* interchanges, double* b, const int* ldb, int* info);
  using Cholesky = void(const char* triangle, const int* n, double* a, const int* lda, int* info);
  using LeastSquares = void(const int* rows, const int* columns, const int* count, double* a, const int* lda, double* b,
                            const int* ldb, int* interchanges, const double* smallest, int* rank, double* work,
                            const int* work_size, int* info);
  Factorise* factorise = library.function<Factorise>("dgetrf_");
  Solve* solve = library.function<Solve>("dgetrs_");
  LeastSquares* least_squares = library.function<LeastSquares>("dgelsy_");
  using Product = void(const char* triangle, const int* n, const double* alpha, const double* a, const int* lda,
                       const double* x, const int* x_step, const double* beta, double* y, const int* y_step);
  Cholesky* cholesky = library.function<Cholesky>("dpotrf_");
  Product* product = library.function<Product>("dsymv_");
  using SingleProduct = void(const char* triangle, const int* n, const float* alpha, const float* a, const int* lda,
                             const float* x, const int* x_step, const float* beta, float* y, const int* y_step);
  SingleProduct* single_product = library.function<SingleProduct>("ssymv_");
  BlasThreads threads{library};
};

const Lapack& lapack() {
  static const Lapack loaded;
  return loaded;
}

/// All i > j, those of a tile that fits the cache one after the other.
template <class Function>
void for_pairs(Eigen::Index n, const Function& function) {
  constexpr Eigen::Index tile = 64;
  for (Eigen::Index column = 0; column < n; column += tile)
    for (Eigen::Index row = column; row < n; row += tile)
      for (Eigen::Index j = column; j < std::min(n, column + tile); ++j)
        for (Eigen::Index i = std::max(row, j + 1); i < std::min(n, row + tile); ++i) function(i, j);
}

/// The x of least size that comes nearest to M x = b, by a complete orthogonal factorisation.
Eigen::VectorXd nearest_solution(Eigen::MatrixXd matrix, Eigen::VectorXd b) {
  if (matrix.rows() < large_dense) return matrix.completeOrthogonalDecomposition().solve(b);
  const int n = static_cast<int>(matrix.rows()), one = 1, ask = -1;
  const double smallest = std::numeric_limits<double>::epsilon() * n;
  std::vector<int> interchanges(static_cast<std::size_t>(n), 0);
  int rank = 0, info = 0;
  const auto solve = [&](std::vector<double>& work, const int* size) {
    lapack().least_squares(&n, &n, &one, matrix.data(), &n, b.data(), &n, interchanges.data(), &smallest, &rank,
                           work.data(), size, &info);
  };
  std::vector<double> work(1);
  solve(work, &ask);
  work.resize(static_cast<std::size_t>(work[0]));
  const int size = static_cast<int>(work.size());
  const AllThreads threads(lapack().threads, n >= large_factor);
  solve(work, &size);
  return b;
}

}  // namespace

DenseLu::DenseLu(Eigen::MatrixXd matrix) {
  if (matrix.rows() < large_dense) {
    small_.emplace(matrix);
    return;
  }
  factors_ = std::move(matrix);
  const int n = static_cast<int>(factors_.rows());
  interchanges_.resize(static_cast<std::size_t>(n));
  int info = 0;
  const AllThreads threads(lapack().threads, n >= large_factor);
  lapack().factorise(&n, &n, factors_.data(), &n, interchanges_.data(), &info);
}

Eigen::VectorXd DenseLu::solve(const Eigen::VectorXd& b) const {
  if (small_) return small_->solve(b);
  Eigen::VectorXd x = b;
  const int n = static_cast<int>(factors_.rows()), one = 1;
  int info = 0;
  lapack().solve("N", &n, &one, factors_.data(), &n, interchanges_.data(), x.data(), &n, &info);
  return x;
}

bool factorise_dense(Eigen::MatrixXd& lower) {
  if (lower.rows() < large_dense) return Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>>(lower).info() == Eigen::Success;
  const int n = static_cast<int>(lower.rows());
  int info = 0;
  const AllThreads threads(lapack().threads, n >= large_factor);
  lapack().cholesky("L", &n, lower.data(), &n, &info);
  return info == 0;
}

Eigen::VectorXd symmetric_product(const Eigen::MatrixXd& lower, const Eigen::VectorXd& x) {
  if (lower.rows() < large_product) return lower.selfadjointView<Eigen::Lower>() * x;
  Eigen::VectorXd product = Eigen::VectorXd::Zero(x.size());
  const int n = static_cast<int>(lower.rows()), step = 1;
  const double plus = 1.0;
  const AllThreads threads(lapack().threads);
  lapack().product("L", &n, &plus, lower.data(), &n, x.data(), &step, &plus, product.data(), &step);
  return product;
}

void fill_upper(Eigen::MatrixXd& matrix) {
  for_pairs(matrix.rows(), [&](Eigen::Index i, Eigen::Index j) { matrix(j, i) = matrix(i, j); });
}

void fill_lower(Eigen::MatrixXd& matrix) {
  for_pairs(matrix.rows(), [&](Eigen::Index i, Eigen::Index j) { matrix(i, j) = matrix(j, i); });
}

SingleTriangle::SingleTriangle(const Eigen::MatrixXd& lower) : values_(lower.rows(), lower.cols()) {
  for (Eigen::Index column = 0; column < lower.cols(); ++column)
    values_.col(column).tail(lower.rows() - column) = lower.col(column).tail(lower.rows() - column).cast<float>();
}

Eigen::VectorXd SingleTriangle::operator*(const Eigen::VectorXd& x) const {
  const double size = largest_component(x);
  if (!(size > 0.0)) return Eigen::VectorXd::Zero(x.size());
  const Eigen::VectorXf given = (x / size).cast<float>();
  Eigen::VectorXf product = Eigen::VectorXf::Zero(x.size());
  const int n = static_cast<int>(values_.rows()), step = 1;
  const float plus = 1.0F;
  const AllThreads threads(lapack().threads);
  lapack().single_product("L", &n, &plus, values_.data(), &n, given.data(), &step, &plus, product.data(), &step);
  return size * product.cast<double>();
}

DenseSystem::DenseSystem(Eigen::MatrixXd matrix) : matrix_(std::move(matrix)) {
  constexpr double tiny = std::numeric_limits<double>::min();
  column_scales_ = matrix_.cwiseAbs().colwise().maxCoeff().transpose().cwiseMax(tiny).cwiseInverse();
  matrix_ = matrix_ * column_scales_.asDiagonal();
  row_scales_ = matrix_.cwiseAbs().rowwise().maxCoeff().cwiseMax(tiny).cwiseInverse();
  matrix_ = row_scales_.asDiagonal() * matrix_;
  factor_.emplace(matrix_);
  const Eigen::VectorXd pivots = factor_->pivots().cwiseAbs();
  if (!(pivots.minCoeff() > singular_pivot * pivots.maxCoeff())) factor_.reset();
}

Eigen::VectorXd DenseSystem::solve(const Eigen::VectorXd& b) const {
  Eigen::VectorXd rhs = row_scales_.asDiagonal() * b, solution;
  if (factor_) {
    solution = factor_->solve(rhs);
    solution += factor_->solve(rhs - matrix_ * solution);
  } else {
    solution = nearest_solution(matrix_, std::move(rhs));
  }
  return column_scales_.asDiagonal() * solution;
}

Eigen::VectorXd solve_dense(Eigen::MatrixXd matrix, const Eigen::VectorXd& rhs) {
  return DenseSystem(std::move(matrix)).solve(rhs);
}

}  // namespace comma::solver
