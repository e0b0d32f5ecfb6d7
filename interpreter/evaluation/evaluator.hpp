// From the tree to values and command calls. Walks the statements in order; a command call is handed to the host, which
// checks it and adds it to the graph. A statement that fails is reported, what it would have bound becomes unknown, and
// the walk goes on, so that all errors of a file come at once and one mistake makes one error.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "interpreter/diagnostic.hpp"
#include "interpreter/evaluation/host.hpp"
#include "interpreter/evaluation/meter.hpp"
#include "interpreter/formulas/expression.hpp"
#include "interpreter/syntax/ast.hpp"
#include "interpreter/values/objects.hpp"

namespace comma::interpreter {

/// Where print() writes.
using OutputSink = std::function<void(std::string_view)>;

class Evaluator {
 public:
  Evaluator(CommandHost& host, Diagnostics& diagnostics, OutputSink output, Limits limits = {});
  ~Evaluator();
  Evaluator(const Evaluator&) = delete;
  Evaluator& operator=(const Evaluator&) = delete;

  /// Runs a file. Variables stay for the next one, as POURSUITE wants it.
  void run(const Ast& ast);
  /// Runs another file from within one that runs, as if its statements stood at the place of the call (INCLUDE). The
  /// tree must outlive the run.
  void include(const Ast& ast);
  /// Up to where a check knows that a run takes the same way: findings and calls before.
  struct Certain {
    std::size_t findings = 0, calls = 0;
  };
  /// Called, if at all, where a check goes on with what it does not know, other than to print it or keep it in a
  /// variable: what it finds from there on need not be wrong. It may throw what ends the reading.
  void on_doubt(std::function<void(const Certain&)> act) { on_doubt_ = std::move(act); }
  /// One expression; names are looked for with `lookup` first, then as everywhere: globals, builtins, commands, the
  /// names of `math`. Throws DiagnosticError.
  Value evaluate(const Node& expression, const std::shared_ptr<const SourceFile>& file, const VariableLookup& lookup);

  /// What is wrong where the file ends itself with a status other than 0 or a text (sys.exit), since it started: what
  /// stands before it counts, what stands after it has not been read.
  const std::optional<Diagnostic>& failed_exit() const { return failed_exit_; }

  /// A global variable, or null.
  const Value* global(std::string_view name) const;
  std::vector<std::string> global_names() const;

  /// What builtins use. Calls a function of any kind; raises RaisedError.
  Value call(const Value& callee, const CallArguments& arguments);
  /// The exception that a call raises, or null where it raises none.
  std::shared_ptr<ExceptionObject> attempt(const Value& callee, const CallArguments& arguments);
  Value attribute(const Value& object, const std::string& name);
  /// Whether a concept has a method or an attribute of this name; unknown while its data is not there.
  Value has_attribute(const ConceptPtr& handle, const std::string& name);
  /// The same from outside of a run, for a function of the file (a formula calls it while the graph is executed). It
  /// can then call no commands.
  static Value call_from_outside(const FunctionObject& function, const CallArguments& arguments);
  Meter& meter() { return meter_; }
  CommandHost& host() { return host_; }
  void print(std::string_view text) { output_(text); }
  /// What would have given names their values is not there: unknown ones are no errors of their own from here on.
  void lose_names() { names_lost_ = true; }

 private:
  enum class Flow { next, break_, continue_, return_ };
  class Generator;

  // Statements (evaluator_statements.cpp).
  Flow execute(const Block& block);
  Flow execute_guarded(const Statement& statement);
  Flow execute_compound(const Statement& statement);
  Flow execute(const Statement& statement);
  Flow execute_if(const IfStatement& statement);
  Flow execute_while(const WhileStatement& statement);
  Flow execute_for(const ForStatement& statement);
  Flow execute_try(const TryStatement& statement);
  Flow execute_with(const WithStatement& statement);
  void forget_handlers(const TryStatement& statement);
  void spoil_reused(const CallArguments& arguments);
  void doubt() const {
    if (on_doubt_) on_doubt_(certain_);
  }
  /// Whether all that is unknown after the statement is known to be so.
  bool keeps_unknown(const Statement& statement);
  bool calls_command(const Node& value) const;
  Flow execute_statement(const Statement& statement);
  Flow execute_handler(const TryStatement::Handler& handler, const RaisedError& error);
  Flow execute_broken(const BrokenStatement& statement);
  Flow skip_unknown(const Statement& statement);
  void execute_assign(const AssignStatement& statement);
  void execute_augmented(const AugmentedStatement& statement);
  void execute_function(const FunctionStatement& statement);
  void execute_delete(const Node& target);
  [[noreturn]] void execute_raise(const RaiseStatement& statement);
  void execute_assert(const AssertStatement& statement);
  bool handles(const TryStatement::Handler& handler, const ExceptionObject& error);
  Flow execute_body(const TryStatement& statement);
  void execute_return(const ValueStatement& statement);
  void forget_bound(const Statement& statement);

  // Imports (evaluator_imports.cpp).
  void execute_import(const ImportStatement& statement);
  void execute_import_from(const ImportStatement& statement);
  Value import_module(const std::string& path, Span span);
  Value import_member(const Value& module, const ImportStatement& statement, const ImportStatement::Item& item);
  Value absent(std::string path, bool whole, std::shared_ptr<ExceptionObject> error) const;
  Value use_absent(AbsentObject& thing, const std::string& path);

