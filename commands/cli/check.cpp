// comma check: is the file sound? The cheap commands run (meshes, groups, models, loads), nothing is solved.
#include <fmt/format.h>

#include "commands/cli/options.hpp"
#include "commands/cli/study_run.hpp"

namespace comma::commands {

namespace {

interpreter::Diagnostics diagnostics_of(const CheckOptions& options) try {
  StudyRun pass(open_study(options.file), Verbosity::quiet, {.check_only = true, .only_tests = false}, options.limits);
  pass.run();
  return pass.diagnostics();
} catch (const interpreter::DiagnosticError& error) {
  interpreter::Diagnostics only;
  only.add(error.diagnostic());
  return only;
}

}  // namespace

int check(const CheckOptions& options) {
  if (!options.json.empty()) require_writable(options.json);
  const interpreter::Diagnostics diagnostics = diagnostics_of(options);
  print_diagnostics(diagnostics, true);
  const int status = diagnostics.has_errors() ? the_file_is_wrong : all_verdicts_hold;
  if (!options.json.empty())
    write_report(options.json, {options.file, status_word(status), {}, {}, diagnostics.distinct(), {}, 0.0});
  if (status == all_verdicts_hold) fmt::print("{} is sound\n", options.file);
  return status;
}

}  // namespace comma::commands
