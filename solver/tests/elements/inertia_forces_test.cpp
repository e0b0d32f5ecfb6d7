#include "solver/elements/inertia_forces.hpp"

#include <catch2/catch.hpp>

#include "load_scene.hpp"
#include "solver/tests/exactly.hpp"

using namespace comma::solver;
using namespace comma::solver::testing;

namespace {

Load gravity(std::vector<int> cells, const Eigen::Vector3d& acceleration) {
  Load load;
  load.gravities.push_back({std::move(cells), {acceleration[0], acceleration[1], acceleration[2]}});
  return load;
}

Load rotation(std::vector<int> cells, double speed, std::array<double, 3> axis, std::array<double, 3> centre) {
  Load load;
  load.rotations.push_back({std::move(cells), speed, axis, centre});
  return load;
}

std::vector<int> all_cells(const Mesh& mesh) {
  std::vector<int> cells(mesh.cell_types.size());
  for (std::size_t i = 0; i < cells.size(); ++i) cells[i] = static_cast<int>(i);
  return cells;
}

}  // namespace

TEST_CASE("weight has the resultant and the moment of the mass, on every body cell", "[loads]") {
  std::vector<CellType> types(std::begin(plane_types), std::end(plane_types));
  types.insert(types.end(), std::begin(solid_types), std::end(solid_types));
  const Eigen::Vector3d g(0.3, -9.0, 2.0);
  for (const CellType type : types) {
    CAPTURE(name_of(type));
    const Body body(with_skin(type, 0.0), continuum_of(type), dense(1.0, 0.3, 7.0));
    const Eigen::VectorXd forces =
        body.assembler->external_forces(applied(gravity(all_cells(*body.model.mesh), g)), 0.0);
    const Content mass = content(*body.model.mesh, 0);
    CHECK(work(body, forces, Eigen::Vector3d::UnitX()) == exactly(7.0 * mass.measure * g[0]));
    CHECK(work(body, forces, Eigen::Vector3d::UnitY()) == exactly(7.0 * mass.measure * g[1]));
    CHECK(work(body, forces, Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ()) ==
          exactly(7.0 * mass.moment.cross(g)[2]));
    if (dimension(type) == 2) continue;
    CHECK(work(body, forces, Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX()) ==
          exactly(7.0 * mass.moment.cross(g)[0]));
  }
}

TEST_CASE("a column hangs under its own weight as the parabola that solves it, on quadratic cells (patch test)",
          "[loads]") {
  const double young = 3.0, density = 2.0, g = 5.0;
  for (const CellType type : {CellType::quad8, CellType::quad9, CellType::tria6, CellType::tetra10, CellType::hexa20,
                              CellType::hexa27, CellType::penta15, CellType::penta18}) {
    CAPTURE(name_of(type));
    auto mesh = single_cell(type);
    const Body body(mesh, dimension(type) == 3 ? Formulation::solid : Formulation::plane_stress,
                    dense(young, 0.0, density));
    // sigma_yy = density g (y - 4): the cell lies below y = 4, where the column ends free, and the rest pulls by
    // tractions.
    const auto exact = [&](const Point& x, int c) {
      return c == 1 ? density * g / young * (0.5 * x[1] * x[1] - 4.0 * x[1]) : 0.0;
    };
    const Eigen::VectorXd u = body.displacements(exact);
    auto skin = with_skin(type, 0.0);
    const Body loaded(skin, dimension(type) == 3 ? Formulation::solid : Formulation::plane_stress,
                      dense(young, 0.0, density));
    Load load = gravity({0}, {0.0, -g, 0.0});
    Eigen::VectorXd forces = loaded.assembler->external_forces(applied(load), 0.0);
    // Tractions sigma n: sigma_yy n_y along Y, by pressure's normal: put on each facet as a force along Y.
    CellSamples samples;
    const int facets = static_cast<int>(boundary_facets(type).size());
    for (int cell = 1; cell <= facets; ++cell) {
      for (const CellSample& sample : samples.of(skin->cell_types[cell], CellRole::skin)) {
        const CellPoint point = locate(*skin, cell, sample);
        const double traction = density * g * (point.at[1] - 4.0) * point.normal(dimension(skin->cell_types[cell]))[1];
        for (Eigen::Index a = 0; a < sample.values.size(); ++a) {
          forces[loaded.dofs->dof(skin->cell(cell)[a], Component::dy)] += sample.weight * sample.values[a] * traction;
        }
      }
    }
    CHECK((body.assembler->internal_forces(u) - forces).norm() < 1e-12 * forces.norm());
  }
}

