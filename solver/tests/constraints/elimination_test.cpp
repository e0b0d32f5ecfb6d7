#include "solver/constraints/elimination.hpp"

#include <cmath>
#include <random>

#include <catch2/catch.hpp>

#include "scene.hpp"
#include "solver/error.hpp"

using namespace comma::solver;
using namespace comma::solver::test;

namespace elimination_test {

constexpr auto dx = Component::dx;
constexpr auto dy = Component::dy;

struct Scene {
  explicit Scene(int nodes, const std::vector<LinearRelation>& relations)
      : model(nodes_in_a_row(nodes)), dofs(model), elimination(*model.mesh, dofs, applied(relations)) {}

  Model model;
  DofMap dofs;
  Elimination elimination;
};

/// The largest violation of the relations by u = T q + g, for arbitrary q.
double violation(const Elimination& elimination, const DofMap& dofs, const std::vector<LinearRelation>& relations) {
  const Eigen::VectorXd q = Eigen::VectorXd::LinSpaced(elimination.reduced_size(), -1.0, 2.7);
  const Eigen::VectorXd u = elimination.transformation() * q + elimination.offset(0.0);
  double worst = 0.0;
  for (const LinearRelation& relation : relations) {
    double sum = -relation.value;
    for (const auto& term : relation.terms) sum += term.coefficient * u[dofs.dof(term.node, term.component)];
    worst = std::max(worst, std::abs(sum));
  }
  return worst;
}

std::string message_of(int nodes, const std::vector<LinearRelation>& relations) {
  try {
    Scene scene(nodes, relations);
    scene.elimination.offset(0.0);
  } catch (const Error& error) {
    return error.code() + ": " + error.what();
  }
  return "no error";
}

SymmetricMatrix random_stiffness(int n, double density, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::vector<Eigen::Triplet<double>> entries;
  for (int column = 0; column < n; ++column) {
    entries.emplace_back(column, column, 5.0 + uniform(generator));
    for (int row = column + 1; row < n; ++row) {
      if (std::abs(uniform(generator)) < density) entries.emplace_back(row, column, uniform(generator));
    }
  }
  SymmetricMatrix matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

double reduction_error(const Elimination& elimination, unsigned seed) {
  const SymmetricMatrix stiffness = random_stiffness(elimination.full_size(), 0.4, seed);
  const Eigen::MatrixXd full = Eigen::MatrixXd(stiffness).selfadjointView<Eigen::Lower>();
  const Eigen::MatrixXd transformation = elimination.transformation();
  const Eigen::MatrixXd expected = transformation.transpose() * full * transformation;
  const SymmetricMatrix reduced = elimination.reduce(stiffness);
  REQUIRE(reduced.rows() == elimination.reduced_size());
  const Eigen::MatrixXd computed = Eigen::MatrixXd(reduced).selfadjointView<Eigen::Lower>();
  return (computed - expected).lpNorm<Eigen::Infinity>() / expected.lpNorm<Eigen::Infinity>();
}

TEST_CASE("imposed degrees of freedom leave the unknowns, the others stay in order") {
  const Scene scene(3, {relation({{0, dx, 2.0}}, 3.0), relation({{1, dy}}, -1.0)});
  CHECK(scene.elimination.full_size() == 6);
  CHECK(std::vector<int>(scene.elimination.kept().begin(), scene.elimination.kept().end()) ==
        std::vector<int>{1, 2, 4, 5});
  Eigen::VectorXd expected(6);
  expected << 1.5, 0, 0, -1, 0, 0;
  CHECK(scene.elimination.offset(0.0) == expected);
}

TEST_CASE("what loads without multipliers impose on one unknown adds up, and meets other conditions as a sum") {
  const auto kinematic = [](std::vector<LinearRelation> relations, TimeFunction multiplier = {}) {
    auto load = std::make_shared<Load>(*applied(relations).front().load);
    load->multipliers_per_relation = 0;
    return AppliedLoad{load, std::move(multiplier)};
  };
  const Model model = nodes_in_a_row(2);
  const DofMap dofs(model);
  std::vector<AppliedLoad> loads{kinematic({relation({{0, dx}}, 0.1), relation({{0, dy}}, 7.0)}),
                                 kinematic({relation({{0, dx}}, 0.2)}, [](double time) { return time; })};
  const Elimination sum(*model.mesh, dofs, loads);
  CHECK(sum.reduced_size() == 2);
  CHECK(sum.offset(3.0)[dofs.dof(0, dx)] == Approx(0.7));
  CHECK(sum.offset(3.0)[dofs.dof(0, dy)] == 7.0);
  loads.push_back(applied({relation({{0, dx}}, 0.7)}).front());
  const Elimination held(*model.mesh, dofs, loads);
  CHECK_NOTHROW(held.offset(3.0));
  CHECK_THROWS_AS(held.offset(1.0), Error);
}

TEST_CASE("without conditions nothing is eliminated") {
  const Scene scene(2, {});
  CHECK(scene.elimination.reduced_size() == 4);
  CHECK(scene.elimination.offset(3.0) == Eigen::VectorXd::Zero(4));
  CHECK(reduction_error(scene.elimination, 1) == 0.0);
}

TEST_CASE("a chain of equalities ends at the imposed value, in whatever order it is written") {
  std::vector<LinearRelation> relations = {relation({{0, dx}, {1, dx, -1.0}}, 0.0),
                                           relation({{1, dx}, {2, dx, -1.0}}, 0.0), relation({{2, dx}}, 1.0)};
  const int turn = GENERATE(0, 1, 2);
  std::rotate(relations.begin(), relations.begin() + turn, relations.end());
  const Scene scene(3, relations);
  CHECK(scene.elimination.reduced_size() == 3);
  const Eigen::VectorXd g = scene.elimination.offset(0.0);
  for (int node = 0; node < 3; ++node) CHECK(g[scene.dofs.dof(node, dx)] == 1.0);
}

TEST_CASE("a cycle of equalities leaves one unknown and one redundant relation") {
  std::vector<LinearRelation> relations;
  for (int node = 0; node < 5; ++node) relations.push_back(relation({{node, dx}, {(node + 1) % 5, dx, -1.0}}, 0.0));
  const Scene scene(5, relations);
  CHECK(scene.elimination.reduced_size() == 6);
  CHECK(violation(scene.elimination, scene.dofs, relations) == 0.0);
}

TEST_CASE("an open cycle of jumps contradicts itself") {
  std::vector<LinearRelation> relations;
  for (int node = 0; node < 3; ++node) relations.push_back(relation({{node, dx}, {(node + 1) % 3, dx, -1.0}}, 1.0));
  CHECK_THAT(message_of(3, relations), Catch::Contains("contradictory-conditions"));
}

TEST_CASE("any consistent set of relations holds for every choice of the remaining unknowns") {
  std::mt19937 generator(11);
  std::uniform_int_distribution<int> node(0, 19), coefficient(1, 7);
  const Model model = nodes_in_a_row(20);
  const DofMap dofs(model);
  // Values come from one displacement, so that redundant relations agree.
  const auto displacement = [](int at) { return std::sin(at); };
  std::vector<LinearRelation> relations;
  for (int k = 0; k < 30; ++k) {
    std::vector<Term> terms;
    double value = 0.0;
    for (int i = 0; i < 1 + k % 4; ++i) {
      const Term term{node(generator), i % 2 == 0 ? dx : dy, static_cast<double>(coefficient(generator))};
      terms.push_back(term);
      value += term.coefficient * displacement(dofs.dof(term.node, term.component));
    }
    relations.push_back(relation(terms, value));
  }
  const Elimination elimination(*model.mesh, dofs, applied(relations));
  CHECK(elimination.reduced_size() >= 40 - 30);
  CHECK(violation(elimination, dofs, relations) < 1e-12);
  CHECK(reduction_error(elimination, 2) < 1e-14);
}

TEST_CASE("the pivot is the largest coefficient, so that no weight in T exceeds 1 for a single relation") {
  const Scene scene(3, {relation({{0, dx, 1e-6}, {1, dx, 2.0}, {2, dx, -1.0}}, 0.0)});
  CHECK(std::find(scene.elimination.kept().begin(), scene.elimination.kept().end(), scene.dofs.dof(1, dx)) ==
        scene.elimination.kept().end());
  CHECK(Eigen::MatrixXd(scene.elimination.transformation()).cwiseAbs().maxCoeff() == 1.0);
}

TEST_CASE("among equal coefficients the rarer unknown leaves, so that a master shared by many is kept") {
  std::vector<LinearRelation> relations;
  for (int slave = 1; slave < 6; ++slave) relations.push_back(relation({{0, dx}, {slave, dx, -1.0}}, 0.0));
  const Scene scene(6, relations);
  CHECK(scene.elimination.kept()[0] == scene.dofs.dof(0, dx));
  CHECK(scene.elimination.reduced_size() == 7);
}

TEST_CASE("redundant conditions that agree are dropped, also when only to the digits of a decimal fraction") {
  const Scene scene(2, {relation({{0, dx}}, 1.0 / 3.0), relation({{0, dx, 3.0}}, 1.0),
                        relation({{0, dx}, {1, dx}}, 0.0), relation({{0, dx, 0.1}, {1, dx, 0.1}}, 0.0)});
  CHECK(scene.elimination.reduced_size() == 2);
  CHECK_NOTHROW(scene.elimination.offset(0.0));
}

TEST_CASE("a zero that carries the rounding of a cosine agrees with zero") {
  const Scene scene(2, {relation({{0, dx}}, 0.0), relation({{0, dx}}, std::cos(M_PI / 2)), relation({{1, dx}}, 1.0)});
  CHECK_NOTHROW(scene.elimination.offset(0.0));
}

TEST_CASE("contradictory values name node, component, values and both origins") {
  const std::string message =
      message_of(3, {relation({{2, dx}}, 1.0, "a.comm:4, DDL_IMPO"), relation({{2, dx}}, 2.0, "a.comm:9, DDL_IMPO")});
  CHECK(message ==
        "contradictory-conditions: conditions contradict each other: DX at N3 = 1 (a.comm:4, DDL_IMPO); DX at N3 = 2 "
        "(a.comm:9, "
        "DDL_IMPO)");
}

TEST_CASE("values of another unit leave no room for a contradiction") {
  const Model model = nodes_in_a_row(2, Formulation::spring_rotation_3d);
  const DofMap dofs(model);
  const auto conditions = [&](double turn) {
    return applied({relation({{0, dx}}, 0.0), relation({{0, dx}}, 1e-7), relation({{1, Component::drx}}, turn)});
  };
  CHECK_THROWS_WITH(Elimination(*model.mesh, dofs, conditions(1e9)), Catch::Contains("contradict"));
  // Beside metres of that size the same is rounding.
  CHECK_NOTHROW(Elimination(*model.mesh, dofs,
                            applied({relation({{0, dx}}, 0.0), relation({{0, dx}}, 1e-7), relation({{1, dx}}, 1e9)})));
}

TEST_CASE("a contradiction through relations names all that take part and no other") {
  const std::string message =
      message_of(3, {relation({{0, dx}}, 1.0, "first"), relation({{1, dx}}, 2.0, "second"),
                     relation({{2, dy}}, 5.0, "bystander"), relation({{0, dx}, {1, dx, -1.0}}, 0.0, "third")});
  CHECK_THAT(message, Catch::Contains("DX at N1 = 1 (first)") && Catch::Contains("DX at N2 = 2 (second)") &&
                          Catch::Contains("DX at N1 - DX at N2 = 0 (third)") && !Catch::Contains("bystander"));
}

TEST_CASE("a relation without a left-hand side cannot be 1") {
  CHECK_THAT(message_of(2, {relation({{0, dx}, {0, dx, -1.0}}, 1.0, "a.comm:4")}),
             Catch::Contains("cannot hold") && Catch::Contains("a.comm:4"));
  CHECK(message_of(2, {relation({{0, dx}, {0, dx, -1.0}}, 0.0)}) == "no error");
}

TEST_CASE("a component that the node lacks is named with those it has") {
  CHECK_THAT(message_of(2, {relation({{1, Component::drz}}, 0.0, "a.comm:4")}),
             Catch::Contains("unknown-dof: node N2 has no component DRZ (a.comm:4)"));
}

TEST_CASE("functions give the value at their node and time, multipliers scale it") {
  const Model model = nodes_in_a_row(3);
  const DofMap dofs(model);
  LinearRelation moving = relation({{2, dx}}, 99.0);
  moving.function = [](const Point& at, double time) { return at[0] + 10.0 * time; };
  const Elimination elimination(*model.mesh, dofs,
                                applied({moving, relation({{0, dy}}, 4.0)}, [](double time) { return time / 2.0; }));
  for (const double time : {0.0, 1.0, 3.0}) {
    const Eigen::VectorXd g = elimination.offset(time);
    CHECK(g[dofs.dof(2, dx)] == (2.0 + 10.0 * time) * time / 2.0);
    CHECK(g[dofs.dof(0, dy)] == 4.0 * time / 2.0);
  }
}

TEST_CASE("a function is taken at the node of highest number, whatever the order of the terms") {
  const Model model = nodes_in_a_row(3);
  const DofMap dofs(model);
  LinearRelation sum = relation({{0, dx}, {2, dx}, {1, dx}}, 0.0);
  sum.function = [](const Point& at, double) { return at[0]; };
  const Elimination elimination(*model.mesh, dofs, applied({sum}));
  const Eigen::VectorXd g = elimination.offset(0.0);
  CHECK(g[dofs.dof(0, dx)] + g[dofs.dof(1, dx)] + g[dofs.dof(2, dx)] == 2.0);
}

TEST_CASE("conditions that agree at first and part later are an error at that time") {
  const Model model = nodes_in_a_row(1);
  const DofMap dofs(model);
  std::vector<AppliedLoad> loads = applied({relation({{0, dx}}, 1.0, "ramp")}, [](double time) { return time; });
  const std::vector<AppliedLoad> fixed = applied({relation({{0, dx}}, 1.0, "fixed")});
  loads.insert(loads.end(), fixed.begin(), fixed.end());
  const Elimination elimination(*model.mesh, dofs, loads);
  CHECK(elimination.offset(1.0)[0] == 1.0);
  CHECK_THROWS_WITH(elimination.offset(2.0),
                    Catch::Contains("at time 2") && Catch::Contains("ramp") && Catch::Contains("fixed"));
}

TEST_CASE(
    "the reduced matrix is the dense T^T K T, for selections and for relations, and follows a change of pattern") {
  const Scene selection(6, {relation({{0, dx}}, 0.0), relation({{3, dy}}, 1.0), relation({{5, dx}}, 0.0)});
  const Scene relations(6, {relation({{0, dx}}, 0.0), relation({{1, dx}, {2, dx, -2.0}, {3, dy, 0.5}}, 1.0),
                            relation({{4, dx}, {1, dx, 3.0}}, 0.0)});
  for (const unsigned seed : {1u, 2u, 3u}) {
    CHECK(reduction_error(selection.elimination, seed) == 0.0);
    CHECK(reduction_error(relations.elimination, seed) < 1e-14);
  }
}

TEST_CASE("imposing every unknown leaves an empty system") {
  const Scene scene(1, {relation({{0, dx}}, 1.0), relation({{0, dy}}, 2.0)});
  CHECK(scene.elimination.reduced_size() == 0);
  CHECK(scene.elimination.reduce(random_stiffness(2, 1.0, 1)).rows() == 0);
  CHECK(scene.elimination.offset(0.0) == Eigen::Vector2d(1.0, 2.0));
}

TEST_CASE("nothing is left of the stiffness of a body that relations make rigid, and all of what holds it") {
  const auto stiffness_of = [](const Scene& scene, const Eigen::Vector3d& strain, double support) {
    std::vector<Eigen::Triplet<double>> entries;
    for (int j = 0; j < 3; ++j)
      for (int i = j; i < 3; ++i)
        entries.emplace_back(std::max(scene.dofs.dof(i, dx), scene.dofs.dof(j, dx)),
                             std::min(scene.dofs.dof(i, dx), scene.dofs.dof(j, dx)), strain[i] * strain[j]);
    entries.emplace_back(scene.dofs.dof(0, dx), scene.dofs.dof(0, dx), support);
    SymmetricMatrix stiffness(scene.elimination.full_size(), scene.elimination.full_size());
    stiffness.setFromTriplets(entries.begin(), entries.end());
    return scene.elimination.reduce(stiffness);
  };
  // The motions (1, 1, 1) and (1, 2, 3) strain nothing but by rounding.
  const Scene moved(3, {relation({{0, dx, 1.0}, {1, dx, -1.0}}, 0.0), relation({{0, dx, 1.0}, {2, dx, -1.0}}, 0.0)});
  const Scene turned(3, {relation({{0, dx, 2.0}, {1, dx, -1.0}}, 0.0), relation({{0, dx, 3.0}, {2, dx, -1.0}}, 0.0)});
  const Eigen::Vector3d of_motion(0.1, 0.2, -0.3), of_turn(0.3, 0.3, -0.3);
  CHECK(stiffness_of(moved, of_motion, 0.0).norm() == 0.0);
  CHECK(stiffness_of(turned, of_turn, 0.0).norm() == 0.0);
  CHECK(stiffness_of(moved, of_motion, 1e-9).norm() == Approx(1e-9).epsilon(1e-6));
}

TEST_CASE("the skew part of a stiffness is reduced like the symmetric one") {
  const Scene scene(4, {relation({{0, dx, 2.0}, {1, dx, -1.0}, {3, dy, 0.5}}, 3.0), relation({{2, dy}}, -1.0)});
  const int n = scene.elimination.full_size();
  const Eigen::MatrixXd any = Eigen::MatrixXd::NullaryExpr(
      n, n, [](Eigen::Index i, Eigen::Index j) { return std::sin(1.0 + static_cast<double>(3 * i + 7 * j)); });
  const Eigen::MatrixXd skew = any - any.transpose();
  const Eigen::MatrixXd below = skew.triangularView<Eigen::StrictlyLower>();
  const SkewMatrix given = below.sparseView();
  const Eigen::MatrixXd transformation = scene.elimination.transformation();
  const Eigen::MatrixXd reduced = scene.elimination.reduce_skew(given);
  CHECK((reduced - reduced.transpose() - transformation.transpose() * skew * transformation).norm() < 1e-13);
}

}  // namespace elimination_test
