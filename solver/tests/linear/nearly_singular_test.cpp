// The founding scene's matrix: a body of 2e9 Pa that springs of 10 N/m alone keep in place sideways, pressed on a body
// of 2e16 Pa.
#include <chrono>
#include <cmath>
#include <memory>
#include <vector>

#include <fmt/format.h>
#include <catch2/catch.hpp>

#include "solver/constraints/elimination.hpp"
#include "solver/linear/linear_solver.hpp"

using namespace comma::solver;

namespace nearly_singular_test {

constexpr double side = 50.0;         // m
constexpr double soft_modulus = 2e9;  // Pa
constexpr double stiff_modulus = 2e16;
constexpr double poisson = 0.3;
constexpr double spring = 10.0;   // N/m
constexpr double descent = 20.0;  // m
// The lateral strain of a plane-strain body between frictionless plates is nu / (1 - nu) times the compression.
const double widening = poisson / (1.0 - poisson) * descent / 2.0;

using Extended = long double;
using ElementMatrix = Eigen::Matrix<Extended, 8, 8>;

/// A square four-node element in plane strain, unit thickness; the size of the square cancels.
ElementMatrix square_stiffness(Extended modulus) {
  const Extended nu = 3.0L / 10.0L;
  Eigen::Matrix<Extended, 3, 3> law = Eigen::Matrix<Extended, 3, 3>::Zero();
  law(0, 0) = law(1, 1) = 1.0L - nu;
  law(0, 1) = law(1, 0) = nu;
  law(2, 2) = (1.0L - 2.0L * nu) / 2.0L;
  law *= modulus / ((1.0L + nu) * (1.0L - 2.0L * nu));
  const int corner_x[] = {-1, 1, 1, -1}, corner_y[] = {-1, -1, 1, 1};
  const Extended gauss = 1.0L / std::sqrt(3.0L);
  ElementMatrix stiffness = ElementMatrix::Zero();
  for (const Extended x : {-gauss, gauss}) {
    for (const Extended y : {-gauss, gauss}) {
      Eigen::Matrix<Extended, 3, 8> strain = Eigen::Matrix<Extended, 3, 8>::Zero();
      for (int a = 0; a < 4; ++a) {
        const Extended slope_x = corner_x[a] * (1.0L + corner_y[a] * y) / 4.0L,
                       slope_y = corner_y[a] * (1.0L + corner_x[a] * x) / 4.0L;
        strain(0, 2 * a) = strain(2, 2 * a + 1) = slope_x;
        strain(1, 2 * a + 1) = strain(2, 2 * a) = slope_y;
      }
      stiffness += strain.transpose() * law * strain;
    }
  }
  return stiffness;
}

/// Two bodies of cells x cells elements, the soft one (nodes first) on y in [0, side], the stiff one below it; they
/// touch along y = 0 in nodes of their own.
struct Scene {
  explicit Scene(int cells) : cells_(cells) {
    model.mesh = std::make_shared<Mesh>();
    model.mesh->dimension = 2;
    add_body(0.0);
    add_body(-side);
    dofs = std::make_unique<DofMap>(model);
    stiffness = assemble();
    elimination = std::make_unique<Elimination>(*model.mesh, *dofs, conditions());
  }

  int node(int body, int column, int row) const { return (body * (cells_ + 1) + row) * (cells_ + 1) + column; }
  int dof(int node_index, Component component) const { return dofs->dof(node_index, component); }

  void add_body(double bottom) {
    const int first = model.mesh->node_count();
    const double step = side / cells_;
    for (int row = 0; row <= cells_; ++row) {
      for (int column = 0; column <= cells_; ++column)
        model.mesh->nodes.push_back({column * step - side / 2, bottom + row * step, 0});
    }
    for (int row = 0; row < cells_; ++row) {
      for (int column = 0; column < cells_; ++column) {
        const int a = first + row * (cells_ + 1) + column;
        model.mesh->add_cell(CellType::quad4, std::vector<int>{a, a + 1, a + cells_ + 2, a + cells_ + 1});
        model.formulations.push_back(Formulation::plane_strain);
      }
    }
  }