TEST_CASE("the centrifugal force is the mass times the distance of its centre from the axis", "[loads]") {
  const std::array<double, 3> axis = {1.0, 2.0, -2.0}, centre = {0.5, -1.0, 3.0};
  const Eigen::Vector3d a = Eigen::Vector3d(1.0, 2.0, -2.0) / 3.0, c(0.5, -1.0, 3.0);
  for (const CellType type : solid_types) {
    CAPTURE(name_of(type));
    const Body body(with_skin(type, 0.0), Formulation::solid, dense(1.0, 0.3, 2.0));
    const Eigen::VectorXd forces = body.assembler->external_forces(applied(rotation({0}, 3.0, axis, centre)), 0.0);
    const Content mass = content(*body.model.mesh, 0);
    const Eigen::Vector3d r = mass.moment - mass.measure * c;
    const Eigen::Vector3d expected = 2.0 * 9.0 * (r - a * a.dot(r));
    for (int i = 0; i < 3; ++i) CHECK(work(body, forces, Eigen::Vector3d::Unit(i)) == exactly(expected[i]));
    CHECK(work(body, forces, c.cross(a), a) == Approx(0.0).margin(1e-10));  // no moment about the axis
  }
}

TEST_CASE("an axisymmetric ring weighs, and flies apart, per radian", "[loads]") {
  auto mesh = std::make_shared<Mesh>();
  mesh->dimension = 2;
  mesh->nodes = {{1, 0, 0}, {3, 0, 0}, {3, 2, 0}, {1, 2, 0}};
  mesh->add_cell(CellType::quad4, std::array{0, 1, 2, 3});
  const Body body(mesh, Formulation::axisymmetric, dense(1.0, 0.3, 2.0));
  Eigen::VectorXd forces = body.assembler->external_forces(applied(gravity({0}, {0.0, -10.0, 0.0})), 0.0);
  CHECK(work(body, forces, Eigen::Vector3d::UnitY()) ==
        exactly(-10.0 * 2.0 * 2.0 * (9.0 - 1.0) / 2.0));  // height x r dr
  forces = body.assembler->external_forces(applied(rotation({0}, 3.0, {0, -5, 0}, {0, 7, 0})), 0.0);
  CHECK(work(body, forces, Eigen::Vector3d::UnitX()) ==
        exactly(2.0 * 9.0 * 2.0 * (27.0 - 1.0) / 3.0));  // height x r^2 dr
  CHECK(work(body, forces, Eigen::Vector3d::UnitY()) == Approx(0.0).margin(1e-12));
  CHECK_THROWS_WITH(body.assembler->external_forces(applied(gravity({0}, {1.0, 0.0, 0.0})), 0.0),
                    Catch::Contains("axis Y"));
  CHECK_THROWS_WITH(body.assembler->external_forces(applied(rotation({0}, 1.0, {0, 0, 1}, {})), 0.0),
                    Catch::Contains("axis Y"));
}

TEST_CASE("bars and beams weigh, and fly apart, along their length", "[loads]") {
  for (const Formulation formulation :
       {Formulation::bar, Formulation::bar_2d, Formulation::euler_beam, Formulation::timoshenko_beam}) {
    auto mesh = std::make_shared<Mesh>();
    mesh->dimension = formulation == Formulation::bar_2d ? 2 : 3;
    mesh->nodes = {{1, 2, 0}, {4, 6, mesh->dimension == 2 ? 0.0 : 12.0}};
    mesh->add_cell(CellType::seg2, std::array{0, 1});
    ElementProperties properties;
    properties.sections[0] = {.area = 0.5,
                              .inertia_y = 0.02,
                              .inertia_z = 0.03,
                              .torsion = 0.01,
                              .shear_y = 1.2,
                              .shear_z = 1.3,
                              .roll = 0.4};
    const Body body(mesh, std::vector{formulation}, dense(100.0, 0.25, 8.0), properties);
    const Eigen::Vector3d x1(mesh->nodes[0].data()), x2(mesh->nodes[1].data()), g(1.0, -2.0, 3.0);
    const double line = 8.0 * 0.5;
    const double length = (x2 - x1).norm();
    const Eigen::VectorXd weight = body.assembler->external_forces(applied(gravity({0}, g)), 0.0);
    const Eigen::VectorXd spin =
        body.assembler->external_forces(applied(rotation({0}, 2.0, {0, 0, 3}, {0, 1, 0})), 0.0);
    const Eigen::Vector3d middle = 0.5 * (x1 + x2);
    for (int i = 0; i < mesh->dimension; ++i)
      CHECK(work(body, weight, Eigen::Vector3d::Unit(i)) == exactly(line * length * g[i]));
    CHECK(work(body, weight, {0, 0, 0}, Eigen::Vector3d::UnitZ()) == exactly(line * length * middle.cross(g)[2]));
    CHECK(work(body, spin, Eigen::Vector3d::UnitX()) == exactly(4.0 * line * length * middle[0]));
    CHECK(work(body, spin, Eigen::Vector3d::UnitY()) == exactly(4.0 * line * length * (middle[1] - 1.0)));
  }
}

