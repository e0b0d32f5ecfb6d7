// Atoms: names, constants, brackets, comprehensions, string literals.
#include <fmt/format.h>

#include <utility>

#include "interpreter/syntax/parser.hpp"

namespace comma::interpreter {

NodePtr Parser::parse_name() {
  auto name = std::make_unique<NameNode>(std::string(now_.text), now_.begin, now_.end);
  scopes_->use(name.get());
  advance();
  return name;
}

NodePtr Parser::parse_atom() {
  const std::uint32_t begin = now_.begin;
  switch (now_.kind) {
    case TokenKind::name:
      return parse_name();
    case TokenKind::text:
    case TokenKind::formatted_text:
      return parse_texts();
    case TokenKind::number: {
      auto node = std::make_unique<ConstantNode>(now_.value, begin, now_.end);
      advance();
      return node;
    }
    case TokenKind::broken: {
      auto node = std::make_unique<Node>(NodeKind::broken, begin, now_.end);
      advance();
      return node;
    }
    default:
      break;
  }
  if (at("(")) return parse_parenthesised();
  if (at("[")) return parse_list_display();
  if (at("{")) return parse_brace_display();
  if (at("None") || at("True") || at("False") || at("...")) {
    if (at("..."))
      fail("not-supported", "'...' is not part of the command language", span_of(now_), "write pass or None");
    auto node = std::make_unique<ConstantNode>(at("None") ? Value() : Value(at("True")), begin, now_.end);
    advance();
    return node;
  }
  if (at("yield") || at("await") || at("async")) refuse_unsupported();
  fail_here("an expression");
}

NodePtr Parser::parse_parenthesised() {
  const Nesting nesting(*this);
  const std::uint32_t begin = now_.begin;
  const std::size_t mark = scopes_->mark();
  advance();
  auto tuple = std::make_unique<SequenceNode>(NodeKind::tuple, begin, begin);
  if (!at(")")) {
    NodePtr first = parse_item();
    if (at("for")) {
      NodePtr generator =
          parse_comprehension(ComprehensionNode::Kind::generator, std::move(first), nullptr, mark, begin);
      expect_closing(")");
      generator->end = previous_end_;
      return generator;
    }
    if (at(":="))
      fail("not-supported", "':=' is not part of the command language", span_of(now_), "assign on a line of its own");
    if (at(")") && first->kind != NodeKind::starred) {
      advance();
      first->parenthesised = true;
      return first;
    }
    deepen(*tuple, first.get());
    tuple->items.push_back(std::move(first));
    while (separate_items(")")) {
      tuple->items.push_back(parse_item());
      deepen(*tuple, tuple->items.back().get());
    }
  }
  expect_closing(")");
  tuple->parenthesised = true;
  tuple->end = previous_end_;
  return tuple;
}

NodePtr Parser::parse_list_display() {
  const Nesting nesting(*this);
  const std::uint32_t begin = now_.begin;
  const std::size_t mark = scopes_->mark();
  advance();
  auto list = std::make_unique<SequenceNode>(NodeKind::list, begin, begin);
  if (!at("]")) {
    NodePtr first = parse_item();
    if (at("for")) {
      NodePtr node = parse_comprehension(ComprehensionNode::Kind::list, std::move(first), nullptr, mark, begin);
      expect_closing("]");
      node->end = previous_end_;
      return node;
    }
    deepen(*list, first.get());
    list->items.push_back(std::move(first));
    while (separate_items("]")) {
      list->items.push_back(parse_item());
      deepen(*list, list->items.back().get());
    }
  }
  expect_closing("]");
  list->end = previous_end_;
  return list;
}

/// {a, b} is a set, {a: b} a dict, {} an empty dict.
NodePtr Parser::parse_brace_display() {
  const Nesting nesting(*this);
  const std::uint32_t begin = now_.begin;
  const std::size_t mark = scopes_->mark();
  advance();
  if (at("}") || at("**")) return parse_dict_rest(nullptr, begin);
  NodePtr first = parse_item();
  if (at(":")) {
    advance();
    NodePtr value = parse_expression();
    if (at("for")) {
      NodePtr node =
          parse_comprehension(ComprehensionNode::Kind::dict, std::move(first), std::move(value), mark, begin);
      expect_closing("}");
      node->end = previous_end_;
      return node;
    }
    auto dict = std::make_unique<DictNode>(NodeKind::dict, begin, begin);
    deepen(*dict, first.get());
    deepen(*dict, value.get());
    dict->items.emplace_back(std::move(first), std::move(value));
    return parse_dict_rest(std::move(dict), begin);
  }
  if (at("for")) {
    NodePtr node = parse_comprehension(ComprehensionNode::Kind::set, std::move(first), nullptr, mark, begin);
    expect_closing("}");
    node->end = previous_end_;
    return node;
  }
  auto set = std::make_unique<SequenceNode>(NodeKind::set, begin, begin);
  deepen(*set, first.get());
  set->items.push_back(std::move(first));
  while (separate_items("}")) {
    set->items.push_back(parse_item());
    deepen(*set, set->items.back().get());
  }
  expect_closing("}");
  set->end = previous_end_;
  return set;
}

/// The pairs after the first one of `started`, or all of them when there is none yet.
NodePtr Parser::parse_dict_rest(NodePtr started, std::uint32_t begin) {
  auto dict = std::make_unique<DictNode>(NodeKind::dict, begin, begin);
  bool more = !at("}");
  if (started) {
    dict.reset(static_cast<DictNode*>(started.release()));
    more = separate_items("}");
  }
  while (more) {
    NodePtr key, value;
    if (accept("**")) {
      value = parse_binary(1);
    } else {
      key = parse_expression();
      if (!accept(":")) fail_here("':' between key and value");
      value = parse_expression();
    }
    deepen(*dict, key.get());
    deepen(*dict, value.get());
    dict->items.emplace_back(std::move(key), std::move(value));
    more = separate_items("}");
  }
  expect_closing("}");
  dict->end = previous_end_;
  return dict;
}

/// What stands before `for` was read as part of the scope around; it moves into the comprehension's own.
NodePtr Parser::parse_comprehension(ComprehensionNode::Kind kind, NodePtr element, NodePtr value, std::size_t uses_mark,
                                    std::uint32_t begin) {
  const Nesting nesting(*this);
  if (element->kind == NodeKind::starred) fail("syntax", "a comprehension has no starred element", span_of(*element));
  auto node = std::make_unique<ComprehensionNode>(NodeKind::comprehension, begin, begin);
  node->produces = kind;
  scopes_->open(true);
  scopes_->move_uses(uses_mark);
  while (accept("for")) {
    ComprehensionNode::Clause clause;
    clause.target = parse_target_list("in");
    if (!accept("in")) fail_here("'in'");
    if (node->clauses.empty()) {
      auto own = scopes_->take_innermost();
      clause.iterable = parse_or();
      scopes_->put_back(std::move(own));
    } else {
      clause.iterable = parse_or();
    }
    while (accept("if")) {
      clause.conditions.push_back(parse_or());
      deepen(*node, clause.conditions.back().get());
    }
    deepen(*node, clause.target.get());
    deepen(*node, clause.iterable.get());
    node->clauses.push_back(std::move(clause));
  }
  node->slots = scopes_->close().slots;
  deepen(*node, element.get());
  deepen(*node, value.get());
  node->element = std::move(element);
  node->value = std::move(value);
  node->end = previous_end_;
  return node;
}

/// The targets of a `for`: parsed below comparisons, since `in` ends them.
NodePtr Parser::parse_target_list(std::string_view until) {
  const std::uint32_t begin = now_.begin;
  const auto parse_target = [&]() -> NodePtr {
    if (at("*")) return parse_item();
    return parse_binary(1);
  };
  NodePtr first = parse_target();
  if (at(",")) {
    auto tuple = std::make_unique<SequenceNode>(NodeKind::tuple, begin, begin);
    deepen(*tuple, first.get());
    tuple->items.push_back(std::move(first));
    while (accept(",") && !at(until)) {
      tuple->items.push_back(parse_target());
      deepen(*tuple, tuple->items.back().get());
    }
    tuple->end = previous_end_;
    first = std::move(tuple);
  }
  bind_target(*first);
  return first;
}

/// String literals side by side are one; an f-string among them makes the whole one.
NodePtr Parser::parse_texts() {
  const std::uint32_t begin = now_.begin;
  const std::size_t findings = diagnostics_.items().size();
  auto node = std::make_unique<FormattedNode>(NodeKind::formatted, begin, begin);
  bool formatted = false;
  std::string text;
  while (now_.kind == TokenKind::text || now_.kind == TokenKind::formatted_text) {
    if (now_.starts_line && now_.begin != begin && starts_statement(now_)) break;
    if (now_.kind == TokenKind::text) {
      text += now_.value.as_text();
    } else {
      if (!text.empty()) node->pieces.emplace_back().text = std::exchange(text, {});
      formatted = true;
      const TextLiteral literal = split_text_literal(now_);
      const auto end = literal.body_begin + static_cast<std::uint32_t>(literal.body.size());
      parse_formatted(*node, literal.body_begin, end, literal.raw, 0);
    }
    advance();
  }
  flawed_ = flawed_ || diagnostics_.items().size() != findings;  // in escapes and in fields
  if (!formatted) return std::make_unique<ConstantNode>(Value(std::move(text)), begin, previous_end_);
  if (!text.empty()) node->pieces.emplace_back().text = std::move(text);
  node->end = previous_end_;
  return node;
}

/// Splits the body of an f-string, or of a format inside it (level 1 and more), into texts and fields.
void Parser::parse_formatted(FormattedNode& node, std::uint32_t begin, std::uint32_t end, bool raw, int level) {
  const std::string_view text = file_->text();
  std::string plain;
  const auto add_text = [&](std::uint32_t from, std::uint32_t to) {
    const std::string_view part = text.substr(from, to - from);
    plain += raw ? std::string(part) : decode_escapes(part, file_, from, diagnostics_);
  };
  std::uint32_t from = begin;
  for (std::uint32_t i = begin; i < end;) {
    if (text[i] != '{' && text[i] != '}') {
      ++i;
      continue;
    }
    add_text(from, i);
    if (i + 1 < end && text[i + 1] == text[i] && level == 0) {
      plain += text[i];
      i += 2;
    } else if (text[i] == '}') {
      fail("syntax", "a '}' stands alone in this f-string", {file_, i, i + 1}, "write '}}' for the character itself");
    } else {
      node.pieces.emplace_back().text = std::exchange(plain, {});
      i = parse_field(node, i + 1, end, raw, level);
    }
    from = i;
  }
  add_text(from, end);
  if (!plain.empty()) node.pieces.emplace_back().text = std::move(plain);
}

namespace {

/// Where the expression of a field ends: at '!', ':', '=' or '}' outside brackets and strings.
std::uint32_t field_end(std::string_view text, std::uint32_t begin, std::uint32_t end) {
  int depth = 0;
  char quote = 0;
  for (std::uint32_t i = begin; i < end; ++i) {
    const char c = text[i];
    const char following = i + 1 < end ? text[i + 1] : '\0';
    if (quote != 0) {
      if (c == quote) quote = 0;
    } else if (c == '\'' || c == '"') {
      quote = c;
    } else if (c == '(' || c == '[' || c == '{') {
      ++depth;
    } else if (depth > 0) {
      if (c == ')' || c == ']' || c == '}') --depth;
    } else if (c == ':' || c == '}') {
      return i;
    } else if (c == '!' && following != '=') {
      return i;
    } else if (c == '=' || c == '!' || c == '<' || c == '>') {
      if (following == '=')
        ++i;
      else if (c == '=')
        return i;
    }
  }
  return end;
}

}  // namespace

/// A replacement field from behind its '{'; returns the place behind its '}'.
std::uint32_t Parser::parse_field(FormattedNode& node, std::uint32_t begin, std::uint32_t end, bool raw, int level) {
  const Nesting nesting(*this);
  if (level > 1)
    fail("syntax", "fields of an f-string are nested too deeply", {file_, begin - 1, begin},
         "compute the format before");
  const std::string_view text = file_->text();
  std::uint32_t at = field_end(text, begin, end);
  const std::string_view written = text.substr(begin, at - begin);
  if (written.find_first_not_of(" \t\r\n") == written.npos) {
    fail("syntax", "a field of this f-string is empty", {file_, begin - 1, std::min(at + 1, end)},
         "write '{{' for the character itself");
  }
  FormattedNode::Piece& piece = node.pieces.back();
  Parser inner(*this, begin, at);
  piece.value = inner.parse_expression_list();
  if (inner.now_.kind != TokenKind::end) inner.fail_here("the end of the field");
  deepen(node, piece.value.get());
  bool shows_source = false;
  if (at < end && text[at] == '=') {
    ++at;
    while (at < end && text[at] == ' ') ++at;
    piece.text += text.substr(begin, at - begin);
    shows_source = true;
  }
  if (at + 1 < end && text[at] == '!') {
    piece.conversion = text[at + 1];
    if (piece.conversion != 'r' && piece.conversion != 's' && piece.conversion != 'a') {
      fail("syntax", "the conversion of a field is !r, !s or !a", {file_, at, at + 2});
    }
    at += 2;
  }
  if (at < end && text[at] == ':') {
    std::uint32_t close = at + 1;
    for (int depth = 0; close < end && (text[close] != '}' || depth > 0); ++close) {
      if (text[close] == '{') ++depth;
      if (text[close] == '}') --depth;
    }
    auto format = std::make_unique<FormattedNode>(NodeKind::formatted, at + 1, close);
    parse_formatted(*format, at + 1, close, raw, level + 1);
    deepen(node, format.get());
    node.pieces.back().format = std::move(format);
    at = close;
  } else if (shows_source && piece.conversion == 0) {
    piece.conversion = 'r';
  }
  if (at >= end || text[at] != '}')
    fail("syntax", "a field of this f-string is not closed", {file_, begin - 1, begin}, "add '}'");
  return at + 1;
}

}  // namespace comma::interpreter
