#include "solver/elements/assembler.hpp"

#include <cmath>

#include <catch2/catch.hpp>

#include "sample_meshes.hpp"
#include "solver/error.hpp"

using namespace comma::solver;
using namespace comma::solver::testing;

namespace assembler_test {

/// A square of n x n distorted quadrangles, or of twice as many triangles; interior nodes are moved off the grid.
std::shared_ptr<Mesh> square(int n, CellType type) {
  auto mesh = std::make_shared<Mesh>();
  mesh->dimension = 2;
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      const bool inside = i > 0 && i < n && j > 0 && j < n;
      const double shift = inside ? 0.25 / n * std::sin(7.0 * i + 3.0 * j) : 0.0;
      mesh->nodes.push_back({static_cast<double>(i) / n + shift, static_cast<double>(j) / n - 0.7 * shift, 0.0});
    }
  }
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i;
      const std::array<int, 4> q = {a, a + 1, a + n + 2, a + n + 1};
      if (type == CellType::quad4) {
        mesh->add_cell(type, q);
      } else {
        mesh->add_cell(type, std::array{q[0], q[1], q[2]});
        mesh->add_cell(type, std::array{q[0], q[2], q[3]});
      }
    }
  }
  return mesh;
}

/// A cube of n^3 distorted hexahedra.
std::shared_ptr<Mesh> cube(int n) {
  auto mesh = std::make_shared<Mesh>();
  const int m = n + 1;
  for (int k = 0; k < m; ++k) {
    for (int j = 0; j < m; ++j) {
      for (int i = 0; i < m; ++i) {
        const bool inside = i > 0 && i < n && j > 0 && j < n && k > 0 && k < n;
        const double shift = inside ? 0.2 / n * std::cos(2.0 * i + 3.0 * j + 5.0 * k) : 0.0;
        mesh->nodes.push_back({static_cast<double>(i) / n + shift, static_cast<double>(j) / n - shift,
                               static_cast<double>(k) / n + 0.5 * shift});
      }
    }
  }
  for (int k = 0; k < n; ++k) {
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        const int a = (k * m + j) * m + i;
        const int b = a + m * m;
        mesh->add_cell(CellType::hexa8, std::array{a, a + 1, a + m + 1, a + m, b, b + 1, b + m + 1, b + m});
      }
    }
  }
  return mesh;
}

bool on_boundary(const Mesh& mesh, const Point& x) {
  for (int j = 0; j < mesh.dimension; ++j) {
    if (x[j] == 0.0 || x[j] == 1.0) return true;
  }
  return false;
}

double linear_field(const Point& x, int c) {
  return 1e-3 * (1.0 + c + (2 + c) * x[0] - (1.5 - c) * x[1] + (0.5 + c) * x[2]);
}

/// Imposes the linear field on the boundary, solves for the inner nodes, returns the largest error there.
double patch_error(const Body& body) {
  const Eigen::VectorXd exact = body.displacements(linear_field);
  Eigen::MatrixXd k = body.dense_stiffness();
  Eigen::VectorXd u = exact;
  std::vector<int> inner;
  for (int dof = 0; dof < body.dofs->size(); ++dof) {
    if (!on_boundary(*body.model.mesh, body.model.mesh->nodes[body.dofs->node_of(dof)])) inner.push_back(dof);
  }
  REQUIRE(!inner.empty());
  for (const int dof : inner) u[dof] = 0.0;
  const Eigen::VectorXd force = body.assembler->internal_forces(u);
  const Eigen::VectorXd change = Eigen::MatrixXd(k(inner, inner)).ldlt().solve(-Eigen::VectorXd(force(inner)));
  return (change - Eigen::VectorXd(exact(inner))).cwiseAbs().maxCoeff();
}

/// A quadrangle on two springs to the ground, and a spring between two of its corners.
Body body_on_springs(double spring) {
  auto mesh = single_cell(CellType::quad4);
  const int ground = mesh->node_count();
  mesh->nodes.push_back({0.0, 0.0, 0.0});
  mesh->add_cell(CellType::seg2, std::array{0, ground});
  mesh->add_cell(CellType::seg2, std::array{ground, 2});
  mesh->add_cell(CellType::poi1, std::array{1});
  std::vector<Formulation> formulations(4, Formulation::spring_2d);
  formulations[0] = Formulation::plane_strain;
  ElementProperties properties;
  const std::array values = {spring, spring};
  for (const int cell : {1, 2, 3}) {
    properties.discrete[cell] = diagonal_stiffness(*mesh, cell, Formulation::spring_2d, values, DiscreteFrame::global);
  }
  return Body(mesh, formulations, elastic(2e9, 0.3), properties);
}

