#include "solver/contact_law/shared_friction.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "solver/mesh/disjoint_sets.hpp"

namespace comma::solver {
namespace {

using Eigen::Index;

constexpr int most_turns = 20;
/// After so many failures in a row a search is left out no longer than before: 64 times.
constexpr int most_failures = 6;
/// Shares of pressure that change by less are near enough to those of the solution for Newton's method.
constexpr double near_share = 1e-2;
/// The largest pressures count as the same within this share of itself.
constexpr double same_pressure = 1e-6;

/// Pressures below this share of the largest are rounding.
constexpr double no_pressure = 1e-12;

/// Whether a solution is looked for near the one before alone, or anew where there is none.
enum class Turn : std::uint8_t { near, anew };
enum class Shears : std::uint8_t { none, as_they_are, by_shares };

/// The largest pressure of each surface: of the nodes that points tie together, one after the other, so that what
/// happens elsewhere does not count.
class SurfacePressures {
 public:
  explicit SurfacePressures(const CondensedProblem& problem)
      : components_(problem.components), values_(static_cast<std::size_t>(problem.node_count), 0.0) {
    DisjointSets surfaces(problem.node_count);
    for (const CondensedPoint& point : problem.points)
      for (int i = 1; i < point.node_count; ++i)
        surfaces.join(point.nodes.front(), point.nodes[static_cast<std::size_t>(i)]);
    for (int node = 0; node < problem.node_count; ++node) surface_.push_back(surfaces.root(node));
  }

  void measure(const CondensedState& state) {
    std::ranges::fill(values_, 0.0);
    largest_ = 0.0;
    for (std::size_t node = 0; node < surface_.size(); ++node) {
      const double pressure = state.multipliers[static_cast<Index>(node) * components_];
      double& of_surface = values_[static_cast<std::size_t>(surface_[node])];
      of_surface = std::max(of_surface, pressure);
      largest_ = std::max(largest_, pressure);
    }
  }

  bool press() const { return largest_ > 0.0; }

  /// Of the surface of the node, of all where nothing presses on that; 1 where nothing presses at all.
  double at(int node) const {
    const double of_surface = values_[static_cast<std::size_t>(surface_[static_cast<std::size_t>(node)])];
    return of_surface > 0.0 ? of_surface : press() ? largest_ : 1.0;
  }

  bool is_near(const SurfacePressures& other, double share) const {
    for (std::size_t i = 0; i < values_.size(); ++i)
      if (std::abs(values_[i] - other.values_[i]) > share * other.values_[i]) return false;
    return true;
  }

 private:
  int components_;
  std::vector<int> surface_;    ///< of each node: the node that stands for its surface
  std::vector<double> values_;  ///< at the nodes that stand for surfaces
  double largest_ = 0.0;
};

std::vector<char> nodes_with_shares(const CondensedProblem& problem) {
  std::vector<char> result(static_cast<std::size_t>(problem.node_count), 0);
  for (const CondensedPoint& point : problem.points)
    for (int i = 0; i < point.node_count && point.share_augmentation > 0.0; ++i)
      result[static_cast<std::size_t>(point.nodes[static_cast<std::size_t>(i)])] = 1;
  return result;
}

class SharedFriction {
 public:
  SharedFriction(const CondensedProblem& problem, const CondensedMethods& methods)
      : given_(problem),
        problem_(problem),
        methods_(methods),
        shared_(nodes_with_shares(problem)),
        pressures_(problem),
        search_(problem.share_search ? *problem.share_search : own_search_) {
    problem_.expected.resize(0);  // shears, not shares
  }

  CondensedSolution run(CondensedState& state) {
    const CondensedState start = state;
    CondensedSolution solution;
    if (find_shares(start, state, solution)) {
      take_own_pressure(state, solution);
      return counted(start, state, solution);
    }
    if (lets_creep()) solution.verdict = CondensedVerdict::too_many_iterations;
    solution.by_shears = solution.verdict == CondensedVerdict::solved;
    if (solution.verdict != CondensedVerdict::solved && far_) {
      state = far_->first;
      solution = far_->second;
    }
    return counted(start, state, solution);
  }

