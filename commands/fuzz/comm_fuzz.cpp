// Fuzz target: any text goes through lexer, parser, evaluator, and the catalogue's checks as `comma check` does it,
// save that no command acts. It must end in diagnostics that can be shown, of which none says that comma itself is at
// fault.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "commands/catalogue.hpp"
#include "interpreter/evaluation/evaluator.hpp"
#include "interpreter/graph/command_graph_export.hpp"
#include "interpreter/graph/session.hpp"
#include "interpreter/syntax/parser.hpp"

using namespace comma::interpreter;

namespace {

/// Small enough for some hundred runs a second, large enough for every branch.
Limits tight_limits() {
  Limits limits;
  limits.steps = 20'000;
  limits.largest_object = 1U << 20;
  limits.integer_bits = 1U << 14;
  limits.seconds = 5.0;
  limits.call_depth = 60;
  return limits;
}

void require_presentable(const Diagnostic& diagnostic) {
  const bool at_fault = diagnostic.code == "internal-error" || diagnostic.message.empty();
  const std::string text = render(diagnostic);
  if (!at_fault && !text.empty()) return;
  std::fprintf(stderr, "a fault of comma: %s\n", text.c_str());
  std::abort();
}

void check(const std::string& text, Diagnostics& diagnostics) {
  static const Catalogue catalogue(comma::commands::catalogue_blobs());
  static const CommandTable no_commands;
  Session session(catalogue, no_commands, diagnostics, {.check_only = true, .only_tests = false});
  for (const char* command : {"INCLUDE", "POURSUITE"}) session.act_at_once(command, [](const Call&) {});
  Evaluator evaluator(
      session, diagnostics, [](std::string_view) {}, tight_limits());
  const Ast tree = parse(std::make_shared<const SourceFile>("fuzz.comm", text), diagnostics);
  if (diagnostics.has_errors()) return;
  evaluator.run(tree);
  session.finish();
  to_dot(session.graph());
  to_json(session.graph()).dump();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Diagnostics diagnostics;
  try {
    check({reinterpret_cast<const char*>(data), size}, diagnostics);
  } catch (const DiagnosticError& error) {
    diagnostics.add(error.diagnostic());
  }
  for (const Diagnostic& diagnostic : diagnostics.items()) require_presentable(diagnostic);
  return 0;
}
