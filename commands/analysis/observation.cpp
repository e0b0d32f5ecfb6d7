#include "commands/analysis/observation.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>

#include "commands/fields/field_reading.hpp"
#include "commands/fields/field_types.hpp"
#include "commands/selection.hpp"
#include "commands/tables/reductions.hpp"
#include "interpreter/diagnostic.hpp"
#include "solver/error.hpp"
#include "solver/fields/data/field_rows.hpp"
#include "solver/fields/data/row_functions.hpp"

namespace comma::commands {

namespace {

using interpreter::DiagnosticError;
using interpreter::Keywords;
// A value, where it comes among all places, absent values included, and the columns that say where it was read.
struct Sample {
  Row place;
  double value;
  std::size_t turn = 0;
};

const PlaceKeywords places_of_nodes = {"", "GROUP_NO", "NOEUD", "GROUP_MA", "MAILLE"};

double reduced(const std::string& operation, const std::vector<Sample>& samples) {
  std::vector<double> values;
  for (const Sample& sample : samples) values.push_back(sample.value);
  if (operation == "MIN") return least(values);
  if (operation == "MAX") return greatest(values);
  if (operation == "MINI_ABS") return least_size(values);
  return operation == "MAXI_ABS" ? greatest_size(values) : mean_of(values);
}

std::vector<int> all_indices(int count) {
  std::vector<int> indices(static_cast<std::size_t>(count));
  std::iota(indices.begin(), indices.end(), 0);
  return indices;
}

std::vector<int> by_number(std::vector<int> indices) {
  std::ranges::sort(indices);
  return indices;
}

std::vector<Sample> samples_of(const solver::NodalField& field, int component, const solver::Mesh& mesh,
                               const std::vector<int>& nodes) {
  std::vector<Sample> samples;
  std::size_t turn = 0;
  for (const int node : nodes) {
    if (const double value = field.at(node, component); !std::isnan(value))
      samples.push_back({{{"NOEUD", table_node(mesh, node)}}, value, turn});
    ++turn;
  }
  return samples;
}

// Those of `count` that POINT or SOUS_POINT names, all without it, counted from 0.
std::vector<int> chosen_of(const Keywords& keywords, const char* keyword, int count) {
  if (!keywords.has(keyword)) return all_indices(count);
  std::vector<int> chosen;
  for (const auto number : keywords.integers(keyword)) {
    if (number >= 1 && number <= count) chosen.push_back(static_cast<int>(number) - 1);
  }
  return chosen;
}

std::vector<Sample> samples_of(const solver::ElementField& field, int component, const solver::Mesh& mesh,
                               const std::vector<int>& cells, const Keywords& keywords) {
  std::vector<Sample> samples;
  std::size_t turn = 0;
  const std::string& over_points = keywords.text("EVAL_ELGA");
  for (const int cell : cells) {
    std::vector<Sample> own;
    const int each = field.values_a_point(cell);
    for (const int point : chosen_of(keywords, "POINT", field.points(cell) / each)) {
      for (const int place : chosen_of(keywords, "SOUS_POINT", each)) {
        const double value = field.at(cell, point * each + place, component);
        ++turn;
        if (std::isnan(value)) continue;
        own.push_back({{{"MAILLE", table_cell(mesh, cell)}, {"POINT", std::int64_t{point + 1}}}, value, turn});
        own.back().place.emplace_back("SOUS_POINT", std::int64_t{place + 1});
      }
    }
    if (over_points != "VALE" && !own.empty()) {
      own = {{{{"MAILLE", table_cell(mesh, cell)}}, reduced(over_points, own), turn}};
    }
    samples.insert(samples.end(), own.begin(), own.end());
  }
  return samples;
}

// One component, under the name of the formula.
solver::Field formula_of(const Keywords& keywords, const solver::Field& held, const solver::Mesh& mesh) {
  if (!keywords.has("FORMULE"))
    throw DiagnosticError("missing-keyword", "OBSERVATION: EVAL_CMP='FORMULE' needs FORMULE", keywords.span);
  const auto& handle = keywords.concept_of("FORMULE");
  const auto& function = interpreter::data_of<FunctionConcept>(handle, "FORMULE");
  const auto& components = solver::components_of(held);
  try {
    const auto value = [&function](std::span<const double> at) { return function.evaluate(at); };
    solver::Field made =
        solver::made_of_rows(held, std::array{solver::formula(components, {function.parameters(), value})});
    require_finite(made, mesh, "OBSERVATION", keywords.span_of("FORMULE"));
    std::visit([&](auto& any) { any.components = {handle->name}; }, made);
    return made;
  } catch (const solver::Error& error) {
    throw DiagnosticError(error.code(), std::string("OBSERVATION: ") + error.what(), keywords.span_of("FORMULE"),
                          error.hint());
  }
}

// Where a place of the wrong kind alone is named nothing would be observed.
void check_place(const Keywords& keywords, const solver::Field& field) {
  const bool at_nodes = std::holds_alternative<solver::NodalField>(field);
  if (at_nodes || !names_a_place(keywords, places_of_nodes) || names_a_place(keywords, cell_places)) return;
  throw DiagnosticError(
      "wrong-place",
      fmt::format("OBSERVATION: {} has its values on cells, and none are named", keywords.text("NOM_CHAM")),
      keywords.span, "name cells by GROUP_MA or MAILLE");
}

std::size_t rows_of(const std::optional<StepTable>& kept) { return kept ? kept->table.rows.size() : 0; }

}  // namespace

Observer::Observer(const interpreter::Call& call, const ResultConcept& computed)
    : computed_(computed), mesh_(computed.result.mesh()), rows_before_(rows_of(computed.observations)) {
  for (const Keywords& given : call.factors("OBSERVATION")) {
    const bool everywhere = !names_a_place(given, places_of_nodes);
    Observation observation{
        given,
        given.has("TITRE") ? given.text("TITRE") : fmt::format("OBSERVATION_{}", observations_.size() + 1),
        everywhere ? all_indices(mesh_.node_count()) : by_number(selected_nodes(given, mesh_, places_of_nodes)),
        everywhere ? all_indices(mesh_.cell_count()) : by_number(selected_cells(given, mesh_, cell_places)),
        given.reals("INST"),
        instant_tolerance(given)};
    if (given.has("LIST_INST")) observation.instants = given.data<ListConcept>("LIST_INST").values;
    observations_.push_back(std::move(observation));
  }
}

bool Observer::is_due(const Observation& observation, double instant, int number) const {
  const Keywords& keywords = observation.keywords;
  if (number == 0) return keywords.text("OBSE_ETAT_INIT") == "OUI";
  if (keywords.has("PAS_OBSE")) return number % std::max<std::int64_t>(1, keywords.integer("PAS_OBSE")) == 0;
  if (observation.instants.empty()) return true;
  return std::ranges::any_of(observation.instants,
                             [&](double wanted) { return observation.tolerance.meets(wanted, instant); });
}

void Observer::observe(int number, Table& table) {
  const solver::ResultStep& step = computed_.result.steps.back();
  Computation computation;
  for (Observation& observation : observations_) {
    if (is_due(observation, step.instant, number)) observe(observation, step, number, computation, table);
  }
}

void Observer::warn_of_nothing(std::span<const double> computed, interpreter::Diagnostics& diagnostics) const {
  for (const Observation& observation : observations_) {
    const Keywords& keywords = observation.keywords;
    constexpr std::array idle = {"POINT", "SOUS_POINT", "EVAL_ELGA"};
    if (observation.at_nodes)
      warn_of_idle_places("OBSERVATION", keywords, std::span(idle).first(keywords.text("EVAL_ELGA") == "VALE" ? 2 : 3),
                          diagnostics);
    if (const auto missed = missed_instants(observation.tolerance, observation.instants, computed); !missed.empty())
      diagnostics.alarm(
          "unknown-step",
          fmt::format("OBSERVATION: no step ends at {}: the table has no row of it", fmt::join(missed, ", ")),
          keywords.span, "name instants of INCREMENT/LIST_INST");
    else if (observation.was_due && observation.rows == 0)
      diagnostics.alarm(
          "unknown-component",
          fmt::format("OBSERVATION: {} has no value there: the table has no row of it", keywords.text("NOM_CHAM")),
          keywords.span, "look at where the field is known, and at NOM_CMP");
  }
}

const solver::Field& Observer::watched(const Keywords& keywords, const solver::ResultStep& step,
                                       Computation& computation, solver::Field& made) const {
  const std::string& name = keywords.text("NOM_CHAM");
  const bool is_computed = !step.fields.contains(name) && solver::FieldComputation::knows(name);
  if (is_computed && !computation) computation.emplace(computed_.problem, computed_.result);
  if (is_computed) made = computation->compute(name, computed_.result.steps.size() - 1);
  const solver::Field& held = is_computed ? made : layered_field_of(keywords, step, name);
  if (keywords.text("EVAL_CMP") == "FORMULE") return made = formula_of(keywords, held, mesh_);
  if (!keywords.given("NOM_VARI")) return held;
  return made = by_variable_names(keywords, held, computed_.problem.behaviours.get());
}

void Observer::observe(Observation& observation, const solver::ResultStep& step, int number, Computation& computation,
                       Table& table) const {
  const Keywords& keywords = observation.keywords;
  // The initial state has not all fields.
  const std::string& name = keywords.text("NOM_CHAM");
  if (number == 0 && !step.fields.contains(name) && !solver::FieldComputation::knows(name)) return;
  observation.was_due = true;
  solver::Field made;
  const solver::Field& field = watched(keywords, step, computation, made);
  check_place(keywords, field);
  const auto& components = solver::components_of(field);
  const std::string& operation = keywords.text("EVAL_CHAM");
  const bool by_formula = keywords.text("EVAL_CMP") == "FORMULE";
  const auto* nodal = std::get_if<solver::NodalField>(&field);
  observation.at_nodes = nodal != nullptr;
  std::vector<std::pair<int, Sample>> found;  // with their components
  for (const int component : by_formula ? std::vector<int>{0} : chosen_components(keywords, components)) {
    std::vector<Sample> samples = nodal != nullptr ? samples_of(*nodal, component, mesh_, observation.nodes)
                                                   : samples_of(std::get<solver::ElementField>(field), component, mesh_,
                                                                observation.cells, keywords);
    if (operation != "VALE" && !samples.empty()) samples = {{{}, reduced(operation, samples)}};
    for (Sample& sample : samples) found.emplace_back(component, std::move(sample));
  }
  std::ranges::stable_sort(found, {}, [](const auto& each) { return each.second.turn; });
  for (const auto& [component, sample] : found) {
    Row row = {{"NOM_OBSERVATION", observation.name},
               {"TYPE_OBJET", "R"},
               {"NUME_REUSE", static_cast<std::int64_t>(computed_.earlier.size())},
               {"NUME_OBSE", static_cast<std::int64_t>(table.rows.size() - rows_before_) + 1},
               {"INST", step.instant},
               {"NOM_CHAM", keywords.text("NOM_CHAM")},
               {"EVAL_CHAM", operation},
               {by_formula ? "EVAL_CMP" : "NOM_CMP", components[static_cast<std::size_t>(component)]}};
    row.insert(row.end(), sample.place.begin(), sample.place.end());
    if (nodal == nullptr && keywords.text("EVAL_ELGA") != "VALE")
      row.emplace_back("EVAL_ELGA", keywords.text("EVAL_ELGA"));
    row.emplace_back("VALE", sample.value);
    table.add_row(row);
    ++observation.rows;
  }
}

}  // namespace comma::commands
