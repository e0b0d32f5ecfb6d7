#include "solver/unilateral/schur_complement.hpp"

#include <numeric>
#include <random>

#include <catch2/catch.hpp>

using namespace comma::solver;

TEST_CASE("Columns are A K^-1 A^T, solved for once each and in batches") {
  std::mt19937 generator(1);
  std::normal_distribution<double> normal;
  const auto draw = [&] { return normal(generator); };
  const int n = 30, m = 80;
  const Eigen::MatrixXd half = Eigen::MatrixXd::NullaryExpr(n, n, draw);
  const Eigen::MatrixXd stiffness = half * half.transpose() + Eigen::MatrixXd::Identity(n, n);
  const Eigen::MatrixXd rows = Eigen::MatrixXd::NullaryExpr(m, n, draw);
  const Eigen::LLT<Eigen::MatrixXd> factor(stiffness);
  long columns = 0, calls = 0;
  SchurComplement schur(rows.sparseView(), [&](Eigen::Ref<Eigen::MatrixXd> rhs) {
    ++calls;
    columns += rhs.cols();
    rhs = factor.solve(rhs).eval();
  });
  std::vector<int> wanted;
  for (int i = 0; i < 70; ++i) wanted.push_back(i);
  schur.require(wanted);
  schur.require(std::vector<int>{3, 5, 69});
  CHECK(columns == 70);
  CHECK(calls == 3);  // 32 + 32 + 6
  const Eigen::MatrixXd expected = rows * factor.solve(rows.transpose());
  for (const int i : wanted) CHECK((schur.column(i) - expected.col(i)).norm() < 1e-10 * expected.norm());

  SECTION("the same rows keep their columns") {
    schur.replace_rows(rows.sparseView());
    CHECK(schur.known(3));
  }
  SECTION("other rows do not") {
    schur.replace_rows((2.0 * rows).sparseView());
    CHECK_FALSE(schur.known(3));
  }
  SECTION("nor does a new factorisation") {
    schur.forget();
    CHECK_FALSE(schur.known(3));
  }
}

TEST_CASE("Rows that change are served by the compliance of their unknowns without a solve") {
  std::mt19937 generator(2);
  std::normal_distribution<double> normal;
  const auto draw = [&] { return normal(generator); };
  const int n = 50, m = 12;
  const Eigen::MatrixXd half = Eigen::MatrixXd::NullaryExpr(n, n, draw);
  const Eigen::LLT<Eigen::MatrixXd> factor(half * half.transpose() + Eigen::MatrixXd::Identity(n, n));
  const std::vector<int> support = {3, 4, 10, 11, 12, 30, 41, 49};
  const auto random_rows = [&] {
    Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(m, n);
    for (const int unknown : support) rows.col(unknown) = Eigen::VectorXd::NullaryExpr(m, draw);
    return rows;
  };
  long solves = 0;
  SchurComplement schur(
      random_rows().sparseView(),
      [&](Eigen::Ref<Eigen::MatrixXd> rhs) {
        solves += rhs.cols();
        rhs = factor.solve(rhs).eval();
      },
      support);
  std::vector<int> all(m);
  for (int i = 0; i < m; ++i) all[i] = i;
  schur.require(all);
  CHECK(solves == m);
  for (int change = 0; change < 5; ++change) {
    const Eigen::MatrixXd rows = random_rows();
    schur.replace_rows(rows.sparseView());
    schur.require(all);
    const Eigen::MatrixXd expected = rows * factor.solve(rows.transpose());
    for (int i = 0; i < m; ++i) CHECK((schur.column(i) - expected.col(i)).norm() < 1e-11 * expected.norm());
  }
  CHECK(solves == m + static_cast<long>(support.size()));

  Eigen::MatrixXd elsewhere = random_rows();
  elsewhere(0, 20) = 1.0;  // off the support: solved for, and right all the same
  schur.replace_rows(elsewhere.sparseView());
  schur.require(std::vector<int>{0});
  CHECK((schur.column(0) - elsewhere * factor.solve(elsewhere.row(0).transpose())).norm() < 1e-10);
}

namespace {

/// K is diagonal, and so large that the compliance of its unknowns is not kept. Row r touches unknowns 3 r, 3 r + 1 and
/// 3 r + 2, with weights that turn with `place`.
struct LongBeam {
  static constexpr int rows = 400;
  static constexpr int unknowns = 3 * rows;
  long solves = 0;

