#include "solver/contact/condensed_contact.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include "solver/contact/frictionless.hpp"
#include "solver/contact/interpolated_step.hpp"
#include "solver/contact/nodal_step.hpp"
#include "solver/contact/relaxation.hpp"
#include "solver/contact/shared_friction.hpp"
#include "solver/contact/smoothed_contact.hpp"
#include "solver/linear/dense_solve.hpp"
#include "solver/linear/largest_component.hpp"

namespace comma::solver {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

/// Gaps, pressures and shears beyond zero by less than this share of the largest are rounding: they change no status.
constexpr double status_tolerance = 1e-12;
/// The system is solved when what is left of it is this share of the jumps.
constexpr double residual_tolerance = 1e-12;
/// Where corrections no longer halve it, what is left may be this share: the rounding of a badly conditioned compliance.
constexpr double stagnation_tolerance = 1e-9;
/// Or this share of what the forces could do to the jumps.
constexpr double jump_rounding_share = 1e-13;
/// Or what the rounding of pressures makes of lengths by a small augmentation, up to this share of the jumps.
constexpr double most_law_rounding = 1e-6;
/// The scale of jumps is at least this share of the largest displacement: what the solver leaves of them, 1e-9 of it, is then the
/// rounding of displacements.
constexpr double rounding_scale = 1e-6;

/// What products with the compliance leave of a linear system, as a share: the next iteration of Newton's method takes the rest along. Products in single
/// precision leave 1e-7.
constexpr double product_tolerance = 1e-5;

/// By how much friction grows at first, and at least, as a share of the whole.
constexpr double first_friction_step = 0.125;
constexpr double least_friction_step = 1.0 / 1024.0;
/// It stops growing after as many iterations as so many attempts may take.
constexpr int growth_attempts = 20;

/// A share of a correction has to bring what is left of the equations down by this much of itself.
constexpr double least_decrease = 1e-4;
/// It is halved down to this; corrections shorter than the other lead nowhere, and so many of them are the end.
constexpr double least_share = 1.0 / 128.0;
constexpr double shortest_useful_share = 1e-2;
constexpr int most_short_steps = 3;
/// Jumps that grow by more are those of a body that nothing holds any more.
constexpr double most_growth = 1e6;
/// States this many times as far as the nearest one that was met are those of bodies that have lost their contact: only if there is no nearer one.
constexpr double farthest_state = 1e4;

bool has_penalty(const CondensedProblem& problem) {
  return std::ranges::any_of(problem.points, [](const CondensedPoint& point) { return point.law.penalised || point.law.friction_penalised; });
}

/// A single step has no other that would take along what products leave; and of penalties, forces are far less exact than jumps.
int direct_rows(const CondensedProblem& problem) {
  return problem.one_step || has_penalty(problem) ? std::max(problem.direct_rows, problem.most_direct_rows) : problem.direct_rows;
}

class CondensedSolver {
 public:
  CondensedSolver(SchurComplement& schur, const CondensedProblem& problem, CondensedState& state)
      : schur_(schur), problem_(problem), state_(state), start_(state.statuses), jumps_(problem.free), forces_(problem.held), is_nodal_(has_points_on_nodes(problem)), direct_rows_(direct_rows(problem)) {
    assert(problem.free.size() == schur.size() && problem.held.size() == schur.size());
    assert(state.statuses.size() == problem.points.size());
  }

  /// From the multipliers expected; where that leads away, from the statuses given; then from those of points that stick to what they touch;
  /// then from laws that are smooth at first; then by corrections cut short; then from what relaxation finds; then from the statuses given, however far that leads; at last with friction that grows from none.
  CondensedSolution run() {
    CondensedSolution solution;
    const Eigen::VectorXd multipliers = state_.multipliers;
    const std::vector<ContactStatus> given = start_;
    close_for_good(multipliers);
    bool solved = start_as_expected() && settle(Rubbing::by_law, solution.iterations, Patience::short_of_growth) && stays_near();
    const auto otherwise = [&](const auto& attempt) {
      if (solved) return;
      restart(multipliers);
      solved = attempt() && stays_near();
    };
    bool led_away = false;
    otherwise([&] {
      const bool settled = settle(Rubbing::by_law, solution.iterations, Patience::short_of_growth);
      led_away = led_away_;
      return settled;
    });
    otherwise([&] { return settle(Rubbing::never_slides, solution.iterations) && settle(Rubbing::by_law, solution.iterations); });
    otherwise([&] { return follow_smoothed(solution.iterations); });
    otherwise([&] { return descend(solution.iterations); });
    otherwise([&] { return relax() && settle(Rubbing::by_law, solution.iterations); });
    if (led_away) otherwise([&] { return settle(Rubbing::by_law, solution.iterations); });
    otherwise([&] { return raise_friction(solution.iterations); });
    conclude(solution, solved || return_far());
    for (std::size_t p = 0; p < given.size(); ++p) solution.changes += given[p] != state_.statuses[p];
    return solution;
  }

