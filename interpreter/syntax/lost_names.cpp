#include "interpreter/syntax/lost_names.hpp"

#include <algorithm>
#include <array>

#include "interpreter/diagnostic.hpp"
#include "interpreter/syntax/lexer.hpp"

namespace comma::interpreter {

namespace {

constexpr std::array augmented = {
    "=", "+=", "-=", "*=", "/=", "//=", "%=", "**=", "<<=", ">>=", "&=", "|=", "^=", "@="};

std::vector<Token> tokens_of(const std::shared_ptr<const SourceFile>& file, std::uint32_t begin, std::uint32_t end) {
  Diagnostics told_before;
  Lexer lexer(file, told_before, begin, end, true);
  std::vector<Token> tokens;
  for (Token token = lexer.next(); token.kind != TokenKind::end; token = lexer.next())
    tokens.push_back(std::move(token));
  return tokens;
}

class Search {
 public:
  Search(std::shared_ptr<const SourceFile> file, std::uint32_t begin, std::uint32_t end, int column)
      : file_(std::move(file)), tokens_(tokens_of(file_, begin, end)), column_(column) {
    if (!tokens_.empty()) tokens_.front().column = column;
  }

  LostNames run() {
    for (std::size_t i = 0; i < tokens_.size(); ++i) {
      look_at(i);
      if (is(i, "(") || is(i, "[") || is(i, "{")) ++depth_;
      if ((is(i, ")") || is(i, "]") || is(i, "}")) && depth_ > 0) --depth_;
    }
    return std::move(lost_);
  }

 private:
  bool is(std::size_t i, std::string_view text) const { return i < tokens_.size() && tokens_[i].text == text; }
  bool is_name(std::size_t i) const { return i < tokens_.size() && tokens_[i].kind == TokenKind::name; }
  void lose(std::size_t i) {
    if (is_name(i)) lost_.names.push_back({file_, tokens_[i].begin, tokens_[i].end});
  }

  /// Whether a statement may begin here. Where brackets are open this is doubtful: the lines of a call's arguments
  /// follow
  /// '(' or ',', and lie further right.
  bool may_start_statement(std::size_t i) const {
    if (i == 0 || is(i - 1, ";") || is(i - 1, ":")) return true;
    if (!tokens_[i].starts_line) return false;
    return depth_ == 0 || tokens_[i].column <= column_ || !(is(i - 1, ",") || is(i - 1, "(")) || calls_a_command(i);
  }

  /// NAME = OTHER( with OTHER not _F.
  bool calls_a_command(std::size_t i) const {
    return is(i + 1, "=") && is_name(i + 2) && !is(i + 2, "_F") && is(i + 3, "(");
  }

  void look_at(std::size_t i) {
    if (is(i, "INCLUDE")) lost_.any = true;
    if (is(i, "reuse") && is(i + 1, "=")) lose(i + 2);
    if (is(i, "as")) lose(i + 1);
    if (!may_start_statement(i)) return;
    if (is_name(i)) lose_targets(i);
    if (is(i, "for")) lose_until(i + 1, "in");
    if (is(i, "def")) lose_until(i + 1, ":");
    if (is(i, "class")) lose(i + 1);
    if (is(i, "import") || is(i, "from")) lose_imports(i);
  }

  /// a, b = ..., a += ..., a[0] = ..., a.append(...)
  void lose_targets(std::size_t i) {
    if (is(i + 1, ".") || is(i + 1, "[")) return lose(i);
    std::size_t last = i;
    while (is_name(last) && is(last + 1, ",")) last += 2;
    const bool assigns =
        last + 1 < tokens_.size() && std::ranges::find(augmented, tokens_[last + 1].text) != augmented.end();
    if (!assigns) return;
    for (; i <= last; i += 2) lose(i);
    if (is(last + 1, "=") && is_name(last + 2) && is(last + 3, "=")) lose_targets(last + 2);
  }

  void lose_until(std::size_t i, std::string_view stop) {
    for (; i < tokens_.size() && !tokens_[i].starts_line && !is(i, stop); ++i) lose(i);
  }

  void lose_imports(std::size_t i) {
    while (i < tokens_.size() && !is(i, "import") &&
           !(i > 0 && tokens_[i].starts_line && depth_ == 0 && !is(i, "from")))
      ++i;
    for (++i; i < tokens_.size() && (!tokens_[i].starts_line || is(i - 1, "(") || is(i - 1, ",")); ++i) {
      if (is(i, "*")) lost_.any = true;
      lose(i);
    }
  }

  std::shared_ptr<const SourceFile> file_;
  std::vector<Token> tokens_;
  int column_;
  int depth_ = 0;
  LostNames lost_;
};

}  // namespace

LostNames lost_names(const std::shared_ptr<const SourceFile>& file, std::uint32_t begin, std::uint32_t end,
                     int column) {
  return Search(file, begin, end, column).run();
}

}  // namespace comma::interpreter