TEST_CASE("discrete masses weigh: points, segments, and one beside its node", "[loads]") {
  auto mesh = std::make_shared<Mesh>();
  mesh->nodes = {{0, 0, 0}, {2, 0, 0}};
  mesh->add_cell(CellType::poi1, std::array{0});
  mesh->add_cell(CellType::seg2, std::array{0, 1});
  const Formulation formulation = Formulation::spring_rotation_3d;
  ElementProperties properties;
  const std::vector<double> values(6, 1.0);
  for (const int cell : {0, 1}) {
    properties.discrete[cell] = diagonal_stiffness(*mesh, cell, formulation, values, DiscreteFrame::global);
  }
  properties.masses[0] =
      rigid_mass(*mesh, 0, formulation, {3.0, Eigen::Matrix3d::Identity(), {0.0, 0.5, 0.0}}, DiscreteFrame::global);
  properties.masses[1] =
      rigid_mass(*mesh, 1, formulation, {4.0, Eigen::Matrix3d::Zero(), Eigen::Vector3d::Zero()}, DiscreteFrame::global);
  CHECK_THROWS_WITH(rigid_mass(*mesh, 1, formulation, {4.0, Eigen::Matrix3d::Zero(), {1, 0, 0}}, DiscreteFrame::global),
                    Catch::Contains("offset"));
  const Body body(mesh, std::vector{formulation, formulation}, nullptr, properties);
  const Eigen::VectorXd forces = body.assembler->external_forces(applied(gravity({0, 1}, {0.0, 0.0, -10.0})), 0.0);
  CHECK(forces[body.dofs->dof(0, Component::dz)] == exactly(-70.0));
  CHECK(forces[body.dofs->dof(1, Component::dz)] == exactly(-40.0));
  CHECK(forces[body.dofs->dof(0, Component::drx)] == exactly(-15.0));  // weight 30 at y = 0.5
  CHECK(forces[body.dofs->dof(1, Component::drx)] == 0.0);
}

// Eight equal masses at the corners of a box have the inertia of one rigid body at its centre.
TEST_CASE("a mass beside its node is driven outwards where it is, and turned towards the plane of the rotation",
          "[loads]") {
  auto mesh = std::make_shared<Mesh>();
  mesh->nodes = {{1.0, -0.5, 0.25}};
  mesh->add_cell(CellType::poi1, std::array{0});
  const Formulation formulation = Formulation::spring_rotation_3d;
  const Eigen::Vector3d offset(0.5, 1.0, -0.75);
  const Eigen::Matrix3d turned =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1.0, 2.0, -1.0).normalized()).toRotationMatrix();
  std::vector<Eigen::Vector3d> corners;
  Eigen::Matrix3d tensor = Eigen::Matrix3d::Zero();
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3d half((corner & 1) != 0 ? 0.1 : -0.1, (corner & 2) != 0 ? 0.2 : -0.2,
                               (corner & 4) != 0 ? 0.4 : -0.4);
    const Eigen::Vector3d arm = turned * half;
    corners.push_back(offset + arm);
    tensor += arm.squaredNorm() * Eigen::Matrix3d::Identity() - arm * arm.transpose();
  }
  ElementProperties properties;
  const std::vector<double> values(6, 1.0);
  properties.discrete[0] = diagonal_stiffness(*mesh, 0, formulation, values, DiscreteFrame::global);
  properties.masses[0] = rigid_mass(*mesh, 0, formulation, {8.0, tensor, offset}, DiscreteFrame::global);
  const Body body(mesh, std::vector{formulation}, nullptr, properties);
  const Eigen::Vector3d axis = Eigen::Vector3d(1.0, -2.0, 0.5).normalized(), centre(0.25, 0.5, -1.0),
                        node(1.0, -0.5, 0.25);
  const double speed = 3.0;
  Eigen::Vector3d force = Eigen::Vector3d::Zero(), moment = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& corner : corners) {
    const Eigen::Vector3d from_centre = node + corner - centre;
    const Eigen::Vector3d outward = speed * speed * (from_centre - axis.dot(from_centre) * axis);
    force += outward;
    moment += corner.cross(outward);
  }
  const Load spin = rotation({0}, speed, {axis[0], axis[1], axis[2]}, {centre[0], centre[1], centre[2]});
  const Eigen::VectorXd forces = body.assembler->external_forces(applied(spin), 0.0);
  for (int c = 0; c < 3; ++c) {
    CHECK(forces[body.dofs->dof(0, static_cast<Component>(c))] == exactly(force[c]));
    CHECK(forces[body.dofs->dof(0, static_cast<Component>(3 + c))] == exactly(moment[c]));
  }
}