  /// From a state near the solution, and no other.
  CondensedSolution refine() {
    CondensedSolution solution;
    const Eigen::VectorXd multipliers = state_.multipliers;
    if (has_penalty(problem_)) balance_jumps();  // forces of penalties come from jumps, not from multipliers
    const Eigen::VectorXd jumps = jumps_, forces = forces_;
    bool solved = settle(Rubbing::by_law, solution.iterations, Patience::short_of_growth);
    if (!solved) {
      restart(multipliers);
      jumps_ = jumps;
      forces_ = forces;
      solved = descend(solution.iterations);
    }
    conclude(solution, solved);
    return solution;
  }

  /// From nowhere in particular, by laws that are smooth at first.
  CondensedSolution smooth(Augmentations augmentations) {
    CondensedSolution solution;
    conclude(solution, follow_smoothed(solution.iterations, augmentations));
    return solution;
  }

  CondensedSolution step() {
    CondensedSolution solution;
    solution.iterations = 1;
    number_unknowns();
    correct();
    evaluate();
    solution.forces = forces_;
    if (is_lost_) solution.verdict = CondensedVerdict::too_many_iterations;
    return solution;
  }

 private:
  /// What closed points do along the surface.
  enum class Rubbing : std::uint8_t { by_law, never_slides };
  /// With friction, whether to stop where two iterations have brought what is left of the equations no nearer to zero.
  enum class Patience : std::uint8_t { to_the_end, short_of_growth };

  /// What the first iteration closes of points that stay closed (GLISSIERE) is so in every attempt: which of them finds the solution does not decide it.
  void close_for_good(const Eigen::VectorXd& multipliers) {
    if (problem_.components == 1 || std::ranges::none_of(problem_.points, &CondensedPoint::bilateral)) return;
    number_unknowns();
    correct();
    evaluate();
    if (std::isfinite(residual_)) update_statuses();
    for (std::size_t p = 0; p < start_.size(); ++p)
      if (problem_.points[p].bilateral) start_[p] = state_.statuses[p];
    restart(multipliers);
  }

  /// Jumps are those that go with the forces of these multipliers.
  bool start_as_expected() {
    if (problem_.components == 1 || problem_.expected.size() != state_.multipliers.size()) return false;
    state_.multipliers = problem_.expected;
    balance_jumps();
    return true;
  }

  /// Jumps as the multipliers have them.
  void balance_jumps() {
    forces_ = multiplier_forces(problem_, state_, forces_.size());
    number_unknowns();
    require_columns();
    jumps_ = balanced_jumps();
  }

  void conclude(CondensedSolution& solution, bool solved) const {
    solution.verdict = solved ? CondensedVerdict::solved : CondensedVerdict::too_many_iterations;
    solution.forces = forces_;
  }

  /// Whether what is solved is a state that bodies come to. Otherwise it is kept: where there is no nearer one, it says what nothing holds.
  bool stays_near() {
    if (scale_ <= farthest_state * nearest_) return true;
    if (!far_) far_ = Far{state_, jumps_, forces_};
    return false;
  }

  bool return_far() {
    if (!far_) return false;
    state_ = far_->state;
    jumps_ = far_->jumps;
    forces_ = far_->forces;
    return true;
  }

  void restart(const Eigen::VectorXd& multipliers) {
    state_.multipliers = multipliers;
    state_.statuses = start_;
    jumps_ = problem_.free;
    forces_ = problem_.held;
  }

