#include "solver/nonlinear/iterations/path_following.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "solver/error.hpp"
#include "solver/linear/largest_component.hpp"
#include "solver/nonlinear/failure.hpp"
#include "solver/nonlinear/iterations/line_search.hpp"

namespace comma::solver {
namespace {

using Eigen::VectorXd;

/// An intensity moves nothing where it moves the controlled displacements by less than this share of what it moves at
/// most.
constexpr double no_influence = 1e-12;
/// Intensities that differ by less than this share are one.
constexpr double same_intensity = 1e-12;
/// Increments whose lengths differ by less than this share are equally long: a converged step leaves residuals of some
/// 1e-6 of the loads.
constexpr double same_length = 1e-5;

std::vector<AppliedLoad> relations_of(const StaticProblem& problem) {
  std::vector<AppliedLoad> loads = problem.loads;
  loads.insert(loads.end(), problem.driven.begin(), problem.driven.end());
  return loads;
}

/// Of one or two.
double other_of(const std::vector<double>& choice, double taken) {
  return choice.front() == taken ? choice.back() : choice.front();
}

}  // namespace

PathFollowing::PathFollowing(const StaticProblem& problem, const DofMap& dofs, const Assembler& assembler,
                             const Elimination& elimination, const NewtonOptions& options, Counters& counters,
                             TangentSystem& tangent, const ReferenceForces& reference,
                             const IterationObserver& observer)
    : problem_(problem),
      mesh_(*problem.model->mesh),
      dofs_(dofs),
      assembler_(assembler),
      elimination_(elimination),
      options_(options),
      control_(*options.path),
      counters_(counters),
      tangent_(tangent),
      observer_(observer),
      criterion_(options),
      reference_(reference),
      held_(elimination, tangent),
      relation_multipliers_(
          dofs, control_.choice == PathChoice::smallest_angle ? relations_of(problem) : std::vector<AppliedLoad>()) {
  multipliers_start_ = VectorXd::Zero(relation_multipliers_.size());
  if (control_.measure != PathMeasure::elastic_prediction && control_.measure != PathMeasure::strain)
    number_controlled();
}

void PathFollowing::number_controlled() {
  std::vector<int> nodes = control_.nodes;
  const bool all = nodes.empty();
  if (all)
    for (int node = 0; node < mesh_.node_count(); ++node) nodes.push_back(node);
  for (const int node : nodes)
    for (const Component component : control_.components) {
      controlled_nodes_ += component == control_.components.front() ? 1 : 0;
      const int dof = dofs_.dof(node, component);
      if (dof >= 0)
        controlled_.push_back(dof);
      else if (!all)
        throw Error("unknown-dof",
                    fmt::format("node {} carries no {}, which the path is to control", mesh_.node_name(node),
                                name_of(component)),
                    "control a component that the node has");
    }
  if (controlled_.empty())
    throw Error("unknown-dof", "no node carries a component that the path is to control", "name others");
}

int PathFollowing::solve(double time, double duration, const DrivenLoads& loads, bool is_last_resort, VectorXd& q,
                         VectorXd& u) {
  time_ = time;
  start_ = u;
  variable_forces_ = assembler_.variable_forces();
  weights_.take(assembler_, elimination_);
  intensity_ = accepted_;
  ended_ = false;
  if (control_.measure == PathMeasure::elastic_prediction)
    prediction_ = std::make_unique<ElasticPrediction>(problem_, dofs_, assembler_, control_.cells, start_);
  if (control_.measure == PathMeasure::strain)
    strains_ = std::make_unique<StrainControl>(problem_, dofs_, assembler_, control_.cells, start_);
  const VectorXd reduced = q;
  passed_over_nearest_ = false;
  try {
    return iterate(false, duration / control_.scale, loads, q, u);
  } catch (const Error& error) {
    if (!is_last_resort || !passed_over_nearest_ ||
        (error.code() != "no-convergence" && error.code() != "integration-failure"))
      throw;
  }
  q = reduced;
  u = start_;
  intensity_ = accepted_;
  tell("step fails: again with the intensity nearest from iteration to iteration");
  return iterate(true, duration / control_.scale, loads, q, u);
}

int PathFollowing::iterate(bool stays, double wanted, const DrivenLoads& loads, VectorXd& q, VectorXd& u) {
  std::vector<IterationReport> history;
  for (int iteration = 1; iteration <= std::max(1, options_.max_iterations); ++iteration) {
    ++counters_.newton_iterations;
    Correction change = correction(iteration, loads, q, u);
    taking_ = iteration == 1 ? Taking::first : stays ? Taking::nearest : Taking::best;
    if (options_.line_search && iteration > 1) shorten(wanted, loads, u, change);
    intensity_ = chosen(candidates(wanted, change, u), change, loads, u);
    u += change.constant + intensity_ * change.linear;
    multipliers_ = change.multipliers.constant + intensity_ * change.multipliers.linear;
    q = u(elimination_.kept());
    u = elimination_.transformation() * q + loads.fixed_offset + intensity_ * loads.driven_offset;
    take_reactions(intensity_, change, loads);
    evaluate(intensity_, loads, u);
    const VectorXd left = held_.imbalance(balance_);
    const auto measure = comma::solver::measure(criterion_, reference_, weights_, {residual_, left}, load_);
    history.push_back(report(iteration, measure));
    if (observer_) observer_(history.back());
    if (measure.converged) {
      ended_ = intensity_ <= control_.least || intensity_ >= control_.most;
      return iteration;
    }
    if (!std::isfinite(measure.absolute)) break;
  }
  if (stands_unconverged(options_, history)) return history.back().iteration;
  throw_no_convergence(
      time_, history, options_,
      {.is_linear = tangent_.is_constant(), .is_elastic = options_.tangent.correction == TangentKind::elastic});
}

void PathFollowing::accept_step(const VectorXd& u) {
  last_step_ = motions(u - start_);
  multipliers_start_ = multipliers_;
  accepted_ = intensity_;
  criterion_.accept(load_);
  ++steps_;
  tell(fmt::format("driven loads have the intensity {:.8g}{}", intensity_,
                   ended_ ? ", the bound: the computation ends" : ""));
}

void PathFollowing::tell(const std::string& text) const {
  if (!observer_) return;
  IterationReport event;
  event.instant = time_;
  event.event = text;
  observer_(event);
}

/// With what the conditions on displacements move as a correction from where the nodes are.
PathFollowing::Correction PathFollowing::correction(int iteration, const DrivenLoads& loads, const VectorXd& q,
                                                    const VectorXd& u) {
  const TangentKind kind = iteration == 1 ? at_start(options_.tangent.prediction) : options_.tangent.correction;
  if (is_tangent_due(options_.tangent, tangent_, iteration, steps_)) tangent_.refresh(u, kind);
  const VectorXd moved = elimination_.transformation() * q + loads.fixed_offset - u;
  const auto& t = elimination_.transformation();
  const VectorXd held = iteration == 1 ? assembler_.starting_forces(u) : assembler_.internal_forces(u);
  Eigen::MatrixXd columns(elimination_.reduced_size(), 2);
  columns.col(0) = t.transpose() * (loads.fixed - held);
  columns.col(1) = t.transpose() * loads.driven;
  if (!moved.isZero(0.0)) columns.col(0) -= tangent_.reduced_forces(u, moved, kind);
  if (!loads.driven_offset.isZero(0.0)) columns.col(1) -= tangent_.reduced_forces(u, loads.driven_offset, kind);
  if (columns.size()) tangent_.solve(columns);
  Correction change{t * columns.col(0) + moved, t * columns.col(1) + loads.driven_offset, {}, held};
  if (!relation_multipliers_.empty()) {
    Eigen::MatrixXd whole(u.size(), 2);
    whole << change.constant, change.linear;
    const Eigen::MatrixXd forces = tangent_.forces(u, whole, kind);
    change.multipliers = {relation_multipliers_.of(forces.col(0) + held - loads.fixed),
                          relation_multipliers_.of(forces.col(1) - loads.driven)};
  }
  return change;
}

/// Takes the share of the correction at which the residual does no more work on it; each share has an intensity of its
/// own.
void PathFollowing::shorten(double wanted, const DrivenLoads& loads, const VectorXd& u, Correction& change) {
  if (!loads.driven_offset.isZero(0.0))
    throw Error("unsupported",
                "a line search along the path needs driven loads that are forces, not imposed displacements",
                "leave out RECH_LINEAIRE");
  const Correction whole = change;
  const auto direction = [&]() -> VectorXd {
    const VectorXd full = whole.constant + intensity_ * whole.linear;
    return full(elimination_.kept());
  };
  const auto work = [&](double share) {
    change = {share * whole.constant, share * whole.linear, whole.multipliers, whole.internal};
    intensity_ = chosen(candidates(wanted, change, u), change, loads, u);
    evaluate(intensity_, loads, u + change.constant + intensity_ * change.linear);
    return direction().dot(residual_);
  };
  const double start = direction().dot(residual_);
  const double share = search_line(*options_.line_search, start, work);
  change = {share * whole.constant, share * whole.linear, whole.multipliers, whole.internal};
}

VectorXd PathFollowing::controlled(const VectorXd& u) const {
  VectorXd values(static_cast<Eigen::Index>(controlled_.size()));
  for (std::size_t i = 0; i < controlled_.size(); ++i) values[static_cast<Eigen::Index>(i)] = u[controlled_[i]];
  return values;
}

/// Intensities that give the increment of the step the measure that is wanted.
std::vector<double> PathFollowing::candidates(double wanted, const Correction& change, const VectorXd& u) const {
  const VectorXd constant = u - start_ + change.constant;
  switch (control_.measure) {
    case PathMeasure::displacement:
      return by_displacement(wanted, constant, change.linear);
    case PathMeasure::arc_length:
      return by_arc_length(wanted, constant, change.linear);
    case PathMeasure::strain:
      return strains_->intensities(wanted, constant, change.linear);
    case PathMeasure::elastic_prediction:
      return prediction_->intensities(wanted, constant, change.linear);
  }
  return {};
}

/// Displacements without the pressures and swellings of mixed elements, whose sizes are others.
VectorXd PathFollowing::motions(VectorXd u) const {
  if (!tangent_.is_saddle()) return u;
  for (int dof = 0; dof < dofs_.size(); ++dof)
    if (static_cast<int>(dofs_.component_of(dof)) >= motion_count) u[dof] = 0.0;
  return u;
}

std::vector<double> PathFollowing::by_displacement(double wanted, const VectorXd& constant,
                                                   const VectorXd& linear) const {
  const double slope = controlled(linear).sum();
  if (!(std::abs(slope) > no_influence * largest_component(motions(linear)))) return {};
  return {(wanted - controlled(constant).sum()) / slope};
}

/// |a + x b|^2 / n = wanted^2, n the number of nodes.
std::vector<double> PathFollowing::by_arc_length(double wanted, const VectorXd& constant,
                                                 const VectorXd& linear) const {
  const VectorXd a = controlled(constant);
  const VectorXd b = controlled(linear);
  const auto count = static_cast<double>(controlled_nodes_);
  const double square = b.squaredNorm();
  if (!(std::sqrt(square) > no_influence * largest_component(motions(linear)))) return {};
  const double middle = -a.dot(b) / square;
  const double apart = middle * middle - (a.squaredNorm() - count * wanted * wanted) / square;
  if (apart < 0.0) return {};
  return {middle - std::sqrt(apart), middle + std::sqrt(apart)};
}

double PathFollowing::bounded(double intensity) const {
  return control_.stops_at_bound ? std::clamp(intensity, control_.least, control_.most) : intensity;
}

std::vector<double> PathFollowing::admitted(const std::vector<double>& found) const {
  std::vector<double> admitted;
  for (const double each : found) {
    const double margin = same_intensity * std::max(std::abs(each), std::abs(accepted_));
    const bool turns = (control_.grows && each < accepted_ - margin) || (control_.falls && each > accepted_ + margin);
    if (!turns && each >= control_.least_sought && each <= control_.most_sought) admitted.push_back(bounded(each));
  }
  if (admitted.empty())
    throw Error(
        "no-convergence",
        fmt::format("at t = {:.6g} {} gives the increment that the path is to have{}", time_,
                    found.empty() ? "no intensity of the driven loads" : "no admitted intensity of the driven loads",
                    found.empty() ? ""
                                  : fmt::format(" ({:.6g}{} would)", found.front(),
                                                found.size() > 1 ? fmt::format(" or {:.6g}", found.back()) : "")),
        "take shorter steps, or a larger COEF_MULT, or control another displacement");
  return admitted;
}

/// The one of the intensities found that the user admits and asks for, or that iterations which are to stay near reach
/// first.
double PathFollowing::chosen(const std::vector<double>& found, const Correction& change, const DrivenLoads& loads,
                             const VectorXd& u) {
  const std::vector<double> choice = admitted(found);
  const double nearest =
      *std::ranges::min_element(choice, {}, [&](double each) { return std::abs(each - intensity_); });
  if (taking_ == Taking::nearest) return nearest;
  double taken = best_of(control_.choice, choice, change, loads, u);
  if (turns_back_by_rounding(choice, change, u, taken)) taken = other_of(choice, taken);
  if (takes_other_) taken = other_of(choice, taken);
  if (taking_ == Taking::best && taken != nearest) passed_over_nearest_ = true;
  return taken;
}

/// The smaller, the better; of equals the larger intensity. Without a step before there is no angle, and all are equal.
double PathFollowing::cost(PathChoice by, double intensity, const Correction& change, const DrivenLoads& loads,
                           const VectorXd& u) {
  if (by == PathChoice::smallest_residual) return residual_or_infinity(intensity, change, loads, u);
  if (by == PathChoice::smallest_increment) return increment(intensity, change, u).norm();
  return knows_direction() ? -advance(intensity, change, u) : 0.0;
}

VectorXd PathFollowing::increment(double intensity, const Correction& change, const VectorXd& u) const {
  return motions(u - start_ + change.constant + intensity * change.linear);
}

bool PathFollowing::knows_direction() const { return last_step_.size() && !last_step_.isZero(0.0); }

/// How far the increment goes on in the direction of the last step, in units of the last step, for one of length 1.
/// In that length multipliers count as displacements do.
double PathFollowing::advance(double intensity, const Correction& change, const VectorXd& u) const {
  const VectorXd own = increment(intensity, change, u);
  double length = own.norm();
  if (!relation_multipliers_.empty())
    length = std::hypot(
        length, (change.multipliers.constant + intensity * change.multipliers.linear - multipliers_start_).norm());
  return own.dot(last_step_) / std::max(length, std::numeric_limits<double>::min());
}

/// By residuals where they differ much, else by lengths.
double PathFollowing::clearly_best_of(const std::vector<double>& choice, const Correction& change,
                                      const DrivenLoads& loads, const VectorXd& u) {
  constexpr double clear_share = 0.1;
  const double first = cost(PathChoice::smallest_residual, choice.front(), change, loads, u);
  const double last = cost(PathChoice::smallest_residual, choice.back(), change, loads, u);
  if (first < clear_share * last) return choice.front();
  if (last < clear_share * first) return choice.back();
  return best_of(PathChoice::smallest_increment, choice, change, loads, u);
}

double PathFollowing::best_of(PathChoice by, const std::vector<double>& choice, const Correction& change,
                              const DrivenLoads& loads, const VectorXd& u) {
  if (choice.size() == 1) return choice.front();
  if (by == PathChoice::clear_residual) return clearly_best_of(choice, change, loads, u);
  double best = choice.back();
  double least = cost(by, best, change, loads, u);
  for (std::size_t i = 0; i + 1 < choice.size(); ++i) {
    const double own = cost(by, choice[i], change, loads, u);
    if (own < least * (least > 0.0 ? 1.0 - same_intensity : 1.0 + same_intensity)) {
      best = choice[i];
      least = own;
    }
  }
  return best;
}

/// From where the body is in balance an increment and its opposite are equally long but for what the last step has
/// left: it goes on.
bool PathFollowing::turns_back_by_rounding(const std::vector<double>& choice, const Correction& change,
                                           const VectorXd& u, double best) const {
  if (control_.choice != PathChoice::smallest_increment || taking_ != Taking::first || choice.size() != 2 ||
      !knows_direction())
    return false;
  const double other = other_of(choice, best);
  return increment(other, change, u).norm() < (1.0 + same_length) * increment(best, change, u).norm() &&
         advance(other, change, u) > 0.0 && advance(best, change, u) < 0.0;
}

/// Where the body cannot be, no residual is larger.
double PathFollowing::residual_or_infinity(double intensity, const Correction& change, const DrivenLoads& loads,
                                           const VectorXd& u) {
  try {
    take_reactions(intensity, change, loads);
    evaluate(intensity, loads, u + change.constant + intensity * change.linear);
    return largest_of({largest_component(residual_), largest_component(held_.imbalance(balance_))});
  } catch (const Error& error) {
    if (error.code() != "integration-failure") throw;
    return std::numeric_limits<double>::infinity();
  }
}

void PathFollowing::evaluate(double intensity, const DrivenLoads& loads, const VectorXd& u) {
  const VectorXd forces = loads.fixed + intensity * loads.driven;
  const VectorXd internal = assembler_.internal_forces(u);
  balance_ = forces - internal;
  residual_ = elimination_.transformation().transpose() * balance_;
  load_ = held_.are_known() ? held_.load_size(weights_, forces, internal, variable_forces_)
                            : weights_.load_size(forces, internal, variable_forces_);
}

/// Those of the linear solve with that intensity.
void PathFollowing::take_reactions(double intensity, const Correction& change, const DrivenLoads& loads) {
  if (tangent_.is_constant()) return;
  const VectorXd balance = loads.fixed + intensity * loads.driven - change.internal;
  held_.take(held_.of(balance, change.constant + intensity * change.linear), 1.0);
}

IterationReport PathFollowing::report(int iteration, const ConvergenceCriterion::Measure& measure) const {
  IterationReport line;
  line.instant = time_;
  line.iteration = iteration;
  line.relative_residual = measure.relative;
  line.absolute_residual = measure.absolute;
  line.worst = worst_place(residual_, elimination_, dofs_, mesh_);
  return line;
}

}  // namespace comma::solver
