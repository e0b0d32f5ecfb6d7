#include "solver/linear/mumps_instance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "solver/error.hpp"

namespace comma::solver {

namespace {

constexpr int job_initialise = -1;
constexpr int job_destroy = -2;
constexpr int job_analyse = 1;
constexpr int job_factorise = 2;
constexpr int job_solve = 3;
constexpr int whole_communicator = -987654;

constexpr int error_integer_workspace = -8;
constexpr int error_workspace = -9;
constexpr int error_memory = -13;
constexpr int error_memory_left = -19;
constexpr int error_index_overflow = -51;

constexpr int first_extra_workspace = 30;   // per cent
constexpr int most_extra_workspace = 2000;  // a matrix that needs more delays nearly all its pivots

}  // namespace

MumpsInstance::MumpsInstance(MumpsSymmetry symmetry) {
  data_.par = 1;
  data_.sym = static_cast<int>(symmetry);
  data_.comm_fortran = whole_communicator;
  run(job_initialise);
  for (int stream = 1; stream <= 3; ++stream) control(stream) = -1;
  control(4) = 0;  // print nothing
  control(6) = 0;  // the matrix is scaled already, and the analysis must hold for other values of the same pattern
  control(8) = 0;
  threads_.use(1);
}

MumpsInstance::~MumpsInstance() { run(job_destroy); }

void MumpsInstance::analyse(const Eigen::SparseMatrix<double>& matrix) {
  rows_.clear();
  columns_.clear();
  for (int column = 0; column < matrix.outerSize(); ++column) {
    for (Eigen::SparseMatrix<double>::InnerIterator entry(matrix, column); entry; ++entry) {
      rows_.push_back(static_cast<int>(entry.row()) + 1);
      columns_.push_back(column + 1);
    }
  }
  data_.n = static_cast<int>(matrix.rows());
  data_.nnz = matrix.nonZeros();
  data_.irn = rows_.data();
  data_.jcn = columns_.data();
  data_.a = nullptr;
  control(10) = 0;  // refinement is the caller's
  control(12) = 1;
  control(13) = 1;  // the last front too counts its null pivots
  control(14) = first_extra_workspace;
  control(24) = 1;  // note null pivots and go on
  run(job_analyse);
  check();
}

void MumpsInstance::note_null_pivots(const Eigen::VectorXd& references, int digits) {
  const double least = std::numeric_limits<double>::min();
  const double threshold = digits < 0 ? least : std::max(least, references.minCoeff() * std::pow(10.0, -digits - 1));
  data_.cntl[2] = -threshold;
}

void MumpsInstance::factorise(const Eigen::SparseMatrix<double>& matrix) {
  values_.assign(matrix.valuePtr(), matrix.valuePtr() + matrix.nonZeros());
  data_.a = values_.data();
  const AllThreads threads(threads_, data_.rinfog[0] > many_operations);
  run(job_factorise);
  while (data_.infog[0] == error_workspace && control(14) < most_extra_workspace) {
    control(14) *= 2;
    run(job_factorise);
  }
  check();
}

void MumpsInstance::solve(Eigen::Ref<Eigen::MatrixXd> rhs) const {
  data_.rhs = rhs.data();
  data_.nrhs = static_cast<int>(rhs.cols());
  data_.lrhs = static_cast<int>(rhs.outerStride());
  run(job_solve);
  check();
}

std::vector<int> MumpsInstance::null_rows() const {
  std::vector<int> rows(data_.pivnul_list, data_.pivnul_list + data_.infog[27]);
  for (int& row : rows) --row;
  std::ranges::sort(rows);
  return rows;
}

void MumpsInstance::run(int job) const {
  data_.job = job;
  mumps_(&data_);
}

void MumpsInstance::check(const char* hint) const {
  const int status = data_.infog[0];
  if (status >= 0) return;
  if (status == error_workspace || status == error_memory || status == error_index_overflow ||
      status == error_integer_workspace || status == error_memory_left)
    throw Error("out-of-memory", "the factors of the matrix do not fit into memory", hint);
  throw Error("linear-solver",
              fmt::format("MUMPS refuses the matrix (INFOG(1) = {}, INFOG(2) = {})", status, data_.infog[1]));
}

}  // namespace comma::solver
