#include "commands/methods/method_arguments.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "interpreter/diagnostic.hpp"

namespace comma::commands {

using interpreter::DiagnosticError;
using interpreter::Value;

MethodArguments::MethodArguments(std::string_view method, const std::vector<Value>& arguments,
                                 const std::map<std::string, Value>& keywords,
                                 const std::vector<std::string>& parameters)
    : method_(method) {
  if (arguments.size() > parameters.size())
    throw DiagnosticError(
        "type-error",
        fmt::format("{}() takes {}, not {}", method_,
                    parameters.empty() ? "no arguments" : fmt::format("at most {} arguments", parameters.size()),
                    arguments.size()));
  for (std::size_t i = 0; i < arguments.size(); ++i) given_.emplace(parameters[i], arguments[i]);
  for (const auto& [name, value] : keywords) {
    if (std::ranges::find(parameters, name) == parameters.end())
      throw DiagnosticError("type-error", fmt::format("{}() has no argument {}", method_, name));
    if (!given_.emplace(name, value).second)
      throw DiagnosticError("type-error", fmt::format("{}() is given {} twice", method_, name));
  }
}

bool MethodArguments::has(const std::string& name) const {
  const auto found = given_.find(name);
  return found != given_.end() && !found->second.is_none();
}

void MethodArguments::refuse(const std::string& name, const char* wanted) const {
  throw DiagnosticError("type-error",
                        fmt::format("{}(): {} is {}, not {}", method_, name, wanted, given_.at(name).repr()));
}

std::string MethodArguments::needed_text(const std::string& name) const {
  if (!given_.contains(name))
    throw DiagnosticError("type-error", fmt::format("{}() is not given its argument {}", method_, name));
  if (!given_.at(name).is_text()) refuse(name, "a text");
  return given_.at(name).as_text();
}

std::string MethodArguments::text(const std::string& name, const std::string& otherwise) const {
  if (!has(name)) return otherwise;
  if (!given_.at(name).is_text()) refuse(name, "a text");
  return given_.at(name).as_text();
}

std::int64_t MethodArguments::integer(const std::string& name, std::int64_t otherwise) const {
  if (!has(name)) return otherwise;
  if (!given_.at(name).is_integer()) refuse(name, "an integer");
  return given_.at(name).as_integer();
}

double MethodArguments::real(const std::string& name, double otherwise) const {
  if (!has(name)) return otherwise;
  if (!given_.at(name).is_number()) refuse(name, "a number");
  return given_.at(name).as_real();
}

std::vector<std::string> MethodArguments::texts(const std::string& name) const {
  if (!has(name)) return {};
  const Value& value = given_.at(name);
  if (value.is_text()) return {value.as_text()};
  if (!value.is_sequence() || !std::ranges::all_of(value.items(), &Value::is_text)) refuse(name, "a text, or several");
  std::vector<std::string> texts;
  for (const Value& item : value.items()) texts.push_back(item.as_text());
  return texts;
}

}  // namespace comma::commands
