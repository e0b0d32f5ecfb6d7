#include "commands/loads/multiplier_sum.hpp"

#include <catch2/catch.hpp>

using comma::commands::MultiplierSum;

namespace multiplier_sum_test {

using Values = MultiplierSum::Values;
using Sum = std::shared_ptr<const MultiplierSum>;

Sum source(Values values) {
  return std::make_shared<const MultiplierSum>([values] { return values; });
}

Sum sum(std::vector<std::pair<double, Sum>> terms) { return std::make_shared<const MultiplierSum>(std::move(terms)); }

TEST_CASE("Multipliers beside a sum are the sum of those of its terms, and none where terms have not as many") {
  const Sum a = source({1.0, 2.0}), b = source({10.0, 20.0});
  CHECK(a->values() == Values{1.0, 2.0});
  CHECK(sum({{2.0, a}, {-1.0, b}, {1.0, a}})->values() == Values{-7.0, -14.0});
  CHECK(sum({{1.0, a}, {1.0, source({3.0})}})->values().empty());
  CHECK(sum({{1.0, a}, {1.0, source({3.0})}, {1.0, b}})->values().empty());
}

TEST_CASE("A long chain of sums is computed and let go of without recursion") {
  Sum last = source({1.0});
  for (int i = 0; i < 200000; ++i) last = sum({{0.5, last}, {0.5, last}});
  CHECK(last->values() == Values{1.0});
}

}  // namespace multiplier_sum_test
