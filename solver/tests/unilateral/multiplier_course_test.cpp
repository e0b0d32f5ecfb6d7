#include "solver/unilateral/multiplier_course.hpp"

#include <catch2/catch.hpp>

using namespace comma::solver;

namespace {

Eigen::VectorXd at(double time) { return Eigen::Vector3d(time + 0.1 * time * time * time, 2.0 - time, 0.0); }

}  // namespace

TEST_CASE("A course goes on as its last steps do, of whatever length") {
  MultiplierCourse course;
  CHECK(course.expected(0.1, at(0.1)) == at(0.1));
  for (const double time : {0.1, 0.2, 0.4, 0.5, 0.7}) course.note(time, at(time));
  CHECK((course.expected(0.8, at(0.7)) - at(0.8)).norm() < 1e-13);
  SECTION("from other multipliers it does not") { CHECK(course.expected(0.8, at(0.6)) == at(0.6)); }
  SECTION("nor at the time of the last step") { CHECK(course.expected(0.7, at(0.7)) == at(0.7)); }
  SECTION("none becomes negative") { CHECK(course.expected(3.0, at(0.7))[1] == 0.0); }
  SECTION("a step that is taken once more leaves no trace") {
    course.note(0.6, at(0.6));
    CHECK((course.expected(0.8, at(0.6)) - at(0.8)).norm() < 1e-13);
  }
}

TEST_CASE("What the first step begins with foretells the next two, and nothing afterwards") {
  MultiplierCourse course;
  const auto bent = [](double time) -> Eigen::VectorXd {
    return Eigen::Vector2d::Constant(time > 0.0 ? 1.0 + time * time : 0.0);
  };
  course.begin(0.0, bent(0.0));
  course.note(0.1, bent(0.1));
  course.begin(0.05, bent(0.05));
  CHECK((course.expected(0.2, bent(0.1)) - 2.0 * bent(0.1)).norm() < 1e-13);
  course.note(0.2, bent(0.2));
  course.note(0.3, bent(0.3));
  CHECK((course.expected(0.4, bent(0.3)) - bent(0.4)).norm() < 1e-13);
}

TEST_CASE("A course that jumps is expected to stay where it is") {
  MultiplierCourse course;
  const Eigen::VectorXd low = Eigen::VectorXd::Constant(2, 1.0), high = Eigen::VectorXd::Constant(2, 2.0);
  for (const double time : {1.0, 2.0, 3.0}) course.note(time, low);
  course.note(4.0, high);
  CHECK(course.expected(5.0, high) == high);
}
