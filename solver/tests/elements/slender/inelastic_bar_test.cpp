#include "solver/elements/slender/inelastic_bar.hpp"

#include <optional>

#include <catch2/catch.hpp>

#include "solver/error.hpp"
#include "solver/tests/elements/sample_meshes.hpp"
#include "solver/tests/exactly.hpp"

using namespace comma::solver;
using namespace comma::solver::testing;

namespace inelastic_bar_test {

constexpr double young = 2e5, yield = 200.0, slope = 4e3, prager = 1.5e3, area = 2.0;

/// One bar from the origin to (1, 2, 2), of length 3.
Body bar(Formulation formulation) {
  auto mesh = std::make_shared<Mesh>();
  mesh->dimension = 3;
  mesh->nodes = {{0, 0, 0}, {1, 2, 2}};
  mesh->add_cell(CellType::seg2, std::array{0, 1});
  Material material;
  material.elasticity = IsotropicElasticity{young, 0.3};
  material.plasticity.linear = LinearHardening{slope, yield};
  material.plasticity.prager = Property(prager);
  ElementProperties properties;
  properties.sections[0] = {.area = area, .inertia_y = 1.0, .inertia_z = 1.0, .torsion = 1.0};
  return Body(mesh, std::vector<Formulation>{formulation}, std::make_shared<const Material>(material), properties);
}

/// The second end moves by `strain` along the bar, and aside.
Eigen::VectorXd moved(double strain) {
  Eigen::VectorXd u(6);
  u << 0, 0, 0, strain * 1.0 + 2e-4, strain * 2.0 - 1e-4, strain * 2.0;
  return u;
}

const BehaviourOfCells mixed = {{Kinematics::small, Relation::mixed_linear}};

TEST_CASE("an initial elongation pushes on a bar that flows by Young's modulus, and is not seen by its law",
          "[elements]") {
  const Body body = bar(Formulation::bar);
  Assembler assembler(body.model, body.materials, body.properties, *body.dofs, &mixed);
  Load load;
  load.initial_slender_strains.push_back({0, {0.004, 0.0, 0.0}, {}});
  const std::vector<AppliedLoad> loads = {{std::make_shared<const Load>(load), {}}};
  assembler.impose_strains(loads, 0.0);
  const Eigen::VectorXd pushes = assembler.external_forces(loads, 0.0);
  const Eigen::Vector3d at_end = young * area * 0.004 * Eigen::Vector3d(1.0, 2.0, 2.0) / 3.0;
  CHECK((pushes.tail<3>() - at_end).norm() <= 1e-12 * at_end.norm());
  CHECK((pushes.head<3>() + at_end).norm() <= 1e-12 * at_end.norm());
  const ElementField held = assembler.stresses(Eigen::VectorXd::Zero(6), loads, 0.0);
  CHECK(held.at(0, 0, held.component("N")) == 0.0);
}

TEST_CASE("the tangent of a bar that flows is the derivative of its forces", "[elements]") {
  const Body body = bar(Formulation::bar);
  for (const Relation relation : {Relation::isotropic_linear, Relation::kinematic_linear, Relation::mixed_linear}) {
    const BehaviourOfCells behaviours = {{Kinematics::small, relation}};
    Assembler assembler(body.model, body.materials, body.properties, *body.dofs, &behaviours);
    assembler.accept(moved(0.004));
    for (const double strain : {0.006, 0.003, -0.004}) {  // flows on, is elastic, flows back
      const SymmetricMatrix lower = assembler.stiffness(moved(strain));
      const Eigen::MatrixXd tangent = Eigen::MatrixXd(lower).selfadjointView<Eigen::Lower>();
      constexpr double h = 1e-7;
      for (int k = 0; k < 6; ++k) {
        const Eigen::VectorXd step = h * Eigen::VectorXd::Unit(6, k);
        const Eigen::VectorXd column =
            (assembler.internal_forces(moved(strain) + step) - assembler.internal_forces(moved(strain) - step)) /
            (2 * h);
        // Forces are straight in the strain on each branch: rounding of some 500 over h is left.
        CHECK((column - tangent.col(k)).norm() <= 1e-6 * young * area / 3.0);
      }
    }
  }
}

TEST_CASE("a bar goes on from its force and its variables as if it had never stopped", "[elements]") {
  const Body body = bar(Formulation::bar);
  Assembler whole(body.model, body.materials, body.properties, *body.dofs, &mixed);
  whole.accept(moved(0.006));
  const ElementField stresses = whole.stresses(moved(0.006));
  const ElementField variables = whole.internal_variables(moved(0.006));
  Assembler resumed(body.model, body.materials, body.properties, *body.dofs, &mixed);
  resumed.resume(moved(0.006), &stresses, &variables);
  const Eigen::VectorXd expected = whole.internal_forces(moved(-0.002));
  CHECK((resumed.internal_forces(moved(-0.002)) - expected).norm() <= 1e-12 * expected.norm());
  CHECK((whole.forces_of_stresses(moved(0.006), stresses) - whole.internal_forces(moved(0.006))).norm() <=
        1e-12 * expected.norm());
}

TEST_CASE("a bar that has flowed goes on by the tangent of the flow where steps extrapolate it", "[elements]") {
  const Body body = bar(Formulation::bar);
  const BehaviourOfCells isotropic = {{Kinematics::small, Relation::isotropic_linear}};
  Assembler assembler(body.model, body.materials, body.properties, *body.dofs, &isotropic);
  const auto force = [&](double strain) { return assembler.internal_forces(moved(strain)).tail<3>().norm(); };
  const double at_yield = yield / young;
  assembler.extrapolate(1.0);
  CHECK(force(0.004) == exactly(area * young * 0.004));
  assembler.extrapolate(std::nullopt);
  CHECK(force(0.004) == exactly(area * (yield + slope * (0.004 - at_yield))));
  assembler.accept(moved(0.004));
  assembler.extrapolate(0.5);
  // Forwards as the law, and backwards where the law would be elastic.
  for (const double strain : {0.006, 0.003})
    CHECK(force(strain) == exactly(area * (yield + slope * (strain - at_yield))));
  assembler.extrapolate(std::nullopt);
  CHECK(force(0.003) == exactly(area * (yield + slope * (0.004 - at_yield) - young * 0.001)));
  Assembler kinematic(body.model, body.materials, body.properties, *body.dofs, &mixed);
  CHECK_THROWS_WITH(kinematic.extrapolate(1.0), Catch::Contains("IMPLEX"));
}

TEST_CASE("beams do not flow, and bars in small strains only", "[elements]") {
  const Body beam = bar(Formulation::euler_beam);
  CHECK_THROWS_WITH(Assembler(beam.model, beam.materials, beam.properties, *beam.dofs, &mixed),
                    Catch::Contains("are elastic"));
  const Body straight = bar(Formulation::bar);
  const BehaviourOfCells large = {{Kinematics::logarithmic, Relation::isotropic_linear}};
  CHECK_THROWS_WITH(Assembler(straight.model, straight.materials, straight.properties, *straight.dofs, &large),
                    Catch::Contains("small strains"));
}

}  // namespace inelastic_bar_test
