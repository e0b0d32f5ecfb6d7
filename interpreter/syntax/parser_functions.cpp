// Functions, their parameters, and what may stand left of '='.
#include <fmt/format.h>

#include <utility>

#include "interpreter/syntax/parser.hpp"

namespace comma::interpreter {

namespace {

std::string_view kind_in_words(const Node& node) {
  switch (node.kind) {
    case NodeKind::constant:
      return "a constant";
    case NodeKind::call:
      return "a call";
    case NodeKind::compare:
      return "a comparison";
    case NodeKind::lambda:
      return "a lambda";
    case NodeKind::comprehension:
      return "a comprehension";
    case NodeKind::conditional:
      return "a conditional expression";
    case NodeKind::formatted:
      return "an f-string";
    case NodeKind::dict:
    case NodeKind::set:
      return "a display in braces";
    default:
      return "an expression";
  }
}

}  // namespace

/// Marks the names of a target as bound here; anything that cannot be assigned to is an error.
void Parser::bind_target(Node& target) {
  switch (target.kind) {
    case NodeKind::name:
      return scopes_->bind(static_cast<NameNode&>(target));
    case NodeKind::attribute:
    case NodeKind::subscript:
      return;
    case NodeKind::tuple:
    case NodeKind::list:
      return bind_targets(static_cast<SequenceNode&>(target).items, target);
    case NodeKind::broken:
      return;
    case NodeKind::starred:
      fail("invalid-target", "a starred target stands alone", span_of(target), "write '*name,' or leave out the star");
    default:
      break;
  }
  const bool compares = target.kind == NodeKind::compare || at("=");
  fail("invalid-target", fmt::format("nothing can be assigned to {}", kind_in_words(target)), span_of(target),
       compares ? "write '==' to compare" : "");
}

void Parser::bind_targets(std::vector<NodePtr>& targets, const Node& whole) {
  int stars = 0;
  for (NodePtr& target : targets) {
    if (target->kind == NodeKind::starred) {
      ++stars;
      bind_target(*static_cast<StarredNode&>(*target).value);
    } else {
      bind_target(*target);
    }
  }
  if (stars > 1) fail("invalid-target", "only one target of an assignment may be starred", span_of(whole));
}

/// Annotations are not evaluated, so their names need not exist.
void Parser::skip_annotation() {
  const std::size_t mark = scopes_->mark();
  parse_expression();
  scopes_->forget_uses(mark);
}

void Parser::parse_parameter(Signature& signature, Parameter::Kind kind, bool annotations) {
  if (now_.kind != TokenKind::name) fail_here("the name of a parameter");
  Parameter parameter;
  parameter.name = std::string(now_.text);
  parameter.kind = kind;
  for (const Parameter& other : signature.parameters) {
    if (other.name == parameter.name) {
      report("repeated-name", fmt::format("two parameters are called {}", parameter.name), span_of(now_),
             "rename one of them");
    }
  }
  const Span place = span_of(now_);
  advance();
  if (annotations && accept(":")) skip_annotation();
  const bool may_have_default = kind == Parameter::Kind::normal || kind == Parameter::Kind::keyword_only;
  if (may_have_default && accept("=")) {
    parameter.default_index = static_cast<int>(signature.defaults.size());
    signature.defaults.push_back(parse_expression());
  } else if (kind == Parameter::Kind::normal && !signature.defaults.empty()) {
    report("syntax", fmt::format("{} has no default but follows parameters that have one", parameter.name), place,
           "put the parameters without default first");
  }
  signature.parameters.push_back(std::move(parameter));
}

Parser::Signature Parser::parse_parameters(std::string_view closing, bool annotations) {
  Signature signature;
  auto kind = Parameter::Kind::normal;
  while (!at(closing)) {
    if (!signature.parameters.empty() && signature.parameters.back().kind == Parameter::Kind::keywords) {
      fail("syntax", "nothing may follow the parameter with **", span_of(now_), "put it last");
    }
    if (at("/")) {
      for (Parameter& parameter : signature.parameters) parameter.positional_only = true;
      advance();
    } else if (accept("**")) {
      parse_parameter(signature, Parameter::Kind::keywords, annotations);
    } else if (at("*")) {
      if (kind == Parameter::Kind::keyword_only)
        fail("syntax", "a second '*' among the parameters", span_of(now_), "remove it");
      advance();
      if (!at(",")) parse_parameter(signature, Parameter::Kind::rest, annotations);
      kind = Parameter::Kind::keyword_only;
    } else {
      parse_parameter(signature, kind, annotations);
    }
    if (!accept(",")) break;
  }
  return signature;
}

void Parser::close_scope(FunctionCode& code) {
  ScopeStack::Closed closed = scopes_->close();
  code.slots = std::move(closed.slots);
  code.outer_uses = std::move(closed.outer_uses);
  code.changes_outer = closed.changes_outer;
}

StatementPtr Parser::parse_function() {
  const std::uint32_t begin = now_.begin;
  auto statement = std::make_unique<FunctionStatement>(StatementKind::function, begin, now_.end);
  advance();
  if (now_.kind != TokenKind::name) fail_here("the name of the function");
  auto code = std::make_shared<FunctionCode>();
  code->name = std::string(now_.text);
  code->file = file_;
  statement->name = parse_name();
  bind_target(*statement->name);
  if (!accept("(")) fail_here("'('");
  Signature signature = parse_parameters(")", true);
  expect_closing(")");
  if (accept("->")) skip_annotation();
  expect_colon("the parameters");
  scopes_->open();
  for (const Parameter& parameter : signature.parameters) scopes_->bind_parameter(parameter.name);
  const int loops = std::exchange(loops_, 0);
  code->body = parse_block("'def'", begin);
  loops_ = loops;
  close_scope(*code);
  code->parameters = std::move(signature.parameters);
  statement->defaults = std::move(signature.defaults);
  statement->code = std::move(code);
  statement->end = previous_end_;
  return statement;
}

NodePtr Parser::parse_lambda() {
  const Nesting nesting(*this);
  auto node = std::make_unique<LambdaNode>(NodeKind::lambda, now_.begin, now_.end);
  advance();
  Signature signature = parse_parameters(":", false);
  if (!accept(":")) fail_here("':' after the parameters");
  scopes_->open();
  for (const Parameter& parameter : signature.parameters) scopes_->bind_parameter(parameter.name);
  auto code = std::make_shared<FunctionCode>();
  code->name = "<lambda>";
  code->file = file_;
  code->result = parse_expression();
  close_scope(*code);
  code->parameters = std::move(signature.parameters);
  deepen(*node, code->result.get());
  for (const NodePtr& value : signature.defaults) deepen(*node, value.get());
  node->defaults = std::move(signature.defaults);
  node->code = std::move(code);
  node->end = previous_end_;
  return node;
}

}  // namespace comma::interpreter
