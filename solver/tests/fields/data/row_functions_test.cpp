#include "solver/fields/data/row_functions.hpp"

#include <catch2/catch.hpp>

#include <array>
#include <cmath>

#include "solver/error.hpp"
#include "solver/tests/exactly.hpp"

using namespace comma::solver;

namespace {

// A cell with uniaxial stress and one with pure shear, which a plane body describes without xz and yz.
const ElementField stresses{"SIEF_R",
                            Support::gauss_point,
                            {"SIXX", "SIYY", "SIZZ", "SIXY"},
                            {0, 1, 1, 3},
                            {12.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 5.0, absent, absent, absent, absent}};

double at(const RowFunction& function, int cell, int point) {
  return std::get<ElementField>(made_of_rows(stresses, std::array{function})).at(cell, point, 0);
}

}  // namespace

TEST_CASE("criteria of a tensor, point by point", "[fields]") {
  const auto of = [](TensorCriterion which) { return criterion(stresses.components, which); };
  CHECK(at(of(TensorCriterion::von_mises), 0, 0) == exactly(12.0));
  CHECK(at(of(TensorCriterion::von_mises), 2, 0) == exactly(5.0 * std::sqrt(3.0)));
  CHECK(at(of(TensorCriterion::tresca), 2, 0) == exactly(10.0));
  CHECK(at(of(TensorCriterion::second_invariant), 0, 0) == exactly(8.0));
  CHECK(at(of(TensorCriterion::trace), 0, 0) == exactly(12.0));
  CHECK(std::isnan(at(of(TensorCriterion::trace), 2, 1)));
  CHECK_THROWS_AS(criterion({"DX", "DY"}, TensorCriterion::trace), Error);
}

TEST_CASE("norms count the halves of a tensor once or twice", "[fields]") {
  CHECK(at(euclidean_norm(), 2, 0) == exactly(5.0));
  CHECK(at(euclidean_norm(frobenius_weights(stresses.components)), 2, 0) == exactly(5.0 * std::sqrt(2.0)));
  CHECK(frobenius_weights({"DX", "EPYZ"}) == std::vector<double>{1.0, 2.0});
}

TEST_CASE("formulas take components by their names", "[fields]") {
  const ValueFunction sum{{"SIXY", "SIXX"}, [](std::span<const double> x) { return 2.0 * x[0] + x[1]; }};
  const Field field = made_of_rows(stresses, std::array{formula(stresses.components, sum), euclidean_norm()});
  const auto& made = std::get<ElementField>(field);
  CHECK(made.components == std::vector<std::string>{"X1", "X2"});
  CHECK(made.at(0, 0, 0) == exactly(12.0));
  CHECK(made.at(2, 0, 0) == exactly(10.0));
  CHECK(std::isnan(made.at(2, 1, 0)));
  CHECK_THROWS_AS(formula(stresses.components, ValueFunction{{"SIXZ"}, {}}), Error);
}
