// String literals: where they end and what their escapes mean.
#include <fmt/format.h>

#include "interpreter/syntax/lexer.hpp"
#include "interpreter/syntax/utf8.hpp"

namespace comma::interpreter {

namespace {

bool has(std::string_view prefix, char letter) {
  for (char c : prefix) {
    if ((c | 0x20) == letter) return true;
  }
  return false;
}

int hex_value(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if ((c | 0x20) >= 'a' && (c | 0x20) <= 'f') return (c | 0x20) - 'a' + 10;
  return -1;
}

/// The code after \x, \u or \U: exactly `digits` hexadecimal digits, else -1.
std::int64_t hex_code(std::string_view digits_text, std::size_t digits) {
  if (digits_text.size() < digits) return -1;
  std::int64_t code = 0;
  for (std::size_t i = 0; i < digits; ++i) {
    const int value = hex_value(digits_text[i]);
    if (value < 0) return -1;
    code = code * 16 + value;
  }
  const bool surrogate = code >= 0xD800 && code < 0xE000;
  return code <= 0x10FFFF && !surrogate ? code : -1;
}

/// The character of a one-letter escape, or 0.
char plain_escape(char c) {
  switch (c) {
    case 'n':
      return '\n';
    case 't':
      return '\t';
    case 'r':
      return '\r';
    case 'a':
      return '\a';
    case 'b':
      return '\b';
    case 'f':
      return '\f';
    case 'v':
      return '\v';
    case '\\':
    case '\'':
    case '"':
      return c;
    default:
      return '\0';
  }
}

}  // namespace

Token Lexer::lex_text(std::uint32_t begin, std::string_view prefix) {
  const char quote = peek();
  const bool triple = peek(1) == quote && peek(2) == quote;
  const std::uint32_t quotes = triple ? 3 : 1;
  at_ += quotes;
  bool closed = false;
  while (at_ < end_) {
    const char c = text_[at_];
    if (c == '\\' && at_ + 1 < end_) {
      at_ += peek(1) == '\r' && peek(2) == '\n' ? 3 : 2;
      continue;
    }
    if (!triple && (c == '\n' || c == '\r')) break;
    closed = c == quote && (!triple || (peek(1) == quote && peek(2) == quote));
    at_ += closed ? quotes : 1;
    if (closed) break;
  }
  if (!closed) {
    error("unterminated-string", triple ? "this string is never closed" : "this string is not closed on its line",
          begin, triple ? begin + static_cast<std::uint32_t>(prefix.size()) + quotes : at_,
          fmt::format("close it with {}", std::string(quotes, quote)));
    return make(TokenKind::broken, begin);
  }
  if (has(prefix, 'b')) {
    error("not-supported", "bytes (b'...') are not part of the command language", begin, at_, "leave out the b");
    return make(TokenKind::broken, begin);
  }
  Token token = make(has(prefix, 'f') ? TokenKind::formatted_text : TokenKind::text, begin);
  if (token.kind == TokenKind::formatted_text) return token;
  const TextLiteral literal = split_text_literal(token);
  token.value = literal.raw ? Value(std::string(literal.body))
                            : Value(decode_escapes(literal.body, file_, literal.body_begin, diagnostics_));
  return token;
}

TextLiteral split_text_literal(const Token& token) {
  const std::size_t open = token.text.find_first_of("'\"");
  const char quote = token.text[open];
  const bool triple = token.text.size() >= open + 6 && token.text[open + 1] == quote && token.text[open + 2] == quote;
  const std::size_t quotes = triple ? 3 : 1;
  TextLiteral literal;
  literal.raw = has(token.text.substr(0, open), 'r');
  literal.body = token.text.substr(open + quotes, token.text.size() - open - 2 * quotes);
  literal.body_begin = token.begin + static_cast<std::uint32_t>(open + quotes);
  return literal;
}

std::string decode_escapes(std::string_view body, const std::shared_ptr<const SourceFile>& file, std::uint32_t begin,
                           Diagnostics& diagnostics) {
  std::string out;
  out.reserve(body.size());
  for (std::size_t i = 0; i < body.size(); ++i) {
    if (body[i] == '\r') {  // a line break is one character, whatever the system that wrote the file
      out += '\n';
      if (i + 1 < body.size() && body[i + 1] == '\n') ++i;
      continue;
    }
    if (body[i] != '\\' || i + 1 == body.size()) {
      out += body[i];
      continue;
    }
    const std::size_t escape = i;
    const char c = body[++i];
    if (c == '\n' || c == '\r') {
      if (c == '\r' && i + 1 < body.size() && body[i + 1] == '\n') ++i;
    } else if (const char plain = plain_escape(c); plain != '\0') {
      out += plain;
    } else if (c >= '0' && c <= '7') {
      unsigned code = 0;
      std::size_t digits = 0;
      for (; digits < 3 && i < body.size() && body[i] >= '0' && body[i] <= '7'; ++digits, ++i)
        code = code * 8 + static_cast<unsigned>(body[i] - '0');
      --i;
      append_utf8(out, code);
    } else if (c == 'x' || c == 'u' || c == 'U') {
      const std::size_t digits = c == 'x' ? 2 : c == 'u' ? 4 : 8;
      const std::int64_t code = hex_code(body.substr(i + 1), digits);
      if (code >= 0) {
        append_utf8(out, static_cast<char32_t>(code));
        i += digits;
      } else {
        const auto where = begin + static_cast<std::uint32_t>(escape);
        diagnostics.error("invalid-escape", fmt::format("\\{} needs {} hexadecimal digits", c, digits),
                          {file, where, where + 2}, "write \\\\ for a backslash");
      }
    } else if (c == 'N' && i + 1 < body.size() && body[i + 1] == '{') {
      const auto where = begin + static_cast<std::uint32_t>(escape);
      diagnostics.error("not-supported", "characters by name (\\N{...}) are not part of the command language",
                        {file, where, where + 2}, "write the character itself");
    } else {
      out += '\\';
      out += c;
    }
  }
  return out;
}

}  // namespace comma::interpreter
