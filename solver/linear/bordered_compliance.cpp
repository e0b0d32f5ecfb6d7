// The numbers of controls are those of the "MUMPS 5.5.1 Users' guide", sections 3.18, 5 and 6.
#include "solver/linear/bordered_compliance.hpp"

#include <numeric>
#include <vector>

#include <dmumps_c.h>
#include <fmt/format.h>

#include "solver/error.hpp"
#include "solver/linear/blas_threads.hpp"
#include "solver/linear/dense_solve.hpp"
#include "solver/linear/equilibration.hpp"
#include "solver/linear/mumps_controls.hpp"
#include "solver/linear/shared_library.hpp"

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
    data_.par = 1;
    data_.sym = general_symmetric;
    data_.comm_fortran = whole_communicator;
    run(job_initialise);
    for (int stream = 1; stream <= 3; ++stream) control(stream) = -1;
    control(4) = 0;  // print nothing
    control(6) = 0;  // no permutation and no scaling: the matrix is scaled already
    control(8) = 0;
    control(7) = nested_dissection;
    control(14) = extra_workspace;
    control(19) = centralised_schur;
    control(31) = 1;      // the factors themselves are of no use
    data_.cntl[0] = 0.0;  // positive definite: no search for pivots
  }
  ~SchurFactorisation() { run(job_destroy); }
  SchurFactorisation(const SchurFactorisation&) = delete;
  SchurFactorisation& operator=(const SchurFactorisation&) = delete;

  /// Of the last `count` rows; its upper triangle.
  Eigen::MatrixXd schur(Bordered& matrix, int size, int count) {
    std::vector<int> last(static_cast<std::size_t>(count));
    std::iota(last.begin(), last.end(), size - count + 1);
    Eigen::MatrixXd result(count, count);
    data_.n = size;
    data_.nnz = static_cast<MUMPS_INT8>(matrix.values.size());
    data_.irn = matrix.rows.data();
    data_.jcn = matrix.columns.data();
    data_.a = matrix.values.data();
    data_.size_schur = count;
    data_.listvar_schur = last.data();
    data_.schur = result.data();
    const BlasThreads threads(library_);
    const AllThreads all(threads);
    run(job_analyse_and_factorise);
    check();
    return result;
  }

 private:
  int& control(int number) { return data_.icntl[number - 1]; }

  void run(int job) {
    data_.job = job;
    mumps_(&data_);
  }

  void check() const {
    const int status = data_.infog[0];
    if (status >= 0) return;
    if (status == -9 || status == -13 || status == -19 || status == -8 || status == -51)
      throw Error("out-of-memory", "the compliance of the contact conditions does not fit into memory",
                  "coarsen the slave surface, or solve with ALGO_CONT='GCP'");
    throw Error("linear-solver", fmt::format("MUMPS refuses the bordered matrix (INFOG(1) = {}, INFOG(2) = {})", status,
                                             data_.infog[1]));
  }

  SharedLibrary library_{COMMA_MUMPS_LIBRARY};
  decltype(&dmumps_c) mumps_ = library_.function<decltype(dmumps_c)>("dmumps_c");
  DMUMPS_STRUC_C data_{};
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
