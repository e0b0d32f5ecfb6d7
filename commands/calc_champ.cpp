#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "commands/analysis/problem_building.hpp"
#include "commands/analysis/result_reading.hpp"
#include "commands/commands.hpp"
#include "commands/fields/field_types.hpp"
#include "commands/selection.hpp"
#include "interpreter/diagnostic.hpp"
#include "solver/error.hpp"
#include "solver/fields/data/field_parts.hpp"
#include "solver/fields/data/field_rows.hpp"
#include "solver/fields/data/row_functions.hpp"
#include "solver/fields/field_computation.hpp"
#include "solver/fields/points/extrapolation.hpp"

namespace comma::commands {

namespace {

// GROUP_MA and MAILLE; nothing: the whole model.
using ChosenCells = std::optional<std::vector<int>>;

std::vector<std::string> wanted_fields(const Call& call) {
  std::vector<std::string> names;
  for (const char* keyword : {"CONTRAINTE", "DEFORMATION", "ENERGIE", "CRITERES", "FORCE", "VARI_INTERNE"}) {
    for (const std::string& name : call.texts(keyword)) names.push_back(name);
  }
  return names;
}

// --- fields of one's own

// UT01_ELGA for NUME_CHAM_RESU=1 and a field at Gauss points.
std::string own_name(const Keywords& occurrence) {
  const std::string& source = occurrence.text("NOM_CHAM");
  const auto place = source.rfind('_');
  return fmt::format("UT{:02}_{}", occurrence.integer("NUME_CHAM_RESU"),
                     place == std::string::npos ? "NOEU" : source.substr(place + 1));
}

std::vector<solver::RowFunction> row_functions(const Keywords& occurrence, const std::vector<std::string>& components) {
  static const std::map<std::string, solver::TensorCriterion, std::less<>> criteria = {
      {"VMIS", solver::TensorCriterion::von_mises},
      {"TRESCA", solver::TensorCriterion::tresca},
      {"INVA_2", solver::TensorCriterion::second_invariant},
      {"TRACE", solver::TensorCriterion::trace}};
  if (occurrence.has("CRITERE")) return {solver::criterion(components, criteria.at(occurrence.text("CRITERE")))};
  if (occurrence.has("NORME")) {
    return {solver::euclidean_norm(occurrence.text("NORME") == "FROBENIUS" ? solver::frobenius_weights(components)
                                                                           : std::vector<double>())};
  }
  std::vector<solver::RowFunction> functions;
  for (const auto& handle : occurrence.concepts("FORMULE")) {
    interpreter::data_of<FunctionConcept>(handle, "FORMULE");
    const auto function = std::dynamic_pointer_cast<const FunctionConcept>(handle->data);
    functions.push_back(solver::formula(components, {function->parameters(), [function](std::span<const double> at) {
                                                       return function->evaluate(at);
                                                     }}));
  }
  return functions;
}

solver::Field own_field(const Keywords& occurrence, const solver::Field& source) {
  const auto& components = solver::components_of(source);
  try {
    return solver::made_of_rows(source, row_functions(occurrence, components));
  } catch (const solver::Error& error) {
    const char* keyword = occurrence.has("FORMULE") ? "FORMULE" : "NOM_CHAM";
    throw interpreter::DiagnosticError(error.code(), std::string("CHAM_UTIL: ") + error.what(),
                                       occurrence.span_of(keyword), error.hint());
  }
}

solver::Field on_cells(const solver::Field& field, const solver::Mesh& mesh, const std::vector<int>& cells) {
  if (const auto* nodal = std::get_if<solver::NodalField>(&field))
    return solver::on_nodes(*nodal, mesh.nodes_of_cells(cells));
  return solver::on_cells(std::get<solver::ElementField>(field), cells);
}

// A field that the step lacks is computed first.
void add_own_field(const Keywords& occurrence, FieldsOfSteps& computation, const solver::Mesh& mesh,
                   const ChosenCells& cells, solver::ResultStep& step, std::size_t index) {
  const std::string& name = occurrence.text("NOM_CHAM");
  const bool computed = !step.fields.contains(name) && solver::FieldComputation::knows(name);
  solver::Field made = own_field(occurrence, computed ? computation.compute(name, index) : field_of(occurrence, step));
  if (cells) made = on_cells(made, mesh, *cells);
  require_finite(made, mesh, "CHAM_UTIL", occurrence.span);
  step.fields.insert_or_assign(own_name(occurrence), std::move(made));
}

// Whether the step has the field as the solve left it: on every cell, with the same values, which a continuation needs.
bool holds_of_solve(const solver::ResultStep& step, const std::string& name) {
  return (name == "SIEF_ELGA" || name == "VARI_ELGA") && step.fields.contains(name) && !step.limited.contains(name);
}

void add_field(const std::string& name, FieldsOfSteps& computation, const ChosenCells& cells, solver::ResultStep& step,
               std::size_t index) {
  solver::Field field = cells ? computation.compute(name, index, *cells) : computation.compute(name, index);
  step.fields.insert_or_assign(name, std::move(field));
  if (cells)
    step.limited.insert(name);
  else
    step.limited.erase(name);
}

bool has_values(const solver::Field& field) {
  return std::ranges::any_of(solver::values_of(field), [](double value) { return !std::isnan(value); });
}

// Elements of other kinds have other fields.
void warn_of_empty_field(const std::string& name, const Call& call, Context& context) {
  context.diagnostics.alarm(
      "empty-field", fmt::format("CALC_CHAMP: no element there has {}: the field has no values", name), call.span,
      "bars and beams have SIEF_ELGA, EFGE_ELNO, SIPO_ELNO and SIPM_ELNO, discrete elements SIEF_ELGA and EFGE_ELNO");
}

// A node has one value, plates have several there.
void warn_of_plates_left_out(const Call& call, FieldsOfSteps& computation, const solver::ResultStep& step,
                             std::size_t index, const ChosenCells& cells, Context& context) {
  const solver::Model& model = *computation.problem().model;
  if (std::ranges::none_of(model.formulations, solver::is_plate)) return;
  std::optional<std::span<const int>> chosen;
  if (cells) chosen = *cells;
  for (const std::string& name : wanted_fields(call)) {
    if (!name.ends_with("_NOEU")) continue;
    const std::string source = name.substr(0, name.size() - 4) + "ELNO";
    const auto held = step.fields.find(source);
    const solver::Field at_nodes = held != step.fields.end() ? held->second : computation.compute(source, index);
    const auto layered = solver::layered_cells(std::get<solver::ElementField>(at_nodes), chosen);
    if (layered.empty()) continue;
    context.diagnostics.alarm(
        "cells-left-out",
        fmt::format("CALC_CHAMP: {} leaves out {} plates, {} for one, which have several values at a node: their nodes "
                    "have none",
                    name, layered.size(), model.mesh->cell_name(layered.front())),
        call.span, "of plates POST_CHAMP with EXTR_COQUE takes one layer; GROUP_MA names the cells that count");
  }
}

// The outermost fibre of a section lies on its outline.
void warn_of_unknown_outlines(const Call& call, const solver::StaticProblem& problem, const ChosenCells& cells,
                              Context& context) {
  const solver::Model& model = *problem.model;
  const std::vector<std::string> wanted = wanted_fields(call);
  if (std::ranges::find(wanted, "SIPM_ELNO") == wanted.end()) return;
  const auto& sections = problem.properties->sections;
  for (int cell = 0; cell < model.mesh->cell_count(); ++cell) {
    const auto found = sections.find(cell);
    if (found == sections.end() || found->second.shape != solver::SectionShape::general) continue;
    if (!solver::is_beam(model.formulations[static_cast<std::size_t>(cell)]) ||
        (cells && std::ranges::find(*cells, cell) == cells->end()))
      continue;
    context.diagnostics.alarm(
        "unknown-outline",
        fmt::format("CALC_CHAMP: the beam on cell {} and its like have no SIPM_ELNO: their section is general, without "
                    "an outline",
                    model.mesh->cell_name(cell)),
        call.span, "describe it by SECTION='RECTANGLE' or 'CERCLE'");
    return;
  }
}

// Strains follow from displacements, which say nothing of that across a plane body without stress there.
void warn_of_elastic_thickness(const Call& call, const solver::StaticProblem& problem, Context& context) {
  if (!problem.behaviours) return;
  const auto& behaviours = *problem.behaviours;
  for (std::size_t cell = 0; cell < behaviours.size(); ++cell) {
    if (!solver::is_plane_stress(problem.model->formulations[cell]) ||
        behaviours[cell].relation == solver::Relation::elastic)
      continue;
    context.diagnostics.alarm(
        "elastic-thickness",
        fmt::format("CALC_CHAMP: EPZZ of cell {} and its like (C_PLAN) follows from linear elasticity, which their "
                    "law is not",
                    problem.model->mesh->cell_name(static_cast<int>(cell))),
        call.span, "where bodies flow it is the elastic strain of the stresses and EPZZ of EPSP_ELGA together");
    return;
  }
}

// EPSP_... and ETOT_... are those of small strains whatever DEFORMATION says.
void warn_of_small_measures(const Call& call, const solver::StaticProblem& problem, Context& context) {
  const auto is_large = [](const solver::CellBehaviour& behaviour) {
    return !solver::has_small_strains(behaviour.kinematics);
  };
  if (!problem.behaviours || std::ranges::none_of(*problem.behaviours, is_large)) return;
  for (const std::string& name : wanted_fields(call))
    if (name.starts_with("EPSP_") || name.starts_with("ETOT_"))
      context.diagnostics.alarm(
          "small-measure",
          fmt::format("CALC_CHAMP: {} takes the linear strain and SIEF_ELGA, which in large strains do not belong "
                      "together",
                      name),
          call.span, "EPSG_ELGA is the strain of Green and Lagrange; internal variables tell what has flowed");
}

bool has_total_strains(const std::vector<std::string>& names) {
  return std::ranges::any_of(names, [](const std::string& name) {
    return name.starts_with("EPSI_") || name.starts_with("EPME_") || name.starts_with("EPEQ_") ||
           name.starts_with("EPMQ_");
  });
}

void add_fields(const Call& call, Context& context, ResultConcept& data) {
  warn_of_missing_instants("CALC_CHAMP", call, context.diagnostics);
  FieldsOfSteps computation(call, data);
  computation.warn_of_other_materials(context.diagnostics);
  ChosenCells cells;
  if (call.given("GROUP_MA") || call.given("MAILLE")) cells = selected_cells(call, data.result.mesh());
  std::set<std::string> empty, filled;
  for (const solver::ResultStep* chosen : selected_steps(call, data.result)) {
    const auto index = static_cast<std::size_t>(chosen - data.result.steps.data());
    solver::ResultStep& step = data.result.steps[index];
    for (const std::string& name : wanted_fields(call)) {
      if (cells && holds_of_solve(step, name)) continue;
      add_field(name, computation, cells, step, index);
      (has_values(step.fields.at(name)) ? filled : empty).insert(name);
    }
    for (const Keywords& occurrence : call.factors("CHAM_UTIL"))
      add_own_field(occurrence, computation, data.result.mesh(), cells, data.result.steps[index], index);
  }
  for (const std::string& name : empty)
    if (!filled.contains(name)) warn_of_empty_field(name, call, context);
  if (!cells) computation.warn_of_limited_sources(context.diagnostics);
  const auto chosen_steps = selected_steps(call, data.result);
  if (!chosen_steps.empty())
    warn_of_plates_left_out(call, computation, *chosen_steps.front(),
                            static_cast<std::size_t>(chosen_steps.front() - data.result.steps.data()), cells, context);
  warn_of_unknown_outlines(call, computation.problem(), cells, context);
  warn_of_small_measures(call, computation.problem(), context);
  if (has_total_strains(wanted_fields(call))) warn_of_elastic_thickness(call, computation.problem(), context);
}

}  // namespace

Product calc_champ(const Call& call, Context& context) {
  return result_with(call, [&](ResultConcept& result) { add_fields(call, context, result); });
}

}  // namespace comma::commands
