#include "solver/contact_law/smoothed_contact.hpp"

#include <catch2/catch.hpp>

#include "solver/tests/contact_law/coupled_points.hpp"

using namespace comma::solver;

namespace {

constexpr int corners = 4;

/// Four points on nodes and one in the middle of them.
struct WithMiddle : Coupled {
  WithMiddle(double friction, double augmentation) : Coupled(corners + 1, friction) {
    problem.node_count = corners;
    state.multipliers.setZero(3 * corners);
    CondensedPoint& middle = problem.points.back();
    middle.node_count = corners;
    for (int i = 0; i < corners; ++i) {
      middle.nodes[static_cast<std::size_t>(i)] = i;
      middle.shape[static_cast<std::size_t>(i)] = 0.25;
    }
    for (CondensedPoint& point : problem.points)
      point.law.augmentation = point.law.friction_augmentation = augmentation;
  }
};

/// What it finds is that of Newton's method on statuses.
template <class Scene>
void check_solution(Scene smoothed, Scene solved) {
  Eigen::VectorXd jumps = smoothed.problem.free;
  std::vector<PointStiffness> stiffness;
  REQUIRE(smooth_condensed(smoothed.schur, smoothed.problem, smoothed.state, jumps, stiffness, Augmentations::of_law));
  REQUIRE(solve_condensed(solved.schur, solved.problem, solved.state).verdict == CondensedVerdict::solved);
  CAPTURE(smoothed.state.multipliers.transpose(), solved.state.multipliers.transpose(),
          smoothed.problem.points[0].law.augmentation);
  CHECK(smoothed.state.statuses == solved.state.statuses);
  // Pressures are rounded off by 1e-9 of the largest, and what is left may be 1e-7 of the jumps.
  CHECK((smoothed.state.multipliers - solved.state.multipliers).norm() < 1e-6 * solved.state.multipliers.norm());
}

}  // namespace

TEST_CASE("Laws that are smooth at first end where statuses settle, whatever the augmentation on nodes") {
  for (const double friction : {0.0, 0.2, 1.0})
    for (const double augmentation : {1e-6, 1.0, 1e6}) {
      Coupled scene(6, friction);
      for (CondensedPoint& point : scene.problem.points)
        point.law.augmentation = point.law.friction_augmentation = augmentation;
      check_solution(scene, scene);
    }
}

TEST_CASE("They find the solution of penalties, however stiff") {
  for (const double penalty : {1.0, 1e4, 1e8}) {
    Coupled scene(6, 0.4);
    for (CondensedPoint& point : scene.problem.points) {
      point.law.penalised = point.law.friction_penalised = true;
      point.law.augmentation = point.law.friction_augmentation = penalty;
    }
    check_solution(scene, scene);
  }
}

TEST_CASE("Between nodes they end with the augmentations of the law") {
  for (const double augmentation : {0.05, 1.0, 20.0})
    check_solution(WithMiddle(0.3, augmentation), WithMiddle(0.3, augmentation));
}

TEST_CASE("So they do where some points have no friction along one direction, and share multipliers with others") {
  for (const double augmentation : {0.05, 1.0, 20.0}) {
    WithMiddle scene(0.3, augmentation);
    for (const std::size_t p : {0U, 1U, 4U}) scene.problem.points[p].law.dead = Eigen::Vector2d(0.6, 0.8);
    check_solution(scene, scene);
  }
}

TEST_CASE("Shears alone may keep the augmentation of the bodies") {
  WithMiddle scene(0.3, 0.05), solved(0.3, 0.05);
  Eigen::VectorXd jumps = scene.problem.free;
  std::vector<PointStiffness> stiffness;
  REQUIRE(smooth_condensed(scene.schur, scene.problem, scene.state, jumps, stiffness, Augmentations::of_pressures));
  for (std::size_t p = 0; p < solved.problem.points.size(); ++p)
    solved.problem.points[p].law.friction_augmentation = stiffness[p].along;
  REQUIRE(solve_condensed(solved.schur, solved.problem, solved.state).verdict == CondensedVerdict::solved);
  CHECK((scene.state.multipliers - solved.state.multipliers).norm() < 1e-6 * solved.state.multipliers.norm());
}

TEST_CASE("A point that is held along one direction of the surface takes no shear there") {
  Coupled scene(3, 0.5);
  for (CondensedPoint& point : scene.problem.points) point.law.dead = Eigen::Vector2d(0.6, 0.8);
  scene.problem.free.setZero();
  for (int p = 0; p < 3; ++p) scene.problem.free.segment<3>(3 * p) << -1.0, 0.08, -0.06;  // across the dead direction
  scene.state.multipliers.setConstant(0.3);
  Coupled smoothed = scene;
  REQUIRE(solve_condensed(scene.schur, scene.problem, scene.state).verdict == CondensedVerdict::solved);
  for (int p = 0; p < 3; ++p)
    CHECK(std::abs(scene.state.multipliers.segment<2>(3 * p + 1).dot(Eigen::Vector2d(0.6, 0.8))) < 1e-14);
  CHECK(scene.state.multipliers.segment<2>(1).norm() > 0.01);
  Eigen::VectorXd jumps = smoothed.problem.free;
  std::vector<PointStiffness> stiffness;
  REQUIRE(smooth_condensed(smoothed.schur, smoothed.problem, smoothed.state, jumps, stiffness, Augmentations::of_law));
  CHECK((smoothed.state.multipliers - scene.state.multipliers).norm() < 1e-6 * scene.state.multipliers.norm());
}