 private:
  /// Whether there is a solution by shares; otherwise what stands in for it.
  bool find_shares(const CondensedState& start, CondensedState& state, CondensedSolution& solution) {
    if (solve_as_expected(state, solution)) return true;
    pressures_.measure(state);
    if (pressures_.press() && solve_at_once(state, solution)) return true;
    bool searched = search_.found_last;
    if (searched && search_shares(start, state, solution)) return true;
    if (pressures_.press() && solve_in_turns(state, solution, Turn::near)) return true;
    if (pressures_.press() && lets_creep()) {
      if (!searched && search_shares(start, state, solution)) return true;
      searched = true;
      if (solve_in_turns(state, solution, Turn::anew)) return true;
    }
    find_pressure(state);
    take(Shears::as_they_are);
    solution = solve_once(state, methods_.refine);
    if (solution.verdict == CondensedVerdict::solved && shares_follow(state, solution)) return true;
    if (!searched && search_shares(start, state, solution)) return true;
    if (solution.verdict == CondensedVerdict::solved) return false;
    state = start;
    solution = solve_by_shears(state);
    return solution.verdict == CondensedVerdict::solved && shares_follow(state, solution);
  }

  /// Where points of a node are open and others closed, the law there depends on the pressure of shares: it is to be
  /// the largest of the solution on its surface, whatever that was found from.
  void take_own_pressure(CondensedState& state, CondensedSolution& solution) {
    for (int turn = 0; turn < most_turns && is_partly_open(state); ++turn) {
      const SurfacePressures before = pressures_;
      pressures_.measure(state);
      if (!pressures_.press() || before.is_near(pressures_, same_pressure)) return;
      CondensedSolution next;
      if (!solve_at_once(state, next)) return;
      solution = next;
    }
  }

  bool is_partly_open(const CondensedState& state) const {
    std::vector<char> open(shared_.size(), 0), closed = open;
    for (std::size_t p = 0; p < given_.points.size(); ++p) {
      const CondensedPoint& point = given_.points[p];
      std::vector<char>& touched = state.statuses[p] == ContactStatus::open ? open : closed;
      for (int i = 0; i < point.node_count && point.share_augmentation > 0.0; ++i)
        touched[static_cast<std::size_t>(point.nodes[static_cast<std::size_t>(i)])] = 1;
    }
    for (std::size_t node = 0; node < open.size(); ++node)
      if (open[node] && closed[node]) return true;
    return false;
  }

  bool lets_creep() const {
    return std::ranges::any_of(given_.points, [](const CondensedPoint& point) {
      return point.share_augmentation > 0.0 && point.law.friction_penalised;
    });
  }

  void take(Shears shears) {
    for (std::size_t p = 0; p < problem_.points.size(); ++p) {
      CondensedPoint& point = problem_.points[p];
      if (!(point.share_augmentation > 0.0)) continue;
      point.law = given_.points[p].law;
      if (shears == Shears::none) point.law.friction = 0.0;
      const double pressure = pressures_.at(point.nodes.front());
      point.law.friction_augmentation =
          point.share_augmentation * (point.law.friction > 0.0 ? point.law.friction : 1.0) * pressure;
      point.law.share_pressure = shears == Shears::by_shares ? pressure : 0.0;
    }
  }

  CondensedSolution solve_once(CondensedState& state) { return solve_once(state, methods_.solve); }
  CondensedSolution solve_once(CondensedState& state, const CondensedMethods::Method& method) {
    return near(method(problem_, state), state);
  }
  /// What was solved far away is kept, and no solution yet.
  CondensedSolution near(CondensedSolution solution, const CondensedState& state) {
    iterations_ += solution.iterations;
    if (!solution.is_far) return solution;
    if (!far_) far_.emplace(state, solution);
    solution.verdict = CondensedVerdict::too_many_iterations;
    return solution;
  }

