#include "solver/elements/external_forces.hpp"

#include <cmath>

#include <catch2/catch.hpp>

#include "load_scene.hpp"
#include "solver/error.hpp"
#include "solver/tests/exactly.hpp"

using namespace comma::solver;
using namespace comma::solver::testing;

namespace {

AppliedLoad pressure_on_skin(const Mesh& mesh, const FieldFunction& pressure) {
  auto load = std::make_shared<Load>();
  const int facets = static_cast<int>(boundary_facets(mesh.cell_types[0]).size());
  for (int cell = 1; cell <= facets; ++cell) load->pressures.push_back({cell, 0.0, 0.0, pressure, {}});
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
  for (const CellType type : {CellType::tria3, CellType::tria6, CellType::quad4, CellType::quad8, CellType::quad9,
                              CellType::tetra4, CellType::tetra10, CellType::penta6, CellType::penta15, CellType::hexa8,
                              CellType::hexa20, CellType::hexa27, CellType::pyram5, CellType::pyram13}) {
    CAPTURE(name_of(type));
    const Body body(with_skin(type, 0.05), continuum_of(type), elastic(1.0, 0.3));
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
  for (const CellType type :
       {CellType::tria3, CellType::tria6, CellType::quad4, CellType::quad8, CellType::quad9, CellType::tetra4,
        CellType::tetra10, CellType::penta6, CellType::hexa8, CellType::hexa20}) {
    CAPTURE(name_of(type));
    const Body body(with_skin(type, 0.0), continuum_of(type), elastic(1.0, 0.3));
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
  CHECK(forces[0] == exactly(3.0));
  CHECK(forces[1] == exactly(5.0));  // against the outward normal: upwards
  CHECK(forces[2] == exactly(3.0));
  CHECK(forces[3] == exactly(5.0));
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
  CHECK(forces[1] == exactly(2.0));
  CHECK(forces[3] == exactly(2.0));
  CHECK(forces[9] == exactly(8.0));
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
  CHECK(resultant(body, forces)[1] == exactly(2.0 * (3.0 * 3.0 - 1.0) / 2));  // p times the integral of r dr
}

TEST_CASE("nodal forces follow functions of place and time, and unknown components are named", "[loads]") {
  const Body body(single_cell(CellType::tria3), Formulation::plane_strain, elastic(1.0, 0.3));
  auto load = std::make_shared<Load>();
  load->nodal_forces.push_back({2, Component::dy, 0.0, [](const Point& x, double t) { return x[1] + t; }});
  load->nodal_forces.push_back({2, Component::dy, 1.0, {}});
  const Eigen::VectorXd forces = body.assembler->external_forces(std::vector<AppliedLoad>{{load, {}}}, 4.0);
  CHECK(forces[5] == exactly(body.model.mesh->nodes[2][1] + 5.0));
  load->nodal_forces.push_back({2, Component::dz, 1.0, {}});
  CHECK_THROWS_WITH(body.assembler->external_forces(std::vector<AppliedLoad>{{load, {}}}, 0.0),
                    Catch::Contains("DZ") && Catch::Contains("N3"));
}

TEST_CASE("a force in a body that is a function is integrated where the stresses of the body are", "[loads]") {
  for (const Formulation formulation : {Formulation::solid, Formulation::solid_reduced}) {
    const Body body(single_cell(CellType::tetra10), formulation, elastic(1.0, 0.3));
    const Mesh& mesh = *body.model.mesh;
    // Of a degree that no family of few points integrates exactly.
    const auto density = [](const Point& x, double) { return std::pow(x[0], 6); };
    auto load = std::make_shared<Load>();
    load->distributed_forces.push_back({0, {}, {density, {}, {}}});
    double expected = 0.0;
    for (const auto& point : quadrature(CellType::tetra10, stiffness_family(CellType::tetra10, formulation))) {
      Eigen::Matrix<double, 3, 10> places;
      for (int node = 0; node < 10; ++node)
        places.col(node) = Eigen::Vector3d(mesh.nodes[static_cast<std::size_t>(node)].data());
      const Eigen::Vector3d at = places * shape_functions(CellType::tetra10, point.at);
      const Eigen::Matrix3d jacobian = places * shape_derivatives(CellType::tetra10, point.at);
      expected += point.weight * jacobian.determinant() * density({at[0], at[1], at[2]}, 0.0);
    }
    CHECK(resultant(body, body.assembler->external_forces(std::vector<AppliedLoad>{{load, {}}}, 0.0))[0] ==
          Approx(expected).epsilon(1e-12));
  }
}

TEST_CASE("a force on the edge of a solid that is a function is integrated at three points of a SEG3", "[loads]") {
  const Body body(with_skin(CellType::hexa20, 0.0), Formulation::solid, elastic(1.0, 0.3));
  const Mesh& mesh = *body.model.mesh;
  const int edge = mesh.cell_count() - 1;
  REQUIRE(mesh.cell_types[static_cast<std::size_t>(edge)] == CellType::seg3);
  const auto end = [&](std::size_t k) {
    return Eigen::Vector3d(mesh.nodes[static_cast<std::size_t>(mesh.cell(edge)[k])].data());
  };
  const Eigen::Vector3d middle = 0.5 * (end(0) + end(1)), half = 0.5 * (end(1) - end(0));
  // Of a degree that three points do not integrate exactly: 0.24 in place of 2/7 on a length of 2.
  const auto density = [&](const Point& x, double) {
    return std::pow((Eigen::Vector3d(x.data()) - middle).dot(half) / half.squaredNorm(), 6);
  };
  auto load = std::make_shared<Load>();
  load->distributed_forces.push_back({edge, {}, {density, {}, {}}});
  CHECK(resultant(body, body.assembler->external_forces(std::vector<AppliedLoad>{{load, {}}}, 0.0))[0] ==
        Approx(0.24 * half.norm()).epsilon(1e-12));
}

TEST_CASE("pressure on a cell that is no skin is refused", "[loads]") {
  const Body body(single_cell(CellType::tria3), Formulation::plane_strain, elastic(1.0, 0.3));
  auto load = std::make_shared<Load>();
  load->pressures.push_back({0, 1.0, 0.0, {}, {}});
  CHECK_THROWS_WITH(body.assembler->external_forces(std::vector<AppliedLoad>{{load, {}}}, 0.0), Catch::Contains("M1"));
}

TEST_CASE(
    "a uniform force on a cell has its measure as resultant and its centre as point of action: bodies, faces, edges",
    "[loads]") {
  std::vector<CellType> types(std::begin(plane_types), std::end(plane_types));
  types.insert(types.end(), std::begin(solid_types), std::end(solid_types));
  for (const CellType type : types) {
    const Body body(with_skin(type, 0.0), continuum_of(type), elastic(1.0, 0.3));
    const Mesh& mesh = *body.model.mesh;
    const Eigen::Vector3d force(2.0, -3.0, dimension(type) == 3 ? 5.0 : 0.0);
    for (int cell = 0; cell < mesh.cell_count(); ++cell) {
      CAPTURE(name_of(type), cell, name_of(mesh.cell_types[cell]));
      Load load;
      load.distributed_forces.push_back({cell, {force[0], force[1], force[2]}, {}});
      const Eigen::VectorXd forces = body.assembler->external_forces(applied(load), 0.0);
      const Content reference = content(mesh, cell);
      for (int c = 0; c < mesh.dimension; ++c) {
        CHECK(work(body, forces, Eigen::Vector3d::Unit(c)) == exactly(reference.measure * force[c]));
      }
      for (int c = mesh.dimension == 3 ? 0 : 2; c < 3; ++c) {
        CHECK(work(body, forces, Eigen::Vector3d::Zero(), Eigen::Vector3d::Unit(c)) ==
              Approx(reference.moment.cross(force)[c]).margin(1e-12));
      }
    }
  }
}

TEST_CASE("a force that is linear in place has the first moment of the cell as resultant", "[loads]") {
  for (const CellType type :
       {CellType::tria6, CellType::quad8, CellType::tetra10, CellType::hexa8, CellType::penta6, CellType::pyram5}) {
    const Body body(with_skin(type, 0.0), continuum_of(type), elastic(1.0, 0.3));
    for (int cell = 0; cell < body.model.mesh->cell_count(); ++cell) {
      CAPTURE(name_of(type), cell);
      Load load;
      load.distributed_forces.push_back({cell, {1.0, 99.0, 0.0}, {}});
      load.distributed_forces[0].functions[1] = [](const Point& x, double t) { return t * x[0]; };
      const Eigen::VectorXd forces =
          body.assembler->external_forces(applied(load, [](double t) { return 1.0 + t; }), 2.0);
      const Content reference = content(*body.model.mesh, cell);
      CHECK(work(body, forces, Eigen::Vector3d::UnitX()) == exactly(3.0 * reference.measure));
      CHECK(work(body, forces, Eigen::Vector3d::UnitY()) == exactly(6.0 * reference.moment[0]));
    }
  }
}

TEST_CASE("forces turn with the body: a rotated curved cell under rotated forces and the same pressure", "[loads]") {
  const Eigen::Matrix3d turn = (Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, -1).normalized())).toRotationMatrix();
  for (const CellType type : solid_types) {
    CAPTURE(name_of(type));
    auto mesh = with_skin(type, 0.05);
    auto turned = std::make_shared<Mesh>(*mesh);
    for (Point& node : turned->nodes)
      Eigen::Map<Eigen::Vector3d>(node.data()) = (turn * Eigen::Vector3d(node.data())).eval();
    const auto forces_on = [](const std::shared_ptr<Mesh>& on, const Eigen::Vector3d& force) {
      const Body body(on, Formulation::solid, elastic(1.0, 0.3));
      Load load;
      for (int cell = 0; cell < on->cell_count(); ++cell)
        load.distributed_forces.push_back({cell, {force[0], force[1], force[2]}, {}});
      load.pressures.push_back({1, 4.0, 0.0, {}, {}});
      return body.assembler->external_forces(applied(load), 0.0);
    };
    const Eigen::Vector3d force(1.0, -2.0, 0.5);
    const Eigen::VectorXd straight = forces_on(mesh, force);
    const Eigen::VectorXd rotated = forces_on(turned, turn * force);
    for (int i = 0; i < straight.size(); i += 3) {
      CHECK((rotated.segment<3>(i) - turn * straight.segment<3>(i)).norm() < 1e-13 * straight.norm());
    }
  }
}

TEST_CASE("distributed forces in an axisymmetric body count per radian", "[loads]") {
  auto mesh = std::make_shared<Mesh>();
  mesh->dimension = 2;
  mesh->nodes = {{1, 0, 0}, {3, 0, 0}, {3, 1, 0}, {1, 1, 0}};
  mesh->add_cell(CellType::quad4, std::array{0, 1, 2, 3});
  mesh->add_cell(CellType::seg2, std::array{1, 2});
  const Body body(mesh, Formulation::axisymmetric, elastic(1.0, 0.3));
  Load load;
  load.distributed_forces.push_back({0, {0.0, 2.0, 0.0}, {}});
  CHECK(resultant(body, body.assembler->external_forces(applied(load), 0.0))[1] == exactly(2.0 * (9.0 - 1.0) / 2));
  load.distributed_forces[0].cell = 1;
  CHECK(resultant(body, body.assembler->external_forces(applied(load), 0.0))[1] == exactly(2.0 * 3.0));
}

TEST_CASE("a distributed force is refused where nothing can take it", "[loads]") {
  const Body body(single_cell(CellType::tria3), Formulation::plane_strain, elastic(1.0, 0.3));
  Load load;
  load.distributed_forces.push_back({0, {0.0, 0.0, 1.0}, {}});
  CHECK_THROWS_WITH(body.assembler->external_forces(applied(load), 0.0),
                    Catch::Contains("along Z") && Catch::Contains("M1"));
  auto mesh = std::make_shared<Mesh>();
  mesh->nodes = {{0, 0, 0}};
  mesh->add_cell(CellType::poi1, std::array{0});
  ElementProperties springs;
  springs.discrete[0] =
      diagonal_stiffness(*mesh, 0, Formulation::spring_3d, std::array{1.0, 1.0, 1.0}, DiscreteFrame::global);
  const Body spring(mesh, std::vector{Formulation::spring_3d}, nullptr, springs);
  CHECK_THROWS_WITH(spring.assembler->external_forces(applied(load), 0.0), Catch::Contains("no part of a continuum"));
}

TEST_CASE("a pressure at nodes acts as the function that its cells interpolate", "[loads]") {
  for (const CellType type : {CellType::quad4, CellType::hexa8, CellType::hexa20}) {
    CAPTURE(name_of(type));
    const Body body(with_skin(type, 0.0), continuum_of(type), elastic(2e11, 0.3));
    const auto linear = [](const Point& at, double time) { return time * (3.0 + 2.0 * at[0] - at[1] + 0.5 * at[2]); };
    const AppliedLoad by_function = pressure_on_skin(*body.model.mesh, linear);
    auto load = std::make_shared<Load>(*by_function.load);
    for (PressureLoad& pressure : load->pressures) {
      pressure.pressure_function = {};
      pressure.pressure_at_nodes = [&](int node, double time) {
        return linear(body.model.mesh->nodes[static_cast<std::size_t>(node)], time);
      };
    }
    const AppliedLoad at_nodes{load, {}};
    const Eigen::VectorXd expected = body.assembler->external_forces(std::span(&by_function, 1), 2.0);
    const Eigen::VectorXd found = body.assembler->external_forces(std::span(&at_nodes, 1), 2.0);
    REQUIRE(expected.norm() > 1.0);
    CHECK((found - expected).norm() <= 1e-13 * expected.norm());
  }
}
