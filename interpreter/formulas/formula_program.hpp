// What a formula becomes: a flat list of instructions for a stack of doubles. It only knows the plain cases; wherever
// Python would raise an error, or leave the real numbers, it stops and says so, and the formula asks the tree instead.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "interpreter/graph/concept.hpp"
#include "interpreter/values/objects.hpp"

namespace comma::interpreter {

enum class FormulaOp : std::uint8_t {
  number,
  argument,
  add,
  subtract,
  multiply,
  divide,
  floor_divide,
  modulo,
  power,
  negate,
  logical_not,
  less,
  less_equal,
  greater,
  greater_equal,
  equal,
  not_equal,
  jump,
  jump_if_false,  ///< the second takes its condition off the stack
  keep_if_false,
  keep_if_true,  ///< `and`, `or`: jumps and keeps the operand when it decides, else drops it
  unary,
  binary,
  minimum,
  maximum,
  concept_function,
  file_function,
};

struct FormulaInstruction {
  using Unary = double (*)(double);
  using Binary = double (*)(double, double);
  FormulaOp op = FormulaOp::number;
  std::uint16_t count = 0;  ///< operands of a minimum, a maximum or a call
  std::uint32_t index = 0;  ///< of an argument, of a function; target of a jump
  union {
    double number = 0.0;
    Unary unary;
    Binary binary;
  };
};

/// Runs without allocation, unless it calls functions of the file. May be run by several threads at once if it does
/// not.
struct FormulaProgram {
  std::vector<FormulaInstruction> instructions;
  std::vector<const RealFunction*> concept_functions;  ///< owned by the formula's bindings
  std::vector<const FunctionObject*> file_functions;
  std::size_t depth = 0;  ///< of the stack

  bool empty() const { return instructions.empty(); }
  /// `stack` has room for `depth` numbers. False: this case is not plain (a division by zero, a result that is not
  /// finite ...).
  bool run(std::span<const double> arguments, double* stack, double& result) const;
};

}  // namespace comma::interpreter
