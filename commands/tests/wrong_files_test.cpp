// Every file of tests/wrong is wrong in one way (sound.comm in none). Beside NAME.comm stands NAME.expected: the exit
// status and what a user reads, to the letter. COMMA_UPDATE_EXPECTED=1 in the environment writes them anew, to be read
// before they are committed.
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "commands/cli/options.hpp"
#include "commands/cli/study_run.hpp"

namespace fs = std::filesystem;
using namespace comma::commands;

namespace wrong_files_test {

const fs::path folder = fs::path(COMMA_SOURCE_DIR) / "commands/tests/wrong";

std::string text_of(const fs::path& path) {
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
}

// What `comma run` says of a file, with the folder's path left out.
std::string outcome(const fs::path& file) {
  StudyRun pass(open_study(file), Verbosity::quiet, {});
  pass.run();
  std::string text = "exit " + std::to_string(status_of(pass.diagnostics())) + "\n";
  for (const auto& diagnostic : pass.diagnostics().distinct()) text += comma::interpreter::render(diagnostic) + "\n";
  replace_all(text, folder.string() + "/", "");
  return text;
}

std::vector<fs::path> files() {
  std::set<fs::path> sorted;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".comm") sorted.insert(entry.path());
  }
  return {sorted.begin(), sorted.end()};
}

TEST_CASE("Each wrong file gets its message, to the letter") {
  const bool update = std::getenv("COMMA_UPDATE_EXPECTED") != nullptr;
  REQUIRE(files().size() > 20);
  for (const fs::path& file : files()) {
    DYNAMIC_SECTION(file.stem().string()) {
      const fs::path expected = fs::path(file).replace_extension(".expected");
      if (update) std::ofstream(expected) << outcome(file);
      CHECK(outcome(file) == text_of(expected));
    }
  }
}

TEST_CASE("What is wrong is told before a solution that the file has to read") {
  const fs::path scratch = fs::temp_directory_path() / ("comma-read-" + std::to_string(getpid()));
  fs::create_directories(scratch);
  fs::copy_file(folder / "plate.mail", scratch / "plate.mail", fs::copy_options::overwrite_existing);
  std::string text = text_of(folder / "sound.comm");
  text.resize(text.find("FIN()"));
  text += "table = CREA_TABLE(RESU=_F(RESULTAT=result, NOM_CHAM='DEPL', INST=1.0, GROUP_NO='CORNER', NOM_CMP='DY'))\n";
  const auto factorisations = [&](const std::string& last, const std::string& code) {
    std::ofstream(scratch / "read.comm") << text << "print(table['DY', 1])\n" << last;
    StudyRun pass(open_study(scratch / "read.comm"), Verbosity::quiet, {});
    pass.run();
    const auto& found = pass.diagnostics().items();
    CHECK((code.empty() ? found.empty() : found.size() == 1 && found.front().code == code));
    return pass.context().counters.factorisations;
  };
  CHECK(factorisations("IMPR_TABLE(TABLE=table)\n", "") == 1);
  CHECK(factorisations("IMPR_TABLE(TABEL=table)\n", "unknown-keyword") == 0);
  fs::remove_all(scratch);
}

TEST_CASE("The sound file is sound") { CHECK(outcome(folder / "sound.comm") == "exit 0\n"); }

}  // namespace wrong_files_test
