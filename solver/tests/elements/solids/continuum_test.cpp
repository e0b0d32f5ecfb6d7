#include <cmath>
#include <string>

#include <catch2/catch.hpp>

#include "solver/error.hpp"
#include "solver/linear/symmetric_eigen.hpp"
#include "solver/materials/elasticity.hpp"
#include "solver/tests/elements/sample_meshes.hpp"

using namespace comma::solver;
using namespace comma::solver::testing;

namespace {

const double young = 2.0e11;
const double poisson = 0.3;

struct Case {
  CellType type;
  Formulation formulation;
};

std::vector<Case> all_cases() {
  std::vector<Case> cases;
  for (const CellType type : plane_types) {
    for (const auto f : {Formulation::plane_strain, Formulation::plane_stress, Formulation::axisymmetric})
      cases.push_back({type, f});
  }
  for (const CellType type : solid_types) cases.push_back({type, Formulation::solid});
  return cases;
}

/// Number of zero-energy motions of an unsupported cell. Four strains at the one point of an axisymmetric TRIA3 leave
/// two of its six degrees of freedom free: the axial translation, and a mode that its neighbours hold.
int free_motions(const Case& c) {
  if (c.formulation == Formulation::axisymmetric && c.type == CellType::tria3) return 2;
  if (c.formulation == Formulation::axisymmetric) return 1;
  return dimension(c.type) == 3 ? 6 : 3;
}

int count_small(const Eigen::VectorXd& eigenvalues, double threshold) {
  int count = 0;
  for (const double value : eigenvalues) count += std::abs(value) < threshold ? 1 : 0;
  return count;
}

}  // namespace

TEST_CASE("stiffness of one cell is symmetric, positive, and free of energy for rigid motions alone", "[elements]") {
  for (const Case& c : all_cases()) {
    CAPTURE(name_of(c.type), static_cast<int>(c.formulation));
    const Body body(single_cell(c.type, 0.03), c.formulation, elastic(young, poisson));
    const Eigen::VectorXd values = symmetric_eigen(body.dense_stiffness()).values;
    const double largest = values.maxCoeff();
    CHECK(values.minCoeff() > -1e-12 * largest);
    CHECK(count_small(values, 1e-11 * largest) == free_motions(c));
  }
}

TEST_CASE("a linear displacement gives the exact stress in every cell, curved ones included", "[elements]") {
  // Isoparametric elements represent linear fields whatever the mapping; Hooke's law then gives one stress for all
  // points.
  const Eigen::Matrix3d h = (Eigen::Matrix3d() << 1.0, 0.4, -0.3, 0.2, -0.7, 0.5, 0.6, -0.1, 0.9).finished() * 1e-3;
  const auto linear = [&](const Point& x, int c) { return 0.1 + h(c, 0) * x[0] + h(c, 1) * x[1] + h(c, 2) * x[2]; };
  for (const Case& c : all_cases()) {
    if (c.formulation == Formulation::axisymmetric) continue;
    CAPTURE(name_of(c.type), static_cast<int>(c.formulation));
    const Body body(single_cell(c.type, 0.05), c.formulation, elastic(young, poisson));
    Eigen::VectorXd strain(6);
    strain << h(0, 0), h(1, 1), h(2, 2), h(0, 1) + h(1, 0), h(0, 2) + h(2, 0), h(1, 2) + h(2, 1);
    const IsotropicModuli material{young, poisson};
    Eigen::VectorXd expected = solid_stiffness(material) * strain;
    if (c.formulation != Formulation::solid) {
      strain[2] = 0.0;
      expected = c.formulation == Formulation::plane_strain
                     ? Eigen::VectorXd(plane_strain_stiffness(material) * strain.head<4>())
                     : Eigen::VectorXd(plane_stress_stiffness(material) * strain.head<4>());
    }
    const ElementField stress = body.assembler->stresses(body.displacements(linear));
    REQUIRE(static_cast<Eigen::Index>(stress.components.size()) == expected.size());
    for (int point = 0; point < stress.points(0); ++point) {
      for (int k = 0; k < expected.size(); ++k) {
        // u is 0.1 and strains are 1e-3: the differences lose two digits.
        CHECK(stress.at(0, point, k) == Approx(expected[k]).margin(1e-12 * young));
      }
    }
  }
}

TEST_CASE("axisymmetric strain: u = a r + b r z, w = c z gives the stresses of the analytic strain", "[elements]") {
  const double a = 2e-3;
  const double c = -1e-3;
  for (const CellType type : plane_types) {
    CAPTURE(name_of(type));
    const Body body(single_cell(type, 0.02), Formulation::axisymmetric, elastic(young, poisson));
    const auto u =
        body.displacements([&](const Point& x, int component) { return component == 0 ? a * x[0] : c * x[1]; });
    const Eigen::Vector4d expected = plane_strain_stiffness({young, poisson}) * Eigen::Vector4d(a, c, a, 0.0);
    const ElementField stress = body.assembler->stresses(u);
    for (int point = 0; point < stress.points(0); ++point) {
      for (int k = 0; k < 4; ++k) CHECK(stress.at(0, point, k) == Approx(expected[k]).margin(1e-13 * young));
    }
  }
}

