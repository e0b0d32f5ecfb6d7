// A host for tests: it knows a few commands, records their calls, and makes a concept for each.
#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "interpreter/evaluation/evaluator.hpp"
#include "interpreter/syntax/parser.hpp"

namespace comma::interpreter::testing {

class RecordingHost : public CommandHost {
 public:
  std::vector<CommandCall> calls;
  std::vector<bool> eager;
  std::vector<ConceptPtr> concepts;
  std::vector<std::string> forced;
  std::vector<std::string> names = {"DEBUT", "FIN", "LIRE_MAILLAGE", "AFFE_MODELE", "STAT_NON_LINE", "DEFI_FONCTION"};
  /// When not empty, STAT_NON_LINE fails with this code as soon as it runs.
  std::string failure;
  /// What concepts contain once forced.
  std::shared_ptr<ConceptData> data;

  bool is_command(std::string_view name) const override {
    return std::find(names.begin(), names.end(), name) != names.end();
  }
  std::vector<std::string> command_names() const override { return names; }

  Value call(const CommandCall& call, bool run_now) override {
    calls.push_back(call);
    eager.push_back(run_now);
    if (call.name == "STAT_NON_LINE" && !failure.empty() && run_now)
      throw DiagnosticError(failure, "step 3 does not converge", call.span);
    if (call.name == "DEBUT" || call.name == "FIN") return {};
    auto handle = std::make_shared<Concept>();
    handle->id = static_cast<int>(concepts.size());
    handle->name = "_" + std::to_string(handle->id);
    handle->type = "concept";
    handle->defined_at = call.span;
    concepts.push_back(handle);
    return Value(handle);
  }

  bool force(const ConceptPtr& handle) override {
    forced.push_back(handle->name);
    handle->data = data;
    return data != nullptr;
  }
};

/// A text that was run: what it printed, what was wrong, which commands it called.
struct Run {
  explicit Run(const std::string& text, Limits limits = {}) : Run(text, std::make_unique<RecordingHost>(), limits) {}
  Run(const std::string& text, std::unique_ptr<RecordingHost> with, Limits limits = {}) : host(std::move(with)) {
    const auto file = std::make_shared<const SourceFile>("test.comm", text);
    ast = parse(file, diagnostics);
    evaluator = std::make_unique<Evaluator>(
        *host, diagnostics, [this](std::string_view part) { output += part; }, limits);
    evaluator->run(ast);
  }

  /// "code line:column" of each finding.
  std::vector<std::string> findings() const {
    std::vector<std::string> lines;
    for (const Diagnostic& item : diagnostics.items()) {
      const Position place = item.span ? item.span.file->position(item.span.begin) : Position{};
      lines.push_back(item.code + " " + std::to_string(place.line) + ":" + std::to_string(place.column));
    }
    return lines;
  }

  std::unique_ptr<RecordingHost> host;
  Diagnostics diagnostics;
  std::string output;
  Ast ast;
  std::unique_ptr<Evaluator> evaluator;
};

}  // namespace comma::interpreter::testing
