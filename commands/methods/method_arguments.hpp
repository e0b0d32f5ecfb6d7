// What a method of a concept was called with, by the names of its parameters.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "interpreter/values/value.hpp"

namespace comma::commands {

/// The names of a table of methods.
template <class Methods>
std::vector<std::string> names_of_methods(const Methods& methods) {
  std::vector<std::string> names;
  for (const auto& method : methods) names.emplace_back(method.first);
  return names;
}

class MethodArguments {
 public:
  /// Throws DiagnosticError `type-error` for arguments that are too many, or of another name.
  MethodArguments(std::string_view method, const std::vector<interpreter::Value>& arguments,
                  const std::map<std::string, interpreter::Value>& keywords,
                  const std::vector<std::string>& parameters);

  /// Whether it was given, and not as None.
  bool has(const std::string& name) const;

  /// None where it is absent.
  interpreter::Value value(const std::string& name) const { return has(name) ? given_.at(name) : interpreter::Value(); }

  /// Throws DiagnosticError `type-error` where it is absent.
  std::string needed_text(const std::string& name) const;

  /// Each gives `otherwise` where the argument is absent, and throws DiagnosticError `type-error` where it is of
  /// another type.
  std::string text(const std::string& name, const std::string& otherwise = "") const;
  std::int64_t integer(const std::string& name, std::int64_t otherwise = 0) const;
  double real(const std::string& name, double otherwise = 0.0) const;
  /// One text or a sequence of them; none where it is absent.
  std::vector<std::string> texts(const std::string& name) const;

 private:
  [[noreturn]] void refuse(const std::string& name, const char* wanted) const;

  std::string method_;
  std::map<std::string, interpreter::Value> given_;
};

}  // namespace comma::commands
