#include "solver/contact_law/support_step.hpp"

#include <numeric>
#include <random>

#include <catch2/catch.hpp>

using namespace comma::solver;

namespace {

/// Many rows on few unknowns, every other one with a penalty.
struct ManyRows {
  static constexpr int unknowns = 30, rows = SchurComplement::factored_rows + 3, laws = 12;
  std::mt19937 generator{7};
  std::normal_distribution<double> normal;
  Eigen::LLT<Eigen::MatrixXd> stiffness;
  SchurComplement schur;
  InterpolatedStep step;

  explicit ManyRows(double penalty)
      : stiffness(positive_definite()),
        schur(
            random_rows(), [this](Eigen::Ref<Eigen::MatrixXd> rhs) { rhs = stiffness.solve(rhs).eval(); },
            numbers(unknowns)),
        step(numbers(rows), rows + laws) {
    for (int row = 0; row < rows; ++row) {
      if (row % 2 == 0) step.add_force_derivative(row, row, -penalty);
      for (const int law : {row % laws, (row + 1) % laws}) {
        const double share = draw();
        step.add_force_derivative(row, rows + law, share);
        step.add_law_derivative(rows + law, row, -share);
      }
    }
    for (int law = rows; law < rows + laws; ++law) {
      step.add_law_derivative(law, law, -0.1);
      step.add_law_weight(law, 1.0);
    }
    schur.require(step.rows());
  }

  double draw() { return normal(generator); }
  static std::vector<int> numbers(int count) {
    std::vector<int> result(static_cast<std::size_t>(count));
    std::iota(result.begin(), result.end(), 0);
    return result;
  }
  Eigen::MatrixXd positive_definite() {
    const Eigen::MatrixXd half = Eigen::MatrixXd::NullaryExpr(unknowns, unknowns, [&] { return draw(); });
    return half * half.transpose() + 10.0 * Eigen::MatrixXd::Identity(unknowns, unknowns);
  }
  RowMatrix random_rows() {
    std::vector<Eigen::Triplet<double>> entries;
    for (int row = 0; row < rows; ++row)
      for (int k = 0; k < 3; ++k) entries.emplace_back(row, static_cast<int>(generator() % unknowns), draw());
    RowMatrix result(rows, unknowns);
    result.setFromTriplets(entries.begin(), entries.end());
    return result;
  }
};

}  // namespace

TEST_CASE(
    "On the unknowns that rows touch steps are solved to the digits of their jumps, however stiff penalties are") {
  for (const double penalty : {0.0, 1.0, 1e4, 1e8}) {
    ManyRows scene(penalty);
    const Eigen::MatrixXd* compliance = scene.schur.kept_compliance();
    REQUIRE(compliance != nullptr);
    const Eigen::VectorXd b = Eigen::VectorXd::NullaryExpr(scene.step.unknowns(), [&] { return scene.draw(); });
    const Eigen::VectorXd x =
        SupportStep(scene.step, scene.schur.on_support(scene.step.rows()), *compliance).solve(b, *compliance);
    Eigen::VectorXd left = b;
    left.head(ManyRows::rows) -= x.head(ManyRows::rows) - scene.schur.times(scene.step.forces() * x);
    left.tail(ManyRows::laws) -= scene.step.laws() * x;
    CAPTURE(penalty, left.norm());
    CHECK(left.norm() < 1e-12 * b.norm() * std::max(1.0, std::sqrt(penalty)));
    CHECK((InterpolatedSolver().solve(scene.step, scene.schur, b) - x).norm() == 0.0);
  }
}
