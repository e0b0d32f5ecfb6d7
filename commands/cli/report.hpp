// The JSON report of a run (docs/report.md).
#pragma once

#include <string>
#include <vector>

#include "commands/verdict.hpp"
#include "interpreter/diagnostic.hpp"
#include "solver/nonlinear/static_analysis.hpp"

namespace comma::commands {

struct CommandRecord {
  std::string name;
  int line = 0;
  std::string concept_name;
  double seconds = 0.0;
  bool skipped = false;
};

struct Report {
  std::string file;
  std::string status;  ///< "passed", "failed", "invalid", "error"
  std::vector<Verdict> tests;
  std::vector<CommandRecord> commands;
  std::vector<interpreter::Diagnostic> diagnostics;
  solver::Counters counters;
  double seconds = 0.0;
};

/// The report as JSON text, with this process's peak memory.
std::string to_json(const Report& report);

/// Whether a report could be written there, asked before anything is computed for it. Throws DiagnosticError
/// `unwritable-file`.
void require_writable(const std::string& path);

/// Throws DiagnosticError `unwritable-file`.
void write_report(const std::string& path, const Report& report);

}  // namespace comma::commands
