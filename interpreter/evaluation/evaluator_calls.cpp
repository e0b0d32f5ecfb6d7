// Calls: of functions, of builtins, and of commands, which go to the host.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "interpreter/catalogue/foreign_commands.hpp"
#include "interpreter/evaluation/evaluator.hpp"
#include "interpreter/library/builtins.hpp"
#include "interpreter/values/host_object.hpp"
#include "interpreter/values/operations.hpp"

namespace comma::interpreter {

namespace {

/// 'a', 'b', and 'c' - as Python lists missing arguments.
std::string list_names(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) text += names.size() == 2 ? " and " : i + 1 == names.size() ? ", and " : ", ";
    text += "'" + names[i] + "'";
  }
  return text;
}

std::map<std::string, Value> keyword_map(const CallArguments& arguments) {
  std::map<std::string, Value> keywords;
  for (const auto& item : arguments.named) keywords.emplace(item.name, item.value);
  return keywords;
}

[[noreturn]] void raise_too_many(const FunctionCode& code, std::size_t given) {
  std::size_t most = 0, fewest = 0;
  for (const Parameter& parameter : code.parameters) {
    if (parameter.kind != Parameter::Kind::normal) continue;
    ++most;
    if (parameter.default_index < 0) ++fewest;
  }
  const std::string range = fewest == most ? std::to_string(most) : fmt::format("from {} to {}", fewest, most);
  raise(ErrorKind::type, fmt::format("{}() takes {} positional argument{} but {} {} given", code.name, range,
                                     most == 1 ? "" : "s", given, given == 1 ? "was" : "were"));
}

[[noreturn]] void raise_missing(const FunctionCode& code, const std::vector<std::string>& names, const char* kind) {
  raise(ErrorKind::type, fmt::format("{}() missing {} required {} argument{}: {}", code.name, names.size(), kind,
                                     names.size() == 1 ? "" : "s", list_names(names)));
}

/// A failure of one part of a call is told at once; the call goes on with the rest.
bool is_tolerant_callee(const Value& callee) {
  const auto* builtin = callee.as_object<BuiltinObject>();
  return callee.as_object<CommandObject>() != nullptr || (builtin != nullptr && builtin->name == "_F");
}

}  // namespace

Value Evaluator::evaluate_call(const CallNode& node) {
  std::string target = std::exchange(target_, {});
  meter_.step();
  Value callee;
  if (node.callee->kind == NodeKind::name) {
    const auto& name = static_cast<const NameNode&>(*node.callee);
    const bool known = !name.global || (lookup_ != nullptr && (*lookup_)(name.id)) || globals_.contains(name.id) ||
                       builtin_value(name.id) != nullptr || math_name(name.id) != nullptr || host_.is_command(name.id);
    callee = known ? evaluate(name) : unknown_name(name, true);
    if (known && callee.is_unknown()) doubt();
  } else {
    callee = evaluate(*node.callee);
  }
  CallArguments arguments = evaluate_arguments(node, recovering() && is_tolerant_callee(callee));
  arguments.callee_span = span_of(*node.callee);
  arguments.span = span_of(node);
  arguments.target = std::move(target);
  return call(callee, arguments);
}

Value Evaluator::evaluate_argument(const Node& node, bool tolerant) {
  if (!tolerant) return evaluate(node);
  try {
    return evaluate(node);
  } catch (const RaisedError& error) {
    if (error.object()->kind == ErrorKind::system_exit) throw;
    report(error.object()->diagnostic());
    return Value::unknown();
  }
}

CallArguments Evaluator::evaluate_arguments(const CallNode& node, bool tolerant) {
  CallArguments arguments;
  for (const CallNode::Item& item : node.arguments) {
    if (item.repeated) continue;
    Value value = evaluate_argument(*item.value, tolerant);
    switch (item.kind) {
      case CallNode::Kind::positional:
        arguments.positional.push_back(std::move(value));
        break;
      case CallNode::Kind::keyword:
        arguments.named.push_back(
            {item.name, std::move(value), span_of(item.name_begin, item.name_end), span_of(*item.value)});
        break;
      case CallNode::Kind::spread:
        if (value.is_unknown())
          arguments.positional.push_back(value);
        else
          for (Value& part : list_of(value, meter_)) arguments.positional.push_back(std::move(part));
        break;
      case CallNode::Kind::spread_keywords:
        spread_mapping(arguments, value, span_of(*item.value));
        break;
    }
  }
  return arguments;
}

