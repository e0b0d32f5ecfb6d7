#include "solver/unilateral/active_set.hpp"
#include "solver/linear/largest_component.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <set>

namespace comma::solver {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
/// A row that overlaps moves in when it does so by more than this share: what moves less is where it was.
constexpr double still = 1e-6;
/// Rounds of the packet phase: it either settles in a few or circles.
constexpr int packet_rounds = 12;
/// From so many rows on the factor gains by blocks: below, they are not worth the copies.
constexpr std::size_t block_rows = 16;

class ActiveSetSolver {
 public:
  ActiveSetSolver(SchurComplement& schur, const ActiveSetProblem& problem, ActiveSetMemory& memory)
      : schur_(schur),
        problem_(problem),
        memory_(memory),
        is_active_(problem.excess.size(), 0),
        redundant_(problem.excess.size(), 0),
        violation_(problem.excess),
        active_(memory.active),
        factor_(memory.factor) {
    if (memory.version == schur.version()) {
      for (const int row : active_) is_active_[row] = 1;
    } else {
      active_.clear();
      factor_.clear();
    }
  }

  ActiveSetSolution run() {
    start_from_guess();
    if (!settle_in_packets()) {
      make_dual_feasible();
      settle_one_by_one();
    }
    if (may_pass_over()) go_from_beginning();
    return finish();
  }

 private:
  double tolerance(int row) const { return violation_tolerance * problem_.scale[row]; }

  Eigen::VectorXd coupling(int row) const {
    const SchurComplement::Column column = schur_.column(row);
    Eigen::VectorXd values(static_cast<Eigen::Index>(active_.size()));
    for (std::size_t i = 0; i < active_.size(); ++i) values[static_cast<Eigen::Index>(i)] = column[active_[i]];
    return values;
  }

  bool enter(int row) {
    if (!factor_.append(coupling(row), schur_.column(row)[row])) return false;
    active_.push_back(row);
    is_active_[row] = 1;
    return true;
  }

  /// Those that depend on no other enter. Whether any did.
  bool enter_all(const std::vector<int>& rows) {
    if (rows.size() >= block_rows && enter_block(rows)) return true;
    bool entered = false;
    for (const int row : rows)
      if (!is_active_[row]) entered |= enter(row);
    return entered;
  }

  bool enter_block(const std::vector<int>& rows) {
    const auto count = static_cast<Eigen::Index>(rows.size());
    Eigen::MatrixXd couplings(count, static_cast<Eigen::Index>(active_.size()));
    Eigen::MatrixXd block(count, count);
    for (Eigen::Index i = 0; i < count; ++i) {
      const SchurComplement::Column column = schur_.column(rows[i]);
      for (std::size_t j = 0; j < active_.size(); ++j) couplings(i, static_cast<Eigen::Index>(j)) = column[active_[j]];
      for (Eigen::Index j = i; j < count; ++j) block(j, i) = column[rows[j]];
    }
    if (!factor_.append_all(couplings, block)) return false;
    for (const int row : rows) is_active_[row] = 1;
    active_.insert(active_.end(), rows.begin(), rows.end());
    return true;
  }

  /// Many at once: the factor begins anew.
  void keep_only(const std::vector<int>& rows) {
    for (const int row : active_) is_active_[row] = 0;
    active_.clear();
    factor_.clear();
    enter_all(rows);
  }

  void leave(int position) {
    is_active_[active_[position]] = 0;
    active_.erase(active_.begin() + position);
    factor_.remove(position);
  }

  /// Multipliers that close the active rows exactly.
  void solve_equalities() {
    Eigen::VectorXd rhs(static_cast<Eigen::Index>(active_.size()));
    for (std::size_t i = 0; i < active_.size(); ++i) rhs[static_cast<Eigen::Index>(i)] = problem_.excess[active_[i]];
    multipliers_ = factor_.solve(rhs);
    update_violation();
    // One step of refinement: the couplings of a soft body can be many times larger than what remains of them.
    for (std::size_t i = 0; i < active_.size(); ++i) rhs[static_cast<Eigen::Index>(i)] = violation_[active_[i]];
    multipliers_ += factor_.solve(rhs);
    update_violation();
  }

  void update_violation() {
    violation_ = problem_.excess;
    for (std::size_t i = 0; i < active_.size(); ++i)
      violation_ -= multipliers_[static_cast<Eigen::Index>(i)] * schur_.column(active_[i]);
  }

  std::vector<int> violated_rows() const {
    std::vector<int> rows;
    for (int row = 0; row < schur_.size(); ++row)
      if (!is_active_[row] && !redundant_[row] && violation_[row] > tolerance(row)) rows.push_back(row);
    return rows;
  }

