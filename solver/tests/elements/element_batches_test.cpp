#include "solver/elements/element_batches.hpp"

#include <cmath>
#include <stdexcept>

#include <catch2/catch.hpp>

using namespace comma::solver;

namespace {

/// As large as an element matrix, so that a few hundred elements make several batches.
using Item = std::array<double, 2048>;

/// A sum whose last digits depend on the order of its terms.
double sum_of(int count, bool concurrent) {
  double sum = 0.0;
  for_each_in_batches<Item>(
      count, concurrent, [](int element, Item& item) { item.fill(std::sin(1.0 + element) / (1.0 + element % 7)); },
      [&](int element, const Item& item) { sum += item[static_cast<std::size_t>(element) % item.size()]; });
  return sum;
}

}  // namespace

TEST_CASE("batches add up in the order of the elements, to the last digit, with threads and without") {
  for (const int count : {0, 1, 255, 256, 257, 512, 1000, 3001}) {
    double expected = 0.0;
    for (int element = 0; element < count; ++element) expected += std::sin(1.0 + element) / (1.0 + element % 7);
    CHECK(sum_of(count, false) == expected);
    CHECK(sum_of(count, true) == expected);
  }
}

TEST_CASE("every element is computed and added once, in order") {
  constexpr int count = 1500;
  std::vector<int> computed(count, 0), added;
  for_each_in_batches<Item>(
      count, true, [&](int element, Item&) { ++computed[static_cast<std::size_t>(element)]; },
      [&](int element, const Item&) { added.push_back(element); });
  CHECK(std::ranges::all_of(computed, [](int times) { return times == 1; }));
  REQUIRE(static_cast<int>(added.size()) == count);
  for (int element = 0; element < count; ++element) CHECK(added[static_cast<std::size_t>(element)] == element);
}

TEST_CASE("an element that fails stops the sum with its own error") {
  for (const bool concurrent : {false, true}) {
    const auto run = [&] {
      for_each_in_batches<Item>(
          1000, concurrent,
          [](int element, Item&) {
            if (element == 700) throw std::runtime_error("element 700");
          },
          [](int, const Item&) {});
    };
    CHECK_THROWS_WITH(run(), "element 700");
  }
}
