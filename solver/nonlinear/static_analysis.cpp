#include "solver/nonlinear/static_analysis.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "solver/constraints/turning_links.hpp"
#include "solver/contact/contact_field.hpp"
#include "solver/contact/straight_faces.hpp"
#include "solver/contact/watched_zones.hpp"
#include "solver/error.hpp"
#include "solver/model/deformed_places.hpp"
#include "solver/nonlinear/combinations.hpp"
#include "solver/nonlinear/critical_modes.hpp"
#include "solver/nonlinear/failure.hpp"
#include "solver/nonlinear/geometry_updates.hpp"
#include "solver/nonlinear/known_displacements.hpp"
#include "solver/nonlinear/newton.hpp"
#include "solver/nonlinear/path_following.hpp"
#include "solver/nonlinear/step_watch.hpp"
#include "solver/nonlinear/surface_doubts.hpp"
#include "solver/on_exit.hpp"

namespace comma::solver {
namespace {

using Eigen::Vector3d;

class StaticAnalysis {
 public:
  StaticAnalysis(const StaticProblem& problem, const NewtonOptions& options, Result& result, Counters& counters,
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
    if (problem.contact) newton_.use_algorithm(*problem.contact);
    if (problem.contact || !problem.unilateral.empty()) tangent_.stay_symmetric();
    if (!followers_.empty()) {
      tangent_.follow(followers_);
      newton_.follow(followers_);
    }
    require_known_combination(problem, options, assembler_, !links_.empty());
    if (!links_.empty()) let_links_turn();
    if (options.path) path_ = std::make_unique<PathFollowing>(problem, dofs_, assembler_, elimination_, options, counters, tangent_, reference_, observer);
    if (!is_mixed()) return;
    tangent_.allow_springs();
    mixed_ = std::make_unique<MixedContact>(*problem.contact, *problem.model, dofs_, elimination_, tangent_, counters, support());
    newton_.attach(mixed_.get());
  }

  void run(const StepPlan& plan) {
    if (plan.instants.empty()) return;
    begin(plan);
    begin_measuring();
    if (mixed_) mixed_->iterate_jointly(iterates_jointly());
    StepSequence sequence(plan);
    while (!sequence.finished()) {
      const double from = last_instant_;
      const double instant = sequence.target();
      const std::optional<int> iterations = try_step(instant, sequence);
      if (!iterations) continue;
      newton_.accept_step();
      if (mixed_) mixed_->accept_step(instant - from);
      if (path_) path_->accept_step(now_.state.u);
      mixed_ ? mixed_->note_doubts(now_.state.u, doubts_) : newton_.note_doubts(doubts_);
      note_doubts_about_surfaces(instant);
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
        throw Error("instability", fmt::format("at INST={:g} the body is unstable, and the computation was asked to stop there (EVENEMENT='INSTABILITE', ACTION='ARRET')", instant),
                    "with reuse= the steps up to there are kept; ACTION='CONTINUE' goes on");
    }
    if (surface_doubts_) surface_doubts_->conclude(doubts_);
  }

  /// All that comes before the first step.
  void begin(const StepPlan& plan) {
    plan_ = &plan;
    require_watchable(plan, problem_, options_);
    newton_.watch(residual_watch(plan));
    limit_depth(plan.event(StepEventKind::depth));
    watch_.emplace(plan, mesh_);
    start(plan.instants.front());
  }

  const ContactDoubts& doubts() const { return doubts_; }

 private:
  /// What a step changes before it is accepted.
  struct Progress {
    NewtonState state;
    bool paired = false;
    std::vector<ContactPair> pairs;
    Eigen::VectorXd reference;  ///< u at the last pairing
    ConditionSet conditions;
  };

  /// The number of iterations; nothing when the step has failed, or does what it must not, and is cut. Throws what a step that cannot be cut throws.
  std::optional<int> try_step(double instant, StepSequence& sequence) {
    const Progress before = now_;
    const std::vector<char> closed_before = closed_points();
    watch_->start_step();
    if (mixed_) mixed_->remember();
    try {
      const int iterations = solve_jointly_or_settled(instant, before);
      watch_->check_increment(instant, [&] { return fields_now(instant); });
      if (mixed_) check_depth(plan_->event(StepEventKind::depth), instant, mixed_->penetration(now_.state.u));
      if (!refines_collision(closed_before, sequence)) return iterations;
      return take_again(instant, before, sequence, "meets a change of contact");
    } catch (const Error& error) {
      const StepEvent* event = watch_->event_behind(error.code());
      if (event == nullptr && !is_failure_of_step(error.code())) throw advised(error, problem_);
      if (event ? !event->cutting || !sequence.cut(*event->cutting, watch_->share_of_step()) : !sequence.cut()) {
        if (event) throw;
        return solve_as_last_resort(instant, before, error);
      }
      return take_again(instant, before, sequence, event ? fmt::format("has failed ({})", error.code()) : "has failed");
    }
  }

