#include <cmath>

#include <catch2/catch.hpp>

#include "solver/fields/stresses/beam_stresses.hpp"
#include "solver/tests/elements/sample_meshes.hpp"
#include "solver/tests/exactly.hpp"

using namespace comma::solver;
using namespace comma::solver::testing;

namespace beam_stresses_test {

/// A section of 0.2 along y and 0.1 along z.
BeamSection rectangle() {
  BeamSection section;
  section.area = 0.02;
  section.inertia_y = 0.2 * std::pow(0.1, 3) / 12;
  section.inertia_z = 0.1 * std::pow(0.2, 3) / 12;
  section.torsion = 4.58e-5;
  section.shear_y = section.shear_z = 1.2;
  section.shape = SectionShape::rectangle;
  section.reach_y = 0.1;
  section.reach_z = 0.05;
  return section;
}

Body beam(const BeamSection& section) {
  auto mesh = std::make_shared<Mesh>();
  mesh->nodes = {{0, 0, 0}, {2, 0, 0}};
  mesh->add_cell(CellType::seg2, std::array{0, 1});
  ElementProperties properties;
  properties.sections[0] = section;
  return Body(mesh, std::vector{Formulation::timoshenko_beam}, elastic(2e11, 0.3), properties);
}

ElementField forces(std::vector<double> values) {
  std::vector<double> both = values;
  both.insert(both.end(), values.begin(), values.end());
  return {"SIEF_R", Support::element_node, {"N", "VY", "VZ", "MT", "MFY", "MFZ"}, {0, 2}, both};
}

FieldInput input_of(const Body& body) { return {body.model, body.materials, body.properties, body.assembler->state()}; }

TEST_CASE("each section force gives the stress of beam theory at the outermost fibre", "[fields]") {
  const Body body = beam(rectangle());
  const ElementField stress = force_stresses(input_of(body), forces({10, 0, 0, 0, 3, 4}));
  CHECK(stress.at(0, 1, 0) == exactly(10 / 0.02));
  CHECK(stress.at(0, 1, 4) == exactly(3 / (0.2 * 0.01 / 6)));   // W = b h^2 / 6
  CHECK(stress.at(0, 1, 5) == exactly(-4 / (0.1 * 0.04 / 6)));  // stretched where y is negative
  CHECK(stress.at(0, 1, 1) == 0.0);
}

TEST_CASE("extreme stresses: both moments at a rectangle's corner, their resultant on a circle's rim", "[fields]") {
  const Body body = beam(rectangle());
  const ElementField corner = extreme_stresses(input_of(body), forces({10, 0, 0, 0, 3, -4}));
  const double bending = 3 / (0.2 * 0.01 / 6) + 4 / (0.1 * 0.04 / 6);
  CHECK(corner.at(0, 0, 0) == exactly(10 / 0.02 - bending));
  CHECK(corner.at(0, 0, 1) == exactly(10 / 0.02 + bending));
  BeamSection circle = rectangle();
  circle.shape = SectionShape::circle;
  circle.reach_y = circle.reach_z = 0.1;
  circle.inertia_y = circle.inertia_z = std::acos(-1.0) * 1e-4 / 4;
  const Body rod = beam(circle);
  CHECK(extreme_stresses(input_of(rod), forces({0, 0, 0, 0, 3, 4})).at(0, 0, 1) == exactly(5 * 0.1 / circle.inertia_y));
  BeamSection general = rectangle();
  general.shape = SectionShape::general;
  const Body unknown = beam(general);
  CHECK(std::isnan(extreme_stresses(input_of(unknown), forces({0, 0, 0, 0, 3, 4})).at(0, 0, 1)));
}

TEST_CASE("generalised strains of a stretched, twisted and bent beam", "[fields]") {
  const Body body = beam(rectangle());
  const double shear = 2e11 / 2.6;
  const ElementField strain =
      generalised_strains(input_of(body), forces({4e9 * 1e-3, 6, 0, shear * 4.58e-5 * 0.02, 0, 0}));
  CHECK(strain.at(0, 0, 0) == exactly(1e-3));
  CHECK(strain.at(0, 0, 1) == exactly(6 * 1.2 / (shear * 0.02)));
  CHECK(strain.at(0, 0, 3) == exactly(0.02));
}

}  // namespace beam_stresses_test
