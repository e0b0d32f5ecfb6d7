// Which methods a value has: one table for each type.
#include <array>

#include "interpreter/library/builtins.hpp"
#include "interpreter/library/test_case.hpp"
#include "interpreter/values/array.hpp"
#include "interpreter/values/operations.hpp"

namespace comma::interpreter {

namespace {

std::span<const MethodRow> methods_of(const Value& value) {
  if (value.is_text()) return text_methods();
  if (value.is_list()) return list_methods();
  if (value.is_tuple() || value.as_object<RangeObject>() != nullptr) return tuple_methods();
  if (value.is_dict()) return dict_methods();
  if (value.is_set()) return set_methods();
  if (is_numeric(value)) return number_methods();
  if (value.as_object<ArrayObject>() != nullptr) return array_methods();
  if (value.as_object<TestCaseObject>() != nullptr) return test_case_methods();
  return {};
}

}  // namespace

Method find_method(const Value& value, std::string_view name) {
  for (const MethodRow& row : methods_of(value)) {
    if (row.name == name) return row.method;
  }
  if (!value.is_text()) return nullptr;
  for (const MethodRow& row : letter_methods()) {
    if (row.name == name) return row.method;
  }
  return nullptr;
}

std::vector<std::string> method_names(const Value& value) {
  std::vector<std::string> names;
  for (const MethodRow& row : methods_of(value)) names.emplace_back(row.name);
  if (!value.is_text()) return names;
  for (const MethodRow& row : letter_methods()) names.emplace_back(row.name);
  return names;
}

}  // namespace comma::interpreter
