#include "interpreter/formulas/formula_program.hpp"

#include <cmath>

#include "interpreter/evaluation/evaluator.hpp"
#include "interpreter/values/exception.hpp"

namespace comma::interpreter {

namespace {

/// Python's %: the remainder has the sign of the divisor.
double python_modulo(double a, double b) {
  double remainder = std::fmod(a, b);
  if (remainder == 0.0) return std::copysign(0.0, b);
  if ((b < 0.0) != (remainder < 0.0)) remainder += b;
  return remainder;
}

/// Python's //: goes with %, so that a == a // b * b + a % b up to rounding.
double python_floor_divide(double a, double b) {
  const double remainder = std::fmod(a, b);
  double quotient = (a - remainder) / b;
  if (remainder != 0.0 && (b < 0.0) != (remainder < 0.0)) quotient -= 1.0;
  if (quotient == 0.0) return std::copysign(0.0, a / b);
  const double below = std::floor(quotient);
  return quotient - below > 0.5 ? below + 1.0 : below;
}

/// An error of the function is that of the formula: what has been called once is not called again to find it.
bool call_in_file(const FunctionObject& function, std::span<const double> arguments, double& result) {
  CallArguments values;
  for (const double argument : arguments) values.positional.emplace_back(argument);
  Value value;
  try {
    value = Evaluator::call_from_outside(function, values);
  } catch (const RaisedError& error) {
    throw DiagnosticError(error.object()->diagnostic());
  }
  if (!value.is_number() && !value.is_bool()) return false;
  result = value.is_bool() ? static_cast<double>(value.as_bool()) : value.as_real();
  return true;
}

double least(const double* values, std::size_t count) {
  double best = values[0];
  for (std::size_t i = 1; i < count; ++i) {
    if (values[i] < best) best = values[i];
  }
  return best;
}

double greatest(const double* values, std::size_t count) {
  double best = values[0];
  for (std::size_t i = 1; i < count; ++i) {
    if (values[i] > best) best = values[i];
  }
  return best;
}

}  // namespace

bool FormulaProgram::run(std::span<const double> arguments, double* stack, double& result) const {
  const FormulaInstruction* const first = instructions.data();
  const FormulaInstruction* const end = first + instructions.size();
  double* top = stack;  // one past the last number
  for (const FormulaInstruction* at = first; at != end; ++at) {
    switch (at->op) {
      case FormulaOp::number:
        *top++ = at->number;
        break;
      case FormulaOp::argument:
        *top++ = arguments[at->index];
        break;
      case FormulaOp::add:
        --top;
        top[-1] += *top;
        break;
      case FormulaOp::subtract:
        --top;
        top[-1] -= *top;
        break;
      case FormulaOp::multiply:
        --top;
        top[-1] *= *top;
        break;
      case FormulaOp::divide:
        if (*--top == 0.0) return false;
        top[-1] /= *top;
        break;
      case FormulaOp::floor_divide:
        if (*--top == 0.0 || !std::isfinite(*top) || !std::isfinite(top[-1])) return false;
        top[-1] = python_floor_divide(top[-1], *top);
        break;
      case FormulaOp::modulo:
        if (*--top == 0.0 || !std::isfinite(*top) || !std::isfinite(top[-1])) return false;
        top[-1] = python_modulo(top[-1], *top);
        break;
      case FormulaOp::power:
        --top;
        top[-1] = std::pow(top[-1], *top);
        if (!std::isfinite(top[-1])) return false;
        break;
      case FormulaOp::negate:
        top[-1] = -top[-1];
        break;
      case FormulaOp::logical_not:
        top[-1] = top[-1] == 0.0;
        break;
      case FormulaOp::less:
        --top;
        top[-1] = top[-1] < *top;
        break;
      case FormulaOp::less_equal:
        --top;
        top[-1] = top[-1] <= *top;
        break;
      case FormulaOp::greater:
        --top;
        top[-1] = top[-1] > *top;
        break;
      case FormulaOp::greater_equal:
        --top;
        top[-1] = top[-1] >= *top;
        break;
      case FormulaOp::equal:
        --top;
        top[-1] = top[-1] == *top;
        break;
      case FormulaOp::not_equal:
        --top;
        top[-1] = top[-1] != *top;
        break;
      case FormulaOp::jump:
        at = first + at->index - 1;
        break;
      case FormulaOp::jump_if_false:
        if (*--top == 0.0) at = first + at->index - 1;
        break;
      case FormulaOp::keep_if_false:
        if (top[-1] == 0.0)
          at = first + at->index - 1;
        else
          --top;
        break;
      case FormulaOp::keep_if_true:
        if (top[-1] != 0.0)
          at = first + at->index - 1;
        else
          --top;
        break;
      case FormulaOp::unary:
        top[-1] = at->unary(top[-1]);
        if (!std::isfinite(top[-1])) return false;
        break;
      case FormulaOp::binary:
        --top;
        top[-1] = at->binary(top[-1], *top);
        if (!std::isfinite(top[-1])) return false;
        break;
      case FormulaOp::minimum:
        top -= at->count - 1;
        top[-1] = least(top - 1, at->count);
        break;
      case FormulaOp::maximum:
        top -= at->count - 1;
        top[-1] = greatest(top - 1, at->count);
        break;
      case FormulaOp::concept_function:
        top -= at->count - 1;
        top[-1] = concept_functions[at->index]->evaluate({top - 1, at->count});
        break;
      case FormulaOp::file_function:
        top -= at->count - 1;
        if (!call_in_file(*file_functions[at->index], {top - 1, at->count}, top[-1])) return false;
        break;
    }
  }
  result = top[-1];
  return true;
}

}  // namespace comma::interpreter