  /// That of the solution without friction, unless there is one already.
  void find_pressure(const CondensedState& start) {
    if (pressures_.press()) return;
    CondensedState state = start;
    take(Shears::none);
    solve_once(state);
    pressures_.measure(state);
  }

  /// Whether shares of the limit follow from a solution by shears, which stays otherwise.
  bool shares_follow(CondensedState& state, CondensedSolution& solution) {
    pressures_.measure(state);
    if (!pressures_.press()) return true;
    CondensedSolution shared;
    if (!solve_by_shares(state, shared)) return false;
    solution = shared;
    return true;
  }

  /// solve_smooth_shares() unless it has failed too often of late.
  bool search_shares(const CondensedState& start, CondensedState& state, CondensedSolution& solution) {
    search_.found_last = false;
    if (search_.left_out > 0) {
      --search_.left_out;
      return false;
    }
    search_.found_last = solve_smooth_shares(start, state, solution);
    search_.failures = search_.found_last ? 0 : std::min(search_.failures + 1, most_failures);
    search_.left_out = search_.found_last ? 0 : 1 << search_.failures;
    return search_.found_last;
  }

  /// By shares at once, without a solution to begin from.
  bool solve_smooth_shares(const CondensedState& start, CondensedState& state, CondensedSolution& solution) {
    if (!pressures_.press()) return false;
    take(Shears::by_shares);
    CondensedState shared_state = start;
    const CondensedSolution shared = solve_once(shared_state, methods_.smooth);
    if (shared.verdict != CondensedVerdict::solved) return false;
    state = in_shears(shared_state);
    solution = shared;
    return true;
  }

  /// With shears that are augmented as the bodies ask for, with the augmentation of shares, and with that of pressures,
  /// which a penalty has large.
  CondensedSolution solve_by_shears(CondensedState& state) {
    const CondensedState start = state;
    take(Shears::as_they_are);
    CondensedSolution solution = solve_once(state, methods_.stand_in);
    if (solution.verdict == CondensedVerdict::solved) return solution;
    if (!lets_creep()) {
      state = start;
      solution = near(methods_.solve(given_, state), state);
      if (solution.verdict == CondensedVerdict::solved) return solution;
    }
    state = start;
    return solve_once(state);
  }

  /// From the multipliers that earlier steps let expect, where there are any.
  bool solve_as_expected(CondensedState& state, CondensedSolution& solution) {
    if (given_.expected.size() != state.multipliers.size()) return false;
    CondensedState expected{given_.expected, state.statuses};
    pressures_.measure(expected);
    if (!pressures_.press() || !solve_at_once(expected, solution)) return false;
    state = expected;
    return true;
  }

  /// Shares of the limit that the pressures of the solution weigh: at once from the pressures at hand, or in turns.
  /// Whether that leads anywhere; if not, the state stays.
  bool solve_by_shares(CondensedState& state, CondensedSolution& solution) {
    return solve_at_once(state, solution) || solve_in_turns(state, solution, Turn::near);
  }

  bool solve_at_once(CondensedState& state, CondensedSolution& solution) {
    CondensedState tried = in_shares(state);
    solution = solve_once(tried, methods_.attempt);
    if (solution.verdict != CondensedVerdict::solved) return false;
    state = in_shears(tried);
    return true;
  }

  /// Pressures that weigh shares follow those of the solution, in turns; the last of them by Newton's method.
  bool solve_in_turns(CondensedState& state, CondensedSolution& solution, Turn turns) {
    CondensedState tried = in_shares(state);
    hold_shares(tried);
    for (int turn = 0; turn < most_turns; ++turn) {
      solution = solve_turn(tried, turns);
      if (solution.verdict != CondensedVerdict::solved) return false;
      if (hold_shares(tried) < near_share && finish(tried, solution, turns)) {
        state = in_shears(tried);
        return true;
      }
    }
    return false;
  }

