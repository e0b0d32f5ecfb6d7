#include <cmath>

#include <catch2/catch.hpp>

#include "solver/error.hpp"
#include "solver/fields/stresses/equivalent.hpp"
#include "solver/tests/exactly.hpp"

using namespace comma::solver;

namespace {

ElementField stress(std::vector<double> values) {
  std::vector<std::string> names = {"SIXX", "SIYY", "SIZZ", "SIXY", "SIXZ", "SIYZ"};
  names.resize(values.size());
  return {"SIEF_R", Support::gauss_point, names, {0, 1}, std::move(values)};
}

double value(const ElementField& field, std::string_view name) { return field.at(0, 0, field.component(name)); }

}  // namespace

TEST_CASE("invariants of known stresses", "[fields]") {
  const ElementField tension = equivalent_stresses(stress({0, 0, 100, 0, 0, 0}));
  CHECK(value(tension, "VMIS") == exactly(100));
  CHECK(value(tension, "TRESCA") == exactly(100));
  CHECK(value(tension, "TRIAX") == exactly(1.0 / 3));
  CHECK(value(tension, "TRSIG") == exactly(100));
  CHECK(std::abs(value(tension, "VECT_3_Z")) == exactly(1));
  const ElementField shear = equivalent_stresses(stress({0, 0, 0, 50}));
  CHECK(value(shear, "VMIS") == exactly(50 * std::sqrt(3.0)));
  CHECK(value(shear, "TRESCA") == exactly(100));
  CHECK(value(shear, "PRIN_1") == exactly(-50));
  CHECK(value(shear, "PRIN_2") == Approx(0).margin(1e-13));
  CHECK(value(shear, "PRIN_3") == exactly(50));
  const ElementField compressed = equivalent_stresses(stress({-30, -10, -10, 0, 0, 0}));
  CHECK(value(compressed, "VMIS_SG") == exactly(-20));
}

TEST_CASE("a hydrostatic state has no von Mises stress and no triaxiality", "[fields]") {
  const ElementField field = equivalent_stresses(stress({-1e8 / 3, -1e8 / 3, -1e8 / 3, 0, 0, 0}));
  CHECK(value(field, "VMIS") == Approx(0).margin(1e-7));
  CHECK(value(field, "TRIAX") == 0.0);
}

TEST_CASE("the second invariant of a strain is the equivalent strain of tension at constant volume", "[fields]") {
  const ElementField strain{
      "EPSI_R", Support::gauss_point, {"EPXX", "EPYY", "EPZZ", "EPXY"}, {0, 1}, {2e-3, -1e-3, -1e-3, 0}};
  const ElementField found = equivalent_strains(strain);
  CHECK(value(found, "INVA_2") == exactly(2e-3));
  CHECK(value(found, "PRIN_3") == exactly(2e-3));
}

TEST_CASE("principal values are invariant and rebuild the tensor", "[fields]") {
  Eigen::Matrix3d tensor;
  tensor << 3, -1, 2, -1, 5, 0.5, 2, 0.5, -4;
  const Principal axes = principal(tensor);
  CHECK(axes.values[0] <= axes.values[1]);
  CHECK(axes.values[1] <= axes.values[2]);
  CHECK((axes.vectors * axes.values.asDiagonal() * axes.vectors.transpose() - tensor).norm() < 1e-13);
}

TEST_CASE("a field without stresses is refused", "[fields]") {
  const ElementField forces{"SIEF_R", Support::gauss_point, {"N"}, {0, 1}, {1.0}};
  CHECK_THROWS_AS(equivalent_stresses(forces), Error);
}
