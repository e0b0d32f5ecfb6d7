#include "solver/unilateral/rounds.hpp"

#include <array>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

using namespace comma::solver;

namespace rounds_test {

/// One row whose column is that of an earlier stiffness.
SchurComplement of_earlier_stiffness() {
  const int unknowns = static_cast<int>(SchurComplement::largest_support) + 1;
  RowMatrix row(1, unknowns);
  row.insert(0, 0) = 1.0;
  std::vector<int> support(static_cast<std::size_t>(unknowns));
  std::iota(support.begin(), support.end(), 0);
  SchurComplement schur(
      row, [](Eigen::Ref<Eigen::MatrixXd>) {}, support);
  const std::array<int, 1> first = {0};
  schur.require(first);
  schur.forget();
  REQUIRE_FALSE(schur.is_exact());
  return schur;
}

/// Rounds that each leave a thousandth of a change, from the first one on.
int count_of_rounds(SchurComplement& schur, double change, double negligible) {
  int rounds = 0;
  settle_in_rounds(schur, negligible, [&]() -> std::optional<double> {
    ++rounds;
    return std::exchange(change, 1e-3 * change);
  });
  return rounds;
}

TEST_CASE("Rounds end where the next one would change nothing, going by what earlier ones have left") {
  SchurComplement schur = of_earlier_stiffness();
  CHECK(count_of_rounds(schur, 1e-2, 5e-11) == 3);
  CHECK(count_of_rounds(schur, 1e-8, 5e-11) == 1);
  CHECK(count_of_rounds(schur, 1e-8, 5e-13) == 2);
  CHECK(count_of_rounds(schur, 1e-6, 5e-11) == 2);
  SECTION("another stiffness has left nothing yet") {
    schur.forget();
    CHECK(count_of_rounds(schur, 1e-8, 5e-11) == 2);
  }
  SECTION("a round that left more counts from then on") {
    schur.note_left(0.1);
    CHECK(count_of_rounds(schur, 1e-8, 5e-11) == 2);
  }
}

}  // namespace rounds_test
