#include "solver/unilateral/status_iteration.hpp"

#include <set>

#include "solver/linear/dense_solve.hpp"

namespace comma::solver {
namespace {

using Eigen::Index;

class StatusIteration {
 public:
  StatusIteration(SchurComplement& schur, const ActiveSetProblem& problem)
      : schur_(schur),
        problem_(problem),
        is_active_(static_cast<std::size_t>(schur.size()), 0),
        multipliers_(Eigen::VectorXd::Zero(schur.size())) {
    for (const int row : problem.guess) is_active_[static_cast<std::size_t>(row)] = 1;
  }

  ActiveSetSolution run() {
    ActiveSetSolution solution;
    solution.verdict = ActiveSetVerdict::too_many_iterations;
    while (++solution.iterations <= problem_.max_iterations) {
      balance();
      if (change()) continue;
      solution.verdict = ActiveSetVerdict::solved;
      break;
    }
    solution.active = active_;
    solution.multipliers = multipliers_.cwiseMax(0.0);
    return solution;
  }

 private:
  /// Multipliers that close the active rows, and by how much the others are violated then.
  void balance() {
    active_.clear();
    for (int row = 0; row < schur_.size(); ++row)
      if (is_active_[static_cast<std::size_t>(row)]) active_.push_back(row);
    schur_.require(active_);
    multipliers_.setZero();
    if (!active_.empty()) {
      const Eigen::VectorXd forces = solve_dense(among_active(), problem_.excess(active_));
      multipliers_(active_) = forces;
    }
    violation_ = problem_.excess - schur_.times(multipliers_);
  }

  Eigen::MatrixXd among_active() const {
    Eigen::MatrixXd block(active_.size(), active_.size());
    for (std::size_t k = 0; k < active_.size(); ++k)
      block.col(static_cast<Index>(k)) = schur_.column(active_[k])(active_);
    return block;
  }

  bool asks_for_change(int row) const {
    return is_active_[static_cast<std::size_t>(row)] ? multipliers_[row] < 0.0
                                                     : violation_[row] > violation_tolerance * problem_.scale[row];
  }

  /// Whether any row changed.
  bool change() {
    bool changed = false;
    for (int row = 0; row < schur_.size() && !(changed && one_at_a_time_); ++row) {
      if (!asks_for_change(row)) continue;
      is_active_[static_cast<std::size_t>(row)] ^= 1;
      changed = true;
    }
    if (changed && !visited_.insert(is_active_).second) one_at_a_time_ = true;
    return changed;
  }

  SchurComplement& schur_;
  const ActiveSetProblem& problem_;
  std::vector<char> is_active_;
  std::vector<int> active_;
  Eigen::VectorXd multipliers_;
  Eigen::VectorXd violation_;
  std::set<std::vector<char>> visited_;
  bool one_at_a_time_ = false;
};

}  // namespace

ActiveSetSolution solve_by_statuses(SchurComplement& schur, const ActiveSetProblem& problem) {
  return StatusIteration(schur, problem).run();
}

}  // namespace comma::solver