  /// Solutions of weaker friction lead to that of the friction asked for: each starts from the one before.
  bool raise_friction(int& iterations) {
    if (problem_.components == 1) return false;
    double reached = 0.0;
    double step = first_friction_step;
    friction_share_ = 0.0;
    bool solved = settle(Rubbing::by_law, iterations);
    const int most = iterations + growth_attempts * problem_.max_iterations;
    while (solved && reached < 1.0 && step >= least_friction_step && iterations < most) {
      const CondensedState state = state_;
      const Eigen::VectorXd jumps = jumps_, forces = forces_;
      friction_share_ = std::min(1.0, reached + step);
      if (settle(Rubbing::by_law, iterations)) {
        reached = friction_share_;
        step *= 2.0;
        continue;
      }
      state_ = state;
      jumps_ = jumps;
      forces_ = forces;
      step *= 0.5;
    }
    friction_share_ = 1.0;
    return solved && reached == 1.0;
  }

  ContactLaw law_of(std::size_t p) const {
    ContactLaw law = problem_.points[p].law;
    law.friction *= friction_share_;
    if (pressures_by_bodies_ && !law.penalised) law.augmentation = bodies_[p].normal;
    if (shears_by_bodies_ && !law.friction_penalised) law.friction_augmentation = bodies_[p].along;
    return law;
  }

  /// Laws that are smooth at first need no statuses. On nodes augmentations are not in the solution, and those of the bodies lead there.
  bool follow_smoothed(int& iterations, Augmentations augmentations = Augmentations::of_law) {
    if (problem_.components == 1 || !smooth_condensed(schur_, problem_, state_, jumps_, bodies_, augmentations)) return false;
    pressures_by_bodies_ = is_nodal_;
    shears_by_bodies_ = is_nodal_ || augmentations == Augmentations::of_pressures;
    const bool solved = settle(Rubbing::by_law, iterations);
    pressures_by_bodies_ = shears_by_bodies_ = false;
    return solved;
  }

  bool relax() {
    rubbing_ = Rubbing::by_law;
    return relax_condensed(schur_, problem_, state_, jumps_);
  }

  /// Iterates until statuses stay and nothing is left of the equations; counts on.
  bool settle(Rubbing rubbing, int& iterations, Patience patience = Patience::to_the_end) {
    rubbing_ = rubbing;
    one_at_a_time_ = false;
    led_away_ = is_lost_ = false;
    visited_.clear();
    double last = 0.0, before_last = 0.0;
    for (std::size_t p = 0; p < state_.statuses.size(); ++p) state_.statuses[p] = restricted(state_.statuses[p], problem_.points[p]);
    for (int iteration = 0; iteration < problem_.max_iterations; ++iteration) {
      ++iterations;
      number_unknowns();
      correct();
      evaluate();
      if (!std::isfinite(residual_)) return false;
      nearest_ = std::min(nearest_, scale_);
      const bool settled = !update_statuses();
      if (settled && is_solved()) return true;
      if (!settled) same_statuses_ = 0;
      if (problem_.components == 1 || rubbing_ != Rubbing::by_law) continue;
      if (one_at_a_time_) return false;  // with friction a cycle stays one
      led_away_ = patience == Patience::short_of_growth && iteration >= 2 && residual_ > before_last;
      if (led_away_) return false;
      before_last = last;
      // Where nothing is left with statuses that change, it says nothing of what will be.
      last = residual_ > residual_tolerance * scale_ ? residual_ : std::numeric_limits<double>::infinity();
    }
    return false;
  }

  /// Newton's method on statuses, jumps and multipliers together: each correction is halved until less is left of the equations with the statuses that it brings
  /// (a damped semismooth method; T. De Luca, F. Facchinei, C. Kanzow, Mathematical Programming 75, 1996).
  bool descend(int& iterations) {
    rubbing_ = Rubbing::by_law;
    led_away_ = is_lost_ = false;
    number_unknowns();
    require_columns();
    jumps_ = balanced_jumps();
    adapt_statuses();
    const double farthest = most_growth * scale_;
    int short_ones = 0;
    for (int iteration = 0; iteration < problem_.max_iterations && short_ones < most_short_steps; ++iteration) {
      ++iterations;
      const double before = remainder_;
      if (correct_partly() < shortest_useful_share) ++short_ones;
      if (!std::isfinite(residual_) || scale_ > farthest) return false;
      if (residual_ <= residual_tolerance * scale_) return true;
      if (remainder_ > 0.5 * before && is_rounding()) return true;
    }
    return false;
  }

