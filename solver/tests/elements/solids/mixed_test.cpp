#include <catch2/catch.hpp>

#include <cmath>

#include "solver/error.hpp"
#include "solver/tests/elements/sample_meshes.hpp"
#include "solver/tests/exactly.hpp"

using namespace comma::solver;
using comma::solver::testing::single_cell;

namespace mixed_test {

constexpr double young = 2000.0;
constexpr double poisson = 0.3;
constexpr double bulk = young / (3.0 * (1.0 - 2.0 * poisson));

struct Kind {
  CellType type;
  Formulation formulation;
};

const std::vector<Kind> kinds = {
    {CellType::tria6, Formulation::plane_strain_pressure}, {CellType::tria6, Formulation::axisymmetric_swelling},
    {CellType::quad8, Formulation::plane_strain_swelling}, {CellType::quad8, Formulation::axisymmetric_pressure},
    {CellType::tetra10, Formulation::solid_pressure},      {CellType::penta15, Formulation::solid_swelling},
    {CellType::pyram13, Formulation::solid_swelling},      {CellType::hexa20, Formulation::solid_pressure},
    {CellType::hexa20, Formulation::solid_swelling}};

/// One cell of metal that hardens.
struct Cell {
  Model model;
  MaterialField materials;
  ElementProperties properties;
  BehaviourOfCells behaviours;
  std::unique_ptr<DofMap> dofs;
  std::unique_ptr<Assembler> assembler;

  Cell(const Kind& kind, CellBehaviour behaviour, double bend = 0.1)
      : model{single_cell(kind.type, bend), {kind.formulation}} {
    Material material;
    material.elasticity = IsotropicElasticity{young, poisson};
    material.plasticity.linear = LinearHardening{100.0, 30.0};
    materials.by_cell = {std::make_shared<const Material>(material)};
    behaviours = {behaviour};
    dofs = std::make_unique<DofMap>(model);
    assembler = std::make_unique<Assembler>(model, materials, properties, *dofs, &behaviours);
  }

