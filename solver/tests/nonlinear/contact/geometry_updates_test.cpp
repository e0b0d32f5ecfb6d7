#include "solver/nonlinear/contact/geometry_updates.hpp"

#include <cmath>
#include <tuple>

#include <catch2/catch.hpp>

#include "solver/tests/exactly.hpp"
#include "solver/tests/nonlinear/scene.hpp"

using namespace comma::solver;
using comma::solver::testing::Scene;

namespace {

/// One square, whose first node alone moves along x.
struct MovingCorner {
  Scene scene;
  Scene::Block block = scene.block("b", {0, 0}, {1, 1}, 1, 1, 1.0, 0.0);
  const Model& model = *scene.problem.model;
  DofMap dofs{model};
  ContactDefinition contact;

  Eigen::VectorXd at(double x) const {
    Eigen::VectorXd u = Eigen::VectorXd::Zero(dofs.size());
    u[dofs.dof(block.nodes[0][0], Component::dx)] = x;
    return u;
  }
};

std::vector<ContactPair> facing(int facet) {
  ContactPair pair;
  pair.facet = facet;
  return {pair};
}

}  // namespace

TEST_CASE("Updates of the geometry end when it moves by less than a share of the displacement of the step") {
  MovingCorner corner;
  corner.contact.geometry_tolerance = 0.02;
  const Eigen::VectorXd start = corner.at(1.0);
  GeometryUpdates updates(corner.contact, *corner.model.mesh, corner.dofs, start);
  CHECK_FALSE(updates.settled(start, corner.at(2.0)));
  // 0.015 of the displacement itself, but 0.03 of that of the step.
  CHECK_FALSE(updates.settled(corner.at(2.0), corner.at(2.03)));
  CHECK(updates.settled(corner.at(2.03), corner.at(2.039)));
}

TEST_CASE("A move counts as a share of the displacement that the step had before it") {
  MovingCorner corner;
  corner.contact.geometry_tolerance = 0.4;
  const Eigen::VectorXd start = corner.at(1.0);
  GeometryUpdates updates(corner.contact, *corner.model.mesh, corner.dofs, start);
  CHECK_FALSE(updates.settled(corner.at(2.0), corner.at(2.5)));  // 0.5 of it; a third of the present one
  CHECK(updates.settled(corner.at(2.5), corner.at(2.0)));
  CHECK(geometry_change(*corner.model.mesh, corner.dofs, start, start, corner.at(2.0)).share == exactly(1.0));
}

TEST_CASE("Nothing is asked of a geometry that moves by the rounding of its places") {
  MovingCorner corner;
  corner.contact.geometry_tolerance = 1e-12;
  const Eigen::VectorXd start = corner.at(0.0);
  GeometryUpdates updates(corner.contact, *corner.model.mesh, corner.dofs, start);
  // In a square of side 1: the last bits of 1 are 2e-16.
  CHECK_FALSE(updates.settled(start, corner.at(1e-6)));
  CHECK_FALSE(updates.settled(corner.at(1e-6), corner.at(1e-6 + 1e-15)));
  CHECK(updates.settled(corner.at(1e-6), corner.at(1e-6 + 1e-16)));
}

TEST_CASE("A geometry that goes to and fro within what is tolerated is settled, and says by how much") {
  MovingCorner corner;
  corner.contact.geometry_tolerance = 1e-12;
  const Eigen::VectorXd start = corner.at(0.0);
  for (const auto& [tolerated, hop, ends] : {std::tuple{0.01, 1e-3, true}, {0.01, 0.02, false}, {0.0, 1e-3, false}}) {
    corner.contact.restless_tolerance = tolerated;
    GeometryUpdates updates(corner.contact, *corner.model.mesh, corner.dofs, start);
    bool settled = false;
    for (int update = 0; update < 50 && !settled; ++update)
      settled = updates.settled(corner.at(1.0 + hop * (update % 2)), corner.at(1.0 + hop * (1 - update % 2)));
    CHECK(settled == ends);
    CHECK(updates.restless() == Approx(ends ? hop : 0.0).epsilon(2e-3));
  }
  // One that comes nearer to rest, however slowly, goes on.
  corner.contact.restless_tolerance = 0.01;
  GeometryUpdates updates(corner.contact, *corner.model.mesh, corner.dofs, start);
  double hop = 1e-3;
  for (int update = 0; update < 100; ++update, hop *= 0.92)
    REQUIRE_FALSE(updates.settled(corner.at(1.0), corner.at(1.0 + hop)));
}