void Evaluator::spread_mapping(CallArguments& arguments, const Value& mapping, const Span& span) {
  if (mapping.is_unknown()) {
    arguments.open = true;
    return;
  }
  if (!mapping.is_dict())
    raise(ErrorKind::type, fmt::format("argument after ** must be a mapping, not {}", mapping.type_name()));
  const auto keywords = keywords_of(mapping.as_dict(), span);
  if (!keywords) raise(ErrorKind::type, "keywords must be strings");
  if (mapping.is_factor()) arguments.open = arguments.open || mapping.as_dict().factor->open;
  for (const Argument& item : *keywords) {
    if (arguments.find(item.name) != nullptr)
      raise(ErrorKind::type, fmt::format("got multiple values for keyword argument '{}'", item.name));
    arguments.named.push_back({item.name, *item.value, item.name_span, item.value_span});
  }
}

namespace {

/// What is not known has no text, within a list neither.
bool holds_any_unknown(const CallArguments& arguments) {
  return arguments.any_unknown() ||
         std::ranges::any_of(arguments.positional, [](const Value& value) { return holds_unknown(value); });
}

/// A method of a type (str.upper), with its object as first argument.
Value call_unbound(Evaluator& evaluator, const UnboundMethod& unbound, const CallArguments& arguments) {
  if (arguments.positional.empty())
    raise(ErrorKind::type, fmt::format("unbound method {}() needs an argument", unbound.name));
  CallArguments rest = arguments;
  rest.positional.erase(rest.positional.begin());
  // Looked up again: the object decides which type's method it is.
  const Method method = find_method(arguments[0], unbound.name);
  if (method != unbound.method)
    raise(ErrorKind::type, fmt::format("{}() does not apply to a '{}' object", unbound.name, arguments[0].type_name()));
  return method(evaluator, arguments[0], rest);
}

/// Not as work of the host: what it calls of the file counts as the file's own.
Value call_host_method(Evaluator& evaluator, const HostMethod& method, const CallArguments& arguments) {
  try {
    return method.code(evaluator, arguments);
  } catch (const LimitReached&) {
    throw;
  } catch (const DiagnosticError& error) {
    throw RaisedError(make_exception(error.diagnostic()));
  }
}

}  // namespace

/// What is called is not known: it may have changed what it names with reuse=.
void Evaluator::spoil_reused(const CallArguments& arguments) {
  const Value* reused = arguments.find("reuse");
  if (reused != nullptr && reused->is_concept()) host_.spoil(*reused->as_concept());
}

Value Evaluator::call(const Value& callee, const CallArguments& arguments) {
  if (callee.is_unknown()) {
    spoil_reused(arguments);
    return callee;
  }
  if (const auto* function = callee.as_object<FunctionObject>()) {
    return function->home == home_ ? call_function(*function, arguments) : call_from_outside(*function, arguments);
  }
  if (const auto* command = callee.as_object<CommandObject>()) return call_command(command->name, arguments);
  if (const auto* builtin = callee.as_object<BuiltinObject>()) {
    if (builtin->name == "_F") return make_factor(arguments);
    if (arguments.any_unknown()) return Value::unknown();
    const bool writes = builtin->name == "print" || builtin->name == "repr" || builtin->name == "format";
    if (writes && holds_any_unknown(arguments)) return Value::unknown();
    return builtin->function(*this, arguments);
  }
  if (const auto* bound = callee.as_object<BoundMethod>()) {
    const bool stores = bound->self.is_list() || bound->self.is_dict() || bound->self.is_set();
    if (!stores && arguments.any_unknown()) return Value::unknown();
    return bound->method(*this, bound->self, arguments);
  }
  if (const auto* unbound = callee.as_object<UnboundMethod>())
    return arguments.any_unknown() ? Value::unknown() : call_unbound(*this, *unbound, arguments);
  if (const auto* type = callee.as_object<TypeObject>()) {
    const bool is_unknown = type->name == "str" ? holds_any_unknown(arguments) : arguments.any_unknown();
    return is_unknown ? Value::unknown() : construct(*this, type->name, arguments);
  }
  if (const auto* error = callee.as_object<ExceptionClassObject>()) {
    auto object = make_exception(error->kind, "");
    object->arguments = arguments.positional;
    return Value(std::shared_ptr<Object>(std::move(object)));
  }
  if (const auto* method = callee.as_object<ConceptMethod>()) {
    if (arguments.any_unknown()) return Value::unknown();
    if (method->name == "getName" && arguments.size() == 0 && arguments.named.empty())
      return Value(method->handle->name);
    if (arguments.size() == 0 && arguments.named.empty())
      if (ConceptPtr source = source_behind(*method->handle, method->name)) return Value(std::move(source));
    return with_host([&]() -> Value {
      if (!host_.force(method->handle)) return Value::unknown();
      return method->handle->data->method(method->name, arguments.positional, keyword_map(arguments));
    });
  }
  if (const auto* method = callee.as_object<HostFunction>()) {
    if (arguments.any_unknown()) return Value::unknown();
    if (!arguments.named.empty()) raise(ErrorKind::type, fmt::format("{}() takes no keyword arguments", method->name));
    return with_host([&] { return method->code(arguments.positional); });
  }
  if (const auto* method = callee.as_object<HostMethod>())
    return arguments.any_unknown() ? Value::unknown() : call_host_method(*this, *method, arguments);
  if (callee.is_concept()) {
    if (arguments.any_unknown()) return Value::unknown();
    const ConceptPtr& handle = callee.as_concept();
    return with_host(
        [&]() -> Value { return host_.force(handle) ? handle->data->call(arguments.positional) : Value::unknown(); });
  }
  raise(ErrorKind::type, fmt::format("'{}' object is not callable", callee.type_name()),
        callee.is_sequence() || callee.is_number() ? "is a comma or an operator missing before '('?" : "");
}

