#include "solver/linear/multigrid_solver.hpp"

#include <catch2/catch.hpp>

#include "solver/constraints/solid_unknowns.hpp"
#include "solver/elements/assembler.hpp"
#include "solver/error.hpp"
#include "solver/linear/aggregation.hpp"
#include "solver/nonlinear/linear_static_analysis.hpp"
#include "solver/nonlinear/static_analysis.hpp"

using namespace comma::solver;

namespace {

/// A steel block of nx x ny x nz HEXA8 over a base of unit width, its lowest layer of nodes clamped unless it is free.
struct Block {
  std::shared_ptr<Mesh> mesh = std::make_shared<Mesh>();
  StaticProblem problem;
  int nx, ny, nz;

  int node(int i, int j, int k) const { return i + (nx + 1) * (j + (ny + 1) * k); }

  Block(int nx_, int ny_, int nz_, double poisson = 0.3, bool clamped = true, double height = 2.0)
      : nx(nx_), ny(ny_), nz(nz_) {
    mesh->dimension = 3;
    for (int k = 0; k <= nz; ++k)
      for (int j = 0; j <= ny; ++j)
        for (int i = 0; i <= nx; ++i)
          mesh->nodes.push_back({static_cast<double>(i) / nx, static_cast<double>(j) / ny, height * k / nz});
    for (int k = 0; k < nz; ++k)
      for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i)
          mesh->add_cell(CellType::hexa8, std::vector<int>{node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k),
                                                           node(i, j + 1, k), node(i, j, k + 1), node(i + 1, j, k + 1),
                                                           node(i + 1, j + 1, k + 1), node(i, j + 1, k + 1)});
    auto model = std::make_shared<Model>();
    model->mesh = mesh;
    model->formulations.assign(static_cast<std::size_t>(mesh->cell_count()), Formulation::solid);
    problem.model = model;
    Material material;
    material.elasticity = IsotropicElasticity{2.1e11, poisson};
    auto materials = std::make_shared<MaterialField>();
    materials->by_cell.assign(static_cast<std::size_t>(mesh->cell_count()), std::make_shared<const Material>(material));
    problem.materials = materials;
    problem.properties = std::make_shared<const ElementProperties>();
    auto load = std::make_shared<Load>();
    if (clamped) clamp_base(*load);
    load->nodal_forces.push_back({node(nx, ny, nz), Component::dx, 1e6, {}});
    problem.loads.push_back({load, {}});
  }

  void clamp_base(Load& load) const {
    for (int base = 0; base < (nx + 1) * (ny + 1); ++base)
      for (const Component component : {Component::dx, Component::dy, Component::dz}) {
        LinearRelation relation;
        relation.terms.push_back({base, component, 1.0});
        relation.origin = std::make_shared<const std::string>("base");
        load.relations.push_back(relation);
      }
  }
};

/// The reduced stiffness of a block, and what multigrid asks for.
struct System {
  DofMap dofs;
  Assembler assembler;
  Elimination elimination;
  SymmetricMatrix matrix;
  LinearOptions options;

  explicit System(const Block& block)
      : dofs(*block.problem.model),
        assembler(*block.problem.model, *block.problem.materials, *block.problem.properties, dofs),
        elimination(*block.mesh, dofs, block.problem.loads),
        matrix(elimination.reduce(assembler.stiffness(Eigen::VectorXd::Zero(dofs.size())))) {
    options.solid = solid_unknowns(*block.problem.model, dofs, elimination);
  }
};

double tip(const Block& block, std::optional<LinearMethod> method, Counters& counters) {
  LinearStaticOptions options;
  options.method = method;
  Result result;
  const std::vector<double> instants = {0.0};
  solve_linear_static(block.problem, instants, options, result, counters);
  const auto& field = std::get<NodalField>(result.steps.front().fields.find("DEPL")->second);
  return field.at(block.node(block.nx, block.ny, block.nz), field.component("DX"));
}

}  // namespace

TEST_CASE("aggregates cover a row of nodes, each with its neighbours") {
  NodeGraph graph;
  constexpr int count = 10;
  for (int node = 0; node < count; ++node) {
    if (node > 0) graph.neighbours.push_back(node - 1);
    if (node + 1 < count) graph.neighbours.push_back(node + 1);
    graph.starts.push_back(static_cast<int>(graph.neighbours.size()));
  }
  const Aggregates aggregates = aggregate(graph);
  CHECK(aggregates.of_node == std::vector<int>{0, 0, 1, 1, 1, 2, 2, 2, 3, 3});
  CHECK(aggregates.count == 4);
}

TEST_CASE("multigrid agrees with a direct solver") {
  const auto [nx, ny, nz] = GENERATE(std::array{4, 4, 8}, std::array{10, 9, 8}, std::array{2, 2, 60});
  CAPTURE(nx, ny, nz);
  // Cells as high as they are wide: of flat ones multigrid makes hard work.
  const System system(Block(nx, ny, nz, 0.3, true, static_cast<double>(nz) / nx));
  REQUIRE(system.options.solid);
  const auto multigrid = make_linear_solver(LinearMethod::multigrid, system.options);
  const auto direct = make_linear_solver(LinearMethod::cholmod, {});
  CHECK(multigrid->factorise(system.matrix).verdict == FactorVerdict::ok);
  direct->factorise(system.matrix);
  Eigen::MatrixXd x(system.matrix.rows(), 2);
  for (Eigen::Index k = 0; k < x.size(); ++k) x.data()[k] = std::sin(static_cast<double>(k));
  Eigen::MatrixXd expected = x;
  CHECK(multigrid->solve(x) < 1e-12);
  direct->solve(expected);
  // The tolerance on the energy, over the square root of the condition of such a block (1e4 to 1e6).
  CHECK((x - expected).norm() < 1e-8 * expected.norm());
}

