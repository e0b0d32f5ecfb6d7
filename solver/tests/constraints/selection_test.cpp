#include "solver/constraints/selection.hpp"

#include <catch2/catch.hpp>

#include "solver/constraints/congruence.hpp"

using namespace comma::solver;

namespace {

using Sparse = Eigen::SparseMatrix<double>;

Sparse transformation(int rows, int columns, const std::vector<Eigen::Triplet<double>>& entries) {
  Sparse matrix(rows, columns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

/// Full, so that every entry is told from every other.
SymmetricMatrix stiffness(int size) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int j = 0; j < size; ++j)
    for (int i = j; i < size; ++i) entries.emplace_back(i, j, 10.0 * i + j + 1.0);
  return transformation(size, size, entries);
}

}  // namespace

TEST_CASE("a transformation that leaves unknowns out is seen as such, one that does anything else is not") {
  CHECK(selected_unknowns(transformation(4, 2, {{1, 0, 1.0}, {3, 1, 1.0}})) == std::vector<int>{-1, 0, -1, 1});
  CHECK(selected_unknowns(transformation(2, 0, {})) == std::vector<int>{-1, -1});
  CHECK(selected_unknowns(transformation(2, 1, {{0, 0, 1.0}, {1, 0, 1.0}})).empty());  // two move together
  CHECK(selected_unknowns(transformation(2, 1, {{0, 0, -1.0}})).empty());              // one is turned round
  CHECK(selected_unknowns(transformation(2, 2, {{1, 0, 1.0}, {0, 1, 1.0}})).empty());  // two change places
}

TEST_CASE("what is selected of a matrix is its congruence, entry by entry") {
  const Sparse select = transformation(5, 3, {{0, 0, 1.0}, {2, 1, 1.0}, {3, 2, 1.0}});
  const SymmetricMatrix whole = stiffness(5);
  const SymmetricMatrix expected = Congruence(whole, select).apply(whole);
  const SymmetricMatrix found = select_unknowns(SymmetricMatrix(whole), selected_unknowns(select));
  REQUIRE(found.isCompressed());
  CHECK(found.nonZeros() == expected.nonZeros());
  CHECK(Eigen::MatrixXd(found) == Eigen::MatrixXd(expected));
}

TEST_CASE("a congruence with too many contributions to list is the same") {
  std::vector<Eigen::Triplet<double>> dense;
  for (int row = 0; row < 5; ++row)
    for (int column = 0; column < 4; ++column)
      dense.emplace_back(row, column, 0.1 * row - 0.3 * column + 0.05 * row * column);
  const Sparse ties = transformation(5, 4, dense);
  const SymmetricMatrix whole = stiffness(5);
  const Eigen::MatrixXd listed = Eigen::MatrixXd(Congruence(whole, ties).apply(whole)),
                        multiplied = Eigen::MatrixXd(Congruence(whole, ties, 0.0).apply(whole));
  CHECK((listed - multiplied).norm() < 1e-13 * listed.norm());
}

TEST_CASE("with nothing left out the matrix stays as it is, with all left out nothing of it stays") {
  const SymmetricMatrix whole = stiffness(3);
  CHECK(Eigen::MatrixXd(select_unknowns(SymmetricMatrix(whole), std::vector<int>{0, 1, 2})) == Eigen::MatrixXd(whole));
  const SymmetricMatrix none = select_unknowns(SymmetricMatrix(whole), std::vector<int>{-1, -1, -1});
  CHECK(none.rows() == 0);
  CHECK(none.nonZeros() == 0);
}

TEST_CASE("the part of a matrix lies where the matrix lay") {
  SymmetricMatrix whole = stiffness(4);
  const double* values = whole.valuePtr();
  const SymmetricMatrix part = select_unknowns(std::move(whole), std::vector<int>{-1, 0, 1, 2});
  CHECK(part.valuePtr() == values);
  SymmetricMatrix again = stiffness(4);
  values = again.valuePtr();
  CHECK(select_unknowns(std::move(again), std::vector<int>{0, 1, 2, 3}).valuePtr() == values);
}
