// What a command file may ask a result for (U1.03.02).
#include <algorithm>
#include <functional>

#include <fmt/format.h>

#include "commands/analysis/result_reading.hpp"
#include "commands/concepts.hpp"
#include "commands/methods/method_arguments.hpp"
#include "commands/tables/result_tables.hpp"
#include "interpreter/diagnostic.hpp"
#include "interpreter/values/dict.hpp"

namespace comma::commands {

namespace {

using interpreter::DiagnosticError;
using interpreter::Dict;

Value table_handle(const ResultConcept& data, const std::string& name) {
  std::optional<Table> found = table_of_result(data, name);
  if (!found) return Value();
  auto table = std::make_shared<TableConcept>();
  table->table = *std::move(found);
  auto handle = std::make_shared<interpreter::Concept>();
  handle->name = name;
  handle->type = "table_sdaster";
  handle->id = interpreter::detached_concept;
  handle->data = std::move(table);
  return Value(std::move(handle));
}

/// One value a step.
Value of_steps(const solver::Result& result, const std::function<Value(const solver::ResultStep&)>& value) {
  std::vector<Value> values;
  for (const solver::ResultStep& step : result.steps) values.push_back(value(step));
  return Value::list(std::move(values));
}

std::shared_ptr<Dict> access_variables(const ResultConcept& data) {
  const solver::Result& result = data.result;
  auto lists = std::make_shared<Dict>();
  lists->set(Value("NUME_ORDRE"),
             of_steps(result, [](const auto& step) { return Value(static_cast<std::int64_t>(step.order)); }));
  lists->set(Value("INST"), of_steps(result, [](const auto& step) { return Value(step.instant); }));
  return lists;
}

/// The access variables and the parameters, None where a step has one not.
std::shared_ptr<Dict> access_parameters(const ResultConcept& data) {
  const solver::Result& result = data.result;
  std::shared_ptr<Dict> lists = access_variables(data);
  for (const auto& [name, number] : data.sources)
    lists->set(Value(name), of_steps(result, [&number = number](const auto&) { return Value(number); }));
  for (const solver::ResultStep& described : result.steps)
    for (const auto& entry : described.parameters) {
      const std::string& name = entry.first;
      if (lists->find(Value(name)) != nullptr) continue;
      lists->set(Value(name), of_steps(result, [&](const solver::ResultStep& step) {
                   const auto found = step.parameters.find(name);
                   if (found == step.parameters.end()) return Value();
                   return to_value(parameter_cell(name, found->second));
                 }));
    }
  return lists;
}

/// The order numbers of the steps that have each field.
std::shared_ptr<Dict> fields(const ResultConcept& data) {
  const solver::Result& result = data.result;
  std::map<std::string, std::vector<Value>, std::less<>> orders;
  for (const solver::ResultStep& step : result.steps)
    for (const auto& field : step.fields) orders[field.first].emplace_back(static_cast<std::int64_t>(step.order));
  auto lists = std::make_shared<Dict>();
  for (auto& [name, numbers] : orders) lists->set(Value(name), Value::list(std::move(numbers)));
  return lists;
}

/// The step of an order number, or of an instant.
const solver::ResultStep& step_at(const solver::Result& result, const MethodArguments& given) {
  const std::string parameter = given.text("para", "NUME_ORDRE");
  if (!given.has("value") || (parameter != "NUME_ORDRE" && parameter != "INST"))
    throw DiagnosticError("type-error", "a step is named by its number or its instant", {},
                          "write RESULT.getField(\"DEPL\", 1), or value=1.0, para=\"INST\"");
  const double value = given.real("value");
  const InstantTolerance tolerance{given.real("prec", 1e-6), given.text("crit", "RELATIF") != "ABSOLU"};
  const auto numbered = [&] {
    return static_cast<std::size_t>(
        std::ranges::find(result.steps, value,
                          [](const solver::ResultStep& step) { return static_cast<double>(step.order); }) -
        result.steps.begin());
  };
  const std::size_t step = parameter == "INST" ? nearest_step(result, value, tolerance) : numbered();
  if (step < result.steps.size()) return result.steps[step];
  throw DiagnosticError("unknown-step", fmt::format("the result has no step {}={}", parameter, value));
}

Value field_handle(const ResultConcept& data, const MethodArguments& given) {
  const std::string name = given.needed_text("name");
  const solver::ResultStep& step = step_at(data.result, given);
  const auto found = step.fields.find(name);
  if (found == step.fields.end())
    throw DiagnosticError("unknown-field",
                          fmt::format("the step INST={} of the result holds no {}", step.instant, name), {},
                          "compute it by CALC_CHAMP before");
  require_one_value_a_point(name, found->second, {});
  auto field = std::make_shared<FieldConcept>();
  field->field = found->second;
  field->model = data.result.model;
  field->behaviours = data.problem_of(step).behaviours;
  field->mesh = data.result.model ? data.result.model->mesh : data.result.bare_mesh;
  auto handle = std::make_shared<interpreter::Concept>();
  handle->name = name;
  handle->type = std::holds_alternative<solver::NodalField>(field->field) ? "cham_no_sdaster" : "cham_elem";
  handle->id = interpreter::detached_concept;
  handle->data = std::move(field);
  return Value(std::move(handle));
}

const solver::ResultStep& end_of(const solver::Result& result, bool last) {
  if (result.steps.empty()) throw DiagnosticError("unknown-step", "the result has no step");
  return last ? result.steps.back() : result.steps.front();
}

struct ResultMethod {
  std::vector<std::string> parameters;
  Value (*code)(const ResultConcept&, const MethodArguments&);
};

const std::map<std::string, ResultMethod, std::less<>>& step_methods() {
  using Arguments = MethodArguments;
  static const auto order = [](const solver::ResultStep& step) { return Value(static_cast<std::int64_t>(step.order)); };
  static const std::map<std::string, ResultMethod, std::less<>> table = {
      {"getIndexes", {{}, [](const ResultConcept& data, const Arguments&) { return of_steps(data.result, order); }}},
      {"getNumberOfIndexes",
       {{},
        [](const ResultConcept& data, const Arguments&) {
          return Value(static_cast<std::int64_t>(data.result.steps.size()));
        }}},
      {"getFirstIndex",
       {{}, [](const ResultConcept& data, const Arguments&) { return order(end_of(data.result, false)); }}},
      {"getLastIndex",
       {{}, [](const ResultConcept& data, const Arguments&) { return order(end_of(data.result, true)); }}},
      {"getLastTime",
       {{}, [](const ResultConcept& data, const Arguments&) { return Value(end_of(data.result, true).instant); }}},
      {"getTime",
       {{"value"},
        [](const ResultConcept& data, const Arguments& given) { return Value(step_at(data.result, given).instant); }}},
      {"getFieldsNames",
       {{}, [](const ResultConcept& data, const Arguments&) { return Value::list(fields(data)->keys()); }}},
      {"getField", {{"name", "value", "para", "crit", "prec"}, field_handle}}};
  return table;
}

using ResultLists = std::map<std::string_view, std::shared_ptr<Dict> (*)(const ResultConcept&)>;

const ResultLists& list_methods() {
  static const ResultLists table = {{"LIST_VARI_ACCES", access_variables},
                                    {"getAccessParameters", access_variables},
                                    {"LIST_PARA", access_parameters},
                                    {"LIST_CHAMPS", fields}};
  return table;
}

}  // namespace

const solver::StaticProblem& ResultConcept::problem_of(const solver::ResultStep& step) const {
  const auto phase =
      std::ranges::find_if(earlier, [&](const EarlierPhase& each) { return step.order <= each.last_order; });
  return phase == earlier.end() ? problem : phase->problem;
}

std::vector<std::string> ResultConcept::method_names() const {
  std::vector<std::string> names = names_of_methods(step_methods());
  for (const auto& list : list_methods()) names.emplace_back(list.first);
  names.emplace_back("getTable");
  return names;
}

Value ResultConcept::method(std::string_view name, const std::vector<Value>& arguments,
                            const std::map<std::string, Value>& keywords) const {
  if (name == "getTable") {
    if (arguments.size() == 1 && arguments.front().is_text() && keywords.empty())
      return table_handle(*this, arguments.front().as_text());
    throw DiagnosticError("type-error", "getTable() takes the name of a table", {},
                          "write RESULT.getTable(\"PARA_CALC\")");
  }
  if (const auto found = step_methods().find(name); found != step_methods().end())
    return found->second.code(*this, MethodArguments(name, arguments, keywords, found->second.parameters));
  const auto list = list_methods().find(name);
  if (list == list_methods().end()) return ConceptData::method(name, arguments, keywords);
  if (arguments.empty() && keywords.empty()) return Value(list->second(*this));
  throw DiagnosticError("type-error", std::string(name) + "() takes no arguments", {},
                        "write RESULT." + std::string(name) + "()");
}

}  // namespace comma::commands