  /// The share of the correction that was taken.
  double correct_partly() {
    const CondensedState state = state_;
    const Eigen::VectorXd jumps = jumps_;
    const double before = remainder_;
    correct();
    const Eigen::VectorXd jump_step = jumps_ - jumps, multiplier_step = state_.multipliers - state.multipliers;
    for (double share = 1.0;; share *= 0.5) {
      jumps_ = jumps + share * jump_step;
      state_ = {state.multipliers + share * multiplier_step, state.statuses};
      number_unknowns();
      evaluate();
      adapt_statuses();
      if (remainder_ < (1.0 - least_decrease * share) * before || share < least_share || !std::isfinite(remainder_)) return share;
    }
  }

  /// The statuses that the law asks for, and what is left of the equations with them.
  void adapt_statuses() {
    visited_.clear();
    one_at_a_time_ = false;
    update_statuses();
    number_unknowns();
    require_columns();
    evaluate();
  }

  ContactStatus restricted(ContactStatus status, const CondensedPoint& point) const {
    if (status == ContactStatus::open || rubbing_ == Rubbing::by_law || !(point.law.friction > 0.0)) return status;
    return ContactStatus::sticking;
  }

  int multiplier_index(int node, int component) const { return node * problem_.components + component; }

  bool is_smooth(int node) const { return !problem_.smooth.empty() && problem_.smooth[static_cast<std::size_t>(node)]; }

  Vector3d multiplier_at(const CondensedPoint& point) const { return solver::multiplier_at(problem_, state_, point); }

  Vector3d jump_at(const CondensedPoint& point) const {
    Vector3d value = Vector3d::Zero();
    for (int c = 0; c < point.rows; ++c) value[c] = jumps_[point.first_row + c];
    return value;
  }

  ContactLawValue law_at(std::size_t p) const {
    const CondensedPoint& point = problem_.points[p];
    return contact_law(law_of(p), state_.statuses[p], multiplier_at(point), jump_at(point));
  }

  /// A multiplier is zero, without more ado, where each of its points lies on its node and is open, or does not rub.
  void number_unknowns() {
    row_unknowns_.assign(static_cast<std::size_t>(schur_.size()), -1);
    multiplier_unknowns_.assign(static_cast<std::size_t>(problem_.node_count * problem_.components), -1);
    unknown_rows_.clear();
    for (std::size_t p = 0; p < problem_.points.size(); ++p) {
      const CondensedPoint& point = problem_.points[p];
      const bool open = state_.statuses[p] == ContactStatus::open;
      for (int c = 0; c < point.rows && !open; ++c) add_row(point.first_row + c);
      if (open && point.node_count == 1) continue;
      for (int i = 0; i < point.node_count; ++i)
        for (int c = 0; c < (is_smooth(point.nodes[i]) ? 1 : point.components); ++c)
          multiplier_unknowns_[multiplier_index(point.nodes[i], c)] = 0;
    }
    for (const CondensedSpring& spring : problem_.springs) add_row(spring.row);
    unknowns_ = static_cast<int>(unknown_rows_.size());
    for (std::size_t i = 0; i < multiplier_unknowns_.size(); ++i) {
      if (multiplier_unknowns_[i] < 0) state_.multipliers[static_cast<Index>(i)] = 0.0;
      if (multiplier_unknowns_[i] == 0) multiplier_unknowns_[i] = unknowns_++;
    }
  }

  void add_row(int row) {
    row_unknowns_[row] = static_cast<int>(unknown_rows_.size());
    unknown_rows_.push_back(row);
  }

  void require_columns() {
    std::vector<int> needed = unknown_rows_;
    for (Index row = 0; row < problem_.held.size(); ++row)
      if (problem_.held[row] != 0.0 || forces_[row] != 0.0) needed.push_back(static_cast<int>(row));
    schur_.require(needed);
  }