  std::nullopt_t take_again(double instant, const Progress& before, const StepSequence& sequence, std::string_view why) {
    take_back(before);
    if (observer_) observer_(event_of_step(instant, fmt::format("the step to {:.6g} {} and is cut: on to {:.6g}", instant, why, sequence.target())));
    return std::nullopt;
  }

  /// Which points of contact are closed, one after the other.
  std::vector<char> closed_points() const {
    if (mixed_) return mixed_->closed_points();
    std::vector<char> closed;
    for (const double multiplier : now_.state.multipliers) closed.push_back(multiplier > 0.0);
    return closed;
  }

  /// A step in which points close or open is taken again, shorter, as long as it may be: then it stands.
  bool refines_collision(const std::vector<char>& before, StepSequence& sequence) const {
    const StepEvent* event = plan_->event(StepEventKind::collision);
    if (event == nullptr) return false;
    const std::vector<char> now = closed_points();
    if (before.size() != now.size() || before == now) return false;
    if (event->around) return sequence.refine(*event->around);
    if (event->cutting) return sequence.cut(*event->cutting);
    throw Error("contact-changes", fmt::format("points of contact close or open in the step to t = {:.6g}, and the computation is to stop there", sequence.target()),
                "write ACTION='DECOUPE' to go on in shorter steps");
  }

  /// Whether Newton's method takes statuses and geometry along, as Code_Aster does: figures are then those of the same iterations (ssnv104d, to 2e-12).
  bool iterates_jointly() const { return problem_.contact->joint_iterations && !options_.line_search && mixed_->can_iterate_jointly(); }

  /// Where joint iterations fail, contact is settled within each: at once where the path does not matter, else once the step cannot be cut (ssnv506e).
  int solve_jointly_or_settled(double instant, const Progress& before) {
    try {
      return solve_from_either_side(instant, before);
    } catch (const Error& error) {
      if (!mixed_ || !mixed_->is_joint() || assembler_.has_memory() || !is_failure_of_step(error.code())) throw;
    }
    return solve_settled(instant, before);
  }

  int solve_settled(double instant, const Progress& before) {
    take_back(before);
    if (observer_) observer_(event_of_step(instant, fmt::format("the step to {:.6g} starts again, with contact settled within each iteration", instant)));
    mixed_->iterate_jointly(false);
    const OnExit as_before([&] { mixed_->iterate_jointly(true); });
    return solve_from_either_side(instant, before);
  }

  /// Of a step that cannot be cut.
  int solve_as_last_resort(double instant, const Progress& before, const Error& error) {
    if (!mixed_ || !mixed_->is_joint() || !assembler_.has_memory()) throw advised(error, problem_);
    try {
      return solve_settled(instant, before);
    } catch (const Error& again) {
      throw advised(again, problem_);
    }
  }

  /// A prediction by the tangent leads astray where what flowed is unloaded: such a step is tried again from the elastic side.
  int solve_from_either_side(double instant, const Progress& before) {
    try {
      return solve_and_check(instant);
    } catch (const Error& error) {
      if (mixed_ && error.code() == "contact-cycling" && tangent_.spring_weak_supports()) return solve_on_stiffer_supports(instant, before, error);
      if (const auto iterations = solve_the_other_way(instant, before, error)) return *iterations;
      const bool may_unload = assembler_.has_memory() && options_.tangent.prediction == TangentKind::tangent;
      if (!may_unload || !is_failure_of_step(error.code())) throw;
    }
    take_back(before);
    if (observer_) observer_(event_of_step(instant, fmt::format("the step to {:.6g} has failed and starts again from an elastic prediction", instant)));
    newton_.predict_with(TangentKind::elastic);
    const OnExit as_before([&] { newton_.predict_with(options_.tangent.prediction); });
    return solve_and_check(instant);
  }

