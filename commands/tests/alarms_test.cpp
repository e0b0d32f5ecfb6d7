// docs/alarms.md has one line for each alarm of the program, and none for others.
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace fs = std::filesystem;

namespace alarms_test {

std::string text_of(const fs::path& path) {
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

std::multiset<std::string> matches(const std::string& text, const char* pattern) {
  const std::regex expression(pattern);
  std::multiset<std::string> found;
  for (auto match = std::sregex_iterator(text.begin(), text.end(), expression); match != std::sregex_iterator();
       ++match)
    found.insert((*match)[1]);
  return found;
}

std::vector<fs::path> sources() {
  std::vector<fs::path> found;
  for (const char* layer : {"interpreter", "commands"}) {
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(COMMA_SOURCE_DIR) / layer)) {
      const bool is_test = entry.path().string().find("/tests/") != std::string::npos;
      if (entry.path().extension() == ".cpp" && !is_test) found.push_back(entry.path());
    }
  }
  return found;
}

TEST_CASE("The page of alarms lists those of the program") {
  // Words stand where the alarm is raised; those of contact where its doubts become advice (advice_on).
  std::set<std::string> raised;
  for (const fs::path& source : sources()) {
    const std::string text = text_of(source);
    const auto named = matches(text, "alarm\\(\\s*\"([a-z-]+)\"");
    const auto calls = matches(text, "(?:\\.|->)(alarm)\\(");
    const auto advice = matches(text, "alarm\\((advice\\.code),");
    const bool advises = source.filename() == "doubt_advice.cpp";
    const auto of_contact = matches(advises ? text : "", "return \\{\\s*\"([a-z-]+)\"");
    INFO(source);
    CHECK(named.size() + advice.size() == calls.size());
    CHECK(advises != of_contact.empty());
    raised.insert(named.begin(), named.end());
    raised.insert(of_contact.begin(), of_contact.end());
  }
  REQUIRE(raised.size() > 30);
  const auto listed = matches(text_of(fs::path(COMMA_SOURCE_DIR) / "docs/alarms.md"), "\n\\| `([a-z-]+)` \\|");
  CHECK(std::multiset<std::string>(raised.begin(), raised.end()) == listed);
}

}  // namespace alarms_test
