#include "solver/fields/points/variable_names.hpp"

#include <catch2/catch.hpp>

#include <cmath>

#include "solver/error.hpp"
#include "solver/materials/behaviour/point_law.hpp"

using namespace comma::solver;

TEST_CASE("a law has as many names as variables", "[fields]") {
  for (const Relation relation :
       {Relation::elastic, Relation::isotropic_linear, Relation::isotropic_traction, Relation::isotropic_power,
        Relation::isotropic_nonlinear, Relation::kinematic_linear, Relation::mixed_linear, Relation::mixed_traction}) {
    for (const Kinematics kinematics : {Kinematics::small, Kinematics::logarithmic, Kinematics::updated}) {
      const CellBehaviour behaviour{kinematics, relation};
      CAPTURE(static_cast<int>(relation), static_cast<int>(kinematics));
      CHECK(static_cast<int>(variable_names(behaviour).size()) == PointLaw(behaviour, false).variable_count());
    }
  }
  CellBehaviour annealed{Kinematics::logarithmic, Relation::mixed_linear};
  annealed.restores_hardening = true;
  CHECK(static_cast<int>(variable_names(annealed).size()) == PointLaw(annealed, false).variable_count());
}

TEST_CASE("one name stands for other numbers in other cells", "[fields]") {
  const BehaviourOfCells behaviours = {{Kinematics::small, Relation::isotropic_linear},
                                       {Kinematics::small, Relation::kinematic_linear}};
  ElementField field{"VARI_R", Support::gauss_point, {"V1", "V2", "V3", "V4", "V5", "V6", "V7"}, {0, 1, 2}, {}};
  field.values = {0.25, 1, absent, absent, absent, absent, absent, 10, 20, 30, 40, 50, 60, 0};
  const auto named = std::get<ElementField>(by_variable_names(field, &behaviours));
  CHECK(named.at(0, 0, named.component("EPSPEQ")) == 0.25);
  CHECK(named.at(0, 0, named.component("INDIPLAS")) == 1.0);
  CHECK(named.at(1, 0, named.component("INDIPLAS")) == 0.0);
  CHECK(named.at(1, 0, named.component("XCINXY")) == 40.0);
  CHECK(std::isnan(named.at(1, 0, named.component("EPSPEQ"))));
  // At nodes values of both cells are mixed: what INDIPLAS is there is not known.
  const NodalField nodal{"VARI_R", field.components, {0.5, 1, 3, 4, 5, 6, 7}};
  const auto at_nodes = std::get<NodalField>(by_variable_names(nodal, &behaviours));
  CHECK(at_nodes.at(0, at_nodes.component("XCINZZ")) == 3.0);
  CHECK(at_nodes.component("INDIPLAS") == -1);
  CHECK_THROWS_AS(by_variable_names(NodalField{"DEPL_R", {"DX"}, {1.0}}, nullptr), Error);
}