  /// Supports so weak that they cost the digits of what contact does stand aside while it is sought.
  int solve_on_stiffer_supports(double instant, const Progress& before, const Error& failure) {
    take_back(before);
    try {
      return solve_from_either_side(instant, before);
    } catch (const Error& error) {
      if (error.code() == "singular-matrix") throw failure;
      throw;
    }
  }

  /// With the solution of the path that was passed over, where the plan says so; nothing where that fails too.
  std::optional<int> solve_the_other_way(double instant, const Progress& before, const Error& failure) {
    if (!path_ || !plan_->tries_other_solution || !is_failure_of_step(failure.code())) return std::nullopt;
    take_back(before);
    if (observer_) observer_(event_of_step(instant, fmt::format("the step to {:.6g} has failed and is tried with the other intensity", instant)));
    path_->take_other_solution(true);
    const OnExit as_before([&] { path_->take_other_solution(false); });
    try {
      return solve_and_check(instant);
    } catch (const Error& error) {
      if (!is_failure_of_step(error.code())) throw;
      return std::nullopt;
    }
  }

  int solve_and_check(double instant) {
    const int iterations = solve_step(instant);
    if (problem_.contact && problem_.contact->stop_on_interpenetration) require_no_interpenetration(*problem_.contact, mesh_, positions(), instant);
    return iterations;
  }

  void take_back(const Progress& before) {
    now_ = before;
    if (!mixed_) return;
    mixed_->restore();
    now_.paired = false;
  }

  void limit_depth(const StepEvent* event) {
    if (event == nullptr) return;
    if (!mixed_ || !mixed_->has_penalties())
      throw Error("contradictory-keywords", "no contact here has a penalty, and points that go too deep are watched (EVENEMENT='INTERPENETRATION')", "take ALGO_CONT='PENALISATION', or leave out the event");
    if (event->most_stiffening) mixed_->limit_depth(event->limit, *event->most_stiffening);
  }

  /// A linear step: what has flowed goes on as it did. What the law makes of it counts from its end on.
  int solve_extrapolated(double time, const Eigen::VectorXd& external, const Eigen::VectorXd& offset) {
    const OnExit as_they_are([&] { assembler_.extrapolate(std::nullopt); });
    assembler_.extrapolate(last_duration_ > 0.0 ? (time - last_instant_) / last_duration_ : 0.0);
    return newton_.solve(time, external, offset, now_.conditions, 0, 0, now_.state);
  }

  bool is_mixed() const { return problem_.contact && is_condensed(*problem_.contact); }