TEST_CASE("internal forces are the stiffness times the displacement", "[elements]") {
  for (const Case& c : all_cases()) {
    CAPTURE(name_of(c.type), static_cast<int>(c.formulation));
    const Body body(single_cell(c.type, 0.04), c.formulation, elastic(young, poisson));
    const auto u =
        body.displacements([](const Point& x, int k) { return 1e-3 * std::sin(3 * x[0] + x[1] + 2 * x[2] + k); });
    const Eigen::MatrixXd k = body.dense_stiffness();
    const Eigen::VectorXd difference = body.assembler->internal_forces(u) - k * u;
    CHECK(difference.cwiseAbs().maxCoeff() <
          1e-13 * k.cwiseAbs().maxCoeff() * u.cwiseAbs().maxCoeff() * static_cast<double>(u.size()));
  }
}

TEST_CASE("the stiffness is the derivative of the internal forces", "[elements]") {
  for (const Case& c : all_cases()) {
    CAPTURE(name_of(c.type), static_cast<int>(c.formulation));
    const Body body(single_cell(c.type, 0.04), c.formulation, elastic(young, poisson));
    const auto u =
        body.displacements([](const Point& x, int k) { return 1e-3 * std::cos(x[0] - 2 * x[1] + x[2] + k); });
    const Eigen::MatrixXd k = body.dense_stiffness();
    const double step = 1e-4;
    Eigen::MatrixXd difference(k.rows(), k.cols());
    for (int j = 0; j < k.cols(); ++j) {
      const Eigen::VectorXd e = step * Eigen::VectorXd::Unit(k.cols(), j);
      difference.col(j) =
          (body.assembler->internal_forces(u + e) - body.assembler->internal_forces(u - e)) / (2 * step);
    }
    // The forces are linear: only their rounding, 1e-16 * K u / step, is left.
    CHECK((difference - k).cwiseAbs().maxCoeff() < 1e-12 * k.cwiseAbs().maxCoeff());
  }
}

TEST_CASE("a rigid translation meets no resistance at all, to the last bit", "[elements]") {
  for (const Case& c : all_cases()) {
    CAPTURE(name_of(c.type), static_cast<int>(c.formulation));
    const Body body(single_cell(c.type, 0.05), c.formulation, elastic(young, poisson));
    const bool axisymmetric = c.formulation == Formulation::axisymmetric;
    const auto u = body.displacements([&](const Point&, int k) { return axisymmetric && k == 0 ? 0.0 : 20.0 / 3 + k; });
    CHECK(body.assembler->internal_forces(u).cwiseAbs().maxCoeff() == 0.0);
    const Eigen::MatrixXd k = body.dense_stiffness();
    for (int d = axisymmetric ? 1 : 0; d < body.model.mesh->dimension; ++d) {
      for (int row = 0; row < k.rows(); ++row) {
        double sum = 0.0;
        for (int dof = 0; dof < k.cols(); ++dof) {
          if (static_cast<int>(body.dofs->component_of(dof)) == d) sum += k(row, dof);
        }
        CHECK(sum == 0.0);
      }
    }
  }
}

TEST_CASE("forces of a deformed body add up to zero far below the rounding of its stiffness", "[elements]") {
  // The resultant of a body of 2e9 N/m at 20 m must be small beside what springs of 10 N/m feel at 1e-8 m: 1e-7 N.
  const Body body(single_cell(CellType::quad4, 0.05), Formulation::plane_strain, elastic(2e9, 0.3));
  const auto u = body.displacements([](const Point& x, int k) { return 20.0 + 4.0 * std::sin(x[0] + 2 * x[1] + k); });
  // Seen through the sum of each element in extended precision; what is left is the rounding of the four results to
  // doubles.
  const Eigen::VectorXd forces = body.assembler->internal_forces(u);
  long double sum = 0.0L;
  for (int dof = 0; dof < forces.size(); dof += 2) sum += forces[dof];
  CHECK(std::abs(static_cast<double>(sum)) < 4 * 1.2e-16 * forces.cwiseAbs().maxCoeff());
}

TEST_CASE("reduced integration keeps the patch test and adds no more than its known zero-energy modes", "[elements]") {
  struct Reduced {
    CellType type;
    Formulation formulation;
    int modes;
  };
  // An eight-node quadrangle on 2 x 2 points has one spurious mode (which neighbours suppress); HEXA20 on 2 x 2 x 2 has
  // six.
  for (const Reduced& c : {Reduced{CellType::quad8, Formulation::plane_strain_reduced, 3 + 1},
                           Reduced{CellType::hexa20, Formulation::solid_reduced, 6 + 6}}) {
    const Body body(single_cell(c.type), c.formulation, elastic(young, poisson));
    const Eigen::VectorXd values = symmetric_eigen(body.dense_stiffness()).values;
    CHECK(count_small(values, 1e-11 * values.maxCoeff()) == c.modes);
  }
}

TEST_CASE("cells that no element can be made of are named", "[elements]") {
  auto folded = single_cell(CellType::quad4);
  std::swap(folded->nodes[2], folded->nodes[3]);
  CHECK_THROWS_WITH(Body(folded, Formulation::plane_strain, elastic(young, poisson)),
                    Catch::Contains("M1") && Catch::Contains("folded"));
  CHECK_THROWS_WITH(Body(single_cell(CellType::quad4), Formulation::plane_strain, nullptr),
                    Catch::Contains("M1") && Catch::Contains("material"));
  CHECK_THROWS_WITH(Body(single_cell(CellType::quad4), Formulation::plane_strain_reduced, elastic(young, poisson)),
                    Catch::Contains("QUAD4"));
  CHECK_THROWS_AS(Body(single_cell(CellType::quad4), Formulation::plane_strain, elastic(young, 0.5)), Error);
}
