#include "solver/nonlinear/steps/static_run.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "solver/contact/straight_faces.hpp"
#include "solver/contact/watched_zones.hpp"
#include "solver/elements/slender/rotating_beam.hpp"
#include "solver/error.hpp"
#include "solver/nonlinear/combinations.hpp"
#include "solver/nonlinear/contact/carried_surfaces.hpp"
#include "solver/nonlinear/critical_modes.hpp"
#include "solver/nonlinear/failure.hpp"
#include "solver/nonlinear/iterations/known_displacements.hpp"

namespace comma::solver {
namespace {

using Eigen::Vector3d;

/// Those that conditions hold by elimination alone (AFFE_CHAR_CINE).
std::vector<int> dofs_without_reactions(const std::vector<AppliedLoad>& loads, const DofMap& dofs) {
  std::vector<int> result;
  for (const AppliedLoad& applied : loads) {
    if (applied.load->multipliers_per_relation > 0) continue;
    for (const LinearRelation& relation : applied.load->relations)
      for (const auto& term : relation.terms)
        if (const int dof = dofs.dof(term.node, term.component); dof >= 0) result.push_back(dof);
  }
  return result;
}

}  // namespace

StaticRun::StaticRun(const StaticProblem& problem, const NewtonOptions& options, Result& result, Counters& counters,
                     const IterationObserver& observer, const StepObserver& after_step)
    : problem_(problem),
      after_step_(after_step),
      mesh_(*problem.model->mesh),
      options_(options),
      result_(result),
      counters_(counters),
      dofs_(*problem.model),
      assembler_(*problem.model, *problem.materials, *problem.properties, dofs_, problem.behaviours.get()),
      followers_(*problem.model, dofs_, problem.followers),
      links_(mesh_, dofs_, problem.turning_links),
      elimination_(mesh_, dofs_, all_conditions(Eigen::VectorXd::Zero(dofs_.size()))),
      tangent_(*problem.model, dofs_, assembler_, elimination_, options, counters),
      reference_(*problem.model, dofs_, elimination_, options),
      contact_nodes_(nodes_of_contact()),
      observer_(observer),
      newton_(mesh_, dofs_, assembler_, elimination_, options, counters, tangent_, reference_, support(), observer) {
  const std::vector<int> eliminated = dofs_without_reactions(problem.loads, dofs_);
  newton_.set_eliminated(eliminated);
  if (problem.contact) newton_.use_algorithm(*problem.contact);
  const auto is_penalised = [](const UnilateralCondition& each) { return each.penalty > 0.0; };
  if ((problem.contact && has_stiffness(*problem.contact)) || std::ranges::any_of(problem.unilateral, is_penalised))
    newton_.take_stiffness_of_contact();
  const bool has_bounds = problem.contact || !problem.unilateral.empty();
  takes_plain_tangents_ =
      !has_bounds && followers_.empty() && has_rotating_beams(*problem.model, problem.behaviours.get());
  if (has_bounds || takes_plain_tangents_) tangent_.stay_symmetric();
  if (!followers_.empty()) {
    tangent_.follow(followers_);
    newton_.follow(followers_);
  }
  require_known_combination(problem, options, assembler_, !links_.empty());
  require_carried_surfaces(problem);
  if (!links_.empty()) let_links_turn();
  if (options.path)
    path_ = std::make_unique<PathFollowing>(problem, dofs_, assembler_, elimination_, options, counters, tangent_,
                                            reference_, observer);
  if (path_) path_->set_eliminated(eliminated);
  if (!is_mixed()) return;
  tangent_.allow_springs();
  mixed_ = std::make_unique<MixedContact>(*problem.contact, *problem.model, dofs_, elimination_, tangent_, counters,
                                          support());
  mixed_->set_eliminated(eliminated);
  newton_.attach(mixed_.get());
}

void StaticRun::run(const StepPlan& plan) {
  if (plan.instants.empty()) return;
  begin(plan);
  begin_measuring();
  if (mixed_) mixed_->iterate(contact_iterations());
  StepSequence sequence(plan);
  while (!sequence.finished()) {
    const double from = last_instant_;
    const double instant = sequence.target();
    const std::optional<int> iterations = try_step(instant, sequence);
    if (!iterations) continue;
    newton_.accept_step();
    if (tangent_.is_indefinite() && !takes_plain_tangents_) ++counters_.indefinite_solutions;
    if (mixed_) mixed_->accept_step(from, instant);
    if (path_) path_->accept_step(now_.state.u);
    mixed_ ? mixed_->note_doubts(now_.state.u, doubts_) : newton_.note_doubts(now_.state, doubts_);
    note_doubts_about_surfaces(instant);
    if (problem_.contact && !problem_.contact->stop_on_interpenetration)
      note_interpenetration(*problem_.contact, mesh_, positions(), instant, doubts_);
    archive(instant, *iterations);
    assembler_.accept(now_.state.u);
    begin_measuring();
    const bool unstable = find_modes(instant, ++accepted_);
    speed_ = (now_.state.u - start_) / (instant - from);
    last_instant_ = instant;
    last_duration_ = instant - from;
    sequence.accept(*iterations, watch_->changes());
    if (path_ && path_->has_ended()) return;
    if (unstable && plan.stops_when_unstable)
      throw Error("instability",
                  fmt::format("at INST={:g} the body is unstable, and the computation was asked to stop there "
                              "(EVENEMENT='INSTABILITE', ACTION='ARRET')",
                              instant),
                  "with reuse= the steps up to there are kept; ACTION='CONTINUE' goes on");
  }
  if (mixed_) mixed_->note_loose_bodies(now_.state.u, doubts_);
  if (surface_doubts_) surface_doubts_->conclude(doubts_);
}

void StaticRun::begin(const StepPlan& plan) {
  plan_ = &plan;
  require_watchable(plan, problem_, options_);
  newton_.watch(residual_watch(plan));
  limit_depth(plan.event(StepEventKind::depth));
  watch_.emplace(plan, mesh_);
  start(plan.instants.front());
}

void StaticRun::limit_depth(const StepEvent* event) {
  if (event == nullptr) return;
  if (!mixed_ || !mixed_->penalties().exist())
    throw Error("contradictory-keywords",
                "no contact here has a penalty, and points that go too deep are watched (EVENEMENT='INTERPENETRATION')",
                "take ALGO_CONT='PENALISATION', or leave out the event");
  if (event->most_stiffening) mixed_->limit_depth(event->limit, *event->most_stiffening);
}

void StaticRun::begin_measuring() {
  if (options_.component_residual) reference_.begin_step(assembler_.internal_forces(now_.state.u));
}

bool StaticRun::find_modes(double instant, int accepted) {
  if (!options_.stability || !is_stability_due(*options_.stability, instant, accepted)) return false;
  const StabilityReport report = critical_modes(*options_.stability, options_.tangent.prediction, instant, now_.state.u,
                                                assembler_, elimination_, dofs_);
  if (!report.modes.empty()) {
    const auto smallest =
        std::ranges::min_element(report.modes, {}, [](const CriticalMode& mode) { return std::abs(mode.value); });
    result_.steps.back().parameters["CHAR_CRIT"] = smallest->value;
    result_.steps.back().fields.insert_or_assign("MODE_FLAMB", smallest->shape);
  }
  if (report.unstable && observer_)
    observer_(event_of_step(instant, fmt::format("at {:.6g} the body is unstable", instant)));
  if (options_.stability->report) options_.stability->report(report);
  return report.unstable;
}

void StaticRun::note_doubts_about_surfaces(double instant) {
  if (!problem_.contact || path_ || !now_.paired) return;
  if (!surface_doubts_) surface_doubts_.emplace(*problem_.contact, mesh_);
  const std::vector<Vector3d> now = positions();
  SurfaceState state{
      instant, now, mixed_ ? mixed_->pushed_back(now_.state.u) : newton_.pushed_back(problem_.contact->zones.size()),
      {},      {},  {}};
  if (problem_.contact->geometry_update != GeometryUpdate::automatic)
    state.pairs = [&] { return pairs_solved_with(instant); };
  if (std::ranges::any_of(problem_.contact->zones, [](const ContactZone& zone) { return zone.mixed.local_average; })) {
    state.averages = mixed_->points();
    state.averages_as_is = [&] { return contact_points(*problem_.contact, *problem_.model, now, instant); };
  }
  surface_doubts_->look(state, doubts_);
}

std::vector<ContactPair> StaticRun::pairs_solved_with(double instant) const {
  if (!mixed_) return now_.pairs;
  return pair_surfaces(*problem_.contact, mesh_, positions_at(now_.reference, mesh_, dofs_), instant);
}

std::vector<AppliedLoad> StaticRun::with_contact_relations() const {
  std::vector<AppliedLoad> loads = problem_.loads;
  for (AppliedLoad driven : problem_.driven) {
    driven.multiplier = [this, own = driven.multiplier](double time) { return drive_ * (own ? own(time) : 1.0); };
    loads.push_back(std::move(driven));
  }
  if (!problem_.contact || problem_.contact->formulation == ContactFormulation::mixed) return loads;
  auto ties = std::make_shared<Load>();
  ties->relations = straight_edges(mesh_, dofs_, *problem_.contact);
  if (!ties->relations.empty()) loads.push_back({std::move(ties), {}});
  return loads;
}

std::vector<AppliedLoad> StaticRun::all_conditions(const Eigen::VectorXd& u) const {
  std::vector<AppliedLoad> loads = with_contact_relations();
  if (links_.empty()) return loads;
  auto rigid = std::make_shared<Load>();
  rigid->relations = links_.at(u);
  loads.push_back({std::move(rigid), {}});
  return loads;
}

void StaticRun::let_links_turn() {
  newton_.relinearise({[this](double time, NewtonState& state) { return turn_links(time, state); },
                       [this](const Eigen::VectorXd& u) { return links_.violation(u); }});
}

Eigen::VectorXd StaticRun::turn_links(double time, NewtonState& state) {
  elimination_ = Elimination(mesh_, dofs_, all_conditions(state.u));
  elimination_.measure_from(differential_from_);
  reference_.renumber(elimination_);
  tangent_.forget();
  state.reduced = state.u(elimination_.kept());
  Eigen::VectorXd offset = elimination_.offset(time);
  state.u = elimination_.transformation() * state.reduced + offset;
  return offset;
}

std::vector<int> StaticRun::nodes_of_contact() const {
  std::set<int> nodes;
  if (problem_.contact)
    for (const ContactZone& zone : problem_.contact->zones)
      for (const auto* cells : {&zone.master_cells, &zone.slave_cells})
        for (const int node : mesh_.nodes_of_cells(*cells)) nodes.insert(node);
  return {nodes.begin(), nodes.end()};
}

std::vector<int> StaticRun::support() const {
  std::set<int> nodes(contact_nodes_.begin(), contact_nodes_.end());
  for (const UnilateralCondition& condition : problem_.unilateral)
    nodes.insert(condition.nodes.begin(), condition.nodes.end());
  return unknowns_behind(nodes, dofs_, elimination_);
}

}  // namespace comma::solver
