#include "solver/contact_law/condensed_equations.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "solver/linear/largest_component.hpp"

namespace comma::solver {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

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

CondensedEquations::CondensedEquations(SchurComplement& schur, const CondensedProblem& problem, CondensedState& state)
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

void CondensedEquations::go_to(Eigen::VectorXd jumps, Eigen::VectorXd forces) {
  jumps_ = std::move(jumps);
  forces_ = std::move(forces);
}

void CondensedEquations::augment_shears(std::vector<PointStiffness> bodies) {
  bodies_ = std::move(bodies);
  shears_by_bodies_ = true;
}

void CondensedEquations::augment_pressures_and_shears(std::vector<PointStiffness> bodies) {
  augment_shears(std::move(bodies));
  pressures_by_bodies_ = true;
}

void CondensedEquations::augment_by_laws() { pressures_by_bodies_ = shears_by_bodies_ = false; }

void CondensedEquations::take_penalties(double share) {
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

void CondensedEquations::balance_jumps() {
  forces_ = multiplier_forces(problem_, state_, forces_.size());
  number_unknowns();
  require_columns();
  jumps_ = problem_.begin.size() > 0 ? problem_.begin : balanced_jumps();
  take_jumps_of_penalties();
}

void CondensedEquations::take_balanced_jumps() {
  number_unknowns();
  require_columns();
  jumps_ = balanced_jumps();
}

/// Of a stiff penalty, jumps that are a little off make any force.
void CondensedEquations::take_jumps_of_penalties() {
  for (std::size_t p = 0; p < problem_.points.size(); ++p) {
    const CondensedPoint& point = problem_.points[p];
    if (point.rows == 0 || state_.statuses[p] == ContactStatus::open) continue;
    const ContactLaw law = law_of(p);
    const Vector3d multiplier = live_part(law, multiplier_at(point));
    if (law.penalised) jumps_[point.first_row] = -multiplier[0] / law.penalty();
    if (!law.friction_penalised || point.rows == 1) continue;
    const Vector3d jump = jump_at(point), live = live_part(law, jump);
    const Eigen::Vector2d sticking = multiplier.tail<2>() / law.friction_penalty();
    const bool slides = state_.statuses[p] == ContactStatus::sliding && sticking.norm() > 0.0;
    const Eigen::Vector2d slip = (slides ? std::max(1.0, live.tail<2>().norm() / sticking.norm()) : 1.0) * sticking;
    jumps_.segment(point.first_row + 1, point.rows - 1) = (slip + (jump - live).tail<2>()).head(point.rows - 1);
  }
}

/// Forces of what is much stiffer than the bodies are far less exact than jumps.
void CondensedEquations::let_multipliers_bear_penalties(double stiffness, ContactLaw& law) {
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

ContactLaw CondensedEquations::law_of(std::size_t p) const {
  ContactLaw law = problem_.points[p].law;
  law.friction *= friction_share_;
  law.pointwise = is_nodal_ && !law.weighs_any_pressure;
  if (law.penalised) law.augmentation *= penalty_share_;
  if (law.friction_penalised) law.friction_augmentation *= penalty_share_;
  if (is_nodal_) let_multipliers_bear_penalties(problem_.points[p].stiffness, law);
  if (pressures_by_bodies_ && !law.penalised) law.augmentation = bodies_[p].normal;
  if (shears_by_bodies_ && !law.friction_penalised) law.friction_augmentation = bodies_[p].along;
  return law;
}

ContactLawValue CondensedEquations::law_at(std::size_t p) const {
  const CondensedPoint& point = problem_.points[p];
  return contact_law(law_of(p), state_.statuses[p], multiplier_at(point), jump_at(point));
}

void CondensedEquations::number_unknowns() {
  row_unknowns_.assign(static_cast<std::size_t>(schur_.size()), -1);
  multiplier_unknowns_.assign(static_cast<std::size_t>(problem_.node_count * problem_.components), -1);
  unknown_rows_.clear();
  for (std::size_t p = 0; p < problem_.points.size(); ++p) {
    const CondensedPoint& point = problem_.points[p];
    const bool open = state_.statuses[p] == ContactStatus::open;
    for (int c = 0; c < point.rows && !open; ++c) add_row(point.first_row + c);
    if (open && point.node_count == 1) continue;
    problem_.visit_multipliers(point, [this](int multiplier) { multiplier_unknowns_[multiplier] = 0; });
  }
  for (const CondensedSpring& spring : problem_.springs) add_row(spring.row);
  unknowns_ = static_cast<int>(unknown_rows_.size());
  for (std::size_t i = 0; i < multiplier_unknowns_.size(); ++i) {
    if (multiplier_unknowns_[i] < 0) state_.multipliers[static_cast<Index>(i)] = 0.0;
    if (multiplier_unknowns_[i] == 0) multiplier_unknowns_[i] = unknowns_++;
  }
}

void CondensedEquations::add_row(int row) {
  row_unknowns_[row] = static_cast<int>(unknown_rows_.size());
  unknown_rows_.push_back(row);
}

void CondensedEquations::require_columns() {
  std::vector<int> needed = unknown_rows_;
  for (Index row = 0; row < problem_.held.size(); ++row)
    if (problem_.held[row] != 0.0 || forces_[row] != 0.0) needed.push_back(static_cast<int>(row));
  schur_.require(needed);
}

void CondensedEquations::correct() {
  number_unknowns();
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
  if (problem_.one_step) take_solved_forces(equations.forces() * step);
  for (std::size_t k = 0; k < unknown_rows_.size(); ++k) jumps_[unknown_rows_[k]] -= step[static_cast<Index>(k)];
  for (std::size_t i = 0; i < multiplier_unknowns_.size(); ++i)
    if (multiplier_unknowns_[i] >= 0) state_.multipliers[static_cast<Index>(i)] -= step[multiplier_unknowns_[i]];
}

/// `changes`: by which the step brings those of unknown rows down.
void CondensedEquations::take_solved_forces(const Eigen::VectorXd& changes) {
  solved_forces_ = forces_;
  for (std::size_t k = 0; k < unknown_rows_.size(); ++k)
    solved_forces_[unknown_rows_[k]] -= changes[static_cast<Index>(k)];
}

bool CondensedEquations::correct_at_nodes() {
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
  if (problem_.one_step) take_solved_forces(step.force_changes());
  for (const NodalStep::Change& change : step.multiplier_changes())
    for (int c = 0; c < change.rows; ++c)
      state_.multipliers[problem_.multiplier_index(change.node, c)] -= change.value[c];
  return true;
}

std::optional<Eigen::VectorXd> CondensedEquations::solved(NodalStep& step, const Eigen::VectorXd& balance) {
  const auto count = static_cast<int>(unknown_rows_.size());
  if (count > direct_rows_) {
    NearInverse& near = problem_.near_inverse ? *problem_.near_inverse : own_near_inverse_;
    const auto jumps = step.solve_by_products(
        schur_, balance, near, {.tolerance = product_tolerance, .most_products = problem_.most_products});
    if (jumps || count > problem_.most_direct_rows) return jumps;
  }
  return step.solve(schur_, balance);
}

Eigen::VectorXd CondensedEquations::solved(const InterpolatedStep& equations, const Eigen::VectorXd& balance) {
  InterpolatedSolver& solver = problem_.interpolated_solver ? *problem_.interpolated_solver : own_interpolated_solver_;
  if (static_cast<int>(unknown_rows_.size()) > direct_rows_)
    if (const auto step = solver.solve_by_products(
            equations, schur_, balance, {.tolerance = product_tolerance, .most_products = problem_.most_products}))
      return *step;
  return solver.solve(equations, schur_, balance);
}

Eigen::VectorXd CondensedEquations::unbalanced_jumps() {
  const Eigen::VectorXd balanced = balanced_jumps();
  Eigen::VectorXd result(static_cast<Index>(unknown_rows_.size()));
  for (std::size_t k = 0; k < unknown_rows_.size(); ++k)
    result[static_cast<Index>(k)] = jumps_[unknown_rows_[k]] - balanced[unknown_rows_[k]];
  return result;
}

void CondensedEquations::add_point(std::size_t p, InterpolatedStep& equations, Eigen::VectorXd& balance) {
  const CondensedPoint& point = problem_.points[p];
  const ContactLawValue value = law_at(p);
  for (int c = 0; c < point.rows; ++c) forces_[point.first_row + c] += point.weight * value.traction[c];
  if (state_.statuses[p] != ContactStatus::open) add_traction_derivatives(point, value, equations);
  add_laws(point, value, equations, balance);
}

void CondensedEquations::add_traction_derivatives(const CondensedPoint& point, const ContactLawValue& value,
                                                  InterpolatedStep& equations) const {
  for (int a = 0; a < point.rows; ++a) {
    const int place = row_unknowns_[point.first_row + a];
    for (int b = 0; b < point.rows; ++b)
      equations.add_force_derivative(place, row_unknowns_[point.first_row + b],
                                     point.weight * value.traction_by_jump(a, b));
    for (int i = 0; i < point.node_count; ++i)
      for (int b = 0; b < problem_.components; ++b)
        equations.add_force_derivative(place, multiplier_unknowns_[problem_.multiplier_index(point.nodes[i], b)],
                                       point.weight * point.shape[i] * value.traction_by_multiplier(a, b));
  }
}

void CondensedEquations::add_laws(const CondensedPoint& point, const ContactLawValue& value,
                                  InterpolatedStep& equations, Eigen::VectorXd& balance) const {
  for (int i = 0; i < point.node_count; ++i)
    for (int a = 0; a < point.law_components(); ++a) {
      const int equation = multiplier_unknowns_[problem_.multiplier_index(point.nodes[i], a)];
      if (equation < 0) continue;
      const double weight = point.weight * point.shape[i];
      balance[equation] += weight * value.residual[a];
      equations.add_law_weight(equation, std::abs(weight));
      for (int b = 0; b < point.rows; ++b)
        equations.add_law_derivative(equation, row_unknowns_[point.first_row + b],
                                     weight * value.residual_by_jump(a, b));
      for (int j = 0; j < point.node_count; ++j)
        for (int b = 0; b < problem_.components; ++b)
          equations.add_law_derivative(equation, multiplier_unknowns_[problem_.multiplier_index(point.nodes[j], b)],
                                       weight * point.shape[j] * value.residual_by_multiplier(a, b));
    }
}

Eigen::VectorXd CondensedEquations::balanced_jumps() {
  if (balanced_forces_.size() == forces_.size() && balanced_forces_ == forces_) return balanced_;
  balanced_ = problem_.free + schur_.times(forces_ - problem_.held);
  balanced_forces_ = forces_;
  return balanced_;
}

void CondensedEquations::evaluate() {
  number_unknowns();
  forces_.setZero();
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(state_.multipliers.size());
  LawBalance law{none, none, none, none};
  for (std::size_t p = 0; p < problem_.points.size(); ++p) {
    const CondensedPoint& point = problem_.points[p];
    const ContactLawValue value = law_at(p);
    for (int c = 0; c < point.rows; ++c) forces_[point.first_row + c] += point.weight * value.traction[c];
    for (int i = 0; i < point.node_count; ++i)
      for (int c = 0; c < point.law_components(); ++c) {
        const int index = problem_.multiplier_index(point.nodes[i], c);
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

void CondensedEquations::measure(const LawBalance& law, const Eigen::VectorXd& balanced) {
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

double CondensedEquations::largest_pressure() const {
  double largest = 0.0;
  for (int node = 0; node < problem_.node_count; ++node)
    largest = std::max(largest, std::abs(state_.multipliers[problem_.multiplier_index(node, 0)]));
  return largest;
}

double CondensedEquations::largest_response() const {
  double sum = 0.0;
  double largest_root = 0.0;
  for (Index row = 0; row < forces_.size(); ++row) {
    if (!schur_.known(static_cast<int>(row))) continue;
    const double root = std::sqrt(std::abs(schur_.own(static_cast<int>(row))));
    sum += root * std::max(std::abs(forces_[row]), std::abs(problem_.held[row]));
    largest_root = std::max(largest_root, root);
  }
  return largest_root * sum;
}

Vector3d CondensedEquations::law_rounding(std::size_t p) const {
  const CondensedPoint& point = problem_.points[p];
  Vector3d sums = Vector3d::Zero();
  for (int i = 0; i < point.node_count; ++i)
    for (int c = 0; c < problem_.components; ++c)
      sums[c] += std::abs(point.shape[i] * state_.multipliers[problem_.multiplier_index(point.nodes[i], c)]);
  const ContactLaw law = law_of(p);
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  const double normal = state_.statuses[p] == ContactStatus::open ? epsilon / law.augmentation : 0.0;
  const bool is_slip = state_.statuses[p] == ContactStatus::sticking && law.dead.isZero();
  const double along = is_slip ? 0.0 : epsilon / law.friction_augmentation;
  return {normal * sums[0], along * sums[1], along * sums[2]};
}

double CondensedEquations::law_rounding() const {
  Eigen::VectorXd rounding = Eigen::VectorXd::Zero(state_.multipliers.size()), weight = rounding;
  for (std::size_t p = 0; p < problem_.points.size(); ++p) {
    const CondensedPoint& point = problem_.points[p];
    const Vector3d each = law_rounding(p);
    for (int i = 0; i < point.node_count; ++i)
      for (int c = 0; c < problem_.components; ++c) {
        const double share = point.weight * std::abs(point.shape[i]);
        rounding[problem_.multiplier_index(point.nodes[i], c)] += share * each[c];
        weight[problem_.multiplier_index(point.nodes[i], c)] += share;
      }
  }
  double largest = 0.0;
  for (Index i = 0; i < rounding.size(); ++i)
    if (multiplier_unknowns_[i] >= 0 && weight[i] > 0.0) largest = std::max(largest, rounding[i] / weight[i]);
  return largest;
}

bool CondensedEquations::is_rounding() const {
  if (residual_ <= std::max(stagnation_tolerance * scale_, jump_rounding_share * largest_response())) return true;
  return residual_ <= std::min(law_rounding(), most_law_rounding * scale_);
}

}  // namespace comma::solver