  /// Summed in extended precision, rounded once: what is a mirror image in the scene is one in the matrix.
  SymmetricMatrix assemble() const {
    std::vector<Eigen::Triplet<Extended>> entries;
    for (int cell = 0; cell < model.mesh->cell_count(); ++cell) {
      const auto nodes = model.mesh->cell(cell);
      const ElementMatrix element = square_stiffness(cell < cells_ * cells_ ? soft_modulus : stiff_modulus);
      for (int i = 0; i < 8; ++i) {
        for (int j = 0; j < 8; ++j) {
          const int row = 2 * nodes[i / 2] + i % 2, column = 2 * nodes[j / 2] + j % 2;
          if (row >= column) entries.emplace_back(row, column, element(i, j));
        }
      }
    }
    for (const int row : {0, cells_}) {
      for (const int column : {0, cells_}) {
        const int at = dof(node(0, column, row), Component::dx);
        entries.emplace_back(at, at, spring);
      }
    }
    Eigen::SparseMatrix<Extended> sum(dofs->size(), dofs->size());
    sum.setFromTriplets(entries.begin(), entries.end());
    return sum.cast<double>();
  }

  std::vector<AppliedLoad> conditions() const {
    auto load = std::make_shared<Load>();
    for (int column = 0; column <= cells_; ++column) {
      load->relations.push_back({{{node(0, column, cells_), Component::dy, 1.0}}, -descent, {}, {}});
      load->relations.push_back(
          {{{node(0, column, 0), Component::dy, 1.0}, {node(1, column, cells_), Component::dy, -1.0}}, 0.0, {}, {}});
      for (const auto component : {Component::dx, Component::dy})
        load->relations.push_back({{{node(1, column, 0), component, 1.0}}, 0.0, {}, {}});
    }
    return {AppliedLoad{load, {}}};
  }

  /// -T^T K g summed in extended precision.
  Eigen::VectorXd right_hand_side() const {
    using Vector = Eigen::Matrix<Extended, Eigen::Dynamic, 1>;
    const Eigen::SparseMatrix<Extended> matrix = stiffness.cast<Extended>();
    const Vector offset = elimination->offset(0.0).cast<Extended>();
    const Eigen::SparseMatrix<Extended> transformation = elimination->transformation().cast<Extended>();
    const Vector force = matrix.selfadjointView<Eigen::Lower>() * offset;
    const Vector reduced = transformation.transpose() * force;
    return -reduced.cast<double>();
  }

  Model model;
  std::unique_ptr<DofMap> dofs;
  SymmetricMatrix stiffness;
  std::unique_ptr<Elimination> elimination;