TEST_CASE("patch test: a linear field on the boundary of distorted cells goes through to the inside", "[elements]") {
  for (const CellType type : {CellType::tria3, CellType::quad4}) {
    for (const auto formulation : {Formulation::plane_strain, Formulation::plane_stress}) {
      CAPTURE(name_of(type));
      CHECK(patch_error(Body(square(4, type), formulation, elastic(2e11, 0.3))) < 1e-15);
    }
  }
  CHECK(patch_error(Body(cube(3), Formulation::solid, elastic(2e11, 0.3))) < 1e-15);
}

TEST_CASE("the assembled stiffness is the sum of the cells and gives the internal forces", "[elements]") {
  const Body body(cube(2), Formulation::solid, elastic(2e11, 0.3));
  const auto u = body.displacements([](const Point& x, int c) { return std::sin(3 * x[0] + 2 * x[1] - x[2] + c); });
  const Eigen::MatrixXd k = body.dense_stiffness();
  CHECK((body.assembler->internal_forces(u) - k * u).norm() < 1e-13 * (k * u).norm());
}

TEST_CASE("the stiffness holds the lower triangle with every diagonal entry, its pattern does not change",
          "[elements]") {
  const Body body = body_on_springs(10.0);
  const SymmetricMatrix first = body.assembler->stiffness(body.zero());
  const SymmetricMatrix second = body.assembler->stiffness(Eigen::VectorXd::Constant(body.dofs->size(), 1.0));
  CHECK(std::equal(first.innerIndexPtr(), first.innerIndexPtr() + first.nonZeros(), second.innerIndexPtr()));
  for (int column = 0; column < first.cols(); ++column) {
    SymmetricMatrix::InnerIterator entry(first, column);
    REQUIRE(entry);
    CHECK(entry.row() == column);
    int row = -1;
    for (; entry; ++entry) {
      CHECK(entry.row() > row);
      row = static_cast<int>(entry.row());
    }
  }
}

TEST_CASE("a stiff body in rigid translation feels its springs alone, to 20 digits of its stiffness", "[elements]") {
  const Body body = body_on_springs(10.0);
  const double shift = 20.0 / 3;
  const Eigen::VectorXd forces = body.assembler->internal_forces(Eigen::VectorXd::Constant(body.dofs->size(), shift));
  // The two spring segments move as a whole; only the one on a point resists.
  for (int dof = 0; dof < forces.size(); ++dof) {
    CHECK(std::abs(forces[dof] - (body.dofs->node_of(dof) == 1 ? 10.0 * shift : 0.0)) <= 1e-20 * 2e9 * shift);
  }
}

TEST_CASE("rows of a body's assembled stiffness add up to exactly zero", "[elements]") {
  const Body body(square(5, CellType::quad4), Formulation::plane_strain, elastic(2e16, 0.3));
  const Eigen::MatrixXd k = body.dense_stiffness();
  for (int d = 0; d < 2; ++d) {
    for (int row = 0; row < k.rows(); ++row) {
      double sum = 0.0;
      for (int column = d; column < k.cols(); column += 2) sum += k(row, column);
      CHECK(sum == 0.0);
    }
  }
}

TEST_CASE("nodes with more components than an element uses: a spring with rotation at the corner of a plane body",
          "[elements]") {
  auto mesh = single_cell(CellType::tria3);
  mesh->add_cell(CellType::poi1, std::array{1});
  ElementProperties properties;
  properties.discrete[1] =
      diagonal_stiffness(*mesh, 1, Formulation::spring_rotation_2d, std::array{3.0, 5.0, 7.0}, DiscreteFrame::global);
  const Body body(mesh, {Formulation::plane_strain, Formulation::spring_rotation_2d}, elastic(1.0, 0.25), properties);
  const Body alone(single_cell(CellType::tria3), Formulation::plane_strain, elastic(1.0, 0.25));
  REQUIRE(body.dofs->size() == 7);
  const std::array translations = {0, 1, 2, 3, 5, 6};
  Eigen::MatrixXd expected = alone.dense_stiffness();
  expected(2, 2) += 3.0;
  expected(3, 3) += 5.0;
  const Eigen::MatrixXd k = body.dense_stiffness();
  CHECK((Eigen::MatrixXd(k(translations, translations)) - expected).cwiseAbs().maxCoeff() < 1e-15);
  CHECK(k(4, 4) == 7.0);
  CHECK(k.row(4).cwiseAbs().sum() == 7.0);
}