  /// What is remembered and guessed stays, what is guessed besides enters.
  void start_from_guess() {
    schur_.require(problem_.guess);
    const std::set<int> guess(problem_.guess.begin(), problem_.guess.end());
    std::vector<int> kept, added;
    for (const int row : active_)
      if (guess.contains(row)) kept.push_back(row);
    if (kept.size() + block_rows < active_.size()) {
      keep_only(kept);
    } else {
      for (int i = static_cast<int>(active_.size()) - 1; i >= 0; --i)
        if (!guess.contains(active_[i])) leave(i);
    }
    for (const int row : guess)
      if (!is_active_[row]) added.push_back(row);
    enter_all(added);
    solve_equalities();
  }

  bool drop_pulling_rows() {
    std::vector<int> pulling, pushing;
    for (int i = 0; i < static_cast<int>(active_.size()); ++i) {
      if (multipliers_[i] < 0.0)
        pulling.push_back(i);
      else
        pushing.push_back(active_[i]);
    }
    if (pulling.empty()) return false;
    if (pulling.size() >= block_rows) {
      keep_only(pushing);
    } else {
      for (auto position = pulling.rbegin(); position != pulling.rend(); ++position) leave(*position);
    }
    solve_equalities();
    return true;
  }

  bool settle_in_packets() {
    for (int round = 0; round < packet_rounds; ++round) {
      const bool dropped = drop_pulling_rows();
      const std::vector<int> violated = violated_rows();
      if (!dropped && violated.empty()) return true;
      ++iterations_;
      schur_.require(violated);
      const bool entered = enter_all(violated);
      if (entered) solve_equalities();
      if (!entered && !violated.empty()) return false;
    }
    return false;
  }

  /// Ends because each round shortens the active set.
  void make_dual_feasible() {
    while (drop_pulling_rows()) ++iterations_;
  }

  int most_violated() const {
    int worst = -1;
    double largest = violation_tolerance;
    for (int row = 0; row < schur_.size(); ++row) {
      if (is_active_[row] || redundant_[row]) continue;
      const double relative = violation_[row] / problem_.scale[row];
      if (relative > largest) {
        largest = relative;
        worst = row;
      }
    }
    return worst;
  }

  void settle_one_by_one() {
    for (int row = most_violated(); row >= 0; row = most_violated()) {
      schur_.require(std::span<const int>(&row, 1));
      if (!bring_in(row)) return;
    }
  }

  /// Raises the multiplier of a violated row, dropping the active rows that begin to pull, until its violation is gone.
  bool bring_in(int row) {
    const double own = schur_.column(row)[row];
    double multiplier = 0.0;
    while (true) {
      if (++iterations_ > problem_.max_iterations) {
        verdict_ = ActiveSetVerdict::too_many_iterations;
        return false;
      }
      const Eigen::VectorXd coupled = coupling(row);
      const Eigen::VectorXd direction = factor_.solve(coupled);
      const bool dependent = factor_.depends(coupled, own);
      const double full_step = dependent ? infinite : violation_[row] / factor_.remaining_pivot(coupled, own);
      const auto [partial_step, leaving] = longest_step(direction);
      if (dependent && leaving < 0) return leave_out(row);
      const double step = std::max(0.0, std::min(full_step, partial_step));
      multipliers_ -= step * direction;
      multiplier += step;
      if (full_step <= partial_step) {
        enter(row);
        solve_equalities();
        clear_rounding();
        return true;
      }
      remove_multiplier(leaving);
      update_violation();
      violation_ -= multiplier * schur_.column(row);
    }
  }

  /// How far the multipliers can follow before one of them vanishes, and which.
  std::pair<double, int> longest_step(const Eigen::VectorXd& direction) const {
    double step = infinite;
    int leaving = -1;
    const double threshold = dependence_tolerance * largest_component(direction);
    for (Eigen::Index i = 0; i < direction.size(); ++i) {
      if (direction[i] <= threshold) continue;
      const double ratio = std::max(0.0, multipliers_[i]) / direction[i];
      if (ratio < step) {
        step = ratio;
        leaving = static_cast<int>(i);
      }
    }
    return {step, leaving};
  }

  void remove_multiplier(int position) {
    const Eigen::Index rest = multipliers_.size() - position - 1;
    multipliers_.segment(position, rest) = multipliers_.tail(rest).eval();
    multipliers_.conservativeResize(multipliers_.size() - 1);
    leave(position);
  }

  /// A row that depends on active ones of which none can leave: either it repeats them, or it contradicts them.
  bool leave_out(int row) {
    if (violation_[row] <= contradiction_tolerance * problem_.scale[row]) {
      redundant_[row] = 1;
      solve_equalities();
      clear_rounding();
      return true;
    }
    verdict_ = ActiveSetVerdict::contradictory;
    contradiction_.push_back(row);
    const Eigen::VectorXd direction = factor_.solve(coupling(row));
    for (std::size_t i = 0; i < active_.size(); ++i)
      if (std::abs(direction[static_cast<Eigen::Index>(i)]) > contradiction_tolerance)
        contradiction_.push_back(active_[i]);
    return false;
  }