TEST_CASE("Updates that overshoot are relaxed, those that come to rest by themselves are not") {
  MovingCorner corner;
  corner.contact.geometry_tolerance = 1e-7;
  corner.contact.max_geometry_updates = 100;
  const Eigen::VectorXd start = corner.at(0.0);
  for (const double slope : {-1.5, -4.0, 0.3}) {
    GeometryUpdates updates(corner.contact, *corner.model.mesh, corner.dofs, start);
    // Paired at x, bodies go to 1 + slope x.
    double paired = 0.0;
    double now = 1.0;
    int count = 1;
    for (; !updates.settled(corner.at(paired), corner.at(now)) && count < 30; ++count) {
      const Eigen::VectorXd next = updates.relaxed(corner.at(paired), corner.at(now));
      if (slope > 0.0) CHECK(next == corner.at(now));
      paired = next[corner.dofs.dof(corner.block.nodes[0][0], Component::dx)];
      now = 1.0 + slope * paired;
    }
    CHECK(now == Approx(1.0 / (1.0 - slope)).epsilon(1e-7));
    CHECK(count < (slope > 0.0 ? 20 : 10));
  }
}

TEST_CASE("Updates that come nearer to rest are accelerated where many digits are wanted") {
  MovingCorner corner;
  corner.contact.max_geometry_updates = 100;
  const Eigen::VectorXd start = corner.at(0.0);
  const int x = corner.dofs.dof(corner.block.nodes[0][0], Component::dx),
            y = corner.dofs.dof(corner.block.nodes[0][0], Component::dy);
  const auto count_updates = [&](double tolerance) {
    corner.contact.geometry_tolerance = tolerance;
    GeometryUpdates updates(corner.contact, *corner.model.mesh, corner.dofs, start);
    // Near its rest at (1, 2), where it is paired with errors d, the corner goes on with 0.8 and 0.4 of them.
    Eigen::VectorXd paired = corner.at(0.999);
    paired[y] = 2.001;
    for (int count = 1;; ++count) {
      Eigen::VectorXd now = paired;
      now[x] = 1.0 + 0.8 * (paired[x] - 1.0);
      now[y] = 2.0 + 0.4 * (paired[y] - 2.0);
      if (updates.settled(paired, now)) {
        CHECK(std::hypot(now[x] - 1.0, now[y] - 2.0) <= 20.0 * tolerance);
        return count;
      }
      paired = updates.relaxed(paired, now);
    }
  };
  CHECK(count_updates(1e-7) > 25);
  CHECK(count_updates(1e-11) < 8);
}

TEST_CASE("Points keep their facets within a margin that grows with updates that do not settle") {
  MovingCorner corner;
  corner.contact.max_geometry_updates = 10;
  const Eigen::VectorXd start = corner.at(0.0);
  GeometryUpdates updates(corner.contact, *corner.model.mesh, corner.dofs, start);
  for (int update = 0; update < 10; ++update) {
    if (update < 5) CHECK(updates.margin() == 0.0);
    // Three updates are left to settle within the widest one.
    if (update >= 7) CHECK(updates.margin() == exactly(0.05));
    updates.settled(corner.at(update % 2), corner.at(1 - update % 2));
  }
  corner.contact.geometry_update = GeometryUpdate::controlled;
  CHECK(updates.margin() == 0.0);
}

TEST_CASE("A prescribed number of updates is done, however far the geometry moves") {
  MovingCorner corner;
  corner.contact.geometry_update = GeometryUpdate::controlled;
  corner.contact.controlled_updates = 2;
  const Eigen::VectorXd start = corner.at(0.0);
  GeometryUpdates updates(corner.contact, *corner.model.mesh, corner.dofs, start);
  CHECK_FALSE(updates.settled(start, corner.at(1.0)));
  CHECK_NOTHROW(updates.require_more(1.0));
  CHECK(updates.settled(corner.at(1.0), corner.at(5.0)));
}

TEST_CASE("Updates that run out tell of facets that return in turn, or of a geometry that does not settle") {
  MovingCorner corner;
  corner.contact.geometry_update = GeometryUpdate::automatic;
  corner.contact.max_geometry_updates = 4;
  const Eigen::VectorXd start = corner.at(0.0);
  for (const bool cycles : {true, false}) {
    GeometryUpdates updates(corner.contact, *corner.model.mesh, corner.dofs, start);
    for (int update = 0; update < 4; ++update) {
      CHECK_NOTHROW(updates.require_more(1.0));
      const double before = update % 2;
      CHECK_FALSE(updates.settled(corner.at(before), corner.at(1.0 - before)));
      updates.note_cycle(facing(cycles ? update % 2 : update));
    }
    CHECK_THROWS_WITH(updates.require_more(1.0),
                      Catch::Contains(cycles ? "return in turn" : "did not settle within 4 updates"));
  }
}
