#include "interpreter/syntax/lexer.hpp"

#include <catch2/catch.hpp>

using namespace comma::interpreter;

namespace {

struct Lexed {
  explicit Lexed(const std::string& text) : file(std::make_shared<const SourceFile>("a.comm", text)) {
    Lexer lexer(file, diagnostics, 0, static_cast<std::uint32_t>(text.size()));
    do tokens.push_back(lexer.next());
    while (tokens.back().kind != TokenKind::end);
  }
  std::shared_ptr<const SourceFile> file;
  Diagnostics diagnostics;
  std::vector<Token> tokens;
};

std::vector<TokenKind> kinds_of(const std::string& text) {
  std::vector<TokenKind> kinds;
  for (const Token& token : Lexed(text).tokens) kinds.push_back(token.kind);
  return kinds;
}

Value number(const std::string& text) {
  const Lexed lexed(text);
  CHECK(lexed.diagnostics.items().empty());
  return lexed.tokens.front().value;
}

}  // namespace

TEST_CASE("Indentation becomes indent and dedent, blank lines and comments do not", "[lexer]") {
  using enum TokenKind;
  CHECK(kinds_of("if x:\n\n  # note\n  y\n\nz\n") ==
        std::vector<TokenKind>{keyword, name, symbol, newline, indent, name, newline, dedent, name, newline, end});
}

TEST_CASE("Inside brackets lines are joined", "[lexer]") {
  using enum TokenKind;
  CHECK(kinds_of("f(1,\n     2)\n") ==
        std::vector<TokenKind>{name, symbol, number, symbol, number, symbol, newline, end});
}

TEST_CASE("A backslash joins lines", "[lexer]") {
  using enum TokenKind;
  CHECK(kinds_of("a = \\\n  1\n") == std::vector<TokenKind>{name, symbol, number, newline, end});
}

TEST_CASE("A file without a last line break ends its line and its blocks", "[lexer]") {
  using enum TokenKind;
  CHECK(kinds_of("if a:\n  b") ==
        std::vector<TokenKind>{keyword, name, symbol, newline, indent, name, newline, dedent, end});
}

TEST_CASE("Numbers have the value that Python gives them", "[lexer]") {
  CHECK(number("0x1F").as_integer() == 31);
  CHECK(number("0b101").as_integer() == 5);
  CHECK(number("0o17").as_integer() == 15);
  CHECK(number("1_000").as_integer() == 1000);
  CHECK(number("1.e-3").as_real() == 1e-3);
  CHECK(number(".5").as_real() == 0.5);
  CHECK(number("2.E+9").as_real() == 2e9);
  CHECK(number("3j").as_complex() == std::complex<double>(0, 3));
  CHECK(number("99999999999999999999").is_big_integer());
}

TEST_CASE("Strings are decoded", "[lexer]") {
  CHECK(number(R"('a\tb\x41\u00e9')").as_text() == "a\tbA\xC3\xA9");
  CHECK(number(R"(r'a\tb')").as_text() == R"(a\tb)");
  CHECK(number("'''a\nb'''").as_text() == "a\nb");
  CHECK(number("'a\\\nb'").as_text() == "ab");
}

TEST_CASE("Each broken token is reported once and stands for an operand", "[lexer]") {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"x = 'abc\n", "unterminated-string"}, {"x = '''abc\n\n", "unterminated-string"},
      {"x = 1abc\n", "invalid-number"},      {"x = 012\n", "invalid-number"},
      {"x = $\n", "unexpected-character"},   {"x = b'a'\n", "not-supported"},
      {"x = '\\xZZ'\n", "invalid-escape"},   {"if 1:\n    a\n  b\n", "bad-indentation"},
  };
  for (const auto& [text, code] : cases) {
    INFO(text);
    const Lexed lexed(text);
    REQUIRE(lexed.diagnostics.items().size() == 1);
    CHECK(lexed.diagnostics.items()[0].code == code);
  }
}