  static double stiffness(int unknown) { return 1.0 + 0.01 * unknown; }
  static RowMatrix matrix(const std::vector<int>& places, double turn) {
    std::vector<Eigen::Triplet<double>> entries;
    for (std::size_t row = 0; row < places.size(); ++row) {
      const int first = 3 * places[row];
      entries.emplace_back(row, first, 1.0);
      entries.emplace_back(row, first + 1, -turn);
      entries.emplace_back(row, (first + 3) % unknowns, turn - 1.0);
    }
    RowMatrix result(static_cast<Eigen::Index>(places.size()), unknowns);
    result.setFromTriplets(entries.begin(), entries.end());
    return result;
  }
  SchurComplement::ApplyInverse inverse() {
    return [this](Eigen::Ref<Eigen::MatrixXd> columns) {
      solves += columns.cols();
      for (int unknown = 0; unknown < unknowns; ++unknown) columns.row(unknown) /= stiffness(unknown);
    };
  }
  static Eigen::MatrixXd compliance(const RowMatrix& a, const RowMatrix& b) {
    Eigen::VectorXd softness(unknowns);
    for (int unknown = 0; unknown < unknowns; ++unknown) softness[unknown] = 1.0 / stiffness(unknown);
    return Eigen::MatrixXd(a * softness.asDiagonal() * b.transpose());
  }
};

std::vector<int> numbers(int first, int count) {
  std::vector<int> result(static_cast<std::size_t>(count));
  std::iota(result.begin(), result.end(), first);
  return result;
}

}  // namespace

TEST_CASE("Of many unknowns, rows that turn keep the columns of those before them until they are asked for anew") {
  LongBeam beam;
  const std::vector<int> before = numbers(0, 399);
  const std::vector<int> after = numbers(1, 399);  // 0 leaves, 399 comes
  SchurComplement schur(beam.matrix(before, 0.3), beam.inverse(), numbers(0, LongBeam::unknowns), before);
  schur.require(numbers(0, 399));
  REQUIRE(schur.is_exact());
  REQUIRE(beam.solves == 399);

  const RowMatrix turned = beam.matrix(after, 0.31);
  schur.replace_rows(turned, after);
  CHECK_FALSE(schur.is_exact());
  schur.require(numbers(0, 399));
  CHECK(beam.solves == 400);
  // The one that came has its own row, the others those of before: together the compliance of one set of rows.
  RowMatrix mixed = beam.matrix(after, 0.3);
  for (RowMatrix::InnerIterator it(mixed, 398); it; ++it) it.valueRef() = turned.coeff(398, it.col());
  const Eigen::MatrixXd expected = beam.compliance(mixed, mixed);
  for (const int row : {0, 7, 397, 398})
    CHECK((schur.column(row) - expected.col(row)).norm() < 1e-14 * expected.col(row).norm());

  schur.start_anew();
  REQUIRE(schur.is_exact());
  schur.require(numbers(0, 399));
  const Eigen::MatrixXd anew = beam.compliance(turned, turned);
  for (const int row : {0, 7, 397, 398})
    CHECK((schur.column(row) - anew.col(row)).norm() < 1e-14 * anew.col(row).norm());
}

TEST_CASE("Many columns come from the whole where there is a way to it") {
  LongBeam beam;
  const RowMatrix rows = beam.matrix(numbers(0, 400), 0.3);
  SchurComplement schur(rows, beam.inverse(), numbers(0, LongBeam::unknowns));
  schur.use_whole([&](const RowMatrix& all) { return beam.compliance(all, all); });
  schur.require(numbers(0, 3));
  CHECK(beam.solves == 3);
  schur.require(numbers(0, 200));
  CHECK(beam.solves == 3);
  CHECK(schur.known(399));
  CHECK((schur.column(150) - beam.compliance(rows, rows).col(150)).norm() == 0.0);
}

TEST_CASE("Rows that come to a whole of columns get theirs, and products take all of them") {
  LongBeam beam;
  const std::vector<int> before = numbers(0, 399);
  const std::vector<int> after = numbers(1, 399);
  SchurComplement schur(beam.matrix(before, 0.3), beam.inverse(), numbers(0, LongBeam::unknowns), before);
  schur.use_whole([&](const RowMatrix& all) { return beam.compliance(all, all); });
  schur.soften(Eigen::VectorXd::Constant(399, 0.5));
  schur.require(numbers(0, 399));
  const RowMatrix rows = beam.matrix(after, 0.3);
  schur.replace_rows(rows, after, Eigen::VectorXd::Constant(399, 0.5));
  CHECK(beam.solves == 1);
  const Eigen::MatrixXd expected = beam.compliance(rows, rows) + 0.5 * Eigen::MatrixXd::Identity(399, 399);
  for (const int row : {0, 7, 397, 398})
    CHECK((schur.column(row) - expected.col(row)).norm() < 1e-14 * expected.col(row).norm());
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(399, -1.0, 1.0);
  CHECK((schur.times(x) - expected * x).norm() < 1e-14 * x.norm());
  CHECK((schur.times_roughly(x) - expected * x).norm() < 1e-5 * x.norm());
}

