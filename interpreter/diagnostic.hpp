// What is wrong, where, and what to write instead. Every layer of the interpreter speaks through diagnostics;
// the command line prints them, the JSON report lists them.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "interpreter/source.hpp"

namespace comma::interpreter {

enum class Severity { error, alarm, info };

/// "error", "alarm" or "info": the words of the JSON report.
std::string_view name_of(Severity severity);

/// One finding. `code` is a stable word with hyphens ("unknown-keyword"); `hint` says what to write instead, or is empty.
struct Diagnostic {
  Severity severity = Severity::error;
  std::string code;
  std::string message;
  std::string hint;
  Span span;
};

/// The finding as a user reads it, without a final line break:
///
///     beam.comm:12:5: error: AFFE_MODELE has no keyword MAILAGE [unknown-keyword]
///       12 | MO = AFFE_MODELE(MAILAGE=MA, ...
///          |                  ^~~~~~~
///          = hint: did you mean MAILLAGE?
std::string render(const Diagnostic& diagnostic);

/// Thrown where work cannot go on; carries the finding.
class DiagnosticError : public std::runtime_error {
 public:
  explicit DiagnosticError(Diagnostic diagnostic)
      : std::runtime_error(diagnostic.message), diagnostic_(std::move(diagnostic)) {}
  DiagnosticError(std::string code, std::string message, Span span = {}, std::string hint = {})
      : DiagnosticError(Diagnostic{Severity::error, std::move(code), std::move(message), std::move(hint), std::move(span)}) {}

  const Diagnostic& diagnostic() const { return diagnostic_; }

 private:
  Diagnostic diagnostic_;
};

/// Collects findings in order of arrival, so that all errors of a file are told at once.
class Diagnostics {
 public:
  void add(Diagnostic diagnostic) { items_.push_back(std::move(diagnostic)); }
  void error(std::string code, std::string message, Span span, std::string hint = {});
  void alarm(std::string code, std::string message, Span span, std::string hint = {});

  const std::vector<Diagnostic>& items() const { return items_; }
  bool has_errors() const;

 private:
  std::vector<Diagnostic> items_;
};

/// The known word nearest to a misspelt one (Damerau-Levenshtein distance, at most a third of the word's length), else "".
/// Of words as near, the one that begins with more of its letters; then the one that stands first in `known`.
std::string nearest(std::string_view word, const std::vector<std::string>& known);

}  // namespace comma::interpreter
