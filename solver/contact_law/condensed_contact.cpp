#include "solver/contact_law/condensed_contact.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "solver/contact_law/condensed_newton.hpp"
#include "solver/contact_law/frictionless.hpp"
#include "solver/contact_law/shared_friction.hpp"

namespace comma::solver {
namespace {

using Patience = CondensedNewton::Patience;
using Rubbing = CondensedNewton::Rubbing;

/// By how much friction and penalties grow at first, and at least, as a share of the way.
constexpr double first_growth = 0.125;
constexpr double least_growth = 1.0 / 1024.0;
/// They stop growing after as many iterations as so many attempts may take.
constexpr int growth_attempts = 20;
/// The softest penalties, as a share of those asked for: these may be that much stiffer than the bodies.
constexpr double softest_penalties = 1.0 / 4096.0;

/// Attempts one after the other, each from where it may find its way.
class CondensedSearch {
 public:
  CondensedSearch(SchurComplement& schur, const CondensedProblem& problem, CondensedState& state)
      : problem_(problem),
        state_(state),
        given_(state.statuses),
        start_{state, first_jumps(problem), problem.held},
        newton_(schur, problem, state) {}

  /// From the multipliers expected; where that leads away, from the statuses given; then from those of points that
  /// stick to what they touch; then from laws that are smooth at first; then by corrections cut short; then from what
  /// relaxation finds; then from the statuses given, however far that leads; at last with penalties that grow from soft
  /// ones, and with friction that grows from none.
  CondensedSolution run() {
    close_for_good();
    bool solved = start_as_expected() && settle(Rubbing::by_law, Patience::short_of_growth) && stays_near();
    const auto otherwise = [&](const auto& attempt) {
      if (solved) return;
      newton_.go_to(start_);
      solved = attempt() && stays_near();
    };
    bool led_away = false;
    otherwise([&] {
      const bool settled = settle(Rubbing::by_law, Patience::short_of_growth);
      led_away = newton_.was_led_away();
      return settled;
    });
    otherwise([&] { return settle(Rubbing::never_slides) && settle(Rubbing::by_law); });
    otherwise([&] { return newton_.follow_smoothed(solution_.iterations, Augmentations::of_law); });
    otherwise([&] { return newton_.descend(solution_.iterations); });
    otherwise([&] { return newton_.relax() && settle(Rubbing::by_law); });
    if (led_away) otherwise([&] { return settle(Rubbing::by_law); });
    otherwise([&] { return raise_penalties(); });
    otherwise([&] { return raise_friction(); });
    const bool returns = !solved && return_far();
    conclude(solved || returns);
    solution_.is_far = returns;
    for (std::size_t p = 0; p < given_.size(); ++p) solution_.changes += given_[p] != state_.statuses[p];
    return solution_;
  }

  /// By Newton's method alone, from a state near the solution and the jumps that go with it.
  CondensedSolution attempt() {
    newton_.balance_jumps();
    conclude(settle(Rubbing::by_law, Patience::short_of_growth));
    return solution_;
  }

  /// From a state near the solution, and no other.
  CondensedSolution refine() {
    if (has_penalty(problem_)) newton_.balance_jumps();  // forces of penalties come from jumps, not from multipliers
    CondensedPlace start = newton_.place();
    start.state = start_.state;
    bool solved = settle(Rubbing::by_law, Patience::short_of_growth);
    if (!solved) {
      newton_.go_to(start);
      solved = newton_.descend(solution_.iterations);
    }
    conclude(solved);
    return solution_;
  }

  /// From nowhere in particular, by laws that are smooth at first.
  CondensedSolution smooth(Augmentations augmentations) {
    conclude(newton_.follow_smoothed(solution_.iterations, augmentations));
    return solution_;
  }

  CondensedSolution step() {
    solution_.iterations = 1;
    newton_.correct_once();
    conclude(!newton_.is_lost());
    if (newton_.solved_forces().size() > 0) solution_.forces = newton_.solved_forces();
    return solution_;
  }

 private:
  bool settle(Rubbing rubbing, Patience patience = Patience::to_the_end) {
    return newton_.settle(rubbing, solution_.iterations, patience);
  }

  /// What the first iteration closes of points that stay closed (GLISSIERE) is so in every attempt: which of them finds
  /// the solution does not decide it.
  void close_for_good() {
    if (problem_.components == 1 || std::ranges::none_of(problem_.points, &CondensedPoint::bilateral)) return;
    newton_.correct_statuses();
    for (std::size_t p = 0; p < given_.size(); ++p)
      if (problem_.points[p].bilateral) start_.state.statuses[p] = state_.statuses[p];
    newton_.go_to(start_);
  }

