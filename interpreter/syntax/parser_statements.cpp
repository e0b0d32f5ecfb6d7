// Statements: simple ones on a line, compound ones with their blocks.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "interpreter/syntax/lost_names.hpp"
#include "interpreter/syntax/parser.hpp"

namespace comma::interpreter {

namespace {

struct Unsupported {
  std::string_view word, message, hint;
};

constexpr std::array unsupported = {
    Unsupported{"class", "classes cannot be defined in a command file", "use functions, tuples and dicts"},
    Unsupported{"async", "'async' is not part of the command language", "a command file runs from top to bottom"},
    Unsupported{"await", "'await' is not part of the command language", "a command file runs from top to bottom"},
    Unsupported{"yield", "generators ('yield') are not part of the command language", "append to a list and return it"},
    Unsupported{"@", "decorators are not part of the command language", "call the function where it is needed"},
};

bool is_compound(const Token& token) {
  return token.kind == TokenKind::keyword && (token.text == "if" || token.text == "while" || token.text == "for" ||
                                              token.text == "def" || token.text == "try" || token.text == "with");
}

}  // namespace

/// Statements up to the end of the block (or of the file). Each broken one is reported and left out.
void Parser::parse_statements(Block& block) {
  const bool around = flawed_;
  while (now_.kind != TokenKind::end && now_.kind != TokenKind::dedent && errors_ < most_errors) {
    const Token start = now_;
    const auto checkpoint = scopes_->checkpoint();
    const std::size_t sound = block.size();
    const int nesting = nesting_;
    const int blocks = blocks_;
    const int loops = loops_;
    flawed_ = false;
    try {
      parse_line(block);
      if (flawed_) leave_out(start, block, sound, checkpoint);
    } catch (Failure& failure) {
      nesting_ = nesting;
      blocks_ = blocks;
      loops_ = loops;
      scopes_->roll_back(checkpoint);
      const bool header = is_compound(start) || (start.kind == TokenKind::keyword && start.text == "else");
      recover(std::move(failure), start);
      if (header || now_.kind == TokenKind::indent) skip_orphan_blocks();
      leave_out(start, block, sound, checkpoint);
    }
  }
  flawed_ = around;
}

/// Puts a broken statement in the place of all that was read since `start`: what it would have bound is unknown, not
/// missing, and its uses are no mistakes of their own.
void Parser::leave_out(const Token& start, Block& block, std::size_t sound, ScopeStack::Checkpoint checkpoint) {
  scopes_->roll_back(checkpoint);
  block.erase(block.begin() + static_cast<std::ptrdiff_t>(sound), block.end());
  const std::uint32_t end = std::max(now_.begin, start.end);
  auto statement = std::make_unique<BrokenStatement>(StatementKind::broken, start.begin, end);
  const LostNames lost = lost_names(file_, start.begin, end, start.column);
  for (const Span& place : lost.names) {
    const std::string_view word = file_->text().substr(place.begin, place.end - place.begin);
    auto name = std::make_unique<NameNode>(std::string(word), place.begin, place.end);
    scopes_->use(name.get());
    scopes_->bind(*name);
    statement->names.push_back(std::move(name));
  }
  statement->loses_any_name = lost.any;
  block.push_back(std::move(statement));
}

/// The rest of the file is not read: nobody knows what it binds.
void Parser::leave_out_rest(Block& block) const {
  const auto end = static_cast<std::uint32_t>(file_->text().size());
  auto statement = std::make_unique<BrokenStatement>(StatementKind::broken, now_.begin, end);
  statement->loses_any_name = true;
  block.push_back(std::move(statement));
}

void Parser::parse_line(Block& block) {
  if (now_.kind == TokenKind::newline) return advance();
  if (now_.kind == TokenKind::indent) return parse_unexpected_block(block);
  refuse_unsupported();
  if (is_compound(now_)) {
    block.push_back(parse_compound());
    return;
  }
  parse_simple_line(block);
}

void Parser::parse_unexpected_block(Block& block) {
  if (!now_.flawed) {
    report_mended("unexpected-indent", "this line is indented without need", {file_, now_.end, now_.end + 1},
                  "begin it in the column of the line before");
  }
  advance();
  if (++blocks_ > deepest_block) fail("too-deep", "blocks are nested too deeply", span_of(now_), "use functions");
  parse_statements(block);
  --blocks_;
  if (now_.kind == TokenKind::dedent) advance();
}

void Parser::parse_simple_line(Block& block) {
  while (true) {
    if (auto statement = parse_simple()) block.push_back(std::move(statement));
    if (!accept(";")) break;
    if (now_.kind == TokenKind::newline) break;
  }
  if (now_.kind == TokenKind::newline) return advance();
  if (now_.kind == TokenKind::end || now_.kind == TokenKind::dedent) return;
  if (at("=")) fail("invalid-target", "nothing can be assigned to this", span_of(now_), "write '==' to compare");
  fail_here("the end of the line");
}

StatementPtr Parser::parse_compound() {
  if (at("if")) return parse_if();
  if (at("while")) return parse_while();
  if (at("for")) return parse_for();
  if (at("def")) return parse_function();
  if (at("with")) return parse_with();
  return parse_try();
}

StatementPtr Parser::parse_simple() {
  if (at("pass")) {
    auto statement = std::make_unique<PlainStatement>(StatementKind::pass, now_.begin, now_.end);
    advance();
    return statement;
  }
  if (at("break") || at("continue")) return parse_loop_exit();
  if (at("return")) return parse_return();
  if (at("raise")) return parse_raise();
  if (at("assert")) return parse_assert();
  if (at("del")) return parse_del();
  if (at("global") || at("nonlocal")) return parse_scope_declaration();
  if (at("import")) return parse_import();
  if (at("from")) return parse_import_from();
  refuse_unsupported();
  if (now_.kind == TokenKind::keyword && is_compound(now_)) fail_here("a simple statement");
  return parse_expression_statement();
}

/// Constructs that Python has and a command file may not use, by their name.
void Parser::refuse_unsupported() {
  for (const Unsupported& row : unsupported) {
    if (!at(row.word)) continue;
    fail("not-supported", std::string(row.message), span_of(now_), std::string(row.hint));
  }
  if (now_.kind != TokenKind::name) return;
  const bool operand_follows = (now_.text == "match" || now_.text == "print" || now_.text == "exec") &&
                               (ahead().kind == TokenKind::name || ahead().kind == TokenKind::text ||
                                ahead().kind == TokenKind::number || ahead().kind == TokenKind::formatted_text);
  if (!operand_follows) return;
  if (now_.text == "match") {
    fail("not-supported", "'match' is not part of the command language", span_of(now_), "use if / elif / else");
  }
  fail("syntax", fmt::format("{} is a function", now_.text), span_of(now_), fmt::format("write {}(...)", now_.text));
}

/// The statements under a header; a simple statement may also stand on the header's own line.
Block Parser::parse_block(std::string_view after, std::uint32_t header_begin) {
  Block block;
  if (now_.kind != TokenKind::newline) {
    parse_simple_line(block);
    return block;
  }
  advance();
  if (now_.kind != TokenKind::indent) {
    report("missing-block", fmt::format("an indented block is missing after {}", after),
           {file_, header_begin, previous_end_}, "indent the lines that belong to it, or write 'pass'");
    orphan_ = true;  // the lines that belong into the block may follow outside of it
    return block;
  }
  if (++blocks_ > deepest_block) fail("too-deep", "blocks are nested too deeply", span_of(now_), "use functions");
  advance();
  parse_statements(block);
  if (now_.kind == TokenKind::dedent) advance();
  --blocks_;
  return block;
}

StatementPtr Parser::parse_if() {
  const std::uint32_t begin = now_.begin;
  auto statement = std::make_unique<IfStatement>(StatementKind::if_, begin, now_.end);
  do {
    const std::uint32_t header = now_.begin;
    const std::string word(now_.text);
    advance();
    NodePtr condition = parse_expression();
    expect_colon("the condition");
    Block block = parse_block(fmt::format("'{}'", word), header);
    statement->branches.emplace_back(std::move(condition), std::move(block));
  } while (at("elif"));
  if (at("else")) {
    const std::uint32_t header = now_.begin;
    advance();
    if (at("if")) fail("syntax", "'else if' is written in one word", span_of(now_), "write 'elif'");
    expect_colon("'else'");
    statement->otherwise = parse_block("'else'", header);
  }
  statement->end = previous_end_;
  return statement;
}

/// What follows the header of a `while` or a `for`.
template <class Loop>
void Parser::parse_loop_blocks(Loop& statement, std::string_view word) {
  ++loops_;
  statement.body = parse_block(word, statement.begin);
  --loops_;
  if (at("else")) {
    const std::uint32_t header = now_.begin;
    advance();
    expect_colon("'else'");
    statement.otherwise = parse_block("'else'", header);
  }
  statement.end = previous_end_;
}

StatementPtr Parser::parse_while() {
  auto statement = std::make_unique<WhileStatement>(StatementKind::while_, now_.begin, now_.end);
  advance();
  statement->condition = parse_expression();
  expect_colon("the condition");
  parse_loop_blocks(*statement, "'while'");
  return statement;
}

StatementPtr Parser::parse_for() {
  auto statement = std::make_unique<ForStatement>(StatementKind::for_, now_.begin, now_.end);
  advance();
  statement->target = parse_target_list("in");
  if (!accept("in")) fail_here("'in'");
  statement->iterable = parse_expression_list();
  expect_colon("what 'for' runs over");
  parse_loop_blocks(*statement, "'for'");
  return statement;
}

StatementPtr Parser::parse_try() {
  auto statement = std::make_unique<TryStatement>(StatementKind::try_, now_.begin, now_.end);
  const Span header = span_of(now_);
  advance();
  expect_colon("'try'");
  statement->body = parse_block("'try'", statement->begin);
  while (at("except")) {
    const Span place = span_of(now_);
    const bool caught_all = !statement->handlers.empty() && statement->handlers.back().type == nullptr;
    if (caught_all)
      report("syntax", "an 'except' follows the one that catches everything", place, "put the bare 'except:' last");
    statement->handlers.push_back(parse_handler());
  }
  const auto parse_part = [&](std::string_view word, Block& block) {
    if (!at(word)) return false;
    const std::uint32_t begin = now_.begin;
    advance();
    expect_colon(fmt::format("'{}'", word));
    block = parse_block(fmt::format("'{}'", word), begin);
    return true;
  };
  if (!statement->handlers.empty()) parse_part("else", statement->otherwise);
  const bool has_finally = parse_part("finally", statement->finally);
  if (!has_finally && statement->handlers.empty()) {
    report("syntax", "'try' has neither 'except' nor 'finally'", header, "say what to catch: except CA.AsterError:");
  }
  statement->end = previous_end_;
  return statement;
}

StatementPtr Parser::parse_with() {
  auto statement = std::make_unique<WithStatement>(StatementKind::with_, now_.begin, now_.end);
  advance();
  statement->manager = parse_expression();
  if (accept("as")) {
    if (now_.kind != TokenKind::name) fail_here("a name");
    statement->target = parse_name();
    bind_target(*statement->target);
  }
  if (at(",")) fail("not-supported", "'with' takes one object", span_of(now_), "put one 'with' into the other");
  expect_colon("'with'");
  statement->body = parse_block("'with'", statement->begin);
  statement->end = previous_end_;
  return statement;
}

TryStatement::Handler Parser::parse_handler() {
  TryStatement::Handler handler;
  const std::uint32_t begin = now_.begin;
  advance();
  if (!at(":") && now_.kind != TokenKind::newline) {
    handler.type = parse_expression();
    if (at(","))
      fail("syntax", "the name of the exception stands after 'as'", span_of(now_), "write 'except TYPE as NAME:'");
    if (accept("as")) {
      if (now_.kind != TokenKind::name) fail_here("a name");
      handler.name = parse_name();
      bind_target(*handler.name);
    }
  }
  expect_colon("'except'");
  handler.body = parse_block("'except'", begin);
  return handler;
}

/// The block around it may be what is broken; then it is left out without a word.
void Parser::report_misplaced(std::string message, std::string hint) {
  flawed_ = true;
  if (!orphan_) report("misplaced-statement", std::move(message), span_of(now_), std::move(hint));
}

StatementPtr Parser::parse_return() {
  auto statement = std::make_unique<ValueStatement>(StatementKind::return_, now_.begin, now_.end);
  if (!scopes_->in_function()) {
    report_misplaced("'return' stands outside a function", "remove it, or put it into a 'def'");
  }
  advance();
  if (now_.kind != TokenKind::newline && now_.kind != TokenKind::end && !at(";"))
    statement->value = parse_expression_list();
  statement->end = previous_end_;
  return statement;
}

StatementPtr Parser::parse_raise() {
  auto statement = std::make_unique<RaiseStatement>(StatementKind::raise, now_.begin, now_.end);
  advance();
  if (now_.kind != TokenKind::newline && now_.kind != TokenKind::end && !at(";")) {
    statement->error = parse_expression();
    if (accept("from")) statement->cause = parse_expression();
  }
  statement->end = previous_end_;
  return statement;
}

StatementPtr Parser::parse_assert() {
  auto statement = std::make_unique<AssertStatement>(StatementKind::assert_, now_.begin, now_.end);
  advance();
  statement->condition = parse_expression();
  if (accept(",")) statement->message = parse_expression();
  statement->end = previous_end_;
  return statement;
}

StatementPtr Parser::parse_loop_exit() {
  const bool leaves = at("break");
  if (loops_ == 0) {
    report_misplaced(fmt::format("'{}' stands outside a loop", now_.text), "it belongs into a 'for' or a 'while'");
  }
  auto statement =
      std::make_unique<PlainStatement>(leaves ? StatementKind::break_ : StatementKind::continue_, now_.begin, now_.end);
  advance();
  return statement;
}

StatementPtr Parser::parse_del() {
  auto statement = std::make_unique<ValueStatement>(StatementKind::del, now_.begin, now_.end);
  advance();
  statement->value = parse_expression_list();
  bind_target(*statement->value);
  statement->end = previous_end_;
  return statement;
}

StatementPtr Parser::parse_expression_statement() {
  const std::uint32_t begin = now_.begin;
  NodePtr first = parse_expression_list();
  if (at("=")) return parse_assignment(std::move(first));
  if (at(":")) return parse_annotated(std::move(first));
  static constexpr std::array<std::pair<std::string_view, Operator>, 13> augmented = {
      {{"+=", Operator::add},
       {"-=", Operator::subtract},
       {"*=", Operator::multiply},
       {"/=", Operator::divide},
       {"//=", Operator::floor_divide},
       {"%=", Operator::modulo},
       {"**=", Operator::power},
       {"<<=", Operator::left_shift},
       {">>=", Operator::right_shift},
       {"&=", Operator::bit_and},
       {"|=", Operator::bit_or},
       {"^=", Operator::bit_xor},
       {"@=", Operator::matrix_multiply}}};
  for (const auto& [symbol, op] : augmented) {
    if (!at(symbol)) continue;
    auto statement = std::make_unique<AugmentedStatement>(StatementKind::augmented, begin, now_.end);
    if (first->kind != NodeKind::name && first->kind != NodeKind::subscript && first->kind != NodeKind::attribute) {
      fail("invalid-target", fmt::format("'{}' needs one variable on its left", symbol), span_of(*first),
           "write it out: a = a + b");
    }
    bind_target(*first);
    advance();
    statement->op = op;
    statement->target = std::move(first);
    statement->value = parse_expression_list();
    statement->end = previous_end_;
    return statement;
  }
  if (at(":="))
    fail("not-supported", "':=' is not part of the command language", span_of(now_), "assign on a line of its own");
  auto statement = std::make_unique<ValueStatement>(StatementKind::expression, begin, previous_end_);
  statement->value = std::move(first);
  return statement;
}

StatementPtr Parser::parse_assignment(NodePtr first) {
  auto statement = std::make_unique<AssignStatement>(StatementKind::assign, first->begin, previous_end_);
  NodePtr value = std::move(first);
  while (accept("=")) {
    bind_target(*value);
    statement->targets.push_back(std::move(value));
    value = parse_expression_list();
  }
  statement->value = std::move(value);
  statement->end = previous_end_;
  return statement;
}

/// name: type = value. The type is a comment to the reader and is not evaluated.
StatementPtr Parser::parse_annotated(NodePtr target) {
  if (target->kind != NodeKind::name && target->kind != NodeKind::subscript && target->kind != NodeKind::attribute) {
    fail_here("the end of the line");
  }
  auto statement = std::make_unique<AssignStatement>(StatementKind::assign, target->begin, previous_end_);
  bind_target(*target);
  advance();
  skip_annotation();
  statement->targets.push_back(std::move(target));
  if (accept("=")) statement->value = parse_expression_list();
  statement->end = previous_end_;
  return statement;
}

}  // namespace comma::interpreter
