// The command line: comma run | check | graph | explain.
#include <CLI/CLI.hpp>

#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "commands/cli/options.hpp"
#include "interpreter/diagnostic.hpp"

namespace {

using namespace comma::commands;

constexpr const char* version = "comma 0.1.0";

// One subcommand and what it does when it is chosen.
struct Subcommands {
  RunOptions run;
  CheckOptions check;
  GraphOptions graph;
  std::vector<std::string> explained;
  bool verbose = false;
  bool quiet = false;
};

// What a command file may use of the machine before the run is stopped.
void add_limits(CLI::App& command, comma::interpreter::Limits& limits) {
  command.add_option("--max-steps", limits.steps, "statements, loop turns and calls of the command file")
      ->capture_default_str();
  command.add_option("--max-seconds", limits.seconds, "time for the command file itself, without its commands")
      ->capture_default_str();
  command.add_option("--max-depth", limits.call_depth, "functions within functions")->capture_default_str();
  command
      .add_option_function<std::uint64_t>(
          "--max-memory", [&limits](std::uint64_t megabytes) { limits.memory = megabytes << 20; },
          "megabytes for the command file's own values")
      ->default_str(std::to_string(limits.memory >> 20));
}

void declare(CLI::App& app, Subcommands& given, int& status) {
  auto* run_command = app.add_subcommand("run", "Run a .comm, or a Code_Aster .export, and judge its verdicts");
  run_command->add_option("FILE", given.run.file, "a .comm or .export")->required();
  run_command->add_option("--json", given.run.json, "write the report there");
  run_command->add_flag("--only-tests", given.run.only_tests, "leave out what no verdict and no output needs");
  add_limits(*run_command, given.run.limits);
  auto* verbose = run_command->add_flag("-v,--verbose", given.verbose, "say more");
  run_command->add_flag("-q,--quiet", given.quiet, "say only what fails")->excludes(verbose);
  run_command->callback([&] {
    if (given.verbose) given.run.verbosity = Verbosity::verbose;
    if (given.quiet) given.run.verbosity = Verbosity::quiet;
    status = run(given.run);
  });

  auto* check_command = app.add_subcommand("check", "Tell everything that is wrong with a file; solve nothing");
  check_command->add_option("FILE", given.check.file, "a .comm or .export")->required();
  check_command->add_option("--json", given.check.json, "write the diagnostics there");
  add_limits(*check_command, given.check.limits);
  check_command->callback([&] { status = check(given.check); });

  auto* graph_command = app.add_subcommand("graph", "Draw the command graph of a file on standard output");
  graph_command->add_option("FILE", given.graph.file, "a .comm or .export")->required();
  graph_command->add_option("--format", given.graph.format, "dot, json or svg")
      ->check(CLI::IsMember({"dot", "json", "svg"}));
  graph_command->add_flag("--only-tests", given.graph.only_tests, "leave out what no verdict and no output needs");
  add_limits(*graph_command, given.graph.limits);
  graph_command->callback([&] { status = graph(given.graph); });

  auto* explain_command = app.add_subcommand("explain", "Say what a command or a keyword is");
  explain_command->add_option("PATH", given.explained,
                              "COMMAND, COMMAND/KEYWORD/... or COMMAND KEYWORD ...; nothing: the list of commands");
  explain_command->callback([&] { status = explain(fmt::format("{}", fmt::join(given.explained, "/"))); });
}

void tell(const comma::interpreter::Diagnostic& problem) {
  std::fprintf(stderr, "%s\n", comma::interpreter::render(problem).c_str());
}

std::vector<std::string> subcommand_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* each : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(each->get_name());
  return names;
}

// The long ones.
std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

// A word on the command line that means nothing, with what is probably meant; nothing where all words do.
std::optional<comma::interpreter::Diagnostic> stray_word(const CLI::App& app, const std::vector<std::string>& words) {
  using comma::interpreter::did_you_mean, comma::interpreter::Severity;
  const auto names = subcommand_names(app);
  const auto command = std::ranges::find_if_not(words, [](const std::string& word) { return word.starts_with('-'); });
  if (command == words.end()) return std::nullopt;
  if (std::ranges::find(names, *command) == names.end()) {
    const std::string near = did_you_mean(*command, names);
    const std::string hint = near.empty() ? fmt::format("there are {}", fmt::join(names, ", ")) : near;
    return {{Severity::error, "usage", fmt::format("comma has no subcommand {}", *command), hint, {}}};
  }
  const auto options = option_names(*app.get_subcommand(*command));
  for (const std::string& word : words) {
    const std::string name = word.substr(0, word.find('='));
    if (!word.starts_with("--") || std::ranges::find(options, name) != options.end()) continue;
    const std::string near = did_you_mean(name, options);
    const std::string hint = near.empty() ? fmt::format("'comma {} --help' lists them", *command) : near;
    return {{Severity::error, "usage", fmt::format("comma {} has no option {}", *command, name), hint, {}}};
  }
  return std::nullopt;
}

// Freed memory stays with the program: large arrays come and go with each assembly and factorisation, and pages that
// the system has to clear anew cost a fifth of a large run.
void keep_memory() {
  constexpr int most = 1 << 30;
  constexpr int growth = 64 << 20;
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, most);
  mallopt(M_TOP_PAD, growth);
}

}  // namespace

int main(int argc, char** argv) {
  keep_memory();
  CLI::App app("comma runs Code_Aster command files.", "comma");
  app.set_version_flag("--version", version);
  app.require_subcommand(1);
  Subcommands given;
  int status = anything_else;
  declare(app, given, status);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const auto stray = error.get_exit_code() == 0 ? std::nullopt : stray_word(app, {argv + 1, argv + argc});
    if (!stray) return app.exit(error) == 0 ? 0 : static_cast<int>(anything_else);
    tell(*stray);
    return anything_else;
  } catch (const comma::interpreter::DiagnosticError& error) {
    tell(error.diagnostic());
    return anything_else;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "comma: %s\n", error.what());
    return anything_else;
  }
  return status;
}
