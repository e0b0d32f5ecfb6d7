#include "solver/model/model.hpp"

#include <catch2/catch.hpp>

using namespace comma::solver;

namespace {

/// A quadrangle with an edge, a spring to a further node, a point on its corner, and a node that nothing uses.
Model sample_model() {
  auto mesh = std::make_shared<Mesh>();
  mesh->dimension = 2;
  mesh->nodes = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {5, 5, 0}, {2, 0, 0}};
  mesh->add_cell(CellType::quad4, std::array{0, 1, 2, 3});
  mesh->add_cell(CellType::seg2, std::array{0, 1});
  mesh->add_cell(CellType::seg2, std::array{1, 5});
  mesh->add_cell(CellType::poi1, std::array{2});
  mesh->add_cell(CellType::poi1, std::array{3});
  return {mesh,
          {Formulation::plane_strain, Formulation::plane_strain, Formulation::spring_2d,
           Formulation::spring_rotation_2d, Formulation::plane_strain}};
}

}  // namespace

TEST_CASE("edges of a plane body are skin, the body and springs are not", "[model]") {
  const Model model = sample_model();
  CHECK_FALSE(model.is_skin(0));
  CHECK(model.is_skin(1));
  CHECK_FALSE(model.is_skin(2));
  CHECK_FALSE(model.is_skin(3));
  CHECK(model.components_of(4) == 0);  // no continuum element on a point
}

TEST_CASE("degrees of freedom exist where an element needs them, node by node, in the order of components", "[model]") {
  const DofMap dofs(sample_model());
  CHECK(dofs.size() == 11);  // five nodes with two, one of them with a rotation more
  CHECK(dofs.dof(4, Component::dx) == -1);
  CHECK(dofs.dof(2, Component::drz) == 6);
  CHECK(dofs.dof(5, Component::dy) == 10);
  CHECK(dofs.dof(0, Component::dz) == -1);
  for (int dof = 0; dof < dofs.size(); ++dof) CHECK(dofs.dof(dofs.node_of(dof), dofs.component_of(dof)) == dof);
}

TEST_CASE("components have names and are found by them", "[model]") {
  for (int c = 0; c < component_count; ++c) {
    const auto component = static_cast<Component>(c);
    CHECK(component_named(name_of(component)) == component);
  }
  CHECK_FALSE(component_named("dx"));
  CHECK_FALSE(component_named("TEMP"));
}
