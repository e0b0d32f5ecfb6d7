#include "solver/contact/polygon.hpp"

#include <cmath>
#include <numbers>
#include <random>

#include <catch2/catch.hpp>

using namespace comma::solver;

namespace {

/// Convex, counter-clockwise: corners at random angles on an ellipse.
Polygon random_convex(std::mt19937& random) {
  std::uniform_real_distribution<double> angle(0.0, 2.0 * std::numbers::pi);
  std::uniform_real_distribution<double> shift(-0.5, 0.5);
  std::vector<double> angles(6);
  for (double& each : angles) each = angle(random);
  std::sort(angles.begin(), angles.end());
  const Eigen::Vector2d centre(shift(random), shift(random));
  Polygon polygon;
  for (const double each : angles) polygon.push_back(centre + Eigen::Vector2d(std::cos(each), 0.6 * std::sin(each)));
  return polygon;
}

}  // namespace

TEST_CASE("What two polygons have in common does not depend on which clips which") {
  std::mt19937 random(7);
  for (int k = 0; k < 200; ++k) {
    const Polygon a = random_convex(random);
    const Polygon b = random_convex(random);
    CHECK(signed_area(clipped(a, b)) == Approx(signed_area(clipped(b, a))).margin(1e-14));
    CHECK(signed_area(clipped(a, a)) == Approx(signed_area(a)).epsilon(1e-14));
  }
}

TEST_CASE("The parts of a polygon on the squares of a grid add up to the whole") {
  std::mt19937 random(11);
  for (int k = 0; k < 50; ++k) {
    const Polygon polygon = random_convex(random);
    double sum = 0.0;
    for (int i = -8; i < 8; ++i)
      for (int j = -8; j < 8; ++j) {
        const double x = 0.25 * i;
        const double y = 0.25 * j;
        sum += signed_area(clipped(polygon, {{x, y}, {x + 0.25, y}, {x + 0.25, y + 0.25}, {x, y + 0.25}}));
      }
    CHECK(sum == Approx(signed_area(polygon)).epsilon(1e-14));
  }
}

TEST_CASE("Triangles make up a polygon, whatever its corners begin with") {
  std::mt19937 random(5);
  for (int k = 0; k < 50; ++k) {
    const Polygon polygon = random_convex(random);
    const Polygon turned = about_mean(polygon);
    double sum = 0.0;
    for (const auto& [i, j, l] : triangles_of(turned.size())) sum += signed_area({turned[i], turned[j], turned[l]});
    CHECK(sum == Approx(-signed_area(polygon)).epsilon(1e-14));  // clockwise
  }
  CHECK(about_mean({{1, 1}, {0, 1}, {1, 0}, {0, 0}}) == Polygon{{0, 0}, {0, 1}, {1, 1}, {1, 0}});
  const std::vector<std::array<std::size_t, 3>> seven = {{0, 1, 2}, {2, 3, 4}, {4, 5, 6}, {6, 0, 2}, {2, 4, 6}};
  CHECK(triangles_of(7) == seven);
}

TEST_CASE("Polygons that only touch have nothing in common") {
  const Polygon square = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  CHECK(clipped({{1, 0}, {2, 0}, {2, 1}, {1, 1}}, square).empty());
  CHECK(clipped({{1, 1}, {2, 1}, {2, 2}}, square).empty());
  CHECK(clipped({{5, 5}, {6, 5}, {6, 6}}, square).empty());
}