  /// Jumps are those that go with the forces of these multipliers.
  bool start_as_expected() {
    if (problem_.components == 1 || problem_.expected.size() != state_.multipliers.size()) return false;
    state_.multipliers = problem_.expected;
    newton_.balance_jumps();
    return true;
  }

  void conclude(bool solved) {
    solution_.is_far = solved && !newton_.stays_near();
    solution_.verdict = solved ? CondensedVerdict::solved : CondensedVerdict::too_many_iterations;
    solution_.forces = newton_.forces();
  }

  /// Whether what is solved is a state that bodies come to. Otherwise it is kept: where there is no nearer one, it says
  /// what nothing holds.
  bool stays_near() {
    if (newton_.stays_near()) return true;
    if (!far_) far_ = newton_.place();
    return false;
  }

  bool return_far() {
    if (far_) newton_.go_to(*far_);
    return far_.has_value();
  }

  /// Solutions of weaker friction lead to that of the friction asked for.
  bool raise_friction() {
    if (problem_.components == 1) return false;
    newton_.take_friction(0.0);
    const bool raised = settle(Rubbing::by_law) && raise([&](double way) { newton_.take_friction(way); });
    newton_.take_friction(1.0);
    return raised;
  }

  /// Solutions with softer penalties lead to that with those asked for.
  bool raise_penalties() {
    if (problem_.components == 1 || !has_penalty(problem_)) return false;
    newton_.take_penalties(softest_penalties);
    bool solved = false;
    const auto otherwise = [&](const auto& attempt) {
      if (solved) return;
      newton_.go_to(start_);
      solved = attempt();
    };
    otherwise([&] { return settle(Rubbing::by_law); });
    otherwise([&] { return newton_.follow_smoothed(solution_.iterations, Augmentations::of_law); });
    otherwise([&] { return newton_.descend(solution_.iterations); });
    otherwise([&] { return raise_friction(); });
    const bool raised =
        solved && raise([&](double way) { newton_.take_penalties(std::pow(softest_penalties, 1.0 - way)); });
    newton_.take_penalties(1.0);
    return raised;
  }

  /// From a solution at the beginning of a way (0) to its end (1): each solution starts from the one before.
  template <typename Take>
  bool raise(const Take& take) {
    double reached = 0.0;
    double step = first_growth;
    const int most = solution_.iterations + growth_attempts * problem_.max_iterations;
    while (reached < 1.0 && step >= least_growth && solution_.iterations < most) {
      const CondensedPlace place = newton_.place();
      const double next = std::min(1.0, reached + step);
      take(next);
      if (settle_or_descend()) {
        reached = next;
        step *= 2.0;
        continue;
      }
      take(reached);
      newton_.go_to(place);
      step *= 0.5;
    }
    return reached == 1.0;
  }

  bool settle_or_descend() {
    const CondensedPlace place = newton_.place();
    if (settle(Rubbing::by_law)) return true;
    newton_.go_to(place);
    return newton_.descend(solution_.iterations);
  }

  const CondensedProblem& problem_;
  CondensedState& state_;
  const std::vector<ContactStatus> given_;
  CondensedPlace start_;  ///< what attempts begin with
  CondensedNewton newton_;
  CondensedSolution solution_;
  std::optional<CondensedPlace> far_;  ///< what was solved far away
};

}  // namespace

CondensedSolution solve_condensed(SchurComplement& schur, const CondensedProblem& problem, CondensedState& state) {
  if (problem.one_step) return CondensedSearch(schur, problem, state).step();
  if (const auto solution = solve_frictionless(schur, problem, state)) return *solution;
  const auto by = [&schur](auto way) {
    return [&schur, way](const CondensedProblem& each, CondensedState& at) {
      CondensedSearch search(schur, each, at);
      return std::invoke(way, search);
    };
  };
  if (has_shared_friction(problem))
    return solve_shared_friction(
        problem, state,
        {.solve = by(&CondensedSearch::run),
         .refine = by(&CondensedSearch::refine),
         .attempt = by(&CondensedSearch::attempt),
         .smooth = by([](CondensedSearch& search) { return search.smooth(Augmentations::of_law); }),
         .stand_in = by([](CondensedSearch& search) { return search.smooth(Augmentations::of_pressures); })});
  CondensedState start = state;
  CondensedSolution found = CondensedSearch(schur, problem, state).run();
  if (found.verdict == CondensedVerdict::solved) return found;
  if (auto solution = solve_afloat(schur, problem, start)) {
    state = std::move(start);
    return *std::move(solution);
  }
  return found;
}

}  // namespace comma::solver
