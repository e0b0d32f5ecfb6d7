#include "solver/functions/operations.hpp"

#include <fmt/format.h>
#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "solver/error.hpp"

namespace comma::solver {

namespace {

/// Abscissas of different tables that are nearer than this, relative to the larger, were meant to be one.
constexpr double same_abscissa = 1e-12;

bool is_same(double a, double b) { return std::abs(a - b) <= same_abscissa * std::max(std::abs(a), std::abs(b)); }

TabulatedFunction shape_of(const TabulatedFunction& function) {
  TabulatedFunction shape = function;
  shape.x.clear();
  shape.y.clear();
  return shape;
}

TabulatedFunction without_extensions(TabulatedFunction function) {
  function.left = Extension::excluded;
  function.right = Extension::excluded;
  return function;
}

/// Rising; those that differ by rounding only are one.
std::vector<double> all_abscissas(Functions functions) {
  std::vector<double> all;
  for (const TabulatedFunction* function : functions) all.insert(all.end(), function->x.begin(), function->x.end());
  std::ranges::sort(all);
  all.erase(std::unique(all.begin(), all.end(), is_same), all.end());
  return all;
}

/// At each of the abscissas `join` of the functions' values.
template <class Join>
TabulatedFunction joined(Functions functions, std::vector<double> abscissas, Join join) {
  TabulatedFunction result = shape_of(*functions.front());
  result.x = std::move(abscissas);
  std::vector<double> values(functions.size());
  for (const double x : result.x) {
    std::ranges::transform(functions, values.begin(),
                           [x](const TabulatedFunction* function) { return (*function)(x); });
    result.y.push_back(join(values));
  }
  return result;
}

}  // namespace

std::vector<double> common_abscissas(Functions functions) {
  std::vector<double> all = all_abscissas(functions);
  std::erase_if(all, [&](double x) {
    return std::ranges::any_of(functions, [x](const TabulatedFunction* function) {
      const auto& own = function->x;
      const bool before = x < own.front() && !is_same(x, own.front()) && function->left == Extension::excluded;
      const bool behind = x > own.back() && !is_same(x, own.back()) && function->right == Extension::excluded;
      return before || behind;
    });
  });
  if (all.empty())
    throw Error("out-of-function", "the functions have no abscissa where all of them are defined",
                "extend them on the left or on the right");
  return all;
}

TabulatedFunction combination(Functions functions, std::span<const double> coefficients) {
  const auto sum = [&](const std::vector<double>& values) {
    return std::inner_product(values.begin(), values.end(), coefficients.begin(), 0.0);
  };
  return joined(functions, common_abscissas(functions), sum);
}

TabulatedFunction product(Functions functions) {
  const auto multiply = [](const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 1.0, std::multiplies<>());
  };
  return joined(functions, common_abscissas(functions), multiply);
}

TabulatedFunction mean(Functions functions) {
  return joined(functions, all_abscissas(functions), [](const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  });
}

