#include "interpreter/syntax/lexer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include "interpreter/syntax/utf8.hpp"
#include "interpreter/values/big_integer.hpp"

namespace comma::interpreter {

namespace {

constexpr std::array keywords = {
    "False",  "None",     "True", "and",    "as",   "assert",  "async",  "await",  "break", "class",  "continue", "def",
    "del",    "elif",     "else", "except", "for",  "finally", "from",   "global", "if",    "import", "in",       "is",
    "lambda", "nonlocal", "not",  "or",     "pass", "raise",   "return", "try",    "while", "with",   "yield"};

// Longest first, so that the first match is the right one.
constexpr std::array symbols = {
    "**=", "//=", ">>=", "<<=", "...", "!=", "<>", "**", "//", ">>", "<<", "<=", ">=", "==", "->", "+=",
    "-=",  "*=",  "/=",  "%=",  "&=",  "|=", "^=", "@=", ":=", "+",  "-",  "*",  "/",  "%",  "&",  "|",
    "^",   "~",   "<",   ">",   "(",   ")",  "[",  "]",  "{",  "}",  ",",  ":",  ".",  ";",  "@",  "="};

constexpr int tab_width = 8;
/// A number with more digits than this is a mistake; reading it would take quadratic time.
constexpr std::size_t longest_number = 5000;

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

/// Letters beyond ASCII may stand in names; punctuation, blanks and symbols may not.
bool is_letter(char32_t c) {
  return c >= 0xC0 && !(c >= 0x2000 && c < 0x2C00) && c != 0x3000 && c != 0xFEFF && c != 0xD7 && c != 0xF7;
}

bool is_text_prefix(std::string_view word) {
  if (word.size() > 2) return false;
  std::string low;
  for (char c : word) low += static_cast<char>(c | 0x20);
  return low == "r" || low == "u" || low == "b" || low == "f" || low == "br" || low == "rb" || low == "fr" ||
         low == "rf";
}

std::string hint_for(char32_t c) {
  switch (c) {
    case 0x2018:
    case 0x2019:
    case 0x201C:
    case 0x201D:
    case 0xAB:
    case 0xBB:
      return "strings stand in straight quotes: ' or \"";
    case 0xA0:
    case 0x202F:
    case 0x2007:
    case 0x3000:
      return "this is a no-break space: replace it by a plain space";
    case 0x2013:
    case 0x2014:
    case 0x2212:
      return "the minus sign is '-'";
    case 0xD7:
      return "the sign of multiplication is '*'";
    case '!':
      return "write 'not', or '!=' to compare";
    case '$':
    case '?':
    case '`':
      return "remove it";
    default:
      return {};
  }
}

}  // namespace

bool is_keyword(std::string_view word) { return std::find(keywords.begin(), keywords.end(), word) != keywords.end(); }

Lexer::Lexer(std::shared_ptr<const SourceFile> file, Diagnostics& diagnostics, std::uint32_t begin, std::uint32_t end,
             bool inside_brackets)
    : file_(std::move(file)),
      text_(file_->text()),
      diagnostics_(diagnostics),
      at_(begin),
      end_(end),
      piece_(inside_brackets) {
  line_start_ = !piece_;
  if (piece_) depth_ = 1;
}

void Lexer::error(const char* code, std::string message, std::uint32_t begin, std::uint32_t end, std::string hint) {
  diagnostics_.error(code, std::move(message), {file_, begin, end}, std::move(hint));
}

Token Lexer::make(TokenKind kind, std::uint32_t begin) const {
  Token token;
  token.kind = kind;
  token.begin = begin;
  token.end = at_;
  token.text = text_.substr(begin, at_ - begin);
  token.column = column_;
  return token;
}

void Lexer::restart_at(const Token& first_of_line) {
  at_ = first_of_line.begin;
  while (at_ > 0 && text_[at_ - 1] != '\n' && text_[at_ - 1] != '\r') --at_;
  depth_ = 0;
  line_start_ = true;
  anything_on_line_ = false;
}

int Lexer::measure_indentation() {
  int column = 0;
  for (; at_ < end_; ++at_) {
    if (text_[at_] == ' ')
      ++column;
    else if (text_[at_] == '\t')
      column = (column / tab_width + 1) * tab_width;
    else if (text_[at_] == '\f')
      column = 0;
    else
      break;
  }
  return column;
}

/// A line between two levels belongs to the inner block (indented by `inner`) if that goes on behind it, else to a
/// block of its own in the outer one.
void Lexer::fit_indentation(int column, int inner) {
  error("bad-indentation", "this line is indented less than its block but more than the one around it", at_, at_ + 1,
        fmt::format("indent it by {} or by {} blanks", indents_.back(), inner));
  if (column_of_next_statement() >= inner) {
    indents_.push_back(inner);
    --pending_dedents_;
  } else {
    indents_.push_back(column);
    pending_indent_ = true;
  }
}

int Lexer::column_of_next_statement() const {
  Diagnostics told_later;
  Lexer rest(file_, told_later, at_, end_);
  Token token = rest.next();
  while (token.kind != TokenKind::newline && token.kind != TokenKind::end) token = rest.next();
  return rest.next().column;
}

// Blank lines and comments have no indentation; any other line may open or close blocks.
Token Lexer::lex_line_start() {
  while (true) {
    const int column = measure_indentation();
    const char c = peek();
    if (c == '#') {
      while (at_ < end_ && text_[at_] != '\n' && text_[at_] != '\r') ++at_;
    }
    if (at_ < end_ && (text_[at_] == '\n' || text_[at_] == '\r')) {
      ++at_;
      continue;
    }
    line_start_ = false;
    first_token_ = true;
    const int effective = at_ >= end_ ? 0 : column;
    column_ = effective;
    if (effective > indents_.back()) {
      indents_.push_back(effective);
      return make(TokenKind::indent, at_);
    }
    const std::vector<int> before = indents_;
    while (effective < indents_.back()) {
      indents_.pop_back();
      ++pending_dedents_;
    }
    if (effective != indents_.back()) fit_indentation(effective, before[indents_.size()]);
    if (pending_dedents_ > 0) {
      --pending_dedents_;
      return make(TokenKind::dedent, at_);
    }
    return next();
  }
}

std::optional<Token> Lexer::lex_line_end() {
  const std::uint32_t begin = at_;
  at_ += peek() == '\r' && peek(1) == '\n' ? 2 : 1;
  if (depth_ > 0) {
    measure_indentation();
    std::uint32_t start = at_;
    while (start > 0 && text_[start - 1] != '\n' && text_[start - 1] != '\r') --start;
    at_ = start;
    column_ = measure_indentation();
    first_token_ = true;
    return std::nullopt;
  }
  line_start_ = true;
  if (!anything_on_line_) return std::nullopt;
  anything_on_line_ = false;
  return make(TokenKind::newline, begin);
}

/// Steps over blanks, comments, joined lines; gives the newline token if one ends here.
std::optional<Token> Lexer::skip_blanks() {
  while (at_ < end_) {
    const char c = text_[at_];
    if (c == ' ' || c == '\t' || c == '\f') {
      ++at_;
    } else if (c == '#') {
      while (at_ < end_ && text_[at_] != '\n' && text_[at_] != '\r') ++at_;
    } else if (c == '\\' && (peek(1) == '\n' || peek(1) == '\r')) {
      at_ += peek(1) == '\r' && peek(2) == '\n' ? 3 : 2;
    } else if (c == '\n' || c == '\r') {
      if (auto token = lex_line_end()) return token;
      if (line_start_) return std::nullopt;
    } else {
      break;
    }
  }
  return std::nullopt;
}

Token Lexer::next() {
  if (pending_dedents_ > 0) {
    --pending_dedents_;
    return make(TokenKind::dedent, at_);
  }
  if (std::exchange(pending_indent_, false)) {
    Token token = make(TokenKind::indent, at_);
    token.flawed = true;
    return token;
  }
  if (line_start_) return lex_line_start();
  if (auto newline = skip_blanks()) return *newline;
  if (line_start_) return lex_line_start();
  if (at_ >= end_) {
    if (anything_on_line_ && !piece_ && depth_ == 0) {
      anything_on_line_ = false;
      line_start_ = true;
      return make(TokenKind::newline, at_);
    }
    if (!piece_ && indents_.size() > 1 && depth_ == 0) {
      indents_.pop_back();
      return make(TokenKind::dedent, at_);
    }
    return make(TokenKind::end, at_);
  }
  const bool starts_line = first_token_;
  first_token_ = false;
  anything_on_line_ = true;
  const char c = peek();
  Token token;
  std::size_t length = 1;
  if (is_letter(c) || (static_cast<unsigned char>(c) >= 0x80 && is_letter(code_point_at(text_, at_, length))))
    token = lex_name();
  else if (is_digit(c) || (c == '.' && is_digit(peek(1))))
    token = lex_number();
  else if (c == '"' || c == '\'')
    token = lex_text(at_, {});
  else
    token = lex_symbol();
  token.starts_line = starts_line;
  return token;
}

Token Lexer::lex_name() {
  const std::uint32_t begin = at_;
  while (at_ < end_) {
    const char c = text_[at_];
    std::size_t length = 1;
    const bool beyond_ascii = static_cast<unsigned char>(c) >= 0x80;
    if (beyond_ascii ? !is_letter(code_point_at(text_, at_, length)) : !(is_letter(c) || is_digit(c))) break;
    at_ += static_cast<std::uint32_t>(length);
  }
  const std::string_view word = text_.substr(begin, at_ - begin);
  if ((peek() == '"' || peek() == '\'') && is_text_prefix(word)) return lex_text(begin, word);
  return make(is_keyword(word) ? TokenKind::keyword : TokenKind::name, begin);
}

Value Lexer::number_value(std::string_view digits, std::uint32_t begin) {
  std::string plain;
  std::copy_if(digits.begin(), digits.end(), std::back_inserter(plain), [](char c) { return c != '_'; });
  const bool imaginary = plain.back() == 'j' || plain.back() == 'J';
  if (imaginary) plain.pop_back();
  const char radix = plain.size() > 1 && plain[0] == '0' ? static_cast<char>(plain[1] | 0x20) : '\0';
  if (radix == 'x' || radix == 'o' || radix == 'b') {
    const auto value = BigInteger::parse(std::string_view(plain).substr(2), radix == 'x' ? 16 : radix == 'o' ? 8 : 2);
    if (value) return Value::integer(*value);
    error("invalid-number", fmt::format("{} is not a number", digits), begin, at_);
    return Value::unknown();
  }
  const bool real = plain.find_first_of(".eE") != std::string::npos;
  if (real || imaginary) {
    double value = 0.0;
    const auto result = std::from_chars(plain.data(), plain.data() + plain.size(), value);
    // Out of range: Python gives inf for the large and 0.0 for the small.
    if (result.ec == std::errc::result_out_of_range) value = std::strtod(plain.c_str(), nullptr);
    return imaginary ? Value(std::complex<double>(0.0, value)) : Value(value);
  }
  if (plain.size() > 1 && plain[0] == '0' && plain.find_first_not_of('0') != std::string::npos) {
    error("invalid-number", "an integer does not begin with 0", begin, at_,
          fmt::format("write {}, or 0o{} if it is octal", plain.substr(plain.find_first_not_of('0')), plain.substr(1)));
    return Value::unknown();
  }
  return Value::integer(*BigInteger::parse(plain, 10));
}

Token Lexer::lex_number() {
  const std::uint32_t begin = at_;
  const auto skip_digits = [&](auto accept) {
    while (accept(peek()) || (peek() == '_' && accept(peek(1)))) ++at_;
  };
  const char radix = peek() == '0' ? static_cast<char>(peek(1) | 0x20) : '\0';
  if (radix == 'x' || radix == 'o' || radix == 'b') {
    at_ += 2;
    skip_digits([](char c) { return is_digit(c) || ((c | 0x20) >= 'a' && (c | 0x20) <= 'f'); });
  } else {
    skip_digits(is_digit);
    if (peek() == '.') {
      ++at_;
      if (is_digit(peek())) skip_digits(is_digit);
    }
    const char sign = peek(1);
    if ((peek() | 0x20) == 'e' && (is_digit(sign) || ((sign == '+' || sign == '-') && is_digit(peek(2))))) {
      at_ += is_digit(sign) ? 1 : 2;
      skip_digits(is_digit);
    }
    if ((peek() | 0x20) == 'j') ++at_;
  }
  const std::uint32_t number_end = at_;
  while (is_letter(peek()) || is_digit(peek())) ++at_;
  const std::string_view tail = text_.substr(number_end, at_ - number_end);
  if (is_keyword(tail)) at_ = number_end;  // 1if x else 2
  Token token = make(TokenKind::number, begin);
  if (at_ != number_end || token.text.size() > longest_number) {
    error("invalid-number", fmt::format("{:.40} is not a number", token.text), begin, at_,
          is_digit(text_[begin]) && (tail == "d" || tail == "D" || (tail.size() > 1 && (tail[0] | 0x20) == 'd'))
              ? "the exponent is written with e: 1.0e-3"
              : "a name begins with a letter, a number has only digits");
    token.kind = TokenKind::broken;
    return token;
  }
  token.value = number_value(token.text, begin);
  return token;
}

Token Lexer::lex_symbol() {
  const std::uint32_t begin = at_;
  const std::string_view rest = text_.substr(at_, std::min<std::uint32_t>(end_ - at_, 3));
  const auto match =
      std::find_if(symbols.begin(), symbols.end(), [&](std::string_view s) { return rest.starts_with(s); });
  if (match == symbols.end()) return lex_strange_character();
  const std::string_view symbol = *match;
  at_ += static_cast<std::uint32_t>(symbol.size());
  if (symbol == "(" || symbol == "[" || symbol == "{") ++depth_;
  if ((symbol == ")" || symbol == "]" || symbol == "}") && depth_ > (piece_ ? 1 : 0)) --depth_;
  return make(TokenKind::symbol, begin);
}

Token Lexer::lex_strange_character() {
  const std::uint32_t begin = at_;
  std::size_t length = 1;
  const char32_t character = code_point_at(text_, at_, length);
  at_ += static_cast<std::uint32_t>(length);
  const std::uint32_t character_end = at_;
  if (character == 0x2018 || character == 0x201C || character == 0xAB) skip_typographic_text(character);
  std::string shown;
  if (character < 0x20)
    shown = fmt::format("\\x{:02x}", static_cast<unsigned>(character));
  else
    append_utf8(shown, character);
  error("unexpected-character",
        fmt::format("the character {} (U+{:04X}) has no meaning here", shown, static_cast<unsigned>(character)), begin,
        character_end, hint_for(character));
  return make(TokenKind::broken, begin);
}

/// To the quote that closes a typographic one, if it is on the line: its text is no code.
void Lexer::skip_typographic_text(char32_t opening) {
  const char32_t closing = opening == 0xAB ? 0xBB : opening + 1;
  std::size_t length = 1;
  for (std::uint32_t i = at_; i < end_ && text_[i] != '\n' && text_[i] != '\r';
       i += static_cast<std::uint32_t>(length)) {
    if (code_point_at(text_, i, length) != closing) continue;
    at_ = i + static_cast<std::uint32_t>(length);
    return;
  }
}

}  // namespace comma::interpreter
