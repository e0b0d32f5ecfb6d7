#include "solver/elements/external_forces.hpp"

#include <cmath>

#include <catch2/catch.hpp>

#include "sample_meshes.hpp"
#include "solver/elements/quadrature.hpp"
#include "solver/error.hpp"

using namespace comma::solver;
using namespace comma::solver::testing;

namespace {

/// One curved cell with all its facets as skin cells.
std::shared_ptr<Mesh> with_skin(CellType type, double bend) {
  auto mesh = single_cell(type, bend);
  for (const BoundaryFacet& facet : boundary_facets(type)) {
    std::vector<int> nodes(facet.nodes.begin(), facet.nodes.begin() + node_count(facet.type));
    mesh->add_cell(facet.type, nodes);
  }
  return mesh;
}

Formulation formulation_of(CellType type) { return dimension(type) == 3 ? Formulation::solid : Formulation::plane_strain; }

AppliedLoad pressure_on_skin(const Mesh& mesh, const FieldFunction& pressure) {
  auto load = std::make_shared<Load>();
  for (int cell = 1; cell < mesh.cell_count(); ++cell) load->pressures.push_back({cell, 0.0, 0.0, pressure, {}});
  return {load, {}};
}

Eigen::VectorXd resultant(const Body& body, const Eigen::VectorXd& forces) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(body.model.mesh->dimension);
  for (int dof = 0; dof < forces.size(); ++dof) sum[static_cast<int>(body.dofs->component_of(dof))] += forces[dof];
  return sum;
}

/// The area of plane cells, the volume of solid ones.
double measure(const Body& body) {
  const auto& mesh = *body.model.mesh;
  const CellType type = mesh.cell_types[0];
  double sum = 0.0;
  for (const auto& point : quadrature(type, mass_family(type))) {
    const Eigen::MatrixXd derivatives = shape_derivatives(type, point.at);
    Eigen::MatrixXd x(node_count(type), dimension(type));
    for (int a = 0; a < x.rows(); ++a) {
      for (int j = 0; j < x.cols(); ++j) x(a, j) = mesh.nodes[a][j];
    }
    sum += point.weight * (derivatives.transpose() * x).determinant();
  }
  return sum;
}

}  // namespace

TEST_CASE("a uniform pressure all round a body has no resultant and no moment", "[loads]") {
  for (const CellType type : {CellType::tria3, CellType::tria6, CellType::quad4, CellType::quad8, CellType::quad9, CellType::tetra4,
                              CellType::tetra10, CellType::penta6, CellType::penta15, CellType::hexa8, CellType::hexa20, CellType::hexa27,
                              CellType::pyram5, CellType::pyram13}) {
    CAPTURE(name_of(type));
    const Body body(with_skin(type, 0.05), formulation_of(type), elastic(1.0, 0.3));
    const std::vector loads = {pressure_on_skin(*body.model.mesh, [](const Point&, double) { return 3.0; })};
    const Eigen::VectorXd forces = body.assembler->external_forces(loads, 0.0);
    CHECK(resultant(body, forces).norm() < 1e-13);
    double moment = 0.0;
    for (int dof = 0; dof < forces.size(); ++dof) {
      const Point& x = body.model.mesh->nodes[body.dofs->node_of(dof)];
      if (body.dofs->component_of(dof) == Component::dy) moment += x[0] * forces[dof];
      if (body.dofs->component_of(dof) == Component::dx) moment -= x[1] * forces[dof];
    }
    CHECK(moment == Approx(0.0).margin(1e-12));
  }
}

TEST_CASE("a pressure that grows with x pushes by its gradient times the volume (divergence theorem)", "[loads]") {
  for (const CellType type : {CellType::tria3, CellType::tria6, CellType::quad4, CellType::quad8, CellType::quad9, CellType::tetra4,
                              CellType::tetra10, CellType::penta6, CellType::hexa8, CellType::hexa20}) {
    CAPTURE(name_of(type));
    const Body body(with_skin(type, 0.0), formulation_of(type), elastic(1.0, 0.3));
    const std::vector loads = {pressure_on_skin(*body.model.mesh, [](const Point& x, double t) { return t * x[0]; })};
    const Eigen::VectorXd sum = resultant(body, body.assembler->external_forces(loads, 2.0));
    CHECK(sum[0] == Approx(-2.0 * measure(body)).epsilon(1e-12));
    CHECK(sum[1] == Approx(0.0).margin(1e-12));
  }
}

