#include "solver/contact_law/condensed_newton.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "solver/contact_law/relaxation.hpp"
#include "solver/linear/dense_solve.hpp"
#include "solver/linear/largest_component.hpp"

namespace comma::solver {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

/// Gaps, pressures and shears beyond zero by less than this share of the largest are rounding: they change no status.
constexpr double status_tolerance = 1e-12;
/// Nor do pressures interpolated from larger ones of the nodes that push by so many of their roundings: beside a small
/// augmentation these are long gaps.
constexpr double pressure_roundings = 16.0;
/// The system is solved when what is left of it is this share of the jumps.
constexpr double residual_tolerance = 1e-12;
/// Where corrections no longer halve it, what is left may be this share: the rounding of a badly conditioned
/// compliance.
constexpr double stagnation_tolerance = 1e-9;
/// Or this share of what the forces could do to the jumps.
constexpr double jump_rounding_share = 1e-13;
/// Or what the rounding of pressures makes of lengths by a small augmentation, up to this share of the jumps.
constexpr double most_law_rounding = 1e-6;
/// The scale of jumps is at least this share of the largest displacement: what the solver leaves of them, 1e-9 of it,
/// is then the rounding of displacements.
constexpr double rounding_scale = 1e-6;

/// What products with the compliance leave of a linear system, as a share: the next iteration of Newton's method takes
/// the rest along. Products in single precision leave 1e-7.
constexpr double product_tolerance = 1e-5;

/// So many iterations may leave more than before, however little patience there is: on nodes, where sliding is
/// linearised such that they come back, some more.
constexpr int free_iterations = 2, free_iterations_on_nodes = 5;

/// A share of a correction has to bring what is left of the equations down by this much of itself.
constexpr double least_decrease = 1e-4;
/// It is halved down to this; corrections shorter than the other lead nowhere, and so many of them are the end.
constexpr double least_share = 1.0 / 128.0;
constexpr double shortest_useful_share = 1e-2;
constexpr int most_short_steps = 3;
/// Jumps that grow by more are those of a body that nothing holds any more.
constexpr double most_growth = 1e6;
/// States this many times as far as the nearest one that was met are those of bodies that have lost their contact: only
/// if there is no nearer one.
constexpr double farthest_state = 1e4;

/// A single step has no other that would take along what products leave; and of penalties that jumps bring alone,
/// forces are far less exact than these.
int direct_rows(const CondensedProblem& problem, bool is_nodal) {
  const bool by_jumps = std::ranges::any_of(problem.points, [&](const CondensedPoint& point) {
    return (point.law.penalised || point.law.friction_penalised) && !(is_nodal && point.stiffness > 0.0);
  });
  const int usual = is_nodal ? problem.direct_rows : problem.direct_rows_between;
  return problem.one_step || by_jumps ? std::max(usual, problem.most_direct_rows) : usual;
}

}  // namespace

const Eigen::VectorXd& first_jumps(const CondensedProblem& problem) {
  return problem.begin.size() > 0 ? problem.begin : problem.free;
}

bool has_penalty(const CondensedProblem& problem) {
  return std::ranges::any_of(
      problem.points, [](const CondensedPoint& point) { return point.law.penalised || point.law.friction_penalised; });
}

CondensedNewton::CondensedNewton(SchurComplement& schur, const CondensedProblem& problem, CondensedState& state)
    : schur_(schur),
      problem_(problem),
      state_(state),
      jumps_(first_jumps(problem)),
      forces_(problem.held),
      is_nodal_(has_points_on_nodes(problem)),
      direct_rows_(direct_rows(problem, is_nodal_)) {
  assert(problem.free.size() == schur.size() && problem.held.size() == schur.size());
  assert(state.statuses.size() == problem.points.size());
}

void CondensedNewton::go_to(const CondensedPlace& place) {
  state_ = place.state;
  jumps_ = place.jumps;
  forces_ = place.forces;
}

void CondensedNewton::correct_once() {
  number_unknowns();
  correct();
  evaluate();
}

void CondensedNewton::correct_statuses() {
  correct_once();
  if (std::isfinite(residual_)) update_statuses();
}

