// FORMULE's expression: real parameters in, a real number out, millions of times. It is compiled once into a flat
// program over doubles (formula_program.hpp); where the program meets something that is not plain, the tree of the
// expression is walked with the language's own arithmetic, which gives the value or the error that Python would give.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "interpreter/formulas/expression.hpp"
#include "interpreter/formulas/formula_compiler.hpp"

namespace comma::interpreter {

///     Formula area("pi * R**2", {"R"}, {});
///     double a = area(std::array{2.0});
class Formula : public RealFunction {
 public:
  /// `bindings` gives what the expression uses beside its parameters, the builtins and the names of `math`; a parameter
  /// hides a binding, a binding hides a builtin. Functions of concepts among them must have been computed. Throws
  /// DiagnosticError `syntax`, `unknown-name`, or `limit-depth` where formulas call each other too deep.
  Formula(std::string text, std::vector<std::string> parameters, FormulaBindings bindings = {},
          std::string origin = "<formula>");

  /// As many arguments as parameters. Throws DiagnosticError (`zero-division`, `value-error`, `type-error` ...;
  /// `not-real` when the value is no real number) with a span in the text.
  double evaluate(std::span<const double> arguments) const override;
  double operator()(std::span<const double> arguments) const { return evaluate(arguments); }

  /// The value for arguments of any kind, by the tree: what the language's own call of a formula gives.
  Value evaluate_values(std::span<const Value> arguments) const;

  const std::vector<std::string>& parameters() const override { return parameters_; }
  int nesting() const override { return nesting_; }
  const std::string& text() const { return expression_.text(); }
  /// Whether it runs as a program; else its tree is walked each time.
  bool is_compiled() const { return !program_.empty(); }

 private:
  void check_names() const;
  void measure_nesting();
  double evaluate_tree(std::span<const double> arguments) const;

  Expression expression_;
  std::vector<std::string> parameters_;
  FormulaBindings bindings_;
  FormulaProgram program_;
  int nesting_ = 0;
};

}  // namespace comma::interpreter
