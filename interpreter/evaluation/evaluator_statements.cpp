// Statements: what is done, in which order, and what becomes of errors.
#include <fmt/format.h>

#include <utility>

#include "interpreter/evaluation/evaluator.hpp"
#include "interpreter/library/builtins.hpp"
#include "interpreter/library/test_case.hpp"
#include "interpreter/syntax/statement_facts.hpp"
#include "interpreter/values/operations.hpp"

namespace comma::interpreter {

namespace {

/// Raises a counter for as long as it lives.
struct Counted {
  explicit Counted(int& which) : counter(which) { ++counter; }
  ~Counted() { --counter; }
  Counted(const Counted&) = delete;
  Counted& operator=(const Counted&) = delete;
  int& counter;
};

}  // namespace

Evaluator::Flow Evaluator::execute(const Block& block) {
  for (const StatementPtr& statement : block) {
    const Flow flow = execute_guarded(*statement);
    if (flow != Flow::next) return flow;
  }
  return Flow::next;
}

/// Outside of functions and of `try`, an error ends its statement only.
Evaluator::Flow Evaluator::execute_guarded(const Statement& statement) {
  if (!recovering() || calls_ > 0) return execute(statement);
  try {
    return execute(statement);
  } catch (const RaisedError& error) {
    if (error.object()->kind == ErrorKind::system_exit) throw;
    report(*error.object(), statement);
    forget_bound(statement);
    return Flow::next;
  }
}

Evaluator::Flow Evaluator::execute(const Statement& statement) {
  if (!on_doubt_) return execute_statement(statement);
  certain_ = {diagnostics_.items().size(), host_.calls()};
  const bool met_before = std::exchange(met_unknown_, false);
  const Flow flow = execute_statement(statement);
  if (met_unknown_ && !keeps_unknown(statement)) doubt();
  met_unknown_ = met_before;
  return flow;
}

bool Evaluator::calls_command(const Node& value) const {
  if (value.kind != NodeKind::call) return false;
  const Node& callee = *static_cast<const CallNode&>(value).callee;
  return callee.kind == NodeKind::name && host_.is_command(static_cast<const NameNode&>(callee).id);
}

bool Evaluator::keeps_unknown(const Statement& statement) {
  switch (statement.kind) {
    case StatementKind::expression: {
      const Node& value = *static_cast<const ValueStatement&>(statement).value;
      if (calls_command(value)) return !met_in_call_;
      if (value.kind != NodeKind::call) return false;
      const Node& callee = *static_cast<const CallNode&>(value).callee;
      return callee.kind == NodeKind::name && static_cast<const NameNode&>(callee).id == "print";
    }
    case StatementKind::assign: {
      const auto& assignment = static_cast<const AssignStatement&>(statement);
      if (assignment.value && calls_command(*assignment.value)) return !met_in_call_;
      const auto& targets = assignment.targets;
      if (targets.size() != 1 || targets.front()->kind != NodeKind::name) return false;
      const auto value = present(static_cast<const NameNode&>(*targets.front()));
      return value && value->is_unknown();
    }
    case StatementKind::return_:
      return returned_.is_unknown();
    case StatementKind::if_:
    case StatementKind::while_:
    case StatementKind::for_:
    case StatementKind::with_:
    case StatementKind::try_:
      return true;  // of these, the statements within
    default:
      return false;
  }
}

Evaluator::Flow Evaluator::execute_statement(const Statement& statement) {
  try {
    meter_.step();
    switch (statement.kind) {
      case StatementKind::expression:
        evaluate(*static_cast<const ValueStatement&>(statement).value);
        return Flow::next;
      case StatementKind::assign:
        execute_assign(static_cast<const AssignStatement&>(statement));
        return Flow::next;
      case StatementKind::augmented:
        execute_augmented(static_cast<const AugmentedStatement&>(statement));
        return Flow::next;
      case StatementKind::function:
        execute_function(static_cast<const FunctionStatement&>(statement));
        return Flow::next;
      case StatementKind::return_:
        execute_return(static_cast<const ValueStatement&>(statement));
        return Flow::return_;
      case StatementKind::pass:
        return Flow::next;
      case StatementKind::break_:
        return Flow::break_;
      case StatementKind::continue_:
        return Flow::continue_;
      case StatementKind::del:
        execute_delete(*static_cast<const ValueStatement&>(statement).value);
        return Flow::next;
      case StatementKind::assert_:
        execute_assert(static_cast<const AssertStatement&>(statement));
        return Flow::next;
      case StatementKind::raise:
        execute_raise(static_cast<const RaiseStatement&>(statement));
      case StatementKind::import:
        execute_import(static_cast<const ImportStatement&>(statement));
        return Flow::next;
      case StatementKind::import_from:
        execute_import_from(static_cast<const ImportStatement&>(statement));
        return Flow::next;
      case StatementKind::broken:
        return execute_broken(static_cast<const BrokenStatement&>(statement));
      default:
        return execute_compound(statement);
    }
  } catch (const RaisedError& error) {
    if (!error.object()->span) place_error(*error.object(), span_of(statement.begin, statement.end));
    throw;
  } catch (const LimitReached& limit) {
    if (limit.diagnostic().span) throw;
    Diagnostic finding = limit.diagnostic();
    finding.span = span_of(statement.begin, statement.end);
    throw LimitReached(std::move(finding));
  }
}

Evaluator::Flow Evaluator::execute_compound(const Statement& statement) {
  check_stack();
  switch (statement.kind) {
    case StatementKind::if_:
      return execute_if(static_cast<const IfStatement&>(statement));
    case StatementKind::while_:
      return execute_while(static_cast<const WhileStatement&>(statement));
    case StatementKind::for_:
      return execute_for(static_cast<const ForStatement&>(statement));
    case StatementKind::with_:
      return execute_with(static_cast<const WithStatement&>(statement));
    default:
      return execute_try(static_cast<const TryStatement&>(statement));
  }
}

/// What a variable holds, if it holds something.
std::optional<Value> Evaluator::present(const NameNode& name) {
  if (!name.global) return frame_of(name).slots[static_cast<std::size_t>(name.slot)];
  const auto found = globals_.find(name.id);
  return found == globals_.end() ? std::nullopt : std::optional(found->second);
}

/// What a statement would have bound is unknown from here on.
void Evaluator::forget_bound(const Statement& statement) {
  for (const NameNode* name : bound_names(statement)) {
    const std::optional<Value> before = present(*name);
    if (before && before->is_concept()) host_.spoil(*before->as_concept());
    if (!name->global || before || builtin_value(name->id) == nullptr) store(*name, Value::unknown());
  }
}

/// What could not be read is only forgotten. It ends a function, whose exit it may have been, and after this turn the
/// loop around it: both might go on for ever without it.
Evaluator::Flow Evaluator::execute_broken(const BrokenStatement& statement) {
  ++failures_;
  names_lost_ = names_lost_ || statement.loses_any_name;
  forget_bound(statement);
  if (calls_ == 0) return Flow::next;
  returned_ = Value::unknown();
  return Flow::return_;
}

/// Neither branch is taken, since nobody knows which: what either would bind is unknown.
Evaluator::Flow Evaluator::skip_unknown(const Statement& statement) {
  doubt();
  forget_bound(statement);
  const Exits exits = exits_of(statement);
  if (exits.returns && calls_ > 0) {
    returned_ = Value::unknown();
    return Flow::return_;
  }
  return exits.leaves_loop ? Flow::break_ : Flow::next;
}

void Evaluator::execute_assign(const AssignStatement& statement) {
  if (!statement.value) return;
  const bool names_product = statement.value->kind == NodeKind::call && statement.targets.size() == 1 &&
                             statement.targets[0]->kind == NodeKind::name;
  if (names_product) target_ = static_cast<const NameNode&>(*statement.targets[0]).id;
  try {
    const Value value = evaluate(*statement.value);
    for (const NodePtr& target : statement.targets) assign(*target, value);
  } catch (const RaisedError& error) {
    if (names_product) keep_what_is_left(*error.object(), static_cast<const NameNode&>(*statement.targets[0]));
    throw;
  }
}

/// A command that fails leaves what had converged to the variable that was to take its product (U1.03.00, section 5).
void Evaluator::keep_what_is_left(ExceptionObject& error, const NameNode& target) {
  if (!error.left || error.left->name != target.id) return;
  store(target, Value(std::exchange(error.left, nullptr)));
}

void Evaluator::execute_augmented(const AugmentedStatement& statement) {
  if (statement.target->kind == NodeKind::name) {
    const auto& name = static_cast<const NameNode&>(*statement.target);
    const Value before = evaluate(name);
    return store(name, augmented(statement.op, before, evaluate(*statement.value)));
  }
  if (statement.target->kind == NodeKind::subscript) {
    const auto& place = static_cast<const SubscriptNode&>(*statement.target);
    const Value object = evaluate(*place.object);
    const Value index = evaluate(*place.index);
    const Value before = item(object, index);
    return store_subscript(object, index, augmented(statement.op, before, evaluate(*statement.value)), meter_);
  }
  assign(*statement.target, evaluate(*statement.value));
}

void Evaluator::execute_function(const FunctionStatement& statement) {
  store(static_cast<const NameNode&>(*statement.name), make_function(statement.code, statement.defaults));
}

void Evaluator::execute_return(const ValueStatement& statement) {
  returned_ = statement.value ? evaluate(*statement.value) : Value();
}

void Evaluator::execute_delete(const Node& target) {
  if (target.kind == NodeKind::name) return erase(static_cast<const NameNode&>(target));
  if (target.kind == NodeKind::tuple || target.kind == NodeKind::list) {
    for (const NodePtr& item : static_cast<const SequenceNode&>(target).items) execute_delete(*item);
    return;
  }
  if (target.kind != NodeKind::subscript) raise(ErrorKind::attribute, "attributes cannot be deleted in a command file");
  const auto& place = static_cast<const SubscriptNode&>(target);
  const Value object = evaluate(*place.object);
  delete_subscript(object, evaluate(*place.index));
}

Evaluator::Flow Evaluator::execute_if(const IfStatement& statement) {
  for (const auto& [condition, block] : statement.branches) {
    const Value value = evaluate(*condition);
    if (met_unknown_) doubt();
    if (value.is_unknown()) return skip_unknown(statement);
    if (truth(value)) return execute(block);
  }
  return execute(statement.otherwise);
}

Evaluator::Flow Evaluator::execute_while(const WhileStatement& statement) {
  const std::uint64_t failures = count_failures();
  while (true) {
    meter_.step();
    const Value condition = evaluate(*statement.condition);
    if (met_unknown_) doubt();
    if (condition.is_unknown()) return skip_unknown(statement);
    if (!truth(condition)) return execute(statement.otherwise);
    const Flow flow = execute(statement.body);
    if (flow == Flow::return_) return flow;
    if (flow == Flow::break_) return Flow::next;
    // Another turn would only tell the same mistake again.
    if (count_failures() != failures) return skip_unknown(statement);
  }
}

Evaluator::Flow Evaluator::execute_for(const ForStatement& statement) {
  const Value iterable = evaluate(*statement.iterable);
  const std::uint64_t failures = count_failures();
  if (met_unknown_) doubt();
  if (iterable.is_unknown()) return skip_unknown(statement);
  const auto iterator = iterate(iterable);
  while (auto value = iterator->next()) {
    meter_.step();
    assign(*statement.target, *value);
    const Flow flow = execute(statement.body);
    if (flow == Flow::return_) return flow;
    if (flow == Flow::break_) return Flow::next;
    if (count_failures() != failures) return skip_unknown(statement);
  }
  return execute(statement.otherwise);
}

/// What nobody knows whether it would have been caught: what handlers bind may be what it was.
void Evaluator::forget_handlers(const TryStatement& statement) {
  for (const auto& handler : statement.handlers)
    for (const StatementPtr& each : handler.body) forget_bound(*each);
}

/// The body with its handlers and `else`, without `finally`.
Evaluator::Flow Evaluator::execute_body(const TryStatement& statement) {
  if (statement.handlers.empty()) return execute(statement.body);
  std::optional<RaisedError> caught;
  const TryStatement::Handler* handler = nullptr;
  if (!host_.runs_calls()) doubt();  // an error that is handled, or not met
  const std::uint64_t left_alone = calls_left_alone_;
  try {
    const Counted inside(tries_);
    const Flow flow = execute(statement.body);
    if (flow != Flow::next) return flow;
    if (calls_left_alone_ != left_alone) forget_handlers(statement);
  } catch (const RaisedError& error) {
    for (const auto& candidate : statement.handlers) {
      if (!handles(candidate, *error.object())) continue;
      handler = &candidate;
      break;
    }
    if (handler == nullptr) throw;
    caught = error;
  }
  if (caught) return execute_handler(*handler, *caught);
  return execute(statement.otherwise);
}

Evaluator::Flow Evaluator::execute_try(const TryStatement& statement) {
  Flow flow = Flow::next;
  try {
    flow = execute_body(statement);
  } catch (const RaisedError&) {
    const Flow last = execute(statement.finally);
    if (last == Flow::next) throw;
    return last;
  }
  const Value returned = returned_;
  const Flow last = execute(statement.finally);
  if (last != Flow::next) return last;
  returned_ = returned;
  return flow;
}

bool Evaluator::handles(const TryStatement::Handler& handler, const ExceptionObject& error) {
  if (!handler.type) return true;
  const Value type = evaluate(*handler.type);
  if (type.is_unknown()) return true;
  return catches(type, error);
}

/// with test.assertRaises(...): what the block raises, the claim judges.
Evaluator::Flow Evaluator::execute_with(const WithStatement& statement) {
  const Value manager = evaluate(*statement.manager);
  if (manager.is_unknown()) return skip_unknown(statement);
  auto* claim = manager.as_object<ExpectedError>();
  if (claim == nullptr) {
    raise(ErrorKind::not_implemented,
          fmt::format("'with' takes test.assertRaises(...) alone, not '{}'", manager.type_name()),
          "files are declared in the .export and read by commands");
  }
  if (statement.target) assign(*statement.target, manager);
  if (!host_.runs_calls()) doubt();
  try {
    const Counted inside(tries_);
    const Flow flow = execute(statement.body);
    claim->judge(*this, nullptr);
    return flow;
  } catch (const RaisedError& error) {
    if (!claim->judge(*this, error.object())) throw;
    return Flow::next;
  }
}

std::shared_ptr<ExceptionObject> Evaluator::attempt(const Value& callee, const CallArguments& arguments) {
  if (!host_.runs_calls()) doubt();
  try {
    const Counted inside(tries_);
    call(callee, arguments);
    return nullptr;
  } catch (const RaisedError& error) {
    return error.object();
  }
}

Evaluator::Flow Evaluator::execute_handler(const TryStatement::Handler& handler, const RaisedError& error) {
  struct Restore {
    Evaluator& self;
    const NameNode* name;
    ~Restore() {
      self.handled_.pop_back();
      if (name == nullptr) return;
      if (name->global)
        self.globals_.erase(name->id);
      else
        self.frame_of(*name).slots[static_cast<std::size_t>(name->slot)].reset();
    }
  };
  const auto* name = static_cast<const NameNode*>(handler.name.get());
  handled_.push_back(error.object());
  const Restore restore{*this, name};
  if (name != nullptr) store(*name, Value(std::shared_ptr<Object>(error.object())));
  return execute(handler.body);
}

void Evaluator::execute_raise(const RaiseStatement& statement) {
  if (!statement.error) {
    if (handled_.empty()) raise(ErrorKind::runtime, "No active exception to reraise");
    throw RaisedError(handled_.back());
  }
  Value error = evaluate(*statement.error);
  if (statement.cause) evaluate(*statement.cause);
  if (error.is_unknown()) throw RaisedError(make_exception(ErrorKind::exception, "unknown"));
  if (error.as_object<ExceptionClassObject>() != nullptr) error = call(error, CallArguments());
  if (error.as_object<ExceptionObject>() == nullptr)
    raise(ErrorKind::type, "exceptions must derive from BaseException");
  auto object = std::dynamic_pointer_cast<ExceptionObject>(std::get<std::shared_ptr<Object>>(error.storage()));
  object->span = span_of(statement.begin, statement.end);
  throw RaisedError(std::move(object));
}

void Evaluator::execute_assert(const AssertStatement& statement) {
  const Value condition = evaluate(*statement.condition);
  if (condition.is_unknown() || truth(condition)) return;
  auto error = make_exception(ErrorKind::assertion, "");
  error->arguments.clear();
  if (statement.message) error->arguments.push_back(evaluate(*statement.message));
  throw RaisedError(std::move(error));
}

}  // namespace comma::interpreter
