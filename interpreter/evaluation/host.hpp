// The seam between the language and the commands: the evaluator meets a call of a command and hands it to its host,
// which checks it, adds it to the command graph and returns a handle. The evaluator itself knows no command.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "interpreter/diagnostic.hpp"
#include "interpreter/values/value.hpp"

namespace comma::interpreter {

/// A call as the evaluator met it, not checked yet. A **mapping argument has been spread into `arguments`.
struct CommandCall {
  std::string name;
  Span name_span;
  Span span;
  std::vector<Argument> arguments;
  bool open = false;        ///< there are further arguments that are not known (those of an unknown **mapping)
  std::string target = {};  ///< the variable that takes the product, where the call is all that is assigned to one
  /// What a name means where the call stands, for expressions that it holds as text; valid during the call, may be
  /// empty.
  std::function<std::optional<Value>(std::string_view)> scope = {};
};

/// A claim that the file makes about its own values (CA.TestCase().assertEqual(a, b) and its like), judged.
struct Assertion {
  std::string method;   ///< "assertAlmostEqual"
  std::string message;  ///< the user's own, or empty
  Span span;
  bool holds = false;
  Value computed, reference;  ///< None where the method has none
  double tolerance = 0.0;     ///< of assertAlmostEqual
};

/// A command has failed and left something of its product: what had converged.
class CommandFailure : public DiagnosticError {
 public:
  CommandFailure(const Diagnostic& finding, ConceptPtr left) : DiagnosticError(finding), left_(std::move(left)) {}
  const ConceptPtr& left() const { return left_; }

 private:
  ConceptPtr left_;
};

/// What the evaluator needs from the outside.
class CommandHost {
 public:
  virtual ~CommandHost() = default;

  virtual bool is_command(std::string_view name) const = 0;
  /// All names, for hints.
  virtual std::vector<std::string> command_names() const = 0;

  /// Checks the call and adds it to the graph. Returns the handle it produces, or None. A call that is wrong is
  /// reported to the diagnostics and gives Value::unknown(), so that one mistake makes one error. `eager` (inside try)
  /// runs it at once.
  virtual Value call(const CommandCall& call, bool eager) = 0;

  /// Runs what a concept depends on, so that its data can be read. Throws DiagnosticError when that fails as the file
  /// may have expected. False where there is no data to go on with, for reasons that have been told or since nothing is
  /// run.
  virtual bool force(const ConceptPtr& handle) = 0;

  /// A variable that has a value is about to get another, or none. A call that waits may read it through a function.
  virtual void before_binding(std::string_view /*name*/) {}

  /// A statement that went wrong may have been to change the concept in place: nothing that reads it from here on is
  /// sound.
  virtual void spoil(const Concept& /*changed*/) {}

  /// Whether a call that is made at once, as within `try`, is really run: else nobody knows whether it would have
  /// failed.
  virtual bool runs_calls() const { return true; }

  /// How many calls stand in the graph.
  virtual std::size_t calls() const { return 0; }

  /// Takes note of a claim, whether it holds or not. A host without verdicts has no use for it.
  virtual void judge(const Assertion& /*assertion*/) {}
};

}  // namespace comma::interpreter
