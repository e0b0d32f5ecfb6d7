#include "solver/contact/straight_faces.hpp"

#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "solver/mesh/reference_cell.hpp"
#include "solver/nonlinear/static_analysis.hpp"

using namespace comma::solver;

namespace {

/// Two HEXA20 of edge 2, the upper one on the lower one without sharing nodes.
struct TwoBricks {
  std::shared_ptr<Mesh> mesh = std::make_shared<Mesh>();
  ContactZone zone;

  TwoBricks() {
    mesh->dimension = 3;
    for (const double height : {0.0, 2.0}) {
      std::vector<int> nodes;
      for (Point at : reference_points(CellType::hexa20)) {
        at[2] += height;
        nodes.push_back(mesh->node_count());
        mesh->nodes.push_back(at);
      }
      mesh->add_cell(CellType::hexa20, nodes);
    }
    zone.master_cells = {add_face(0)};
    zone.slave_cells = {add_face(1)};
  }

  /// The face of a brick at z = 1, turned outwards.
  int add_face(int brick) {
    for (const BoundaryFacet& facet : boundary_facets(CellType::hexa20)) {
      std::vector<int> nodes;
      for (int i = 0; i < node_count(facet.type); ++i)
        nodes.push_back(mesh->cell(brick)[static_cast<std::size_t>(facet.nodes[static_cast<std::size_t>(i)])]);
      if (std::ranges::all_of(nodes, [&](int node) { return mesh->nodes[node][2] == 1.0; }))
        return mesh->add_cell(facet.type, nodes);
    }
    return -1;
  }

  std::vector<int> level(double z) const {
    std::vector<int> nodes;
    for (int node = 0; node < mesh->node_count(); ++node) {
      if (mesh->nodes[node][2] == z) nodes.push_back(node);
    }
    return nodes;
  }
};

/// The lower brick held at its bottom, the top of the upper one moved down by 0.2, no Poisson effect.
StaticProblem pressed(const TwoBricks& bricks) {
  StaticProblem problem;
  problem.model = std::make_shared<Model>(Model{bricks.mesh, std::vector(4, Formulation::solid)});
  auto material = std::make_shared<Material>();
  IsotropicElasticity elasticity;
  elasticity.young = 2e5;
  material->elasticity = elasticity;
  auto materials = std::make_shared<MaterialField>();
  materials->by_cell.assign(4, material);
  problem.materials = materials;
  problem.properties = std::make_shared<const ElementProperties>();
  auto load = std::make_shared<Load>();
  const auto origin = std::make_shared<const std::string>("test");
  for (const auto& [z, moved] : {std::pair(-1.0, 0.0), std::pair(3.0, -0.2)}) {
    for (const int node : bricks.level(z)) {
      load->relations.push_back({{{node, Component::dx, 1.0}}, 0.0, {}, origin});
      load->relations.push_back({{{node, Component::dy, 1.0}}, 0.0, {}, origin});
      load->relations.push_back({{{node, Component::dz, 1.0}}, moved, {}, origin});
    }
  }
  problem.loads.push_back({load, {}});
  problem.contact.emplace();
  problem.contact->zones = {bricks.zone};
  return problem;
}

Result solved(const StaticProblem& problem) {
  Result result;
  Counters counters;
  solve_static(problem, StepPlan({0.0, 1.0}), {}, result, counters);
  return result;
}

const NodalField& last(const Result& result, const char* field) {
  return std::get<NodalField>(result.steps.back().fields.at(field));
}

}  // namespace

TEST_CASE("the corners of an eight-node face make contact, its edges stay straight", "[contact]") {
  const TwoBricks bricks;
  CHECK(contact_nodes(*bricks.mesh, bricks.zone).size() == 4);
  auto model = std::make_shared<Model>(Model{bricks.mesh, std::vector(4, Formulation::solid)});
  const DofMap dofs(*model);
  ContactDefinition contact;
  contact.zones = {bricks.zone};
  const auto relations = straight_edges(*bricks.mesh, dofs, contact);
  REQUIRE(relations.size() == 2 * 4 * 3);
  for (const LinearRelation& relation : relations) {
    Eigen::Vector3d gap = Eigen::Vector3d::Zero();
    for (const auto& term : relation.terms)
      gap += term.coefficient * Eigen::Map<const Eigen::Vector3d>(bricks.mesh->nodes[term.node].data());
    CHECK(gap.norm() == 0.0);
  }
}

TEST_CASE("where contact does not open again, or has a penalty, all nodes of an eight-node face make it untied",
          "[contact]") {
  TwoBricks bricks;
  const bool has_penalty = GENERATE(false, true);
  (has_penalty ? bricks.zone.mixed.penalised : bricks.zone.mixed.bilateral) = true;
  CHECK(contact_nodes(*bricks.mesh, bricks.zone).size() == 8);
  auto model = std::make_shared<Model>(Model{bricks.mesh, std::vector(4, Formulation::solid)});
  ContactDefinition contact;
  contact.zones = {bricks.zone};
  CHECK(straight_edges(*bricks.mesh, DofMap(*model), contact).empty());
}

TEST_CASE("two bricks of HEXA20 pressed together share the squeeze evenly", "[contact]") {
  const TwoBricks bricks;
  const Result result = solved(pressed(bricks));
  const auto& displacement = last(result, "DEPL");
  for (const int node : bricks.level(1.0))
    CHECK(displacement.at(node, displacement.component("DZ")) == Approx(-0.1).epsilon(1e-10));
  // The first step tells of the nodes of the others: corners alone.
  for (const ResultStep& step : result.steps) {
    const auto& contact = std::get<NodalField>(step.fields.at("CONT_NOEU"));
    int told = 0;
    for (const int node : bricks.mesh->nodes_of_cells(bricks.zone.slave_cells))
      told += std::isnan(contact.at(node, contact.component("JEU"))) ? 0 : 1;
    CHECK(told == 4);
  }
}

TEST_CASE("where contact is not enforced, nodes go through and their depth is told", "[contact]") {
  TwoBricks bricks;
  bricks.zone.resolved = false;
  StaticProblem problem = pressed(bricks);
  const Result result = solved(problem);
  const auto& contact = last(result, "CONT_NOEU");
  for (const int node : contact_nodes(*bricks.mesh, bricks.zone)) {
    CHECK(contact.at(node, contact.component("CONT")) == 3.0);
    CHECK(contact.at(node, contact.component("JEU")) == Approx(-0.2).epsilon(1e-10));
  }
  problem.contact->stop_on_interpenetration = true;
  CHECK_THROWS_WITH(solved(problem), Catch::Contains("deep in facet"));
  problem.contact->zones[0].interpenetration_tolerance = 0.21;
  CHECK_NOTHROW(solved(problem));
}
