// The command line: comma run | check | graph | explain.
#include <CLI/CLI.hpp>

#include <malloc.h>

#include "commands/cli/options.hpp"

namespace {

using namespace comma::commands;

constexpr const char* version = "comma 0.1.0";

// One subcommand and what it does when it is chosen.
struct Subcommands {
  RunOptions run;
  CheckOptions check;
  GraphOptions graph;
  std::string explained;
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
  explain_command->add_option("PATH", given.explained, "COMMAND or COMMAND/KEYWORD/...; nothing: the list of commands");
  explain_command->callback([&] { status = explain(given.explained); });
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
    return app.exit(error) == 0 ? 0 : static_cast<int>(anything_else);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "comma: %s\n", error.what());
    return anything_else;
  }
  return status;
}