  CondensedSolution solve_turn(CondensedState& state, Turn turn) {
    const CondensedState before = state;
    CondensedSolution solution = solve_once(state, methods_.refine);
    if (solution.verdict == CondensedVerdict::solved || turn == Turn::near) return solution;
    state = before;
    return solve_once(state);
  }

  /// With the pressures themselves.
  bool finish(CondensedState& state, CondensedSolution& solution, Turn turn) {
    const std::vector<double> held = held_shares();
    for (CondensedPoint& point : problem_.points) point.law.held_share = 0.0;
    CondensedState finished = state;
    const CondensedSolution last = solve_turn(finished, turn);
    for (std::size_t p = 0; p < held.size(); ++p) problem_.points[p].law.held_share = held[p];
    if (last.verdict != CondensedVerdict::solved) return false;
    state = finished;
    solution = last;
    return true;
  }

  std::vector<double> held_shares() const {
    std::vector<double> held;
    for (const CondensedPoint& point : problem_.points) held.push_back(point.law.held_share);
    return held;
  }

  /// Returns the largest change.
  double hold_shares(const CondensedState& state) {
    double change = 0.0;
    for (std::size_t p = 0; p < problem_.points.size(); ++p) {
      CondensedPoint& point = problem_.points[p];
      if (!(point.share_augmentation > 0.0)) continue;
      const bool open = state.statuses[p] == ContactStatus::open;
      const double share = open ? least_pressure_share
                                : std::max(least_pressure_share, multiplier_at(problem_, state, point)[0] /
                                                                     pressures_.at(point.nodes.front()));
      change = std::max(change, std::abs(share - point.law.held_share));
      point.law.held_share = share;
    }
    return change;
  }

  /// With the laws by shares: shears for shares, and back.
  CondensedState in_shares(CondensedState state) {
    take(Shears::by_shares);
    scale_shears(state, [](double pressure, double of_surface) { return of_surface / pressure; });
    return state;
  }
  CondensedState in_shears(CondensedState state) const {
    scale_shears(state, [](double pressure, double of_surface) { return pressure / of_surface; });
    return state;
  }

  /// Where the pressure of a node pulls its shear lies along that which it stands for in points that press.
  template <typename Factor>
  void scale_shears(CondensedState& state, const Factor& factor) const {
    for (int node = 0; node < given_.node_count; ++node) {
      if (!shared_[static_cast<std::size_t>(node)]) continue;
      const Index first = Index{node} * given_.components;
      const double pressure = state.multipliers[first], of_surface = pressures_.at(node);
      state.multipliers.segment(first + 1, given_.components - 1) *=
          std::abs(pressure) > no_pressure * of_surface ? factor(pressure, of_surface) : 0.0;
    }
  }

  CondensedSolution counted(const CondensedState& start, const CondensedState& state,
                            CondensedSolution solution) const {
    solution.iterations = iterations_;
    solution.changes = 0;
    for (std::size_t p = 0; p < start.statuses.size(); ++p) solution.changes += start.statuses[p] != state.statuses[p];
    return solution;
  }

  const CondensedProblem& given_;
  CondensedProblem problem_;
  const CondensedMethods& methods_;
  const std::vector<char> shared_;
  SurfacePressures pressures_;
  ShareSearch own_search_;
  ShareSearch& search_;
  int iterations_ = 0;
  std::optional<std::pair<CondensedState, CondensedSolution>> far_;
};

}  // namespace

bool has_shared_friction(const CondensedProblem& problem) {
  return std::ranges::any_of(
      problem.points, [](const CondensedPoint& point) { return point.rows > 1 && point.share_augmentation > 0.0; });
}

CondensedSolution solve_shared_friction(const CondensedProblem& problem, CondensedState& state,
                                        const CondensedMethods& methods) {
  return SharedFriction(problem, methods).run(state);
}

}  // namespace comma::solver
