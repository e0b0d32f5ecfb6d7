#include "solver/fields/data/field_room.hpp"

#include <cmath>

#include <catch2/catch.hpp>

#include "solver/fields/data/field_parts.hpp"

using namespace comma::solver;

namespace {

/// Two triangles and one of their edges.
Model square_of_triangles() {
  auto mesh = std::make_shared<Mesh>();
  mesh->dimension = 2;
  mesh->nodes = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh->add_cell(CellType::tria6, std::array{0, 1, 2, 0, 1, 2});
  mesh->add_cell(CellType::tria3, std::array{0, 2, 3});
  mesh->add_cell(CellType::seg2, std::array{0, 1});
  return {mesh, std::vector<Formulation>(3, Formulation::plane_strain)};
}

}  // namespace

TEST_CASE("an element field has room at the points of its elements", "[fields]") {
  const Model model = square_of_triangles();
  const ElementField at_points = empty_element_field(model, "SIEF_R", Support::gauss_point, {"SIXX"}, false);
  CHECK(at_points.points(0) == 3);
  CHECK(at_points.points(1) == 1);
  CHECK(at_points.points(2) == 0);
  const ElementField at_nodes = empty_element_field(model, "NEUT_R", Support::element_node, {"X1"}, true);
  CHECK(at_nodes.points(0) == 6);
  CHECK(at_nodes.points(2) == 2);
}

TEST_CASE("zeros stand where the element knows the component, and not where another one does", "[fields]") {
  auto mesh = std::make_shared<Mesh>();
  mesh->nodes = std::vector<Point>(8);
  mesh->add_cell(CellType::hexa8, std::array{0, 1, 2, 3, 4, 5, 6, 7});
  mesh->add_cell(CellType::seg2, std::array{0, 1});
  const Model model{mesh, {Formulation::solid_reduced, Formulation::spring_rotation_3d}};
  ElementField field = empty_element_field(model, "SIEF_R", Support::gauss_point, {"SIXX", "VMIS"}, false);
  field.values[0] = 7.0;
  fill_with_zeros(field, model);
  CHECK(field.at(0, 0, field.component("SIXX")) == 7.0);
  CHECK(field.at(0, 0, field.component("FSTAB72")) == 0.0);
  CHECK(std::isnan(field.at(0, 0, field.component("MFZ"))));
  CHECK(field.at(1, 0, field.component("MFZ")) == 0.0);
  CHECK(std::isnan(field.at(1, 0, field.component("SIXX"))));
  CHECK(field.at(1, 0, field.component("VMIS")) == 0.0);  // no stress of an element
  CHECK_FALSE(is_zero(field, 0));
  CHECK(is_zero(field, 1));
}

TEST_CASE("cells without values give their room back", "[fields]") {
  ElementField field = empty_cell_field(*square_of_triangles().mesh, "TEMP_R", {"TEMP"});
  field.values = {absent, 4.0, absent};
  drop_empty_cells(field);
  CHECK(field.points(0) == 0);
  CHECK(field.at(1, 0, 0) == 4.0);
  CHECK(field.values.size() == 1);
}