  /// The loads, and the relations that contact faces bring along.
  std::vector<AppliedLoad> with_contact_relations() const {
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

  /// With the relations of rigid bodies at the displacements u.
  std::vector<AppliedLoad> all_conditions(const Eigen::VectorXd& u) const {
    std::vector<AppliedLoad> loads = with_contact_relations();
    if (links_.empty()) return loads;
    auto rigid = std::make_shared<Load>();
    rigid->relations = links_.at(u);
    loads.push_back({std::move(rigid), {}});
    return loads;
  }

  void let_links_turn() {
    newton_.relinearise({[this](double time, NewtonState& state) { return turn_links(time, state); }, [this](const Eigen::VectorXd& u) { return links_.violation(u); }});
  }

  /// The relations of rigid bodies at the state, which then satisfies them as they are linear there; returns the offset.
  Eigen::VectorXd turn_links(double time, NewtonState& state) {
    elimination_ = Elimination(mesh_, dofs_, all_conditions(state.u));
    elimination_.measure_from(differential_from_);
    reference_.renumber(elimination_);
    tangent_.forget();
    state.reduced = state.u(elimination_.kept());
    Eigen::VectorXd offset = elimination_.offset(time);
    state.u = elimination_.transformation() * state.reduced + offset;
    return offset;
  }

  std::vector<int> nodes_of_contact() const {
    std::set<int> nodes;
    if (problem_.contact)
      for (const ContactZone& zone : problem_.contact->zones)
        for (const auto* cells : {&zone.master_cells, &zone.slave_cells})
          for (const int node : mesh_.nodes_of_cells(*cells)) nodes.insert(node);
    return {nodes.begin(), nodes.end()};
  }

  /// The reduced unknowns behind the nodes that conditions speak of.
  std::vector<int> support() const {
    std::set<int> nodes(contact_nodes_.begin(), contact_nodes_.end());
    for (const UnilateralCondition& condition : problem_.unilateral) nodes.insert(condition.nodes.begin(), condition.nodes.end());
    return unknowns_behind(nodes, dofs_, elimination_);
  }

  /// From the initial state, unstressed and undisplaced, or where the result's last step left off.
  void start(double instant) {
    last_instant_ = instant;
    now_.state.u = Eigen::VectorXd::Zero(dofs_.size());
    if (problem_.initial) {
      if (problem_.initial->displacement) take_displacements(*problem_.initial->displacement, dofs_, now_.state.u);
    } else if (!result_.steps.empty()) {
      take_last_step();
    }
    differential_from_ = differential_reference();
    elimination_.measure_from(differential_from_);
    now_.state.reduced = now_.state.u(elimination_.kept());
    assembler_.set_time(instant);
    assembler_.impose_strains(loads_so_far(), instant);
    resume();
    go_on_with_path();
    if (!result_.steps.empty()) {
      watch_->take(result_.steps.back());
      return;
    }
    result_.model = problem_.model;
    ResultStep step;
    step.instant = instant;
    step.fields.emplace("DEPL", displacements());
    step.fields.emplace("SIEF_ELGA", initial_stresses());
    add_internal_variables(step);
    step.parameters["ITER_GLOB"] = 0.0;
    if (path_) step.parameters["ETA_PILOTAGE"] = path_->intensity();
    if (problem_.contact) step.fields.emplace("CONT_NOEU", initial_contact_state(instant));
    add_patch_state(step);
    append(std::move(step));
  }

  /// The next step is measured against the internal forces of the moment.
  void begin_measuring() {
    if (options_.component_residual) reference_.begin_step(assembler_.internal_forces(now_.state.u));
  }

  /// What the conditions of differential loads count from.
  Eigen::VectorXd differential_reference() const {
    Eigen::VectorXd u = now_.state.u;
    if (problem_.initial && problem_.initial->differential_reference) take_displacements(*problem_.initial->differential_reference, dofs_, u);
    return u;
  }

  /// A path that goes on has an intensity and a direction.
  void go_on_with_path() {
    if (!path_ || !problem_.initial) return;
    if (problem_.initial->intensity) path_->set_intensity(*problem_.initial->intensity);
    if (!problem_.initial->earlier) return;
    Eigen::VectorXd u = Eigen::VectorXd::Zero(dofs_.size());
    take_displacements(*problem_.initial->earlier, dofs_, u);
    path_->set_direction(now_.state.u - u);
  }

  void take_last_step() {
    const auto found = result_.steps.back().fields.find("DEPL");
    if (found == result_.steps.back().fields.end())
      throw Error("missing-field", "the result to go on with has no displacement (DEPL) at its last step");
    take_displacements(std::get<NodalField>(found->second), dofs_, now_.state.u);
  }

  /// Puts the unknowns where the step is guessed to end, if anything but where it begins.
  void guess(double time, const Eigen::VectorXd& offset) {
    Eigen::VectorXd u = now_.state.u;
    if (options_.guessed)
      u = displacements_at(time, *options_.guessed, dofs_, now_.state.u);
    else if (options_.guess == StepGuess::extrapolate && speed_.size() == u.size())
      u += (time - last_instant_) * speed_;
    else
      return;
    now_.state.reduced = u(elimination_.kept());
    now_.state.u = elimination_.transformation() * now_.state.reduced + offset;
  }

  void resume() {
    const auto address = [](const auto& field) { return field ? &*field : nullptr; };
    if (problem_.initial)
      assembler_.resume(now_.state.u, address(problem_.initial->stresses), of_memory(address(problem_.initial->variables)));
    else if (!result_.steps.empty())
      assembler_.resume(now_.state.u, field_of_last_step("SIEF_ELGA"), of_memory(field_of_last_step("VARI_ELGA")));
    else
      assembler_.resume(now_.state.u, nullptr, nullptr);
  }

  /// The one variable of elasticity is zero, and says nothing to a law with a memory.
  static const ElementField* of_memory(const ElementField* variables) {
    return variables != nullptr && variables->components.size() > 1 ? variables : nullptr;
  }

  /// Without an initial state the body starts without stress, even where its first temperature is not that of reference.
  ElementField initial_stresses() const {
    ElementField field = assembler_.stresses(now_.state.u);
    for (double& value : field.values)
      if (!problem_.initial && !std::isnan(value)) value = 0.0;
    return field;
  }

  /// Null where the step has it not.
  const ElementField* field_of_last_step(std::string_view name) const {
    const auto& fields = result_.steps.back().fields;
    const auto found = fields.find(name);
    return found == fields.end() ? nullptr : &std::get<ElementField>(found->second);
  }

  void add_internal_variables(ResultStep& step) const {
    step.fields.emplace("VARI_ELGA", assembler_.internal_variables(now_.state.u));
  }

  std::vector<Vector3d> positions() const { return positions_at(now_.state.u, mesh_, dofs_); }

  void note_doubts_about_surfaces(double instant) {
    if (!problem_.contact || path_ || !now_.paired) return;
    if (!surface_doubts_) surface_doubts_.emplace(*problem_.contact, mesh_);
    const std::vector<Vector3d> now = positions();
    SurfaceState state{instant, now, mixed_ ? mixed_->pushed_back() : newton_.pushed_back(), {}, {}, {}};
    if (problem_.contact->geometry_update != GeometryUpdate::automatic) state.pairs = [&] { return pairs_solved_with(instant); };
    if (std::ranges::any_of(problem_.contact->zones, [](const ContactZone& zone) { return zone.mixed.local_average; })) {
      state.averages = mixed_->points();
      state.averages_as_is = [&] { return contact_points(*problem_.contact, *problem_.model, now, instant); };
    }
    surface_doubts_->look(state, doubts_);
  }

  std::vector<ContactPair> pairs_solved_with(double instant) const {
    if (!mixed_) return now_.pairs;
    return pair_surfaces(*problem_.contact, mesh_, positions_at(now_.reference, mesh_, dofs_), instant);
  }

  std::span<const AppliedLoad> loads_so_far() const {
    if (problem_.initial) return problem_.initial->loads;
    return result_.steps.empty() ? std::span<const AppliedLoad>() : problem_.loads;
  }

  /// What the intensity multiplies, and what it does not.
  DrivenLoads driven_loads(double time) {
    DrivenLoads loads;
    loads.fixed = assembler_.external_forces(problem_.loads, time);
    // A law with a memory knows no strains but those that do not depend on the intensity: others are refused.
    assembler_.impose_strains({}, time);
    loads.driven = assembler_.external_forces(problem_.driven, time);
    assembler_.impose_strains(problem_.loads, time);
    drive_ = 0.0;
    loads.fixed_offset = elimination_.offset(time);
    drive_ = 1.0;
    loads.driven_offset = elimination_.offset(time) - loads.fixed_offset;
    return loads;
  }

  int solve_step(double time) {
    assembler_.set_time(time);
    assembler_.impose_strains(problem_.loads, time);
    followers_.set_time(time);
    newton_.start_step(time - last_instant_);
    if (path_) {
      start_ = now_.state.u;
      return path_->solve(time, time - last_instant_, driven_loads(time), now_.state.reduced, now_.state.u);
    }
    const Eigen::VectorXd external = assembler_.external_forces(problem_.loads, time);
    if (!links_.empty()) turn_links(last_instant_, now_.state);
    const Eigen::VectorXd offset = elimination_.offset(time);
    const bool updates = problem_.contact && problem_.contact->geometry_update != GeometryUpdate::none;
    if (mixed_) mixed_->start_step(now_.state.u, time - last_instant_);
    start_ = now_.state.u;
    guess(time, offset);
    const bool is_weak = problem_.contact && problem_.contact->formulation == ContactFormulation::mixed;
    if (options_.extrapolates_flow) {
      now_.conditions = make_conditions({}, {}, mesh_, dofs_, time);
      return solve_extrapolated(time, external, offset);
    }
    int iterations = 0;
    std::optional<GeometryUpdates> geometry;
    if (updates) geometry.emplace(*problem_.contact, mesh_, dofs_, start_);
    for (int update = 0;; ++update) {
      if (updates || !now_.paired || (update == 0 && thickness_changes())) pair(time, update == 0 ? start_ : now_.state.u, geometry ? &*geometry : nullptr);
      ConditionSet next = make_conditions(now_.pairs, problem_.unilateral, mesh_, dofs_, time);
      if (update == 0 || mixed_ || !same_rows(next, now_.conditions)) {
        resize_multipliers(next);
        now_.conditions = std::move(next);
        // Between updates of the geometry the discrete formulation goes on counting, the mixed one begins again (ssnv504f, ssnv504j).
        const int earlier = is_weak ? 0 : iterations;
        const auto balance = [&] { return newton_.solve(time, external, offset, now_.conditions, earlier, active_set_limit(), now_.state); };
        iterations = earlier + balance();
        while (mixed_ && mixed_->stiffen_penalties(now_.state.u)) {
          if (observer_) observer_(event_of_step(time, "contact is deeper, or slips by more, than allowed: its penalty is raised"));
          iterations += balance();
        }
      }
      const bool at_rest = !geometry || geometry->settled(now_.reference, now_.state.u);
      const bool settled = at_rest || (mixed_ && mixed_->is_joint());
      if (settled && !(mixed_ && mixed_->leaves_overlap(now_.state.u))) {
        if (geometry) geometry->note_doubts(now_.pairs, mixed_ ? mixed_->points() : std::vector<ContactPoint>(), doubts_);
        return iterations;
      }
      if (!geometry) continue;
      geometry->note_cycle(now_.pairs);
      geometry->require_more(time);
    }
  }

  void resize_multipliers(const ConditionSet& next) {
    if (now_.state.multipliers.size() != next.slot_count) now_.state.multipliers = Eigen::VectorXd::Zero(next.slot_count);
    // A slot that has lost its row holds nothing any more.
    Eigen::VectorXd kept = Eigen::VectorXd::Zero(next.slot_count);
    for (const int slot : next.row_slots) kept[slot] = now_.state.multipliers[slot];
    now_.state.multipliers = std::move(kept);
  }

  /// ITER_CONT_MULT changes a condition; unilateral conditions alone need no user's word on it.
  int active_set_limit() const {
    constexpr int generous = 30;
    const int factor = problem_.contact ? std::max(1, problem_.contact->active_set_factor) : generous;
    return factor * std::max(1, now_.conditions.slot_count);
  }

  /// Whether surfaces that face each other for good have gaps that change nevertheless.
  bool thickness_changes() const {
    return problem_.contact && std::ranges::any_of(problem_.contact->zones, [](const ContactZone& zone) { return zone.thickness_changes; });
  }

  /// The surfaces as the displacements `u` have them: at first those with which the step begins, whatever is guessed of its end.
  void pair(double time, const Eigen::VectorXd& u, GeometryUpdates* updates) {
    now_.paired = true;
    if (!problem_.contact) return;
    // Without updates surfaces face each other as the mesh has them, wherever the computation goes on from (U4.44.11).
    if (problem_.contact->geometry_update == GeometryUpdate::none) now_.reference = Eigen::VectorXd::Zero(u.size());
    else now_.reference = updates ? updates->relaxed(now_.reference, u) : u;
    const double margin = updates ? updates->margin() : 0.0;
    const std::vector<Vector3d> places = positions_at(now_.reference, mesh_, dofs_);
    if (mixed_) {
      mixed_->pair(places, time, margin);
    } else {
      now_.pairs = pair_surfaces(*problem_.contact, mesh_, places, time, faced_facets(now_.pairs, margin));
      ++counters_.pairings;
    }
  }

  /// The multipliers of the mixed formulation are unknowns beside them.
  NodalField displacements() const {
    NodalField field = to_field(now_.state.u, dofs_, "DEPL_R");
    if (mixed_) mixed_->add_multipliers(field);
    return field;
  }

  /// Displacements, stresses and internal variables.
  ResultStep fields_now(double instant) const {
    ResultStep step;
    step.order = result_.steps.back().order + 1;
    step.instant = instant;
    step.fields.emplace("DEPL", displacements());
    step.fields.emplace("SIEF_ELGA", assembler_.stresses(now_.state.u, problem_.loads, instant));
    add_internal_variables(step);
    return step;
  }

  void archive(double instant, int iterations) {
    ResultStep step = fields_now(instant);
    if (problem_.contact) step.fields.emplace("CONT_NOEU", contact_state());
    add_patch_state(step);
    step.parameters["ITER_GLOB"] = iterations;
    if (path_) step.parameters["ETA_PILOTAGE"] = path_->intensity();
    append(std::move(step));
  }

  /// After a converged step, where they are asked for: whether they tell of an instability.
  bool find_modes(double instant, int accepted) {
    if (!options_.stability || !is_stability_due(*options_.stability, instant, accepted)) return false;
    const StabilityReport report = critical_modes(*options_.stability, instant, now_.state.u, assembler_, elimination_, dofs_);
    if (!report.modes.empty()) {
      const auto smallest = std::ranges::min_element(report.modes, {}, [](const CriticalMode& mode) { return std::abs(mode.value); });
      result_.steps.back().parameters["CHAR_CRIT"] = smallest->value;
      result_.steps.back().fields.insert_or_assign("MODE_FLAMB", smallest->shape);
    }
    if (report.unstable && observer_) observer_(event_of_step(instant, fmt::format("at {:.6g} the body is unstable", instant)));
    if (options_.stability->report) options_.stability->report(report);
    return report.unstable;
  }

  /// What looks on may take fields away.
  void append(ResultStep step) {
    watch_->take(step);
    result_.steps.push_back(std::move(step));
    if (after_step_) after_step_(result_);
  }

  /// How the surfaces stand before anything presses.
  NodalField initial_contact_state(double instant) {
    pair(instant, now_.state.u, nullptr);
    now_.conditions = make_conditions(now_.pairs, problem_.unilateral, mesh_, dofs_, instant);
    resize_multipliers(now_.conditions);
    return contact_state();
  }

  void add_patch_state(ResultStep& step) const {
    if (!mixed_) return;
    if (auto state = mixed_->patch_state(now_.state.u)) step.fields.emplace("CONT_ELEM", *std::move(state));
  }

  NodalField contact_state() const {
    if (mixed_) return mixed_->contact_state(now_.state.u, positions());
    const Eigen::VectorXd slack = now_.conditions.full.bounds - now_.conditions.full.rows * now_.state.u;
    std::vector<double> gaps(now_.conditions.pairs.size(), absent);
    for (std::size_t row = 0; row < now_.conditions.row_slots.size(); ++row) {
      const int slot = now_.conditions.row_slots[row];
      if (slot < static_cast<int>(gaps.size())) gaps[slot] = slack[static_cast<Eigen::Index>(row)];
    }
    const std::vector<Vector3d> now = positions();
    std::vector<ContactPair> pairs = now_.conditions.pairs;
    for (const auto& [k, pair] : watched_pairs(*problem_.contact, mesh_, now)) {
      pairs[k] = pair;
      gaps[k] = surface_gap(pair, mesh_, now);
    }
    return contact_field(pairs, gaps, now_.state.multipliers, mesh_.node_count(), now);
  }

  const StaticProblem& problem_;
  const StepObserver& after_step_;
  const Mesh& mesh_;
  const NewtonOptions& options_;
  Result& result_;
  Counters& counters_;
  double drive_ = 1.0;  ///< what multiplies driven conditions on displacements while offsets are taken
  DofMap dofs_;
  Assembler assembler_;
  FollowerForces followers_;
  TurningLinks links_;
  Elimination elimination_;
  Eigen::VectorXd differential_from_;  ///< what differential conditions count from
  TangentSystem tangent_;
  ReferenceForces reference_;
  std::vector<int> contact_nodes_;
  const IterationObserver& observer_;
  NewtonSolver newton_;
  std::unique_ptr<MixedContact> mixed_;
  std::unique_ptr<PathFollowing> path_;

  Progress now_;
  std::optional<SurfaceDoubts> surface_doubts_;
  ContactDoubts doubts_;
  Eigen::VectorXd start_;  ///< u at the beginning of the step
  Eigen::VectorXd speed_;  ///< change of u over time in the last step; empty before the first
  int accepted_ = 0;  ///< steps
  double last_instant_ = 0.0;
  double last_duration_ = 0.0;  ///< of the last accepted step; 0 before
  const StepPlan* plan_ = nullptr;
  std::optional<StepWatch> watch_;
};

}  // namespace

void require_solvable(const StaticProblem& problem, const StepPlan& plan, const NewtonOptions& options) {
  Result result;
  Counters counters;
  StaticAnalysis(problem, options, result, counters, {}, {}).begin(plan);
}

ContactDoubts solve_static(const StaticProblem& problem, const StepPlan& plan, const NewtonOptions& options,
                           Result& result, Counters& counters, const IterationObserver& observer, const StepObserver& after_step) {
  StaticAnalysis analysis(problem, options, result, counters, observer, after_step);
  analysis.run(plan);
  return analysis.doubts();
}

}  // namespace comma::solver
