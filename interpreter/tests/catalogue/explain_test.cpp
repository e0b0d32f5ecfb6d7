#include "interpreter/catalogue/explain.hpp"

#include <catch2/catch.hpp>

#include "interpreter/diagnostic.hpp"
#include "interpreter/tests/little_catalogue.hpp"

using namespace comma::interpreter;
using namespace comma::interpreter::tests;

namespace {

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("The list of commands is ordered by what one does with them") {
  const LittleCatalogue little = little_catalogue();
  const std::string all = explain_all(*little.catalogue);
  CHECK(all.find("mesh\n  MESH") < all.find("loads\n  LOAD"));
  CHECK(all.find("loads\n  LOAD") < all.find("verify\n  VERIFY"));
}

TEST_CASE("A command is told with its product, keywords, conditions, rules and example") {
  const LittleCatalogue little = little_catalogue();
  const std::string text = explain(*little.catalogue, "LOAD");
  CHECK(has(text, "LOAD - Makes a load."));
  CHECK(has(text, "a special load (special_load) when SPECIAL == 'YES'"));
  CHECK(has(text, "when STRENGTH > 5.0"));
  CHECK(has(text, "rule: at most one of PRES, POINTS"));
  CHECK(has(text, "L = LOAD(MODEL=MO, PRES=1.0)"));
  CHECK(has(text, "LATER                Not yet. [not supported yet]"));
}

TEST_CASE("A keyword is told with its type, unit, bounds, words and default") {
  const LittleCatalogue little = little_catalogue();
  const std::string pressure = explain(*little.catalogue, "LOAD/PRES");
  CHECK(has(pressure, "type       a real number"));
  CHECK(has(pressure, "unit       Pa"));
  CHECK(has(pressure, "bounds     above 0"));
  const std::string special = explain(*little.catalogue, "LOAD/SPECIAL");
  CHECK(has(special, "default    'NO'"));
  CHECK(has(special, "Undecided. [not supported yet]"));
  CHECK(has(explain(*little.catalogue, "LOAD/OLD_NEAR"), "older name OLD_NEAR"));
}

TEST_CASE("A keyword inside a factor and a block is told with the condition") {
  const LittleCatalogue little = little_catalogue();
  const std::string text = explain(*little.catalogue, "LOAD/SPOT/DEGREE");
  CHECK(has(text, "LOAD/SPOT/DEGREE - Degree of the special load."));
  CHECK(has(text, "only when  SPECIAL == 'YES'"));
  CHECK(has(text, "required   yes"));
}

TEST_CASE("A name that is not there is told with the nearest one") {
  const LittleCatalogue little = little_catalogue();
  const auto hint = [&](const std::string& path) {
    try {
      explain(*little.catalogue, path);
    } catch (const DiagnosticError& error) {
      return error.diagnostic().code + ": " + error.diagnostic().hint;
    }
    return std::string();
  };
  CHECK(hint("LAOD") == "unknown-command: did you mean LOAD?");
  CHECK(hint("THER_LINEAIRE") == "unsupported: 'comma explain' lists the commands that it has");
  CHECK(hint("LOAD/PRESS") == "unknown-keyword: did you mean PRES?");
  CHECK(hint("LOAD/SPOT/GROUPE") == "unknown-keyword: did you mean GROUP?");
  CHECK(hint("LOAD/SPOT/ELSEWHERE") == "unknown-keyword: 'comma explain LOAD/SPOT' lists its keywords");
  CHECK(hint("ELSEWHERE") == "unknown-command: 'comma explain' lists the commands");
}
