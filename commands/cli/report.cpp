#include "commands/cli/report.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

namespace comma::commands {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

namespace {

constexpr int report_version = 1;

ordered_json json_of(const std::optional<TestedValue>& value) {
  if (!value) return nullptr;
  return std::visit([](const auto& held) { return ordered_json(held); }, *value);
}

ordered_json json_of(const Verdict& verdict) {
  return {{"file", verdict.file},
          {"line", verdict.line},
          {"command", verdict.command},
          {"label", verdict.label},
          {"kind", verdict.kind},
          {"reference_type", verdict.reference_type},
          {"reference", json_of(verdict.reference)},
          {"computed", json_of(verdict.computed)},
          {"criterion", verdict.relative ? "RELATIF" : "ABSOLU"},
          {"tolerance", verdict.tolerance},
          {"order_of_magnitude",
           verdict.order_of_magnitude ? ordered_json(*verdict.order_of_magnitude) : ordered_json(nullptr)},
          {"error", verdict.error},
          {"passed", verdict.passed}};
}

ordered_json json_of(const CommandRecord& command) {
  return {{"name", command.name},
          {"line", command.line},
          {"concept", command.concept_name},
          {"seconds", command.seconds},
          {"skipped", command.skipped}};
}

ordered_json json_of_place(const interpreter::Span& span) {
  const auto place = span.file->position(span.begin);
  return {{"file", span.file->path()}, {"line", place.line}, {"column", place.column}};
}

ordered_json json_of(const interpreter::Diagnostic& diagnostic) {
  ordered_json json = {{"severity", std::string(interpreter::name_of(diagnostic.severity))},
                       {"code", diagnostic.code},
                       {"message", diagnostic.message}};
  if (!diagnostic.hint.empty()) json["hint"] = diagnostic.hint;
  const auto& span = diagnostic.span;
  const auto begin = span ? span.file->position(span.begin) : interpreter::Position{};
  const auto end = span ? span.file->position(span.end) : interpreter::Position{};
  json["file"] = span ? span.file->path() : "";
  json["line"] = begin.line;
  json["column"] = begin.column;
  json["end_line"] = end.line;
  json["end_column"] = end.column;
  for (const interpreter::Span& call : diagnostic.called_from) json["called_from"].push_back(json_of_place(call));
  return json;
}

/// The largest resident size. Not getrusage's: Linux keeps that one through exec, so that a program started by a large
/// process would report the size of the latter.
long peak_memory_bytes() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    if (long kib = 0; word == "VmHWM:" && status >> kib) return kib * 1024;
  }
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss * 1024;  // Linux counts in KiB
}

template <class Items>
ordered_json json_list(const Items& items) {
  ordered_json list = ordered_json::array();
  for (const auto& item : items) list.push_back(json_of(item));
  return list;
}

}  // namespace

std::string to_json(const Report& report) {
  const solver::Counters& counters = report.counters;
  const ordered_json json = {
      {"version", report_version},
      {"file", report.file},
      {"status", report.status},
      {"tests", json_list(report.tests)},
      {"commands", json_list(report.commands)},
      {"diagnostics", json_list(report.diagnostics)},
      {"counters",
       {{"factorisations", counters.factorisations},
        {"indefinite_factorisations", counters.indefinite_factorisations},
        {"solves", counters.solves},
        {"newton_iterations", counters.newton_iterations},
        {"contact_iterations", counters.contact_iterations},
        {"pairings", counters.pairings}}},
      {"phases",
       {{"assembling", counters.assembling}, {"factorising", counters.factorising}, {"solving", counters.solving}}},
      {"peak_memory_bytes", peak_memory_bytes()},
      {"seconds", report.seconds}};
  return json.dump(1, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

void require_writable(const std::string& path) {
  const fs::path file = fs::absolute(path), folder = file.parent_path();
  if (!fs::is_directory(folder))
    throw interpreter::DiagnosticError("unwritable-file", "cannot write the report " + path, {},
                                       "there is no folder " + folder.string());
  if (fs::is_directory(file) || access((fs::exists(file) ? file : folder).c_str(), W_OK) != 0)
    throw interpreter::DiagnosticError("unwritable-file", "cannot write the report " + path, {},
                                       "name a file in a folder that you may write to");
}

void write_report(const std::string& path, const Report& report) {
  std::ofstream file(path);
  file << to_json(report);
  file.close();
  if (!file) throw interpreter::DiagnosticError("unwritable-file", "cannot write the report " + path);
}

}  // namespace comma::commands
