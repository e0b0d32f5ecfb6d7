#include "solver/io/med_localization.hpp"

#include <numeric>

#include <catch2/catch.hpp>

#include "solver/elements/quadrature.hpp"
#include "solver/tests/exactly.hpp"

using namespace comma::solver;

TEST_CASE("values at Gauss points are placed in a file where the element has them", "[io]") {
  for (const auto formulation : {Formulation::solid, Formulation::plane_strain, Formulation::axisymmetric}) {
    for (int i = 0; i <= static_cast<int>(CellType::hexa27); ++i) {
      const auto type = static_cast<CellType>(i);
      if (dimension(type) != continuum_dimension(formulation) || !has_element(formulation, type)) continue;
      CAPTURE(name_of(type), static_cast<int>(formulation));
      const Quadrature points = quadrature(type, stiffness_family(type, formulation));
      const auto scheme = gauss_scheme(type, static_cast<int>(points.size()));
      REQUIRE(scheme);
      for (std::size_t g = 0; g < points.size(); ++g) {
        CHECK(scheme->weights[g] == exactly(points[g].weight));
        for (std::size_t axis = 0; axis < points[g].at.size(); ++axis)
          CHECK(scheme->points[g][axis] == Approx(points[g].at[axis]).margin(1e-15));
      }
    }
  }
}

TEST_CASE("one point is the centre, two of a line are its ends, and some numbers of points have no scheme", "[io]") {
  CHECK(gauss_scheme(CellType::pyram5, 1)->points.front() == Point{0.0, 0.0, 0.25});
  CHECK(gauss_scheme(CellType::penta6, 1)->weights.front() == exactly(1.0));
  CHECK(gauss_scheme(CellType::seg2, 2)->points.front()[0] == -1.0);
  CHECK_FALSE(gauss_scheme(CellType::hexa8, 5));
}