TEST_CASE("a quadrangle with two nodes in one place acts as a triangle", "[elements]") {
  auto mesh = single_cell(CellType::tria3);
  auto collapsed = std::make_shared<Mesh>();
  collapsed->dimension = 2;
  collapsed->nodes = mesh->nodes;
  collapsed->add_cell(CellType::quad4, std::array{0, 1, 2, 2});
  const Body triangle(mesh, Formulation::plane_strain, elastic(1.0, 0.25));
  const Body body(collapsed, Formulation::plane_strain, elastic(1.0, 0.25));
  // Entries of order one are kept to 2^-48, see translation.hpp.
  CHECK((triangle.dense_stiffness() - body.dense_stiffness()).cwiseAbs().maxCoeff() < 1e-13);
}

TEST_CASE("a displacement becomes a field with gaps where nodes have no such component", "[elements]") {
  const Body body = body_on_springs(10.0);
  auto mesh = std::make_shared<Mesh>(*body.model.mesh);
  mesh->nodes.push_back({9.0, 9.0, 0.0});
  const Model model{mesh, body.model.formulations};
  const DofMap dofs(model);
  const NodalField field = to_field(Eigen::VectorXd::LinSpaced(dofs.size(), 0.0, dofs.size() - 1.0), dofs, "DEPL_R");
  CHECK(field.components == std::vector<std::string>{"DX", "DY"});
  CHECK(field.at(2, field.component("DY")) == 5.0);
  CHECK(std::isnan(field.at(5, 0)));
  CHECK(field.component("DZ") == -1);
}

TEST_CASE("a discrete element without stiffness is named", "[elements]") {
  auto mesh = single_cell(CellType::tria3);
  mesh->add_cell(CellType::poi1, std::array{1});
  CHECK_THROWS_WITH(Body(mesh, {Formulation::plane_strain, Formulation::spring_2d}, elastic(1.0, 0.25)),
                    Catch::Contains("M2"));
}

TEST_CASE("a pressed square that weak springs centre spreads evenly to both sides", "[elements]") {
  // A body of 2e9 Pa, 50 m wide, flattened by 1 m in 50, held sideways by springs of 10 N/m between its foot corners
  // and the ground: the sides move by -/+ nu / (1 - nu) * 0.02 * 25 m. 1e-8 m of drift is what 2e-7 N would cause.
  auto mesh = std::make_shared<Mesh>();
  mesh->dimension = 2;
  mesh->nodes = {{0, 0, 0}, {50, 0, 0}, {50, 50, 0}, {0, 50, 0}, {-5, 0, 0}, {55, 0, 0}};
  mesh->add_cell(CellType::quad4, std::array{0, 1, 2, 3});
  mesh->add_cell(CellType::seg2, std::array{4, 0});
  mesh->add_cell(CellType::seg2, std::array{1, 5});
  ElementProperties properties;
  for (const int cell : {1, 2}) {
    properties.discrete[cell] =
        diagonal_stiffness(*mesh, cell, Formulation::spring_2d, std::array{10.0, 10.0}, DiscreteFrame::global);
  }
  const Body body(mesh, {Formulation::plane_strain, Formulation::spring_2d, Formulation::spring_2d}, elastic(2e9, 0.3),
                  properties);
  const std::vector<int> free = {0, 2, 4, 6};  // DX of the four corners
  Eigen::VectorXd u = body.zero();
  u[5] = u[7] = -1.0;
  u(free).setConstant(1.0);  // a start far from the answer
  const Eigen::MatrixXd k = body.dense_stiffness();
  const auto factor = Eigen::MatrixXd(k(free, free)).ldlt();
  for (int iteration = 0; iteration < 4; ++iteration) {
    const Eigen::VectorXd residual = body.assembler->internal_forces(u);
    u(free) -= factor.solve(Eigen::VectorXd(residual(free)));
  }
  const double side = 0.3 / 0.7 * 0.02 * 25.0;
  CHECK(u[0] == Approx(-side).epsilon(1e-8));  // the springs push back by 1e-9 of the body's stiffness
  CHECK(std::abs(u[0] + u[2]) < 1e-8);
  CHECK(std::abs(u[4] + u[6]) < 1e-8);
  CHECK(u[0] == Approx(u[6]).epsilon(1e-8));
}

}  // namespace assembler_test
