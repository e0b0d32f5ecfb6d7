// Tokens: what the lexer makes of characters and the parser makes a tree of.
#pragma once

#include <cstdint>
#include <string_view>

#include "interpreter/values/value.hpp"

namespace comma::interpreter {

enum class TokenKind {
  end,
  newline,  ///< end of a logical line
  indent,
  dedent,
  name,     ///< identifier
  keyword,  ///< reserved word
  number,
  text,            ///< a string literal, decoded into `value`
  formatted_text,  ///< an f-string; the parser reads its replacement fields
  symbol,          ///< operator or delimiter
  broken,          ///< already reported by the lexer; fits wherever an operand fits
};

struct Token {
  TokenKind kind = TokenKind::end;
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
  std::string_view text;  ///< as written
  Value value;            ///< of a number or a text
  bool starts_line = false;
  bool flawed = false;  ///< the lexer has reported something about it
  int column = 0;       ///< indentation of its line, tabs counted to multiples of 8
};

}  // namespace comma::interpreter
