// comma run: everything, then the verdicts.
#include <fmt/format.h>

#include <chrono>

#include "commands/cli/options.hpp"
#include "commands/cli/study_run.hpp"

namespace comma::commands {

namespace {

std::vector<CommandRecord> records_of(const interpreter::CommandGraph& graph) {
  std::vector<CommandRecord> records;
  for (const interpreter::CommandNode& node : graph.nodes()) {
    const auto& span = node.call.span;
    records.push_back({node.call.command, span ? span.file->position(span.begin).line : 0,
                       node.product ? node.product->name : "", node.seconds,
                       node.state == interpreter::NodeState::skipped || node.state == interpreter::NodeState::waiting});
  }
  return records;
}

void show_summary(const Context& context, int status, double seconds) {
  const auto& verdicts = context.verdicts;
  const auto held =
      std::count_if(verdicts.begin(), verdicts.end(), [](const Verdict& verdict) { return verdict.passed; });
  const auto failed = static_cast<std::ptrdiff_t>(verdicts.size()) - held;
  const std::string judged =
      fmt::format("{}, {} {}", held == 1 ? "1 verdict holds" : fmt::format("{} verdicts hold", held), failed,
                  failed == 1 ? "fails" : "fail");
  std::string text = verdicts.empty() ? "no verdicts" : judged;
  if (status == the_file_is_wrong)
    text = (verdicts.empty() ? "" : judged + "; ") + "the file is wrong; nothing more was computed";
  if (status == the_computation_failed) text += "; the computation failed";
  context.console.line(fmt::format("{}   ({:.0f} ms)", text, 1e3 * seconds));
}

int status_of_run(const StudyRun& pass) {
  if (const int status = status_of(pass.diagnostics()); status != 0) return status;
  const auto& verdicts = pass.context().verdicts;
  const bool all_hold =
      std::all_of(verdicts.begin(), verdicts.end(), [](const Verdict& verdict) { return verdict.passed; });
  return all_hold ? all_verdicts_hold : a_verdict_fails;
}

struct Outcome {
  int status;
  Report report;
};

Outcome execute(const RunOptions& options) try {
  const auto started = std::chrono::steady_clock::now();
  StudyRun pass(open_study(options.file), options.verbosity, {.check_only = false, .only_tests = options.only_tests},
                options.limits);
  pass.run();
  const int status = status_of_run(pass);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - started;
  print_diagnostics(pass.diagnostics(), options.verbosity != Verbosity::quiet);
  if (status != all_verdicts_hold || options.verbosity != Verbosity::quiet)
    show_summary(pass.context(), status, elapsed.count());
  return {status,
          {options.file, status_word(status), pass.context().verdicts, records_of(pass.graph()),
           pass.diagnostics().distinct(), pass.context().counters, elapsed.count()}};
} catch (const interpreter::DiagnosticError& error) {
  interpreter::Diagnostics only;
  only.add(error.diagnostic());
  print_diagnostics(only, true);
  const int status = status_of(only);
  return {status, {options.file, status_word(status), {}, {}, only.items(), {}, 0.0}};
}

}  // namespace

int run(const RunOptions& options) {
  if (!options.json.empty()) require_writable(options.json);
  const Outcome outcome = execute(options);
  if (!options.json.empty()) write_report(options.json, outcome.report);
  return outcome.status;
}

}  // namespace comma::commands
