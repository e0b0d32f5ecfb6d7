// One run of one command file: the evaluator hands its calls here; they are checked, ordered, and executed when the
// whole file is known to be right - or earlier, when the file itself asks for a computed value.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "interpreter/catalogue/check.hpp"
#include "interpreter/evaluation/host.hpp"
#include "interpreter/graph/command_graph.hpp"
#include "interpreter/graph/executor.hpp"
#include "interpreter/graph/late_values.hpp"

namespace comma::interpreter {

struct SessionOptions {
  bool check_only = false;  ///< run what is cheap, solve nothing; what comma does not support is an alarm, not an error
  bool only_tests = false;  ///< leave out what no verdict and no output needs
  bool strict = false;      ///< what a call asks for and comma does not support is an error in a check too
};

/// What becomes of the file's own assertions.
using AssertionSink = std::function<void(const Assertion&)>;

/// Codes of its own: unknown-command, not-computed, command-failed, out-of-memory, internal-error (see check.hpp for
/// the rest).
class Session : public CommandHost {
 public:
  /// All three must outlive the session.
  Session(const Catalogue& catalogue, const CommandTable& commands, Diagnostics& diagnostics,
          SessionOptions options = {});

  bool is_command(std::string_view name) const override;
  std::vector<std::string> command_names() const override;
  Value call(const CommandCall& call, bool eager) override;

  /// While the file has errors, or is only being checked, what would have to be solved is left alone, and the evaluator
  /// goes on with an unknown value. It does so too, inside of `try` as well, when a call outside of `try` fails: that
  /// ends a file where the call stands, so it is reported and the file's own handlers do not get it.
  bool force(const ConceptPtr& handle) override;
  /// Runs the calls that read the variable through a function of the file.
  void before_binding(std::string_view name) override;
  void spoil(const Concept& changed) override { graph_.spoil(changed); }
  bool runs_calls() const override { return !options_.check_only && !diagnostics_.has_errors(); }
  std::size_t calls() const override { return graph_.nodes().size(); }
  /// Those behind the first so many need not be right, and are left alone.
  void leave_calls_from(std::size_t count);
  void judge(const Assertion& assertion) override;

  /// What print() says. It is written in the file's order among what commands say, not before those that still wait:
  /// of these what writes and judges runs then, if what it reads is there. Behind an error nothing is said any more.
  void print(std::string_view text);
  /// Where it goes; nowhere without one.
  void set_output(std::function<void(std::string_view)> output) { output_ = std::move(output); }
  void set_assertion_sink(AssertionSink sink) { assertion_sink_ = std::move(sink); }
  /// A command that acts while the file is being read, and stands for nothing in the graph (INCLUDE). It may throw
  /// DiagnosticError.
  void act_at_once(std::string command, std::function<void(const Call&)> action) {
    immediate_[std::move(command)] = std::move(action);
  }
  /// What a call that makes no concept is worth while the file is read, before it runs (DEFI_FICHIER: a number). The
  /// function may complete the call, and throw DiagnosticError.
  void give_at_once(std::string command, std::function<Value(Call&)> worth) {
    worths_[std::move(command)] = std::move(worth);
  }
  /// See Executor::prepare_with.
  void prepare_with(const CommandTable& preparations) { executor_.prepare_with(preparations); }
  /// Looks at each call before anything is solved; see Executor::run_cheap.
  void set_call_check(CallCheck check) { call_check_ = std::move(check); }
  /// Called once, when the first solution that the file asks for while it is being read is about to run. It may throw
  /// what ends the run there.
  void look_ahead_with(std::function<void()> look_ahead) { look_ahead_ = std::move(look_ahead); }

  /// All that was printed and waits, whatever is still to run.
  void write_printed() { write_printed(graph_.nodes().size()); }

  /// After the last statement: runs the graph. First what is cheap, so that a group which does not exist is found
  /// before anything is solved; then, if all is right so far, the rest. Where an error comes after the file has asked
  /// for what is solved, what stands before it is written and judged all the same.
  void finish();

  const CommandGraph& graph() const { return graph_; }

 private:
  ConceptPtr make_concept(const std::string& type, const std::string& name, const Span& span);
  bool may_run(int node) const;
  void name_files();
  void spoil_reused(const CommandCall& call);
  /// The first node that is still to say something, or how many there are.
  std::size_t first_to_speak();
  /// Runs those that only write or judge and wait for nothing, once the file has asked for a solution: before, nothing
  /// runs until the whole file is known to be right.
  void let_speak();
  /// Writes what was printed before the first so many nodes were all.
  void write_printed(std::size_t nodes);

  const Catalogue& catalogue_;
  Diagnostics& diagnostics_;
  SessionOptions options_;
  CommandGraph graph_;
  Executor executor_;
  std::map<std::string, std::function<void(const Call&)>, std::less<>> immediate_;
  std::map<std::string, std::function<Value(Call&)>, std::less<>> worths_;
  AssertionSink assertion_sink_;
  CallCheck call_check_;
  std::function<void()> look_ahead_;
  LateCalls late_calls_;
  int nodes_before_errors_ = 0;
  bool solving_has_begun_ = false;
  std::function<void(std::string_view)> output_;
  /// What was printed and has to wait, by the number of nodes then.
  std::map<std::size_t, std::string> printed_;
  std::size_t first_to_speak_ = 0;  ///< nodes before it say nothing any more
  int next_concept_ = 0;
};

}  // namespace comma::interpreter