TEST_CASE("Of many rows on few unknowns S is its factors: one solve an unknown, however often rows change") {
  std::mt19937 generator(3);
  std::normal_distribution<double> normal;
  const auto draw = [&] { return normal(generator); };
  const int n = 60, unknowns = 40, m = SchurComplement::factored_rows + 7;
  const Eigen::MatrixXd half = Eigen::MatrixXd::NullaryExpr(n, n, draw);
  const Eigen::LLT<Eigen::MatrixXd> factor(half * half.transpose() + Eigen::MatrixXd::Identity(n, n));
  std::vector<int> support(unknowns), all(m);
  std::iota(support.begin(), support.end(), 5);
  std::iota(all.begin(), all.end(), 0);
  const auto random_rows = [&](int count) {
    Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(count, n);
    for (int row = 0; row < count; ++row)
      for (int k = 0; k < 3; ++k) rows(row, 5 + static_cast<int>(generator() % unknowns)) += draw();
    return rows;
  };
  long solves = 0;
  Eigen::MatrixXd rows = random_rows(m);
  SchurComplement schur(
      rows.sparseView(),
      [&](Eigen::Ref<Eigen::MatrixXd> rhs) {
        solves += rhs.cols();
        rhs = factor.solve(rhs).eval();
      },
      support);
  const Eigen::VectorXd softness = Eigen::VectorXd::LinSpaced(m, 0.0, 1.0);
  schur.soften(softness);

  const auto check = [&](const Eigen::VectorXd& soft) {
    schur.require(all);
    Eigen::MatrixXd expected = rows * factor.solve(rows.transpose());
    if (soft.size()) expected.diagonal() += soft;
    const Eigen::VectorXd x = Eigen::VectorXd::NullaryExpr(rows.rows(), draw);
    CHECK((schur.times(x) - expected * x).norm() < 1e-10 * expected.norm() * x.norm());
    CHECK((schur.column(8) - expected.col(8)).norm() < 1e-10 * expected.norm());
    const std::vector<int> some = {9, 2, 400};
    const Eigen::MatrixXd forces = Eigen::MatrixXd::NullaryExpr(3, 2, draw),
                          weights = Eigen::MatrixXd::NullaryExpr(2, 3, draw);
    const Responses responses = schur.responses(some, forces.sparseView());
    const Eigen::MatrixXd moved = expected(some, some) * forces;
    const double rounding = 1e-10 * expected.norm() * forces.norm();
    CHECK((responses.whole() - moved).norm() < rounding);
    CHECK((responses.weighed_by(weights.sparseView()) - weights * moved).norm() < rounding * weights.norm());
    CHECK((responses * Eigen::Vector2d(1.0, -2.0) - moved * Eigen::Vector2d(1.0, -2.0)).norm() < 3.0 * rounding);
    CHECK(schur.is_exact());
  };
  check(softness);
  CHECK(solves == unknowns);
  rows = random_rows(m);
  schur.replace_rows(rows.sparseView());
  check({});
  CHECK(solves == unknowns);
  schur.forget();
  check({});
  CHECK(solves == 2 * unknowns);

  SECTION("few rows are multiplied out") {
    rows = random_rows(SchurComplement::factored_rows - 1);
    all.resize(static_cast<std::size_t>(rows.rows()));
    schur.replace_rows(rows.sparseView());
    check({});
  }
  SECTION("and so are rows on other unknowns") {
    rows(0, 0) = 1.0;
    schur.replace_rows(rows.sparseView());
    check({});
  }
}

TEST_CASE("Few of many rows on many unknowns are solved for one by one, and more of them at once") {
  const int unknowns = static_cast<int>(SchurComplement::largest_support) + 20, m = 2 * unknowns;
  const auto rows = [&](double share) {
    RowMatrix result(m, unknowns);
    for (int row = 0; row < m; ++row) {
      const int at = row % (unknowns - 1);
      result.insert(row, at) = 1.0;
      result.insert(row, at + 1) = share;
    }
    return result;
  };
  std::vector<int> all(m);
  std::iota(all.begin(), all.end(), 0);
  std::vector<int> support(all.begin(), all.begin() + unknowns);
  long solves = 0;
  SchurComplement schur(
      rows(0.5),
      [&](Eigen::Ref<Eigen::MatrixXd> rhs) {
        solves += rhs.cols();
        rhs *= 2.0;
      },
      support);
  const auto check = [&](double share, std::vector<int> required) {
    schur.require(required);
    const Eigen::VectorXd expected = 2.0 * (rows(share) * rows(share).row(7).transpose()).toDense();
    CHECK((schur.column(7) - expected).norm() < 1e-14 * expected.norm());
    Eigen::VectorXd x = Eigen::VectorXd::Zero(m);
    x[7] = -3.0;
    CHECK((schur.times(x) + 3.0 * expected).norm() < 1e-14 * expected.norm());
    CHECK(schur.is_exact());
  };
  check(0.5, {3, 7, m - 1});
  CHECK(solves == 3);
  check(0.5, all);
  CHECK(solves == 3 + unknowns);
  schur.replace_rows(rows(0.25));
  check(0.25, all);
  CHECK(solves == 3 + unknowns);

  SECTION("from columns of other rows too") {
    schur.start_anew();
    schur.require(std::vector<int>{7});
    schur.replace_rows(rows(0.5));
    CHECK(!schur.is_exact());
    check(0.5, all);
  }
}