  /// One step of Newton's method for the jumps of closed points and springs and for the multipliers.
  void correct() {
    require_columns();
    if (unknowns_ == 0 || (is_nodal_ && correct_at_nodes())) return;
    InterpolatedStep equations(unknown_rows_, unknowns_);
    forces_.setZero();
    Eigen::VectorXd balance = Eigen::VectorXd::Zero(unknowns_);
    for (std::size_t p = 0; p < problem_.points.size(); ++p) add_point(p, equations, balance);
    for (const CondensedSpring& spring : problem_.springs) {
      forces_[spring.row] += spring.stiffness * jumps_[spring.row];
      equations.add_force_derivative(row_unknowns_[spring.row], row_unknowns_[spring.row], spring.stiffness);
    }
    balance.head(static_cast<Index>(unknown_rows_.size())) = unbalanced_jumps();
    const Eigen::VectorXd step = solved(equations, balance);
    for (std::size_t k = 0; k < unknown_rows_.size(); ++k) jumps_[unknown_rows_[k]] -= step[static_cast<Index>(k)];
    for (std::size_t i = 0; i < multiplier_unknowns_.size(); ++i)
      if (multiplier_unknowns_[i] >= 0) state_.multipliers[static_cast<Index>(i)] -= step[multiplier_unknowns_[i]];
  }

  /// The same with the multipliers eliminated point by point: half the unknowns. False where a law leaves its multiplier open.
  bool correct_at_nodes() {
    NodalStep step(unknown_rows_);
    forces_.setZero();
    for (std::size_t p = 0; p < problem_.points.size(); ++p) {
      const CondensedPoint& point = problem_.points[p];
      if (point.rows == 0 || state_.statuses[p] == ContactStatus::open) continue;
      const ContactLawValue value = law_at(p);
      for (int c = 0; c < point.rows; ++c) forces_[point.first_row + c] += point.weight * value.traction[c];
      if (!step.add_point(row_unknowns_[point.first_row], point, value)) return false;
    }
    for (const CondensedSpring& spring : problem_.springs) {
      forces_[spring.row] += spring.stiffness * jumps_[spring.row];
      step.add_spring(row_unknowns_[spring.row], spring.stiffness);
    }
    const std::optional<Eigen::VectorXd> jumps = solved(step, unbalanced_jumps());
    if (!jumps) {
      is_lost_ = true;
      return true;
    }
    for (std::size_t k = 0; k < unknown_rows_.size(); ++k) jumps_[unknown_rows_[k]] -= (*jumps)[static_cast<Index>(k)];
    for (const NodalStep::Change& change : step.multiplier_changes())
      for (int c = 0; c < change.rows; ++c) state_.multipliers[multiplier_index(change.node, c)] -= change.value[c];
    return true;
  }

  /// Many rows by products with the compliance; where these lead nowhere and for few rows, directly. Nothing where that takes too long as well.
  std::optional<Eigen::VectorXd> solved(NodalStep& step, const Eigen::VectorXd& balance) {
    const auto count = static_cast<int>(unknown_rows_.size());
    if (count > direct_rows_) {
      NearInverse& near = problem_.near_inverse ? *problem_.near_inverse : own_near_inverse_;
      const auto jumps = step.solve_by_products(schur_, balance, near, {.tolerance = product_tolerance, .most_products = problem_.most_products});
      if (jumps || count > problem_.most_direct_rows) return jumps;
    }
    return step.solve(schur_, balance);
  }

  /// What jumps of unknown rows exceed those that go with the forces by.
  Eigen::VectorXd unbalanced_jumps() {
    const Eigen::VectorXd balanced = balanced_jumps();
    Eigen::VectorXd result(static_cast<Index>(unknown_rows_.size()));
    for (std::size_t k = 0; k < unknown_rows_.size(); ++k) result[static_cast<Index>(k)] = jumps_[unknown_rows_[k]] - balanced[unknown_rows_[k]];
    return result;
  }

  /// Many rows by products with the compliance where these lead anywhere.
  Eigen::VectorXd solved(const InterpolatedStep& equations, const Eigen::VectorXd& balance) {
    if (static_cast<int>(unknown_rows_.size()) > direct_rows_)
      if (const auto step = equations.solve_by_products(schur_, balance, {.tolerance = product_tolerance, .most_products = problem_.most_products})) return *step;
    return equations.solve(schur_, balance);
  }

  void add_point(std::size_t p, InterpolatedStep& equations, Eigen::VectorXd& balance) {
    const CondensedPoint& point = problem_.points[p];
    const ContactLawValue value = law_at(p);
    for (int c = 0; c < point.rows; ++c) forces_[point.first_row + c] += point.weight * value.traction[c];
    if (state_.statuses[p] != ContactStatus::open) add_traction_derivatives(point, value, equations);
    add_laws(point, value, equations, balance);
  }

