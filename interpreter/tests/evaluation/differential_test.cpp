// The language against python3: what a few hundred snippets print must be the same to the last character.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "interpreter/tests/recording_host.hpp"

using namespace comma::interpreter;
using testing::Run;

namespace {

const std::filesystem::path folder = std::filesystem::path(COMMA_SOURCE_DIR) / "interpreter/tests/snippets";
constexpr std::string_view separator = "\n# ----\n";

std::string read(const std::filesystem::path& path) {
  std::ifstream stream(path);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

/// What python3 prints for each snippet, in the order of files and snippets; empty when there is no python3.
nlohmann::json python_outputs() {
  const std::string python = COMMA_PYTHON3;
  if (python.empty()) return {};
  const std::string command = "\"" + python + "\" \"" + (folder / "run_snippets.python").string() + "\" \"" +
                              folder.string() + "\" 2>/dev/null";
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return {};
  std::string text;
  char buffer[4096];
  for (std::size_t n = 0; (n = fread(buffer, 1, sizeof buffer, pipe)) > 0;) text.append(buffer, n);
  if (pclose(pipe) != 0) return {};
  return nlohmann::json::parse(text, nullptr, false);
}

std::vector<std::string> snippets() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".py") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::vector<std::string> all;
  for (const auto& file : files) {
    const std::string text = read(file);
    std::size_t from = 0;
    for (std::size_t at = text.find(separator); at != std::string::npos; at = text.find(separator, from)) {
      all.push_back(text.substr(from, at - from) + "\n");
      from = at + separator.size();
    }
    all.push_back(text.substr(from));
  }
  return all;
}

}  // namespace

TEST_CASE("Snippets print what python3 prints", "[differential]") {
  const nlohmann::json expected = python_outputs();
  if (!expected.is_array() || expected.empty()) {
    WARN("python3 was not found or does not run: the differential test is skipped");
    return;
  }
  const std::vector<std::string> all = snippets();
  REQUIRE(all.size() == expected.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    INFO(all[i]);
    const Run run(all[i]);
    if (!run.diagnostics.items().empty()) INFO(render(run.diagnostics.items().front()));
    CHECK(run.diagnostics.items().empty());
    CHECK(run.output == expected[i].get<std::string>());
  }
}
