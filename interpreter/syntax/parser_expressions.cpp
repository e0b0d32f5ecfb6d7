// Expressions, from the loosest binding to the tightest.
#include <fmt/format.h>

#include <array>
#include <set>

#include "interpreter/syntax/parser.hpp"

namespace comma::interpreter {

namespace {

struct BinaryRow {
  std::string_view symbol;
  int level;  ///< higher binds tighter
  Operator op;
};

constexpr std::array binary_rows = {
    BinaryRow{"|", 1, Operator::bit_or},       BinaryRow{"^", 2, Operator::bit_xor},
    BinaryRow{"&", 3, Operator::bit_and},      BinaryRow{"<<", 4, Operator::left_shift},
    BinaryRow{">>", 4, Operator::right_shift}, BinaryRow{"+", 5, Operator::add},
    BinaryRow{"-", 5, Operator::subtract},     BinaryRow{"*", 6, Operator::multiply},
    BinaryRow{"/", 6, Operator::divide},       BinaryRow{"//", 6, Operator::floor_divide},
    BinaryRow{"%", 6, Operator::modulo},       BinaryRow{"@", 6, Operator::matrix_multiply},
};

const BinaryRow* binary_row(const Token& token) {
  if (token.kind != TokenKind::symbol) return nullptr;
  for (const BinaryRow& row : binary_rows) {
    if (row.symbol == token.text) return &row;
  }
  return nullptr;
}

bool is_whole_number(const Node& node) {
  return node.kind == NodeKind::constant && static_cast<const ConstantNode&>(node).value.is_integer();
}

/// -0
bool is_whole_with_sign(const Node& node) {
  const Node* number = &node;
  if (node.kind == NodeKind::unary) number = static_cast<const UnaryNode&>(node).operand.get();
  return number != nullptr && is_whole_number(*number);
}

}  // namespace

std::string_view symbol_of(Operator op) {
  static constexpr std::string_view symbols[] = {"+",  "-", "*",  "/",  "//", "%",  "**",     "@",   "<<",
                                                 ">>", "&", "|",  "^",  "+",  "-",  "~",      "not", "<",
                                                 "<=", ">", ">=", "==", "!=", "in", "not in", "is",  "is not"};
  return symbols[static_cast<std::size_t>(op)];
}

/// One expression, or several with commas: a tuple.
NodePtr Parser::parse_expression_list() {
  const std::uint32_t begin = now_.begin;
  NodePtr first = parse_item();
  if (!at(",")) {
    if (first->kind == NodeKind::starred && !at("="))
      fail("syntax", "a starred expression stands alone", span_of(*first), "write '*name,'");
    return first;
  }
  auto tuple = std::make_unique<SequenceNode>(NodeKind::tuple, begin, begin);
  deepen(*tuple, first.get());
  tuple->items.push_back(std::move(first));
  while (accept(",")) {
    const bool ends = now_.kind == TokenKind::newline || now_.kind == TokenKind::end || at("=") || at(")") || at(":") ||
                      at(";") || at("]") || at("}");
    if (ends) break;
    tuple->items.push_back(parse_item());
    deepen(*tuple, tuple->items.back().get());
  }
  tuple->end = previous_end_;
  return tuple;
}

/// An expression, or *expression where several may stand.
NodePtr Parser::parse_item() {
  if (!at("*")) return parse_expression();
  auto node = std::make_unique<StarredNode>(NodeKind::starred, now_.begin, now_.end);
  advance();
  node->value = parse_binary(1);
  deepen(*node, node->value.get());
  node->end = previous_end_;
  return node;
}

NodePtr Parser::parse_expression() {
  if (at("lambda")) return parse_lambda();
  const Nesting nesting(*this);
  NodePtr value = parse_or();
  if (!at("if")) return value;
  auto node = std::make_unique<ConditionalNode>(NodeKind::conditional, value->begin, value->end);
  advance();
  node->then = std::move(value);
  node->condition = parse_or();
  if (!accept("else")) fail_here("'else'");
  node->otherwise = parse_expression();
  deepen(*node, node->then.get());
  deepen(*node, node->condition.get());
  deepen(*node, node->otherwise.get());
  node->end = previous_end_;
  return node;
}

NodePtr Parser::parse_or() {
  NodePtr first = parse_and();
  if (!at("or")) return first;
  auto node = std::make_unique<LogicalNode>(NodeKind::logical, first->begin, first->end);
  node->conjunction = false;
  deepen(*node, first.get());
  node->operands.push_back(std::move(first));
  while (accept("or")) {
    node->operands.push_back(parse_and());
    deepen(*node, node->operands.back().get());
  }
  node->end = previous_end_;
  return node;
}

NodePtr Parser::parse_and() {
  NodePtr first = parse_not();
  if (!at("and")) return first;
  auto node = std::make_unique<LogicalNode>(NodeKind::logical, first->begin, first->end);
  deepen(*node, first.get());
  node->operands.push_back(std::move(first));
  while (accept("and")) {
    node->operands.push_back(parse_not());
    deepen(*node, node->operands.back().get());
  }
  node->end = previous_end_;
  return node;
}

NodePtr Parser::parse_not() {
  if (!at("not")) return parse_comparison();
  const Nesting nesting(*this);
  auto node = std::make_unique<UnaryNode>(NodeKind::unary, now_.begin, now_.end);
  advance();
  node->op = Operator::logical_not;
  node->operand = parse_not();
  deepen(*node, node->operand.get());
  node->end = previous_end_;
  return node;
}

std::optional<Operator> Parser::comparison_operator() {
  static constexpr std::array<std::pair<std::string_view, Operator>, 6> rows = {{{"<", Operator::less},
                                                                                 {"<=", Operator::less_equal},
                                                                                 {">", Operator::greater},
                                                                                 {">=", Operator::greater_equal},
                                                                                 {"==", Operator::equal},
                                                                                 {"!=", Operator::not_equal}}};
  for (const auto& [symbol, op] : rows) {
    if (accept(symbol)) return op;
  }
  if (accept("in")) return Operator::in;
  if (accept("is")) return accept("not") ? Operator::is_not : Operator::is;
  if (!at("not") || ahead().text != "in") return std::nullopt;
  advance();
  advance();
  return Operator::not_in;
}

NodePtr Parser::parse_comparison() {
  NodePtr first = parse_binary(1);
  auto op = comparison_operator();
  if (!op) return first;
  auto node = std::make_unique<CompareNode>(NodeKind::compare, first->begin, first->end);
  deepen(*node, first.get());
  node->first = std::move(first);
  while (op) {
    node->rest.emplace_back(*op, parse_binary(1));
    deepen(*node, node->rest.back().second.get());
    op = comparison_operator();
  }
  node->end = previous_end_;
  return node;
}

NodePtr Parser::parse_binary(int lowest) {
  NodePtr left = parse_factor();
  while (const BinaryRow* row = binary_row(now_)) {
    if (row->level < lowest) break;
    advance();
    auto node = std::make_unique<BinaryNode>(NodeKind::binary, left->begin, left->end);
    node->op = row->op;
    node->left = std::move(left);
    node->right = parse_binary(row->level + 1);
    deepen(*node, node->left.get());
    deepen(*node, node->right.get());
    node->end = previous_end_;
    left = std::move(node);
  }
  return left;
}

/// Signs bind looser than ** on their right: -2**2 is -4, 2**-1 is 0.5.
NodePtr Parser::parse_factor() {
  const bool sign = at("+") || at("-") || at("~");
  if (sign) {
    const Nesting nesting(*this);
    auto node = std::make_unique<UnaryNode>(NodeKind::unary, now_.begin, now_.end);
    node->op = at("+") ? Operator::plus : at("-") ? Operator::minus : Operator::invert;
    advance();
    node->operand = parse_factor();
    deepen(*node, node->operand.get());
    node->end = previous_end_;
    return node;
  }
  NodePtr base = parse_postfix();
  if (!at("**")) return base;
  const Nesting nesting(*this);
  auto node = std::make_unique<BinaryNode>(NodeKind::binary, base->begin, base->end);
  advance();
  node->op = Operator::power;
  node->left = std::move(base);
  node->right = parse_factor();
  deepen(*node, node->left.get());
  deepen(*node, node->right.get());
  node->end = previous_end_;
  return node;
}

NodePtr Parser::parse_postfix() {
  NodePtr value = parse_atom();
  while (true) {
    if (at("(")) {
      value = parse_call(std::move(value));
    } else if (at("[")) {
      value = parse_subscript(std::move(value));
    } else if (accept(".")) {
      auto node = std::make_unique<AttributeNode>(NodeKind::attribute, value->begin, value->end);
      if (now_.kind != TokenKind::name) fail_here("the name of an attribute");
      node->name = std::string(now_.text);
      node->name_begin = now_.begin;
      advance();
      deepen(*node, value.get());
      node->object = std::move(value);
      node->end = previous_end_;
      value = std::move(node);
    } else {
      return value;
    }
  }
}

NodePtr Parser::parse_call(NodePtr callee) {
  const Nesting nesting(*this);
  auto call = std::make_unique<CallNode>(NodeKind::call, callee->begin, callee->end);
  deepen(*call, callee.get());
  call->callee = std::move(callee);
  advance();
  if (!at(")")) {
    do {
      parse_argument(*call);
      deepen(*call, call->arguments.back().value.get());
    } while (separate_items(")"));
  }
  expect_closing(")");
  call->end = previous_end_;
  return call;
}

void Parser::parse_argument(CallNode& call) {
  CallNode::Item item;
  item.name_begin = now_.begin;
  const std::size_t mark = scopes_->mark();
  if (accept("**")) {
    item.kind = CallNode::Kind::spread_keywords;
    item.value = parse_expression();
  } else if (accept("*")) {
    item.kind = CallNode::Kind::spread;
    item.value = parse_expression();
  } else if (now_.kind == TokenKind::name && ahead().kind == TokenKind::symbol && ahead().text == "=") {
    item.kind = CallNode::Kind::keyword;
    item.name = std::string(now_.text);
    item.name_end = now_.end;
    for (const CallNode::Item& other : call.arguments) {
      if (other.kind != CallNode::Kind::keyword || other.name != item.name) continue;
      item.repeated = true;
      report_mended("repeated-keyword", fmt::format("{} is given twice in this call", item.name), span_of(now_),
                    "keep one of them; several occurrences of a factor stand in a tuple: (_F(...), _F(...))");
      break;
    }
    advance();
    advance();
    item.value = parse_expression();
  } else {
    const bool follows_keyword = !call.arguments.empty() && call.arguments.back().kind >= CallNode::Kind::keyword;
    // A keyword would have to stand here: `F(A=1,` and, on the next line, `G(...)`.
    if (follows_keyword && now_.kind == TokenKind::name && starts_line_outside(now_)) fail_here("')'");
    item.value = parse_expression();
    if (at("for")) {
      const std::uint32_t begin = item.value->begin;
      item.value = parse_comprehension(ComprehensionNode::Kind::generator, std::move(item.value), nullptr, mark, begin);
    } else if (at("=")) {
      fail("syntax", "the name of a keyword is a plain word", span_of(*item.value),
           "write NAME=value, or '==' to compare");
    } else if (at(":=")) {
      fail("not-supported", "':=' is not part of the command language", span_of(now_), "assign on a line of its own");
    } else if (follows_keyword) {
      const Node& before = *call.arguments.back().value;
      // 2,1e5 and -0,2: what follows the comma has digits alone, or an exponent besides.
      const bool decimal_comma = item.value->kind == NodeKind::constant && is_whole_with_sign(before) &&
                                 before.end + 1 == item.value->begin && is_number_without_point(*item.value);
      report("syntax", "an argument without keyword follows one with a keyword", span_of(*item.value),
             decimal_comma ? "numbers have a decimal point: write 10.5 for ten and a half" : "write KEYWORD=value");
    }
  }
  call.arguments.push_back(std::move(item));
}

bool Parser::is_number_without_point(const Node& node) const {
  const std::string_view text = file_->text().substr(node.begin, node.end - node.begin);
  return !text.empty() && std::isdigit(static_cast<unsigned char>(text.front())) != 0 &&
         text.find('.') == std::string_view::npos;
}

NodePtr Parser::parse_subscript(NodePtr object) {
  const Nesting nesting(*this);
  auto node = std::make_unique<SubscriptNode>(NodeKind::subscript, object->begin, object->end);
  deepen(*node, object.get());
  node->object = std::move(object);
  advance();
  const std::uint32_t begin = now_.begin;
  NodePtr index = parse_subscript_item();
  if (at(",")) {
    auto tuple = std::make_unique<SequenceNode>(NodeKind::tuple, begin, begin);
    tuple->items.push_back(std::move(index));
    while (accept(",") && !at("]")) tuple->items.push_back(parse_subscript_item());
    tuple->end = previous_end_;
    for (const NodePtr& item : tuple->items) deepen(*tuple, item.get());
    index = std::move(tuple);
  }
  deepen(*node, index.get());
  node->index = std::move(index);
  expect_closing("]");
  node->end = previous_end_;
  return node;
}

NodePtr Parser::parse_subscript_item() {
  const std::uint32_t begin = now_.begin;
  NodePtr start = at(":") ? nullptr : parse_item();
  if (!at(":")) return start;
  auto slice = std::make_unique<SliceNode>(NodeKind::slice, begin, begin);
  slice->start = std::move(start);
  advance();
  if (!at(":") && !at("]") && !at(",")) slice->stop = parse_expression();
  if (accept(":") && !at("]") && !at(",")) slice->step = parse_expression();
  deepen(*slice, slice->start.get());
  deepen(*slice, slice->stop.get());
  deepen(*slice, slice->step.get());
  slice->end = previous_end_;
  return slice;
}

}  // namespace comma::interpreter
