#include "commands/analysis/result_reading.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "commands/nearest.hpp"
#include "interpreter/diagnostic.hpp"
#include "solver/error.hpp"
#include "solver/fields/field_computation.hpp"
#include "solver/fields/points/variable_names.hpp"
#include "solver/fields/relation_multipliers.hpp"

namespace comma::commands {

using interpreter::DiagnosticError;
using interpreter::Keywords;
using solver::ResultStep;

namespace {

std::string known_instants(const solver::Result& result) {
  if (result.steps.empty()) return "the result holds no step";
  return fmt::format("the result holds {} steps, from INST={} to INST={}", result.steps.size(),
                     result.steps.front().instant, result.steps.back().instant);
}

// Null where no step stands there.
const ResultStep* find_step(const Keywords& keywords, const solver::Result& result, double instant) {
  const std::size_t nearest = nearest_step(result, instant, instant_tolerance(keywords));
  return nearest == result.steps.size() ? nullptr : &result.steps[nearest];
}

const ResultStep& step_at(const Keywords& keywords, const solver::Result& result, double instant) {
  if (const ResultStep* step = find_step(keywords, result, instant)) return *step;
  throw DiagnosticError("unknown-step", fmt::format("no step of the result stands at INST={}", instant),
                        keywords.span_of("INST"), known_instants(result));
}

const ResultStep& step_numbered(const Keywords& keywords, const solver::Result& result, std::int64_t order,
                                const char* keyword) {
  for (const ResultStep& step : result.steps) {
    if (step.order == order) return step;
  }
  throw DiagnosticError("unknown-step", fmt::format("no step of the result has NUME_ORDRE={}", order),
                        keywords.span_of(keyword), known_instants(result));
}

}  // namespace

InstantTolerance instant_tolerance(const Keywords& keywords) {
  InstantTolerance tolerance;
  const bool verdict = keywords.has("TOLE_MACHINE");
  const auto precisions = verdict ? keywords.reals("TOLE_MACHINE") : keywords.reals("PRECISION");
  const auto criteria = keywords.texts("CRITERE");
  const std::size_t which = verdict ? 1 : 0;
  if (precisions.size() > which) tolerance.precision = precisions[which];
  if (criteria.size() > which) tolerance.relative = criteria[which] == "RELATIF";
  return tolerance;
}

std::size_t nearest_step(const solver::Result& result, double instant, const InstantTolerance& tolerance) {
  return nearest_within(result.steps, instant, tolerance.reach(instant), &ResultStep::instant)
      .value_or(result.steps.size());
}

double instant_reach(const Keywords& keywords, double instant) { return instant_tolerance(keywords).reach(instant); }

std::vector<const ResultStep*> selected_steps(const Keywords& keywords, const solver::Result& result) {
  std::vector<const ResultStep*> steps;
  if (keywords.given("INST")) {
    for (const double instant : keywords.reals("INST")) steps.push_back(&step_at(keywords, result, instant));
  } else if (keywords.given("LIST_INST")) {
    // A list is one of computations as a rule, and names the steps that a result has of it.
    const auto& wanted = keywords.data<ListConcept>("LIST_INST").values;
    for (const double instant : wanted)
      if (const ResultStep* step = find_step(keywords, result, instant)) steps.push_back(step);
    if (steps.empty() && !wanted.empty()) steps.push_back(&step_at(keywords, result, wanted.front()));
  } else if (keywords.given("NUME_ORDRE")) {
    for (const auto order : keywords.integers("NUME_ORDRE"))
      steps.push_back(&step_numbered(keywords, result, order, "NUME_ORDRE"));
  } else if (keywords.given("LIST_ORDRE")) {
    for (const auto order : keywords.data<IntegerListConcept>("LIST_ORDRE").values)
      steps.push_back(&step_numbered(keywords, result, order, "LIST_ORDRE"));
  } else {
    for (const ResultStep& step : result.steps) steps.push_back(&step);
  }
  return steps;
}

void warn_of_idle_places(const char* command, const Keywords& keywords, std::span<const char* const> idle,
                         interpreter::Diagnostics& diagnostics) {
  for (const char* keyword : idle)
    if (keywords.given(keyword))
      diagnostics.alarm("idle-keyword",
                        fmt::format("{}: {} has no effect here: the field has its values at nodes", command, keyword),
                        keywords.span_of(keyword), "leave it out, or name a field on cells");
}

void warn_of_missing_instants(const char* command, const Keywords& keywords, interpreter::Diagnostics& diagnostics) {
  if (!keywords.has("RESULTAT") || !keywords.given("LIST_INST")) return;
  const solver::Result& result = keywords.data<ResultConcept>("RESULTAT").result;
  std::vector<double> missing;
  for (const double instant : keywords.data<ListConcept>("LIST_INST").values)
    if (find_step(keywords, result, instant) == nullptr) missing.push_back(instant);
  if (missing.empty()) return;
  constexpr std::size_t most_shown = 5;
  const std::span<const double> shown(missing.data(), std::min(missing.size(), most_shown));
  diagnostics.alarm("unknown-step",
                    fmt::format("{}: {} has no step at {} of the instants of LIST_INST: {}{}", command,
                                keywords.concept_of("RESULTAT")->name, missing.size(), fmt::join(shown, ", "),
                                missing.size() > most_shown ? " ..." : ""),
                    keywords.span_of("LIST_INST"), "those that it has are taken");
}

std::vector<double> missed_instants(const InstantTolerance& tolerance, std::span<const double> wanted,
                                    std::span<const double> computed) {
  std::vector<double> missed;
  for (const double instant : wanted) {
    const bool is_among = !computed.empty() && instant > computed.front() && instant < computed.back();
    if (is_among && std::ranges::none_of(computed, [&](double each) { return tolerance.meets(instant, each); }))
      missed.push_back(instant);
  }
  return missed;
}

const ResultStep& only_step(const Keywords& keywords, const solver::Result& result, const char* reason) {
  const auto steps = selected_steps(keywords, result);
  if (steps.size() == 1) return *steps.front();
  throw DiagnosticError("wrong-count", fmt::format("these keywords name {} steps; {}", steps.size(), reason),
                        keywords.span, "give INST or NUME_ORDRE");
}

std::vector<const ResultStep*> steps_with_field(const Keywords& keywords, const solver::Result& result) {
  auto steps = selected_steps(keywords, result);
  const bool named =
      std::ranges::any_of(std::array{"INST", "NUME_ORDRE"}, [&](const char* name) { return keywords.given(name); });
  if (named) return steps;
  const std::string& field = keywords.text("NOM_CHAM");
  const auto lacks = [&](const ResultStep* step) { return !step->fields.contains(field); };
  // Where none has it, reading the first one says what there is.
  if (!std::ranges::all_of(steps, lacks)) std::erase_if(steps, lacks);
  return steps;
}

bool is_layered(const solver::Field& field) {
  const auto* on_cells = std::get_if<solver::ElementField>(&field);
  return on_cells != nullptr && !on_cells->sub_points.empty();
}

void require_one_value_a_point(const std::string& name, const solver::Field& field, const interpreter::Span& span) {
  if (!is_layered(field)) return;
  throw DiagnosticError(
      "layered-field",
      fmt::format("{} has several values a point on plates, one for each place in their thickness", name), span,
      "POST_CHAMP with EXTR_COQUE takes one of them");
}

const solver::Field& field_of(const Keywords& keywords, const ResultStep& step) {
  const std::string& name = keywords.text("NOM_CHAM");
  const solver::Field& field = layered_field_of(keywords, step, name);
  require_one_value_a_point(name, field, keywords.span_of("NOM_CHAM"));
  return field;
}

const solver::Field& layered_field_of(const Keywords& keywords, const ResultStep& step, const std::string& name) {
  const auto found = step.fields.find(name);
  if (found != step.fields.end()) return found->second;
  std::vector<std::string> known;
  for (const auto& [field, _] : step.fields) known.push_back(field);
  throw DiagnosticError("unknown-field", fmt::format("step INST={} of the result holds no {}", step.instant, name),
                        keywords.span_of("NOM_CHAM"),
                        fmt::format("it holds {}; CALC_CHAMP computes more", fmt::join(known, ", ")));
}

int sub_point(const Keywords& keywords, const solver::ElementField& field, int cell, const solver::Mesh& mesh) {
  const int count = field.values_a_point(cell);
  if (!keywords.given("SOUS_POINT")) {
    if (count == 1) return 0;
    throw DiagnosticError("missing-keyword",
                          fmt::format("the field has {} values a point on cell {}, one for each place in its thickness",
                                      count, mesh.cell_name(cell)),
                          keywords.span,
                          "name one by SOUS_POINT: 1 at the lower side, 2 in the middle, 3 at the upper side of the "
                          "lowest layer, and so on");
  }
  const auto wanted = keywords.integer("SOUS_POINT");
  if (wanted <= count) return static_cast<int>(wanted) - 1;
  throw DiagnosticError("out-of-bounds",
                        fmt::format("SOUS_POINT: the field has {} a point on cell {}",
                                    count == 1 ? "one value" : fmt::format("{} values", count), mesh.cell_name(cell)),
                        keywords.span_of("SOUS_POINT"),
                        count == 1 ? "give 1, or leave it out" : fmt::format("give 1 to {}", count));
}

std::vector<double> multipliers_of(const ResultConcept& data, const ResultStep& step) {
  const solver::StaticProblem& problem = data.problem_of(step);
  if (!problem.model || !problem.materials) return {};
  solver::FieldComputation computation(problem, data.result);
  const solver::Field reactions =
      computation.compute("REAC_NODA", static_cast<std::size_t>(&step - data.result.steps.data()));
  return solver::relation_multipliers(solver::DofMap(*problem.model), problem.loads,
                                      std::get<solver::NodalField>(reactions));
}

solver::Field by_variable_names(const Keywords& keywords, const solver::Field& field,
                                const solver::BehaviourOfCells* behaviours) {
  try {
    return solver::by_variable_names(field, behaviours);
  } catch (const solver::Error& error) {
    throw DiagnosticError(error.code(), std::string("NOM_VARI: ") + error.what(), keywords.span_of("NOM_CHAM"),
                          "give VARI_ELGA, VARI_ELNO or VARI_NOEU");
  }
}

int component_of(const Keywords& keywords, const std::vector<std::string>& components, const std::string& name,
                 const char* keyword) {
  const auto found = std::find(components.begin(), components.end(), name);
  if (found != components.end()) return static_cast<int>(found - components.begin());
  throw DiagnosticError("unknown-component", "the field has no component " + name, keywords.span_of(keyword),
                        fmt::format("it has {}", fmt::join(components, ", ")));
}

Product result_with(const interpreter::Call& call, const std::function<void(ResultConcept&)>& add) {
  auto& source = call.data<ResultConcept>("RESULTAT");
  if (call.reuse) {
    add(source);
    return nullptr;
  }
  auto product = std::make_shared<ResultConcept>(source);
  add(*product);
  return product;
}

}  // namespace comma::commands
