// Functions as concepts: tables, constants, formulas, functions of two parameters, all behind one interface; and how
// the solver sees them.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "interpreter/formulas/formula.hpp"
#include "interpreter/graph/call.hpp"
#include "interpreter/graph/concept.hpp"
#include "solver/functions/function.hpp"

namespace comma::commands {

/// A real function of named parameters: what every keyword of type fonction_any takes. `evaluate` throws solver::Error
/// or DiagnosticError where the function is not defined.
struct FunctionConcept : interpreter::ConceptData, interpreter::RealFunction {
  const RealFunction* real_function() const override { return this; }
  /// With numbers; an error of the solver becomes one of the language.
  interpreter::Value call(const std::vector<interpreter::Value>& arguments) const override;
  /// Of what has points: Absc() and Ordo(), its abscissas and values as arrays, and Valeurs(), both (U1.03.02);
  /// getValues(): both in one list, abscissas first; getValuesAsArray(): a row a point; size(): how many;
  /// Parametres(): INTERPOL, NOM_PARA, NOM_RESU, PROL_GAUCHE and PROL_DROITE, as DEFI_FONCTION takes them.
  interpreter::Value method(std::string_view name, const std::vector<interpreter::Value>& arguments,
                            const std::map<std::string, interpreter::Value>& keywords) const override;
  std::vector<std::string> method_names() const override;
  /// The table behind it, or null when it has none.
  virtual const solver::TabulatedFunction* table() const { return nullptr; }
  /// The points that methods show: those of the table.
  virtual const solver::TabulatedFunction* points() const { return table(); }
};

/// DEFI_FONCTION, and the commands that tabulate.
class TabulatedConcept : public FunctionConcept {
 public:
  explicit TabulatedConcept(solver::TabulatedFunction function);
  const std::vector<std::string>& parameters() const override { return parameters_; }
  double evaluate(std::span<const double> at) const override { return function_(at[0]); }
  const solver::TabulatedFunction* table() const override { return &function_; }

 private:
  solver::TabulatedFunction function_;
  std::vector<std::string> parameters_;
};

/// DEFI_CONSTANTE: whatever the parameter. Methods show one point at 1, as in Code_Aster.
class ConstantConcept : public FunctionConcept {
 public:
  explicit ConstantConcept(double value);
  const std::vector<std::string>& parameters() const override { return parameters_; }
  double evaluate(std::span<const double>) const override { return point_.y.front(); }
  const solver::TabulatedFunction* points() const override { return &point_; }

 private:
  solver::TabulatedFunction point_;
  std::vector<std::string> parameters_;
};

/// FORMULE. Its errors say where it was written, and for which arguments it failed.
class FormulaConcept : public FunctionConcept {
 public:
  FormulaConcept(interpreter::Formula formula, interpreter::Span span);
  const std::vector<std::string>& parameters() const override { return formula_.parameters(); }
  double evaluate(std::span<const double> at) const override;
  int nesting() const override { return formula_.nesting(); }
  /// getVariables(): the names of the parameters; getExpression(): the text.
  interpreter::Value method(std::string_view name, const std::vector<interpreter::Value>& arguments,
                            const std::map<std::string, interpreter::Value>& keywords) const override;
  std::vector<std::string> method_names() const override;
  /// Also with lists, texts ... when the expression is made for them.
  interpreter::Value call(const std::vector<interpreter::Value>& arguments) const override;

 private:
  [[noreturn]] void fail(const interpreter::DiagnosticError& error, const std::string& arguments) const;

  interpreter::Formula formula_;
  interpreter::Span span_;
};

/// DEFI_NAPPE: one table for each value of a first parameter, and between two of them the interpolation of their values
/// (U4.31.03). `edges` holds the values, rising, and how the function goes on beyond them; its ordinates are not used.
class SurfaceConcept : public FunctionConcept {
 public:
  SurfaceConcept(solver::TabulatedFunction edges, std::vector<std::shared_ptr<const solver::TabulatedFunction>> rows);
  const std::vector<std::string>& parameters() const override { return parameters_; }
  double evaluate(std::span<const double> at) const override;
  /// Valeurs(): the values of the first parameter, and for each the abscissas and values of its table; Parametres():
  /// how the function goes on between and beyond them, and for each table INTERPOL_FONC, PROL_DROITE_FONC and
  /// PROL_GAUCHE_FONC (U1.03.02).
  interpreter::Value method(std::string_view name, const std::vector<interpreter::Value>& arguments,
                            const std::map<std::string, interpreter::Value>& keywords) const override;
  std::vector<std::string> method_names() const override { return {"Parametres", "Valeurs"}; }
  const solver::TabulatedFunction& edges() const { return edges_; }
  const std::vector<std::shared_ptr<const solver::TabulatedFunction>>& rows() const { return rows_; }
  /// The table that belongs to the value of the first parameter which lies within `reach`. Throws DiagnosticError
  /// `unknown-step` at `span`, listing the values there are.
  const solver::TabulatedFunction& row_near(double value, double reach, const interpreter::Span& span) const;

 private:
  solver::TabulatedFunction edges_;
  std::vector<std::shared_ptr<const solver::TabulatedFunction>> rows_;
  std::vector<std::string> parameters_;
};

/// Numbers as a list of the language.
interpreter::Value list_of(std::span<const double> values);

/// The function of time behind a concept. Throws DiagnosticError `unknown-parameter` at `span` when it depends on
/// anything but INST, naming it. The function keeps the concept's data alive.
solver::TimeFunction time_function(const interpreter::ConceptPtr& handle, const interpreter::Span& span);
/// The same for place and time: X, Y, Z and INST.
solver::FieldFunction field_function(const interpreter::ConceptPtr& handle, const interpreter::Span& span);
/// Of a load that may follow the body: besides X, Y, Z the function may depend on XF, YF, ZF, the place on the deformed
/// body, and is then a solver::DeformedPlaceFunction.
solver::FieldFunction following_function(const interpreter::ConceptPtr& handle, const interpreter::Span& span);
/// The values of parameters by name. Throws DiagnosticError `unknown-parameter` when one is missing.
double evaluate_named(const FunctionConcept& function, const std::vector<std::string>& names,
                      std::span<const double> values, const interpreter::Span& span);

}  // namespace comma::commands
