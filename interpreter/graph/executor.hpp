// Runs the command graph: calls each command's function in the file's order, keeps failures apart, measures time.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "interpreter/diagnostic.hpp"
#include "interpreter/graph/command_graph.hpp"

namespace comma::interpreter {

/// A command: computes the inside of its product (null if it has none). With reuse=, `call.result->data` is what it
/// changes; it may return that same data, or other data that replaces it, or null to keep it. It may set
/// `call.result->data` before throwing: what had converged then stays readable.
using CommandFunction = std::function<std::shared_ptr<ConceptData>(const Call&)>;
using CommandTable = std::map<std::string, CommandFunction, std::less<>>;

/// Whether a call may go on, as far as that depends on what the calls before it made: whether the groups it names
/// exist. Reports what is wrong.
using CallCheck = std::function<bool(const CommandNode&)>;

class Executor {
 public:
  Executor(CommandGraph& graph, const CommandTable& commands, Diagnostics& diagnostics)
      : graph_(graph), commands_(commands), diagnostics_(diagnostics) {}

  /// Runs what is cheap, makes no output, gives no verdict, and waits for nothing that is not: meshes, groups, models,
  /// loads. Their errors are those that a check can find before anything is solved. Every call, also one that will not
  /// run now, goes through `check` (unless it is empty) when its turn in the file has come; one that is wrong counts as
  /// failed. What solves is prepared, if it waits for nothing that solves. `nothing_more`: what is not cheap will never
  /// run, so nothing waits for it.
  void run_cheap(Need least, bool nothing_more, const CallCheck& check);

  /// What of commands that solve can go wrong before they do: called like them, for its errors alone. `preparations`
  /// must outlive the executor.
  void prepare_with(const CommandTable& preparations) { preparations_ = &preparations; }

  bool is_running() const { return running_ > 0; }
  /// Called before a node runs.
  void set_before_run(std::function<void(const CommandNode&)> act) { before_run_ = std::move(act); }

  /// Runs all nodes that are needed at least so much. A failing node is reported and stops those that build on it; the
  /// others still run.
  void run_all(Need least);

  /// The same for the first `count` nodes of a file that goes wrong after them, once the file itself has asked for a
  /// solution: what has been solved is written and judged. Nothing more is solved unless the last solution is what
  /// failed.
  void run_begun(Need least, int count);

  /// Runs a node and what it depends on, each once. The first failure ends it: inside of `try` it is thrown as a
  /// DiagnosticError, that of another call is reported, now or before, and gives false.
  bool force(int id);

  /// The same for a node that the file has not asked for: a failure is reported, as by run_all.
  void run_now(int id);
  /// Runs it if nothing that comes before it is still to run.
  void run_in_turn(int id);

  /// Whether all that `id` builds on has run, and nothing that comes before it is still to run.
  bool is_ready(int id) const;
  /// Whether a call is right, as far as what was made before it says; one that is wrong counts as failed.
  bool passes(CommandNode& node, const CallCheck& check);
  /// Whether all that `id` still waits for is cheap.
  bool is_cheap(int id) const;

  /// The failure of a node is handled by the file (try/except): what it left may be read.
  void forgive(int id);

 private:
  /// Marks the node done, or failed and throws.
  void run(CommandNode& node);
  /// Reports what `run` throws.
  void run_reporting(CommandNode& node);
  /// Runs a node that is needed and can run; else it is skipped.
  void run_or_skip(CommandNode& node, bool wanted);
  /// Whether its failure has been reported, and is none that the file deals with.
  static bool is_reported(const CommandNode& node) { return node.state == NodeState::failed && !node.caught; }
  /// `unsupported`: how grave it is that comma cannot do what a node asks. Returns whether what failed has been told as
  /// an alarm alone.
  template <typename Act>
  bool report_errors(const Act& act, Severity unsupported);
  /// Whether there is something to prepare now.
  bool is_to_prepare(const CommandNode& node) const;
  /// Whether its values are known, and all that it reads is there.
  bool can_run(const CommandNode& node) const { return node.complete && missing_source(node) == nullptr; }
  /// Calls the command. Throws DiagnosticError, with the call's place when the command gave none.
  static std::shared_ptr<ConceptData> invoke(const CommandTable& commands, const CommandNode& node);
  /// Whether nothing that it waits for is still to run.
  bool is_in_turn(const CommandNode& node) const;
  /// The first node that this one builds on and that is not there, or null.
  const CommandNode* missing_source(const CommandNode& node) const;
  /// Whether the node reads what was left out with an alarm: it is skipped then, with an error.
  bool is_told_of_left_out(CommandNode& node);

  CommandGraph& graph_;
  const CommandTable& commands_;
  const CommandTable* preparations_ = nullptr;
  Diagnostics& diagnostics_;
  std::function<void(const CommandNode&)> before_run_;
  int running_ = 0;
};

}  // namespace comma::interpreter
