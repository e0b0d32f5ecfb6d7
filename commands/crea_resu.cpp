#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <type_traits>

#include "commands/analysis/behaviour_reading.hpp"
#include "commands/analysis/problem_building.hpp"
#include "commands/analysis/result_reading.hpp"
#include "commands/analysis/same_mesh.hpp"
#include "commands/commands.hpp"
#include "commands/fields/field_types.hpp"
#include "interpreter/diagnostic.hpp"
#include "solver/fields/data/field_room.hpp"

namespace comma::commands {

namespace {

using interpreter::DiagnosticError;

// A field of functions is evaluated with the instant and, at nodes, their coordinates (U4.44.12).
solver::Field at_instant(const FieldConcept& data, double instant, const interpreter::Span& span) {
  if (data.functions.empty()) return data.field;
  const solver::Field time = solver::uniform_like(data.field, "INST", instant);
  std::vector<const solver::Field*> known = {&time};
  std::optional<solver::Field> coordinates;
  if (std::holds_alternative<solver::NodalField>(data.field))
    known.push_back(&coordinates.emplace(solver::node_coordinates(*data.mesh)));
  const std::string quantity = std::visit([](const auto& field) { return field.quantity; }, data.field);
  solver::Field made = solver::evaluate(*data.mesh, data.field, value_functions(data), known, quantity);
  require_finite(made, *data.mesh, "CREA_RESU", span);
  return made;
}

using Origin = std::shared_ptr<const solver::StaticProblem>;

// What EXCIT and COMPORTEMENT say, so that occurrences that say the same share what their steps were computed from.
struct StateWords {
  std::vector<std::tuple<const interpreter::Concept*, const interpreter::Concept*, std::string>> loads;
  solver::BehaviourOfCells behaviours;

  bool operator==(const StateWords&) const = default;
};

// A result in the making: what each of its steps was computed from; null where that is `product.problem`, which
// occurrences fill.
struct Making {
  ResultConcept& product;
  std::vector<Origin> origins;
  Origin current = {};  ///< of new steps: what the last occurrence with EXCIT or COMPORTEMENT says
  StateWords words = {};
  int first_order = 1;

  explicit Making(ResultConcept& made) : product(made) {
    std::size_t phase = 0;
    Origin of_phase;
    for (const solver::ResultStep& step : product.result.steps) {
      while (phase < product.earlier.size() && step.order > product.earlier[phase].last_order) {
        ++phase;
        of_phase.reset();
      }
      if (phase < product.earlier.size() && !of_phase)
        of_phase = std::make_shared<const solver::StaticProblem>(product.earlier[phase].problem);
      origins.push_back(of_phase);
    }
  }

  // The step at an instant, made in its place among the others if there is none so near. `state`: what it goes on from;
  // null: as it was.
  solver::ResultStep& step_at(double instant, const InstantTolerance& tolerance, const Origin& state) {
    auto& steps = product.result.steps;
    if (const std::size_t found = nearest_step(product.result, instant, tolerance); found < steps.size()) {
      if (state) origins[found] = state;
      return steps[found];
    }
    const auto later = std::ranges::find_if(steps, [&](const auto& step) { return step.instant > instant; });
    origins.insert(origins.begin() + (later - steps.begin()), current);
    solver::ResultStep& made = *steps.insert(later, solver::ResultStep{});
    made.instant = instant;
    return made;
  }

  // Numbers the steps, and makes phases of those in a row that have one origin.
  void settle() {
    auto& steps = product.result.steps;
    solver::StaticProblem& own = product.problem;
    if (!own.properties) own.properties = std::make_shared<const solver::ElementProperties>();
    if (current && own.loads.empty() && !own.behaviours)
      own = completed(*current);  // also of steps that came before it
    const solver::StaticProblem whole = own;
    product.earlier.clear();
    for (std::size_t k = 0; k < steps.size(); ++k) {
      steps[k].order = first_order + static_cast<int>(k);
      const solver::StaticProblem problem = origins[k] ? completed(*origins[k]) : whole;
      if (k + 1 == steps.size())
        own = problem;
      else if (origins[k + 1] != origins[k])
        product.earlier.push_back({steps[k].order, problem});
    }
  }

