#include "commands/cli/study_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <string_view>

#include "commands/alarms/name_check.hpp"
#include "commands/catalogue.hpp"
#include "commands/cli/options.hpp"
#include "commands/registry.hpp"
#include "interpreter/evaluation/evaluator.hpp"
#include "interpreter/syntax/parser.hpp"
#include "interpreter/values/exception.hpp"

namespace comma::commands {

namespace fs = std::filesystem;
using interpreter::Diagnostic;
using interpreter::Severity;
using interpreter::Span;

namespace {

std::set<int> units_of(const std::vector<ExportFile>& files) {
  std::set<int> units;
  for (const ExportFile& file : files) units.insert(file.unit);
  return units;
}

// Codes of a computation that was well put and did not succeed, and of what is the machine's or comma's own fault; any
// other error says that the file is wrong.
constexpr std::array<std::string_view, 17> computation_codes = {"no-convergence",
                                                                "singular-matrix",
                                                                "contradictory-conditions",
                                                                "contact-cycling",
                                                                "not-finite",
                                                                "instability",
                                                                "integration-failure",
                                                                "inaccurate-solution",
                                                                "contact-interpenetration",
                                                                "contact-too-deep",
                                                                "contact-changes",
                                                                "residual-diverges",
                                                                "residual-too-large",
                                                                "increment-too-large",
                                                                "too-many-steps",
                                                                "command-failed",
                                                                "exit"};
constexpr std::array<std::string_view, 4> machine_codes = {"internal-error", "out-of-memory", "unwritable-file",
                                                           "missing-library"};

template <class Codes>
bool is_one_of(const Codes& codes, const std::string& code) {
  return std::find(codes.begin(), codes.end(), code) != codes.end();
}

/// What a look ahead finds wrong before anything is solved.
struct FoundAhead {
  std::vector<Diagnostic> findings;
};

int status_of(const Diagnostic& diagnostic) {
  if (is_one_of(machine_codes, diagnostic.code)) return anything_else;
  return is_one_of(computation_codes, diagnostic.code) ? the_computation_failed : the_file_is_wrong;
}

}  // namespace

Study open_study(const fs::path& file) {
  if (file.extension() == ".export") return read_export(file, fs::current_path());
  if (!fs::is_regular_file(file)) {
    throw interpreter::DiagnosticError("missing-file", fs::exists(file) ? file.string() + " is not a regular file"
                                                                        : "there is no file " + file.string());
  }
  return Study{{file}, {}};
}

StudyRun::StudyRun(Study study, Verbosity verbosity, interpreter::SessionOptions options, interpreter::Limits limits)
    : study_(std::move(study)),
      limits_(limits),
      context_{Files(study_.command_files.front(), study_.files, fs::current_path()), Console(verbosity), diagnostics_},
      commands_(make_command_table(context_)),
      preparations_(make_preparation_table(context_)),
      units_(units_of(study_.files)),
      catalogue_(catalogue_blobs()),
      session_(catalogue_, commands_, diagnostics_, options) {
  context_.only_checks = options.check_only;
  session_.prepare_with(preparations_);
  session_.set_assertion_sink([this](const interpreter::Assertion& assertion) {
    if (!unreadable_) context_.report(verdict_of(assertion));
  });
  session_.set_call_check([this](const interpreter::CommandNode& node) {
    return check_names(node, session_.graph(), catalogue_, diagnostics_);
  });
  session_.act_at_once("INCLUDE", [this](const interpreter::Call& call) { include(call); });
  session_.act_at_once("POURSUITE", [this](const interpreter::Call& call) { go_on(call); });
  session_.give_at_once("DEFI_FICHIER", [this](interpreter::Call& call) {
    return units_.number_of(call, unreadable_ || diagnostics_.has_errors());
  });
  if (!options.check_only) session_.look_ahead_with([this] { look_ahead(); });
  session_.set_output([this](std::string_view text) {
    if (!unreadable_) context_.console.print(text);
  });
  evaluator_ = std::make_unique<interpreter::Evaluator>(
      session_, diagnostics_, [this](std::string_view text) { session_.print(text); }, limits_);
}

void StudyRun::run() {
  try {
    read_files();
  } catch (const FoundAhead& ahead) {
    session_.write_printed();
    diagnostics_ = {};
    for (const Diagnostic& finding : ahead.findings) diagnostics_.add(finding);
    return;
  }
  session_.finish();
  if (evaluator_->failed_exit()) diagnostics_.add(*evaluator_->failed_exit());
  if (!diagnostics_.has_errors()) warn_of_unused_loads();
}

/// What a check finds up to where it cannot know the way that a run takes. Errors of the Python part are left to the
/// run.
void StudyRun::look_ahead() {
  using Certain = interpreter::Evaluator::Certain;
  StudyRun check(study_, Verbosity::quiet, {.check_only = true, .strict = true}, limits_);
  check.session_.set_output({});
  check.session_.set_assertion_sink({});
  check.evaluator_->on_doubt([](const Certain& before) { throw before; });
  std::vector<Diagnostic> findings;
  try {
    check.read_files();
  } catch (const Certain& before) {
    const auto& all = check.diagnostics_.items();
    findings.assign(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(before.findings));
    check.session_.leave_calls_from(before.calls);
    check.diagnostics_ = {};
  }
  check.session_.finish();
  for (const Diagnostic& finding : check.diagnostics_.items()) findings.push_back(finding);
  if (std::ranges::any_of(findings, [](const Diagnostic& each) { return each.severity == Severity::error; }))
    throw FoundAhead{findings};
}

void StudyRun::read_files() {
  for (const fs::path& file : study_.command_files) {
    ++files_begun_;
    evaluator_->run(read(file));
    if (evaluator_->failed_exit()) break;
  }
}

/// A load that was forgotten among those of a computation leaves no other trace.
void StudyRun::warn_of_unused_loads() {
  const auto& nodes = graph().nodes();
  if (std::ranges::none_of(nodes,
                           [](const interpreter::CommandNode& node) { return node.cost == interpreter::Cost::solve; }))
    return;
  std::set<int> read;
  for (const interpreter::CommandNode& node : nodes) {
    for (const interpreter::Edge& edge : node.waits_for) read.insert(edge.from);
  }
  for (const interpreter::CommandNode& node : nodes) {
    if (read.contains(node.id) || !node.product || !node.product->type.starts_with("char_")) continue;
    diagnostics_.alarm("unused-load", fmt::format("{}: no command uses {}", node.call.command, node.product->name),
                       node.call.span, "name it among EXCIT (or as CONTACT), or leave it out");
  }
}

/// What can be read of a file is evaluated for its errors, even if the rest cannot.
interpreter::Ast StudyRun::read(const fs::path& file) {
  interpreter::Diagnostics findings;
  interpreter::Ast tree = interpreter::parse(interpreter::SourceFile::read(file.string()), findings);
  unreadable_ = unreadable_ || findings.has_errors();
  for (const Diagnostic& finding : findings.items()) diagnostics_.add(finding);
  if (tree.statements.empty() && !findings.has_errors())
    diagnostics_.alarm("empty-file", file.filename().string() + " holds no statement: there is nothing to do", {},
                       "see whether it was saved, and whether another file is meant");
  return tree;
}

void StudyRun::include(const interpreter::Call& call) {
  // Deep enough for every sensible nesting; a file that includes itself must end.
  constexpr int deepest = 20;
  if (include_depth_ >= deepest) {
    throw interpreter::DiagnosticError("include-depth",
                                       fmt::format("files include one another more than {} times deep", deepest),
                                       call.span, "look for a file that includes itself");
  }
  // Files that include one another twice each are soon millions, whatever the depth.
  constexpr std::size_t most = 1000;
  if (trees_.size() == most) {
    throw interpreter::LimitReached("limit-files",
                                    fmt::format("this includes more than {} files: the run is stopped", most),
                                    call.span, "look for files that include one another");
  }
  const bool by_unit = call.given("UNITE");
  const Span where = call.span_of(by_unit ? "UNITE" : "DONNEE");
  const fs::path path = by_unit ? context_.files.included(static_cast<int>(call.integer("UNITE")), where)
                                : context_.files.included(call.text("DONNEE"), where);
  trees_.push_back(read(path));
  struct Depth {
    int& depth;
    explicit Depth(int& count) : depth(count) { ++depth; }
    ~Depth() { --depth; }
  } const depth(include_depth_);
  evaluator_->include(trees_.back());
}

void StudyRun::go_on(const interpreter::Call& call) const {
  if (files_begun_ > 1) return;
  evaluator_->lose_names();
  throw interpreter::DiagnosticError(
      "nothing-before", "POURSUITE goes on from a file before this one, and there is none", call.span,
      "name the files in their order in an .export; a data base of Code_Aster cannot be read");
}

void print_diagnostics(const interpreter::Diagnostics& diagnostics, bool alarms) {
  std::vector<Diagnostic> ordered = diagnostics.distinct();
  std::stable_partition(ordered.begin(), ordered.end(),
                        [](const Diagnostic& item) { return item.severity != Severity::error; });
  std::fflush(stdout);
  for (const Diagnostic& diagnostic : ordered) {
    if (!alarms && diagnostic.severity != Severity::error) continue;
    const std::string text = interpreter::render(diagnostic) + "\n";
    std::fwrite(text.data(), 1, text.size(), stderr);
  }
}

// A wrong file outweighs a failed computation, since it may have caused it; what is comma's own fault outweighs both.
int status_of(const interpreter::Diagnostics& diagnostics) {
  bool wrong = false, failed = false;
  for (const Diagnostic& diagnostic : diagnostics.items()) {
    if (diagnostic.severity != Severity::error) continue;
    const int status = status_of(diagnostic);
    if (status == anything_else) return anything_else;
    wrong |= status == the_file_is_wrong;
    failed |= status == the_computation_failed;
  }
  if (wrong) return the_file_is_wrong;
  return failed ? the_computation_failed : 0;
}

std::string status_word(int exit_status) {
  switch (exit_status) {
    case all_verdicts_hold:
      return "passed";
    case a_verdict_fails:
      return "failed";
    case the_file_is_wrong:
      return "invalid";
    default:
      return "error";
  }
}

}  // namespace comma::commands
