#include "solver/contact/face_rule.hpp"

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "solver/contact/facet.hpp"
#include "solver/elements/quadrature.hpp"
#include "solver/error.hpp"

namespace comma::solver {
namespace {

using Eigen::Vector2d;

constexpr int default_gauss_order = 3;
constexpr int default_simpson_order = 1;
/// Gauss's rule of as many points as a quadratic triangle has nodes, in their order.
constexpr int order_of_six_points = 4;
constexpr int default_newton_cotes_order = 3;

/// Points of [-1, 1] and their weights.
using LineRule = std::vector<std::pair<double, double>>;

struct Legendre {
  double value;
  double slope;
};

Legendre legendre(int degree, double x) {
  double before = 1.0;
  double now = x;
  for (int k = 2; k <= degree; ++k) before = std::exchange(now, ((2 * k - 1) * x * now - (k - 1) * before) / k);
  return {now, degree * (x * now - before) / (x * x - 1.0)};
}

/// Roots of the Legendre polynomial by Newton's method from their cosine estimates.
LineRule gauss_line(int count) {
  if (count == 1) return {{0.0, 2.0}};
  LineRule line;
  for (int k = count; k >= 1; --k) {
    double x = std::cos(std::numbers::pi * (k - 0.25) / (count + 0.5));
    for (int iteration = 0; iteration < 20; ++iteration) {
      const Legendre p = legendre(count, x);
      x -= p.value / p.slope;
    }
    const double slope = legendre(count, x).slope;
    line.emplace_back(x, 2.0 / ((1.0 - x * x) * slope * slope));
  }
  return line;
}

LineRule simpson_line(int pieces) {
  LineRule line;
  const int count = 2 * pieces + 1;
  const double third = 1.0 / (3.0 * pieces);
  for (int k = 0; k < count; ++k) {
    const bool is_end = k == 0 || k == count - 1;
    line.emplace_back(-1.0 + static_cast<double>(k) / pieces, third * (is_end ? 1.0 : k % 2 == 1 ? 4.0 : 2.0));
  }
  return line;
}

/// Closed, on equidistant points: the weights that integrate the monomials exactly.
LineRule newton_cotes_line(int order) {
  const int count = order + 1;
  Eigen::MatrixXd powers(count, count);
  Eigen::VectorXd integrals(count);
  for (int degree = 0; degree < count; ++degree) {
    for (int k = 0; k < count; ++k) powers(degree, k) = std::pow(-1.0 + 2.0 * k / order, degree);
    integrals[degree] = degree % 2 == 0 ? 2.0 / (degree + 1) : 0.0;
  }
  const Eigen::VectorXd weights = powers.fullPivLu().solve(integrals);
  LineRule line;
  for (int k = 0; k < count; ++k) line.emplace_back(-1.0 + 2.0 * k / order, weights[k]);
  return line;
}

LineRule trapezium_line() { return {{-1.0, 1.0}, {1.0, 1.0}}; }

std::vector<FacePoint> on_line(const LineRule& line) {
  std::vector<FacePoint> points;
  for (const auto& [x, weight] : line) points.push_back({Vector2d(x, 0.0), weight});
  return points;
}

std::vector<FacePoint> on_square(const LineRule& line) {
  std::vector<FacePoint> points;
  for (const auto& [y, b] : line)
    for (const auto& [x, a] : line) points.push_back({Vector2d(x, y), a * b});
  return points;
}

/// Nodes of the six-node triangle with a weight for corners and one for middles.
std::vector<FacePoint> corners_and_middles(double corner, double middle) {
  std::vector<FacePoint> points;
  for (int k = 0; k < 6; ++k) points.push_back({facet_node(CellType::tria6, k), k < 3 ? corner : middle});
  return points;
}

std::vector<FacePoint> triangle_corners() {
  std::vector<FacePoint> points;
  for (int k = 0; k < 3; ++k) points.push_back({facet_node(CellType::tria3, k), 1.0 / 6});
  return points;
}

/// Dunavant's rule of degree 6 (International Journal for Numerical Methods in Engineering 21, 1985), FPG12 of
/// R3.01.01: two orbits of three points and one of six. Weights here are for the unit area.
std::vector<FacePoint> twelve_points() {
  constexpr double a = 0.249286745170910, a_weight = 0.116786275726379;
  constexpr double b = 0.063089014491502, b_weight = 0.050844906370207;
  constexpr double c = 0.310352451033785, d = 0.053145049844816, c_weight = 0.082851075618374;
  std::vector<FacePoint> points;
  const auto add = [&](double x, double y, double weight) { points.push_back({Vector2d(x, y), 0.5 * weight}); };
  for (const auto& [at, weight] : {std::pair(a, a_weight), std::pair(b, b_weight)}) {
    add(at, at, weight);
    add(1.0 - 2.0 * at, at, weight);
    add(at, 1.0 - 2.0 * at, weight);
  }
  constexpr std::array<double, 3> all = {c, d, 1.0 - c - d};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      if (i != j) add(all[i], all[j], c_weight);
  return points;
}

std::vector<FacePoint> gauss_triangle(int order) {
  constexpr std::array<std::string_view, 5> families = {"FPG1", "FPG3", "FPG4", "FPG6", "FPG7"};
  if (order == static_cast<int>(families.size()) + 1) return twelve_points();
  if (order > static_cast<int>(families.size()))
    throw Error("unsupported", fmt::format("triangles have no Gauss rule of order {}", order),
                "give an order (ORDRE_INT) of 6 at most");
  std::vector<FacePoint> points;
  for (const QuadraturePoint& point : quadrature(CellType::tria3, families[static_cast<std::size_t>(order - 1)]))
    points.push_back({Vector2d(point.at[0], point.at[1]), point.weight});
  return points;
}

/// The weights of the corners and middles of each of order^2 like triangles, added up where these meet.
std::vector<FacePoint> simpson_triangle(int order) {
  if (order == 1) return corners_and_middles(1.0 / 30, 4.0 / 30);
  const int parts = 2 * order;  // lattice of corners and middles
  std::map<std::pair<int, int>, double> weights;
  const auto add_triangle = [&](int i, int j, int side) {
    const std::array<std::pair<int, int>, 3> corners = {std::pair(i, j), std::pair(i + side, j),
                                                        std::pair(i, j + side)};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& [x, y] = corners[k];
      const auto& [next_x, next_y] = corners[(k + 1) % 3];
      weights[corners[k]] += 1.0 / 30 / (order * order);
      weights[{(x + next_x) / 2, (y + next_y) / 2}] += 4.0 / 30 / (order * order);
    }
  };
  for (int j = 0; j < parts; j += 2)
    for (int i = 0; i + j < parts; i += 2) {
      add_triangle(i, j, 2);
      if (i + j + 4 <= parts) add_triangle(i + 2, j + 2, -2);
    }
  std::vector<FacePoint> points;
  for (const auto& [at, weight] : weights) points.push_back({Vector2d(at.first, at.second) / parts, weight});
  return points;
}

/// Closed, on the lattice of `order` parts a side: the weights that integrate all monomials of that degree exactly
/// (Stroud, Approximate Calculation of Multiple Integrals, 1971, gives those of low order).
std::vector<FacePoint> newton_cotes_triangle(int order) {
  std::vector<FacePoint> points;
  for (int j = 0; j <= order; ++j)
    for (int i = 0; i + j <= order; ++i) points.push_back({Vector2d(i, j) / order, 0.0});
  const auto count = static_cast<Eigen::Index>(points.size());
  Eigen::MatrixXd powers(count, count);
  Eigen::VectorXd integrals(count);
  Eigen::Index row = 0;
  for (int b = 0; b <= order; ++b)
    for (int a = 0; a + b <= order; ++a, ++row) {
      for (Eigen::Index k = 0; k < count; ++k) {
        const Vector2d& at = points[static_cast<std::size_t>(k)].xi;
        powers(row, k) = std::pow(at[0], a) * std::pow(at[1], b);
      }
      integrals[row] = std::tgamma(a + 1.0) * std::tgamma(b + 1.0) / std::tgamma(a + b + 3.0);
    }
  const Eigen::VectorXd weights = powers.fullPivLu().solve(integrals);
  for (Eigen::Index k = 0; k < count; ++k) points[static_cast<std::size_t>(k)].weight = weights[k];
  // Weights that vanish are rounding: points that carry nothing are none.
  constexpr double nothing = 1e-12;
  std::erase_if(points, [](const FacePoint& point) { return std::abs(point.weight) < nothing; });
  return points;
}

/// A point next to each corner, and one next to each middle.
std::vector<FacePoint> six_points() {
  std::vector<FacePoint> points = gauss_triangle(order_of_six_points);
  for (std::size_t k = 0; k < points.size(); ++k) points[k].stands_for = static_cast<int>(k);
  return points;
}

bool is_triangle(CellType type) { return corner_count(type) == 3; }

LineRule line_of(ContactRule rule, int order) {
  switch (rule) {
    case ContactRule::gauss:
      return gauss_line(order);
    case ContactRule::simpson:
      return simpson_line(order);
    case ContactRule::newton_cotes:
      return newton_cotes_line(order);
    case ContactRule::automatic:
      break;
  }
  return trapezium_line();
}

std::vector<FacePoint> triangle_rule(ContactRule rule, int order) {
  switch (rule) {
    case ContactRule::gauss:
      return gauss_triangle(order);
    case ContactRule::simpson:
      return simpson_triangle(order);
    case ContactRule::newton_cotes:
      return newton_cotes_triangle(order);
    case ContactRule::automatic:
      break;
  }
  return triangle_corners();
}

int default_order(ContactRule rule) {
  switch (rule) {
    case ContactRule::gauss:
      return default_gauss_order;
    case ContactRule::simpson:
      return default_simpson_order;
    case ContactRule::newton_cotes:
      return default_newton_cotes_order;
    case ContactRule::automatic:
      break;
  }
  return 1;
}

}  // namespace

std::vector<FacePoint> face_rule(CellType type, ContactRule rule, int order) {
  facet_shape(type, facet_centre(type));  // throws where the cell is no facet
  const bool is_quadratic = node_count(type) > corner_count(type);
  if (rule == ContactRule::automatic && is_quadratic) {
    if (is_triangle(type)) return six_points();
    rule = ContactRule::simpson;
  }
  if (order <= 0) order = default_order(rule);
  if (is_triangle(type)) return triangle_rule(rule, order);
  return dimension(type) == 1 ? on_line(line_of(rule, order)) : on_square(line_of(rule, order));
}

}  // namespace comma::solver
