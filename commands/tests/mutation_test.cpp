// One error at a time, planted into every scene of ours: `comma check` must find it, alone, with the right code on the
// right line, and with a hint where a near name exists.
#include <fmt/format.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "commands/catalogue.hpp"
#include "commands/cli/study_run.hpp"
#include "commands/tests/mutations.hpp"

namespace fs = std::filesystem;
using namespace comma::commands;
using namespace comma::commands::tests;
using comma::interpreter::Diagnostic;
using comma::interpreter::Severity;

namespace {

// A scene with many calls has thousands of mutants; this many, evenly taken, keep the test short.
constexpr std::size_t most_mutants_a_scene = 60;
constexpr std::size_t most_pairs_a_scene = 20;
// Scenes with a larger mesh say nothing more about the checks.
constexpr std::uintmax_t largest_mesh = 500'000;

std::string text_of(const fs::path& path) {
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

// A folder with the scene's mesh, where mutants replace its command file.
class Bench {
 public:
  explicit Bench(const fs::path& scene)
      : folder_(fs::temp_directory_path() / fmt::format("comma-mutants-{}", getpid())) {
    fs::create_directories(folder_);
    for (const auto& entry : fs::directory_iterator(scene.parent_path())) {
      const bool other =
          entry.is_regular_file() && entry.path().extension() != ".comm" && entry.path().extension() != ".expected";
      if (other) fs::copy_file(entry.path(), folder_ / entry.path().filename(), fs::copy_options::overwrite_existing);
    }
    file_ = folder_ / scene.filename();
  }
  ~Bench() { fs::remove_all(folder_); }
  Bench(const Bench&) = delete;
  Bench& operator=(const Bench&) = delete;

  std::vector<Diagnostic> errors_of(const std::string& text) const {
    std::ofstream(file_) << text;
    StudyRun pass(open_study(file_), Verbosity::quiet, {.check_only = true, .only_tests = false});
    pass.run();
    std::vector<Diagnostic> errors;
    for (const Diagnostic& item : pass.diagnostics().items()) {
      if (item.severity == Severity::error) errors.push_back(item);
    }
    return errors;
  }

 private:
  fs::path folder_, file_;
};

struct Tally {
  int planted = 0, found = 0, alone = 0, right_code = 0, right_line = 0, hinted = 0, hints_due = 0;
};

bool mesh_is_small(const fs::path& scene) {
  for (const auto& entry : fs::directory_iterator(scene.parent_path())) {
    if (entry.is_regular_file() && entry.file_size() > largest_mesh) return false;
  }
  return true;
}

std::vector<fs::path> scenes() {
  const fs::path root = COMMA_SOURCE_DIR;
  std::vector<fs::path> found = {root / "commands/tests/wrong/sound.comm"};
  // testcases/SCENE/NAME.comm; what lies deeper is part of a command file (bench).
  for (auto entry = fs::recursive_directory_iterator(root / "testcases"); entry != fs::recursive_directory_iterator();
       ++entry) {
    const fs::path& path = entry->path();
    if (entry.depth() == 1 && path.extension() == ".comm" && mesh_is_small(path)) found.push_back(path);
  }
  std::sort(found.begin(), found.end());
  return found;
}

// Judges one mutant; what is not as it should be is told by a failing check with the mutant's own story.
void judge(const Bench& bench, const Mutant& mutant, Tally& tally) {
  const auto errors = bench.errors_of(mutant.text);
  std::string story = fmt::format("{} at line {}, wanted {} with hint \"{}\", got {} errors", mutant.kind, mutant.line,
                                  mutant.code, mutant.hint, errors.size());
  for (const Diagnostic& error : errors) story += "\n" + render(error);
  INFO(story);
  ++tally.planted;
  tally.found += errors.empty() ? 0 : 1;
  tally.alone += errors.size() == 1 ? 1 : 0;
  if (!errors.empty()) {
    const Diagnostic& error = errors.front();
    tally.right_code += error.code == mutant.code ? 1 : 0;
    tally.right_line += error.span && error.span.file->position(error.span.begin).line == mutant.line ? 1 : 0;
    tally.hinted += !mutant.hint.empty() && error.hint.find(mutant.hint) != std::string::npos ? 1 : 0;
  }
  tally.hints_due += mutant.hint.empty() ? 0 : 1;
  REQUIRE_FALSE(errors.empty());
  CHECK(errors.size() == 1);
  CHECK(errors.front().code == mutant.code);
  CHECK((errors.front().span && errors.front().span.file->position(errors.front().span.begin).line == mutant.line));
  CHECK(errors.front().hint.find(mutant.hint) != std::string::npos);
}

}  // namespace

TEST_CASE("A syntax error hides no error elsewhere in the file, and makes none") {
  const comma::interpreter::Catalogue catalogue(catalogue_blobs());
  int planted = 0, told = 0;
  for (const fs::path& scene : scenes()) {
    const std::string text = text_of(scene);
    const Bench bench(scene);
    const auto pairs = plant_pairs(text, catalogue);
    const std::size_t stride = 1 + pairs.size() / most_pairs_a_scene;
    for (std::size_t i = 0; i < pairs.size(); i += stride) {
      const Pair& pair = pairs[i];
      const auto errors = bench.errors_of(pair.text);
      std::string story =
          fmt::format("{}: {} at line {} and {} at line {}, got {} errors", scene.filename().string(),
                      pair.unreadable.kind, pair.unreadable.line, pair.other.kind, pair.other.line, errors.size());
      for (const Diagnostic& error : errors) story += "\n" + render(error);
      INFO(story);
      const auto tells = [&](const Mutant& mutant) {
        return std::any_of(errors.begin(), errors.end(), [&](const Diagnostic& error) {
          return error.code == mutant.code && error.span &&
                 error.span.file->position(error.span.begin).line == mutant.line;
        });
      };
      const bool both = errors.size() == 2 && tells(pair.unreadable) && tells(pair.other);
      CHECK(both);
      ++planted;
      told += both ? 1 : 0;
    }
  }
  fmt::print("pairs of a syntax error and another: {} planted, both told alone {}\n", planted, told);
  CHECK(planted > 100);
}

TEST_CASE("Each error that is planted into a scene is found, alone, in its place") {
  const comma::interpreter::Catalogue catalogue(catalogue_blobs());
  std::map<std::string, Tally> tallies;
  for (const fs::path& scene : scenes()) {
    const std::string text = text_of(scene);
    const Bench bench(scene);
    INFO(scene.string());
    if (!bench.errors_of(text).empty()) {
      FAIL_CHECK("the scene itself is not sound");
      continue;
    }
    const auto mutants = plant_errors(text, catalogue);
    const std::size_t stride = 1 + mutants.size() / most_mutants_a_scene;
    for (std::size_t i = 0; i < mutants.size(); i += stride) {
      try {
        judge(bench, mutants[i], tallies[mutants[i].kind]);
      } catch (const Catch::TestFailureException&) {
        continue;  // the others are worth a look too
      }
    }
  }
  Tally all;
  for (const auto& [kind, tally] : tallies) {
    fmt::print("{:<32} planted {:>4}  found {:>4}  alone {:>4}  right code {:>4}  right line {:>4}  hints {}/{}\n",
               kind, tally.planted, tally.found, tally.alone, tally.right_code, tally.right_line, tally.hinted,
               tally.hints_due);
    all.planted += tally.planted;
    all.found += tally.found;
  }
  fmt::print("mutants: {} planted, {} found\n", all.planted, all.found);
  for (const char* kind : {"misspelt command",
                           "misspelt keyword",
                           "misspelt word",
                           "missing compulsory keyword",
                           "two exclusive keywords",
                           "wrong type",
                           "wrong concept type",
                           "out of bounds",
                           "unknown concept",
                           "unknown group",
                           "unknown component",
                           "unknown field",
                           "concept used before it exists",
                           "too many occurrences",
                           "too many values",
                           "keyword given twice",
                           "unbalanced bracket",
                           "stray indentation",
                           "missing comma",
                           "string left open"}) {
    INFO(kind);
    CHECK(tallies[kind].planted > 0);
  }
}