  // Variables (evaluator.cpp).
  Value load(const NameNode& name);
  Value load_global(const NameNode& name);
  const Value* math_name(std::string_view name) const;
  Value unknown_name(const NameNode& name, bool called = false);
  int line_of_later_definition(const NameNode& name) const;
  bool is_made_here(const NameNode& name) const;
  void announce_binding(const NameNode& name);
  void store(const NameNode& name, Value value);
  void assign(const Node& target, const Value& value);
  void assign_items(const SequenceNode& target, const Value& value);
  void erase(const NameNode& name);
  Frame& frame_of(const NameNode& name);
  std::optional<Value> present(const NameNode& name);

  // Expressions (evaluator_expressions.cpp).
  Value evaluate(const Node& node);
  Value evaluate_node(const Node& node);
  Value evaluate_formatted(const FormattedNode& node);
  Value evaluate_sequence(const SequenceNode& node);
  Value evaluate_dict(const DictNode& node);
  Value evaluate_logical(const LogicalNode& node);
  Value evaluate_compare(const CompareNode& node);
  Value evaluate_conditional(const ConditionalNode& node);
  Value evaluate_lambda(const LambdaNode& node);
  Value evaluate_comprehension(const ComprehensionNode& node);
  Value evaluate_subscript(const SubscriptNode& node);
  Value evaluate_name(const NameNode& node);
  Value augmented(Operator op, const Value& before, const Value& value);
  Value concept_operation(Operator op, const Value& left, const Value& right);
  Value item(const Value& object, const Value& index);
  Value evaluate_slice(const SliceNode& node);
  Value evaluate_or_none(const NodePtr& node);

  // Calls (evaluator_calls.cpp).
  Value evaluate_call(const CallNode& node);
  CallArguments evaluate_arguments(const CallNode& node, bool tolerant);
  void spread_mapping(CallArguments& arguments, const Value& mapping, const Span& span);
  Value evaluate_argument(const Node& node, bool tolerant);
  Value call_function(const FunctionObject& function, const CallArguments& arguments);
  Value call_guest(const FunctionObject& function, const CallArguments& arguments);
  void bind_arguments(const FunctionObject& function, const CallArguments& arguments, Frame& frame);
  std::optional<Value> visible(std::string_view name) const;
  Value call_command(const std::string& name, const CallArguments& arguments);
  Value make_factor(const CallArguments& arguments);
  std::vector<Argument> named_arguments(const CallArguments& arguments, std::string_view what);
  Value make_function(const std::shared_ptr<const FunctionCode>& code, const std::vector<NodePtr>& defaults);
  void remember_frame(const std::shared_ptr<Frame>& frame);

  // Errors (evaluator.cpp).
  bool recovering() const { return strict_ == 0 && tries_ == 0; }
  void report(const Diagnostic& finding);
  void report(const ExceptionObject& error, const Statement& statement);
  void keep_what_is_left(ExceptionObject& error, const NameNode& target);
  /// Notes where an exception was raised, and what led there.
  void place_error(ExceptionObject& error, Span span) const;
  Span span_of(std::uint32_t begin, std::uint32_t end) const { return {file_, begin, end}; }
  Span span_of(const Node& node) const { return {file_, node.begin, node.end}; }
  std::uint64_t count_failures();
  void check_stack() const;

  /// Runs work of the host; what it throws becomes an exception of the language.
  template <class Work>
  auto with_host(Work work) -> decltype(work());

  CommandHost& host_;
  Diagnostics& diagnostics_;
  OutputSink output_;
  Meter meter_;
  std::unordered_map<std::string, Value> globals_;
  const VariableLookup* lookup_ = nullptr;
  std::shared_ptr<const SourceFile> file_;
  const Ast* tree_ = nullptr;  ///< of the command file, without those that it includes
  std::shared_ptr<Frame> frame_;
  /// Frames that functions keep alive: emptied at the end, since they hold each other.
  std::vector<std::weak_ptr<Frame>> closures_;
  Value returned_;
  std::optional<Diagnostic> failed_exit_;
  std::string target_;  ///< the variable that takes the value of the call evaluated next
  std::vector<std::shared_ptr<ExceptionObject>> handled_;  ///< for a bare `raise`
  std::set<std::string> reported_names_;
  std::set<std::pair<const SourceFile*, std::uint64_t>> reported_places_;
  const char* stack_base_ = nullptr;
  std::shared_ptr<const FunctionCode> code_;  ///< of the function that runs; null in the file itself
  std::shared_ptr<int> run_token_;            ///< lives as long as the tree that runs
  std::uint64_t failures_ = 0;                ///< errors so far, here and in the host
  bool names_lost_ = false;                   ///< an unknown name may be one that a broken statement would have bound
  std::size_t errors_seen_ = 0;               ///< how many diagnostics `failures_` has counted
  int tries_ = 0;
  std::function<void(const Certain&)> on_doubt_;
  Certain certain_;
  bool met_unknown_ = false;  ///< in the statement that runs
  bool met_in_call_ = false;  ///< before its last call of a command was made: one that is wrong gives what is unknown
  std::uint64_t calls_left_alone_ = 0;  ///< by a host that runs none, so that nobody knows what they would have done
  int strict_ = 0;
  int calls_ = 0;
  int guests_ = 0;  ///< calls from outside under way
  std::shared_ptr<FunctionHome> home_;
};

template <class Work>
auto Evaluator::with_host(Work work) -> decltype(work()) {
  try {
    const Meter::Pause pause(meter_);
    return work();
  } catch (const LimitReached&) {
    throw;
  } catch (const DiagnosticError& error) {
    auto object = make_exception(error.diagnostic());
    object->called_from = diagnostics_.called_from();
    if (const auto* failure = dynamic_cast<const CommandFailure*>(&error)) object->left = failure->left();
    throw RaisedError(std::move(object));
  }
}

}  // namespace comma::interpreter