TEST_CASE("multigrid in parts finds the same however the nodes are numbered") {
  // Enough nodes for several parts. Numbers without any order put neighbours into different parts.
  const System system(Block(15, 15, 20, 0.3, true, 20.0 / 15));
  REQUIRE(system.options.solid);
  SolidUnknowns shuffled = *system.options.solid;
  const int count = static_cast<int>(shuffled.places.size());
  REQUIRE(count > 4000);
  const int stride = 1999;  // a prime: k -> stride * k takes every number once
  REQUIRE(count % stride != 0);
  for (int node = 0; node < count; ++node)
    shuffled.places[static_cast<std::size_t>(static_cast<long>(node) * stride % count)] =
        system.options.solid->places[static_cast<std::size_t>(node)];
  for (int& node : shuffled.nodes) node = static_cast<int>(static_cast<long>(node) * stride % count);
  LinearOptions options = system.options;
  options.solid = std::make_shared<const SolidUnknowns>(shuffled);
  const auto multigrid = make_linear_solver(LinearMethod::multigrid, options);
  const auto direct = make_linear_solver(LinearMethod::cholmod, {});
  CHECK(multigrid->factorise(system.matrix).verdict == FactorVerdict::ok);
  direct->factorise(system.matrix);
  Eigen::MatrixXd x(system.matrix.rows(), 1);
  for (Eigen::Index k = 0; k < x.size(); ++k) x.data()[k] = std::sin(static_cast<double>(k));
  Eigen::MatrixXd expected = x;
  CHECK(multigrid->solve(x) < 1e-12);
  direct->solve(expected);
  CHECK((x - expected).norm() < 1e-8 * expected.norm());
}

TEST_CASE("one solid of fully integrated cells qualifies for multigrid; a hinge, a loose cell or springs do not") {
  Block block(2, 2, 2);
  const auto qualifies = [&](const Block& scene) {
    const DofMap dofs(*scene.problem.model);
    return solid_unknowns(*scene.problem.model, dofs, Elimination(*scene.mesh, dofs, scene.problem.loads)) != nullptr;
  };
  CHECK(qualifies(block));
  Block reduced(2, 2, 2);
  auto model = std::make_shared<Model>(*reduced.problem.model);
  model->formulations.front() = Formulation::solid_reduced;
  reduced.problem.model = model;
  CHECK_FALSE(qualifies(reduced));
  // A cell that shares an edge with the block can turn about it.
  Block hinge(1, 1, 1);
  for (const auto& point :
       {Point{2, 1, 0}, Point{2, 2, 0}, Point{1, 2, 0}, Point{2, 1, 2}, Point{2, 2, 2}, Point{1, 2, 2}})
    hinge.mesh->nodes.push_back(point);
  hinge.mesh->add_cell(CellType::hexa8,
                       std::vector<int>{hinge.node(1, 1, 0), 8, 9, 10, hinge.node(1, 1, 1), 11, 12, 13});
  model = std::make_shared<Model>(*hinge.problem.model);
  model->formulations.push_back(Formulation::solid);
  hinge.problem.model = model;
  CHECK_FALSE(qualifies(hinge));
  Block spring(2, 2, 2);
  spring.mesh->add_cell(CellType::poi1, std::vector<int>{0});
  model = std::make_shared<Model>(*spring.problem.model);
  model->formulations.push_back(Formulation::spring_3d);
  spring.problem.model = model;
  CHECK_FALSE(qualifies(spring));
}

TEST_CASE("a large solid takes multigrid of itself, and gets the direct solver's displacement") {
  const Block block(18, 18, 20);
  Counters own;
  Counters direct;
  const double expected = tip(block, LinearMethod::cholmod, direct);
  CHECK(tip(block, {}, own) == Approx(expected).epsilon(1e-9));
  CHECK(own.factorisations == 1);
  CHECK(own.assembling > 0.0);
}

TEST_CASE("where multigrid does not converge the direct solver takes over") {
  const Block block(18, 18, 20, 0.49999999);
  Counters own;
  Counters direct;
  const double expected = tip(block, LinearMethod::cholmod, direct);
  CHECK(tip(block, {}, own) == Approx(expected).epsilon(1e-9));
  CHECK(own.factorisations == 2);
}

TEST_CASE("a few elastic steps take multigrid as well, many a factor") {
  // Here multigrid fails, and the factor that takes over is a second one.
  const Block block(18, 18, 20, 0.49999999);
  for (const auto& [instants, factorisations] :
       {std::pair(std::vector{0.0, 1.0}, 2), std::pair(std::vector{0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0}, 1)}) {
    StepPlan plan;
    plan.instants = instants;
    Counters counters, direct;
    Result result;
    solve_static(block.problem, plan, {}, result, counters, {}, {});
    CHECK(counters.factorisations == factorisations);
    CHECK(std::get<NodalField>(result.steps.back().fields.at("DEPL")).at(block.node(18, 18, 20), 0) ==
          Approx(tip(block, LinearMethod::cholmod, direct)).epsilon(1e-6));
  }
}

TEST_CASE("a large solid that nothing holds is told, not solved") {
  const Block block(18, 18, 20, 0.3, false);
  Counters counters;
  CHECK_THROWS_WITH(tip(block, {}, counters), Catch::Contains("nothing holds"));
}
