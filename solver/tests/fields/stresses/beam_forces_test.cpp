#include "solver/fields/stresses/beam_forces.hpp"

#include <catch2/catch.hpp>

#include "solver/fields/points/extrapolation.hpp"
#include "solver/tests/elements/sample_meshes.hpp"
#include "solver/tests/exactly.hpp"

using namespace comma::solver;
using namespace comma::solver::testing;

TEST_CASE("a cantilever under a uniform load: -q L^2 / 2 where it is clamped, nothing at its free end", "[fields]") {
  const double load = 300.0;
  const double length = 2.0;
  auto mesh = std::make_shared<Mesh>();
  mesh->nodes = {{0, 0, 0}, {length, 0, 0}};
  mesh->add_cell(CellType::seg2, std::array{0, 1});
  ElementProperties properties;
  BeamSection section;
  section.area = 0.02;
  section.inertia_y = section.inertia_z = 1e-5;
  section.torsion = 2e-5;
  section.shear_y = section.shear_z = 1.2;
  properties.sections[0] = section;
  for (const auto formulation : {Formulation::euler_beam, Formulation::timoshenko_beam}) {
    const Body body(mesh, std::vector{formulation}, elastic(2e11, 0.3), properties);
    auto distributed = std::make_shared<Load>();
    BeamForce force;
    force.cell = 0;
    force.force[1] = -load;
    distributed->beam_forces = {force};
    const std::vector<AppliedLoad> loads = {{distributed, {}}};
    // The free end moves as the stiffness of its six components wants.
    const Eigen::VectorXd external = body.assembler->external_forces(loads, 0.0);
    Eigen::VectorXd u = body.zero();
    u.tail<6>() = body.dense_stiffness().bottomRightCorner<6, 6>().ldlt().solve(external.tail<6>());
    const ElementField found =
        end_section_forces({body.model, body.materials, body.properties, *body.dofs},
                           to_element_nodes(body.model, body.assembler->stresses(u)), loads, 0.0);
    const auto at = [&](int end, std::string_view name) { return found.at(0, end, found.component(name)); };
    CHECK(at(0, "MFZ") == exactly(-load * length * length / 2));
    CHECK(at(0, "VY") == exactly(-load * length));
    CHECK(at(1, "MFZ") == Approx(0.0).margin(1e-9 * load));
    CHECK(at(1, "VY") == Approx(0.0).margin(1e-9 * load));
  }
}