 private:
  int cells_;
};

/// The pattern of a cube of linear bricks, three unknowns a node; values that make it positive definite.
SymmetricMatrix brick(int cells) {
  const int n = cells + 1;
  std::vector<Eigen::Triplet<double>> entries;
  const auto couple = [&](int a, int b) {
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        if (3 * a + i >= 3 * b + j) entries.emplace_back(3 * a + i, 3 * b + j, 3 * a + i == 3 * b + j ? 30.0 : -0.3);
      }
    }
  };
  for (int at = 0; at < n * n * n; ++at) {
    const int x = at % n, y = at / n % n, z = at / n / n;
    for (int k = 0; k < 27; ++k) {
      const int u = x + k % 3 - 1, v = y + k / 3 % 3 - 1, w = z + k / 9 - 1;
      if (u >= 0 && v >= 0 && w >= 0 && u < n && v < n && w < n) couple(at, u + n * (v + n * w));
    }
  }
  SymmetricMatrix matrix(3 * n * n * n, 3 * n * n * n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

struct Outcome {
  FactorReport report;
  double left = 0.0, right = 0.0;  ///< DX at the lower corners of the soft body
  double asymmetry = 0.0;          ///< largest |DX(x, y) + DX(-x, y)| over the soft body
  double seconds = 0.0;
};

Outcome solve(const Scene& scene, int cells, LinearMethod method, const LinearOptions& options) {
  const SymmetricMatrix reduced = scene.elimination->reduce(scene.stiffness);
  const auto start = std::chrono::steady_clock::now();
  auto solver = make_linear_solver(method, options);
  solver->analyse(reduced);
  Outcome outcome;
  outcome.report = solver->factorise(reduced);
  Eigen::MatrixXd solution = scene.right_hand_side();
  solver->solve(solution);
  outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const Eigen::VectorXd u = scene.elimination->transformation() * solution.col(0) + scene.elimination->offset(0.0);
  const auto dx_at = [&](int column, int row) { return u[scene.dof(scene.node(0, column, row), Component::dx)]; };
  outcome.left = dx_at(0, 0);
  outcome.right = dx_at(cells, 0);
  for (int row = 0; row <= cells; ++row) {
    for (int column = 0; column <= cells; ++column) {
      outcome.asymmetry = std::max(outcome.asymmetry, std::abs(dx_at(column, row) + dx_at(cells - column, row)));
    }
  }
  return outcome;
}

TEST_CASE("a body of 2e9 Pa held by springs of 10 N/m stays where symmetry puts it, with every solver") {
  const auto method = GENERATE(LinearMethod::mumps, LinearMethod::cholmod, LinearMethod::eigen_ldlt);
  const int cells = GENERATE(1, 8);
  CAPTURE(name_of(method), cells);
  const Outcome outcome = solve(Scene(cells), cells, method, {});
  CHECK(outcome.report.verdict == FactorVerdict::ok);
  CHECK(outcome.asymmetry < 1e-8);
  // The springs' 40 N/m and the stiff body's give, 1e-7 of the soft one's, change the widening by less than 1e-6 of it.
  CHECK(outcome.left == Approx(-widening).epsilon(1e-6));
  CHECK(outcome.right == Approx(widening).epsilon(1e-6));
}

TEST_CASE("the figures of docs/linear_solvers.md", "[.figures]") {
  const LinearMethod methods[] = {LinearMethod::mumps, LinearMethod::cholmod, LinearMethod::eigen_ldlt};
  for (const int cells : {1, 8, 40}) {
    const Scene scene(cells);
    for (const LinearMethod method : methods) {
      for (const bool equilibrate : {false, true}) {
        for (const int steps : {0, 20}) {
          LinearOptions options;
          options.singular_digits = -1;
          options.refinement_steps = steps;
          options.equilibrate = equilibrate;
          const Outcome outcome = solve(scene, cells, method, options);
          fmt::print(
              "{0} x {0} cells, {1:8} scaled {2:5} refined {3:5}: asymmetry {4:.1e} m, lost digits {5}, {6:.2f} ms\n",
              cells, name_of(method), equilibrate, steps > 0, outcome.asymmetry, outcome.report.lost_digits,
              1e3 * outcome.seconds);
        }
      }
    }
  }
}

TEST_CASE("the times of docs/linear_solvers.md", "[.figures]") {
  LinearOptions untested;
  untested.singular_digits = -1;
  for (const int cells : {2, 5, 10, 15, 22, 32, 50, 100, 160}) {
    const Scene scene(cells);
    for (const LinearMethod method : {LinearMethod::mumps, LinearMethod::cholmod, LinearMethod::eigen_ldlt}) {
      const Outcome outcome = solve(scene, cells, method, untested);
      fmt::print("plane, {:6} unknowns, {:8}: {:8.2f} ms\n", scene.elimination->reduced_size(), name_of(method),
                 1e3 * outcome.seconds);
    }
  }
  for (const int cells : {3, 6, 9, 14, 20}) {
    const SymmetricMatrix matrix = brick(cells);
    for (const LinearMethod method : {LinearMethod::mumps, LinearMethod::cholmod, LinearMethod::eigen_ldlt}) {
      const auto start = std::chrono::steady_clock::now();
      auto solver = make_linear_solver(method, {});
      solver->analyse(matrix);
      solver->factorise(matrix);
      Eigen::MatrixXd rhs = Eigen::VectorXd::Ones(matrix.rows());
      solver->solve(rhs);
      const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      fmt::print("solid, {:6} unknowns, {:8}: {:8.2f} ms\n", matrix.rows(), name_of(method), 1e3 * seconds);
    }
  }
}

}  // namespace nearly_singular_test
