#include "interpreter/evaluation/evaluator.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <utility>

#include "interpreter/library/builtins.hpp"
#include "interpreter/syntax/statement_facts.hpp"
#include "interpreter/values/operations.hpp"

namespace comma::interpreter {

Evaluator::Evaluator(CommandHost& host, Diagnostics& diagnostics, OutputSink output, Limits limits)
    : host_(host),
      diagnostics_(diagnostics),
      output_(std::move(output)),
      meter_(limits),
      home_(std::make_shared<FunctionHome>()) {
  home_->evaluator = this;
}

Evaluator::~Evaluator() {
  home_->evaluator = nullptr;
  // A function lies in a variable of the very frame that it keeps alive.
  for (const auto& weak : closures_) {
    if (const auto frame = weak.lock()) frame->slots.clear();
  }
}

void Evaluator::run(const Ast& ast) {
  // INCLUDE runs a file from within a call of the one that includes it.
  const bool outermost = stack_base_ == nullptr;
  const char here = 0;
  if (outermost) stack_base_ = &here;
  struct Restore {
    Evaluator& self;
    bool outermost;
    std::shared_ptr<const SourceFile> file = self.file_;
    std::shared_ptr<const FunctionCode> code = std::exchange(self.code_, nullptr);
    std::shared_ptr<Frame> frame = std::exchange(self.frame_, nullptr);
    std::shared_ptr<int> token = std::exchange(self.run_token_, std::make_shared<int>(0));
    int calls = std::exchange(self.calls_, 0);
    ~Restore() {
      self.file_ = std::move(file);
      self.code_ = std::move(code);
      self.frame_ = std::move(frame);
      self.run_token_ = std::move(token);
      self.calls_ = calls;
      if (outermost) self.stack_base_ = nullptr;
    }
  } const restore{*this, outermost};
  file_ = ast.file;
  if (outermost) tree_ = &ast;
  try {
    execute(ast.statements);
  } catch (const RaisedError& error) {
    const bool ends = error.object()->kind == ErrorKind::system_exit;
    if (!outermost && (ends || !recovering())) throw;
    if (ends)
      failed_exit_ = failure_of_exit(*error.object());
    else
      report(error.object()->diagnostic());
  } catch (const LimitReached& limit) {
    if (!outermost) throw;
    report(limit.diagnostic());
  }
}

void Evaluator::include(const Ast& ast) {
  check_stack();
  const Meter::Resume own_work(meter_);
  struct Return {
    Evaluator& self;
    std::shared_ptr<const SourceFile> file;
    std::shared_ptr<Frame> frame;
    std::shared_ptr<const FunctionCode> code;
    ~Return() {
      self.file_ = std::move(file);
      self.frame_ = std::move(frame);
      self.code_ = std::move(code);
    }
  } const back{*this, file_, std::exchange(frame_, nullptr), std::exchange(code_, nullptr)};
  file_ = ast.file;
  execute(ast.statements);
}

Value Evaluator::evaluate(const Node& expression, const std::shared_ptr<const SourceFile>& file,
                          const VariableLookup& lookup) {
  const char here = 0;
  struct Restore {
    Evaluator& self;
    const VariableLookup* lookup = self.lookup_;
    const char* stack_base = self.stack_base_;
    std::shared_ptr<const SourceFile> file = self.file_;
    std::shared_ptr<int> token = self.run_token_;
    ~Restore() {
      self.lookup_ = lookup;
      self.stack_base_ = stack_base;
      self.file_ = std::move(file);
      self.run_token_ = std::move(token);
      --self.strict_;
    }
  } const restore{*this};
  if (stack_base_ == nullptr) stack_base_ = &here;
  if (!run_token_) run_token_ = std::make_shared<int>(0);
  file_ = file;
  lookup_ = &lookup;
  ++strict_;
  try {
    return evaluate(expression);
  } catch (const RaisedError& error) {
    throw DiagnosticError(error.object()->diagnostic());
  }
}

const Value* Evaluator::global(std::string_view name) const {
  const auto found = globals_.find(std::string(name));
  return found == globals_.end() ? nullptr : &found->second;
}

std::vector<std::string> Evaluator::global_names() const {
  std::vector<std::string> names;
  for (const auto& [name, value] : globals_) names.push_back(name);
  std::sort(names.begin(), names.end());
  return names;
}

// Variables

Frame& Evaluator::frame_of(const NameNode& name) {
  Frame* frame = frame_.get();
  for (int hop = 0; hop < name.hops; ++hop) frame = frame->outer.get();
  return *frame;
}

Value Evaluator::load(const NameNode& name) {
  if (name.global) return load_global(name);
  const std::optional<Value>& slot = frame_of(name).slots[static_cast<std::size_t>(name.slot)];
  if (slot) return *slot;
  if (name.hops == 0) {
    raise(ErrorKind::unbound_local,
          fmt::format("cannot access local variable '{}' where it is not associated with a value", name.id),
          "it is assigned in this function, but not before this line");
  }
  raise(ErrorKind::name,
        fmt::format("cannot access free variable '{}' where it is not associated with a value in enclosing scope",
                    name.id));
}

Value Evaluator::load_global(const NameNode& name) {
  if (lookup_ != nullptr) {
    if (auto value = (*lookup_)(name.id)) return std::move(*value);
  }
  if (const auto found = globals_.find(name.id); found != globals_.end()) return found->second;
  if (const Value* value = builtin_value(name.id)) return *value;
  if (const Value* value = math_name(name.id)) return *value;
  if (host_.is_command(name.id)) return Value(std::shared_ptr<Object>(std::make_shared<CommandObject>(name.id)));
  return unknown_name(name);
}

/// In a formula all of math is at hand; a file has the usual part of it.
const Value* Evaluator::math_name(std::string_view name) const {
  return strict_ > 0 ? math_value(name) : common_math_value(name);
}

/// Where the file itself gives the name a value behind this use; 0 if it does not.
int Evaluator::line_of_later_definition(const NameNode& name) const {
  if (tree_ == nullptr || tree_->file != file_) return 0;
  for (const StatementPtr& statement : tree_->statements) {
    if (statement->kind != StatementKind::assign || statement->begin <= name.begin) continue;
    for (const NodePtr& target : static_cast<const AssignStatement&>(*statement).targets) {
      if (target->kind == NodeKind::name && static_cast<const NameNode&>(*target).id == name.id)
        return file_->position(statement->begin).line;
    }
  }
  return 0;
}

/// Whether the statement that the name stands in is the one that gives it a value.
bool Evaluator::is_made_here(const NameNode& name) const {
  if (tree_ == nullptr || tree_->file != file_) return false;
  return std::ranges::any_of(tree_->statements, [&](const StatementPtr& statement) {
    if (statement->kind != StatementKind::assign || statement->begin > name.begin || statement->end < name.end)
      return false;
    const auto& targets = static_cast<const AssignStatement&>(*statement).targets;
    return std::ranges::any_of(targets, [&](const NodePtr& target) {
      return target->kind == NodeKind::name && static_cast<const NameNode&>(*target).id == name.id;
    });
  });
}

/// A name is reported once; its later uses belong to the same mistake.
Value Evaluator::unknown_name(const NameNode& name, bool called) {
  const auto& word = name.id;
  const bool like_a_command =
      called && std::none_of(word.begin(), word.end(), [](unsigned char c) { return std::islower(c) != 0; });
  if (names_lost_ && !like_a_command) return Value::unknown();
  std::vector<std::string> known = global_names();
  const std::vector<std::string> commands = host_.command_names();
  const std::vector<std::string> builtins = builtin_names();
  if (like_a_command) known.clear();
  known.insert(known.end(), commands.begin(), commands.end());
  if (!like_a_command) known.insert(known.end(), builtins.begin(), builtins.end());
  const std::string near = nearest(word, known);
  const std::string_view refusal = refusal_of(word);
  std::string hint = !near.empty() ? fmt::format("did you mean {}?", near) : "";
  if (math_value(word) != nullptr) hint = fmt::format("write 'from math import {}' before", word);
  if (!refusal.empty()) hint = refusal;
  const bool in_capitals = std::ranges::all_of(
      word, [](unsigned char c) { return std::isupper(c) != 0 || std::isdigit(c) != 0 || c == '_'; });
  if (hint.empty() && !called && in_capitals) hint = fmt::format("a text stands between quotes: '{}'", word);
  if (const int line = line_of_later_definition(name); line > 0)
    hint = fmt::format("it is defined later, in line {}", line);
  if (!called && is_made_here(name))
    hint = fmt::format("{} is made here: leave out what goes on from it (reuse=, ETAT_INIT) the first time", word);
  const std::string message = refusal.empty() ? fmt::format("name '{}' is not defined", word)
                                              : fmt::format("'{}' is not part of the command language", word);
  if (reported_names_.contains(word)) return Value::unknown();
  if (!recovering()) raise(ErrorKind::name, message, std::move(hint));
  reported_names_.insert(word);
  const char* code = like_a_command ? "unknown-command" : refusal.empty() ? "unknown-name" : "not-supported";
  report({Severity::error, code, like_a_command ? fmt::format("there is no command {}", word) : message,
          std::move(hint), span_of(name)});
  return Value::unknown();
}

/// A function that a running command calls changes nothing that waits: what binds variables of the file has run at
/// once.
void Evaluator::announce_binding(const NameNode& name) {
  if (guests_ == 0) host_.before_binding(name.id);
}

void Evaluator::store(const NameNode& name, Value value) {
  if (value.is_concept()) {
    const ConceptPtr& handle = value.as_concept();
    if (handle->name.empty() || handle->name[0] == '_') handle->name = name.id;
  }
  if (name.global) {
    if (globals_.contains(name.id)) announce_binding(name);
    globals_[name.id] = std::move(value);
  } else {
    auto& slot = frame_of(name).slots[static_cast<std::size_t>(name.slot)];
    if (slot) announce_binding(name);
    slot = std::move(value);
  }
}

void Evaluator::erase(const NameNode& name) {
  announce_binding(name);
  const bool existed =
      name.global ? globals_.erase(name.id) > 0 : frame_of(name).slots[static_cast<std::size_t>(name.slot)].has_value();
  if (!name.global) frame_of(name).slots[static_cast<std::size_t>(name.slot)].reset();
  if (!existed) raise(ErrorKind::name, fmt::format("name '{}' is not defined", name.id));
}

void Evaluator::assign(const Node& target, const Value& value) {
  switch (target.kind) {
    case NodeKind::name:
      return store(static_cast<const NameNode&>(target), value);
    case NodeKind::tuple:
    case NodeKind::list:
      return assign_items(static_cast<const SequenceNode&>(target), value);
    case NodeKind::subscript: {
      const auto& node = static_cast<const SubscriptNode&>(target);
      const Value object = evaluate(*node.object);
      return store_subscript(object, evaluate(*node.index), value, meter_);
    }
    case NodeKind::attribute: {
      const auto& node = static_cast<const AttributeNode&>(target);
      const Value object = evaluate(*node.object);
      if (object.is_unknown()) return;
      raise(ErrorKind::attribute, fmt::format("'{}' object attribute '{}' is read-only", object.type_name(), node.name),
            "attributes cannot be assigned in a command file");
    }
    default:
      return;
  }
}

void Evaluator::assign_items(const SequenceNode& target, const Value& value) {
  const auto& targets = target.items;
  if (value.is_unknown()) {
    for (const NodePtr& item : targets) {
      assign(item->kind == NodeKind::starred ? *static_cast<const StarredNode&>(*item).value : *item, value);
    }
    return;
  }
  if (!value.is_sequence() && !value.is_text()) {
    try {
      iterate(value);
    } catch (const RaisedError&) {
      raise(ErrorKind::type, fmt::format("cannot unpack non-iterable {} object", value.type_name()));
    }
  }
  std::vector<Value> items = list_of(value, meter_);
  const auto star =
      std::find_if(targets.begin(), targets.end(), [](const NodePtr& item) { return item->kind == NodeKind::starred; });
  const auto before = static_cast<std::size_t>(star - targets.begin());
  const bool starred = star != targets.end();
  const std::size_t fixed = starred ? targets.size() - 1 : targets.size();
  if (items.size() < fixed) {
    raise(ErrorKind::value, fmt::format("not enough values to unpack (expected {}{}, got {})",
                                        starred ? "at least " : "", fixed, items.size()));
  }
  if (!starred && items.size() > fixed)
    raise(ErrorKind::value, fmt::format("too many values to unpack (expected {})", fixed));
  const std::size_t taken = items.size() - fixed;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    if (i == before && starred) {
      const auto first = items.begin() + static_cast<std::ptrdiff_t>(i);
      assign(*static_cast<const StarredNode&>(*targets[i]).value,
             Value::list({first, first + static_cast<std::ptrdiff_t>(taken)}));
    } else {
      assign(*targets[i], items[i < before ? i : starred ? i + taken - 1 : i]);
    }
  }
}

