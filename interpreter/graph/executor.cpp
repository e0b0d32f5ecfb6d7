#include "interpreter/graph/executor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <new>
#include <span>
#include <stdexcept>

namespace comma::interpreter {
namespace {

bool is_preparation(const CommandNode& node) {
  return node.cost == Cost::cheap &&
         (node.role == Role::value || node.role == Role::naming || node.role == Role::setup);
}

/// Whether what `source` made can be read.
bool is_readable(const CommandNode& source) {
  if (source.state == NodeState::done) return true;
  return source.state == NodeState::failed && source.forgiven && source.product && source.product->data;
}

/// Of a command that reads what one that was left out would have written.
Diagnostic not_computed(const CommandNode& left_out, const CommandNode& reader) {
  return {Severity::error, "not-computed",
          fmt::format("{} reads what {} (line {}) was to write or name, which comma has left out", reader.call.command,
                      left_out.call.command, line_of(left_out)),
          "see the alarm there", reader.call.span};
}

DiagnosticError not_computed(const CommandNode& source) {
  return {"not-computed", fmt::format("{} (line {}) has not been computed", source.call.command, line_of(source)),
          source.call.span};
}

}  // namespace

template <typename Act>
bool Executor::report_errors(const Act& act, Severity unsupported) {
  try {
    act();
  } catch (const DiagnosticError& error) {
    Diagnostic finding = error.diagnostic();
    if (finding.code == "unsupported") finding.severity = unsupported;
    const bool is_alarm = finding.severity == Severity::alarm;
    diagnostics_.add(std::move(finding));
    return is_alarm;
  }
  return false;
}

bool Executor::is_to_prepare(const CommandNode& node) const {
  return preparations_ != nullptr && preparations_->contains(node.call.command) && !node.caught && is_in_turn(node) &&
         can_run(node);
}

void Executor::run_cheap(Need least, bool nothing_more, const CallCheck& check) {
  const auto needs = graph_.needs();
  const Severity unsupported = nothing_more ? Severity::alarm : Severity::error;
  const auto solves = [](const CommandNode& node) {
    return node.state == NodeState::waiting && node.cost == Cost::solve;
  };
  const bool prepares = nothing_more || std::ranges::count_if(graph_.nodes(), solves) >
                                            1;  // one alone runs next, and tells the same itself
  for (CommandNode& node : graph_.nodes()) {
    if (node.state != NodeState::waiting || needs[static_cast<std::size_t>(node.id)] < least) continue;
    if (!passes(node, check)) continue;
    const Diagnostics::LaterWork scope(diagnostics_, node.called_from);
    const Diagnostics::Handled handled(diagnostics_, node.caught);
    if (nothing_more && is_told_of_left_out(node)) continue;
    // What is not written has no place to be read from.
    const bool any_turn = nothing_more && node.role != Role::naming;
    if (is_preparation(node) && (any_turn || is_in_turn(node)) && can_run(node)) {
      const bool is_alarm = report_errors([&] { run(node); }, only_writes(node.role) ? Severity::alarm : unsupported);
      node.left_out = is_alarm && only_writes(node.role);
    }
    if (prepares && is_to_prepare(node)) report_errors([&] { invoke(*preparations_, node); }, unsupported);
  }
}

bool Executor::is_in_turn(const CommandNode& node) const {
  return std::ranges::none_of(node.waits_for, [&](const Edge& edge) {
    return graph_.nodes()[static_cast<std::size_t>(edge.from)].state == NodeState::waiting;
  });
}

void Executor::run_all(Need least) {
  const auto needs = graph_.needs();
  for (CommandNode& node : graph_.nodes()) run_or_skip(node, needs[static_cast<std::size_t>(node.id)] >= least);
}

void Executor::run_begun(Need least, int count) {
  const auto needs = graph_.needs();
  const std::span<CommandNode> begun(graph_.nodes().data(), static_cast<std::size_t>(count));
  const auto solves = [](const CommandNode& node) { return node.cost == Cost::solve; };
  const auto last = std::ranges::find_if(begun.rbegin(), begun.rend(),
                                         [&](const CommandNode& node) { return solves(node) && node.has_run; });
  if (last == begun.rend()) return;
  const bool may_solve = last->state == NodeState::failed;
  for (CommandNode& node : begun) {
    if (!may_solve && is_reported(node)) return;
    run_or_skip(node, needs[static_cast<std::size_t>(node.id)] >= least && (may_solve || !solves(node)));
  }
}

void Executor::run_or_skip(CommandNode& node, bool wanted) {
  if (node.state != NodeState::waiting) return;
  if (wanted && can_run(node)) {
    run_reporting(node);
    return;
  }
  node.state = NodeState::skipped;
  if (wanted) is_told_of_left_out(node);
}

/// What failed has been told as an error, what was left out as an alarm alone.
bool Executor::is_told_of_left_out(CommandNode& node) {
  const CommandNode* source = missing_source(node);
  if (source == nullptr || !source->left_out) return false;
  diagnostics_.add(not_computed(*source, node));
  node.state = NodeState::skipped;
  return true;
}

void Executor::run_now(int id) {
  for (const int required : graph_.required_by(id)) {
    CommandNode& node = graph_.nodes()[static_cast<std::size_t>(required)];
    if (node.state == NodeState::waiting && can_run(node)) run_reporting(node);
  }
}

void Executor::run_in_turn(int id) {
  CommandNode& node = graph_.nodes()[static_cast<std::size_t>(id)];
  if (node.state == NodeState::waiting && is_in_turn(node) && can_run(node)) run_reporting(node);
}

void Executor::run_reporting(CommandNode& node) {
  const Diagnostics::LaterWork scope(diagnostics_, node.called_from);
  node.left_out = report_errors([&] { run(node); }, only_writes(node.role) ? Severity::alarm : Severity::error);
}

bool Executor::force(int id) {
  for (const int required : graph_.required_by(id)) {
    CommandNode& node = graph_.nodes()[static_cast<std::size_t>(required)];
    if (node.state != NodeState::waiting) continue;
    if (const CommandNode* source = missing_source(node)) {
      if (is_reported(*source)) return false;
      throw not_computed(*source);
    }
    if (!node.complete) throw not_computed(node);
    if (node.caught)
      run(node);
    else
      run_reporting(node);
    if (is_reported(node)) return false;
  }
  const CommandNode& last = graph_.nodes()[static_cast<std::size_t>(id)];
  if (is_reported(last)) return false;
  if (!is_readable(last)) throw not_computed(last);
  return true;
}

bool Executor::passes(CommandNode& node, const CallCheck& check) {
  const Diagnostics::LaterWork scope(diagnostics_, node.called_from);
  const Diagnostics::Handled handled(diagnostics_, node.caught);
  if (!check || check(node)) return true;
  node.state = NodeState::failed;
  return false;
}

bool Executor::is_ready(int id) const {
  const CommandNode& node = graph_.nodes()[static_cast<std::size_t>(id)];
  return node.state == NodeState::waiting && is_in_turn(node) && can_run(node);
}

bool Executor::is_cheap(int id) const {
  return std::ranges::all_of(graph_.required_by(id), [&](int required) {
    const CommandNode& node = graph_.nodes()[static_cast<std::size_t>(required)];
    return node.state != NodeState::waiting || (node.complete && is_preparation(node));
  });
}

void Executor::forgive(int id) { graph_.nodes()[static_cast<std::size_t>(id)].forgiven = true; }

void Executor::run(CommandNode& node) {
  if (before_run_) before_run_(node);
  const Diagnostics::LaterWork scope(diagnostics_, node.called_from);
  const auto start = std::chrono::steady_clock::now();
  node.has_run = true;
  ++running_;
  const auto stop_clock = [&] {
    --running_;
    node.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  try {
    auto data = invoke(commands_, node);
    if (node.product && data) node.product->data = std::move(data);
    if (node.product) ++node.product->version;
    node.state = NodeState::done;
    stop_clock();
  } catch (...) {
    if (node.product) ++node.product->version;
    node.state = NodeState::failed;
    stop_clock();
    throw;
  }
}

std::shared_ptr<ConceptData> Executor::invoke(const CommandTable& commands, const CommandNode& node) {
  const Call& call = node.call;
  const auto command = commands.find(call.command);
  if (command == commands.end())
    throw DiagnosticError("unsupported", fmt::format("comma does not run {} yet", call.command), call.span);
  try {
    return command->second(call);
  } catch (const DiagnosticError& error) {
    if (error.diagnostic().span) throw;
    Diagnostic placed = error.diagnostic();
    placed.span = call.span;
    throw DiagnosticError(std::move(placed));
  } catch (const std::bad_alloc&) {
    throw DiagnosticError("out-of-memory", fmt::format("{} needs more memory than there is", call.command), call.span);
  } catch (const std::logic_error& error) {
    throw DiagnosticError("internal-error", fmt::format("{}: {}", call.command, error.what()), call.span,
                          "this is a fault of comma, not of the file");
  } catch (const std::exception& error) {
    throw DiagnosticError("command-failed", fmt::format("{}: {}", call.command, error.what()), call.span);
  }
}

const CommandNode* Executor::missing_source(const CommandNode& node) const {
  for (const Edge& edge : node.waits_for) {
    const CommandNode& source = graph_.nodes()[static_cast<std::size_t>(edge.from)];
    if (edge.hazard == Hazard::read_after_write && !is_readable(source)) return &source;
  }
  return nullptr;
}

}  // namespace comma::interpreter
