#include "interpreter/syntax/statement_facts.hpp"

namespace comma::interpreter {

namespace {

using NameNodes = std::vector<const NameNode*>;

void add_target(const Node* target, NameNodes& names) {
  if (target == nullptr) return;
  switch (target->kind) {
    case NodeKind::name:
      names.push_back(static_cast<const NameNode*>(target));
      break;
    case NodeKind::subscript:
      add_target(static_cast<const SubscriptNode*>(target)->object.get(), names);
      break;
    case NodeKind::attribute:
      add_target(static_cast<const AttributeNode*>(target)->object.get(), names);
      break;
    case NodeKind::starred:
      add_target(static_cast<const StarredNode*>(target)->value.get(), names);
      break;
    case NodeKind::tuple:
    case NodeKind::list:
      for (const NodePtr& item : static_cast<const SequenceNode*>(target)->items) add_target(item.get(), names);
      break;
    default:
      break;
  }
}

/// items.append(x) changes items.
void add_changed_object(const Node& expression, NameNodes& names) {
  if (expression.kind != NodeKind::call) return;
  const Node& callee = *static_cast<const CallNode&>(expression).callee;
  if (callee.kind == NodeKind::attribute) add_target(static_cast<const AttributeNode&>(callee).object.get(), names);
}

/// Calls visit(block) for each block of the statement; `in_loop` says whether it is the body of a loop.
template <class Visit>
void for_each_block(const Statement& statement, Visit visit) {
  switch (statement.kind) {
    case StatementKind::if_: {
      const auto& node = static_cast<const IfStatement&>(statement);
      for (const auto& [condition, block] : node.branches) visit(block, false);
      visit(node.otherwise, false);
      break;
    }
    case StatementKind::while_: {
      const auto& node = static_cast<const WhileStatement&>(statement);
      visit(node.body, true);
      visit(node.otherwise, false);
      break;
    }
    case StatementKind::for_: {
      const auto& node = static_cast<const ForStatement&>(statement);
      visit(node.body, true);
      visit(node.otherwise, false);
      break;
    }
    case StatementKind::try_: {
      const auto& node = static_cast<const TryStatement&>(statement);
      visit(node.body, false);
      for (const auto& handler : node.handlers) visit(handler.body, false);
      visit(node.otherwise, false);
      visit(node.finally, false);
      break;
    }
    case StatementKind::with_:
      visit(static_cast<const WithStatement&>(statement).body, false);
      break;
    default:
      break;
  }
}

void collect(const Statement& statement, NameNodes& names) {
  switch (statement.kind) {
    case StatementKind::assign:
      for (const NodePtr& target : static_cast<const AssignStatement&>(statement).targets)
        add_target(target.get(), names);
      break;
    case StatementKind::augmented:
      add_target(static_cast<const AugmentedStatement&>(statement).target.get(), names);
      break;
    case StatementKind::for_:
      add_target(static_cast<const ForStatement&>(statement).target.get(), names);
      break;
    case StatementKind::with_:
      add_target(static_cast<const WithStatement&>(statement).target.get(), names);
      break;
    case StatementKind::function:
      add_target(static_cast<const FunctionStatement&>(statement).name.get(), names);
      break;
    case StatementKind::expression:
      add_changed_object(*static_cast<const ValueStatement&>(statement).value, names);
      break;
    case StatementKind::broken:
      for (const NodePtr& name : static_cast<const BrokenStatement&>(statement).names) add_target(name.get(), names);
      break;
    case StatementKind::import:
    case StatementKind::import_from:
      for (const auto& item : static_cast<const ImportStatement&>(statement).items) add_target(item.name.get(), names);
      break;
    default:
      break;
  }
  for_each_block(statement, [&](const Block& block, bool) {
    for (const StatementPtr& inner : block) collect(*inner, names);
  });
}

void collect(const Statement& statement, bool in_loop, Exits& exits) {
  if (statement.kind == StatementKind::return_) exits.returns = true;
  if (!in_loop && (statement.kind == StatementKind::break_ || statement.kind == StatementKind::continue_))
    exits.leaves_loop = true;
  for_each_block(statement, [&](const Block& block, bool loop) {
    for (const StatementPtr& inner : block) collect(*inner, in_loop || loop, exits);
  });
}

}  // namespace

std::vector<const NameNode*> bound_names(const Statement& statement) {
  NameNodes names;
  collect(statement, names);
  return names;
}

Exits exits_of(const Statement& statement) {
  Exits exits;
  collect(statement, false, exits);
  return exits;
}

}  // namespace comma::interpreter
