// Solutions of earlier loads, for loads that are multiples of them.
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Dense>

namespace comma::solver {

/// With one factor and loads that grow in proportion, increments of the load and of contact forces are multiples of
/// those of an earlier step, but for rounding: so are the solutions. Keeps the last few; what belongs to another matrix
/// has to be forgotten.
class KnownSolutions {
 public:
  /// Overwrites the load (n) by its solution, if it is a multiple of a known one. The multiple of the solution then
  /// leaves of each equation less than `backward_error` of its row of |K| (`row_sizes`, n: sums of |K_ij|) times the
  /// largest unknown, which is what the rounding of a direct solution leaves, or less than `rounding` (n, a force
  /// each), where that is more: of what the solution is added to. Empty: 0.
  bool take(Eigen::Ref<Eigen::VectorXd> load, const Eigen::VectorXd& row_sizes, const Eigen::VectorXd& rounding = {});
  /// K^-1 load.
  void add(Eigen::VectorXd load, Eigen::VectorXd solution);
  void forget() { known_.clear(); }

  static constexpr double backward_error = 1e-14;

 private:
  /// The increment of the load and that of contact forces come by turns, and change in the first steps before statuses
  /// settle.
  static constexpr std::size_t most = 4;

  struct Pair {
    Eigen::VectorXd load, solution;
  };
  std::vector<Pair> known_;  ///< the last used at the end
};

}  // namespace comma::solver
