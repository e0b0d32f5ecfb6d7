// comma graph: the command graph on standard output.
#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands/cli/options.hpp"
#include "commands/cli/study_run.hpp"
#include "interpreter/graph/command_graph_export.hpp"

namespace comma::commands {

namespace {

// Lays a dot text out by graphviz, which writes the picture to standard output itself.
int write_svg(const std::string& dot) {
  std::fflush(stdout);
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(popen("dot -Tsvg", "w"), pclose);
  if (!pipe) return anything_else;
  std::fwrite(dot.data(), 1, dot.size(), pipe.get());
  return all_verdicts_hold;
}

bool has_graphviz() { return std::system("command -v dot >/dev/null 2>&1") == 0; }

int write(const interpreter::CommandGraph& graph, const std::string& format, interpreter::Need least) {
  if (format == "json") {
    fmt::print("{}\n", interpreter::to_json(graph, least).dump(1));
    return all_verdicts_hold;
  }
  const std::string dot = interpreter::to_dot(graph, least);
  if (format == "dot") {
    fmt::print("{}", dot);
    return all_verdicts_hold;
  }
  if (!has_graphviz()) {
    fmt::print(stderr, "comma: --format svg needs graphviz (apt-get install graphviz); --format dot does not\n");
    return anything_else;
  }
  return write_svg(dot);
}

}  // namespace

int graph(const GraphOptions& options) try {
  StudyRun pass(open_study(options.file), Verbosity::quiet, {.check_only = true, .only_tests = options.only_tests},
                options.limits);
  pass.run();
  print_diagnostics(pass.diagnostics(), false);
  if (pass.diagnostics().has_errors()) return the_file_is_wrong;
  return write(pass.graph(), options.format,
               options.only_tests ? interpreter::Need::output : interpreter::Need::nothing);
} catch (const interpreter::DiagnosticError& error) {
  fmt::print(stderr, "{}\n", interpreter::render(error.diagnostic()));
  return the_file_is_wrong;
}

}  // namespace comma::commands
