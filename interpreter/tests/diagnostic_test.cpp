#include "interpreter/diagnostic.hpp"

#include <catch2/catch.hpp>

using namespace comma::interpreter;

TEST_CASE("A finding shows its place, its line, a caret and a hint", "[diagnostic]") {
  const auto file =
      std::make_shared<const SourceFile>("beam.comm", "\n\n\n\n\n\n\n\n\n\n\nMO = AFFE_MODELE(MAILAGE=MA)\n");
  const Diagnostic finding{Severity::error,
                           "unknown-keyword",
                           "AFFE_MODELE has no keyword MAILAGE",
                           "did you mean MAILLAGE?",
                           {file, 28, 35}};
  CHECK(render(finding) ==
        "beam.comm:12:18: error: AFFE_MODELE has no keyword MAILAGE [unknown-keyword]\n"
        "  12 | MO = AFFE_MODELE(MAILAGE=MA)\n"
        "     |                  ^~~~~~~\n"
        "     = hint: did you mean MAILLAGE?");
}

TEST_CASE("The caret stands below its character after tabs and accents", "[diagnostic]") {
  const auto file = std::make_shared<const SourceFile>("a.comm", "\té = x");
  CHECK(render({Severity::alarm, "c", "m", "", {file, 6, 7}}) ==
        "a.comm:1:6: alarm: m [c]\n  1 | \té = x\n    | \t    ^");
}

TEST_CASE("A finding without place is one line", "[diagnostic]") {
  CHECK(render({Severity::info, "note", "done", "", {}}) == "info: done [note]");
  CHECK(render({Severity::error, "c", "m", "h", {}}) == "error: m [c]\n  = hint: h");
}

TEST_CASE("A very long line is cut around the caret", "[diagnostic]") {
  const auto file = std::make_shared<const SourceFile>("a.comm", std::string(1000, 'a') + "b" + std::string(1000, 'c'));
  const std::string text = render({Severity::error, "c", "m", "", {file, 1000, 1001}});
  CHECK(text.size() < 500);
  const auto lines_begin = text.find('\n') + 1;
  const auto second = text.find('\n', lines_begin);
  const std::string shown = text.substr(lines_begin, second - lines_begin);
  const std::string carets = text.substr(second + 1);
  CHECK(shown[carets.find('^')] == 'b');
}

TEST_CASE("Only an error counts as one", "[diagnostic]") {
  Diagnostics findings;
  findings.alarm("a", "m", {});
  CHECK_FALSE(findings.has_errors());
  findings.error("b", "m", {});
  CHECK(findings.has_errors());
  CHECK(findings.items().size() == 2);
}

TEST_CASE("The nearest known word is found by slips of the fingers", "[diagnostic]") {
  const std::vector<std::string> known = {"MAILLAGE", "MODELE", "AFFE_MODELE", "GROUP_MA", "GROUP_NO"};
  CHECK(nearest("MAILAGE", known) == "MAILLAGE");
  CHECK(nearest("MIALLAGE", known) == "MAILLAGE");
  CHECK(nearest("maillage", known) == "MAILLAGE");
  CHECK(nearest("AFE_MODEL", known) == "AFFE_MODELE");
  CHECK(nearest("DYY", {"DX", "DRY", "DY"}) == "DY");
  CHECK(nearest("DW", {"DY", "DX"}) == "DY");
  CHECK(nearest("DZR", {"DZ", "DRZ"}) == "DRZ");
  CHECK(nearest("XYZ", known).empty());
  CHECK(nearest("", known).empty());
  CHECK(nearest(std::string(1000, 'A'), known).empty());
}