// Errors

void Evaluator::report(const Diagnostic& finding) {
  if (finding.span) {
    const auto place = static_cast<std::uint64_t>(finding.span.begin) << 32 | finding.span.end;
    if (!reported_places_.emplace(finding.span.file.get(), place).second) {
      ++failures_;
      return;
    }
  }
  if (finding.code != "unknown-command") doubt();  // it would end a run, for which nobody knows what comes before
  diagnostics_.add(finding);
}

void Evaluator::place_error(ExceptionObject& error, Span span) const {
  error.span = std::move(span);
  error.called_from = diagnostics_.called_from();
}

void Evaluator::report(const ExceptionObject& error, const Statement& statement) {
  Diagnostic finding = error.diagnostic();
  if (!finding.span) finding.span = span_of(statement.begin, statement.end);
  report(finding);
}

/// Errors so far, those that the host reported included.
std::uint64_t Evaluator::count_failures() {
  const auto& items = diagnostics_.items();
  for (; errors_seen_ < items.size(); ++errors_seen_) {
    if (items[errors_seen_].severity == Severity::error) ++failures_;
  }
  return failures_;
}

void Evaluator::check_stack() const {
  const char here = 0;
  const auto used = stack_base_ > &here ? stack_base_ - &here : &here - stack_base_;
  if (static_cast<std::size_t>(used) > meter_.limits().stack_bytes) {
    raise(ErrorKind::recursion, "maximum recursion depth exceeded", "look for a function that calls itself for ever");
  }
}

}  // namespace comma::interpreter
