// numpy's functions of sampled curves and of polynomials: interp, trapz, polyfit, polyval.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "interpreter/library/numpy_functions.hpp"
#include "interpreter/values/operations.hpp"

namespace comma::interpreter::numpy {

namespace {

Numbers vector_argument(Evaluator& evaluator, const Value& value, std::string_view what) {
  Numbers numbers = array_argument(evaluator, value);
  if (numbers.shape.size() != 1)
    raise(ErrorKind::value, fmt::format("{} is wanted as an array of one dimension", what));
  return numbers;
}

/// The polyline through (xp, fp) at x; outside, left and right.
double interpolated(double x, const std::vector<double>& xp, const std::vector<double>& fp, double left, double right) {
  if (std::isnan(x)) return x;
  if (x < xp.front()) return left;
  if (x > xp.back()) return right;
  const auto j = static_cast<std::size_t>(std::upper_bound(xp.begin(), xp.end(), x) - xp.begin()) - 1;
  if (j + 1 == xp.size() || xp[j] == x) return fp[j];
  const double slope = (fp[j + 1] - fp[j]) / (xp[j + 1] - xp[j]);
  return slope * (x - xp[j]) + fp[j];
}

Value interp(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("interp", arguments, 3, 5, {"left", "right"});
  Numbers places = argument(evaluator, arguments[0]);
  const Numbers xp = vector_argument(evaluator, arguments[1], "xp"),
                fp = vector_argument(evaluator, arguments[2], "fp");
  if (xp.data.size() != fp.data.size()) raise(ErrorKind::value, "fp and xp are not of the same length.");
  if (xp.data.empty()) raise(ErrorKind::value, "array of sample points is empty");
  const auto outside = [&](std::size_t position, std::string_view name, double fallback) {
    const Value* given = option(arguments, position, name);
    return given == nullptr || given->is_none() ? fallback : real_of(*given);
  };
  const double left = outside(3, "left", fp.data.front()), right = outside(4, "right", fp.data.back());
  for (double& x : places.data) x = interpolated(x, xp.data, fp.data, left, right);
  places.type = NumberType::real;
  return make_value(std::move(places));
}

/// The area below a polyline; of a matrix, below each of its rows.
Value trapz(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("trapz", arguments, 1, 3, {"x", "dx"});
  const Numbers y = array_argument(evaluator, arguments[0]);
  const Value* given = option(arguments, 1, "x");
  const Value* step = option(arguments, 2, "dx");
  const double dx = step != nullptr ? real_of(*step) : 1.0;
  Numbers x;
  if (given != nullptr && !given->is_none()) {
    x = vector_argument(evaluator, *given, "x");
    if (x.data.size() != y.shape.back()) raise(ErrorKind::value, "x and y of trapz are of different lengths");
  }
  Numbers area = map_lines(y, y.shape.size() - 1, [&](Line line) {
    double total = 0.0;
    for (std::size_t i = 0; i + 1 < line.size(); ++i)
      total += (x.data.empty() ? dx : x.data[i + 1] - x.data[i]) * (line[i + 1] + line[i]) / 2.0;
    return std::vector<double>{total};
  });
  area.type = NumberType::real;
  area.shape.pop_back();
  return make_value(std::move(area));
}

Value polyval(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("polyval", arguments, 2, 2);
  const Numbers coefficients = vector_argument(evaluator, arguments[0], "the polynomial");
  const Numbers x = argument(evaluator, arguments[1]);
  Numbers value{std::vector<double>(x.data.size(), 0.0), x.shape,
                std::max({coefficients.type, x.type, NumberType::integer})};
  evaluator.meter().work(x.data.size() * coefficients.data.size());
  for (const double coefficient : coefficients.data)
    for (std::size_t i = 0; i < x.data.size(); ++i) value.data[i] = value.data[i] * x.data[i] + coefficient;
  return make_value(std::move(value));
}

/// Least squares of a tall matrix, given by its columns, with Householder reflections (Golub and Van Loan, Matrix
/// Computations, section 5.3.2). Returns the unknowns. Raises ValueError where columns depend on one another.
std::vector<double> least_squares(std::vector<std::vector<double>> columns, std::vector<double> right) {
  const std::size_t rows = right.size(), count = columns.size();
  constexpr double smallest_pivot = 1e-14;  // columns are of length one: below lies nothing but rounding
  std::vector<double> pivots(count);
  for (std::size_t k = 0; k < count; ++k) {
    std::vector<double>& v = columns[k];
    double length = 0.0;
    for (std::size_t i = k; i < rows; ++i) length = std::hypot(length, v[i]);
    if (!(length > smallest_pivot)) raise(ErrorKind::value, "polyfit is poorly conditioned: too few different points");
    pivots[k] = v[k] > 0.0 ? -length : length;
    v[k] -= pivots[k];
    double square = 0.0;
    for (std::size_t i = k; i < rows; ++i) square += v[i] * v[i];
    const auto reflect = [&](std::vector<double>& w) {
      double product = 0.0;
      for (std::size_t i = k; i < rows; ++i) product += v[i] * w[i];
      for (std::size_t i = k; i < rows; ++i) w[i] -= 2.0 * product / square * v[i];
    };
    for (std::size_t j = k + 1; j < count; ++j) reflect(columns[j]);
    reflect(right);
  }
  std::vector<double> unknowns(count);
  for (std::size_t k = count; k-- > 0;) {
    double rest = right[k];
    for (std::size_t j = k + 1; j < count; ++j) rest -= columns[j][k] * unknowns[j];
    unknowns[k] = rest / pivots[k];
  }
  return unknowns;
}

Value polyfit(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("polyfit", arguments, 3, 3);
  const Numbers x = vector_argument(evaluator, arguments[0], "x"), y = vector_argument(evaluator, arguments[1], "y");
  const std::int64_t degree = index_of(arguments[2]);
  if (x.data.size() != y.data.size()) raise(ErrorKind::type, "expected x and y to have same length");
  if (degree < 0) raise(ErrorKind::value, "expected deg >= 0");
  if (static_cast<std::uint64_t>(degree) >= x.data.size())
    raise(ErrorKind::value, "polyfit is poorly conditioned: too few points for this degree");
  const std::size_t count = static_cast<std::size_t>(degree) + 1;
  evaluator.meter().allocate(count * x.data.size() * sizeof(double));
  evaluator.meter().work(count * count * x.data.size());
  std::vector<std::vector<double>> columns(count, std::vector<double>(x.data.size(), 1.0));
  std::vector<double> scales;
  for (std::size_t k = count; k-- > 0;)
    for (std::size_t i = 0; k + 1 < count && i < x.data.size(); ++i) columns[k][i] = columns[k + 1][i] * x.data[i];
  for (std::vector<double>& column : columns) {
    double length = 0.0;
    for (const double entry : column) length = std::hypot(length, entry);
    scales.push_back(length > 0.0 ? length : 1.0);
    for (double& entry : column) entry /= scales.back();
  }
  Numbers result{least_squares(std::move(columns), y.data), {count}, NumberType::real};
  for (std::size_t k = 0; k < count; ++k) result.data[k] /= scales[k];
  return make_value(std::move(result));
}

constexpr std::array curve_table = {
    FunctionRow{"interp", interp},
    FunctionRow{"trapz", trapz},
    FunctionRow{"polyval", polyval},
    FunctionRow{"polyfit", polyfit},
};

}  // namespace

std::span<const FunctionRow> curve_functions() { return curve_table; }

}  // namespace comma::interpreter::numpy
