#include "solver/elements/follower_forces.hpp"

#include <cmath>

#include <catch2/catch.hpp>

#include "load_scene.hpp"
#include "solver/elements/external_forces.hpp"
#include "solver/error.hpp"
#include "solver/functions/deformed_place.hpp"

using namespace comma::solver;
using namespace comma::solver::testing;

namespace {

/// A cell whose whole boundary bears a load.
struct Pressed {
  Body body;
  std::vector<AppliedLoad> loads;
  FollowerForces forces;

  template <class SetUp>
  Pressed(CellType type, Formulation formulation, SetUp&& set_up)
      : body(moved_away(type), formulation, dense(1.0, 0.3, 1.0)),
        loads(load_of(body, set_up)),
        forces(body.model, *body.dofs, loads) {}

  // Clear of the axis of axisymmetric bodies.
  static std::shared_ptr<Mesh> moved_away(CellType type) {
    auto mesh = with_skin(type, 0.1);
    for (Point& node : mesh->nodes) node[0] += 3.0;
    return mesh;
  }

  template <class SetUp>
  static std::vector<AppliedLoad> load_of(const Body& body, SetUp&& set_up) {
    auto load = std::make_shared<Load>();
    const Mesh& mesh = *body.model.mesh;
    for (int cell = 1; cell < mesh.cell_count(); ++cell) {
      if (dimension(mesh.cell_types[cell]) != dimension(mesh.cell_types[0]) - 1) continue;
      PressureLoad pressure;
      pressure.cell = cell;
      set_up(pressure);
      load->pressures.push_back(std::move(pressure));
    }
    return {{std::move(load), [](double time) { return 2.0 * time; }}};
  }
};

constexpr CellType bodies[] = {CellType::tria3,   CellType::quad8,   CellType::quad9, CellType::tetra4,
                               CellType::tetra10, CellType::penta15, CellType::hexa8, CellType::hexa27};

Eigen::VectorXd some_displacement(const Body& body) {
  return body.displacements(
      [](const Point& x, int c) { return 0.2 * std::sin(1.0 + c + 2.0 * x[0] - x[1] * x[2] + 0.7 * x[(c + 1) % 3]); });
}

}  // namespace

TEST_CASE("the tangent of pressures that follow is their derivative", "[loads]") {
  const auto check = [](CellType type, Formulation formulation, auto&& set_up) {
    CAPTURE(name_of(type));
    Pressed scene(type, formulation, set_up);
    scene.forces.set_time(1.5);
    const Eigen::VectorXd u = some_displacement(scene.body);
    const Eigen::MatrixXd tangent = scene.forces.tangent(u);
    constexpr double step = 1e-5;
    Eigen::MatrixXd differences(u.size(), u.size());
    for (int dof = 0; dof < u.size(); ++dof) {
      const Eigen::VectorXd change = Eigen::VectorXd::Unit(u.size(), dof) * step;
      differences.col(dof) = (scene.forces.at(u + change) - scene.forces.at(u - change)) / (2.0 * step);
    }
    // Round an axis what the radius adds stands in the row: the symmetric part is that of the derivative.
    Eigen::MatrixXd difference = tangent - differences;
    if (is_axisymmetric(formulation)) difference += difference.transpose().eval();
    CHECK(difference.norm() < 1e-7 * differences.norm());
    CHECK(tangent.norm() > 0.0);
  };
  const auto constant = [](PressureLoad& load) { load.pressure = 3.0; };
  const auto varying = [](PressureLoad& load) {
    load.pressure_function = DeformedPlaceFunction{[](const Point& initial, const Point& at, double time) {
      return time * (1.0 + at[0] * at[0] - at[1] * initial[0] + 0.5 * at[2]);
    }};
  };
  for (const CellType type : bodies) {
    check(type, continuum_of(type), constant);
    check(type, continuum_of(type), varying);
    if (dimension(type) > 2) continue;
    check(type, Formulation::axisymmetric, varying);
    check(type, Formulation::axisymmetric, [](PressureLoad& load) { load.shear = -2.0; });
  }
}

