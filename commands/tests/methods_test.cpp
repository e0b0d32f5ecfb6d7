// The files of tests/methods ask concepts for what they hold, and claim what the answers are.
#include <catch2/catch.hpp>
#include <filesystem>

#include "commands/cli/study_run.hpp"

namespace fs = std::filesystem;
using namespace comma::commands;

TEST_CASE("Methods of concepts answer what the files that ask them claim, and a check of these files finds nothing") {
  const fs::path folder = fs::path(COMMA_SOURCE_DIR) / "commands/tests/methods";
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() != ".comm") continue;
    CAPTURE(entry.path().stem().string());
    for (const bool check_only : {false, true}) {
      CAPTURE(check_only);
      StudyRun pass(open_study(entry.path()), Verbosity::quiet, {.check_only = check_only, .only_tests = false});
      pass.run();
      for (const auto& item : pass.diagnostics().items()) FAIL_CHECK(comma::interpreter::render(item));
      if (!check_only) CHECK(pass.context().verdicts.size() > 5);
      for (const Verdict& verdict : pass.context().verdicts) {
        CAPTURE(verdict.line, verdict.label);
        CHECK(verdict.passed);
      }
    }
  }
}
