#include "solver/functions/function.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "solver/error.hpp"

namespace comma::solver {

namespace {

// Instants are sums of steps; a last instant that misses the table's end by rounding still belongs to the table.
constexpr double end_tolerance = 1e-10;

double forward(Scale scale, double value) { return scale == Scale::logarithmic ? std::log(value) : value; }
double backward(Scale scale, double value) { return scale == Scale::logarithmic ? std::exp(value) : value; }

/// The curve through points i and i+1 of the table, each axis on its own scale.
double segment(const TabulatedFunction& f, std::size_t i, double at) {
  const bool positive = (f.x_scale == Scale::linear || (at > 0.0 && f.x[i] > 0.0)) &&
                        (f.y_scale == Scale::linear || (f.y[i] > 0.0 && f.y[i + 1] > 0.0));
  if (!positive) {
    throw Error(
        "out-of-function",
        fmt::format(
            "the function {}({}) is interpolated on a logarithmic scale, but a value near {} = {} is not positive",
            f.result, f.parameter, f.parameter, at));
  }
  const double x0 = forward(f.x_scale, f.x[i]);
  const double x1 = forward(f.x_scale, f.x[i + 1]);
  const double y0 = forward(f.y_scale, f.y[i]);
  const double y1 = forward(f.y_scale, f.y[i + 1]);
  const double s = (forward(f.x_scale, at) - x0) / (x1 - x0);
  return backward(f.y_scale, y0 + s * (y1 - y0));
}

double beyond(const TabulatedFunction& f, double at, bool on_the_left) {
  const Extension extension = on_the_left ? f.left : f.right;
  if (extension == Extension::constant) return on_the_left ? f.y.front() : f.y.back();
  if (extension == Extension::linear && f.x.size() > 1) return segment(f, on_the_left ? 0 : f.x.size() - 2, at);
  throw Error("out-of-function",
              fmt::format("{} = {} lies outside the function {}({}), which is defined from {} to {}", f.parameter, at,
                          f.name.empty() ? f.result : f.name, f.parameter, f.x.front(), f.x.back()),
              fmt::format("extend the function on the {}", on_the_left ? "left" : "right"));
}

}  // namespace

void TabulatedFunction::sort_points() {
  std::vector<std::size_t> order(x.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return x[i]; });
  std::vector<double> sorted_x, sorted_y;
  for (const std::size_t i : order) {
    sorted_x.push_back(x[i]);
    sorted_y.push_back(y[i]);
  }
  x = std::move(sorted_x);
  y = std::move(sorted_y);
}

double TabulatedFunction::operator()(double at) const {
  assert(!x.empty() && x.size() == y.size());
  const double margin = end_tolerance * std::max(std::abs(x.front()), std::abs(x.back()));
  if (std::isnan(at)) throw Error("out-of-function", fmt::format("{} is not a number", parameter));
  if (at < x.front()) return at >= x.front() - margin ? y.front() : beyond(*this, at, true);
  if (at > x.back()) return at <= x.back() + margin ? y.back() : beyond(*this, at, false);
  const auto above = std::lower_bound(x.begin(), x.end(), at);
  const auto index = static_cast<std::size_t>(above - x.begin());
  if (*above == at) return y[index];
  return segment(*this, index - 1, at);
}

}  // namespace comma::solver
