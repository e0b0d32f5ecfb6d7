#include "commands/functions/functions.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "commands/diagnosed.hpp"
#include "commands/functions/function_building.hpp"
#include "commands/nearest.hpp"
#include "interpreter/diagnostic.hpp"
#include "interpreter/values/array.hpp"
#include "solver/error.hpp"
#include "solver/functions/deformed_place.hpp"

namespace comma::commands {

using interpreter::ConceptPtr;
using interpreter::Diagnostic;
using interpreter::DiagnosticError;
using interpreter::Span;
using interpreter::Value;

namespace {

std::shared_ptr<const FunctionConcept> function_behind(const ConceptPtr& handle) {
  interpreter::data_of<FunctionConcept>(handle);  // says what is wrong when it is none
  return std::dynamic_pointer_cast<const FunctionConcept>(handle->data);
}

bool is_deformed(const std::string& parameter) { return parameter == "XF" || parameter == "YF" || parameter == "ZF"; }

/// For each parameter of the function, its place among `known`.
std::vector<std::size_t> places_of(const FunctionConcept& function, const std::string& name,
                                   const std::vector<std::string>& known, const Span& span) {
  std::vector<std::size_t> places;
  for (const std::string& parameter : function.parameters()) {
    const auto found = std::find(known.begin(), known.end(), parameter);
    if (found == known.end() && is_deformed(parameter)) {
      throw DiagnosticError(
          "unsupported",
          fmt::format("{} depends on {}, a place on the deformed body, which pressures alone know (PRES_REP)", name,
                      parameter),
          span, "let it depend on the initial place: X, Y, Z");
    }
    if (found == known.end()) {
      throw DiagnosticError("unknown-parameter",
                            fmt::format("{} depends on {}, which has no value here", name, parameter), span,
                            fmt::format("here a function may depend on {}", fmt::join(known, ", ")));
    }
    places.push_back(static_cast<std::size_t>(found - known.begin()));
  }
  return places;
}

const std::vector<std::string>& place_and_time() {
  static const std::vector<std::string> names = {"X", "Y", "Z", "INST"};
  return names;
}

/// The weight of the upper of the two values around `at`, on the scale of the parameter.
double weight(solver::Scale scale, double lower, double upper, double at) {
  if (scale == solver::Scale::linear) return (at - lower) / (upper - lower);
  if (!(lower > 0.0 && at > 0.0)) {
    throw solver::Error(
        "out-of-function",
        fmt::format("a function is interpolated on a logarithmic scale at {}, which is not positive", at));
  }
  return std::log(at / lower) / std::log(upper / lower);
}

/// The value at a share of the way from one value to the next, on their scale.
double between(solver::Scale scale, double low, double high, double share) {
  if (scale == solver::Scale::linear) return low + share * (high - low);
  if (!(low > 0.0 && high > 0.0)) {
    throw solver::Error(
        "out-of-function",
        fmt::format("values are interpolated on a logarithmic scale between {} and {}, which are not both positive",
                    low, high));
  }
  return low * std::pow(high / low, share);
}

}  // namespace

Value list_of(std::span<const double> values) { return Value::list(std::vector<Value>(values.begin(), values.end())); }

namespace {

using Items = std::vector<std::pair<std::string, Value>>;

Value array_of(const std::vector<double>& values) {
  return interpreter::make_value({values, {values.size()}, interpreter::NumberType::real});
}

Value word(std::string_view text) { return Value(std::string(text)); }

Value scales_of(const solver::TabulatedFunction& table) {
  return Value::list({word(word_of(table.x_scale)), word(word_of(table.y_scale))});
}

Items attributes_of(const solver::TabulatedFunction& table) {
  return {{"INTERPOL", scales_of(table)},
          {"NOM_PARA", Value(table.parameter)},
          {"NOM_RESU", Value(table.result)},
          {"PROL_GAUCHE", word(word_of(table.left))},
          {"PROL_DROITE", word(word_of(table.right))}};
}

}  // namespace

std::vector<std::string> FunctionConcept::method_names() const {
  if (points() == nullptr) return {};
  return {"Absc", "Ordo", "Parametres", "Valeurs", "getValues", "getValuesAsArray", "size"};
}

Value FunctionConcept::method(std::string_view name, const std::vector<Value>& arguments,
                              const std::map<std::string, Value>& keywords) const {
  const solver::TabulatedFunction* shown = points();
  if (shown != nullptr && arguments.empty() && keywords.empty()) {
    if (name == "Absc") return array_of(shown->x);
    if (name == "Ordo") return array_of(shown->y);
    if (name == "getValues") {
      std::vector<double> values = shown->x;
      values.insert(values.end(), shown->y.begin(), shown->y.end());
      return list_of(values);
    }
    if (name == "getValuesAsArray") {
      std::vector<double> rows;
      for (std::size_t i = 0; i < shown->x.size(); ++i) rows.insert(rows.end(), {shown->x[i], shown->y[i]});
      return interpreter::make_value({std::move(rows), {shown->x.size(), 2}, interpreter::NumberType::real});
    }
    if (name == "size") return Value(static_cast<std::int64_t>(shown->x.size()));
    if (name == "Valeurs") return Value::tuple({array_of(shown->x), array_of(shown->y)});
    if (name == "Parametres") return Value::dict(attributes_of(*shown));
  }
  return ConceptData::method(name, arguments, keywords);
}

Value FunctionConcept::call(const std::vector<Value>& arguments) const {
  return diagnosed([&] { return ConceptData::call(arguments); });
}

ConstantConcept::ConstantConcept(double value) {
  point_.x = {1.0};
  point_.y = {value};
  point_.left = point_.right = solver::Extension::constant;
  point_.parameter = "TOUTPARA";
  point_.result = "TOUTRESU";
}

TabulatedConcept::TabulatedConcept(solver::TabulatedFunction function)
    : function_(std::move(function)), parameters_{function_.parameter} {}

FormulaConcept::FormulaConcept(interpreter::Formula formula, Span span)
    : formula_(std::move(formula)), span_(std::move(span)) {}

void FormulaConcept::fail(const DiagnosticError& error, const std::string& arguments) const {
  Diagnostic found = error.diagnostic();
  // Of formulas that call each other the innermost one says it.
  if (!found.message.starts_with("the formula "))
    found.message = fmt::format("the formula {} at {}: {}", formula_.text(), arguments, found.message);
  found.span = span_;
  throw DiagnosticError(std::move(found));
}

double FormulaConcept::evaluate(std::span<const double> at) const {
  try {
    return formula_.evaluate(at);
  } catch (const DiagnosticError& error) {
    std::vector<std::string> shown;
    for (std::size_t i = 0; i < at.size(); ++i)
      shown.push_back(fmt::format("{}={:g}", formula_.parameters()[i], at[i]));
    fail(error, fmt::format("{}", fmt::join(shown, ", ")));
  }
}

std::vector<std::string> FormulaConcept::method_names() const { return {"getVariables", "getExpression"}; }

Value FormulaConcept::method(std::string_view name, const std::vector<Value>& arguments,
                             const std::map<std::string, Value>& keywords) const {
  if (arguments.empty() && keywords.empty() && name == "getVariables")
    return Value::list({parameters().begin(), parameters().end()});
  if (arguments.empty() && keywords.empty() && name == "getExpression") return Value(formula_.text());
  return FunctionConcept::method(name, arguments, keywords);
}

Value FormulaConcept::call(const std::vector<Value>& arguments) const {
  const bool numbers =
      std::ranges::all_of(arguments, [](const Value& value) { return value.is_number() || value.is_bool(); });
  if (numbers || arguments.size() != parameters().size()) return FunctionConcept::call(arguments);
  try {
    return formula_.evaluate_values(arguments);
  } catch (const DiagnosticError& error) {
    fail(error, fmt::format("{}", fmt::join(parameters(), ", ")));
  }
}

SurfaceConcept::SurfaceConcept(solver::TabulatedFunction edges,
                               std::vector<std::shared_ptr<const solver::TabulatedFunction>> rows)
    : edges_(std::move(edges)), rows_(std::move(rows)), parameters_{edges_.parameter, rows_.front()->parameter} {}

double SurfaceConcept::evaluate(std::span<const double> at) const {
  const auto& values = edges_.x;
  const bool left = at[0]<values.front(), right = at[0]> values.back();
  if (left || right) {
    const solver::Extension extension = left ? edges_.left : edges_.right;
    if (extension == solver::Extension::excluded || values.size() < 2) {
      if (extension == solver::Extension::constant) return (*rows_.front())(at[1]);
      throw solver::Error("out-of-function",
                          fmt::format("{} = {} lies outside the function, which is defined from {} to {}",
                                      edges_.parameter, at[0], values.front(), values.back()),
                          fmt::format("extend the function on the {}", left ? "left" : "right"));
    }
    if (extension == solver::Extension::constant) return (*(left ? rows_.front() : rows_.back()))(at[1]);
  }
  const auto above = std::upper_bound(values.begin() + 1, values.end() - (values.size() > 1 ? 1 : 0), at[0]);
  if (values.size() == 1) return (*rows_.front())(at[1]);
  const auto upper = static_cast<std::size_t>(above - values.begin());
  const double share = weight(edges_.x_scale, values[upper - 1], values[upper], at[0]);
  if (share == 0.0) return (*rows_[upper - 1])(at[1]);
  if (share == 1.0) return (*rows_[upper])(at[1]);
  const double low = (*rows_[upper - 1])(at[1]), high = (*rows_[upper])(at[1]);
  return between(edges_.y_scale, low, high, share);
}

Value SurfaceConcept::method(std::string_view name, const std::vector<Value>& arguments,
                             const std::map<std::string, Value>& keywords) const {
  const bool plain = arguments.empty() && keywords.empty();
  std::vector<Value> of_rows;
  if (plain && name == "Valeurs") {
    for (const auto& row : rows_) of_rows.push_back(Value::list({list_of(row->x), list_of(row->y)}));
    return Value::list({list_of(edges_.x), Value::list(of_rows)});
  }
  if (plain && name == "Parametres") {
    Items items = attributes_of(edges_);
    items.emplace_back("NOM_PARA_FONC", Value(parameters_[1]));
    for (const auto& row : rows_)
      of_rows.push_back(Value::dict({{"INTERPOL_FONC", scales_of(*row)},
                                     {"PROL_DROITE_FONC", word(word_of(row->right))},
                                     {"PROL_GAUCHE_FONC", word(word_of(row->left))}}));
    return Value::list({Value::dict(std::move(items)), Value::list(of_rows)});
  }
  return ConceptData::method(name, arguments, keywords);
}

const solver::TabulatedFunction& SurfaceConcept::row_near(double value, double reach, const Span& span) const {
  if (const auto row = nearest_within(edges_.x, value, reach)) return *rows_[*row];
  throw DiagnosticError("unknown-step", fmt::format("the function of two parameters has none for {}", value), span,
                        fmt::format("it has them for {}", fmt::join(edges_.x, ", ")));
}

solver::TimeFunction time_function(const ConceptPtr& handle, const Span& span) {
  auto function = function_behind(handle);
  places_of(*function, handle->name, {"INST"}, span);
  return [function = std::move(function)](double time) { return function->evaluate({&time, 1}); };
}

namespace {

/// Of `known` quantities, which are called `names`.
template <std::size_t N>
auto function_of(const ConceptPtr& handle, const std::vector<std::string>& names, const Span& span) {
  auto function = function_behind(handle);
  const auto places = places_of(*function, handle->name, names, span);
  std::array<std::size_t, N> order{};
  std::copy(places.begin(), places.end(), order.begin());
  const std::size_t count = places.size();
  return [function = std::move(function), order, count](const std::array<double, N>& known) {
    std::array<double, N> arguments{};
    for (std::size_t i = 0; i < count; ++i) arguments[i] = known[order[i]];
    return function->evaluate({arguments.data(), count});
  };
}

}  // namespace

solver::FieldFunction field_function(const ConceptPtr& handle, const Span& span) {
  return [value = function_of<4>(handle, place_and_time(), span)](const solver::Point& at, double time) {
    return value({at[0], at[1], at[2], time});
  };
}

solver::FieldFunction following_function(const ConceptPtr& handle, const Span& span) {
  const auto& parameters = function_behind(handle)->parameters();
  if (std::ranges::none_of(parameters, is_deformed)) return field_function(handle, span);
  return solver::DeformedPlaceFunction{
      [value = function_of<7>(handle, {"X", "Y", "Z", "XF", "YF", "ZF", "INST"}, span)](
          const solver::Point& initial, const solver::Point& now, double time) {
        return value({initial[0], initial[1], initial[2], now[0], now[1], now[2], time});
      }};
}

double evaluate_named(const FunctionConcept& function, const std::vector<std::string>& names,
                      std::span<const double> values, const Span& span) {
  std::vector<double> arguments;
  for (const std::size_t place : places_of(function, "the function", names, span)) arguments.push_back(values[place]);
  return function.evaluate(arguments);
}

}  // namespace comma::commands