TabulatedFunction fractile(Functions functions, double share) {
  return joined(functions, all_abscissas(functions), [share](std::vector<double> values) {
    std::ranges::sort(values);
    const double place = share * static_cast<double>(values.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    return std::lerp(values[below], values[std::min(below + 1, values.size() - 1)], place - std::floor(place));
  });
}

TabulatedFunction upper_envelope(Functions functions) {
  return joined(functions, all_abscissas(functions),
                [](const std::vector<double>& values) { return std::ranges::max(values); });
}

TabulatedFunction lower_envelope(Functions functions) {
  return joined(functions, all_abscissas(functions),
                [](const std::vector<double>& values) { return std::ranges::min(values); });
}

TabulatedFunction resampled(const TabulatedFunction& function, std::vector<double> abscissas) {
  TabulatedFunction result = shape_of(function);
  result.x = std::move(abscissas);
  std::ranges::transform(result.x, std::back_inserter(result.y), std::cref(function));
  return result;
}

TabulatedFunction mapped(const TabulatedFunction& function, const std::function<double(double)>& ordinate) {
  TabulatedFunction result = function;
  std::ranges::transform(result.y, result.y.begin(), ordinate);
  return result;
}

TabulatedFunction in_succession(const TabulatedFunction& first, const TabulatedFunction& second, Overlap counts) {
  if (first.x_scale != second.x_scale || first.y_scale != second.y_scale)
    throw Error("other-scales", "the functions have not the same interpolation",
                "give both the same INTERPOL, by CALC_FONC_INTERP");
  const bool as_written = first.x.front() < second.x.front();
  const TabulatedFunction& left = as_written ? first : second;
  const TabulatedFunction& right = as_written ? second : first;
  TabulatedFunction result = shape_of(first);
  result.left = left.left;
  const auto take = [&result](const TabulatedFunction& from, auto counts_at) {
    for (std::size_t i = 0; i < from.x.size(); ++i) {
      if (!counts_at(from.x[i])) continue;
      result.x.push_back(from.x[i]);
      result.y.push_back(from.y[i]);
    }
  };
  const bool by_left = counts == Overlap::left;
  take(left, [&](double x) { return by_left || (x < right.x.front() && !is_same(x, right.x.front())); });
  const std::size_t before = result.x.size();
  take(right, [&](double x) { return !by_left || (x > left.x.back() && !is_same(x, left.x.back())); });
  result.right = result.x.size() > before ? right.right : left.right;
  return result;
}

TabulatedFunction polynomial_fit(const TabulatedFunction& function, int degree) {
  const auto count = static_cast<Eigen::Index>(function.x.size());
  if (count <= degree)
    throw Error("out-of-function", fmt::format("{} points determine no polynomial of degree {}", count, degree),
                "take a lower degree");
  // Powers of a variable between -1 and 1.
  const double middle = 0.5 * (function.x.front() + function.x.back()),
               half = std::max(0.5 * (function.x.back() - function.x.front()), std::numeric_limits<double>::min());
  Eigen::MatrixXd powers = Eigen::MatrixXd::Ones(count, degree + 1);
  for (Eigen::Index i = 0; i < count; ++i)
    for (int k = 1; k <= degree; ++k)
      powers(i, k) = powers(i, k - 1) * (function.x[static_cast<std::size_t>(i)] - middle) / half;
  const Eigen::Map<const Eigen::VectorXd> values(function.y.data(), count);
  TabulatedFunction result = function;
  result.x_scale = result.y_scale = Scale::linear;
  Eigen::Map<Eigen::VectorXd>(result.y.data(), count) = powers * powers.householderQr().solve(values);
  return result;
}

TabulatedFunction integral(const TabulatedFunction& function, double at_first) {
  TabulatedFunction result = without_extensions(function);
  result.y.front() = at_first;
  for (std::size_t i = 1; i < function.x.size(); ++i) {
    result.y[i] = result.y[i - 1] + 0.5 * (function.y[i - 1] + function.y[i]) * (function.x[i] - function.x[i - 1]);
  }
  return result;
}

TabulatedFunction simpson_integral(const TabulatedFunction& function, double at_first) {
  TabulatedFunction result = integral(function, at_first);
  const auto& x = function.x;
  const auto& y = function.y;
  for (std::size_t i = 2; i < x.size(); ++i) {
    const double first = x[i - 1] - x[i - 2], second = x[i] - x[i - 1], both = x[i] - x[i - 2];
    const double under_parabola =
        both / 6.0 *
        ((2.0 - second / first) * y[i - 2] + both * both / (first * second) * y[i - 1] + (2.0 - first / second) * y[i]);
    result.y[i] = result.y[i - 2] + under_parabola;
  }
  return result;
}

double mean_between(const TabulatedFunction& function, double from, double to) {
  TabulatedFunction sum = integral(function, 0.0);
  sum.y_scale = Scale::linear;  // it begins at zero
  sum.left = function.left;
  sum.right = function.right;
  return (sum(to) - sum(from)) / (to - from);
}

TabulatedFunction derivative(const TabulatedFunction& function) {
  const std::size_t last = function.x.size() - 1;
  if (last == 0) throw Error("out-of-function", "a function of one point has no derivative");
  TabulatedFunction result = without_extensions(function);
  for (std::size_t i = 0; i <= last; ++i) {
    const std::size_t before = i == 0 ? 0 : i - 1, after = std::min(i + 1, last);
    if (function.x[after] == function.x[before])
      throw Error("out-of-function", fmt::format("the function {}({}) steps at {:g}: it has no derivative there",
                                                 function.result, function.parameter, function.x[i]));
    result.y[i] = (function.y[after] - function.y[before]) / (function.x[after] - function.x[before]);
  }
  return result;
}

TabulatedFunction inverse(const TabulatedFunction& function) {
  const bool rises = std::ranges::adjacent_find(function.y, std::ranges::greater_equal()) == function.y.end();
  const bool falls = std::ranges::adjacent_find(function.y, std::ranges::less_equal()) == function.y.end();
  if (!rises && !falls) {
    throw Error("out-of-function",
                fmt::format("the function {}({}) neither rises nor falls throughout: it has no inverse",
                            function.result, function.parameter));
  }
  TabulatedFunction result = function;
  for (Extension* end : {&result.left, &result.right})
    if (*end == Extension::constant) *end = Extension::excluded;
  std::swap(result.x, result.y);
  std::swap(result.x_scale, result.y_scale);
  if (falls && !rises) {
    std::ranges::reverse(result.x);
    std::ranges::reverse(result.y);
    std::swap(result.left, result.right);
  }
  return result;
}

TabulatedFunction composition(const TabulatedFunction& outer, const TabulatedFunction& inner) {
  TabulatedFunction result = shape_of(outer);
  result.parameter = inner.parameter;
  result.x = inner.x;
  std::ranges::transform(inner.y, std::back_inserter(result.y), std::cref(outer));
  return result;
}

}  // namespace comma::solver
