// numpy.linalg: norms, and small dense systems by Gaussian elimination. The interpreter knows no solver.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "interpreter/library/numpy_functions.hpp"
#include "interpreter/values/operations.hpp"

namespace comma::interpreter::numpy {

namespace {

double sum_of_powers(Line line, double order) {
  double total = 0.0;
  for (const double x : line) total += std::pow(std::abs(x), order);
  return total;
}

double euclidean_norm(Line line) {
  double total = 0.0;
  for (const double x : line) total += x * x;
  return std::sqrt(total);
}

double vector_norm(Line line, const Value& order) {
  if (order.is_none()) return euclidean_norm(line);
  if (!is_numeric(order)) raise(ErrorKind::value, fmt::format("Invalid norm order {} for vectors", order.repr()));
  const double p = real_of(order);
  if (p == 2.0) return euclidean_norm(line);
  const auto smaller_magnitude = [](double a, double b) { return std::abs(a) < std::abs(b); };
  if (std::isinf(p) && line.empty())
    raise(ErrorKind::value, "zero-size array to reduction operation which has no identity");
  if (std::isinf(p))
    return std::abs(p > 0.0 ? *std::ranges::max_element(line, smaller_magnitude)
                            : *std::ranges::min_element(line, smaller_magnitude));
  if (p == 0.0) return static_cast<double>(std::ranges::count_if(line, [](double x) { return x != 0.0; }));
  return std::pow(sum_of_powers(line, p), 1.0 / p);
}

/// The largest (or smallest, for a negative order) sum of magnitudes of a row or of a column; the Frobenius norm.
double matrix_norm(const Numbers& matrix, const Value& order) {
  if (order.is_none() || (order.is_text() && order.as_text() == "fro")) return euclidean_norm(matrix.data);
  const double p = is_numeric(order) ? real_of(order) : 0.0;
  if (std::abs(p) != 1.0 && !std::isinf(p))
    raise(ErrorKind::not_implemented, fmt::format("the norm of order {} of a matrix is not supported", order.repr()));
  const Numbers sums =
      map_lines(matrix, std::isinf(p) ? 1 : 0, [](Line line) { return std::vector<double>{sum_of_powers(line, 1.0)}; });
  if (sums.data.empty()) raise(ErrorKind::value, "zero-size array to reduction operation which has no identity");
  return p > 0.0 ? *std::ranges::max_element(sums.data) : *std::ranges::min_element(sums.data);
}

Value norm(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("norm", arguments, 1, 3, {"ord", "axis"});
  Numbers source = argument(evaluator, arguments[0]);
  if (source.shape.empty()) source.shape = {1};
  const Value* given = option(arguments, 1, "ord");
  const Value order = given != nullptr ? *given : Value();
  const auto axis = axis_argument(arguments, 2, source.shape.size());
  if (!axis) return source.shape.size() == 2 ? matrix_norm(source, order) : vector_norm(source.data, order);
  Numbers norms = map_lines(source, *axis, [&](Line line) { return std::vector<double>{vector_norm(line, order)}; });
  norms.type = NumberType::real;
  norms.shape.erase(norms.shape.begin() + static_cast<std::ptrdiff_t>(*axis));
  return make_value(std::move(norms));
}

Numbers square_argument(Evaluator& evaluator, const Value& value) {
  Numbers matrix = array_argument(evaluator, value);
  if (matrix.shape.size() != 2) raise(ErrorKind::value, "a matrix is wanted: an array of two dimensions");
  if (matrix.shape[0] != matrix.shape[1]) raise(ErrorKind::value, "Last 2 dimensions of the array must be square");
  const std::uint64_t n = matrix.shape[0];
  evaluator.meter().work(n * n * n);
  return matrix;
}

/// Brings a square matrix to triangular form, the rows of `right` (of this width) going with it. Returns the
/// determinant; a zero says that the elimination stopped at a column without pivot.
double eliminate(Numbers& matrix, std::vector<double>& right, std::size_t width) {
  const std::size_t n = matrix.shape[0];
  const auto entry = [&](std::size_t i, std::size_t j) -> double& { return matrix.data[i * n + j]; };
  double determinant = 1.0;
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < n; ++i)
      if (std::abs(entry(i, k)) > std::abs(entry(pivot, k))) pivot = i;
    if (entry(pivot, k) == 0.0) return 0.0;
    if (pivot != k) {
      for (std::size_t j = 0; j < n; ++j) std::swap(entry(k, j), entry(pivot, j));
      for (std::size_t j = 0; j < width; ++j) std::swap(right[k * width + j], right[pivot * width + j]);
      determinant = -determinant;
    }
    determinant *= entry(k, k);
    for (std::size_t i = k + 1; i < n; ++i) {
      const double factor = entry(i, k) / entry(k, k);
      for (std::size_t j = k; j < n; ++j) entry(i, j) -= factor * entry(k, j);
      for (std::size_t j = 0; j < width; ++j) right[i * width + j] -= factor * right[k * width + j];
    }
  }
  return determinant;
}

