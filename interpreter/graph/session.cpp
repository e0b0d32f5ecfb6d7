#include "interpreter/graph/session.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "interpreter/catalogue/expression_keywords.hpp"
#include "interpreter/catalogue/foreign_commands.hpp"

namespace comma::interpreter {
namespace {

/// Whether what a command does is told where it is done: what is cheap runs in any order.
bool speaks(const CommandNode& node) {
  return node.cost == Cost::solve || node.role == Role::output || node.role == Role::verdict;
}

}  // namespace

Session::Session(const Catalogue& catalogue, const CommandTable& commands, Diagnostics& diagnostics,
                 SessionOptions options)
    : catalogue_(catalogue), diagnostics_(diagnostics), options_(options), executor_(graph_, commands, diagnostics) {
  executor_.set_before_run([this](const CommandNode& node) {
    if (node.cost == Cost::solve) {
      if (const auto look_ahead = std::exchange(look_ahead_, nullptr)) look_ahead();
      solving_has_begun_ = true;
    }
    if (speaks(node)) write_printed(std::min(static_cast<std::size_t>(node.id), first_to_speak()));
  });
}

bool Session::is_command(std::string_view name) const { return catalogue_.has(name) || is_foreign_command(name); }

std::vector<std::string> Session::command_names() const { return catalogue_.names(); }

Value Session::call(const CommandCall& written, bool eager) {
  const Severity unsupported = options_.check_only && !options_.strict ? Severity::alarm : Severity::error;
  if (!catalogue_.has(written.name)) {
    MissingCommand missing = missing_command(written.name, catalogue_.names());
    const Severity severity = is_foreign_command(written.name) ? unsupported : Severity::error;
    diagnostics_.add(
        {severity, std::move(missing.code), std::move(missing.message), std::move(missing.hint), written.name_span});
    spoil_reused(written);
    return Value::unknown();
  }
  const CommandPage& page = catalogue_.page(written.name);
  CommandCall bound = written;
  const bool readable = bind_expressions(bound, page, diagnostics_);
  CheckedCall checked = check_call(bound, page, catalogue_, diagnostics_, unsupported);
  if (!readable || !checked.sound) {
    spoil_reused(written);
    return Value::unknown();
  }
  if (const auto action = immediate_.find(written.name); action != immediate_.end()) {
    if (checked.complete) {
      name_files();
      action->second(checked.call);
    }
    return Value();
  }

  Value worth;
  if (const auto given = worths_.find(written.name); given != worths_.end())
    worth = checked.complete ? given->second(checked.call) : Value::unknown();
  ConceptPtr product = checked.call.result;
  const bool product_is_known = checked.product_type.has_value();
  if (!product && product_is_known && !checked.product_type->empty())
    product = make_concept(*checked.product_type, written.target, written.name_span);
  checked.call.result = product;
  CommandNode& node = graph_.add(std::move(checked.call), product, page, checked.complete);
  node.caught = eager;
  node.left_out = checked.left_out;
  node.called_from = diagnostics_.called_from();
  const int id = node.id;
  if (!diagnostics_.has_errors()) nodes_before_errors_ = id + 1;
  if (late_calls_.note_last(graph_, page.inside.further != nullptr) && !eager && may_run(id)) executor_.run_now(id);
  // Loops that compute at once would keep all that they have given up.
  if ((page.destroys || page.role == Role::naming) && may_run(id)) executor_.run_in_turn(id);
  if (eager && may_run(id)) {
    try {
      if (!executor_.force(id)) return Value::unknown();
    } catch (const DiagnosticError& failure) {
      executor_.forgive(id);
      if (product && product->data) throw CommandFailure(failure.diagnostic(), product);
      throw;
    }
  }
  if (!product && !product_is_known) return Value::unknown();
  return product ? Value(product) : worth;
}

/// A call that is wrong would have changed what it names with reuse=.
void Session::spoil_reused(const CommandCall& call) {
  for (const Argument& argument : call.arguments)
    if (argument.name == "reuse" && argument.value->is_concept()) graph_.spoil(*argument.value->as_concept());
}

// What acts at once may open a file that a command before it names, which itself waits for what is written before.
void Session::name_files() {
  if (options_.check_only || diagnostics_.has_errors()) return;
  for (const CommandNode& node : graph_.nodes())
    if (node.role == Role::naming && node.state == NodeState::waiting) executor_.run_now(node.id);
}

bool Session::force(const ConceptPtr& handle) {
  const int writer = graph_.last_writer(*handle);
  if (writer >= 0 && may_run(writer) && !executor_.force(writer)) return false;
  // What a check does not run may have been to change what is there.
  if (writer >= 0 && !runs_calls() && graph_.nodes()[static_cast<std::size_t>(writer)].state == NodeState::waiting)
    return false;
  if (!handle->data && handle->destroyed_at) throw destroyed_concept(*handle);
  return handle->data != nullptr;
}

void Session::before_binding(std::string_view name) {
  for (const int id : late_calls_.take_before_binding(name)) {
    if (may_run(id)) executor_.run_now(id);
  }
}

void Session::print(std::string_view text) {
  if (!output_) return;
  if (executor_.is_running() || options_.check_only) {
    output_(text);
    return;
  }
  if (diagnostics_.has_errors()) return;
  let_speak();
  if (diagnostics_.has_errors()) return;
  printed_[graph_.nodes().size()] += text;
  write_printed(first_to_speak());
}

std::size_t Session::first_to_speak() {
  const auto& nodes = graph_.nodes();
  const auto will_speak = [](const CommandNode& node) {
    return speaks(node) && node.complete && node.state == NodeState::waiting;
  };
  while (first_to_speak_ < nodes.size() && !will_speak(nodes[first_to_speak_])) ++first_to_speak_;
  return first_to_speak_;
}

void Session::let_speak() {
  if (!solving_has_begun_ || options_.only_tests) return;
  while (first_to_speak() < graph_.nodes().size()) {
    CommandNode& node = graph_.nodes()[first_to_speak_];
    if (node.cost == Cost::solve || !executor_.is_ready(node.id)) return;
    if (!executor_.passes(node, call_check_)) return;
    executor_.run_now(node.id);
    if (node.state == NodeState::waiting) return;
  }
}

void Session::write_printed(std::size_t nodes) {
  const auto end = printed_.upper_bound(nodes);
  for (auto text = printed_.begin(); text != end; ++text) output_(text->second);
  printed_.erase(printed_.begin(), end);
}

void Session::leave_calls_from(std::size_t count) {
  auto& nodes = graph_.nodes();
  for (std::size_t id = count; id < nodes.size(); ++id)
    if (nodes[id].state == NodeState::waiting) nodes[id].state = NodeState::skipped;
}

void Session::judge(const Assertion& assertion) {
  if (assertion_sink_) assertion_sink_(assertion);
}

void Session::finish() {
  look_ahead_ = nullptr;
  const Need least = options_.only_tests ? Need::output : Need::nothing;
  executor_.run_cheap(least, options_.check_only, call_check_);
  if (options_.check_only) return;  // and nothing that was printed waits
  if (diagnostics_.has_errors())
    executor_.run_begun(least, nodes_before_errors_);
  else
    executor_.run_all(least);
  write_printed(graph_.nodes().size());
}

ConceptPtr Session::make_concept(const std::string& type, const std::string& name, const Span& span) {
  auto handle = std::make_shared<Concept>();
  handle->id = next_concept_++;
  handle->name = name.empty() ? fmt::format("_{}", handle->id) : name;
  handle->type = type;
  handle->defined_at = span;
  return handle;
}

bool Session::may_run(int node) const { return executor_.is_cheap(node) || runs_calls(); }

}  // namespace comma::interpreter
