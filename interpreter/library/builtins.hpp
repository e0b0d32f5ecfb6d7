// The names that every command file knows, the types' constructors and methods, and the modules that may be imported.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "interpreter/evaluation/evaluator.hpp"
#include "interpreter/values/objects.hpp"

namespace comma::interpreter {

/// print, len, range ..., the types, the exceptions, _F; null for another name.
const Value* builtin_value(std::string_view name);
std::vector<std::string> builtin_names();
/// A member of the module math; null for another name.
const Value* math_value(std::string_view name);

/// The part of math that every command file has without import, as Code_Aster brings it; null for another name.
const Value* common_math_value(std::string_view name);
/// Why a Python builtin is left out ("open" reaches files); empty for a name that is none of them.
std::string_view refusal_of(std::string_view name);

/// int(...), str(...), list(...) ...
Value construct(Evaluator& evaluator, const std::string& type, const CallArguments& arguments);

/// A method of a value's type; null when it has none of that name.
Method find_method(const Value& value, std::string_view name);
std::vector<std::string> method_names(const Value& value);

/// A module by its full name; null when it is not on the list.
std::shared_ptr<ModuleObject> find_module(const std::string& path);
std::vector<std::string> module_names();

/// What the tables of functions and methods are made of.
struct FunctionRow {
  std::string_view name;
  Builtin function;
};
struct MethodRow {
  std::string_view name;
  Method method;
};
std::span<const FunctionRow> basic_functions();      ///< builtins.cpp
std::span<const FunctionRow> sequence_functions();   ///< builtins_sequences.cpp
std::span<const FunctionRow> math_functions();       ///< module_math.cpp
std::vector<FunctionRow> numpy_functions();          ///< module_numpy.cpp
std::span<const FunctionRow> linalg_functions();     ///< of numpy.linalg
std::span<const FunctionRow> itertools_functions();  ///< module_itertools.cpp
std::span<const FunctionRow> copy_functions();       ///< module_copy.cpp
std::span<const FunctionRow> functools_functions();  ///< module_collections.cpp
std::span<const FunctionRow> operator_functions();
std::span<const FunctionRow> collections_functions();
/// chain.from_iterable(...): the items of the items.
Value chain_of(Evaluator& evaluator, const CallArguments& arguments);
std::span<const MethodRow> text_methods();    ///< methods_text.cpp
std::span<const MethodRow> letter_methods();  ///< methods_letters.cpp
std::span<const MethodRow> list_methods();    ///< methods_containers.cpp
std::span<const MethodRow> tuple_methods();
std::span<const MethodRow> dict_methods();
std::span<const MethodRow> set_methods();
std::span<const MethodRow> number_methods();     ///< methods_numbers.cpp
std::span<const MethodRow> array_methods();      ///< module_numpy.cpp
std::span<const MethodRow> test_case_methods();  ///< test_case.cpp

/// The arguments of a builtin, checked: raises TypeError when there are fewer or more, or keywords not listed.
void expect_arguments(std::string_view function, const CallArguments& arguments, std::size_t fewest, std::size_t most,
                      std::initializer_list<std::string_view> keywords = {});
/// isinstance(): of a type, an exception class, or one of a tuple of them.
bool is_instance(const Value& value, const Value& type);
Value make_set(const std::vector<Value>& items, bool frozen = false);
/// Sorts in place, stably, by key(item) when there is a key.
void sort_values(Evaluator& evaluator, std::vector<Value>& items, const CallArguments& arguments);

}  // namespace comma::interpreter
