#include "interpreter/syntax/parser.hpp"

#include <catch2/catch.hpp>

using namespace comma::interpreter;

namespace {

/// "code line:column" of each finding.
std::vector<std::string> findings(const std::string& text) {
  Diagnostics diagnostics;
  const auto file = std::make_shared<const SourceFile>("a.comm", text);
  parse(file, diagnostics);
  std::vector<std::string> lines;
  for (const Diagnostic& item : diagnostics.items()) {
    const Position place = file->position(item.span.begin);
    lines.push_back(item.code + " " + std::to_string(place.line) + ":" + std::to_string(place.column));
  }
  return lines;
}

using Findings = std::vector<std::string>;

std::string times(const std::string& text, int count) {
  std::string out;
  for (int i = 0; i < count; ++i) out += text;
  return out;
}

}  // namespace

TEST_CASE("One mistake makes one error, at its place", "[parser]") {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"MA = LIRE_MAILLAGE(FORMAT='MED'\nMO = AFFE_MODELE(MAILLAGE=MA,\n  AFFE=_F(TOUT='OUI'))\nx = 1\n",
       "unclosed-bracket 1:19"},
      {"MA = LIRE_MAILLAGE(FORMAT='MED',\nMO = AFFE_MODELE(MAILLAGE=MA)\nRES = STAT_NON_LINE(MODELE=MO)\nFIN()\n",
       "unclosed-bracket 1:19"},
      {"x = (1, 2\n", "unclosed-bracket 1:5"},
      {"x = [1, 2\ndef f():\n    return 1\n", "unclosed-bracket 1:5"},
      {"x = LIST(VALE=(1, 2)\nfor each, other in (\n    (1, 2),\n    (3, 4),\n):\n    f(each)\n",
       "unclosed-bracket 1:9"},
      {"A(B=1 C=2)\n", "missing-comma 1:7"},
      {"A(B=1, B=2)\n", "repeated-keyword 1:8"},
      {"x = (1]\n", "unmatched-bracket 1:7"},
      {"x = 1)\n", "unmatched-bracket 1:6"},
      {"x = )\ny = 1\n", "unmatched-bracket 1:5"},
      {"if x == 1\n    y = 2\n", "missing-colon 1:10"},
      {"if x = 1:\n    y = 2\nelse:\n    y = 3\n", "syntax 1:6"},
      {"if x:\ny = 2\n", "missing-block 1:1"},
      {"x = 1\n  y = 2\nz = 3\n", "unexpected-indent 2:3"},
      {"def f(:\n    return 1\nelse_ = 2\n", "syntax 1:7"},
      {"return 1\n", "misplaced-statement 1:1"},
      {"break\n", "misplaced-statement 1:1"},
      {"f(x) = 1\n", "invalid-target 1:1"},
      {"1 += 2\n", "invalid-target 1:1"},
      {"a, *b, *c = d\n", "invalid-target 1:1"},
      {"print 'x'\n", "syntax 1:1"},
      {"try:\n    x = 1\n", "syntax 1:1"},
      {"with f() as g:\n    x = 1\n    return 2\ny = 2\n", "misplaced-statement 3:5"},
      {"with a, b:\n    x = 1\ny = 2\n", "not-supported 1:7"},
      {"with f()\n    x = 1\ny = 2\n", "missing-colon 1:9"},
      {"class A:\n    def f(self):\n        return 1\n", "not-supported 1:1"},
      {"@d\ndef f(): pass\n", "not-supported 1:1"},
      {"def f():\n    yield 1\n", "not-supported 2:5"},
      {"x = f'{a'\n", "syntax 1:7"},
      {"x = f'{}'\n", "syntax 1:7"},
      {"x = 5 if 3\n", "syntax 1:11"},
      {"x = 1 +\n", "syntax 1:8"},
      {"def f(a, a): pass\n", "repeated-name 1:10"},
      {"def f(a=1, b): pass\n", "syntax 1:12"},
      {"f(a=1, 2)\n", "syntax 1:8"},
      {"def f():\n    nonlocal x\n    x = 1\n", "unknown-name 2:14"},
      {"else:\n    x = 1\n", "syntax 1:1"},
      {"else if x:\n    x = 1\n", "syntax 1:1"},
      {"x = 'abc\ny = 1\n", "unterminated-string 1:5"},
      {"F(A='B, C='2D', E=('G'))\nx = 1\n", "unterminated-string 1:22"},
      {"M = F(A=1,\n      B='C)\nN = G(D=M)\n", "unterminated-string 2:9"},
      {"M = F(A='B'\na, b = 1, 2\n", "unclosed-bracket 1:6"},
      {"M = F(A='B'\nd['x'] = F(1)\n", "unclosed-bracket 1:6"},
      {"M = F(A='B'\nd.update(x=1)\n", "unclosed-bracket 1:6"},
      {"M = F(A='B'\nfor i in M:\n    x = i\n", "unclosed-bracket 1:6"},
      {"def f(x):\nreturn x\n", "missing-block 1:1"},
      {"for i in (1, 2):\n    x = i\n  y = 2\nz = 3\n", "bad-indentation 3:3"},
      {"for i in (1, 2):\n    x = i\n  y = 2\n  z = 3\n", "bad-indentation 3:3"},
      {"for i in (1, 2):\n    x = i\n  y = 2\n    z = 3\n", "bad-indentation 3:3"},
      {"x = \xE2\x80\x9Cquoted\xE2\x80\x9D\n", "unexpected-character 1:5"},
  };
  for (const auto& [text, expected] : cases) {
    INFO(text);
    CHECK(findings(text) == Findings{expected});
  }
}