void CondensedNewton::take_penalties(double share) {
  const double ratio = penalty_share_ / share;
  for (std::size_t p = 0; p < problem_.points.size(); ++p) {
    const CondensedPoint& point = problem_.points[p];
    if (point.rows == 0 || state_.statuses[p] == ContactStatus::open) continue;
    if (point.law.penalised) jumps_[point.first_row] *= ratio;
    if (point.law.friction_penalised && state_.statuses[p] == ContactStatus::sticking)
      jumps_.segment(point.first_row + 1, point.rows - 1) *= ratio;
  }
  penalty_share_ = share;
}

bool CondensedNewton::is_far() const { return scale_ > problem_.farthest; }

bool CondensedNewton::stays_near() const { return scale_ <= farthest_state * nearest_ && !is_far(); }

void CondensedNewton::balance_jumps() {
  forces_ = multiplier_forces(problem_, state_, forces_.size());
  number_unknowns();
  require_columns();
  jumps_ = problem_.begin.size() > 0 ? problem_.begin : balanced_jumps();
  take_jumps_of_penalties();
}

/// Of a stiff penalty, jumps that are a little off make any force.
void CondensedNewton::take_jumps_of_penalties() {
  for (std::size_t p = 0; p < problem_.points.size(); ++p) {
    const CondensedPoint& point = problem_.points[p];
    if (point.rows == 0 || state_.statuses[p] == ContactStatus::open) continue;
    const ContactLaw law = law_of(p);
    const Vector3d multiplier = multiplier_at(point);
    if (law.penalised) jumps_[point.first_row] = -multiplier[0] / law.penalty();
    if (!law.friction_penalised || point.rows == 1) continue;
    auto slip = jumps_.segment(point.first_row + 1, point.rows - 1);
    const Eigen::VectorXd sticking = multiplier.segment(1, point.rows - 1) / law.friction_penalty();
    const bool slides = state_.statuses[p] == ContactStatus::sliding && sticking.norm() > 0.0;
    slip = (slides ? std::max(1.0, slip.norm() / sticking.norm()) : 1.0) * sticking;
  }
}

/// Forces of what is much stiffer than the bodies are far less exact than jumps.
void CondensedNewton::let_multipliers_bear_penalties(double stiffness, ContactLaw& law) {
  if (!(stiffness > 0.0)) return;
  if (law.penalised && law.augmentation > stiffness) {
    law.pressure_share = 1.0 - stiffness / law.augmentation;
    law.augmentation = stiffness;
  }
  if (law.friction_penalised && law.friction_augmentation > stiffness) {
    law.shear_share = 1.0 - stiffness / law.friction_augmentation;
    law.friction_augmentation = stiffness;
  }
}

ContactLaw CondensedNewton::law_of(std::size_t p) const {
  ContactLaw law = problem_.points[p].law;
  law.friction *= friction_share_;
  law.pointwise = is_nodal_;
  if (law.penalised) law.augmentation *= penalty_share_;
  if (law.friction_penalised) law.friction_augmentation *= penalty_share_;
  if (is_nodal_) let_multipliers_bear_penalties(problem_.points[p].stiffness, law);
  if (pressures_by_bodies_ && !law.penalised) law.augmentation = bodies_[p].normal;
  if (shears_by_bodies_ && !law.friction_penalised) law.friction_augmentation = bodies_[p].along;
  return law;
}

bool CondensedNewton::follow_smoothed(int& iterations, Augmentations augmentations) {
  if (problem_.components == 1 || !smooth_condensed(schur_, problem_, state_, jumps_, bodies_, augmentations))
    return false;
  pressures_by_bodies_ = is_nodal_;
  shears_by_bodies_ = is_nodal_ || augmentations == Augmentations::of_pressures;
  const bool solved = settle(Rubbing::by_law, iterations);
  pressures_by_bodies_ = shears_by_bodies_ = false;
  return solved;
}

bool CondensedNewton::relax() {
  rubbing_ = Rubbing::by_law;
  return relax_condensed(schur_, problem_, state_, jumps_);
}

