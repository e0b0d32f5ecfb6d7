#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "commands/alarms/scene_alarms.hpp"
#include "commands/analysis/problem_building.hpp"
#include "commands/analysis/same_mesh.hpp"
#include "commands/commands.hpp"
#include "commands/fields/field_distribution.hpp"
#include "commands/fields/field_integrals.hpp"
#include "commands/fields/field_reading.hpp"
#include "commands/fields/field_types.hpp"
#include "commands/model/angles.hpp"
#include "commands/model/parts_of_model.hpp"
#include "commands/selection.hpp"
#include "commands/tables/section_table.hpp"
#include "interpreter/diagnostic.hpp"
#include "solver/fields/data/field_parts.hpp"
#include "solver/fields/data/field_rows.hpp"
#include "solver/fields/data/statistics.hpp"
#include "solver/fields/field_computation.hpp"
#include "solver/fields/integrals/energies.hpp"
#include "solver/fields/integrals/external_work.hpp"
#include "solver/fields/integrals/mass_inertia.hpp"
#include "solver/fields/points/discretisation.hpp"
#include "solver/loads/end_effect.hpp"
#include "solver/mesh/axes.hpp"
#include "solver/mesh/transform.hpp"

namespace comma::commands {

namespace {

using interpreter::DiagnosticError;

// --- energies

// The result whose energies are asked for: RESULTAT, or one step that holds the displacement CHAM_GD.
ResultConcept energy_source(const Call& call) {
  if (call.has("RESULTAT")) return call.data<ResultConcept>("RESULTAT");
  const FieldConcept& data = number_field(call.concept_of("CHAM_GD"), call, "CHAM_GD");
  if (!std::holds_alternative<solver::NodalField>(data.field)) {
    throw DiagnosticError("wrong-type", "POST_ELEM: energies are those of displacements, a field at nodes",
                          call.span_of("CHAM_GD"), "give a field DEPL, or RESULTAT");
  }
  if (call.has("MODELE")) require_mesh(call, "MODELE", call.data<ModelConcept>("MODELE").model->mesh.get(), *data.mesh);
  ResultConcept source;
  source.problem.model = data.model;
  source.problem.properties = std::make_shared<const solver::ElementProperties>();
  source.result.model = call.has("MODELE") ? call.data<ModelConcept>("MODELE").model : data.model;
  solver::ResultStep& step = source.result.steps.emplace_back();
  step.fields.emplace("DEPL", data.field);
  return source;
}

// What the elastic energy of plates among the cells is made of, 0 where there are none.
void add_parts(Row& row, const solver::ElementField& energies, std::span<const int> cells) {
  for (const char* name : {"MEMBRANE", "FLEXION", "CISAILLE", "COUPL_MF"}) {
    const auto found = std::ranges::find(energies.components, name);
    const auto component = static_cast<int>(found - energies.components.begin());
    row.emplace_back(name,
                     found == energies.components.end() ? 0.0 : solver::sum_over_cells(energies, component, cells));
  }
}

// What percentages refer to: all cells that the occurrences name, or those of a field that the result has already.
double reference_energy(const Call& call, const char* keyword, const solver::ElementField& energies, bool is_stored,
                        const solver::Mesh& mesh) {
  if (is_stored) return solver::sum_over_cells(energies, 0);
  std::set<int> named;
  for (const Keywords& occurrence : call.factors(keyword))
    for (const Part& part : parts_of(call, occurrence, mesh)) named.insert(part.cells.begin(), part.cells.end());
  const std::vector<int> cells(named.begin(), named.end());
  return solver::sum_over_cells(energies, 0, std::span<const int>(cells));
}

// Of nothing the whole is everything, a group nothing (Code_Aster 17.3).
double percentage(const Part& part, double share, double whole) {
  if (whole == 0.0) return part.kind == "TOUT" ? 100.0 : 0.0;
  return 100.0 * share / whole;
}

void warn_of_potential_energy(const Call& call, interpreter::Diagnostics& diagnostics) {
  diagnostics.alarm("linear-energy",
                    "POST_ELEM: ENER_POT is the energy that DEPL would have in linear elasticity and small strains, "
                    "which is not what the body has stored",
                    call.span_of("ENER_POT"),
                    "ENER_ELAS is the elastic energy of its stresses, ENER_TOTALE their work");
}

// Totals over parts: with what elastic energy is made of, potential energy with its percentage.
void list_energies(Table& table, const Call& call, interpreter::Diagnostics& diagnostics, const char* keyword,
                   const char* field) {
  const ResultConcept source = energy_source(call);
  FieldsOfSteps computation(call, source);
  if (call.has("RESULTAT")) computation.warn_of_other_materials(diagnostics);
  const bool is_elastic = std::string_view(keyword) == "ENER_ELAS";
  const bool is_potential = std::string_view(keyword) == "ENER_POT";
  bool is_told = false;
  for (const solver::ResultStep* chosen : selected_steps(call, source.result)) {
    const auto index = static_cast<std::size_t>(chosen - source.result.steps.data());
    const auto energies = std::get<solver::ElementField>(computation.compute(field, index));
    if (is_potential && !is_told && !computation.stores_potential_energy(index)) {
      warn_of_potential_energy(call, diagnostics);
      is_told = true;
    }
    const bool is_stored = chosen->fields.contains("EPOT_ELEM");
    const double whole =
        is_potential ? reference_energy(call, keyword, energies, is_stored, source.result.mesh()) : 0.0;
    for (const Keywords& occurrence : call.factors(keyword)) {
      for (const Part& part : is_potential ? parts_of(call, occurrence, source.result.mesh())
                                           : parts_and_union(call, occurrence, source.result.mesh())) {
        const double total = solver::sum_over_cells(energies, 0, std::span<const int>(part.cells));
        Row row;
        if (call.has("RESULTAT"))
          row = {{"NUME_ORDRE", static_cast<std::int64_t>(chosen->order)}, {"INST", chosen->instant}};
        const Row place = place_columns(part);
        row.insert(row.end(), place.begin(), place.end());
        row.emplace_back("TOTALE", total);
        if (is_elastic)
          add_parts(row, energies, part.cells);
        else if (is_potential)
          row.emplace_back("POUR_CENT", percentage(part, total, whole));
        table.add_row(row);
      }
    }
  }
  computation.warn_of_limited_sources(diagnostics);
}

// --- indicators of the loading

// Code_Aster calls a whole model by its number among the concepts of the file, in eight hexadecimal digits (U4.81.22,
// LIEU).
std::string internal_name(const interpreter::Concept& handle) { return fmt::format("{:08x}", handle.id); }

std::string name_of_whole(const Call& call) {
  if (call.has("MODELE")) return internal_name(*call.concept_of("MODELE"));
  for (const auto& source : call.concept_of("RESULTAT")->reads_through)
    if (source->type == "modele_sdaster") return internal_name(*source);
  return "TOUT";
}

// Means over the volume of each part.
void list_indicators(Table& table, const Call& call, interpreter::Diagnostics& diagnostics,
                     const std::string& keyword) {
  const auto& source = call.data<ResultConcept>("RESULTAT");
  FieldsOfSteps computation(call, source);
  computation.warn_of_other_materials(diagnostics);
  const solver::Model& model = *computation.problem().model;
  const solver::ElementField volumes = solver::cell_volumes(model);
  for (const solver::ResultStep* chosen : selected_steps(call, source.result)) {
    const auto index = static_cast<std::size_t>(chosen - source.result.steps.data());
    const auto densities = std::get<solver::ElementField>(computation.compute(keyword + "_ELGA", index));
    const solver::ElementField integrals = solver::integrate_cells(model, densities);
    for (const Keywords& occurrence : call.factors(keyword)) {
      for (const Part& part : parts_of(call, occurrence, source.result.mesh())) {
        const std::span<const int> cells(part.cells);
        const double volume = solver::sum_over_cells(volumes, 0, cells);
        if (volume == 0.0)
          throw DiagnosticError("no-element", fmt::format("POST_ELEM: no solid or plane element lies in {}", part.name),
                                occurrence.span);
        table.add_row({{"NUME_ORDRE", static_cast<std::int64_t>(chosen->order)},
                       {"INST", chosen->instant},
                       {"LIEU", part.kind == "TOUT" ? name_of_whole(call) : part.name},
                       {"ENTITE", part.kind},
                       {keyword, solver::sum_over_cells(integrals, 0, cells) / volume}});
      }
    }
  }
}

// --- masses

solver::StaticProblem named_problem(const Call& call) {
  if (call.has("RESULTAT")) return problem_of_result(call, call.data<ResultConcept>("RESULTAT"));
  return problem_of_result(call, ResultConcept());
}

void add_inertia(Row& row, const Eigen::Matrix3d& inertia, const char* ending) {
  constexpr std::pair<const char*, std::pair<int, int>> entries[] = {{"IX", {0, 0}},  {"IY", {1, 1}},  {"IZ", {2, 2}},
                                                                     {"IXY", {0, 1}}, {"IXZ", {0, 2}}, {"IYZ", {1, 2}}};
  // Products of inertia are integrals of xy, xz and yz, which the tensor has with a minus sign.
  for (const auto& [name, place] : entries)
    row.emplace_back(std::string(name) + ending, place.first == place.second
                                                     ? inertia(place.first, place.second)
                                                     : 0.0 - inertia(place.first, place.second));
}

void add_principal_inertia(Row& row, const solver::PrincipalInertia& principal) {
  for (int i = 0; i < 3; ++i) row.emplace_back(fmt::format("I{}_PRIN_G", "XYZ"[i]), principal.moments[i]);
  const Eigen::Vector3d angles = solver::nautical_angles(principal.axes) / degree;
  row.insert(row.end(), {{"ALPHA", angles[0]}, {"BETA", angles[1]}, {"GAMMA", angles[2]}});
}

Eigen::Vector3d inertia_origin(const std::vector<double>& coordinates) {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  std::ranges::copy(coordinates, point.data());
  return point;
}

const solver::Field& displacement_of(const Call& call) {
  if (!call.has("RESULTAT"))
    throw DiagnosticError("missing-keyword",
                          "POST_ELEM: GEOMETRIE='DEFORMEE' needs the displacements that deform the mesh",
                          call.span_of("GEOMETRIE"), "give RESULTAT with INST, or CHAM_GD");
  const auto& result = call.data<ResultConcept>("RESULTAT").result;
  const solver::ResultStep& step = only_step(call, result, "masses are taken at one");
  const auto found = step.fields.find("DEPL");
  if (found != step.fields.end()) return found->second;
  throw DiagnosticError("unknown-field",
                        fmt::format("POST_ELEM: step INST={} of the result holds no DEPL", step.instant),
                        call.span_of("RESULTAT"));
}

// The model with its mesh where a displacement has brought it: that of a step of RESULTAT, or CHAM_GD.
solver::Model deformed(const Call& call, const solver::Model& model) {
  const solver::Field& field =
      call.has("CHAM_GD") ? number_field(call.concept_of("CHAM_GD"), call, "CHAM_GD").field : displacement_of(call);
  const auto* displacement = std::get_if<solver::NodalField>(&field);
  if (displacement == nullptr)
    throw DiagnosticError("wrong-type", "POST_ELEM: GEOMETRIE='DEFORMEE' takes a displacement",
                          call.span_of("GEOMETRIE"));
  auto mesh = std::make_shared<solver::Mesh>(*model.mesh);
  solver::displace(*mesh, *displacement);
  solver::Model moved = model;
  moved.mesh = std::move(mesh);
  return moved;
}

void list_masses(Table& table, const Call& call, Context& context) {
  const solver::StaticProblem problem = named_problem(call);
  const solver::VariableState state;
  const bool moved = call.text("GEOMETRIE") == "DEFORMEE";
  const solver::Model model = moved ? deformed(call, *problem.model) : *problem.model;
  const solver::FieldInput input{model, *problem.materials, *problem.properties, state};
  std::set<int> counted;
  for (const Keywords& occurrence : call.factors("MASS_INER")) {
    for (const Part& part : parts_and_union(call, occurrence, *problem.model->mesh)) {
      counted.insert(part.cells.begin(), part.cells.end());
      const solver::MassInertia found = solver::mass_inertia(input, std::span<const int>(part.cells));
      Row row = place_columns(part);
      row.emplace_back("MASSE", found.mass);
      for (int i = 0; i < 3; ++i) row.emplace_back(fmt::format("CDG_{}", "XYZ"[i]), found.centre[i]);
      add_inertia(row, found.inertia, "_G");
      add_principal_inertia(row, solver::principal_inertia(found.inertia));
      if (occurrence.has("ORIG_INER")) {
        const Eigen::Vector3d origin = inertia_origin(occurrence.reals("ORIG_INER"));
        for (int i = 0; i < 3; ++i) row.emplace_back(fmt::format("{}_P", "XYZ"[i]), origin[i]);
        add_inertia(row, solver::inertia_about(found, origin), "_P");
      }
      table.add_row(row);
    }
  }
  warn_of_missing_masses(call, problem, counted, context);
}

// --- extremes

void add_extremes(Table& table, const Call& call, const Keywords& occurrence, const FieldSource& source) {
  const auto& components = solver::components_of(source.field);
  const bool nodal = std::holds_alternative<solver::NodalField>(source.field);
  for (const Part& part : parts_and_union(call, occurrence, source.mesh)) {
    const std::vector<int> places = nodal ? source.mesh.nodes_of_cells(part.cells) : part.cells;
    Row row = source.columns;
    if (row.front().first == "RESU") row.erase(row.begin());
    row.front().first = "CHAMP_GD";
    const Row place = named_place(part);
    row.insert(row.end(), place.begin(), place.end());
    for (const std::string& name : occurrence.texts("NOM_CMP")) {
      const auto found =
          solver::extremes(source.field, component_of(occurrence, components, name), std::span<const int>(places));
      if (!found) {
        throw DiagnosticError("unknown-component", fmt::format("POST_ELEM: nothing in {} carries {}", part.name, name),
                              occurrence.span_of("NOM_CMP"));
      }
      for (const auto& [kind, extreme] : {std::pair("MAX", found->greatest), std::pair("MIN", found->least)}) {
        row.emplace_back(fmt::format("{}_{}", kind, name), extreme.value);
        if (nodal) row.emplace_back(fmt::format("NO_{}_{}", kind, name), table_node(source.mesh, extreme.place));
        if (nodal) continue;
        row.emplace_back(fmt::format("MA_{}_{}", kind, name), table_cell(source.mesh, extreme.place));
        row.emplace_back(fmt::format("PT_{}_{}", kind, name), std::int64_t{extreme.point + 1});
      }
    }
    table.add_row(row);
  }
}

// MINMAX reads results of its own.
void warn_of_idle_steps(const Call& call, interpreter::Diagnostics& diagnostics) {
  static constexpr std::array steps = {"INST", "NUME_ORDRE", "LIST_INST", "LIST_ORDRE"};
  const auto reads_all = [](const Keywords& occurrence) {
    return occurrence.has("RESULTAT") &&
           std::ranges::none_of(steps, [&](const char* keyword) { return occurrence.has(keyword); });
  };
  if (std::ranges::none_of(call.factors("MINMAX"), reads_all)) return;
  for (const char* keyword : steps)
    if (call.given(keyword))
      diagnostics.alarm(
          "idle-keyword",
          fmt::format("POST_ELEM/{} does not count for MINMAX, which takes all steps of its own RESULTAT", keyword),
          call.at(keyword).name_span, fmt::format("write {} inside MINMAX=_F(...)", keyword));
}

void list_extremes(Table& table, const Call& call, interpreter::Diagnostics& diagnostics) {
  warn_of_idle_steps(call, diagnostics);
  for (const Keywords& occurrence : call.factors("MINMAX")) {
    warn_of_missing_instants("POST_ELEM", occurrence, diagnostics);
    for (const FieldSource& source : field_sources(occurrence)) add_extremes(table, call, occurrence, source);
  }
}

// --- work

void list_work(Table& table, const Call& call, interpreter::Diagnostics& diagnostics) {
  const auto& result = call.data<ResultConcept>("RESULTAT").result;
  const auto works = solver::external_work(result);
  if (std::ranges::any_of(result.steps,
                          [](const solver::ResultStep& step) { return step.limited.contains("FORC_NODA"); }))
    warn_of_limited_fields(call, {"FORC_NODA"}, diagnostics);
  for (const solver::ResultStep* step : selected_steps(call, result)) {
    const solver::ExternalWork& work = works[static_cast<std::size_t>(step - result.steps.data())];
    table.add_row({{"NUME_ORDRE", std::int64_t{step->order}},
                   {"INST", step->instant},
                   {"TRAV_ELAS", work.elastic},
                   {"TRAV_REEL", work.real}});
  }
}

// --- holes

void list_areas(Table& table, const Call& call) {
  const solver::Mesh& mesh = *call.data<ModelConcept>("MODELE").model->mesh;
  for (const Keywords& occurrence : call.factors("AIRE_INTERNE")) {
    const auto names = occurrence.texts("GROUP_MA_BORD");
    const auto rim = selected_cells(occurrence, mesh, {"", "", "", "GROUP_MA_BORD", ""});
    table.add_row({{"GROUP_MA", fmt::format("{}", fmt::join(names, " "))},
                   {"AIRE", solver::enclosed_area(mesh, rim)},
                   {"LONGUEUR", solver::length_along_nodes(mesh, rim)}});
  }
}

}  // namespace

Product post_elem(const Call& call, Context& context) {
  auto product = std::make_shared<TableConcept>();
  Table& table = product->table;
  warn_of_missing_instants("POST_ELEM", call, context.diagnostics);
  if (call.has("ENER_ELAS")) list_energies(table, call, context.diagnostics, "ENER_ELAS", "ENEL_ELEM");
  if (call.has("ENER_POT")) list_energies(table, call, context.diagnostics, "ENER_POT", "ENER_POT");
  if (call.has("ENER_TOTALE")) list_energies(table, call, context.diagnostics, "ENER_TOTALE", "ENER_TOTALE");
  for (const char* keyword : {"INDIC_SEUIL", "INDIC_ENER"})
    if (call.has(keyword)) list_indicators(table, call, context.diagnostics, keyword);
  if (call.has("MASS_INER")) list_masses(table, call, context);
  if (call.has("INTEGRALE")) list_integrals(table, call, context.diagnostics);
  if (call.has("NORME")) list_norms(table, call, context.diagnostics);
  if (call.has("VOLUMOGRAMME")) list_distributions(table, call, context.diagnostics);
  if (call.has("MINMAX")) list_extremes(table, call, context.diagnostics);
  if (call.has("TRAV_EXT")) list_work(table, call, context.diagnostics);
  if (call.has("AIRE_INTERNE")) list_areas(table, call);
  if (call.has("CARA_GEOM")) list_sections(table, call);
  return product;
}

}  // namespace comma::commands
