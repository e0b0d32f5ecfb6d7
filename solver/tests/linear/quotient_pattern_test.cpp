#include "solver/linear/quotient_pattern.hpp"

#include <catch2/catch.hpp>

using namespace comma::solver;

TEST_CASE("Unknowns of a node that has the same neighbours are one in the pattern that is ordered") {
  // A chain of three nodes with two unknowns each; of the one in the middle one is held.
  const std::vector<int> nodes = {0, 0, 1, 2, 2};
  SymmetricMatrix matrix(5, 5);
  for (int column = 0; column < 5; ++column)
    for (int row = column; row < 5; ++row)
      if (nodes[row] - nodes[column] < 2) matrix.insert(row, column) = 1.0;
  matrix.makeCompressed();
  const QuotientPattern pattern = quotient_pattern(matrix);
  REQUIRE(pattern.size() == 3);
  CHECK(pattern.first_rows == std::vector<int>{0, 2, 3, 5});
  CHECK(pattern.column_starts == std::vector<int>{0, 2, 4, 5});
  CHECK(pattern.rows == std::vector<int>{0, 1, 1, 2, 2});
  const std::vector<int> order = {2, 0, 1};
  CHECK(pattern.expanded(order.data()) == std::vector<int>{3, 4, 0, 1, 2});
}