/// The solutions of a square system, in place of its right-hand sides.
void solve_system(Numbers matrix, std::vector<double>& right, std::size_t width) {
  const std::size_t n = matrix.shape[0];
  eliminate(matrix, right, width);
  for (std::size_t k = n; k-- > 0;) {
    const double pivot = matrix.data[k * n + k];
    if (pivot == 0.0) raise(ErrorKind::value, "Singular matrix");
    for (std::size_t j = 0; j < width; ++j) {
      double rest = right[k * width + j];
      for (std::size_t i = k + 1; i < n; ++i) rest -= matrix.data[k * n + i] * right[i * width + j];
      right[k * width + j] = rest / pivot;
    }
  }
}

Value solve(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("solve", arguments, 2, 2);
  const Numbers matrix = square_argument(evaluator, arguments[0]);
  Numbers right = array_argument(evaluator, arguments[1]);
  if (right.shape[0] != matrix.shape[0])
    raise(ErrorKind::value,
          fmt::format("solve: the matrix has {} rows, the right-hand side {}", matrix.shape[0], right.shape[0]));
  const std::size_t width = right.shape.size() == 2 ? right.shape[1] : 1;
  evaluator.meter().work(matrix.data.size() * width);
  solve_system(matrix, right.data, width);
  right.type = NumberType::real;
  return make_value(std::move(right));
}

Value inv(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("inv", arguments, 1, 1);
  const Numbers matrix = square_argument(evaluator, arguments[0]);
  const std::size_t n = matrix.shape[0];
  Numbers inverse{std::vector<double>(n * n, 0.0), {n, n}, NumberType::real};
  for (std::size_t i = 0; i < n; ++i) inverse.data[i * n + i] = 1.0;
  solve_system(matrix, inverse.data, n);
  return make_value(std::move(inverse));
}

Value det(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("det", arguments, 1, 1);
  Numbers matrix = square_argument(evaluator, arguments[0]);
  std::vector<double> nothing;
  return eliminate(matrix, nothing, 0);
}

/// Rotations that make the entry (p, q) of a symmetric matrix zero (Golub and Van Loan, section 8.5).
void rotate(Numbers& matrix, std::size_t p, std::size_t q) {
  const std::size_t n = matrix.shape[0];
  const auto entry = [&](std::size_t i, std::size_t j) -> double& { return matrix.data[i * n + j]; };
  if (entry(p, q) == 0.0) return;
  const double tau = (entry(q, q) - entry(p, p)) / (2.0 * entry(p, q));
  const double tangent = (tau >= 0.0 ? 1.0 : -1.0) / (std::abs(tau) + std::hypot(1.0, tau));
  const double cosine = 1.0 / std::hypot(1.0, tangent), sine = tangent * cosine;
  for (std::size_t k = 0; k < n; ++k) {
    const double a = entry(k, p), b = entry(k, q);
    entry(k, p) = cosine * a - sine * b;
    entry(k, q) = sine * a + cosine * b;
  }
  for (std::size_t k = 0; k < n; ++k) {
    const double a = entry(p, k), b = entry(q, k);
    entry(p, k) = cosine * a - sine * b;
    entry(q, k) = sine * a + cosine * b;
  }
}

/// The eigenvalues of a symmetric matrix in ascending order, by Jacobi's sweeps. Of the matrix the lower half is read.
Value eigvalsh(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("eigvalsh", arguments, 1, 1);
  constexpr int most_sweeps = 60;  // they converge quadratically: ten are many
  Numbers matrix = square_argument(evaluator, arguments[0]);
  const std::size_t n = matrix.shape[0];
  for (const double number : matrix.data)
    if (!std::isfinite(number)) raise(ErrorKind::value, "Eigenvalues did not converge");
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 1; j < n; ++j) matrix.data[i * n + j] = matrix.data[j * n + i];
  const double scale = euclidean_norm(matrix.data);
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    double rest = 0.0;
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j)
        if (i != j) rest = std::max(rest, std::abs(matrix.data[i * n + j]));
    if (rest <= scale * 1e-17) break;  // a tenth of the last digit of the largest eigenvalue
    evaluator.meter().work(n * n * n);
    for (std::size_t p = 0; p < n; ++p)
      for (std::size_t q = p + 1; q < n; ++q) rotate(matrix, p, q);
  }
  Numbers values{{}, {n}, NumberType::real};
  for (std::size_t i = 0; i < n; ++i) values.data.push_back(matrix.data[i * n + i]);
  std::ranges::sort(values.data);
  return make_value(std::move(values));
}

constexpr std::array linalg_rows = {
    FunctionRow{"norm", norm}, FunctionRow{"solve", solve},       FunctionRow{"inv", inv},
    FunctionRow{"det", det},   FunctionRow{"eigvalsh", eigvalsh},
};

}  // namespace

std::span<const FunctionRow> linalg_table() { return linalg_rows; }

}  // namespace comma::interpreter::numpy
