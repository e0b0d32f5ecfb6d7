#include <catch2/catch.hpp>

#include "solver/error.hpp"
#include "solver/fields/integrals/energies.hpp"
#include "solver/fields/stresses/strains.hpp"
#include "solver/tests/elements/sample_meshes.hpp"
#include "solver/tests/exactly.hpp"

using namespace comma::solver;
using namespace comma::solver::testing;

namespace strains_test {

const Eigen::Matrix3d gradient =
    (Eigen::Matrix3d() << 1.0, 0.4, -0.3, 0.2, -0.7, 0.5, 0.6, -0.1, 0.9).finished() * 1e-2;

Eigen::VectorXd linear(const Body& body) {
  return body.displacements([](const Point& x, int k) {
    return 5.0 + gradient(k, 0) * x[0] + gradient(k, 1) * x[1] + gradient(k, 2) * x[2];
  });
}

FieldInput input_of(const Body& body) { return {body.model, body.materials, body.properties, body.assembler->state()}; }

ElementField strain_of(const Body& body, const Eigen::VectorXd& u, StrainKind kind) {
  return strains(input_of(body), to_field(u, *body.dofs, "DEPL_R"), kind);
}

TEST_CASE("a linear displacement has its exact strain in every cell, curved ones included", "[fields]") {
  for (const CellType type : solid_types) {
    CAPTURE(name_of(type));
    const Body body(single_cell(type, 0.05), Formulation::solid, elastic(2e11, 0.3));
    const Eigen::Matrix3d small = 0.5 * (gradient + gradient.transpose());
    const Eigen::Matrix3d green = small + 0.5 * gradient.transpose() * gradient;
    for (const auto& [kind, expected] : {std::pair{StrainKind::total, small}, std::pair{StrainKind::green, green}}) {
      const ElementField field = strain_of(body, linear(body), kind);
      const double values[] = {expected(0, 0), expected(1, 1), expected(2, 2),
                               expected(0, 1), expected(0, 2), expected(1, 2)};
      for (int point = 0; point < field.points(0); ++point) {
        // 5 and 1e-2 lie three digits apart.
        for (int c = 0; c < 6; ++c) CHECK(field.at(0, point, c) == Approx(values[c]).margin(1e-13));
      }
    }
  }
}

TEST_CASE("plane and axisymmetric strains across the plane", "[fields]") {
  for (const CellType type : plane_types) {
    CAPTURE(name_of(type));
    const double poisson = 0.3;
    const Body plane(single_cell(type, 0.03), Formulation::plane_stress, elastic(2e11, poisson));
    const ElementField stressless = strain_of(plane, linear(plane), StrainKind::total);
    const double in_plane = gradient(0, 0) + gradient(1, 1);
    CHECK(stressless.at(0, 0, 2) == exactly(-poisson / (1 - poisson) * in_plane));
    const Body ring(single_cell(type, 0.03), Formulation::axisymmetric, elastic(2e11, poisson));
    const auto u = ring.displacements([](const Point& x, int k) { return k == 0 ? 2e-3 * x[0] : 0.0; });
    CHECK(strain_of(ring, u, StrainKind::total).at(0, 0, 2) == exactly(2e-3));
  }
}

TEST_CASE("mechanical strains leave thermal expansion out, and plane stress lets it go across", "[fields]") {
  Material material;
  IsotropicElasticity elasticity{2e11, 0.3};
  elasticity.expansion = 1e-5;
  material.elasticity = elasticity;
  Body body(single_cell(CellType::quad8), Formulation::plane_stress, std::make_shared<const Material>(material));
  CommandVariable variable;
  variable.reference = 0.0;
  variable.snapshots = {
      {0.0, std::make_shared<const Field>(NodalField{"TEMP_R", {"TEMP"}, std::vector<double>(8, 50.0)})}};
  body.materials.variables = {variable};
  body.assembler->set_time(0.0);
  const auto u = body.displacements([](const Point& x, int k) { return 5e-4 * x[k]; });
  const ElementField total = strain_of(body, u, StrainKind::total);
  const ElementField mechanical = strain_of(body, u, StrainKind::mechanical);
  for (int c = 0; c < 3; ++c) {
    CHECK(total.at(0, 3, c) == exactly(5e-4));
    CHECK(mechanical.at(0, 3, c) == Approx(0.0).margin(1e-17));
  }
}

TEST_CASE("energy densities integrate to 1/2 u K u, from stresses and from their work alike", "[fields]") {
  for (const CellType type : {CellType::hexa20, CellType::tetra10, CellType::pyram13, CellType::penta15}) {
    CAPTURE(name_of(type));
    const Body body(single_cell(type, 0.03), Formulation::solid, elastic(2e11, 0.3));
    const auto u =
        body.displacements([](const Point& x, int k) { return 1e-3 * std::cos(x[0] - 2 * x[1] + x[2] + k); });
    const double expected = 0.5 * u.dot(body.dense_stiffness() * u);
    const ElementField stress = body.assembler->stresses(u);
    const ElementField elastic_density = elastic_energy_density(input_of(body), stress);
    CHECK(sum_over_cells(integrate_cells(body.model, elastic_density), 0) == exactly(expected));
    const ElementField strain = strain_of(body, u, StrainKind::total);
    // In a linear body the trapezoidal rule is exact, and two steps do the work of one.
    const ElementField half_stress = body.assembler->stresses(0.5 * u);
    const ElementField half_strain = strain_of(body, 0.5 * u, StrainKind::total);
    const ElementField first = total_energy_density(half_stress, half_strain, nullptr, nullptr, nullptr);
    const ElementField work = total_energy_density(stress, strain, &half_stress, &half_strain, &first);
    CHECK(sum_over_cells(integrate_cells(body.model, work), 0) == exactly(expected));
  }
}

TEST_CASE("volumes: a sheared cube, and a ring per radian", "[fields]") {
  const Body cube(single_cell(CellType::hexa8), Formulation::solid, elastic(1, 0));
  const double det =
      Eigen::Matrix3d((Eigen::Matrix3d() << 1.1, 0.2, 0.15, -0.1, 0.9, 0.1, 0.2, -0.1, 1.2).finished()).determinant();
  CHECK(cell_volumes(cube.model).values[0] == exactly(8 * det));
  auto square = std::make_shared<Mesh>();
  square->dimension = 2;
  square->nodes = {{1, 0, 0}, {3, 0, 0}, {3, 5, 0}, {1, 5, 0}};
  square->add_cell(CellType::quad4, std::array{0, 1, 2, 3});
  const Body ring(square, Formulation::axisymmetric, elastic(1, 0));
  CHECK(cell_volumes(ring.model).values[0] == exactly(5 * (9 - 1) / 2.0));
}

TEST_CASE("a displacement that lacks a node is refused by its name", "[fields]") {
  const Body body(single_cell(CellType::quad4), Formulation::plane_strain, elastic(1, 0.3));
  const NodalField field{"DEPL_R", {"DX", "DY"}, {0, 0, 1, absent, 0, 0, 0, 0}};
  CHECK_THROWS_WITH(strains(input_of(body), field, StrainKind::total), Catch::Contains("N2"));
}

}  // namespace strains_test
