// The numbers of controls are those of the "MUMPS 5.5.1 Users' guide", sections 3.18, 5 and 6.
#include "solver/linear/bordered_compliance.hpp"

#include <numeric>
#include <vector>

#include "solver/linear/dense_solve.hpp"
#include "solver/linear/equilibration.hpp"
#include "solver/linear/mumps_instance.hpp"

namespace comma::solver {
namespace {

constexpr int job_analyse_and_factorise = 4;
constexpr int nested_dissection = 5;
constexpr int centralised_schur = 1;
constexpr int extra_workspace = 60;  // per cent: delayed pivots do not occur, but the estimate does not know the border

/// The bordered matrix in coordinates, lower triangle, from 1 on.
struct Bordered {
  std::vector<int> rows, columns;
  std::vector<double> values;

  Bordered(const SymmetricMatrix& stiffness, const Eigen::SparseMatrix<double, Eigen::RowMajor>& border,
           const Eigen::VectorXd& scale) {
    const auto size = static_cast<std::size_t>(stiffness.nonZeros() + border.nonZeros() + border.rows());
    rows.reserve(size);
    columns.reserve(size);
    values.reserve(size);
    for (int column = 0; column < stiffness.outerSize(); ++column)
      for (SymmetricMatrix::InnerIterator it(stiffness, column); it; ++it)
        add(static_cast<int>(it.row()), column, it.value() * scale[it.row()] * scale[column]);
    const int first = static_cast<int>(stiffness.rows());
    for (int row = 0; row < border.outerSize(); ++row) {
      for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator it(border, row); it; ++it)
        add(first + row, static_cast<int>(it.col()), it.value() * scale[it.col()]);
      add(first + row, first + row, 0.0);
    }
  }

  void add(int row, int column, double value) {
    rows.push_back(row + 1);
    columns.push_back(column + 1);
    values.push_back(value);
  }
};

class SchurFactorisation {
 public:
  SchurFactorisation() {
    mumps_.control(7) = nested_dissection;
    mumps_.control(14) = extra_workspace;
    mumps_.control(19) = centralised_schur;
    mumps_.control(31) = 1;     // the factors themselves are of no use
    mumps_.threshold(1) = 0.0;  // positive definite: no search for pivots
  }

  /// Of the last `count` rows; its upper triangle.
  Eigen::MatrixXd schur(Bordered& matrix, int size, int count) {
    std::vector<int> last(static_cast<std::size_t>(count));
    std::iota(last.begin(), last.end(), size - count + 1);
    Eigen::MatrixXd result(count, count);
    DMUMPS_STRUC_C& data = mumps_.data();
    data.n = size;
    data.nnz = static_cast<MUMPS_INT8>(matrix.values.size());
    data.irn = matrix.rows.data();
    data.jcn = matrix.columns.data();
    data.a = matrix.values.data();
    data.size_schur = count;
    data.listvar_schur = last.data();
    data.schur = result.data();
    const AllThreads threads(mumps_.threads());
    mumps_.run(job_analyse_and_factorise);
    mumps_.check("coarsen the slave surface, or solve with ALGO_CONT='GCP'");
    return result;
  }

 private:
  MumpsInstance mumps_{MumpsSymmetry::general};
};

}  // namespace

Eigen::MatrixXd bordered_compliance(const SymmetricMatrix& stiffness,
                                    const Eigen::SparseMatrix<double, Eigen::RowMajor>& rows) {
  const int count = static_cast<int>(rows.rows());
  if (count == 0) return {};
  Bordered matrix(stiffness, rows, equilibration_factors(stiffness));
  Eigen::MatrixXd schur = SchurFactorisation().schur(matrix, static_cast<int>(stiffness.rows()) + count, count);
  schur *= -1.0;
  fill_lower(schur);
  return schur;
}

}  // namespace comma::solver