  /// The exact equalities may leave a multiplier at minus a rounding: it counts as zero.
  void clear_rounding() { multipliers_ = multipliers_.cwiseMax(0.0); }

  /// Whether any of the active rows is one that a walk from the beginning may miss: without these both ways end alike,
  /// since the solution is that of the other rows alone.
  bool may_pass_over() const {
    return verdict_ == ActiveSetVerdict::solved && problem_.beginning.size() > 0 &&
           std::ranges::any_of(active_, [&](int row) {
             return problem_.excess[row] <= tolerance(row) && problem_.beginning[row] > tolerance(row);
           });
  }

  /// The rows that the free solution violates are active at first. The displacements go from the beginning to where the
  /// active rows are closed, as far as the next row on the way, which becomes active; where they arrive the row that
  /// pulls most leaves. What moves away from its bound is on no way.
  void go_from_beginning() {
    const std::vector<int> exact = active_;
    std::vector<int> first;
    for (int row = 0; row < schur_.size(); ++row)
      if (problem_.excess[row] > tolerance(row)) first.push_back(row);
    schur_.require(first);
    keep_only(first);
    solve_equalities();
    std::fill(redundant_.begin(), redundant_.end(), 0);
    Eigen::VectorXd now = problem_.beginning;
    for (const int last = iterations_ + problem_.max_iterations; iterations_ < last; ++iterations_) {
      const auto [share, row] = next_on_the_way(now);
      if (row >= 0) {
        now += share * (violation_ - now);
        schur_.require(std::span<const int>(&row, 1));
        redundant_[row] = enter(row) ? 0 : 1;
      } else {
        now = violation_;
        Eigen::Index most = 0;
        if (multipliers_.size() == 0 || multipliers_.minCoeff(&most) >= 0.0) return;
        leave(static_cast<int>(most));
      }
      solve_equalities();
    }
    keep_only(exact);
    solve_equalities();
    clear_rounding();
  }

  /// How far displacements can go, as a share of the whole way, and the row that stops them; -1: none does.
  std::pair<double, int> next_on_the_way(const Eigen::VectorXd& now) const {
    double share = 1.0;
    int next = -1;
    for (int row = 0; row < schur_.size(); ++row) {
      const double nearer = violation_[row] - now[row];
      if (is_active_[row] || redundant_[row] || violation_[row] <= tolerance(row) ||
          nearer <= tolerance(row) + still * std::max(0.0, now[row]))
        continue;
      const double reached = std::max(0.0, -now[row] / nearer);
      if (reached >= share) continue;
      share = reached;
      next = row;
    }
    return {share, next};
  }

  ActiveSetSolution finish() {
    ActiveSetSolution solution;
    solution.verdict = verdict_;
    solution.iterations = iterations_;
    solution.contradiction = std::move(contradiction_);
    solution.multipliers = Eigen::VectorXd::Zero(problem_.excess.size());
    for (std::size_t i = 0; i < active_.size(); ++i)
      solution.multipliers[active_[i]] = std::max(0.0, multipliers_[static_cast<Eigen::Index>(i)]);
    solution.active = active_;
    std::sort(solution.active.begin(), solution.active.end());
    memory_.version = schur_.version();
    return solution;
  }

  SchurComplement& schur_;
  const ActiveSetProblem& problem_;
  ActiveSetMemory& memory_;
  std::vector<char> is_active_;
  std::vector<char> redundant_;
  Eigen::VectorXd violation_;
  std::vector<int>& active_;
  ActiveCholesky& factor_;
  Eigen::VectorXd multipliers_;
  ActiveSetVerdict verdict_ = ActiveSetVerdict::solved;
  int iterations_ = 0;
  std::vector<int> contradiction_;
};

}  // namespace

std::vector<int> positive_rows(const Eigen::VectorXd& multipliers) {
  std::vector<int> rows;
  for (Eigen::Index i = 0; i < multipliers.size(); ++i)
    if (multipliers[i] > 0.0) rows.push_back(static_cast<int>(i));
  return rows;
}

ActiveSetSolution solve_active_set(SchurComplement& schur, const ActiveSetProblem& problem) {
  ActiveSetMemory memory;
  return solve_active_set(schur, problem, memory);
}

ActiveSetSolution solve_active_set(SchurComplement& schur, const ActiveSetProblem& problem, ActiveSetMemory& memory) {
  assert(problem.excess.size() == schur.size() && problem.scale.size() == schur.size());
  return ActiveSetSolver(schur, problem, memory).run();
}

}  // namespace comma::solver
