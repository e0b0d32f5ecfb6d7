#include "solver/mesh/box_tree.hpp"

#include <random>

#include <catch2/catch.hpp>

using namespace comma::solver;
using Eigen::Vector3d;

TEST_CASE("The tree finds the nearest box that a scan finds, visiting few") {
  std::mt19937 generator(9);
  std::uniform_real_distribution<double> place(0.0, 100.0);
  std::vector<Box> boxes;
  for (int i = 0; i < 2000; ++i) {
    const Vector3d corner(place(generator), place(generator), place(generator));
    boxes.emplace_back(corner, corner + Vector3d(1, 2, 0.5));
  }
  const BoxTree tree(boxes);
  long visits = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const Vector3d point(place(generator), place(generator), place(generator));
    double nearest = std::numeric_limits<double>::infinity();
    tree.search(point, [&](int item) {
      ++visits;
      nearest = std::min(nearest, boxes[item].exteriorDistance(point));
      return nearest;
    });
    double expected = std::numeric_limits<double>::infinity();
    for (const Box& box : boxes) expected = std::min(expected, box.exteriorDistance(point));
    CHECK(nearest == expected);
  }
  CHECK(visits < 200 * 100);
}

TEST_CASE("An empty tree has nothing to visit") {
  BoxTree({}).search(Vector3d::Zero(), [](int) -> double {
    FAIL("nothing to visit");
    return 0.0;
  });
}
