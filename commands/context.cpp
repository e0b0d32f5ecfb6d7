#include "commands/context.hpp"

#include <fstream>

namespace comma::commands {

void Context::write(const std::filesystem::path& path, std::string_view text) {
  const bool first = written.insert(path.string()).second;
  std::ofstream file(path, first ? std::ios::trunc : std::ios::app);
  file << text;
  file.flush();
  if (!file) {
    throw interpreter::DiagnosticError("unwritable-file", "cannot write " + path.string(), {},
                                       "see that its folder exists and may be written to");
  }
  if (first) console.progress("  writes " + path.string());
}

void Context::write(int unit, const std::string& extension, int default_unit, std::string_view text) {
  if (files.is_terminal(unit)) return console.print(text);
  write(files.output(unit, extension, default_unit), text);
}

void Context::begin_anew_if_renewed(int unit, const std::filesystem::path& path) {
  if (renewed_units.erase(unit) == 0) return;
  written.erase(path.string());
  med_files.erase(path.string());
}

void Context::report(Verdict verdict) {
  const std::string text = format_verdict(verdict);
  if (verdict.passed) {
    console.progress(text);
  } else {
    console.line(text);
  }
  verdicts.push_back(std::move(verdict));
}

}  // namespace comma::commands
