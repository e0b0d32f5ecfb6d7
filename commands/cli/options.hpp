// What the command line says.
#pragma once

#include <string>

#include "commands/context.hpp"
#include "interpreter/evaluation/meter.hpp"

namespace comma::commands {

/// The exit status of every subcommand.
enum ExitStatus : int {
  all_verdicts_hold = 0,
  a_verdict_fails = 1,
  the_file_is_wrong = 2,
  the_computation_failed = 3,
  anything_else = 4
};

struct RunOptions {
  std::string file;
  interpreter::Limits limits = {};
  std::string json;  ///< where the report goes; empty: nowhere
  bool only_tests = false;
  Verbosity verbosity = Verbosity::normal;
};

struct CheckOptions {
  std::string file;
  interpreter::Limits limits = {};
  std::string json;
};

struct GraphOptions {
  std::string file;
  interpreter::Limits limits = {};
  std::string format = "dot";  ///< "dot", "json" or "svg"
  bool only_tests = false;     ///< leave out what no verdict and no output needs
};

int run(const RunOptions& options);
int check(const CheckOptions& options);
int graph(const GraphOptions& options);
/// `path`: "", "COMMAND" or "COMMAND/KEYWORD/...".
int explain(const std::string& path);

}  // namespace comma::commands