  void add_traction_derivatives(const CondensedPoint& point, const ContactLawValue& value, InterpolatedStep& equations) const {
    for (int a = 0; a < point.rows; ++a) {
      const int place = row_unknowns_[point.first_row + a];
      for (int b = 0; b < point.rows; ++b) equations.add_force_derivative(place, row_unknowns_[point.first_row + b], point.weight * value.traction_by_jump(a, b));
      for (int i = 0; i < point.node_count; ++i)
        for (int b = 0; b < problem_.components; ++b)
          equations.add_force_derivative(place, multiplier_unknowns_[multiplier_index(point.nodes[i], b)], point.weight * point.shape[i] * value.traction_by_multiplier(a, b));
    }
  }

  void add_laws(const CondensedPoint& point, const ContactLawValue& value, InterpolatedStep& equations, Eigen::VectorXd& balance) const {
    for (int i = 0; i < point.node_count; ++i)
      for (int a = 0; a < problem_.components; ++a) {
        const int equation = multiplier_unknowns_[multiplier_index(point.nodes[i], a)];
        if (equation < 0) continue;
        const double weight = point.weight * point.shape[i];
        balance[equation] += weight * value.residual[a];
        for (int b = 0; b < point.rows; ++b) equations.add_law_derivative(equation, row_unknowns_[point.first_row + b], weight * value.residual_by_jump(a, b));
        for (int j = 0; j < point.node_count; ++j)
          for (int b = 0; b < problem_.components; ++b)
            equations.add_law_derivative(equation, multiplier_unknowns_[multiplier_index(point.nodes[j], b)], weight * point.shape[j] * value.residual_by_multiplier(a, b));
      }
  }

  /// The jumps that go with the present forces.
  Eigen::VectorXd balanced_jumps() {
    if (balanced_forces_.size() == forces_.size() && balanced_forces_ == forces_) return balanced_;
    balanced_ = problem_.free + schur_.times(forces_ - problem_.held);
    balanced_forces_ = forces_;
    return balanced_;
  }

  /// What is left of the law at a multiplier, and what a length is measured by there.
  struct LawBalance {
    Eigen::VectorXd residual, weight;
    Eigen::VectorXd share_weight;  ///< by which a share is known to its own rounding
    Eigen::VectorXd open;          ///< augmentation of open points, a pressure over a length, or 0
  };

  /// Forces, and what is left of the equations, at the present multipliers and jumps.
  void evaluate() {
    forces_.setZero();
    const Eigen::VectorXd none = Eigen::VectorXd::Zero(state_.multipliers.size());
    LawBalance law{none, none, none, none};
    for (std::size_t p = 0; p < problem_.points.size(); ++p) {
      const CondensedPoint& point = problem_.points[p];
      const ContactLawValue value = law_at(p);
      for (int c = 0; c < point.rows; ++c) forces_[point.first_row + c] += point.weight * value.traction[c];
      for (int i = 0; i < point.node_count; ++i)
        for (int c = 0; c < problem_.components; ++c) {
          const int index = multiplier_index(point.nodes[i], c);
          law.residual[index] += point.weight * point.shape[i] * value.residual[c];
          law.weight[index] += point.weight * std::abs(point.shape[i]);
          if (c == 0 && state_.statuses[p] == ContactStatus::open) law.open[index] = law_of(p).augmentation;
          if (c > 0 && point.share_augmentation > 0.0 && state_.statuses[p] != ContactStatus::sticking)
            law.share_weight[index] += point.weight * std::abs(point.shape[i]) / point.share_augmentation;
        }
    }
    for (const CondensedSpring& spring : problem_.springs) forces_[spring.row] += spring.stiffness * jumps_[spring.row];
    const Eigen::VectorXd balanced = balanced_jumps();
    scale_ = std::max({rounding_scale * problem_.displacement, largest_component(problem_.free), largest_component(balanced - problem_.free)});
    measure(law, balanced);
    for (Index row = 0; row < balanced.size(); ++row)
      if (row_unknowns_[row] < 0) jumps_[row] = balanced[row];
    if (is_lost_ || !jumps_.allFinite() || !state_.multipliers.allFinite()) residual_ = remainder_ = std::numeric_limits<double>::infinity();
  }

