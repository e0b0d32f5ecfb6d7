#include "solver/fields/relation_multipliers.hpp"

#include <catch2/catch.hpp>

#include "solver/elements/assembler.hpp"
#include "solver/tests/constraints/scene.hpp"
#include "solver/tests/exactly.hpp"

using namespace comma::solver;
using namespace comma::solver::test;

TEST_CASE("The multipliers of relations balance the reactions, as many for each relation as its load says") {
  const Model model = nodes_in_a_row(3);
  const DofMap dofs(model);
  // 2 DX(0) = 0, with two multipliers; DX(1) - DX(2) = 0 and DY(2) = 0, with one; DY(0) = 0 eliminated.
  Load twice, once, never;
  twice.relations = {relation({{0, Component::dx, 2.0}}, 0.0)};
  once.relations = {relation({{1, Component::dx}, {2, Component::dx, -1.0}}, 0.0), relation({{2, Component::dy}}, 0.0)};
  once.multipliers_per_relation = 1;
  never.relations = {relation({{0, Component::dy}}, 0.0)};
  never.multipliers_per_relation = 0;
  std::vector<AppliedLoad> loads;
  for (const Load& load : {twice, once, never}) loads.push_back({std::make_shared<const Load>(load), {}});

  Eigen::VectorXd reactions = Eigen::VectorXd::Zero(dofs.size());
  reactions[dofs.dof(0, Component::dx)] = 12.0;
  reactions[dofs.dof(1, Component::dx)] = 5.0;
  reactions[dofs.dof(2, Component::dx)] = -5.0;
  reactions[dofs.dof(2, Component::dy)] = 7.0;
  reactions[dofs.dof(0, Component::dy)] = 9.0;
  const auto multipliers = relation_multipliers(dofs, loads, to_field(reactions, dofs, "DEPL_R"));
  REQUIRE(multipliers.size() == 4);
  CHECK(multipliers[0] == exactly(-3.0));
  CHECK(multipliers[1] == exactly(-3.0));
  CHECK(multipliers[2] == exactly(-5.0));
  CHECK(multipliers[3] == exactly(-7.0));
}

TEST_CASE("Relations that depend on each other share what there is") {
  const Model model = nodes_in_a_row(1);
  const DofMap dofs(model);
  Load load;
  load.relations = {relation({{0, Component::dx}}, 0.0), relation({{0, Component::dx, 3.0}}, 0.0)};
  const std::vector<AppliedLoad> loads = {{std::make_shared<const Load>(load), {}}};
  Eigen::VectorXd reactions = Eigen::VectorXd::Zero(dofs.size());
  reactions[dofs.dof(0, Component::dx)] = 6.0;
  const auto found = relation_multipliers(dofs, loads, to_field(reactions, dofs, "DEPL_R"));
  REQUIRE(found.size() == 4);
  CHECK(found[0] + found[1] + 3.0 * (found[2] + found[3]) == exactly(-6.0));
}
