// From characters to tokens: numbers, strings, operators, and the indentation that stands for brackets in Python.
// Every error is reported and stepped over, so that the parser always gets a whole stream.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "interpreter/diagnostic.hpp"
#include "interpreter/source.hpp"
#include "interpreter/syntax/token.hpp"

namespace comma::interpreter {

class Lexer {
 public:
  /// Reads [begin, end) of the file. `inside_brackets`: a piece of a line (the field of an f-string), where line breaks
  /// and indentation mean nothing.
  Lexer(std::shared_ptr<const SourceFile> file, Diagnostics& diagnostics, std::uint32_t begin, std::uint32_t end,
        bool inside_brackets = false);

  /// The next token; after the end, `end` for ever.
  Token next();

  /// Goes back to the start of a statement that brackets left open had hidden: they count as closed.
  void restart_at(const Token& first_of_line);

 private:
  Token lex_line_start();
  void fit_indentation(int column, int inner);
  int column_of_next_statement() const;
  Token make(TokenKind kind, std::uint32_t begin) const;
  Token lex_name();
  Token lex_number();
  Token lex_text(std::uint32_t begin, std::string_view prefix);
  Token lex_symbol();
  Token lex_strange_character();
  void skip_typographic_text(char32_t opening);
  std::optional<Token> lex_line_end();
  std::optional<Token> skip_blanks();
  int measure_indentation();
  Value number_value(std::string_view digits, std::uint32_t begin);
  void error(const char* code, std::string message, std::uint32_t begin, std::uint32_t end, std::string hint = {});
  char peek(std::uint32_t ahead = 0) const { return at_ + ahead < end_ ? text_[at_ + ahead] : '\0'; }

  std::shared_ptr<const SourceFile> file_;
  std::string_view text_;
  Diagnostics& diagnostics_;
  std::uint32_t at_;
  std::uint32_t end_;
  bool piece_;
  bool line_start_ = true;
  bool first_token_ = true;  ///< nothing but blanks so far on this physical line
  int depth_ = 0;
  int column_ = 0;
  int pending_dedents_ = 0;
  bool pending_indent_ = false;  ///< of a block that nothing opens, which has been reported
  bool anything_on_line_ = false;
  std::vector<int> indents_{0};
};

/// The text between the quotes (it begins at `begin` of the file) with its escapes replaced; bad ones are reported.
std::string decode_escapes(std::string_view body, const std::shared_ptr<const SourceFile>& file, std::uint32_t begin,
                           Diagnostics& diagnostics);

bool is_keyword(std::string_view word);

/// The parts of a string literal as written: prefix, quotes, body.
struct TextLiteral {
  std::string_view body;
  std::uint32_t body_begin = 0;
  bool raw = false;
};
TextLiteral split_text_literal(const Token& token);

}  // namespace comma::interpreter