// Commands

std::vector<Argument> Evaluator::named_arguments(const CallArguments& arguments, std::string_view what) {
  if (!arguments.positional.empty() && !is_foreign_command(what)) {
    raise(ErrorKind::type, fmt::format("{} takes keywords only", what), "write KEYWORD=value");
  }
  std::vector<Argument> named;
  named.reserve(arguments.named.size());
  for (const auto& item : arguments.named) {
    named.push_back({item.name, item.name_span, std::make_shared<const Value>(item.value), item.value_span});
  }
  return named;
}

/// Like dict(...), with the places of what is written: _F(A=1, B=2), _F({"A": 1}, B=2).
Value Evaluator::make_factor(const CallArguments& arguments) {
  CallArguments written = arguments;
  const bool extends = written.positional.size() == 1 && written.positional[0].is_dict();
  const Value base = extends ? written.positional[0] : Value();
  if (extends) written.positional.clear();
  auto places = std::make_shared<FactorPlaces>();
  if (extends && base.is_factor()) *places = *base.as_dict().factor;
  places->span = arguments.span;
  places->open = places->open || arguments.open;
  auto factor = std::make_shared<Dict>();
  if (extends) factor->update(base.as_dict());
  for (const Argument& item : named_arguments(written, "_F")) {
    factor->set(Value(item.name), *item.value);
    places->of_keywords.insert_or_assign(item.name, FactorPlaces::Place{item.name_span, item.value_span});
  }
  factor->factor = std::move(places);
  return Value(std::move(factor));
}

namespace {

bool is_computed(const Value& product) { return product.is_concept() && product.as_concept()->data != nullptr; }

}  // namespace

Value Evaluator::call_command(const std::string& name, const CallArguments& arguments) {
  if (guests_ > 0) raise(ErrorKind::runtime, fmt::format("a function that a formula calls cannot call {}", name));
  met_in_call_ = met_unknown_;
  CommandCall command;
  command.name = name;
  command.name_span = arguments.callee_span;
  command.span = arguments.span;
  command.arguments = named_arguments(arguments, name);
  command.open = arguments.open;
  command.target = arguments.target;
  command.scope = [this](std::string_view word) { return visible(word); };
  Value product = with_host([&] { return host_.call(command, !recovering()); });
  if (!host_.runs_calls() && !is_computed(product)) ++calls_left_alone_;
  if (name != "FIN") return product;
  // What follows it is not run (U4.11.02): as after sys.exit().
  auto exit = make_exception(ErrorKind::system_exit, "");
  exit->arguments.clear();
  throw RaisedError(std::move(exit));
}

/// The variable of a name in the function that runs or, if it has none, in the file.
std::optional<Value> Evaluator::visible(std::string_view name) const {
  if (code_ && frame_) {
    const auto slot = std::find(code_->slots.begin(), code_->slots.end(), name);
    const auto index = static_cast<std::size_t>(slot - code_->slots.begin());
    if (slot != code_->slots.end() && index < frame_->slots.size() && frame_->slots[index]) return frame_->slots[index];
  }
  const Value* value = global(name);
  if (value != nullptr) return *value;
  return names_lost_ ? std::optional(Value::unknown()) : std::nullopt;
}

// Functions

Value Evaluator::make_function(const std::shared_ptr<const FunctionCode>& code, const std::vector<NodePtr>& defaults) {
  auto function = std::make_shared<FunctionObject>();
  function->home = home_;
  function->code = code;
  function->outer = frame_;
  for (const NodePtr& value : defaults) function->defaults.push_back(evaluate(*value));
  if (frame_) remember_frame(frame_);
  return Value(std::shared_ptr<Object>(std::move(function)));
}

void Evaluator::remember_frame(const std::shared_ptr<Frame>& frame) {
  if (!closures_.empty() && closures_.back().lock() == frame) return;
  // Forget the dead ones whenever the list has doubled.
  if (closures_.size() == closures_.capacity())
    std::erase_if(closures_, [](const auto& weak) { return weak.expired(); });
  closures_.push_back(frame);
}

