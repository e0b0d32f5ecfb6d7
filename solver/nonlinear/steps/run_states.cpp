// The part of StaticRun that reads the state it begins with, and writes the states it reaches.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "solver/contact/contact_field.hpp"
#include "solver/contact/straight_faces.hpp"
#include "solver/contact/watched_zones.hpp"
#include "solver/error.hpp"
#include "solver/fields/data/field_algebra.hpp"
#include "solver/nonlinear/contact/mixed_contact_fields.hpp"
#include "solver/nonlinear/iterations/known_displacements.hpp"
#include "solver/nonlinear/steps/static_run.hpp"

namespace comma::solver {

using Eigen::Vector3d;

void StaticRun::start(double instant) {
  last_instant_ = instant;
  now_.state.u = Eigen::VectorXd::Zero(dofs_.size());
  if (problem_.initial) {
    if (problem_.initial->displacement) take_displacements(*problem_.initial->displacement, dofs_, now_.state.u);
  } else if (!result_.steps.empty()) {
    take_last_step();
  }
  began_at_ = now_.state.u;
  differential_from_ = differential_reference();
  elimination_.measure_from(differential_from_);
  now_.state.reduced = now_.state.u(elimination_.kept());
  assembler_.set_time(instant);
  assembler_.impose_strains(loads_so_far(), instant);
  resume();
  if (options_.note_unused_stresses && problem_.initial && problem_.initial->stresses)
    note_unused_stresses(*problem_.initial->stresses);
  if (problem_.initial || !result_.steps.empty())
    newton_.begin_with(assembler_.external_forces(loads_so_far(), instant), assembler_.internal_forces(now_.state.u));
  if (mixed_) mixed_->begin_at(now_.state.u, contact_so_far());
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
  if (problem_.contact) {
    pair_initially(instant);
    std::vector<int> slaves;
    const bool is_discrete = problem_.contact->formulation == ContactFormulation::discrete;
    for (const ContactZone& zone : problem_.contact->zones) {
      const auto nodes = is_discrete ? contact_nodes(mesh_, zone) : mesh_.nodes_of_cells(zone.slave_cells);
      slaves.insert(slaves.end(), nodes.begin(), nodes.end());
    }
    step.fields.emplace("CONT_NOEU", untouched_field(slaves, mesh_.node_count()));
  }
  add_patch_state(step);
  if (problem_.initial) keep_given(*problem_.initial, step);
  append(std::move(step));
}

/// What is given is the state itself, not what the laws would make of it now.
void StaticRun::keep_given(const InitialState& given, ResultStep& step) const {
  if (given.stresses) take_common_values(step.fields.at("SIEF_ELGA"), *given.stresses);
  if (const ElementField* variables = given.variables ? of_memory(&*given.variables) : nullptr)
    take_common_values(step.fields.at("VARI_ELGA"), *variables);
  else if (given.stresses)
    for (double& value : std::get<ElementField>(step.fields.at("VARI_ELGA")).values)
      if (!std::isnan(value)) value = 0.0;
  if (given.displacement) take_common_values(step.fields.at("DEPL"), *given.displacement);  // multipliers too
  if (given.contact_fields.empty()) return;
  for (const auto& [name, field] : given.contact_fields)
    if (name != "CONT_NOEU") step.fields.insert_or_assign(name, field);
  step.contact = given.contact;
}

// SIP is no stress of the law. With the swelling as an unknown the pressure follows from the law; with the pressure
// alone it stays what it is, and is the mean of the stresses.
void StaticRun::note_unused_stresses(const ElementField& given) const {
  const ElementField taken = assembler_.stresses(now_.state.u);
  enum class Left : std::uint8_t { stresses, deviators };
  const auto without_pressure = [&](ElementField field, Left left) {
    const std::array columns = {field.component("SIXX"), field.component("SIYY"), field.component("SIZZ")};
    const int pressure = field.component("SIP");
    const auto width = static_cast<std::ptrdiff_t>(field.components.size());
    for (int cell = 0; cell < mesh_.cell_count() && pressure >= 0; ++cell) {
      const int unknown_fields = mixed_field_count(problem_.model->formulations[static_cast<std::size_t>(cell)]);
      if (unknown_fields == 0) continue;
      for (int point = field.starts[cell]; point < field.starts[cell + 1]; ++point) {
        double* row = field.values.data() + point * width;
        row[pressure] = absent;
        if (unknown_fields > 1 || left == Left::stresses || std::ranges::find(columns, -1) != columns.end()) continue;
        const double mean = (row[columns[0]] + row[columns[1]] + row[columns[2]]) / 3.0;
        for (const int column : columns) row[column] -= mean;
      }
    }
    return field;
  };
  const auto other_cell = [&](Left left) {
    return cell_of_other_values(without_pressure(taken, left), without_pressure(given, left));
  };
  if (const auto cell = other_cell(Left::deviators))
    options_.note_unused_stresses(*cell, UnusedStresses::all);
  else if (const auto other = other_cell(Left::stresses))
    options_.note_unused_stresses(*other, UnusedStresses::mean);
}

Eigen::VectorXd StaticRun::differential_reference() const {
  Eigen::VectorXd u = now_.state.u;
  if (problem_.initial && problem_.initial->differential_reference)
    take_displacements(*problem_.initial->differential_reference, dofs_, u);
  return u;
}

void StaticRun::take_last_step() {
  const auto found = result_.steps.back().fields.find("DEPL");
  if (found == result_.steps.back().fields.end())
    throw Error("missing-field", "the result to go on with has no displacement (DEPL) at its last step");
  take_displacements(std::get<NodalField>(found->second), dofs_, now_.state.u);
}

void StaticRun::go_on_with_path() {
  if (!path_ || !problem_.initial) return;
  if (problem_.initial->intensity) path_->set_intensity(*problem_.initial->intensity);
  if (!problem_.initial->earlier) return;
  Eigen::VectorXd u = Eigen::VectorXd::Zero(dofs_.size());
  take_displacements(*problem_.initial->earlier, dofs_, u);
  path_->set_direction(now_.state.u - u);
}

std::shared_ptr<const ContactMemory> StaticRun::contact_so_far() const {
  if (problem_.initial) return problem_.initial->contact;
  return result_.steps.empty() ? nullptr : result_.steps.back().contact;
}

void StaticRun::resume() {
  const auto address = [](const auto& field) { return field ? &*field : nullptr; };
  if (problem_.initial) {
    assembler_.resume(now_.state.u, address(problem_.initial->stresses),
                      of_memory(address(problem_.initial->variables)));
    if (!problem_.initial->stresses) assembler_.begin_without_forces(now_.state.u);
  } else if (!result_.steps.empty()) {
    assembler_.resume(now_.state.u, field_of_last_step("SIEF_ELGA"), of_memory(field_of_last_step("VARI_ELGA")));
  } else {
    assembler_.resume(now_.state.u, nullptr, nullptr);
    assembler_.begin_without_forces(now_.state.u);
  }
}

const ElementField* StaticRun::of_memory(const ElementField* variables) {
  if (variables == nullptr || variables->components.size() > 1) return variables;
  return std::ranges::any_of(variables->values, [](double value) { return std::abs(value) > 0.0; }) ? variables
                                                                                                    : nullptr;
}

ElementField StaticRun::initial_stresses() const {
  ElementField field = assembler_.stresses(now_.state.u);
  for (double& value : field.values)
    if (!(problem_.initial && problem_.initial->stresses) && !std::isnan(value)) value = 0.0;
  return field;
}

const ElementField* StaticRun::field_of_last_step(std::string_view name) const {
  const auto& fields = result_.steps.back().fields;
  const auto found = fields.find(name);
  return found == fields.end() ? nullptr : &std::get<ElementField>(found->second);
}

std::span<const AppliedLoad> StaticRun::loads_so_far() const {
  if (problem_.initial) return problem_.initial->loads;
  return result_.steps.empty() ? std::span<const AppliedLoad>() : problem_.loads;
}

void StaticRun::pair_initially(double instant) {
  pair(instant, now_.state.u, nullptr);
  now_.conditions = make_conditions(now_.pairs, problem_.unilateral, mesh_, dofs_, instant);
  resize_multipliers(now_.conditions);
}

void StaticRun::add_internal_variables(ResultStep& step) const {
  step.fields.emplace("VARI_ELGA", assembler_.internal_variables(now_.state.u));
}

void StaticRun::add_patch_state(ResultStep& step) const {
  if (!mixed_) return;
  if (auto state = patch_state(mixed_->solved(now_.state.u))) step.fields.emplace("CONT_ELEM", *std::move(state));
}

NodalField StaticRun::displacements() const {
  NodalField field = to_field(now_.state.u, dofs_, "DEPL_R");
  if (mixed_) add_multipliers(mixed_->solved(now_.state.u), field);
  return field;
}

ResultStep StaticRun::fields_now(double instant) const {
  ResultStep step;
  step.order = result_.steps.back().order + 1;
  step.instant = instant;
  step.fields.emplace("DEPL", displacements());
  step.fields.emplace("SIEF_ELGA", assembler_.stresses(now_.state.u, problem_.loads, instant));
  add_internal_variables(step);
  return step;
}

void StaticRun::archive(double instant, int iterations) {
  ResultStep step = fields_now(instant);
  if (problem_.contact)
    if (auto state = contact_state(instant)) step.fields.emplace("CONT_NOEU", *std::move(state));
  add_patch_state(step);
  if (mixed_) step.contact = mixed_->memory();
  step.parameters["ITER_GLOB"] = iterations;
  if (path_) step.parameters["ETA_PILOTAGE"] = path_->intensity();
  append(std::move(step));
}

void StaticRun::append(ResultStep step) {
  watch_->take(step);
  result_.steps.push_back(std::move(step));
  if (after_step_) after_step_(result_);
}

std::optional<NodalField> StaticRun::contact_state(double instant) const {
  const std::vector<Vector3d> paired_at = positions_at(now_.reference, mesh_, dofs_);
  const double duration = instant - result_.steps.back().instant;
  if (mixed_)
    return comma::solver::contact_state(mixed_->solved(now_.state.u), positions(), paired_at, instant, duration);
  const Eigen::VectorXd slack = now_.conditions.full.bounds - now_.conditions.full.rows * now_.state.u;
  std::vector<double> gaps(now_.conditions.pairs.size(), absent);
  for (std::size_t row = 0; row < now_.conditions.row_slots.size(); ++row) {
    const int slot = now_.conditions.row_slots[row];
    if (slot < static_cast<int>(gaps.size())) gaps[slot] = slack[static_cast<Eigen::Index>(row)];
  }
  const std::vector<Vector3d> now = positions();
  std::vector<ContactPair> pairs = now_.conditions.pairs;
  for (const auto& [k, pair] : watched_pairs(*problem_.contact, mesh_, paired_at, instant)) {
    pairs[k] = pair;
    gaps[k] = gap_at(pair, mesh_, paired_at);
  }
  return contact_field(pairs, gaps, now_.state.multipliers, mesh_.node_count(), now, duration);
}

}  // namespace comma::solver
