#include "solver/contact/half_thickness.hpp"

#include <catch2/catch.hpp>

#include "solver/elements/slender/section_shapes.hpp"
#include "solver/elements/slender/varying_section.hpp"
#include "solver/error.hpp"
#include "solver/tests/exactly.hpp"

using namespace comma::solver;

namespace {

/// Two beams and a plate, of which the second beam tapers.
struct Frame {
  std::shared_ptr<Mesh> mesh = std::make_shared<Mesh>();
  Model model;
  ElementProperties properties;

  Frame() {
    mesh->nodes = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}};
    mesh->add_cell(CellType::seg2, std::vector<int>{0, 1});
    mesh->add_cell(CellType::seg2, std::vector<int>{1, 2});
    mesh->add_cell(CellType::tria3, std::vector<int>{0, 1, 3});
    model.mesh = mesh;
    model.formulations = {Formulation::euler_beam, Formulation::timoshenko_beam, Formulation::thin_plate};
    properties.sections[0] = circular_section(0.1, 0.1);
    properties.sections[1] = varying_section(circular_section(0.2, 0.01), circular_section(0.4, 0.01), all_sizes_vary);
    properties.plates[2].thickness = 0.06;
  }
};

const std::vector<int> all = {0, 1, 2};

}  // namespace

TEST_CASE("Beams add their radius, plates half of their thickness") {
  const Frame frame;
  const auto radii = beam_radii(frame.model, frame.properties, all);
  REQUIRE(radii.size() == 2);
  CHECK(radii.at(0) == 0.1);
  CHECK(radii.at(1) == exactly(0.3));
  const auto halves = plate_half_thicknesses(frame.model, frame.properties, all);
  REQUIRE(halves.size() == 1);
  CHECK(halves.at(2) == 0.03);
}

TEST_CASE("An eccentric plate, whose faces are not half of its thickness away, is refused") {
  Frame frame;
  frame.properties.plates[2].offset = 0.01;
  CHECK_THROWS_WITH(plate_half_thicknesses(frame.model, frame.properties, all), Catch::Contains("eccentric by 0.01"));
}

TEST_CASE("A beam that tapers adds the mean of its radii, and nodes have the mean of their cells'") {
  const Frame frame;
  ContactZone zone;
  zone.slave_cells = all;
  zone.half_thickness = beam_radii(frame.model, frame.properties, all);
  CHECK(half_thickness(zone, 1) == exactly(0.3));
  CHECK(half_thickness(zone, 2) == 0.0);
  const auto nodal = nodal_half_thickness(zone, *frame.mesh);
  CHECK(nodal.at(0) == exactly(0.1));
  CHECK(nodal.at(1) == exactly(0.2));
  CHECK(nodal.at(2) == exactly(0.3));
  CHECK_FALSE(nodal.contains(3));
}

TEST_CASE("A section that is no circle has no radius, and one that is missing is named") {
  Frame frame;
  frame.properties.sections[0] = rectangular_section({0.1, 0.2, 0.0, 0.0});
  CHECK_THROWS_AS(beam_radii(frame.model, frame.properties, all), Error);
  frame.properties.sections.erase(0);
  CHECK_THROWS_WITH(beam_radii(frame.model, frame.properties, all), Catch::Contains("M1"));
}