bool CondensedNewton::settle(Rubbing rubbing, int& iterations, Patience patience) {
  rubbing_ = rubbing;
  one_at_a_time_ = false;
  led_away_ = is_lost_ = false;
  visited_.clear();
  double last = 0.0, before_last = 0.0;
  for (std::size_t p = 0; p < state_.statuses.size(); ++p)
    state_.statuses[p] = restricted(state_.statuses[p], problem_.points[p]);
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
    if (problem_.components == 1) continue;
    if (one_at_a_time_) return false;  // with friction a cycle stays one
    if (rubbing_ != Rubbing::by_law) continue;
    led_away_ = patience == Patience::short_of_growth &&
                iteration >= (is_nodal_ ? free_iterations_on_nodes : free_iterations) && residual_ > before_last;
    if (led_away_) return false;
    before_last = last;
    // Where nothing is left with statuses that change, it says nothing of what will be.
    last = residual_ > residual_tolerance * scale_ ? residual_ : std::numeric_limits<double>::infinity();
  }
  return false;
}

bool CondensedNewton::descend(int& iterations) {
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

double CondensedNewton::correct_partly() {
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
    if (remainder_ < (1.0 - least_decrease * share) * before || share < least_share || !std::isfinite(remainder_))
      return share;
  }
}

void CondensedNewton::adapt_statuses() {
  visited_.clear();
  one_at_a_time_ = false;
  update_statuses();
  number_unknowns();
  require_columns();
  evaluate();
}

ContactStatus CondensedNewton::restricted(ContactStatus status, const CondensedPoint& point) const {
  if (status == ContactStatus::open || rubbing_ == Rubbing::by_law || !(point.law.friction > 0.0)) return status;
  return ContactStatus::sticking;
}

Vector3d CondensedNewton::jump_at(const CondensedPoint& point) const {
  Vector3d value = Vector3d::Zero();
  for (int c = 0; c < point.rows; ++c) value[c] = jumps_[point.first_row + c];
  return value;
}

ContactLawValue CondensedNewton::law_at(std::size_t p) const {
  const CondensedPoint& point = problem_.points[p];
  return contact_law(law_of(p), state_.statuses[p], multiplier_at(point), jump_at(point));
}