  void measure(const LawBalance& law, const Eigen::VectorXd& balanced) {
    residual_ = 0.0;
    double squares = 0.0;
    const auto count = [&](double left, double counts) {
      residual_ = std::max(residual_, left);
      squares += counts * left * counts * left;
    };
    for (const int row : unknown_rows_) count(std::abs(jumps_[row] - balanced[row]), 1.0);
    const double pressure = largest_pressure();
    const double flexibility = pressure > 0.0 ? scale_ / pressure : 0.0;
    for (Index i = 0; i < law.residual.size(); ++i) {
      if (multiplier_unknowns_[i] < 0 || !(law.weight[i] > 0.0)) continue;
      const double weight = law.weight[i] + (scale_ > 0.0 ? law.share_weight[i] / scale_ : 0.0);
      // The pressure of an open point is worth what the bodies give way under it, not what a small augmentation would.
      count(std::abs(law.residual[i]) / weight, law.open[i] > 0.0 ? std::min(1.0, law.open[i] * flexibility) : 1.0);
    }
    remainder_ = std::sqrt(squares);
  }

  double largest_pressure() const {
    double largest = 0.0;
    for (int node = 0; node < problem_.node_count; ++node) largest = std::max(largest, std::abs(state_.multipliers[multiplier_index(node, 0)]));
    return largest;
  }

  /// What forces of one sign could do to a jump: jumps are exact to some roundings of it.
  double largest_response() const {
    double sum = 0.0;
    double largest_root = 0.0;
    for (Index row = 0; row < forces_.size(); ++row) {
      if (!schur_.known(static_cast<int>(row))) continue;
      const double root = std::sqrt(std::abs(schur_.column(static_cast<int>(row))[row]));
      sum += root * std::max(std::abs(forces_[row]), std::abs(problem_.held[row]));
      largest_root = std::max(largest_root, root);
    }
    return largest_root * sum;
  }

  bool is_solved() {
    if (residual_ <= residual_tolerance * scale_) return true;
    const bool stagnates = same_statuses_ > 0 && residual_ > 0.5 * last_residual_;
    last_residual_ = residual_;
    ++same_statuses_;
    return stagnates && is_rounding();
  }

  /// Of lengths at a point that are differences of pressures or shears over an augmentation, which may be small beside the stiffness of the bodies.
  Vector3d law_rounding(std::size_t p) const {
    const CondensedPoint& point = problem_.points[p];
    Vector3d sums = Vector3d::Zero();
    for (int i = 0; i < point.node_count; ++i)
      for (int c = 0; c < problem_.components; ++c) sums[c] += std::abs(point.shape[i] * state_.multipliers[multiplier_index(point.nodes[i], c)]);
    const ContactLaw law = law_of(p);
    constexpr double epsilon = std::numeric_limits<double>::epsilon();
    const double normal = state_.statuses[p] == ContactStatus::open ? epsilon / law.augmentation : 0.0;
    const double along = state_.statuses[p] == ContactStatus::sticking ? 0.0 : epsilon / law.friction_augmentation;
    return {normal * sums[0], along * sums[1], along * sums[2]};
  }

  /// The largest of what that makes of the equations of a multiplier.
  double law_rounding() const {
    Eigen::VectorXd rounding = Eigen::VectorXd::Zero(state_.multipliers.size()), weight = rounding;
    for (std::size_t p = 0; p < problem_.points.size(); ++p) {
      const CondensedPoint& point = problem_.points[p];
      const Vector3d each = law_rounding(p);
      for (int i = 0; i < point.node_count; ++i)
        for (int c = 0; c < problem_.components; ++c) {
          const double share = point.weight * std::abs(point.shape[i]);
          rounding[multiplier_index(point.nodes[i], c)] += share * each[c];
          weight[multiplier_index(point.nodes[i], c)] += share;
        }
    }
    double largest = 0.0;
    for (Index i = 0; i < rounding.size(); ++i)
      if (multiplier_unknowns_[i] >= 0 && weight[i] > 0.0) largest = std::max(largest, rounding[i] / weight[i]);
    return largest;
  }

  /// Where corrections bring no more.
  bool is_rounding() const {
    if (residual_ <= std::max(stagnation_tolerance * scale_, jump_rounding_share * largest_response())) return true;
    return residual_ <= std::min(law_rounding(), most_law_rounding * scale_);
  }

