// comma check: is the file sound? The cheap commands run (meshes, groups, models, loads), nothing is solved.
#include <fmt/format.h>

#include <fstream>

#include "commands/cli/options.hpp"
#include "commands/cli/study_run.hpp"

namespace comma::commands {

namespace {

int conclude(const CheckOptions& options, const interpreter::Diagnostics& diagnostics) {
  print_diagnostics(diagnostics, true);
  const int status = diagnostics.has_errors() ? the_file_is_wrong : all_verdicts_hold;
  if (!options.json.empty()) {
    std::ofstream file(options.json);
    file << to_json({options.file, status_word(status), {}, {}, diagnostics.items(), {}, 0.0});
  }
  if (status == all_verdicts_hold) fmt::print("{} is sound\n", options.file);
  return status;
}

}  // namespace

int check(const CheckOptions& options) try {
  StudyRun pass(open_study(options.file), Verbosity::quiet, {.check_only = true, .only_tests = false}, options.limits);
  pass.run();
  return conclude(options, pass.diagnostics());
} catch (const interpreter::DiagnosticError& error) {
  interpreter::Diagnostics only;
  only.add(error.diagnostic());
  return conclude(options, only);
}

}  // namespace comma::commands