void CondensedNewton::number_unknowns() {
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

void CondensedNewton::add_row(int row) {
  row_unknowns_[row] = static_cast<int>(unknown_rows_.size());
  unknown_rows_.push_back(row);
}

void CondensedNewton::require_columns() {
  std::vector<int> needed = unknown_rows_;
  for (Index row = 0; row < problem_.held.size(); ++row)
    if (problem_.held[row] != 0.0 || forces_[row] != 0.0) needed.push_back(static_cast<int>(row));
  schur_.require(needed);
}

void CondensedNewton::correct() {
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

bool CondensedNewton::correct_at_nodes() {
  NodalStep step(unknown_rows_);
  forces_.setZero();
  for (std::size_t p = 0; p < problem_.points.size(); ++p) {
    const CondensedPoint& point = problem_.points[p];
    if (point.rows == 0 || state_.statuses[p] == ContactStatus::open) continue;
    const ContactLaw law = law_of(p);
    const ContactLawValue value = contact_law(law, state_.statuses[p], multiplier_at(point), jump_at(point));
    for (int c = 0; c < point.rows; ++c) forces_[point.first_row + c] += point.weight * value.traction[c];
    if (!step.add_point(row_unknowns_[point.first_row], point, law, value)) return false;
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

std::optional<Eigen::VectorXd> CondensedNewton::solved(NodalStep& step, const Eigen::VectorXd& balance) {
  const auto count = static_cast<int>(unknown_rows_.size());
  if (count > direct_rows_) {
    NearInverse& near = problem_.near_inverse ? *problem_.near_inverse : own_near_inverse_;
    const auto jumps = step.solve_by_products(
        schur_, balance, near, {.tolerance = product_tolerance, .most_products = problem_.most_products});
    if (jumps || count > problem_.most_direct_rows) return jumps;
  }
  return step.solve(schur_, balance);
}

Eigen::VectorXd CondensedNewton::unbalanced_jumps() {
  const Eigen::VectorXd balanced = balanced_jumps();
  Eigen::VectorXd result(static_cast<Index>(unknown_rows_.size()));
  for (std::size_t k = 0; k < unknown_rows_.size(); ++k)
    result[static_cast<Index>(k)] = jumps_[unknown_rows_[k]] - balanced[unknown_rows_[k]];
  return result;
}

Eigen::VectorXd CondensedNewton::solved(const InterpolatedStep& equations, const Eigen::VectorXd& balance) {
  InterpolatedSolver& solver = problem_.interpolated_solver ? *problem_.interpolated_solver : own_interpolated_solver_;
  if (static_cast<int>(unknown_rows_.size()) > direct_rows_)
    if (const auto step = solver.solve_by_products(
            equations, schur_, balance, {.tolerance = product_tolerance, .most_products = problem_.most_products}))
      return *step;
  return solver.solve(equations, schur_, balance);
}

void CondensedNewton::add_point(std::size_t p, InterpolatedStep& equations, Eigen::VectorXd& balance) {
  const CondensedPoint& point = problem_.points[p];
  const ContactLawValue value = law_at(p);
  for (int c = 0; c < point.rows; ++c) forces_[point.first_row + c] += point.weight * value.traction[c];
  if (state_.statuses[p] != ContactStatus::open) add_traction_derivatives(point, value, equations);
  add_laws(point, value, equations, balance);
}

void CondensedNewton::add_traction_derivatives(const CondensedPoint& point, const ContactLawValue& value,
                                               InterpolatedStep& equations) const {
  for (int a = 0; a < point.rows; ++a) {
    const int place = row_unknowns_[point.first_row + a];
    for (int b = 0; b < point.rows; ++b)
      equations.add_force_derivative(place, row_unknowns_[point.first_row + b],
                                     point.weight * value.traction_by_jump(a, b));
    for (int i = 0; i < point.node_count; ++i)
      for (int b = 0; b < problem_.components; ++b)
        equations.add_force_derivative(place, multiplier_unknowns_[multiplier_index(point.nodes[i], b)],
                                       point.weight * point.shape[i] * value.traction_by_multiplier(a, b));
  }
}

void CondensedNewton::add_laws(const CondensedPoint& point, const ContactLawValue& value, InterpolatedStep& equations,
                               Eigen::VectorXd& balance) const {
  for (int i = 0; i < point.node_count; ++i)
    for (int a = 0; a < problem_.components; ++a) {
      const int equation = multiplier_unknowns_[multiplier_index(point.nodes[i], a)];
      if (equation < 0) continue;
      const double weight = point.weight * point.shape[i];
      balance[equation] += weight * value.residual[a];
      equations.add_law_weight(equation, std::abs(weight));
      for (int b = 0; b < point.rows; ++b)
        equations.add_law_derivative(equation, row_unknowns_[point.first_row + b],
                                     weight * value.residual_by_jump(a, b));
      for (int j = 0; j < point.node_count; ++j)
        for (int b = 0; b < problem_.components; ++b)
          equations.add_law_derivative(equation, multiplier_unknowns_[multiplier_index(point.nodes[j], b)],
                                       weight * point.shape[j] * value.residual_by_multiplier(a, b));
    }
}

Eigen::VectorXd CondensedNewton::balanced_jumps() {
  if (balanced_forces_.size() == forces_.size() && balanced_forces_ == forces_) return balanced_;
  balanced_ = problem_.free + schur_.times(forces_ - problem_.held);
  balanced_forces_ = forces_;
  return balanced_;
}

void CondensedNewton::evaluate() {
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
  scale_ = std::max({rounding_scale * problem_.displacement, largest_component(problem_.free),
                     largest_component(balanced - problem_.free)});
  measure(law, balanced);
  for (Index row = 0; row < balanced.size(); ++row)
    if (row_unknowns_[row] < 0) jumps_[row] = balanced[row];
  if (is_lost_ || !jumps_.allFinite() || !state_.multipliers.allFinite())
    residual_ = remainder_ = std::numeric_limits<double>::infinity();
}

void CondensedNewton::measure(const LawBalance& law, const Eigen::VectorXd& balanced) {
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

double CondensedNewton::largest_pressure() const {
  double largest = 0.0;
  for (int node = 0; node < problem_.node_count; ++node)
    largest = std::max(largest, std::abs(state_.multipliers[multiplier_index(node, 0)]));
  return largest;
}

double CondensedNewton::largest_response() const {
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

bool CondensedNewton::is_solved() {
  if (residual_ <= residual_tolerance * scale_) return true;
  const bool stagnates = same_statuses_ > 0 && residual_ > 0.5 * last_residual_;
  last_residual_ = residual_;
  ++same_statuses_;
  return stagnates && is_rounding();
}

Vector3d CondensedNewton::law_rounding(std::size_t p) const {
  const CondensedPoint& point = problem_.points[p];
  Vector3d sums = Vector3d::Zero();
  for (int i = 0; i < point.node_count; ++i)
    for (int c = 0; c < problem_.components; ++c)
      sums[c] += std::abs(point.shape[i] * state_.multipliers[multiplier_index(point.nodes[i], c)]);
  const ContactLaw law = law_of(p);
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  const double normal = state_.statuses[p] == ContactStatus::open ? epsilon / law.augmentation : 0.0;
  const double along = state_.statuses[p] == ContactStatus::sticking ? 0.0 : epsilon / law.friction_augmentation;
  return {normal * sums[0], along * sums[1], along * sums[2]};
}

double CondensedNewton::law_rounding() const {
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

bool CondensedNewton::is_rounding() const {
  if (residual_ <= std::max(stagnation_tolerance * scale_, jump_rounding_share * largest_response())) return true;
  return residual_ <= std::min(law_rounding(), most_law_rounding * scale_);
}

bool CondensedNewton::is_meant(std::size_t p, ContactStatus now, ContactStatus wanted) const {
  const CondensedPoint& point = problem_.points[p];
  const ContactLaw law = law_of(p);
  const Vector3d multiplier = multiplier_at(point);
  const Vector3d jump = jump_at(point);
  const double pressure = trial_pressure(law, multiplier, jump);
  if (now == ContactStatus::open)
    return pressure > law.augmentation * std::max(status_tolerance * scale_, pressure_roundings * law_rounding(p)[0]);
  if (wanted == ContactStatus::open) return -pressure > status_tolerance * pressure_scale_;
  const double beyond = std::abs(shear_beyond_limit(law, multiplier, jump));
  return beyond > status_tolerance * problem_.points[p].law.friction * pressure_scale_;
}

ContactStatus CondensedNewton::wanted_status(std::size_t p) const {
  const CondensedPoint& point = problem_.points[p];
  const ContactStatus now = state_.statuses[p];
  if (point.rows == 0) return ContactStatus::open;
  const bool stays_closed = point.bilateral && now != ContactStatus::open;
  const ContactStatus wanted =
      restricted(contact_status(law_of(p), stays_closed, multiplier_at(point), jump_at(point)), point);
  return wanted == now || is_meant(p, now, wanted) ? wanted : now;
}

/// At nodes, where sliding is linearised such that iterations come nearer, statuses come back before all of them are
/// right: not a cycle while less is left than then.
bool CondensedNewton::is_cycle(const std::vector<ContactStatus>& next) {
  if (const auto now = visited_.find(state_.statuses); now != visited_.end()) now->second = residual_;
  const auto [before, is_new] = visited_.try_emplace(next, 0.0);
  return !is_new && (!is_nodal_ || std::max(residual_, residual_tolerance * scale_) > 0.5 * before->second);
}

bool CondensedNewton::update_statuses() {
  pressure_scale_ = largest_pressure();
  bool changed = false;
  std::vector<ContactStatus> next = state_.statuses;
  for (std::size_t p = 0; p < next.size() && !(changed && one_at_a_time_); ++p) {
    next[p] = wanted_status(p);
    changed |= next[p] != state_.statuses[p];
  }
  if (changed && is_cycle(next)) one_at_a_time_ = true;
  state_.statuses = std::move(next);
  return changed;
}

}  // namespace comma::solver