  /// Whether a status that the law asks for differs from the present one by more than rounding.
  bool is_meant(std::size_t p, ContactStatus now, ContactStatus wanted) const {
    const CondensedPoint& point = problem_.points[p];
    const ContactLaw law = law_of(p);
    const Vector3d multiplier = multiplier_at(point);
    const Vector3d jump = jump_at(point);
    const double pressure = (law.penalised ? 0.0 : multiplier[0]) - law.augmentation * jump[0];
    if (now == ContactStatus::open) return pressure > status_tolerance * law.augmentation * scale_;
    if (wanted == ContactStatus::open) return -pressure > status_tolerance * pressure_scale_;
    const double beyond = std::abs(shear_beyond_limit(law, multiplier, jump));
    return beyond > status_tolerance * problem_.points[p].law.friction * pressure_scale_;
  }

  ContactStatus wanted_status(std::size_t p) const {
    const CondensedPoint& point = problem_.points[p];
    const ContactStatus now = state_.statuses[p];
    if (point.rows == 0) return ContactStatus::open;
    const bool stays_closed = point.bilateral && now != ContactStatus::open;
    const ContactStatus wanted = restricted(contact_status(law_of(p), stays_closed, multiplier_at(point), jump_at(point)), point);
    return wanted == now || is_meant(p, now, wanted) ? wanted : now;
  }

  bool update_statuses() {
    pressure_scale_ = largest_pressure();
    bool changed = false;
    std::vector<ContactStatus> next = state_.statuses;
    for (std::size_t p = 0; p < next.size() && !(changed && one_at_a_time_); ++p) {
      next[p] = wanted_status(p);
      changed |= next[p] != state_.statuses[p];
    }
    if (changed && !visited_.insert(next).second) one_at_a_time_ = true;
    state_.statuses = std::move(next);
    return changed;
  }

  SchurComplement& schur_;
  const CondensedProblem& problem_;
  CondensedState& state_;
  std::vector<ContactStatus> start_;  ///< what attempts begin with
  Eigen::VectorXd jumps_;
  Eigen::VectorXd forces_;
  const bool is_nodal_;
  const int direct_rows_;
  NearInverse own_near_inverse_;
  Eigen::VectorXd balanced_forces_, balanced_;
  std::vector<int> row_unknowns_;         ///< unknown of a row of the Schur complement, or -1
  std::vector<int> multiplier_unknowns_;  ///< the same of a multiplier
  std::vector<int> unknown_rows_;
  int unknowns_ = 0;
  double residual_ = 0.0;
  double remainder_ = 0.0;  ///< what is left of all equations, by the root of squares (a length)
  double last_residual_ = 0.0;
  double scale_ = 0.0;
  double pressure_scale_ = 0.0;
  int same_statuses_ = 0;
  bool one_at_a_time_ = false;
  bool led_away_ = false;  ///< the last attempt ended for want of patience
  bool is_lost_ = false;   ///< a linear system was not solved
  double nearest_ = std::numeric_limits<double>::infinity();  ///< the least scale that was met
  struct Far {
    CondensedState state;
    Eigen::VectorXd jumps, forces;
  };
  std::optional<Far> far_;  ///< what was solved far away
  Rubbing rubbing_ = Rubbing::by_law;
  double friction_share_ = 1.0;
  bool pressures_by_bodies_ = false, shears_by_bodies_ = false;  ///< whose augmentations are those of the bodies, not of the law
  std::vector<PointStiffness> bodies_;
  std::set<std::vector<ContactStatus>> visited_;
};

}  // namespace

CondensedSolution solve_condensed(SchurComplement& schur, const CondensedProblem& problem, CondensedState& state) {
  if (problem.one_step) return CondensedSolver(schur, problem, state).step();
  if (const auto solution = solve_frictionless(schur, problem, state)) return *solution;
  if (has_shared_friction(problem))
    return solve_shared_friction(problem, state, {[&](const CondensedProblem& each, CondensedState& at) { return CondensedSolver(schur, each, at).run(); },
                                                  [&](const CondensedProblem& each, CondensedState& at) { return CondensedSolver(schur, each, at).refine(); },
                                                  [&](const CondensedProblem& each, CondensedState& at) { return CondensedSolver(schur, each, at).smooth(Augmentations::of_law); },
                                                  [&](const CondensedProblem& each, CondensedState& at) { return CondensedSolver(schur, each, at).smooth(Augmentations::of_pressures); }});
  return CondensedSolver(schur, problem, state).run();
}

}  // namespace comma::solver
