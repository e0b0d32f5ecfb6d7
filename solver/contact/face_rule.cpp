#include "solver/contact/face_rule.hpp"

#include <array>
#include <cmath>
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
constexpr int default_newton_cotes_order = 3;

/// Points of [-1, 1] and their weights.
using Line = std::vector<std::pair<double, double>>;

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
Line gauss_line(int count) {
  if (count == 1) return {{0.0, 2.0}};
  Line line;
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

Line simpson_line(int pieces) {
  Line line;
  const int count = 2 * pieces + 1;
  const double third = 1.0 / (3.0 * pieces);
  for (int k = 0; k < count; ++k) {
    const bool is_end = k == 0 || k == count - 1;
    line.emplace_back(-1.0 + static_cast<double>(k) / pieces, third * (is_end ? 1.0 : k % 2 == 1 ? 4.0 : 2.0));
  }
  return line;
}

/// Closed, on equidistant points: the weights that integrate the monomials exactly.
Line newton_cotes_line(int order) {
  const int count = order + 1;
  Eigen::MatrixXd powers(count, count);
  Eigen::VectorXd integrals(count);
  for (int degree = 0; degree < count; ++degree) {
    for (int k = 0; k < count; ++k) powers(degree, k) = std::pow(-1.0 + 2.0 * k / order, degree);
    integrals[degree] = degree % 2 == 0 ? 2.0 / (degree + 1) : 0.0;
  }
  const Eigen::VectorXd weights = powers.fullPivLu().solve(integrals);
  Line line;
  for (int k = 0; k < count; ++k) line.emplace_back(-1.0 + 2.0 * k / order, weights[k]);
  return line;
}

Line trapezium_line() { return {{-1.0, 1.0}, {1.0, 1.0}}; }

std::vector<FacePoint> on_line(const Line& line) {
  std::vector<FacePoint> points;
  for (const auto& [x, weight] : line) points.push_back({Vector2d(x, 0.0), weight});
  return points;
}

std::vector<FacePoint> on_square(const Line& line) {
  std::vector<FacePoint> points;
  for (const auto& [y, b] : line)
    for (const auto& [x, a] : line) points.push_back({Vector2d(x, y), a * b});
  return points;
}

[[noreturn]] void throw_no_triangle_rule(std::string_view rule, int order) {
  throw Error("unsupported", fmt::format("triangles have no {} rule of order {}", rule, order), "give a lower order (ORDRE_INT)");
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

std::vector<FacePoint> gauss_triangle(int order) {
  constexpr std::array<std::string_view, 6> families = {"FPG1", "FPG3", "FPG4", "FPG6", "FPG7", "FPG12"};
  if (order > static_cast<int>(families.size())) throw_no_triangle_rule("Gauss", order);
  std::vector<FacePoint> points;
  for (const QuadraturePoint& point : quadrature(CellType::tria3, families[static_cast<std::size_t>(order - 1)]))
    points.push_back({Vector2d(point.at[0], point.at[1]), point.weight});
  return points;
}

std::vector<FacePoint> simpson_triangle(int order) {
  if (order != 1) throw_no_triangle_rule("Simpson", order);
  return corners_and_middles(1.0 / 30, 4.0 / 30);
}

/// Closed rules on the triangle (Stroud, Approximate Calculation of Multiple Integrals, 1971).
std::vector<FacePoint> newton_cotes_triangle(int order) {
  if (order == 1) return triangle_corners();
  if (order == 2) return corners_and_middles(0.0, 1.0 / 6);
  if (order != 3) throw_no_triangle_rule("Newton-Cotes", order);
  std::vector<FacePoint> points;
  for (int j = 0; j <= order; ++j) {
    for (int i = 0; i + j <= order; ++i) {
      const int zeros = (i == 0) + (j == 0) + (i + j == order);
      points.push_back({Vector2d(i / 3.0, j / 3.0), zeros == 2 ? 1.0 / 60 : zeros == 1 ? 3.0 / 80 : 9.0 / 40});
    }
  }
  return points;
}

bool is_triangle(CellType type) { return corner_count(type) == 3; }

Line line_of(ContactRule rule, int order) {
  switch (rule) {
    case ContactRule::gauss: return gauss_line(order);
    case ContactRule::simpson: return simpson_line(order);
    case ContactRule::newton_cotes: return newton_cotes_line(order);
    case ContactRule::automatic: break;
  }
  return trapezium_line();
}

std::vector<FacePoint> triangle_rule(ContactRule rule, int order) {
  switch (rule) {
    case ContactRule::gauss: return gauss_triangle(order);
    case ContactRule::simpson: return simpson_triangle(order);
    case ContactRule::newton_cotes: return newton_cotes_triangle(order);
    case ContactRule::automatic: break;
  }
  return triangle_corners();
}

int default_order(ContactRule rule) {
  switch (rule) {
    case ContactRule::gauss: return default_gauss_order;
    case ContactRule::simpson: return default_simpson_order;
    case ContactRule::newton_cotes: return default_newton_cotes_order;
    case ContactRule::automatic: break;
  }
  return 1;
}

}  // namespace

std::vector<FacePoint> face_rule(CellType type, ContactRule rule, int order) {
  facet_shape(type, facet_centre(type));  // throws where the cell is no facet
  const bool is_quadratic = node_count(type) > corner_count(type);
  if (rule == ContactRule::automatic && is_quadratic) rule = ContactRule::simpson;
  if (order <= 0) order = default_order(rule);
  if (is_triangle(type)) return triangle_rule(rule, order);
  return dimension(type) == 1 ? on_line(line_of(rule, order)) : on_square(line_of(rule, order));
}

}  // namespace comma::solver
