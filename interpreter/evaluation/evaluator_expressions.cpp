// Expressions: each node gives a value; operands are evaluated from left to right.
#include <fmt/format.h>

#include "interpreter/evaluation/evaluator.hpp"
#include "interpreter/evaluation/generator.hpp"
#include "interpreter/values/format.hpp"
#include "interpreter/values/operations.hpp"
#include "interpreter/values/repr.hpp"

namespace comma::interpreter {

namespace {

bool combines_concepts(const Value& left, const Value& right) {
  const auto counts = [](const Value& value) { return value.is_number() || value.is_concept(); };
  return (left.is_concept() || right.is_concept()) && counts(left) && counts(right);
}

}  // namespace

/// The innermost node that fails is where the error is.
Value Evaluator::evaluate(const Node& node) {
  try {
    Value value = evaluate_node(node);
    met_unknown_ = met_unknown_ || value.is_unknown();
    return value;
  } catch (const RaisedError& error) {
    if (!error.object()->span) place_error(*error.object(), span_of(node));
    throw;
  } catch (const LimitReached& limit) {
    if (limit.diagnostic().span) throw;
    Diagnostic finding = limit.diagnostic();
    finding.span = span_of(node);
    throw LimitReached(std::move(finding));
  }
}

Value Evaluator::evaluate_node(const Node& node) {
  check_stack();
  switch (node.kind) {
    case NodeKind::constant:
      return static_cast<const ConstantNode&>(node).value;
    case NodeKind::name:
      return evaluate_name(static_cast<const NameNode&>(node));
    case NodeKind::formatted:
      return evaluate_formatted(static_cast<const FormattedNode&>(node));
    case NodeKind::tuple:
    case NodeKind::list:
    case NodeKind::set:
      return evaluate_sequence(static_cast<const SequenceNode&>(node));
    case NodeKind::dict:
      return evaluate_dict(static_cast<const DictNode&>(node));
    case NodeKind::unary: {
      const auto& unary = static_cast<const UnaryNode&>(node);
      const Value operand = evaluate(*unary.operand);
      if (unary.op == Operator::minus && operand.is_concept())
        return concept_operation(Operator::multiply, operand, Value(-1.0));
      return unary_operation(unary.op, operand);
    }
    case NodeKind::binary: {
      const auto& binary = static_cast<const BinaryNode&>(node);
      const Value left = evaluate(*binary.left);
      const Value right = evaluate(*binary.right);
      if (combines_concepts(left, right)) return concept_operation(binary.op, left, right);
      return binary_operation(binary.op, left, right, meter_);
    }
    case NodeKind::logical:
      return evaluate_logical(static_cast<const LogicalNode&>(node));
    case NodeKind::compare:
      return evaluate_compare(static_cast<const CompareNode&>(node));
    case NodeKind::conditional:
      return evaluate_conditional(static_cast<const ConditionalNode&>(node));
    case NodeKind::lambda:
      return evaluate_lambda(static_cast<const LambdaNode&>(node));
    case NodeKind::comprehension:
      return evaluate_comprehension(static_cast<const ComprehensionNode&>(node));
    case NodeKind::call:
      return evaluate_call(static_cast<const CallNode&>(node));
    case NodeKind::attribute: {
      const auto& access = static_cast<const AttributeNode&>(node);
      return attribute(evaluate(*access.object), access.name);
    }
    case NodeKind::subscript:
      return evaluate_subscript(static_cast<const SubscriptNode&>(node));
    case NodeKind::slice:
      return evaluate_slice(static_cast<const SliceNode&>(node));
    case NodeKind::starred:
      raise(ErrorKind::syntax, "can't use starred expression here");
    case NodeKind::broken:
      return Value::unknown();
  }
  return Value::unknown();
}

Value Evaluator::evaluate_formatted(const FormattedNode& node) {
  std::string out;
  bool unknown = false;
  for (const FormattedNode::Piece& piece : node.pieces) {
    out += piece.text;
    if (!piece.value) continue;
    Value value = evaluate(*piece.value);
    if (piece.conversion != 0) value = convert_value(value, piece.conversion);
    const Value spec = piece.format ? evaluate(*piece.format) : Value("");
    unknown = unknown || holds_unknown(value) || spec.is_unknown();
    if (!unknown) out += format_value(value, spec.as_text(), meter_);
    meter_.allocate(out.size());
  }
  return unknown ? Value::unknown() : Value(std::move(out));
}

Value Evaluator::evaluate_sequence(const SequenceNode& node) {
  std::vector<Value> items;
  items.reserve(node.items.size());
  for (const NodePtr& item : node.items) {
    if (item->kind != NodeKind::starred) {
      items.push_back(evaluate(*item));
      continue;
    }
    const Value spread = evaluate(*static_cast<const StarredNode&>(*item).value);
    if (spread.is_unknown()) return spread;
    for (Value& value : list_of(spread, meter_)) items.push_back(std::move(value));
  }
  if (node.kind == NodeKind::tuple) return Value::tuple(std::move(items));
  if (node.kind == NodeKind::list) return Value::list(std::move(items));
  auto set = std::make_shared<Set>();
  set->keys = std::make_unique<Dict>();
  for (const Value& item : items) set->keys->set(item, Value());
  return Value(std::move(set));
}

Value Evaluator::evaluate_dict(const DictNode& node) {
  auto dict = std::make_shared<Dict>();
  for (const auto& [key, value] : node.items) {
    if (key) {
      const Value name = evaluate(*key);
      dict->set(name, evaluate(*value));
      continue;
    }
    const Value spread = evaluate(*value);
    if (spread.is_unknown()) return spread;
    if (!spread.is_dict()) raise(ErrorKind::type, fmt::format("'{}' object is not a mapping", spread.type_name()));
    dict->update(spread.as_dict());
  }
  return Value(std::move(dict));
}

Value Evaluator::evaluate_logical(const LogicalNode& node) {
  Value value;
  for (const NodePtr& operand : node.operands) {
    value = evaluate(*operand);
    if (value.is_unknown()) doubt();
    if (value.is_unknown() || truth(value) != node.conjunction) return value;
  }
  return value;
}

Value Evaluator::evaluate_compare(const CompareNode& node) {
  Value left = evaluate(*node.first);
  Value result;
  for (const auto& [op, operand] : node.rest) {
    Value right = evaluate(*operand);
    result = compare(op, left, right);
    if (result.is_unknown()) return result;
    if (&node.rest.back().second != &operand && !truth(result)) return result;
    left = std::move(right);
  }
  return result;
}

Value Evaluator::evaluate_conditional(const ConditionalNode& node) {
  const Value condition = evaluate(*node.condition);
  if (condition.is_unknown()) {
    doubt();
    return condition;
  }
  return evaluate(truth(condition) ? *node.then : *node.otherwise);
}

Value Evaluator::evaluate_lambda(const LambdaNode& node) { return make_function(node.code, node.defaults); }

Value Evaluator::augmented(Operator op, const Value& before, const Value& value) {
  return combines_concepts(before, value) ? concept_operation(op, before, value)
                                          : augmented_operation(op, before, value, meter_);
}

/// Of concepts, and of one and a number: what comes of it has no command that makes it.
Value Evaluator::concept_operation(Operator op, const Value& left, const Value& right) {
  const bool reversed = !left.is_concept();
  const ConceptPtr own = (reversed ? right : left).as_concept();
  return with_host([&]() -> Value {
    for (const Value& operand : {left, right}) {
      if (operand.is_concept() && !host_.force(operand.as_concept())) return Value::unknown();
    }
    auto made = own->data->combined(op, reversed ? left : right, reversed);
    if (!made) return binary_operation(op, left, right, meter_);
    auto handle = std::make_shared<Concept>();
    handle->name = "_" + own->name;
    handle->type = own->type;
    handle->id = detached_concept;
    handle->reads_through = own->reads_through;
    handle->data = std::move(made);
    return Value(std::move(handle));
  });
}

Value Evaluator::evaluate_name(const NameNode& node) {
  Value value = load(node);
  // What lies in an absent module is used by its name alone; of the module itself, the part behind the dot is.
  if (auto* thing = value.as_object<AbsentObject>(); thing != nullptr && !thing->is_module)
    return use_absent(*thing, thing->path);
  return value;
}

/// What a defaultdict lacks is made when it is asked for.
Value Evaluator::item(const Value& object, const Value& index) {
  if (object.is_dict() && object.as_dict().factory && !index.is_unknown() && object.as_dict().find(index) == nullptr) {
    const std::shared_ptr<const Value> factory = object.as_dict().factory;
    const Value made = call(*factory, CallArguments());
    store_subscript(object, index, made, meter_);
    return made;
  }
  return subscript(object, index, meter_);
}

Value Evaluator::evaluate_subscript(const SubscriptNode& node) {
  const Value object = evaluate(*node.object);
  const Value index = evaluate(*node.index);
  if (!object.is_concept()) return item(object, index);
  if (index.is_unknown()) return index;
  const ConceptPtr& handle = object.as_concept();
  return with_host([&]() -> Value { return host_.force(handle) ? handle->data->subscript(index) : Value::unknown(); });
}

Value Evaluator::evaluate_or_none(const NodePtr& node) { return node ? evaluate(*node) : Value(); }

Value Evaluator::evaluate_slice(const SliceNode& node) {
  auto slice = std::make_shared<SliceObject>();
  slice->start = evaluate_or_none(node.start);
  slice->stop = evaluate_or_none(node.stop);
  slice->step = evaluate_or_none(node.step);
  if (slice->start.is_unknown() || slice->stop.is_unknown() || slice->step.is_unknown()) return Value::unknown();
  return Value(std::shared_ptr<Object>(std::move(slice)));
}

Value Evaluator::evaluate_comprehension(const ComprehensionNode& node) {
  const Value first = evaluate(*node.clauses.front().iterable);
  if (first.is_unknown()) return first;
  auto generator = std::make_shared<Generator>(*this, node, iterate(first));
  remember_frame(generator->frame());
  if (node.produces == ComprehensionNode::Kind::generator) return Value(std::shared_ptr<Object>(std::move(generator)));
  std::vector<Value> items;
  auto dict = std::make_shared<Dict>();
  const bool list = node.produces == ComprehensionNode::Kind::list;
  while (auto item = generator->next()) {
    if (list) {
      if (items.size() == items.capacity()) meter_.allocate_items(items.size() + 1);
      items.push_back(std::move(*item));
    } else {
      dict->set(*item, generator->value());
    }
  }
  if (generator->met_unknown()) return Value::unknown();
  if (list) return Value::list(std::move(items));
  if (node.produces == ComprehensionNode::Kind::dict) return Value(std::move(dict));
  auto set = std::make_shared<Set>();
  set->keys = std::make_unique<Dict>();
  for (const Value& key : dict->keys()) set->keys->set(key, Value());
  return Value(std::move(set));
}

}  // namespace comma::interpreter
