// The part of FieldComputation that computes energies, and what they say of the way a body is loaded.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "solver/elements/energy_parts.hpp"
#include "solver/error.hpp"
#include "solver/fields/data/field_algebra.hpp"
#include "solver/fields/data/field_parts.hpp"
#include "solver/fields/field_computation.hpp"
#include "solver/fields/integrals/energies.hpp"
#include "solver/fields/nodal_forces.hpp"
#include "solver/fields/points/extrapolation.hpp"
#include "solver/fields/stresses/loading_indicators.hpp"

namespace comma::solver {

void FieldComputation::require_added_strains(std::string_view name) const {
  if (problem_.behaviours && std::ranges::any_of(*problem_.behaviours, [](const CellBehaviour& each) {
        return !has_small_strains(each.kinematics);
      }))
    throw Error("unsupported", fmt::format("{} is known for small strains and PETIT_REAC only", name));
}

Field FieldComputation::elastic_energy(std::size_t step) {
  const ElementField& stresses = stresses_beside_plates(step);
  Field energies = elastic_energy_density(input(), stresses);
  if (const std::vector<int> cells = cells_in_green_strains(); !cells.empty()) {
    const Field of_strains = strain_energy_density(input(), whole_field("EPMG_ELGA", step));
    put_piece(energies, {&of_strains, {}, {}, 1.0, false}, &cells);
  }
  if (assembler_.has_memory()) {
    const Field of_memory = assembler_.energy_densities(to_dofs(displacement(step), dofs_), stresses,
                                                        std::get<ElementField>(remembered("VARI_ELGA", step)));
    put_piece(energies, {&of_memory, {}, {}, 1.0, false});
  }
  require_elastic_patterns(stresses);
  add_stabilisation_energy(input(), stresses, std::get<ElementField>(energies));
  return energies;
}

// What patterns give back once the point has flowed is not known: they change by its tangent, which is not elastic.
void FieldComputation::require_elastic_patterns(const ElementField& stresses) const {
  if (!problem_.behaviours) return;
  for (int cell = 0; cell < problem_.model->mesh->cell_count(); ++cell) {
    if ((*problem_.behaviours)[static_cast<std::size_t>(cell)].relation == Relation::elastic ||
        !is_stabilised(stresses, cell))
      continue;
    throw Error("unsupported",
                fmt::format("cell {}: the elastic energy of the stabilisation of hexahedra with one point (3D_SI) is "
                            "not known for laws that flow",
                            problem_.model->mesh->cell_name(cell)),
                "take the total energy (ETOT_ELEM, ENER_TOTALE), or MODELISATION='3D'");
  }
}

std::vector<int> FieldComputation::cells_in_green_strains() const {
  std::vector<int> cells;
  if (!problem_.behaviours) return cells;
  const ContinuumPoints continuum(*problem_.model);
  for (int cell = 0; cell < problem_.model->mesh->cell_count(); ++cell)
    if (continuum.covers(cell) &&
        (*problem_.behaviours)[static_cast<std::size_t>(cell)].kinematics == Kinematics::green_lagrange)
      cells.push_back(cell);
  return cells;
}

bool FieldComputation::has_bars_with_memory() const {
  if (!problem_.behaviours) return false;
  for (std::size_t cell = 0; cell < problem_.behaviours->size(); ++cell)
    if (is_bar(problem_.model->formulations[cell]) && has_memory((*problem_.behaviours)[cell])) return true;
  return false;
}

namespace {

// Of plates the whole is what its parts make together: what holds the rotation about the normal is no elastic energy.
ElementField without_drilling(const Model& model, ElementField energies) {
  const int total = energies.component("TOTALE");
  for (int cell = 0; cell < model.mesh->cell_count(); ++cell) {
    if (!is_plate(model.formulations[static_cast<std::size_t>(cell)]) || energies.points(cell) == 0) continue;
    double sum = 0.0;
    for (const std::string_view name : plate_energy_names) sum += energies.at(cell, 0, energies.component(name));
    energies.values[static_cast<std::size_t>(energies.starts[cell]) * energies.components.size() +
                    static_cast<std::size_t>(total)] = sum;
  }
  return energies;
}

}  // namespace

// Of continua from their stresses; of springs, bars and beams from their displacements, and of bars with a memory from
// what they remember.
Field FieldComputation::elastic_energy_of_cells(std::size_t step) {
  const Eigen::VectorXd u = to_dofs(displacement(step), dofs_);
  if (has_bars_with_memory()) assembler_.resume(u, &whole_field("SIEF_ELGA", step), &whole_field("VARI_ELGA", step));
  require_no_initial_stresses("the elastic energy", step);
  Field energies = without_drilling(*problem_.model, assembler_.elastic_energies(u));
  const Field continua = integrate_cells(*problem_.model, whole_field("ENEL_ELGA", step));
  put_piece(energies, {&continua, {}, {}, 1.0, false});
  return energies;
}

// Elasticity that began with stresses adds them up as laws with a memory do, and has an energy all the same where these
// are the ones of the displacements that it began with.
Field FieldComputation::potential_energy_of_cells(std::size_t step) {
  const Eigen::VectorXd u = to_dofs(displacement(step), dofs_);
  require_no_initial_stresses("the potential energy", step);
  if (!assembler_.has_memory()) return assembler_.elastic_energies(u);
  BehaviourOfCells laws = *problem_.behaviours;
  for (CellBehaviour& law : laws) law.from_initial_state = false;
  const bool began_displaced = problem_.initial && problem_.initial->displacement;
  if (!began_displaced || std::ranges::any_of(laws, [](const CellBehaviour& law) { return has_memory(law); }))
    throw Error("unsupported",
                "the potential energy of a material with a memory does not follow from its displacements",
                "take the elastic energy (ENEL_ELEM, ENER_ELAS), from the stresses");
  const std::unique_ptr<Assembler> elastic = assembler_of(&laws, step);
  if (const auto cell = cell_of_other_stresses(*elastic, step))
    throw Error("unsupported",
                fmt::format("the potential energy is not known where a computation began with stresses that are not "
                            "those of its displacements, as on cell {}",
                            problem_.model->mesh->cell_name(*cell)),
                "take the elastic energy (ENEL_ELEM, ENER_ELAS), from the stresses");
  return elastic->elastic_energies(u);
}

std::unique_ptr<Assembler> FieldComputation::assembler_of(const BehaviourOfCells* laws, std::size_t step) const {
  auto elastic = std::make_unique<Assembler>(*problem_.model, *problem_.materials, *problem_.properties, dofs_, laws);
  elastic->set_time(result_.steps[step].instant);
  elastic->impose_strains(problem_.loads, result_.steps[step].instant);
  return elastic;
}

std::optional<int> FieldComputation::cell_of_other_stresses(const Assembler& elastic, std::size_t step) {
  const ElementField of_displacements =
      elastic.stresses(to_dofs(displacement(step), dofs_), problem_.loads, result_.steps[step].instant);
  return cell_of_other_values(of_displacements, whole_field("SIEF_ELGA", step));
}

// Elasticity in small strains, whatever the law is: what Code_Aster 17.3 calls potential in every result.
Field FieldComputation::energy_of_displacements(std::size_t step) {
  if (has_beams_that_turn())
    throw Error("unsupported", "the potential energy of beams that turn (GROT_GDEP) is not known",
                "name the other cells by GROUP_MA");
  const Eigen::VectorXd u = to_dofs(displacement(step), dofs_);
  return departs_from_linear() ? assembler_of(nullptr, step)->elastic_energies(u) : assembler_.elastic_energies(u);
}

bool FieldComputation::departs_from_linear() const {
  return problem_.behaviours && std::ranges::any_of(*problem_.behaviours, [](const CellBehaviour& law) {
           return has_memory(law) || law.kinematics != Kinematics::small;
         });
}

bool FieldComputation::stores_potential_energy(std::size_t step) {
  move_to(step);
  const ElementField* stresses = remembered_stresses(step);
  if (!departs_from_linear())
    return stresses == nullptr || !assembler_.has_initial_stresses(to_dofs(displacement(step), dofs_), *stresses);
  const auto is_linear = [](CellBehaviour law) {
    law.from_initial_state = false;
    return !has_memory(law) && law.kinematics == Kinematics::small;
  };
  return std::ranges::all_of(*problem_.behaviours, is_linear) &&
         !cell_of_other_stresses(*assembler_of(nullptr, step), step);
}

// What adds up from step to step is computed from the first one on: step by step backwards the calls would nest as deep
// as there are steps.
void FieldComputation::know_earlier(const std::string& name, std::size_t step) {
  const auto is_known = [&](std::size_t earlier) {
    return holds_whole(name, earlier) || known_.contains(Key(earlier, name));
  };
  std::size_t next = step;
  while (next > 0 && !is_known(next - 1)) --next;
  for (; next < step; ++next) whole(name, next);
  move_to(step);
}

// The work of stresses adds up from step to step, in large strains too that of Cauchy's stress on the linear strain.
Field FieldComputation::total_energy(std::size_t step) {
  know_earlier("ETOT_ELGA", step);
  const ElementField *stress_before = nullptr, *strain_before = nullptr, *before = nullptr;
  const NodalField* displacement_before = nullptr;
  if (step > 0) {
    stress_before = &stresses_beside_plates(step - 1);
    strain_before = &whole_field("EPSI_ELGA", step - 1);
    before = &whole_field("ETOT_ELGA", step - 1);
    displacement_before = &displacement(step - 1);
    move_to(step);
  }
  const ElementField& stress = stresses_beside_plates(step);
  ElementField energies =
      total_energy_density(stress, whole_field("EPSI_ELGA", step), stress_before, strain_before, before);
  add_stabilisation_work(input(), stress, displacement(step), stress_before, displacement_before, energies);
  return energies;
}

// The work of the normal force of bars adds up like that of stresses; that of the forces of beams, plates and discrete
// elements is their elastic energy, as long as they are elastic and nothing else strains them.
Field FieldComputation::total_energy_of_cells(std::size_t step) {
  ElementField energies = integrate_cells(*problem_.model, whole_field("ETOT_ELGA", step));
  const Model& model = *problem_.model;
  std::vector<int> bars, others;
  for (int cell = 0; cell < model.mesh->cell_count(); ++cell) {
    if (model.components_of(cell) == 0 || model.is_skin(cell) || continuum_dimension(model.formulations[cell]) > 0)
      continue;
    (is_bar(model.formulations[cell]) ? bars : others).push_back(cell);
  }
  if (!others.empty()) {
    require_elastic_work(others, step);
    constexpr std::array whole = {0};
    const Field elastic = with_components(assembler_.elastic_energies(to_dofs(displacement(step), dofs_)), whole);
    energies = side_by_side(energies, on_cells(std::get<ElementField>(elastic), others));
  }
  return bars.empty() ? energies : side_by_side(energies, work_of_bars(bars, step));
}

// Where hardening is isotropic what is stored and what flow has taken up follow from the state; of all else the work
// adds up from step to step (ENER_TOTALE, U4.81.22).
Field FieldComputation::energy_of_state(std::size_t step) {
  require_added_strains("ENER_TOTALE");
  Field energies = whole_field("ETOT_ELEM", step);
  if (!some_flow()) return energies;
  const Field flow = hardening_energy_density(input(), whole_field("VARI_ELGA", step), *problem_.behaviours);
  const ElementField& stresses = stresses_beside_plates(step);
  std::vector<int> cells;
  for (int cell = 0; cell < problem_.model->mesh->cell_count(); ++cell)
    if (std::get<ElementField>(flow).points(cell) > 0 && !is_stabilised(stresses, cell)) cells.push_back(cell);
  Field densities = on_cells(elastic_energy_density(input(), stresses), cells);
  put_piece(densities, {&flow, {}, {}, 1.0, true});
  const Field of_state = integrate_cells(*problem_.model, std::get<ElementField>(densities));
  put_piece(energies, {&of_state, {}, {}, 1.0, false});
  return energies;
}

void FieldComputation::require_elastic_work(const std::vector<int>& others, std::size_t step) {
  const Mesh& mesh = *problem_.model->mesh;
  require_no_initial_stresses("the total energy", step);
  if (others_.stiffness_changes && others_.begin > 0)
    throw Error("unsupported",
                fmt::format("the total energy of beams, plates and discrete elements, such as that on {}, is not known "
                            "where materials or sections are not the same in all steps of a result",
                            mesh.cell_name(others.front())),
                "take the elastic energy (ENEL_ELEM, ENER_ELAS), or name the other cells by GROUP_MA");
  if (!assembler_.state().empty() || strains_act_on(step, others))
    throw Error("unsupported",
                "the total energy of beams, plates and discrete elements is not known beside strains of command "
                "variables or of loads",
                "take the elastic energy (ENEL_ELEM, ENER_ELAS)");
  const auto flows = [&](int cell) {
    return problem_.behaviours && (*problem_.behaviours)[static_cast<std::size_t>(cell)].relation != Relation::elastic;
  };
  if (const auto found = std::ranges::find_if(others, flows); found != others.end())
    throw Error(
        "unsupported",
        fmt::format("the total energy of discrete elements with a law of their own, such as that on {}, is not known",
                    mesh.cell_name(*found)));
}

ElementField FieldComputation::work_of_bars(const std::vector<int>& bars, std::size_t step) {
  know_earlier("ETOT_ELEM", step);
  const auto lacks = [&](const ElementField& before) {
    return std::ranges::any_of(bars, [&](int cell) { return before.points(cell) == 0; });
  };
  if (step > 0 && (lacks(whole_field("SIEF_ELGA", step - 1)) || lacks(whole_field("ETOT_ELEM", step - 1))))
    throw Error(
        "incompatible-field",
        fmt::format("the total energy adds up from step to step, and step INST={} of the result lacks forces or "
                    "energies of bars",
                    result_.steps[step - 1].instant),
        "compute ETOT_ELEM of all steps on the whole model, and with one model");
  ElementField of_bars =
      bar_work(*problem_.model, bars, whole_field("SIEF_ELGA", step), displacement(step),
               step > 0 ? &whole_field("SIEF_ELGA", step - 1) : nullptr, step > 0 ? &displacement(step - 1) : nullptr);
  if (step == 0) return of_bars;
  const ElementField& before = whole_field("ETOT_ELEM", step - 1);
  for (const int cell : bars) of_bars.values[static_cast<std::size_t>(of_bars.starts[cell])] += before.at(cell, 0, 0);
  move_to(step);
  return of_bars;
}

Field FieldComputation::unloading(std::size_t step) {
  know_earlier("DERA_ELGA", step);
  std::optional<ElementField> before;  // a copy: the next step is looked at below
  if (step > 0) before = whole_field("DERA_ELGA", step - 1);
  const ElementField now = continuum_stresses(stresses_beside_plates(step));
  const bool is_last = step + 1 == result_.steps.size();
  const std::size_t next = is_last ? step : step + 1;
  const ElementField then = continuum_stresses(stresses_beside_plates(next));
  LoadingFields fields{now, then, nullptr, nullptr, problem_.behaviours.get()};
  if (some_flow()) {
    fields.variables = &whole_field("VARI_ELGA", step);
    fields.next_variables = &whole_field("VARI_ELGA", next);
  }
  if (before) fields.before = &*before;
  move_to(step);
  ElementField indicators = local_indicators(input(), fields);
  if (is_last) std::ranges::fill(indicators.values, absent);
  return indicators;
}

bool FieldComputation::some_flow() const {
  const auto flows = [](const CellBehaviour& behaviour) {
    return behaviour.relation != Relation::elastic && behaviour.relation != Relation::hyperelastic;
  };
  return problem_.behaviours && std::ranges::any_of(*problem_.behaviours, flows);
}

Field FieldComputation::yield_of_loading(std::size_t step) {
  return yield_indicator(input(), {whole_field("EPSP_ELGA", step), stresses_beside_plates(step),
                                   whole_field("VARI_ELGA", step), problem_.behaviours.get()});
}

Field FieldComputation::energy_of_loading(std::size_t step) {
  return energy_indicator(input(), {whole_field("EPSP_ELGA", step), stresses_beside_plates(step),
                                    whole_field("VARI_ELGA", step), problem_.behaviours.get()});
}

}  // namespace comma::solver
