// From the tree of an expression to the instructions of a formula.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "interpreter/formulas/expression.hpp"
#include "interpreter/formulas/formula_program.hpp"

namespace comma::interpreter {

/// What the names of a formula mean, its parameters apart.
using FormulaBindings = std::map<std::string, Value, std::less<>>;

/// The program of an expression; an empty one where the expression needs more than real numbers (a text, a list, a
/// comprehension that depends on the parameters ...): then the tree has to be walked each time. What depends on no
/// parameter is computed here, once, with the language's own arithmetic. Throws nothing.
FormulaProgram compile_formula(const Expression& expression, const std::vector<std::string>& parameters,
                               const FormulaBindings& bindings);

}  // namespace comma::interpreter