// On the moved boundary, in the direction that it has.
TEST_CASE("forces on faces that follow grow with the area, and their tangent is their derivative", "[loads]") {
  for (const CellType type : {CellType::tetra10, CellType::hexa8, CellType::hexa27}) {
    CAPTURE(name_of(type));
    const Body body(with_skin(type, 0.1), Formulation::solid, dense(1.0, 0.3, 1.0));
    auto load = std::make_shared<Load>();
    for (int cell = 1; cell < body.model.mesh->cell_count(); ++cell)
      if (body.model.is_skin(cell) && dimension(body.model.mesh->cell_types[cell]) == 2)
        load->distributed_forces.push_back({cell, {1.0, -2.0, 0.5}, {}});
    const std::vector<AppliedLoad> loads = {{load, {}}};
    const FollowerForces forces(body.model, *body.dofs, loads);
    const Eigen::VectorXd twice =
        body.displacements([](const Point& x, int c) { return x[static_cast<std::size_t>(c)]; });
    const Eigen::VectorXd at_rest = forces.at(body.zero());
    CHECK((forces.at(twice) - 4.0 * at_rest).norm() < 1e-13 * at_rest.norm());
    std::vector<long double> dead(static_cast<std::size_t>(body.dofs->size()), 0.0L);
    add_external_forces({body.model, body.materials, body.properties, *body.dofs}, loads, 0.0, dead);
    const Eigen::VectorXd u = some_displacement(body);
    constexpr double step = 1e-5;
    Eigen::MatrixXd differences(u.size(), u.size());
    for (int dof = 0; dof < u.size(); ++dof) {
      CHECK(at_rest[dof] == Approx(static_cast<double>(dead[static_cast<std::size_t>(dof)])).margin(1e-13));
      const Eigen::VectorXd change = Eigen::VectorXd::Unit(u.size(), dof) * step;
      differences.col(dof) = (forces.at(u + change) - forces.at(u - change)) / (2.0 * step);
    }
    CHECK((forces.tangent(u) - differences).norm() < 1e-7 * differences.norm());
  }
}

TEST_CASE("a constant pressure all round a body neither pushes nor turns it, however it deforms", "[loads]") {
  for (const CellType type : bodies) {
    CAPTURE(name_of(type));
    Pressed scene(type, continuum_of(type), [](PressureLoad& load) { load.pressure = 3.0; });
    scene.forces.set_time(1.0);
    const Eigen::VectorXd u = some_displacement(scene.body);
    const Eigen::VectorXd forces = scene.forces.at(u);
    Eigen::Vector3d force = Eigen::Vector3d::Zero(), moment = Eigen::Vector3d::Zero();
    for (int node = 0; node < scene.body.model.mesh->node_count(); ++node) {
      Eigen::Vector3d at(scene.body.model.mesh->nodes[static_cast<std::size_t>(node)].data()),
          f = Eigen::Vector3d::Zero();
      for (int c = 0; c < 3; ++c) {
        const int dof = scene.body.dofs->dof(node, static_cast<Component>(c));
        if (dof < 0) continue;
        at[c] += u[dof];
        f[c] = forces[dof];
      }
      force += f;
      moment += at.cross(f);
    }
    CHECK(force.norm() < 1e-12 * forces.norm());
    CHECK(moment.norm() < 1e-11 * forces.norm());
  }
}

TEST_CASE("on the body at rest pressures that follow are those that do not", "[loads]") {
  for (const Formulation formulation : {Formulation::plane_strain, Formulation::axisymmetric}) {
    Pressed scene(CellType::quad8, formulation, [](PressureLoad& load) {
      load.pressure_function = [](const Point& at, double time) { return at[0] * time; };
      load.shear = 0.5;
    });
    scene.forces.set_time(2.0);
    const Eigen::VectorXd fixed = scene.body.assembler->external_forces(scene.loads, 2.0);
    CHECK((scene.forces.at(scene.body.zero()) - fixed).norm() < 1e-14 * fixed.norm());
    // A function of the initial place does not see how far the body has moved.
    Eigen::VectorXd lifted = scene.body.zero();
    for (int dof = 0; dof < lifted.size(); ++dof)
      lifted[dof] = scene.body.dofs->component_of(dof) == Component::dy ? 7.0 : 0.0;
    CHECK((scene.forces.at(lifted) - fixed).norm() < 1e-13 * fixed.norm());
  }
}
