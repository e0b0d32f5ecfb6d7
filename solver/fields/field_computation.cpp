#include "solver/fields/field_computation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "solver/elements/slender/rotating_beam.hpp"
#include "solver/error.hpp"
#include "solver/fields/data/field_algebra.hpp"
#include "solver/fields/data/field_parts.hpp"
#include "solver/fields/nodal_forces.hpp"
#include "solver/fields/points/extrapolation.hpp"
#include "solver/fields/points/variable_fields.hpp"
#include "solver/fields/stresses/beam_forces.hpp"
#include "solver/fields/stresses/beam_stresses.hpp"
#include "solver/fields/stresses/equivalent.hpp"
#include "solver/fields/stresses/plate_forces.hpp"
#include "solver/fields/stresses/strains.hpp"
#include "solver/fields/stresses/surface_stresses.hpp"

namespace comma::solver {

using namespace std::string_view_literals;

namespace {

/// A criterion and the field that it judges, both at the nodes of cells or both at Gauss points.
const std::map<std::string, std::string, std::less<>>& strain_criteria() {
  static const std::map<std::string, std::string, std::less<>> table = {
      {"EPEQ", "EPSI"}, {"EPMQ", "EPME"}, {"EPGQ", "EPSG"}};
  return table;
}

std::string quantity_of(std::string_view name) { return std::string(name.substr(0, name.rfind('_'))); }

std::vector<int> skin_cells(const Model& model) {
  std::vector<int> cells;
  for (int cell = 0; cell < model.mesh->cell_count(); ++cell) {
    if (model.is_skin(cell)) cells.push_back(cell);
  }
  return cells;
}

// What plates have: forces and strains in their own axes, stresses and strains in layers (of which one may be taken to
// the nodes), energies, forces on nodes.
constexpr std::array plate_fields = {
    "EFGE_ELGA"sv,   "EFGE_ELNO"sv, "EFGE_NOEU"sv, "DEGE_ELGA"sv, "DEGE_ELNO"sv, "DEGE_NOEU"sv, "SIEF_ELGA"sv,
    "SIEF_ELNO"sv,   "SIEF_NOEU"sv, "SIGM_ELGA"sv, "SIGM_ELNO"sv, "SIGM_NOEU"sv, "SIEQ_ELGA"sv, "SIEQ_ELNO"sv,
    "SIEQ_NOEU"sv,   "EPSI_ELGA"sv, "EPSI_ELNO"sv, "EPSI_NOEU"sv, "EPEQ_ELGA"sv, "EPEQ_ELNO"sv, "EPEQ_NOEU"sv,
    "ENER_TOTALE"sv, "ETOT_ELEM"sv, "EPOT_ELEM"sv, "ENEL_ELEM"sv, "FORC_NODA"sv, "REAC_NODA"sv, "ENER_POT"sv};

std::vector<int> all_cells(const Model& model) {
  std::vector<int> cells(static_cast<std::size_t>(model.mesh->cell_count()));
  std::iota(cells.begin(), cells.end(), 0);
  return cells;
}

void check_plates(const Model& model, std::string_view name, std::optional<std::span<const int>> cells) {
  if (std::ranges::find(plate_fields, name) != plate_fields.end()) return;
  const std::vector<int> all = cells ? std::vector<int>(cells->begin(), cells->end()) : all_cells(model);
  const auto plate =
      std::ranges::find_if(all, [&](int cell) { return is_plate(model.formulations[cell]) && !model.is_skin(cell); });
  if (plate == all.end()) return;
  // Over the whole model the elements that have such a field get it.
  const auto has_other_elements = [&](int cell) {
    return model.formulations[cell] != Formulation::none && !is_plate(model.formulations[cell]) && !model.is_skin(cell);
  };
  if (!cells && std::ranges::any_of(all, has_other_elements)) return;
  throw Error("unsupported",
              fmt::format("comma does not compute {} on plates such as {}", name, model.mesh->cell_name(*plate)),
              "name the cells without plates, or take EFGE_ELNO, SIGM_ELNO or EPSI_ELNO");
}

bool ends(std::string_view name, std::string_view place) { return name.ends_with(place); }

}  // namespace

FieldComputation::FieldComputation(const StaticProblem& problem, const Result& result, OtherPhases others)
    : problem_(problem),
      result_(result),
      others_(std::move(others)),
      dofs_(*problem.model),
      assembler_(*problem.model, *problem.materials, *problem.properties, dofs_, problem.behaviours.get()) {}

const std::map<std::string, FieldComputation::Rule, std::less<>>& FieldComputation::rules() {
  using F = FieldComputation;
  static const std::map<std::string, Rule, std::less<>> table = {
      {"SIEF_ELGA", &F::stresses},
      {"SIEF_ELNO", &F::stresses_and_forces_at_nodes},
      {"SIGM_ELGA", &F::stress_field_at_points},
      {"SIGM_ELNO", &F::stress_field_at_nodes},
      {"EFGE_ELGA", &F::section_force_field},
      {"EFGE_ELNO", &F::end_forces},
      {"SIPO_ELNO", &F::fibre_stresses},
      {"SIPM_ELNO", &F::largest_stresses},
      {"DEGE_ELGA", &F::section_strains_at_points},
      {"DEGE_ELNO", &F::section_strains},
      {"EPSI_ELGA", &F::total_strains},
      {"EPSI_ELNO", &F::total_strains_at_nodes},
      {"EPME_ELGA", &F::mechanical_strains},
      {"EPSG_ELGA", &F::green_strains},
      {"EPMG_ELGA", &F::mechanical_green_strains},
      {"EPSL_ELGA", &F::logarithmic_strains},
      {"EPSP_ELGA", &F::plastic_strains_at_points},
      {"EPVC_ELGA", &F::variable_strains},
      {"EPFP_ELGA", &F::strains_of_creep},
      {"EPFD_ELGA", &F::strains_of_creep},
      {"VARC_ELGA", &F::command_variables},
      {"SIEQ_ELGA", &F::stress_criteria_at_points},
      {"SIEQ_ELNO", &F::stress_criteria_at_nodes},
      {"ENEL_ELGA", &F::elastic_energy},
      {"ENEL_ELEM", &F::elastic_energy_of_cells},
      {"EPOT_ELEM", &F::potential_energy_of_cells},
      {"ETOT_ELGA", &F::total_energy},
      {"ETOT_ELEM", &F::total_energy_of_cells},
      {"ENER_TOTALE", &F::energy_of_state},
      {"ENER_POT", &F::energy_of_displacements},
      {"VARI_ELGA", &F::internal_variables},
      {"DERA_ELGA", &F::unloading},
      {"INDIC_SEUIL_ELGA", &F::yield_of_loading},
      {"INDIC_ENER_ELGA", &F::energy_of_loading},
      {"FORC_NODA", &F::internal_forces},
      {"REAC_NODA", &F::reactions},
  };
  return table;
}

bool FieldComputation::knows(std::string_view name) {
  if (name == "SIRO_ELEM" || rules().contains(name)) return true;
  const std::string quantity = quantity_of(name);
  if (strain_criteria().contains(quantity)) return ends(name, "_ELGA") || ends(name, "_ELNO") || ends(name, "_NOEU");
  if (ends(name, "_ELNO")) return rules().contains(quantity + "_ELGA");
  if (ends(name, "_NOEU")) return knows(quantity + "_ELNO");
  return false;
}

Field FieldComputation::compute(std::string_view name, std::size_t step, std::optional<std::span<const int>> cells) {
  if (!knows(name)) throw Error("unsupported", fmt::format("the field {} is not known how to compute", name));
  check_plates(*problem_.model, name, cells);
  return derive(name, step, cells);
}

Field FieldComputation::derive(std::string_view name, std::size_t step, std::optional<std::span<const int>> cells) {
  const std::string quantity = quantity_of(name);
  move_to(step);
  if (const auto found = known_.find(Key(step, name)); found != known_.end() && !cells) return found->second;
  if (name == "SIRO_ELEM") {
    const auto skin = cells ? std::vector<int>(cells->begin(), cells->end()) : skin_cells(*problem_.model);
    return surface_stresses(result_.mesh(), element_field("SIGM_ELNO", step), skin);
  }
  if (name == "FORC_NODA" && cells) return internal_forces_of(*cells, step);
  if (name == "REAC_NODA" && cells) return reactions_of(*cells, step);
  if (ends(name, "_NOEU")) return means_at_nodes(quantity, step, cells);
  Field field;
  if (const auto rule = rules().find(name); rule != rules().end()) {
    field = (this->*rule->second)(step);
  } else if (const auto judged = strain_criteria().find(quantity); judged != strain_criteria().end()) {
    field = equivalent_strains(element_field(judged->second + std::string(name.substr(4)), step));
  } else {
    field = to_element_nodes(*problem_.model, element_field(quantity + "_ELGA", step));
  }
  if (!cells || !std::holds_alternative<ElementField>(field)) return field;
  // The next step may add to what is whole.
  const auto known = known_.insert_or_assign(Key(step, name), std::move(field)).first;
  return on_cells(std::get<ElementField>(known->second), *cells);
}

const Field& FieldComputation::needed(const std::string& name, std::size_t step) {
  const auto& held = result_.steps[step].fields;
  if (const auto found = held.find(name); found != held.end()) {
    if (result_.steps[step].limited.contains(name)) limited_sources_.insert(name);
    return found->second;
  }
  return computed(name, step);
}

const Field& FieldComputation::computed(const std::string& name, std::size_t step) {
  if (step < others_.begin || step >= others_.end) return others_.field(name, step);
  const Key key(step, name);
  if (const auto found = known_.find(key); found != known_.end()) return found->second;
  if (!knows(name)) {
    throw Error("unknown-field",
                fmt::format("step INST={} of the result holds no {}", result_.steps[step].instant, name));
  }
  Field field = derive(name, step);
  return known_.emplace(key, std::move(field)).first->second;
}

const ElementField& FieldComputation::element_field(const std::string& name, std::size_t step) {
  return std::get<ElementField>(needed(name, step));
}

bool FieldComputation::holds_whole(const std::string& name, std::size_t step) const {
  return result_.steps[step].fields.contains(name) && !result_.steps[step].limited.contains(name);
}

const Field& FieldComputation::whole(const std::string& name, std::size_t step) {
  return holds_whole(name, step) || !knows(name) ? needed(name, step) : computed(name, step);
}

const ElementField& FieldComputation::whole_field(const std::string& name, std::size_t step) {
  return std::get<ElementField>(whole(name, step));
}

const NodalField& FieldComputation::displacement(std::size_t step) {
  return std::get<NodalField>(needed("DEPL", step));
}

// What is known of a step serves it and the next one.
void FieldComputation::move_to(std::size_t step) {
  if (step_ == step) return;
  step_ = step;
  std::erase_if(known_, [&](const auto& item) { return item.first.first + 1 < step; });
  assembler_.set_time(result_.steps[step].instant);
  assembler_.impose_strains(problem_.loads, result_.steps[step].instant);
}

FieldInput FieldComputation::input() const {
  return {*problem_.model, *problem_.materials, *problem_.properties, assembler_.state()};
}

/// What a material with a memory has left in the result: it does not follow from the displacements.
const Field& FieldComputation::remembered(std::string_view name, std::size_t step) const {
  const auto& held = result_.steps[step].fields;
  if (const auto found = held.find(name); found != held.end()) return found->second;
  throw Error("unknown-field",
              fmt::format("step INST={} of the result holds no {}, which a material with a memory needs",
                          result_.steps[step].instant, name),
              "archive it (ARCHIVAGE without CHAM_EXCLU)");
}

const ElementField* FieldComputation::remembered_stresses(std::size_t step) const {
  const bool is_held = assembler_.takes_initial_stresses() && holds_whole("SIEF_ELGA", step);
  return is_held || assembler_.has_memory() || began_with_stresses()
             ? &std::get<ElementField>(remembered("SIEF_ELGA", step))
             : nullptr;
}

bool FieldComputation::began_with_stresses() const {
  return assembler_.takes_initial_stresses() && problem_.initial && problem_.initial->stresses;
}

// What springs, bars, beams and plates have beside the stresses of their displacements is in no energy, nor in the
// strains that follow from forces.
void FieldComputation::require_no_initial_stresses(std::string_view name, std::size_t step) {
  const ElementField* known = remembered_stresses(step);
  if (known == nullptr || !assembler_.has_initial_stresses(to_dofs(displacement(step), dofs_), *known)) return;
  throw Error("unsupported",
              fmt::format("{} of springs, bars, beams and plates is not known beside initial stresses", name),
              "begin without SIGM in ETAT_INIT, or take fields of forces (EFGE_ELNO)");
}

Field FieldComputation::stresses(std::size_t step) {
  if (assembler_.has_memory() || began_with_stresses()) return remembered("SIEF_ELGA", step);
  return assembler_.stresses(to_dofs(displacement(step), dofs_), problem_.loads, result_.steps[step].instant);
}

// Elasticity has no memory: Code_Aster gives it one variable, which stays zero (U4.51.11).
Field FieldComputation::internal_variables(std::size_t step) {
  if (assembler_.has_memory()) return remembered("VARI_ELGA", step);
  ElementField field = stresses_beside_plates(step);
  const std::size_t stresses = field.components.size();
  for (std::size_t k = 0; k < field.values.size() / stresses; ++k) {
    const bool exists = std::any_of(field.values.begin() + static_cast<std::ptrdiff_t>(k * stresses),
                                    field.values.begin() + static_cast<std::ptrdiff_t>((k + 1) * stresses),
                                    [](double value) { return !std::isnan(value); });
    field.values[k] = exists ? 0.0 : absent;
  }
  field.values.resize(field.values.size() / stresses);
  field.components = {"V1"};
  field.quantity = "VARI_R";
  return field;
}

bool FieldComputation::strains_act_on(std::size_t step, std::span<const int> cells) const {
  const ImposedStrains imposed(*problem_.model, problem_.loads, result_.steps[step].instant);
  return std::ranges::any_of(cells, [&](int cell) { return imposed.acts_on(cell); });
}

Field FieldComputation::section_force_field(std::size_t step) {
  const ElementField of_members = section_forces(stresses_beside_plates(step));
  return has_plates() ? side_by_side(of_members, plate_forces(step)) : of_members;
}

Field FieldComputation::end_forces(std::size_t step) {
  const ForceInput forces{*problem_.model, *problem_.materials, *problem_.properties, dofs_, &assembler_.state()};
  TurnedAxes axes;
  if (has_beams_that_turn())
    axes = turned_axes(*problem_.model, *problem_.behaviours, displacement(step),
                       &std::get<ElementField>(remembered("VARI_ELGA", step)));
  return end_section_forces(forces, forces_at_nodes(step), problem_.loads, result_.steps[step].instant, axes);
}

Field FieldComputation::fibre_stresses(std::size_t step) {
  return force_stresses(input(), element_field("EFGE_ELNO", step));
}

Field FieldComputation::largest_stresses(std::size_t step) {
  return extreme_stresses(input(), element_field("EFGE_ELNO", step));
}

Field FieldComputation::section_strains(std::size_t step) {
  const ElementField of_plates = has_plates() ? plate_forces_at_corners(step) : element_field("EFGE_ELNO", step);
  return strains_of_forces("DEGE_ELNO", section_forces(forces_at_nodes(step)), of_plates, step);
}

Field FieldComputation::section_strains_at_points(std::size_t step) {
  const ElementField& forces = element_field("EFGE_ELGA", step);
  return strains_of_forces("DEGE_ELGA", forces, forces, step);
}

Field FieldComputation::strains_of_forces(std::string_view name, const ElementField& of_members,
                                          const ElementField& of_plates, std::size_t step) {
  require_no_initial_stresses(name, step);
  const auto names_one = [&](std::string_view force) { return of_members.component(force) >= 0; };
  const ImposedStrains imposed(*problem_.model, problem_.loads, result_.steps[step].instant);
  if (!names_one("NXX")) return with_flow_of_bars(generalised_strains(input(), of_members, &imposed), step);
  if (strains_act_on(step, plates()))
    throw Error("unsupported", fmt::format("{} of plates is not known beside initial strains (PRE_EPSI)", name));
  const ElementField strains = plate_strains(input(), of_plates);
  return names_one("N")
             ? side_by_side(with_flow_of_bars(generalised_strains(input(), of_members, &imposed), step), strains)
             : strains;
}

// The elongation of a bar that flows does not follow from its force.
ElementField FieldComputation::with_flow_of_bars(ElementField strains, std::size_t step) {
  const int axial = strains.component("EPXX");
  if (!problem_.behaviours || axial < 0) return strains;
  const ElementField* whole = nullptr;
  for (int cell = 0; cell < problem_.model->mesh->cell_count(); ++cell) {
    if (!is_bar(problem_.model->formulations[static_cast<std::size_t>(cell)]) ||
        !solver::has_memory((*problem_.behaviours)[static_cast<std::size_t>(cell)]))
      continue;
    if (whole == nullptr) whole = &element_field("EPSI_ELGA", step);
    const int column = whole->component("EPXX");
    for (int point = 0; point < strains.points(cell) && whole->points(cell) > 0 && column >= 0; ++point)
      strains.values[static_cast<std::size_t>(strains.starts[cell] + point) * strains.components.size() +
                     static_cast<std::size_t>(axial)] = whole->at(cell, 0, column);
  }
  return strains;
}

Field FieldComputation::mechanical_strains(std::size_t step) {
  return strains(input(), displacement(step), StrainKind::mechanical);
}

// The linear strain less what the stress holds up elastically, in large strains too.
Field FieldComputation::plastic_strains_at_points(std::size_t step) {
  if (assembler_.imposes_strains())
    throw Error("unsupported", "EPSP_ELGA is not known beside initial strains (PRE_EPSI)");
  return plastic_strains(input(), displacement(step), stresses_beside_plates(step));
}

Field FieldComputation::green_strains(std::size_t step) {
  return strains(input(), displacement(step), StrainKind::green);
}

Field FieldComputation::logarithmic_strains(std::size_t step) {
  return strains(input(), displacement(step), StrainKind::logarithmic);
}

Field FieldComputation::mechanical_green_strains(std::size_t step) {
  return strains(input(), displacement(step), StrainKind::mechanical_green);
}

Field FieldComputation::variable_strains(std::size_t) { return variable_strain_field(input()); }

Field FieldComputation::strains_of_creep(std::size_t step) { return creep_strains(input(), displacement(step)); }

Field FieldComputation::command_variables(std::size_t) { return command_variable_field(input()); }

Field FieldComputation::stress_criteria_at_points(std::size_t step) {
  return equivalent_stresses(element_field("SIGM_ELGA", step));
}

Field FieldComputation::stress_criteria_at_nodes(std::size_t step) {
  return equivalent_stresses(element_field("SIGM_ELNO", step));
}

bool FieldComputation::has_beams_that_turn() const {
  return has_rotating_beams(*problem_.model, problem_.behaviours.get());
}

// Forces act along the axes of beams as the step left them, which their variables hold.
void FieldComputation::turn_beams(Assembler& assembler, const DofMap& dofs, std::size_t step) {
  if (!has_beams_that_turn()) return;
  assembler.resume(to_dofs(displacement(step), dofs), &std::get<ElementField>(remembered("SIEF_ELGA", step)),
                   &std::get<ElementField>(remembered("VARI_ELGA", step)));
}

Field FieldComputation::internal_forces(std::size_t step) {
  turn_beams(assembler_, dofs_, step);
  return nodal_forces(assembler_, dofs_, displacement(step), problem_.loads, result_.steps[step].instant,
                      remembered_stresses(step));
}

// The cells are a model of their own.
Field FieldComputation::internal_forces_of(std::span<const int> cells, std::size_t step) {
  Model part{problem_.model->mesh, std::vector<Formulation>(problem_.model->formulations.size(), Formulation::none)};
  for (const int cell : cells)
    part.formulations[static_cast<std::size_t>(cell)] = problem_.model->formulations[static_cast<std::size_t>(cell)];
  const DofMap dofs(part);
  Assembler assembler(part, *problem_.materials, *problem_.properties, dofs, problem_.behaviours.get());
  const double time = result_.steps[step].instant;
  assembler.set_time(time);
  assembler.impose_strains(problem_.loads, time);
  turn_beams(assembler, dofs, step);
  return nodal_forces(assembler, dofs, displacement(step), problem_.loads, time, remembered_stresses(step));
}

Field FieldComputation::reactions(std::size_t step) {
  const double time = result_.steps[step].instant;
  FollowerForces followers(*problem_.model, dofs_, problem_.followers);
  followers.set_time(time);
  turn_beams(assembler_, dofs_, step);
  return nodal_reactions(assembler_, dofs_, displacement(step), problem_.loads, followers, time,
                         remembered_stresses(step));
}

Field FieldComputation::reactions_of(std::span<const int> cells, std::size_t step) {
  const double time = result_.steps[step].instant;
  FollowerForces followers(*problem_.model, dofs_, problem_.followers);
  followers.set_time(time);
  // Initial strains are part of the nodal forces.
  const Eigen::VectorXd applied = assembler_.external_forces(problem_.loads, time) -
                                  assembler_.initial_strain_forces(problem_.loads, time) +
                                  followers.at(to_dofs(displacement(step), dofs_));
  const Field forces = internal_forces_of(cells, step), loads = to_field(applied, dofs_, "DEPL_R");
  const Field reactions = linear_combination(std::array{FieldTerm{&forces, 1.0}, FieldTerm{&loads, -1.0}});
  return on_nodes(std::get<NodalField>(reactions), result_.mesh().nodes_of_cells(cells));
}

}  // namespace comma::solver
