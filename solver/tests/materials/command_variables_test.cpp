#include <array>
#include <cmath>

#include <catch2/catch.hpp>

#include "solver/error.hpp"
#include "solver/materials/command_variables.hpp"
#include "solver/tests/exactly.hpp"

using namespace comma::solver;

namespace command_variables_test {

Mesh two_bars() {
  Mesh mesh;
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  mesh.add_cell(CellType::seg2, std::array{0, 1});
  mesh.add_cell(CellType::seg2, std::array{1, 2});
  return mesh;
}

std::shared_ptr<const Field> nodal(std::vector<double> values) {
  return std::make_shared<const Field>(NodalField{"TEMP_R", {"TEMP"}, std::move(values)});
}

CommandVariable heating() {
  CommandVariable variable;
  variable.reference = 20.0;
  variable.snapshots = {{0.0, nodal({0, 100, 200})}, {10.0, nodal({0, 300, 400})}};
  return variable;
}

double temperature(const Mesh& mesh, const VariableState& state, int cell, double first_share) {
  MaterialPoint at;
  state.sample(cell, mesh.cell(cell), std::array{first_share, 1 - first_share}, 0, at);
  return at[Parameter::temperature];
}

TEST_CASE("command variables are linear in time and place", "[materials]") {
  const Mesh mesh = two_bars();
  const std::vector variables = {heating()};
  CHECK(temperature(mesh, VariableState(mesh, variables, 0.0), 0, 0.5) == exactly(50.0));
  CHECK(temperature(mesh, VariableState(mesh, variables, 2.5), 1, 0.25) == exactly(0.25 * 150 + 0.75 * 250));
  CHECK(temperature(mesh, VariableState(mesh, variables, 10.0), 1, 0.0) == exactly(400.0));
}

TEST_CASE("elements with one value for all see the mean of the points that a field has", "[materials]") {
  const Mesh mesh = two_bars();
  CommandVariable variable;
  variable.reference = 0.0;
  variable.snapshots = {{0.0, std::make_shared<const Field>(ElementField{
                                  "TEMP_R", Support::gauss_point, {"TEMP"}, {0, 2, 5}, {10, 30, 20.1, 20.1, 20.1}})}};
  const std::vector variables = {variable};
  const VariableState state(mesh, variables, 0.0);
  const auto mean = [&](int cell) {
    MaterialPoint at;
    state.sample(cell, mesh.cell(cell), std::array{0.5, 0.5}, VariableState::all_points, at);
    return at[Parameter::temperature];
  };
  CHECK(mean(0) == exactly(20.0));
  CHECK(mean(1) == 20.1);
  CHECK(temperature(mesh, state, 0, 0.5) == 10.0);
}

TEST_CASE("a uniform command variable is uniform to the last bit", "[materials]") {
  const Mesh mesh = two_bars();
  CommandVariable variable;
  variable.reference = 20.1;
  variable.snapshots = {{0.0, nodal({20.1, 20.1, 20.1})}};
  const std::vector variables = {variable};
  const VariableState state(mesh, variables, 0.0);
  for (double share = 0.0; share <= 1.0; share += 0.0617) CHECK(temperature(mesh, state, 0, share) == 20.1);
}

TEST_CASE("a command variable may run through its instants at a pace of its own", "[materials]") {
  const Mesh mesh = two_bars();
  std::vector variables = {heating()};
  variables[0].instant = [](double time) { return 10.0 - 0.5 * time; };
  CHECK(temperature(mesh, VariableState(mesh, variables, 20.0), 0, 0.5) == exactly(50.0));
  CHECK(temperature(mesh, VariableState(mesh, variables, 0.0), 1, 0.0) == exactly(400.0));
  CHECK(VariableState(mesh, variables, 20.0).time() == 20.0);
  CHECK_THROWS_AS(VariableState(mesh, variables, 21.0), Error);
}

TEST_CASE("outside its instants a command variable is refused unless it is extended", "[materials]") {
  const Mesh mesh = two_bars();
  std::vector variables = {heating()};
  CHECK_THROWS_WITH(VariableState(mesh, variables, 11.0), Catch::Contains("temperature") && Catch::Contains("11"));
  variables[0].right = Extension::constant;
  CHECK(temperature(mesh, VariableState(mesh, variables, 11.0), 1, 0.0) == exactly(400.0));
  variables[0].right = Extension::linear;
  CHECK(temperature(mesh, VariableState(mesh, variables, 11.0), 1, 0.0) == exactly(420.0));
  CHECK_THROWS_AS(VariableState(mesh, variables, -1.0), Error);
}

TEST_CASE("a later variable replaces an earlier one on its cells alone", "[materials]") {
  const Mesh mesh = two_bars();
  CommandVariable local;
  local.right = Extension::constant;
  local.cells = {1};
  local.snapshots = {
      {0.0, std::make_shared<const Field>(ElementField{"TEMP_R", Support::cell, {"TEMP"}, {0, 0, 1}, {77.0}})}};
  const std::vector variables = {heating(), local};
  const VariableState state(mesh, variables, 5.0);
  CHECK(temperature(mesh, state, 0, 0.0) == exactly(200.0));
  CHECK(temperature(mesh, state, 1, 0.3) == 77.0);
}

TEST_CASE("fields of another mesh are refused", "[materials]") {
  const Mesh mesh = two_bars();
  std::vector variables = {heating()};
  variables[0].snapshots[1].field = nodal({1, 2});
  CHECK_THROWS_WITH(VariableState(mesh, variables, 0.0), Catch::Contains("another mesh"));
}

}  // namespace command_variables_test
