#include "interpreter/syntax/lost_names.hpp"

#include <catch2/catch.hpp>
#include <set>

using namespace comma::interpreter;

namespace {

std::set<std::string> lost(const std::string& text) {
  const auto file = std::make_shared<const SourceFile>("a.comm", text);
  std::set<std::string> names;
  for (const Span& span : lost_names(file, 0, static_cast<std::uint32_t>(text.size()), 0).names)
    names.insert(text.substr(span.begin, span.end - span.begin));
  return names;
}

using Names = std::set<std::string>;

}  // namespace

TEST_CASE("The names that a broken text would have bound") {
  CHECK(lost("MA = LIRE_MAILLAGE(UNITE=20") == Names{"MA"});
  CHECK(lost("a, b = c = d, e)") == Names{"a", "b", "c"});
  CHECK(lost("x += 1 1") == Names{"x"});
  CHECK(lost("l.append(1") == Names{"l"});
  CHECK(lost("d['a'] = = 1") == Names{"d"});
  CHECK(lost("for i, j in (1:") == Names{"i", "j"});
  CHECK(lost("def f(x, y=2:") == Names{"f", "x", "y"});
  CHECK(lost("from m import a, b as c)") == Names{"a", "b", "c"});
  CHECK(lost("DEFI_GROUP(reuse=MA, MAILLAGE=MB") == Names{"MA"});
  CHECK(lost("a == 3 4").empty());
}

TEST_CASE("Of the lines that an open bracket hides, statements bind names and arguments do not") {
  CHECK(lost("R = SOLVE(\n    MODEL=MO,\n    LOAD=F,\n\nN = OTHER(R)\nprint(N)\n") == Names{"R", "N"});
  CHECK(lost("R = SOLVE(MODEL=MO\nfor i in R:\n    x = i\n") == Names{"R", "i", "x"});
}

TEST_CASE("Whole sets of names can be lost") {
  const auto file = std::make_shared<const SourceFile>("a.comm", "from m import *)\nx = 1\n");
  CHECK(lost_names(file, 0, 16, 0).any);
  CHECK_FALSE(lost_names(file, 17, 22, 0).any);
}