TEST_CASE("pressure and shear on one edge: resultant, direction and sharing between nodes", "[loads]") {
  auto mesh = std::make_shared<Mesh>();
  mesh->dimension = 2;
  mesh->nodes = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}};
  mesh->add_cell(CellType::quad4, std::array{0, 1, 2, 3});
  mesh->add_cell(CellType::seg2, std::array{0, 1});  // bottom, outward normal -Y, tangent +X
  const Body body(mesh, Formulation::plane_stress, elastic(1.0, 0.3));
  auto load = std::make_shared<Load>();
  load->pressures.push_back({1, 5.0, 3.0, {}, {}});
  const std::vector<AppliedLoad> loads = {{load, [](double t) { return 10.0 * t; }}};
  const Eigen::VectorXd forces = body.assembler->external_forces(loads, 0.1);
  CHECK(forces[0] == Approx(3.0));
  CHECK(forces[1] == Approx(5.0));  // against the outward normal: upwards
  CHECK(forces[2] == Approx(3.0));
  CHECK(forces[3] == Approx(5.0));
  CHECK(forces.tail(4).norm() == 0.0);
}

TEST_CASE("a quadratic edge shares a uniform pressure as 1/6, 1/6, 4/6", "[loads]") {
  auto mesh = std::make_shared<Mesh>();
  mesh->dimension = 2;
  for (const auto& at : reference_nodes(CellType::quad8)) mesh->nodes.push_back({at[0], at[1], 0.0});
  mesh->add_cell(CellType::quad8, std::array{0, 1, 2, 3, 4, 5, 6, 7});
  mesh->add_cell(CellType::seg3, std::array{0, 1, 4});
  const Body body(mesh, Formulation::plane_strain, elastic(1.0, 0.3));
  auto load = std::make_shared<Load>();
  load->pressures.push_back({1, 6.0, 0.0, {}, {}});
  const Eigen::VectorXd forces = body.assembler->external_forces(std::vector<AppliedLoad>{{load, {}}}, 0.0);
  CHECK(forces[1] == Approx(2.0));
  CHECK(forces[3] == Approx(2.0));
  CHECK(forces[9] == Approx(8.0));
}

TEST_CASE("axisymmetric pressure counts per radian", "[loads]") {
  auto mesh = std::make_shared<Mesh>();
  mesh->dimension = 2;
  mesh->nodes = {{1, 0, 0}, {3, 0, 0}, {3, 1, 0}, {1, 1, 0}};
  mesh->add_cell(CellType::quad4, std::array{0, 1, 2, 3});
  mesh->add_cell(CellType::seg2, std::array{0, 1});
  const Body body(mesh, Formulation::axisymmetric, elastic(1.0, 0.3));
  auto load = std::make_shared<Load>();
  load->pressures.push_back({1, 2.0, 0.0, {}, {}});
  const Eigen::VectorXd forces = body.assembler->external_forces(std::vector<AppliedLoad>{{load, {}}}, 0.0);
  CHECK(resultant(body, forces)[1] == Approx(2.0 * (3.0 * 3.0 - 1.0) / 2));  // p times the integral of r dr
}

TEST_CASE("nodal forces follow functions of place and time, and unknown components are named", "[loads]") {
  const Body body(single_cell(CellType::tria3), Formulation::plane_strain, elastic(1.0, 0.3));
  auto load = std::make_shared<Load>();
  load->nodal_forces.push_back({2, Component::dy, 0.0, [](const Point& x, double t) { return x[1] + t; }});
  load->nodal_forces.push_back({2, Component::dy, 1.0, {}});
  const Eigen::VectorXd forces = body.assembler->external_forces(std::vector<AppliedLoad>{{load, {}}}, 4.0);
  CHECK(forces[5] == Approx(body.model.mesh->nodes[2][1] + 5.0));
  load->nodal_forces.push_back({2, Component::dz, 1.0, {}});
  CHECK_THROWS_WITH(body.assembler->external_forces(std::vector<AppliedLoad>{{load, {}}}, 0.0),
                    Catch::Contains("DZ") && Catch::Contains("N3"));
}

TEST_CASE("pressure on a cell that is no skin is refused", "[loads]") {
  const Body body(single_cell(CellType::tria3), Formulation::plane_strain, elastic(1.0, 0.3));
  auto load = std::make_shared<Load>();
  load->pressures.push_back({0, 1.0, 0.0, {}, {}});
  CHECK_THROWS_WITH(body.assembler->external_forces(std::vector<AppliedLoad>{{load, {}}}, 0.0), Catch::Contains("M1"));
}
