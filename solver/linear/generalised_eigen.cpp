#include "solver/linear/generalised_eigen.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <Spectra/GenEigsSolver.h>
#include <fmt/format.h>
#include <Eigen/Eigenvalues>

#include "solver/error.hpp"
#include "solver/linear/largest_component.hpp"

namespace comma::solver {

namespace {

/// Up to here all eigenvalues of the dense matrix cost less than a tenth of a second.
constexpr int dense_size = 120;
/// An imaginary part below this share of the value is rounding: pairs of equal eigenvalues part by the square root of
/// it.
constexpr double real_share = 1e-6;
constexpr double tolerance = 1e-10;
/// A shift that meets an eigenvalue moves on by this share of the interval.
constexpr double shift_step = 0.0137;

LinearOptions untested() {
  LinearOptions options;
  options.singular_digits = -1;
  return options;
}

/// (A - shift B)^-1 B.
class ShiftedInverse {
 public:
  using Scalar = double;

  ShiftedInverse(const Pencil& pencil, double shift) : b_(pencil.b), unsymmetric_(untested()) {
    const SymmetricMatrix shifted = shift == 0.0 ? pencil.a : SymmetricMatrix(pencil.a - shift * pencil.b);
    FactorReport report;
    if (pencil.skew) {
      report = unsymmetric_.factorise(shifted, *pencil.skew);
    } else {
      symmetric_ = make_linear_solver(LinearMethod::mumps, untested());
      symmetric_->analyse(shifted);
      report = symmetric_->factorise(shifted);
    }
    is_singular_ = report.verdict == FactorVerdict::singular;
  }

  bool is_singular() const { return is_singular_; }
  Eigen::Index rows() const { return b_.rows(); }
  Eigen::Index cols() const { return b_.cols(); }

  void apply(Eigen::MatrixXd& columns) const {
    columns = (b_.selfadjointView<Eigen::Lower>() * columns).eval();
    if (symmetric_)
      symmetric_->solve(columns);
    else
      unsymmetric_.solve(columns);
  }
  void perform_op(const double* in, double* out) const {
    Eigen::MatrixXd column = Eigen::Map<const Eigen::VectorXd>(in, rows());
    apply(column);
    Eigen::Map<Eigen::VectorXd>(out, rows()) = column.col(0);
  }