  // With what later occurrences said of the whole result.
  solver::StaticProblem completed(solver::StaticProblem problem) const {
    if (!problem.model) problem.model = product.problem.model;
    if (!problem.materials) problem.materials = product.problem.materials;
    if (!problem.properties) problem.properties = product.problem.properties;
    return problem;
  }
};

// A result has one model, one material field and so on for all of its steps.
void require_one(bool is_same, const Keywords& occurrence, const char* keyword) {
  if (is_same) return;
  throw DiagnosticError(
      "one-for-all-steps",
      fmt::format("CREA_RESU: another {} than that of the steps before: in comma a result has one for all of its steps",
                  keyword),
      occurrence.span_of(keyword), "make one result for each");
}

template <class Part>
void take_part(const Keywords& occurrence, const char* keyword, const std::shared_ptr<Part>& part,
               const solver::Mesh* own, const solver::Mesh& mesh,
               std::shared_ptr<const std::remove_const_t<Part>>& target) {
  require_mesh(occurrence, keyword, own, mesh);
  require_one(!target || target == part, occurrence, keyword);
  target = part;
}

void take_support(ResultConcept& product, const Keywords& occurrence, const FieldConcept& data) {
  solver::Result& result = product.result;
  const solver::Mesh& mesh = *data.mesh;
  if (occurrence.has("MODELE")) {
    const auto& model = occurrence.data<ModelConcept>("MODELE").model;
    take_part(occurrence, "MODELE", model, model->mesh.get(), mesh, product.problem.model);
  } else if (!product.problem.model) {
    product.problem.model = data.model;
  }
  if (occurrence.has("CHAM_MATER")) {
    const auto& materials = occurrence.data<MaterialFieldConcept>("CHAM_MATER");
    const auto field = materials.field.get();
    if (product.problem.materials && materials.field.has_made(product.problem.materials))
      product.problem.materials = field;
    take_part(occurrence, "CHAM_MATER", field, materials.mesh.get(), mesh, product.problem.materials);
  }
  if (occurrence.has("CARA_ELEM")) {
    const auto& properties = occurrence.data<PropertiesConcept>("CARA_ELEM");
    take_part(occurrence, "CARA_ELEM", properties.properties, properties.model ? properties.model->mesh.get() : nullptr,
              mesh, product.problem.properties);
  }
  if (!result.steps.empty() && &result.mesh() != data.mesh.get()) {
    throw DiagnosticError("incompatible-field", "CREA_RESU: the field lies on another mesh than those before it",
                          occurrence.span_of("CHAM_GD"), "make one result for each mesh");
  }
  result.model = product.problem.model;
  result.bare_mesh = data.mesh;
}

// The instants of an occurrence; of LIST_INST those from NUME_INIT to NUME_FIN, which count from 1.
std::vector<double> instants_of(const Keywords& occurrence) {
  if (!occurrence.has("LIST_INST")) return occurrence.reals("INST");
  const auto& all = occurrence.data<ListConcept>("LIST_INST").values;
  const auto count = static_cast<std::int64_t>(all.size());
  const auto first = occurrence.given("NUME_INIT") ? std::max<std::int64_t>(1, occurrence.integer("NUME_INIT")) : 1;
  const auto last = occurrence.given("NUME_FIN") ? std::min(count, occurrence.integer("NUME_FIN")) : count;
  if (first > last)
    throw DiagnosticError(
        "out-of-bounds",
        fmt::format("CREA_RESU: no instant stands between number {} and number {} of {}", first, last, count),
        occurrence.span);
  return {all.begin() + first - 1, all.begin() + last};
}

StateWords state_words(const Keywords& occurrence, const solver::StaticProblem& problem) {
  StateWords words;
  if (occurrence.has("EXCIT"))
    for (const Keywords& excitation : occurrence.factors("EXCIT"))
      words.loads.emplace_back(excitation.concept_of("CHARGE").get(),
                               excitation.has("FONC_MULT") ? excitation.concept_of("FONC_MULT").get() : nullptr,
                               excitation.has("TYPE_CHARGE") ? excitation.text("TYPE_CHARGE") : std::string());
  if (problem.behaviours) words.behaviours = *problem.behaviours;
  return words;
}

// What computations on the steps of the occurrence go on from: loads and behaviour, which stand beside the occurrences
// or, in older files, in each of them. Null where nothing is said of them.
Origin state_of(Making& making, const Call& call, const Keywords& occurrence) {
  const Keywords& loads = occurrence.has("EXCIT") ? occurrence : call;
  const Keywords& laws = occurrence.has("COMPORTEMENT") ? occurrence : call;
  if (!loads.has("EXCIT") && !laws.has("COMPORTEMENT")) return nullptr;
  auto problem = std::make_shared<solver::StaticProblem>(making.current ? *making.current : making.product.problem);
  if (loads.has("EXCIT")) take_loads(loads, *problem);
  if (laws.has("COMPORTEMENT")) {
    problem->model = making.product.problem.model;
    if (!problem->model) {
      throw DiagnosticError("missing-keyword", "CREA_RESU: a behaviour belongs to the cells of a model",
                            laws.span_of("COMPORTEMENT"), "give MODELE");
    }
    problem->behaviours = behaviours_of(laws, *problem->model, nullptr, false);
  }
  StateWords words = state_words(loads, *problem);
  if (making.current && words == making.words) return making.current;
  making.words = std::move(words);
  return making.current = problem;
}

// The name of the field stands in the occurrence, in older files once beside them.
const std::string& field_name(const Call& call, const Keywords& occurrence) {
  if (occurrence.has("NOM_CHAM")) return occurrence.text("NOM_CHAM");
  if (call.has("NOM_CHAM")) return call.text("NOM_CHAM");
  throw DiagnosticError("missing-keyword", "CREA_RESU/AFFE needs NOM_CHAM", occurrence.span,
                        "give the name of the field in the result, such as DEPL or SIEF_ELGA");
}

void add_field(Making& making, const Call& call, const Keywords& occurrence) {
  const auto& data = interpreter::data_of<FieldConcept>(occurrence.concept_of("CHAM_GD"), "CHAM_GD");
  take_support(making.product, occurrence, data);
  const Origin state = state_of(making, call, occurrence);
  for (const double instant : instants_of(occurrence)) {
    solver::ResultStep& step = making.step_at(instant, instant_tolerance(occurrence), state);
    step.fields.insert_or_assign(field_name(call, occurrence), at_instant(data, instant, occurrence.span));
  }
}

// OPERATION='ASSE': the steps of a result, later by TRANSLATION, in place of those from its first instant on.
void append(Making& making, const Keywords& occurrence) {
  const auto& source = occurrence.data<ResultConcept>("RESULTAT");
  ResultConcept& product = making.product;
  auto& steps = product.result.steps;
  if (steps.empty()) {
    product.result = source.result;
    steps.clear();
  } else if (&product.result.mesh() != &source.result.mesh()) {
    throw DiagnosticError("incompatible-field", "CREA_RESU: the results lie on different meshes",
                          occurrence.span_of("RESULTAT"));
  }
  if (product.result.model && source.result.model &&
      product.result.model->formulations != source.result.model->formulations)
    throw DiagnosticError(
        "one-for-all-steps",
        "CREA_RESU: the results lie on models with other elements: in comma a result has one for all of its steps",
        occurrence.span_of("RESULTAT"), "make one result for each");
  if (source.result.steps.empty()) return;
  const double shift = occurrence.real("TRANSLATION");
  const double first = source.result.steps.front().instant + shift;
  constexpr double same_instant = 1e-9;
  const auto replaced = std::ranges::find_if(
      steps, [&](const auto& step) { return step.instant >= first - same_instant * std::abs(first); });
  making.origins.resize(static_cast<std::size_t>(replaced - steps.begin()));
  steps.erase(replaced, steps.end());
  const solver::StaticProblem* before = nullptr;
  for (const solver::ResultStep& step : source.result.steps) {
    const solver::StaticProblem& problem = source.problem_of(step);
    making.origins.push_back(before == &problem ? making.origins.back()
                                                : std::make_shared<const solver::StaticProblem>(problem));
    before = &problem;
    steps.push_back(step);
    steps.back().instant += shift;
  }
}

}  // namespace

Product crea_resu(const Call& call, Context&) {
  auto product = call.reuse ? std::make_shared<ResultConcept>(interpreter::data_of<ResultConcept>(call.result, "reuse"))
                            : std::make_shared<ResultConcept>();
  Making making(*product);
  for (const Keywords& occurrence : call.factors("ASSE")) append(making, occurrence);
  if (!product->result.steps.empty()) making.first_order = product->result.steps.front().order;
  for (const Keywords& occurrence : call.factors("AFFE")) add_field(making, call, occurrence);
  making.settle();
  if (!call.reuse) return product;
  call.result->data = product;
  return nullptr;
}

}  // namespace comma::commands
