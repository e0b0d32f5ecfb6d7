#include "solver/unilateral/conditions.hpp"

#include <catch2/catch.hpp>

#include "solver/error.hpp"

using namespace comma::solver;

namespace {

/// Two nodes with DX and DY; a relation ties the DY of the second to the DX of the first: DY(N2) = 2 DX(N1) + 0.5 t.
struct Two {
  std::shared_ptr<Mesh> mesh = std::make_shared<Mesh>();
  Model model;
  std::shared_ptr<Load> load = std::make_shared<Load>();

  Two() {
    mesh->dimension = 2;
    mesh->nodes = {{0, 0, 0}, {3, 0, 0}};
    mesh->add_cell(CellType::seg2, std::vector<int>{0, 1});
    model.mesh = mesh;
    model.formulations = {Formulation::spring_2d};
    LinearRelation relation;
    relation.terms = {{1, Component::dy, 1.0}, {0, Component::dx, -2.0}};
    relation.value = 0.5;
    relation.origin = std::make_shared<const std::string>("tie");
    load->relations.push_back(relation);
  }
};

UnilateralCondition condition(int node, Component component, double bound) {
  UnilateralCondition result;
  result.nodes = {node};
  result.components = {component};
  result.coefficients = {[](const Point& at, double t) { return 1.0 + at[0] * t; }};
  result.bound = [bound](const Point&, double t) { return bound * t; };
  return result;
}

}  // namespace

TEST_CASE("Coefficients and bounds are taken at the node and the time") {
  const Two two;
  const DofMap dofs(two.model);
  const std::vector<UnilateralCondition> conditions = {condition(1, Component::dy, 7.0)};
  const Inequalities rows = unilateral_rows(conditions, *two.mesh, dofs, 2.0);
  REQUIRE(rows.rows.rows() == 1);
  CHECK(rows.rows.coeff(0, dofs.dof(1, Component::dy)) == 7.0);  // 1 + 3 * 2
  CHECK(rows.bounds[0] == 14.0);
}

TEST_CASE("A row on tied unknowns is a row on those that are left") {
  const Two two;
  const DofMap dofs(two.model);
  const std::vector<AppliedLoad> loads = {{two.load, [](double t) { return t; }}};
  const Elimination elimination(*two.mesh, dofs, loads);
  const std::vector<UnilateralCondition> conditions = {condition(1, Component::dy, 7.0)};
  const Inequalities full = unilateral_rows(conditions, *two.mesh, dofs, 0.0);
  const Eigen::VectorXd offset = elimination.offset(2.0);
  const auto reduced = reduce(full, elimination, offset, [](int) { return std::string("row"); });
  REQUIRE(reduced.origin == std::vector<int>{0});
  // For any q the reduced row says what the full row says of T q + g.
  const Eigen::VectorXd q = Eigen::VectorXd::LinSpaced(elimination.reduced_size(), 0.3, 1.1);
  const Eigen::VectorXd u = elimination.transformation() * q + offset;
  const double slack = (full.bounds - full.rows * u)[0];
  CHECK((reduced.inequalities.bounds - reduced.inequalities.rows * q)[0] == Approx(slack).epsilon(1e-14));
}

TEST_CASE("A row on held unknowns holds or is an error") {
  Two two;
  two.load->relations[0].terms = {{1, Component::dy, 1.0}};
  const DofMap dofs(two.model);
  const std::vector<AppliedLoad> loads = {{two.load, {}}};
  const Elimination elimination(*two.mesh, dofs, loads);
  for (const double bound :
       {0.5, 0.6, 0.4}) {  // DY is held at 0.5; the bound is taken at t = 1, with coefficient 1 + 3
    const std::vector<UnilateralCondition> conditions = {condition(1, Component::dy, 4.0 * bound)};
    const Inequalities full = unilateral_rows(conditions, *two.mesh, dofs, 1.0);
    const auto run = [&] {
      return reduce(full, elimination, elimination.offset(1.0), [](int) { return std::string("row"); });
    };
    if (bound >= 0.5) {
      CHECK(run().origin.empty());
    } else {
      CHECK_THROWS_WITH(run(), Catch::Contains("violate row by 0.4"));
    }
  }
}

TEST_CASE("A component that the node lacks is named") {
  const Two two;
  const DofMap dofs(two.model);
  const std::vector<UnilateralCondition> conditions = {condition(0, Component::drz, 1.0)};
  CHECK_THROWS_WITH(unilateral_rows(conditions, *two.mesh, dofs, 0.0), Catch::Contains("N1") && Catch::Contains("DRZ"));
}
