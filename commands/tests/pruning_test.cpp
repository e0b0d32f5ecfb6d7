// --only-tests leaves out what no verdict and no output needs; no verdict may change by it.
#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "commands/cli/study_run.hpp"

namespace fs = std::filesystem;
using namespace comma::commands;
using comma::interpreter::CommandNode;
using comma::interpreter::NodeState;

namespace pruning_test {

std::string text_of(const fs::path& path) {
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

// A folder of its own for what a scene reads and writes; the process works there.
class Workplace {
 public:
  explicit Workplace(const fs::path& scene)
      : before_(fs::current_path()),
        folder_(fs::temp_directory_path() / ("comma-pruning-" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
    for (const auto& entry : fs::directory_iterator(scene.parent_path())) {
      if (entry.is_regular_file())
        fs::copy_file(entry.path(), folder_ / entry.path().filename(), fs::copy_options::overwrite_existing);
    }
    fs::current_path(folder_);
  }
  ~Workplace() {
    fs::current_path(before_);
    fs::remove_all(folder_);
  }
  Workplace(const Workplace&) = delete;
  Workplace& operator=(const Workplace&) = delete;

 private:
  fs::path before_, folder_;
};

struct Outcome {
  std::vector<Verdict> verdicts;
  std::vector<std::string> left_out;  ///< concepts
  bool right = false;
};

Outcome run(const fs::path& file, bool only_tests) {
  StudyRun pass(open_study(file), Verbosity::quiet, {.check_only = false, .only_tests = only_tests});
  pass.run();
  Outcome outcome{pass.context().verdicts, {}, !pass.diagnostics().has_errors()};
  for (const CommandNode& node : pass.graph().nodes()) {
    if (node.state == NodeState::skipped && node.product) outcome.left_out.push_back(node.product->name);
  }
  return outcome;
}

std::vector<fs::path> scenes() {
  std::vector<fs::path> found;
  // testcases/SCENE/NAME.comm; what lies deeper is part of a command file (bench).
  const fs::path root = fs::path(COMMA_SOURCE_DIR) / "testcases";
  for (auto entry = fs::recursive_directory_iterator(root); entry != fs::recursive_directory_iterator(); ++entry) {
    if (entry.depth() == 1 && entry->path().extension() == ".comm") found.push_back(entry->path());
  }
  std::sort(found.begin(), found.end());
  return found;
}

TEST_CASE("Pruning never changes a verdict") {
  for (const fs::path& scene : scenes()) {
    CAPTURE(scene.string());
    const Workplace here(scene);
    // Something that nothing needs stands before the end of the file.
    std::string text = text_of(scene);
    const std::size_t end = text.rfind("FIN()");
    text.insert(end == std::string::npos ? text.size() : end, "\nidle = DEFI_LIST_REEL(VALE=(0.0, 1.0))\n");
    std::ofstream(scene.filename()) << text;

    const Outcome whole = run(scene.filename(), false);
    const Outcome pruned = run(scene.filename(), true);
    REQUIRE(whole.right);
    REQUIRE(pruned.right);
    CHECK(whole.left_out.empty());
    CHECK(std::find(pruned.left_out.begin(), pruned.left_out.end(), "idle") != pruned.left_out.end());
    REQUIRE(whole.verdicts.size() == pruned.verdicts.size());
    for (std::size_t i = 0; i < whole.verdicts.size(); ++i) {
      CAPTURE(whole.verdicts[i].label);
      CHECK(whole.verdicts[i].label == pruned.verdicts[i].label);
      CHECK(whole.verdicts[i].computed == pruned.verdicts[i].computed);  // the very same work: to the last bit
      CHECK(whole.verdicts[i].passed == pruned.verdicts[i].passed);
    }
  }
}

}  // namespace pruning_test