void Evaluator::bind_arguments(const FunctionObject& function, const CallArguments& arguments, Frame& frame) {
  const FunctionCode& code = *function.code;
  const auto& parameters = code.parameters;
  std::size_t given = 0;
  std::optional<std::size_t> rest, keywords;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (parameters[i].kind == Parameter::Kind::normal && given < arguments.size()) frame.slots[i] = arguments[given++];
    if (parameters[i].kind == Parameter::Kind::rest) rest = i;
    if (parameters[i].kind == Parameter::Kind::keywords) keywords = i;
  }
  if (given < arguments.size() && !rest) raise_too_many(code, arguments.size());
  if (rest)
    frame.slots[*rest] =
        Value::tuple({arguments.positional.begin() + static_cast<std::ptrdiff_t>(given), arguments.positional.end()});
  auto more = std::make_shared<Dict>();
  for (const auto& item : arguments.named) {
    const auto match = std::find_if(parameters.begin(), parameters.end(), [&](const Parameter& p) {
      return p.name == item.name && !p.positional_only &&
             (p.kind == Parameter::Kind::normal || p.kind == Parameter::Kind::keyword_only);
    });
    if (match == parameters.end()) {
      if (keywords) {
        more->set(Value(item.name), item.value);
        continue;
      }
      std::vector<std::string> names;
      for (const Parameter& parameter : parameters) names.push_back(parameter.name);
      raise(ErrorKind::type, fmt::format("{}() got an unexpected keyword argument '{}'", code.name, item.name),
            did_you_mean(item.name, names));
    }
    auto& slot = frame.slots[static_cast<std::size_t>(match - parameters.begin())];
    if (slot) raise(ErrorKind::type, fmt::format("{}() got multiple values for argument '{}'", code.name, item.name));
    slot = item.value;
  }
  if (keywords) frame.slots[*keywords] = Value(std::move(more));
  std::vector<std::string> missing, missing_keywords;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (frame.slots[i]) continue;
    if (parameters[i].default_index >= 0)
      frame.slots[i] = function.defaults[static_cast<std::size_t>(parameters[i].default_index)];
    else
      (parameters[i].kind == Parameter::Kind::normal ? missing : missing_keywords).push_back(parameters[i].name);
  }
  if (!missing.empty()) raise_missing(code, missing, "positional");
  if (!missing_keywords.empty()) raise_missing(code, missing_keywords, "keyword-only");
}

Value Evaluator::call_from_outside(const FunctionObject& function, const CallArguments& arguments) {
  Evaluator* home = function.home ? function.home->evaluator : nullptr;
  if (home == nullptr)
    raise(ErrorKind::runtime, fmt::format("{}() belongs to a file that has ended", function.code->name));
  return home->call_guest(function, arguments);
}

Value Evaluator::call_guest(const FunctionObject& function, const CallArguments& arguments) {
  struct Visit {
    explicit Visit(Evaluator& owner) : self(owner), base(owner.stack_base_) {
      ++self.guests_;
      ++self.tries_;  // errors go to the caller, as they do inside `try`
    }
    ~Visit() {
      --self.guests_;
      --self.tries_;
      self.stack_base_ = base;
    }
    Evaluator& self;
    const char* base;
  } const visit(*this);
  const char here = 0;
  if (calls_ == 0) stack_base_ = &here;
  return call_function(function, arguments);
}

Value Evaluator::call_function(const FunctionObject& function, const CallArguments& arguments) {
  if (calls_ >= meter_.limits().call_depth) {
    raise(ErrorKind::recursion, "maximum recursion depth exceeded", "look for a function that calls itself for ever");
  }
  check_stack();
  meter_.step();
  auto frame = std::make_shared<Frame>();
  frame->outer = function.outer;
  frame->slots.resize(function.code->slots.size());
  bind_arguments(function, arguments, *frame);
  struct Scope {
    Scope(Evaluator& owner, const Span& place)
        : self(owner), frame(owner.frame_), file(owner.file_), code(owner.code_), placed(place) {
      ++self.calls_;
      if (placed) self.diagnostics_.open_call(place);
    }
    ~Scope() {
      --self.calls_;
      if (placed) self.diagnostics_.close_call();
      self.frame_ = std::move(frame);
      self.file_ = std::move(file);
      self.code_ = std::move(code);
    }
    Evaluator& self;
    std::shared_ptr<Frame> frame;
    std::shared_ptr<const SourceFile> file;
    std::shared_ptr<const FunctionCode> code;
    bool placed;
  } const scope(*this, arguments.span);
  const std::shared_ptr<const FunctionCode> code = function.code;
  frame_ = std::move(frame);
  file_ = code->file;
  code_ = code;
  if (code->result) return evaluate(*code->result);
  returned_ = Value();
  const Flow flow = execute(code->body);
  return flow == Flow::return_ ? std::exchange(returned_, Value()) : Value();
}

}  // namespace comma::interpreter
