#include "interpreter/values/exception.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "interpreter/values/objects.hpp"

namespace comma::interpreter {

namespace {

// In the order of ErrorKind.
constexpr std::array classes = [] {
  using enum ErrorKind;
  return std::array{
      ErrorClass{base_exception, base_exception, "BaseException", "exception"},
      ErrorClass{system_exit, base_exception, "SystemExit", "exit"},
      ErrorClass{keyboard_interrupt, base_exception, "KeyboardInterrupt", "exception"},
      ErrorClass{exception, base_exception, "Exception", "exception"},
      ErrorClass{arithmetic, exception, "ArithmeticError", "arithmetic-error"},
      ErrorClass{zero_division, arithmetic, "ZeroDivisionError", "zero-division"},
      ErrorClass{overflow, arithmetic, "OverflowError", "overflow"},
      ErrorClass{floating_point, arithmetic, "FloatingPointError", "arithmetic-error"},
      ErrorClass{assertion, exception, "AssertionError", "assertion-failed"},
      ErrorClass{attribute, exception, "AttributeError", "unknown-attribute"},
      ErrorClass{end_of_file, exception, "EOFError", "exception"},
      ErrorClass{import, exception, "ImportError", "unknown-module"},
      ErrorClass{module_not_found, import, "ModuleNotFoundError", "unknown-module"},
      ErrorClass{lookup, exception, "LookupError", "lookup-error"},
      ErrorClass{index, lookup, "IndexError", "index-error"},
      ErrorClass{key, lookup, "KeyError", "key-error"},
      ErrorClass{memory, exception, "MemoryError", "limit-memory"},
      ErrorClass{name, exception, "NameError", "unknown-name"},
      ErrorClass{unbound_local, name, "UnboundLocalError", "unknown-name"},
      ErrorClass{os, exception, "OSError", "not-allowed"},
      ErrorClass{file_not_found, os, "FileNotFoundError", "not-allowed"},
      ErrorClass{runtime, exception, "RuntimeError", "runtime-error"},
      ErrorClass{not_implemented, runtime, "NotImplementedError", "not-supported"},
      ErrorClass{recursion, runtime, "RecursionError", "limit-depth"},
      ErrorClass{stop_iteration, exception, "StopIteration", "stop-iteration"},
      ErrorClass{syntax, exception, "SyntaxError", "syntax"},
      ErrorClass{type, exception, "TypeError", "type-error"},
      ErrorClass{value, exception, "ValueError", "value-error"},
      ErrorClass{unicode, value, "UnicodeError", "value-error"},
      ErrorClass{aster, exception, "AsterError", "command-failed"},
      ErrorClass{convergence, aster, "ConvergenceError", "no-convergence"},
      ErrorClass{contact, aster, "ContactError", "contact-failed"},
      ErrorClass{solver, aster, "SolverError", "singular-matrix"},
      ErrorClass{time_limit, aster, "TimeLimitError", "time-limit"},
      ErrorClass{integration, aster, "IntegrationError", "integration-failure"},
  };
}();

std::vector<Value> one_text(std::string message) {
  std::vector<Value> values;
  values.emplace_back(std::move(message));
  return values;
}

}  // namespace

const ErrorClass& class_of(ErrorKind kind) { return classes[static_cast<std::size_t>(kind)]; }

bool is_subclass(ErrorKind kind, ErrorKind ancestor) {
  while (kind != ancestor) {
    if (kind == ErrorKind::base_exception) return false;
    kind = class_of(kind).parent;
  }
  return true;
}

ErrorKind kind_of_failure(std::string_view code) {
  if (code == "no-convergence" || code == "increment-too-large" || code.substr(0, 9) == "residual-")
    return ErrorKind::convergence;
  if (code.substr(0, 8) == "contact-") return ErrorKind::contact;
  if (code == "singular-matrix") return ErrorKind::solver;
  if (code == "time-limit") return ErrorKind::time_limit;
  if (code == class_of(ErrorKind::key).code) return ErrorKind::key;
  if (code == "integration-failure") return ErrorKind::integration;
  return ErrorKind::aster;
}

ExceptionObject::~ExceptionObject() {
  if (!arguments.empty()) release_later(std::make_shared<std::vector<Value>>(std::move(arguments)));
}

std::string ExceptionObject::repr() const {
  std::string text(class_of(kind).name);
  text += "(";
  for (std::size_t i = 0; i < arguments.size(); ++i) text += (i > 0 ? ", " : "") + arguments[i].repr();
  return text + ")";
}

std::string ExceptionObject::text() const {
  if (arguments.empty()) return {};
  if (arguments.size() > 1) return Value::tuple(arguments).repr();
  // Python shows the key itself, in quotes: KeyError: 'DX'.
  return arguments[0].is_text() && kind != ErrorKind::key ? arguments[0].as_text() : arguments[0].repr();
}

Diagnostic ExceptionObject::diagnostic() const {
  if (failure) {
    Diagnostic finding = *failure;
    if (!finding.span) finding.span = span;
    if (finding.called_from.empty()) finding.called_from = called_from;
    return finding;
  }
  const ErrorClass& row = class_of(kind);
  std::string message = text();
  if (kind == ErrorKind::key) message = "the key " + message + " does not exist";
  if (kind == ErrorKind::assertion)
    message = message.empty() ? "the assertion is false" : "the assertion is false: " + message;
  if (row.code == "exception" || message.empty())
    message = fmt::format("{}{}{}", row.name, message.empty() ? "" : ": ", message);
  return {Severity::error, std::string(row.code), std::move(message), hint, span, called_from};
}

std::optional<Diagnostic> failure_of_exit(const ExceptionObject& exit) {
  const Value status = exit.arguments.empty() ? Value() : exit.arguments[0];
  if (status.is_none() || (status.is_bool() && !status.as_bool()) || (status.is_integer() && status.as_integer() == 0))
    return std::nullopt;
  const bool is_text = status.is_text();
  return Diagnostic{Severity::error,
                    std::string(class_of(exit.kind).code),
                    is_text ? "the file ends itself: " + status.as_text()
                            : fmt::format("the file ends itself with status {}", status.repr()),
                    "what stands after this has not been run",
                    exit.span,
                    exit.called_from};
}

bool catches(const Value& classes, const ExceptionObject& error) {
  const std::vector<Value> each = classes.is_tuple()
                                      ? std::vector<Value>(classes.items().begin(), classes.items().end())
                                      : std::vector<Value>{classes};
  return std::any_of(each.begin(), each.end(), [&](const Value& candidate) {
    const auto* wanted = candidate.as_object<ExceptionClassObject>();
    if (wanted == nullptr)
      raise(ErrorKind::type, "catching classes that do not inherit from BaseException is not allowed");
    return is_subclass(error.kind, wanted->kind);
  });
}

std::string ExceptionClassObject::repr() const { return fmt::format("<class '{}'>", class_of(kind).name); }

std::shared_ptr<ExceptionObject> make_exception(ErrorKind kind, std::string message, std::string hint) {
  auto object = std::make_shared<ExceptionObject>();
  object->kind = kind;
  object->arguments = one_text(std::move(message));
  object->hint = std::move(hint);
  return object;
}

std::shared_ptr<ExceptionObject> make_exception(const Diagnostic& failure) {
  auto object = make_exception(kind_of_failure(failure.code), failure.message, failure.hint);
  object->failure = failure;
  object->span = failure.span;
  return object;
}

void raise(ErrorKind kind, std::string message, std::string hint) {
  throw RaisedError(make_exception(kind, std::move(message), std::move(hint)));
}

}  // namespace comma::interpreter
