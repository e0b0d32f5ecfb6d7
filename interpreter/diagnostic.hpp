// What is wrong, where, and what to write instead. Every layer of the interpreter speaks through diagnostics;
// the command line prints them, the JSON report lists them.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "interpreter/source.hpp"

namespace comma::interpreter {

enum class Severity { error, alarm, info };

/// "error", "alarm" or "info": the words of the JSON report.
std::string_view name_of(Severity severity);

/// One finding. `code` is a stable word with hyphens ("unknown-keyword"); `hint` says what to write instead, or is
/// empty.
struct Diagnostic {
  Severity severity = Severity::error;
  std::string code;
  std::string message;
  std::string hint;
  Span span;
  std::vector<Span> called_from{};  ///< the calls of functions that led there, the innermost first

  bool operator==(const Diagnostic&) const = default;
};

/// The finding as a user reads it, without a final line break:
///
///     beam.comm:12:5: error: AFFE_MODELE has no keyword MAILAGE [unknown-keyword]
///       12 | MO = AFFE_MODELE(MAILAGE=MA, ...
///          |                  ^~~~~~~
///          = hint: did you mean MAILLAGE?
///
/// and, of what happens in a function of the file, `= called at beam.comm:20:7`, the innermost call first.
std::string render(const Diagnostic& diagnostic);

/// Thrown where work cannot go on; carries the finding.
class DiagnosticError : public std::runtime_error {
 public:
  explicit DiagnosticError(Diagnostic diagnostic)
      : std::runtime_error(diagnostic.message), diagnostic_(std::move(diagnostic)) {}
  DiagnosticError(std::string code, std::string message, Span span = {}, std::string hint = {})
      : DiagnosticError(
            Diagnostic{Severity::error, std::move(code), std::move(message), std::move(hint), std::move(span)}) {}

  const Diagnostic& diagnostic() const { return diagnostic_; }

 private:
  Diagnostic diagnostic_;
};

/// Collects findings in order of arrival, so that all errors of a file are told at once.
class Diagnostics {
 public:
  /// A finding that does not say what led to it is taken to come from the calls that are open.
  void add(Diagnostic diagnostic);
  void error(std::string code, std::string message, Span span, std::string hint = {});
  void alarm(std::string code, std::string message, Span span, std::string hint = {});

  const std::vector<Diagnostic>& items() const { return items_; }
  /// Each finding once: a command in a loop may find the same in each turn.
  std::vector<Diagnostic> distinct() const;
  bool has_errors() const;

  /// Functions of the file that run now were called there, the innermost last.
  void open_call(Span place) { open_calls_.push_back(std::move(place)); }
  void close_call() { open_calls_.pop_back(); }
  /// The innermost first, as in a finding.
  std::vector<Span> called_from() const { return {open_calls_.rbegin(), open_calls_.rend()}; }

  /// While it lives, findings come from the given calls (the innermost first) instead of the open ones.
  class LaterWork {
   public:
    LaterWork(Diagnostics& owner, const std::vector<Span>& called_from)
        : owner_(owner), kept_(std::exchange(owner.open_calls_, {called_from.rbegin(), called_from.rend()})) {}
    ~LaterWork() { owner_.open_calls_ = std::move(kept_); }
    LaterWork(const LaterWork&) = delete;
    LaterWork& operator=(const LaterWork&) = delete;

   private:
    Diagnostics& owner_;
    std::vector<Span> kept_;
  };

  /// While it lives, errors are those of a command within `try`: the file goes on after them, and they are told as
  /// alarms.
  class Handled {
   public:
    Handled(Diagnostics& owner, bool handled)
        : owner_(owner), before_(std::exchange(owner.handled_, owner.handled_ || handled)) {}
    ~Handled() { owner_.handled_ = before_; }
    Handled(const Handled&) = delete;
    Handled& operator=(const Handled&) = delete;

   private:
    Diagnostics& owner_;
    bool before_;
  };

 private:
  std::vector<Diagnostic> items_;
  std::vector<Span> open_calls_;
  bool handled_ = false;
};

/// The known word nearest to a misspelt one (Damerau-Levenshtein distance, at most a third of the word's length), else
/// "". Of words as near, the one that begins with more of its letters; then the one that stands first in `known`.
std::string nearest(std::string_view word, const std::vector<std::string>& known);
/// The hint that names it, or "".
std::string did_you_mean(std::string_view word, const std::vector<std::string>& known);

}  // namespace comma::interpreter