  /// Irregular, each kind of unknown of its own size.
  Eigen::VectorXd rough(double amplitude) const {
    Eigen::VectorXd u(dofs->size());
    for (int k = 0; k < dofs->size(); ++k) u[k] = amplitude * size_of(k) * std::sin(1.0 + 3.0 * k);
    return u;
  }
  double size_of(int dof) const { return dofs->component_of(dof) == Component::pressure ? young : 1.0; }
};

TEST_CASE("corners alone have a pressure, and a swelling where there are two fields") {
  const Cell cell({CellType::hexa20, Formulation::solid_swelling}, {});
  CHECK(cell.dofs->size() == 20 * 3 + 8 * 2);
  CHECK(cell.dofs->dof(7, Component::swelling) >= 0);
  CHECK(cell.dofs->dof(8, Component::pressure) == -1);
  CHECK(Cell({CellType::tria6, Formulation::plane_strain_pressure}, {}).dofs->size() == 6 * 2 + 3);
}

TEST_CASE("the stiffness of mixed elements is the derivative of their forces") {
  const Kind kind = GENERATE(from_range(kinds));
  const Kinematics kinematics = GENERATE(Kinematics::small, Kinematics::logarithmic);
  const Cell cell(kind, {kinematics, Relation::isotropic_linear});
  const Eigen::VectorXd u = cell.rough(0.04);
  const Eigen::MatrixXd lower = cell.assembler->stiffness(u);
  const Eigen::MatrixXd tangent = lower.selfadjointView<Eigen::Lower>();
  for (int k = 0; k < cell.dofs->size(); ++k) {
    const double step = 1e-6 * cell.size_of(k);
    Eigen::VectorXd ahead = u, behind = u;
    ahead[k] += step;
    behind[k] -= step;
    const Eigen::VectorXd column =
        (cell.assembler->internal_forces(ahead) - cell.assembler->internal_forces(behind)) / (2.0 * step);
    CHECK((tangent.col(k) - column).cwiseAbs().maxCoeff() < 1e-5 * young / cell.size_of(k));
  }
}

TEST_CASE("the elastic stiffness of mixed elements is that of small strains at rest, whatever the strains are") {
  const Kind kind = GENERATE(from_range(kinds));
  const Cell large(kind, {Kinematics::logarithmic, Relation::isotropic_linear});
  const Cell small(kind, {Kinematics::small, Relation::isotropic_linear});
  const Eigen::MatrixXd expected = small.assembler->stiffness(Eigen::VectorXd::Zero(small.dofs->size()));
  const Eigen::MatrixXd found = large.assembler->initial_stiffness(large.rough(0.04));
  CHECK((found - expected).cwiseAbs().maxCoeff() < 1e-12 * expected.cwiseAbs().maxCoeff());
}

TEST_CASE("a linear displacement, its change of volume and the pressure of that pass the patch test") {
  const Kind kind = GENERATE(from_range(kinds));
  const Cell cell(kind, {}, 0.0);
  const int dimension = cell.model.mesh->dimension;
  Eigen::Matrix3d h;
  h << 1e-3, 2e-3, 0.5e-3, -1e-3, 3e-3, 1e-3, 0.2e-3, 0.1e-3, -0.5e-3;
  const bool round = is_axisymmetric(kind.formulation);
  if (round) h.row(0) << 1e-3, 0.0, 0.0;  // the radial displacement is proportional to the radius
  const double trace = h(0, 0) + h(1, 1) + (dimension == 3 ? h(2, 2) : round ? h(0, 0) : 0.0);
  Eigen::VectorXd u(cell.dofs->size());
  for (int dof = 0; dof < cell.dofs->size(); ++dof) {
    const Point& at = cell.model.mesh->nodes[static_cast<std::size_t>(cell.dofs->node_of(dof))];
    const Component component = cell.dofs->component_of(dof);
    if (component == Component::pressure)
      u[dof] = bulk * trace;
    else if (component == Component::swelling)
      u[dof] = trace;
    else
      u[dof] = h.row(static_cast<int>(component)).dot(Eigen::Vector3d(at[0], at[1], dimension == 3 ? at[2] : 0.0));
  }
  const Eigen::VectorXd forces = cell.assembler->internal_forces(u);
  for (int dof = 0; dof < cell.dofs->size(); ++dof)
    if (cell.dofs->component_of(dof) >= Component::pressure)
      CHECK(std::abs(forces[dof]) < 1e-12 * forces.cwiseAbs().maxCoeff());
  const ElementField stresses = cell.assembler->stresses(u);
  const double shear = young / (2.0 * (1.0 + poisson));
  const int sip = stresses.component("SIP");
  for (int point = 0; point < stresses.points(0); ++point) {
    CHECK(stresses.at(0, point, 0) == exactly(bulk * trace + 2.0 * shear * (h(0, 0) - trace / 3.0)));
    CHECK(stresses.at(0, point, stresses.component("SIXY")) == exactly(shear * (h(0, 1) + h(1, 0))));
    CHECK(std::abs(stresses.at(0, point, sip)) < 1e-12 * young);
  }
}

TEST_CASE("stresses and variables of a mixed element give its forces back and take it up again") {
  const Kind kind = GENERATE(Kind{CellType::hexa20, Formulation::solid_swelling},
                             Kind{CellType::tria6, Formulation::axisymmetric_pressure});
  const Kinematics kinematics = GENERATE(Kinematics::small, Kinematics::logarithmic);
  Cell cell(kind, {kinematics, Relation::isotropic_linear});
  const Eigen::VectorXd u = cell.rough(0.04);
  const Eigen::VectorXd forces = cell.assembler->internal_forces(u);
  const ElementField stresses = cell.assembler->stresses(u);
  const ElementField variables = cell.assembler->internal_variables(u);
  CHECK((cell.assembler->forces_of_stresses(u, stresses) - forces).norm() < 1e-12 * forces.norm());

  cell.assembler->accept(u);
  const Eigen::VectorXd further = cell.rough(0.05);
  const Eigen::VectorXd expected = cell.assembler->internal_forces(further);
  Cell other(kind, {kinematics, Relation::isotropic_linear});
  other.assembler->resume(u, &stresses, &variables);
  CHECK((other.assembler->internal_forces(further) - expected).norm() < 1e-10 * expected.norm());
}

TEST_CASE("mixed elements say which cells and strains they do not know") {
  const auto make = [](CellType type, Formulation formulation, CellBehaviour behaviour) {
    Cell({type, formulation}, behaviour);
  };
  CHECK_FALSE(has_element(Formulation::solid_swelling, CellType::hexa8));
  CHECK_FALSE(has_element(Formulation::plane_strain_pressure, CellType::quad9));
  CHECK_THROWS_WITH(make(CellType::tetra4, Formulation::solid_pressure, {}), Catch::Contains("TETRA4"));
  CHECK_THROWS_WITH(
      make(CellType::hexa20, Formulation::solid_pressure, {Kinematics::multiplicative, Relation::isotropic_linear}),
      Catch::Contains("multiplicative"));
  CHECK_THROWS_WITH(
      make(CellType::hexa20, Formulation::solid_swelling, {Kinematics::updated, Relation::isotropic_linear}),
      Catch::Contains("strains"));
}

}  // namespace mixed_test