TEST_CASE("All errors of a file are told at once", "[parser]") {
  CHECK(findings("x = )\ny = 1\nif z\n    a = (1]\nfor i in 3:\n    b = = 2\nc = 'open\n") ==
        Findings{"unmatched-bracket 1:5", "missing-colon 3:5", "unmatched-bracket 4:11", "syntax 6:9",
                 "unterminated-string 7:5"});
}

TEST_CASE("Sound text has no findings", "[parser]") {
  CHECK(findings("").empty());
  CHECK(findings("\n\n# only a comment").empty());
  CHECK(findings("x = f(a, *b, c=1, **d,)\ny = [i for i in x if i]; z = {**a}\n").empty());
  CHECK(findings("M = LIRE(\nFORMAT='MED',\nUNITE=20,\nA=_F(B=1),\n)\n").empty());
  CHECK(findings("def f(a, /, b=1, *c, d, e=2, **g) -> int:\n    return lambda *x: x\n").empty());
}

TEST_CASE("A hundred thousand brackets end in a diagnostic", "[parser]") {
  for (const char* open : {"(", "[", "{", "-", "not ", "lambda: ", "1 if 1 else ", "2**", "f(", "a["}) {
    INFO(open);
    const Findings found = findings("x = " + times(open, 100'000) + "\ny = 1\n");
    REQUIRE_FALSE(found.empty());
    CHECK(found.front().substr(0, 8) == "too-deep");
  }
  CHECK(findings("x = " + times("1+", 100'000) + "1\n").front() == "too-deep 1:5");
  CHECK(findings("x = a" + times(".b", 100'000) + "\n").front() == "too-deep 1:5");
}

TEST_CASE("As many brackets as Python allows are fine", "[parser]") {
  CHECK(findings("x = " + times("(", 195) + "1" + times(")", 195) + "\n").empty());
  CHECK(findings("x = " + times("1 + ", 1500) + "1\n").empty());
}

TEST_CASE("A file of nonsense stops after a hundred errors", "[parser]") {
  CHECK(findings(times("x = )\n", 1000)).size() == 101);
}
