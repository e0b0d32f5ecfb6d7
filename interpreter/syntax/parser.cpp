// Tokens, errors and recovery; the grammar itself is in the files parser_*.cpp.
#include "interpreter/syntax/parser.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <set>

namespace comma::interpreter {

namespace {

/// Words that begin a statement and nothing else, so that a line beginning with one ends what came before.
constexpr std::array statement_words = {"def",   "while",    "try",   "import", "return", "class",
                                        "with",  "del",      "raise", "assert", "global", "pass",
                                        "break", "continue", "elif",  "except", "finally"};

std::size_t skip_word(std::string_view text, std::size_t at) {
  while (at < text.size() && (std::isalnum(static_cast<unsigned char>(text[at])) != 0 || text[at] == '_')) ++at;
  return at;
}

std::size_t skip_blanks(std::string_view text, std::size_t at) {
  while (at < text.size() && (text[at] == ' ' || text[at] == '\t')) ++at;
  return at;
}

/// NAME = OTHER( with OTHER not _F: a keyword argument hardly ever looks like that.
bool looks_like_command(std::string_view text) {
  std::size_t at = skip_blanks(text, skip_word(text, 0));
  if (at + 1 >= text.size() || text[at] != '=' || text[at + 1] == '=') return false;
  const std::size_t callee = skip_blanks(text, at + 1);
  at = skip_word(text, callee);
  const std::string_view name = text.substr(callee, at - callee);
  at = skip_blanks(text, at);
  return !name.empty() && name != "_F" && at < text.size() && text[at] == '(';
}

/// Behind NAME, NAME[...] or NAME.NAME on one line.
std::size_t skip_target(std::string_view text) {
  std::size_t at = skip_word(text, 0);
  while (at < text.size() && (text[at] == '[' || text[at] == '.')) {
    const std::size_t end = text[at] == '.' ? skip_word(text, at + 1) : text.find_first_of("]\n", at);
    if (end == std::string_view::npos || text[end] == '\n') return at;
    at = text[at] == '.' ? end : end + 1;
  }
  return skip_blanks(text, at);
}

/// Behind such a target or NAME, NAME ...
std::size_t skip_targets(std::string_view text) {
  std::size_t at = skip_target(text);
  while (at < text.size() && text[at] == ',') {
    const std::size_t name = skip_blanks(text, at + 1);
    if (skip_word(text, name) == name) break;
    at = skip_blanks(text, skip_word(text, name));
  }
  return at;
}

bool is_compound_word(std::string_view word) { return word == "if" || word == "for" || word == "else"; }

/// Whether a line that begins with `for` or `if` is the head of a block, which ends with its colon or with a bracket
/// that goes on, and not a part of a comprehension.
bool ends_as_head(std::string_view text) {
  const std::string_view line = text.substr(0, text.find_first_of("\r\n#"));
  const std::size_t last = line.find_last_not_of(" \t");
  return last != std::string_view::npos && std::string_view(":([{").find(line[last]) != std::string_view::npos;
}

std::string_view closing_of(std::string_view opening) { return opening == "(" ? ")" : opening == "[" ? "]" : "}"; }

bool is_operand(const Token& token) {
  if (token.kind == TokenKind::keyword) {
    return token.text == "None" || token.text == "True" || token.text == "False" || token.text == "lambda" ||
           token.text == "not";
  }
  return token.kind == TokenKind::name || token.kind == TokenKind::number || token.kind == TokenKind::text ||
         token.kind == TokenKind::formatted_text;
}

}  // namespace

Parser::Parser(std::shared_ptr<const SourceFile> file, Diagnostics& diagnostics, bool inside_brackets)
    : file_(std::move(file)),
      diagnostics_(diagnostics),
      lexer_(file_, diagnostics, 0, static_cast<std::uint32_t>(file_->text().size()), inside_brackets),
      scopes_(std::make_shared<ScopeStack>()) {
  advance();
}

Parser::Parser(Parser& around, std::uint32_t begin, std::uint32_t end)
    : file_(around.file_),
      diagnostics_(around.diagnostics_),
      lexer_(file_, diagnostics_, begin, end, true),
      scopes_(around.scopes_),
      previous_end_(begin),
      nesting_(around.nesting_) {
  advance();
}

void Parser::advance() {
  if (now_.kind == TokenKind::symbol) {
    const char c = now_.text[0];
    if (now_.text.size() == 1 && (c == '(' || c == '[' || c == '{')) open_brackets_.push_back(now_);
    if ((c == ')' || c == ']' || c == '}') && !open_brackets_.empty()) open_brackets_.pop_back();
  }
  if (now_.kind == TokenKind::newline) {
    open_brackets_.clear();
    broken_ = false;
  }
  if (now_.end > previous_end_ && now_.kind != TokenKind::newline) previous_end_ = now_.end;
  const bool part_of_statement = now_.kind != TokenKind::indent && now_.kind != TokenKind::dedent;
  flawed_ = flawed_ || (now_.flawed && part_of_statement);
  if (ahead_) {
    now_ = std::move(*ahead_);
    ahead_.reset();
  } else {
    now_ = lex();
  }
  broken_ = broken_ || now_.kind == TokenKind::broken;
}

Token Parser::lex() {
  const std::size_t findings = diagnostics_.items().size();
  Token token = lexer_.next();
  token.flawed = token.flawed || diagnostics_.items().size() != findings;
  return token;
}

const Token& Parser::ahead() {
  if (!ahead_) ahead_ = lex();
  return *ahead_;
}

bool Parser::at(std::string_view word) const {
  return (now_.kind == TokenKind::symbol || now_.kind == TokenKind::keyword) && now_.text == word;
}

bool Parser::accept(std::string_view word) {
  if (!at(word)) return false;
  advance();
  return true;
}

Span Parser::span_of(const Token& token) const {
  if (token.kind == TokenKind::newline || token.kind == TokenKind::end || token.kind == TokenKind::dedent) {
    return {file_, previous_end_, previous_end_};
  }
  return {file_, token.begin, std::max(token.end, token.begin)};
}

void Parser::fail(std::string code, std::string message, Span span, std::string hint) {
  Diagnostic finding{Severity::error, std::move(code), std::move(message), std::move(hint), std::move(span)};
  throw Failure{std::move(finding), now_.begin};
}

/// An error after which the statement is read on for its other errors, and then left out.
void Parser::report(std::string code, std::string message, Span span, std::string hint) {
  flawed_ = true;
  report_mended(std::move(code), std::move(message), std::move(span), std::move(hint));
}

/// An error that leaves no doubt about what was meant: the statement counts as if it had been written so.
void Parser::report_mended(std::string code, std::string message, Span span, std::string hint) {
  if (broken_) return;
  ++errors_;
  diagnostics_.error(std::move(code), std::move(message), std::move(span), std::move(hint));
}

void Parser::fail_here(std::string expected) {
  // What the lexer could not read was reported there.
  if (now_.kind == TokenKind::broken) throw Failure{{}, now_.begin};
  if (now_.kind == TokenKind::newline) {
    const std::string_view before = file_->text().substr(0, previous_end_);
    const bool steps = before.ends_with("++") || before.ends_with("--");
    fail("syntax", "the line ends where " + expected + " is expected", span_of(now_),
         steps ? "write 'x += 1' or 'x -= 1'" : "");
  }
  if (now_.kind == TokenKind::end || now_.kind == TokenKind::dedent) {
    fail("syntax", "the text ends where " + expected + " is expected", span_of(now_));
  }
  if (now_.kind == TokenKind::indent) fail("unexpected-indent", "this line is indented without need", span_of(now_));
  if (now_.text == ")" || now_.text == "]" || now_.text == "}") {
    if (open_brackets_.empty()) {
      fail("unmatched-bracket", fmt::format("no bracket is open that '{}' could close", now_.text), span_of(now_),
           "remove it");
    }
  }
  std::string hint;
  if (now_.kind == TokenKind::keyword) hint = fmt::format("'{}' is a reserved word of the language", now_.text);
  if (now_.text == "&" || now_.text == "|") hint = "the logical operators are 'and' and 'or'";
  if (now_.text == "<>") hint = "different from is written !=";
  fail("syntax", fmt::format("'{}' stands where {} is expected", now_.text, expected), span_of(now_), std::move(hint));
}

void Parser::expect_closing(std::string_view bracket) {
  if (accept(bracket)) return;
  if (now_.kind == TokenKind::symbol && (now_.text == ")" || now_.text == "]" || now_.text == "}") &&
      !open_brackets_.empty()) {
    const Token& opening = open_brackets_.back();
    report("unmatched-bracket",
           fmt::format("'{}' does not close the '{}' of line {}", now_.text, opening.text,
                       file_->position(opening.begin).line),
           span_of(now_), fmt::format("write '{}'", bracket));
    advance();
    return;
  }
  fail_here(fmt::format("'{}'", bracket));
}

void Parser::expect_colon(std::string_view after) {
  if (accept(":")) return;
  if (at("=")) fail("syntax", "'=' assigns, it does not compare", span_of(now_), "write '=='");
  if (now_.kind != TokenKind::newline) fail_here(fmt::format("':' after {}", after));
  report_mended("missing-colon", fmt::format("':' is missing after {}", after), span_of(now_), "end the line with ':'");
}

/// After an item of a bracket: true when another one may follow. A missing comma is reported and taken as written.
bool Parser::separate_items(std::string_view closing) {
  if (accept(",")) return !at(closing);
  if (at(closing)) return false;
  if (is_operand(now_) && !starts_statement(now_)) {
    report("missing-comma", fmt::format("a comma is missing before {:.40}", now_.text), {file_, now_.begin, now_.end},
           "separate the items by ','");
    return true;
  }
  return false;
}

/// Whether a line inside brackets begins no further right than the statement that opened them.
bool Parser::starts_line_outside(const Token& token) const {
  if (!token.starts_line || open_brackets_.empty()) return false;
  const int line = file_->position(open_brackets_.front().begin).line;
  const std::string_view opening_line = file_->line(line);
  return token.column <= static_cast<int>(skip_blanks(opening_line, 0));
}

/// Whether a line inside brackets is rather the next statement, the brackets having been left open.
bool Parser::starts_statement(const Token& token) const {
  if (!starts_line_outside(token)) return false;
  const std::string_view rest = file_->text().substr(token.begin);
  if (token.kind == TokenKind::keyword) {
    const bool only_there =
        std::find(statement_words.begin(), statement_words.end(), token.text) != statement_words.end();
    return only_there || (is_compound_word(token.text) && ends_as_head(rest));
  }
  if (token.kind != TokenKind::name) return false;
  if (looks_like_command(rest)) return true;
  const std::size_t next = skip_targets(rest);
  const bool call_or_assignment = next < rest.size() && (rest[next] == '(' || rest[next] == '=');
  const char before = file_->text().substr(0, previous_end_).back();
  return call_or_assignment && std::string_view(",([{=+-*/%:").find(before) == std::string_view::npos;
}

/// Steps over the rest of a broken statement and reports it.
void Parser::recover(Failure failure, const Token& start) {
  std::optional<Token> left_open;
  if (!open_brackets_.empty()) left_open = open_brackets_.back();
  bool at_next_statement = false;
  const bool follows_from_broken = broken_;
  while (now_.kind != TokenKind::newline && now_.kind != TokenKind::end) {
    if (now_.kind == TokenKind::indent || now_.kind == TokenKind::dedent) break;
    const bool failed_here =
        now_.begin == failure.token_begin && now_.kind == TokenKind::name && starts_line_outside(now_);
    if (now_.begin > start.begin && (failed_here || starts_statement(now_))) {
      at_next_statement = true;
      break;
    }
    advance();
  }
  const bool never_closed =
      left_open && (at_next_statement || now_.kind == TokenKind::end) && now_.begin == failure.token_begin;
  if (never_closed) {
    failure.finding = {Severity::error, "unclosed-bracket", fmt::format("this '{}' is never closed", left_open->text),
                       fmt::format("add '{}'", closing_of(left_open->text)), span_of(*left_open)};
  }
  const bool is_news = !failure.finding.message.empty() && !follows_from_broken;
  if (is_news) {
    ++errors_;
    diagnostics_.add(std::move(failure.finding));
  }
  if (at_next_statement) {
    ahead_.reset();
    lexer_.restart_at(now_);
    now_ = Token();
    open_brackets_.clear();
    advance();
  } else if (now_.kind == TokenKind::newline) {
    advance();
  }
  open_brackets_.clear();
}

/// The block and the branches of a header that was broken: read for their own errors, then dropped.
void Parser::skip_orphan_blocks() {
  const bool was_orphan = orphan_;
  orphan_ = true;
  while (true) {
    if (now_.kind == TokenKind::indent) {
      advance();
      Block dropped;
      ++blocks_;
      if (blocks_ <= deepest_block) parse_statements(dropped);
      while (blocks_ > deepest_block && now_.kind != TokenKind::end) advance();
      --blocks_;
      if (now_.kind == TokenKind::dedent) advance();
    } else if (at("elif") || at("else") || at("except") || at("finally")) {
      while (now_.kind != TokenKind::newline && now_.kind != TokenKind::end) advance();
      if (now_.kind == TokenKind::newline) advance();
    } else {
      break;
    }
  }
  orphan_ = was_orphan;
}

void Parser::deepen(Node& node, const Node* child) {
  if (child == nullptr) return;
  node.depth = std::max(node.depth, child->depth + 1);
  if (node.depth > highest_tree) {
    fail("too-deep", "this expression has too many terms", {file_, node.begin, node.begin + 1},
         "build it in several statements");
  }
}

Block Parser::parse_file() {
  Block block;
  while (now_.kind != TokenKind::end) {
    parse_statements(block);
    if (errors_ >= most_errors) {
      diagnostics_.error("too-many-errors", fmt::format("{} errors: the rest of the file is not read", errors_),
                         span_of(now_));
      leave_out_rest(block);
      break;
    }
    // Only a dedent that the lexer made of a wrong indentation ends the statements before the file does.
    if (now_.kind != TokenKind::end) advance();
  }
  for (const auto& name : scopes_->unbound_outer()) {
    report("unknown-name", fmt::format("no function around this one has a variable {}", name.name),
           {file_, name.begin, name.end}, "use 'global' for a variable of the file");
  }
  return block;
}

NodePtr Parser::parse_only_expression() {
  try {
    NodePtr value = parse_expression_list();
    if (now_.kind != TokenKind::end) fail_here("the end of the expression");
    return value;
  } catch (Failure& failure) {
    if (!failure.finding.message.empty()) diagnostics_.add(std::move(failure.finding));
    return nullptr;
  }
}

namespace {

/// A quote that is missing turns texts into code and code into texts to the end of its line: whatever else is found
/// there follows from it.
void move_findings(Diagnostics& found, Diagnostics& told) {
  std::set<int> misread;
  const auto line_of = [](const Diagnostic& item) { return item.span.file->position(item.span.begin).line; };
  for (const Diagnostic& item : found.items()) {
    if (item.code == "unterminated-string") misread.insert(line_of(item));
  }
  for (const Diagnostic& item : found.items()) {
    if (item.code == "unterminated-string" || !misread.contains(line_of(item))) told.add(item);
  }
}

}  // namespace

Ast parse(const std::shared_ptr<const SourceFile>& file, Diagnostics& diagnostics) {
  Diagnostics findings;
  Parser parser(file, findings);
  Ast ast;
  ast.file = file;
  ast.statements = parser.parse_file();
  move_findings(findings, diagnostics);
  return ast;
}

NodePtr parse_expression(const std::shared_ptr<const SourceFile>& file, Diagnostics& diagnostics,
                         std::vector<std::string>* names) {
  Parser parser(file, diagnostics, true);
  NodePtr expression = parser.parse_only_expression();
  if (expression && names != nullptr) *names = parser.free_names();
  return expression;
}

}  // namespace comma::interpreter