 private:
  const SymmetricMatrix& b_;
  std::unique_ptr<LinearSolver> symmetric_;
  UnsymmetricSolver unsymmetric_;
  bool is_singular_ = false;
};

struct ComplexPairs {
  Eigen::VectorXcd values;
  Eigen::MatrixXcd vectors;
};

ComplexPairs all_pairs(const ShiftedInverse& inverse) {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Identity(inverse.rows(), inverse.rows());
  inverse.apply(matrix);
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(matrix);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

/// Those of the largest magnitude.
ComplexPairs largest_pairs(ShiftedInverse& inverse, int count) {
  constexpr int most_restarts = 1000, least_space = 20;
  const int n = static_cast<int>(inverse.rows());
  Spectra::GenEigsSolver<ShiftedInverse> solver(inverse, count, std::min(n, std::max(2 * count + 4, least_space)));
  solver.init();
  solver.compute(Spectra::SortRule::LargestMagn, most_restarts, tolerance);
  if (solver.info() != Spectra::CompInfo::Successful)
    throw Error("no-convergence",
                fmt::format("the {} eigenvalues nearest to the one sought were not found in {} restarts", count,
                            most_restarts));
  return {solver.eigenvalues(), solver.eigenvectors()};
}

/// From those of the inverse.
EigenPairs real_pairs(const ComplexPairs& found, double shift) {
  std::vector<std::pair<double, Eigen::VectorXd>> pairs;
  const double largest = largest_component(found.values);
  for (Eigen::Index k = 0; k < found.values.size(); ++k) {
    const double value = found.values[k].real();
    // What B does not see has an infinite eigenvalue.
    if (std::abs(value) <= tolerance * largest || std::abs(found.values[k].imag()) > real_share * std::abs(value))
      continue;
    Eigen::VectorXd vector = found.vectors.col(k).real();
    Eigen::Index peak = 0;
    vector.cwiseAbs().maxCoeff(&peak);
    pairs.emplace_back(shift + 1.0 / value, vector / vector[peak]);
  }
  std::ranges::sort(pairs, {}, [](const auto& pair) { return pair.first; });
  EigenPairs result;
  result.vectors.resize(found.vectors.rows(), static_cast<Eigen::Index>(pairs.size()));
  for (const auto& [value, vector] : pairs) {
    result.vectors.col(static_cast<Eigen::Index>(result.values.size())) = vector;
    result.values.push_back(value);
  }
  return result;
}

template <class Keep>
EigenPairs filtered(const EigenPairs& pairs, Keep&& keep) {
  EigenPairs result;
  std::vector<int> kept;
  for (std::size_t k = 0; k < pairs.values.size(); ++k) {
    if (!keep(pairs.values[k])) continue;
    kept.push_back(static_cast<int>(k));
    result.values.push_back(pairs.values[k]);
  }
  result.vectors = pairs.vectors(Eigen::all, kept);
  return result;
}

bool is_small(const ShiftedInverse& inverse) { return inverse.rows() <= dense_size; }

EigenPairs of_smallest(const EigenPairs& pairs, int count) {
  if (static_cast<int>(pairs.values.size()) <= count) return pairs;
  std::vector<double> sizes(pairs.values.size());
  std::ranges::transform(pairs.values, sizes.begin(), [](double value) { return std::abs(value); });
  std::ranges::nth_element(sizes, sizes.begin() + count - 1);
  int left = count;
  return filtered(
      pairs, [&](double value) { return std::abs(value) <= sizes[static_cast<std::size_t>(count - 1)] && left-- > 0; });
}

}  // namespace

EigenPairs smallest_eigenvalues(const Pencil& pencil, int count) {
  if (pencil.a.rows() == 0 || count <= 0 || pencil.b.norm() == 0.0) return {};
  ShiftedInverse inverse(pencil, 0.0);
  if (inverse.is_singular()) throw Error("singular-matrix", "the stiffness whose eigenvalues are sought is singular");
  const bool nearly_all = count > inverse.rows() - 4;  // iterations find two fewer than there are
  if (is_small(inverse) || nearly_all) return of_smallest(real_pairs(all_pairs(inverse), 0.0), count);
  // Complex pairs may be among them, and make room for as many more.
  return of_smallest(real_pairs(largest_pairs(inverse, count + 2), 0.0), count);
}

EigenPairs eigenvalues_between(const Pencil& pencil, double first, double last) {
  constexpr int first_count = 8, most_shifts = 5;
  if (pencil.a.rows() == 0 || pencil.b.norm() == 0.0) return {};
  const auto is_inside = [&](double value) { return value >= first && value <= last; };
  for (int attempt = 0; attempt < most_shifts; ++attempt) {
    const double shift = 0.5 * (first + last) + attempt * shift_step * (last - first);
    ShiftedInverse inverse(pencil, shift);
    if (inverse.is_singular()) continue;
    if (is_small(inverse)) return filtered(real_pairs(all_pairs(inverse), shift), is_inside);
    const double reach = std::max(last - shift, shift - first);
    const int most = static_cast<int>(inverse.rows()) - 2;
    for (int count = first_count;; count = std::min(2 * count, most)) {
      const ComplexPairs found = largest_pairs(inverse, count);
      const bool covers = found.values.cwiseAbs().minCoeff() * reach < 1.0;
      if (covers || count == most) return filtered(real_pairs(found, shift), is_inside);
    }
  }
  throw Error(
      "singular-matrix",
      fmt::format(
          "the matrices of the eigenvalue problem are singular together all over the interval from {:g} to {:g}", first,
          last));
}

}  // namespace comma::solver
