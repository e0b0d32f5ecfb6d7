#include "solver/fields/data/field_algebra.hpp"

#include <cmath>

#include <catch2/catch.hpp>

#include "solver/error.hpp"
#include "solver/fields/data/field_room.hpp"

using namespace comma::solver;

namespace {

NodalField nodal(std::vector<std::string> components, std::vector<double> values) {
  return {"NEUT_R", std::move(components), std::move(values)};
}

}  // namespace

TEST_CASE("a combination adds components where terms have them", "[fields]") {
  const Field first = nodal({"X1", "X2"}, {1, absent, 2, 5});
  const Field second = nodal({"X1"}, {10, absent});
  const Field sum = linear_combination(std::vector<FieldTerm>{{&first, 2.0}, {&second, 1.0}});
  const auto& values = std::get<NodalField>(sum);
  CHECK(values.at(0, 0) == 12);
  CHECK(std::isnan(values.at(0, 1)));
  CHECK(values.at(1, 0) == 4);
  CHECK(values.at(1, 1) == 10);
}

TEST_CASE("fields at different places do not combine", "[fields]") {
  const Field nodes = nodal({"X1"}, {1, 2});
  const Field cells = ElementField{"NEUT_R", Support::cell, {"X1"}, {0, 1, 2}, {3, 4}};
  CHECK_THROWS_WITH(linear_combination(std::vector<FieldTerm>{{&nodes, 1.0}, {&cells, 1.0}}),
                    Catch::Contains("same places"));
}

TEST_CASE("a piece replaces or adds, under other names, at its places alone", "[fields]") {
  const Field source = nodal({"DX"}, {1, 2, 3});
  Field target = nodal({"X1"}, {10, 20, absent});
  const std::vector<int> places = {1, 2};
  put_piece(target, {&source, {"DX"}, {"X1"}, 2.0, true}, &places);
  const auto& values = std::get<NodalField>(target);
  CHECK(values.at(0, 0) == 10);
  CHECK(values.at(1, 0) == 24);
  CHECK(values.at(2, 0) == 6);
}

TEST_CASE("functions are evaluated with the components of their arguments at each point", "[fields]") {
  const std::vector<ValueFunction> functions = {
      {{"X", "T"}, [](std::span<const double> at) { return at[0] * at[1]; }},
      {{}, [](std::span<const double>) { return 7.0; }},
  };
  const Field which = nodal({"X1"}, {0, 1, absent});
  const Field places = nodal({"X"}, {3, absent, absent});
  const Field time = uniform_like(places, "T", 5.0);
  const std::vector<const Field*> arguments = {&places, &time};
  const auto result = std::get<NodalField>(evaluate(Mesh(), which, functions, arguments, "NEUT_R"));
  CHECK(result.at(0, 0) == 15);
  CHECK(result.at(1, 0) == 7);
  CHECK(std::isnan(result.at(2, 0)));
  const Field needy = nodal({"X1"}, {0, 0, absent});
  CHECK_THROWS_WITH(evaluate(Mesh(), needy, functions, arguments, "NEUT_R"),
                    Catch::Contains("depends on X, which has no value at node N2"));
}

TEST_CASE("what is made of numbers and is none is infinite, not absent", "[fields]") {
  constexpr double huge = 1e308;
  const Field field = nodal({"X1"}, {huge, 1, absent});
  const Field twice = linear_combination(std::vector<FieldTerm>{{&field, 10.0}, {&field, -10.0}});
  REQUIRE(first_infinite(twice));
  CHECK(first_infinite(twice)->place == 0);
  CHECK(values_of(twice)[1] == 0.0);
  CHECK(std::isnan(values_of(twice)[2]));
  const std::vector<ValueFunction> functions = {
      {{"X1"}, [](std::span<const double> at) { return (at[0] - 1) * huge * huge - (at[0] - 1) * huge * huge; }}};
  const Field which = nodal({"X2"}, {absent, 0, absent}), two = nodal({"X1"}, {1, 2, 1});
  const std::vector<const Field*> arguments = {&two};
  const Field made = evaluate(Mesh(), which, functions, arguments, "NEUT_R");
  REQUIRE(first_infinite(made));
  CHECK(first_infinite(made)->place == 1);
  CHECK_FALSE(first_infinite(field));
}

TEST_CASE("segments of springs have forces at both ends, points at one", "[fields]") {
  auto mesh = std::make_shared<Mesh>();
  mesh->nodes = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh->add_cell(CellType::seg2, std::array{0, 1});
  mesh->add_cell(CellType::poi1, std::array{1});
  mesh->add_cell(CellType::tria3, std::array{0, 2, 3});
  const Model model{mesh, {Formulation::spring_2d, Formulation::spring_2d, Formulation::plane_strain}};
  const ElementField room = empty_element_field(model, "SIEF_R", Support::gauss_point, {"N"}, false);
  CHECK(room.starts == std::vector{0, 2, 3, 4});
}
