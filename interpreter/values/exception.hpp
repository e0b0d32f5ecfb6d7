// Python's exceptions as values and as what travels through the evaluator. The classes are a closed table: a command
// file cannot define its own.
#pragma once

#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "interpreter/diagnostic.hpp"
#include "interpreter/values/value.hpp"

namespace comma::interpreter {

enum class ErrorKind {
  base_exception,
  system_exit,
  keyboard_interrupt,
  exception,
  arithmetic,
  zero_division,
  overflow,
  floating_point,
  assertion,
  attribute,
  end_of_file,
  import,
  module_not_found,
  lookup,
  index,
  key,
  memory,
  name,
  unbound_local,
  os,
  file_not_found,
  runtime,
  not_implemented,
  recursion,
  stop_iteration,
  syntax,
  type,
  value,
  unicode,
  aster,
  convergence,
  contact,
  solver,
  time_limit,
  integration,
};

/// A row of the table of exception classes.
struct ErrorClass {
  ErrorKind kind;
  ErrorKind parent;
  std::string_view name;  ///< Python's
  std::string_view code;  ///< of the diagnostic that tells it
};

const ErrorClass& class_of(ErrorKind kind);
bool is_subclass(ErrorKind kind, ErrorKind ancestor);
/// The class that a command's failure belongs to, by the code of its diagnostic: "no-convergence" is a
/// ConvergenceError, "contact-..." a ContactError, "singular-matrix" a SolverError, "key-error" (what a table lacks) a
/// KeyError, all others an AsterError.
ErrorKind kind_of_failure(std::string_view code);

/// An exception, raised or not.
struct ExceptionObject : Object {
  ExceptionObject() = default;
  ~ExceptionObject() override;
  ExceptionObject(const ExceptionObject&) = default;
  ExceptionObject& operator=(const ExceptionObject&) = default;
  ErrorKind kind = ErrorKind::exception;
  std::vector<Value> arguments;
  std::string hint;
  Span span;                          ///< where it was raised
  std::vector<Span> called_from;      ///< as in Diagnostic
  std::optional<Diagnostic> failure;  ///< of a command
  ConceptPtr left;                    ///< what that command has made before it failed, until a variable has it

  std::string type_name() const override { return std::string(class_of(kind).name); }
  std::string repr() const override;
  /// Python's str(): what stands behind the colon of a traceback.
  std::string text() const;
  /// The finding that tells this exception when nothing catches it.
  Diagnostic diagnostic() const;
};

/// An exception class as a value: `ValueError`.
struct ExceptionClassObject : Object {
  explicit ExceptionClassObject(ErrorKind which) : kind(which) {}
  ErrorKind kind;
  std::string type_name() const override { return "type"; }
  std::string repr() const override;
  bool is_callable() const override { return true; }
};

/// An exception on its way up.
class RaisedError : public std::exception {
 public:
  explicit RaisedError(std::shared_ptr<ExceptionObject> object) : object_(std::move(object)) {}
  const std::shared_ptr<ExceptionObject>& object() const { return object_; }
  const char* what() const noexcept override { return "an exception of the command language"; }

 private:
  std::shared_ptr<ExceptionObject> object_;
};

/// What a SystemExit says that nothing catches: nothing where its status is 0, None or left out.
std::optional<Diagnostic> failure_of_exit(const ExceptionObject& exit);

/// Whether `except` with this class, or tuple of classes, catches the exception. Raises TypeError for anything else.
bool catches(const Value& classes, const ExceptionObject& error);

/// A limit of the evaluator was reached: ends the run, no `except` catches it.
class LimitReached : public DiagnosticError {
 public:
  using DiagnosticError::DiagnosticError;
};

[[noreturn]] void raise(ErrorKind kind, std::string message, std::string hint = {});
std::shared_ptr<ExceptionObject> make_exception(ErrorKind kind, std::string message, std::string hint = {});
std::shared_ptr<ExceptionObject> make_exception(const Diagnostic& failure);

}  // namespace comma::interpreter
