// What the files of numpy functions share: how arguments are read, and the tables of which the module is made.
#pragma once

#include <functional>
#include <optional>
#include <span>

#include "interpreter/library/builtins.hpp"
#include "interpreter/values/array.hpp"

namespace comma::interpreter::numpy {

/// An argument as numbers: a copy of an array, a number, or a sequence.
Numbers argument(Evaluator& evaluator, const Value& value);
/// The same where a plain number is refused.
Numbers array_argument(Evaluator& evaluator, const Value& value);
/// The argument in this position or of this name; null when it is absent.
const Value* option(const CallArguments& arguments, std::size_t position, std::string_view name);
/// dtype=, in this position or by name; nothing when it is absent or None.
std::optional<NumberType> type_argument(const CallArguments& arguments, std::size_t position);
/// axis=, counted from the end when negative; nothing when it is absent or None. Raises ValueError.
std::optional<std::size_t> axis_argument(const CallArguments& arguments, std::size_t position, std::size_t dimensions);

using Line = std::span<const double>;
using LineFunction = std::function<std::vector<double>(Line)>;
/// Each line of numbers along an axis through a function whose results are equally long.
Numbers map_lines(const Numbers& source, std::size_t axis, const LineFunction& function);
Numbers flattened(Numbers numbers);

/// A function whose first argument is the object itself.
template <Builtin Function>
Value as_method(Evaluator& evaluator, const Value& self, const CallArguments& arguments) {
  CallArguments all = arguments;
  all.positional.insert(all.positional.begin(), self);
  return Function(evaluator, all);
}

std::span<const FunctionRow> making_functions();    ///< numpy_making.cpp
std::span<const FunctionRow> element_functions();   ///< numpy_elements.cpp
std::span<const FunctionRow> reducing_functions();  ///< numpy_reductions.cpp
std::span<const FunctionRow> shape_functions();     ///< numpy_shapes.cpp
std::span<const FunctionRow> curve_functions();     ///< numpy_curves.cpp
std::span<const FunctionRow> matrix_functions();    ///< numpy_matrices.cpp
std::span<const FunctionRow> linalg_table();        ///< numpy_linalg.cpp
std::span<const MethodRow> making_methods();
std::span<const MethodRow> element_methods();
std::span<const MethodRow> reducing_methods();
std::span<const MethodRow> shape_methods();
std::span<const MethodRow> matrix_methods();

}  // namespace comma::interpreter::numpy
