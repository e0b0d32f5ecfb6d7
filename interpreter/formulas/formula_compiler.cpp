#include "interpreter/formulas/formula_compiler.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "interpreter/evaluation/evaluator.hpp"
#include "interpreter/graph/late_values.hpp"
#include "interpreter/library/builtins.hpp"
#include "interpreter/syntax/ast.hpp"

namespace comma::interpreter {

namespace {

// The stack of a formula that nests deeper would not fit the space that is set aside for it; a comparison in a chain is
// compiled twice, so a program could grow without end.
constexpr std::size_t deepest_stack = 64;
constexpr std::size_t longest_program = 4096;

/// The expression is not one of real numbers.
struct Unsuitable {};

// Python's integers have no negative zero.
double whole(double value) { return value + 0.0; }
double floor_of(double x) { return whole(std::floor(x)); }
double ceil_of(double x) { return whole(std::ceil(x)); }
double truncated(double x) { return whole(std::trunc(x)); }
double rounded(double x) { return whole(std::nearbyint(x)); }  // halves to even, as Python's round()
double same(double x) { return x; }
double degrees(double x) { return x * (180.0 / 3.14159265358979323846); }
double radians(double x) { return x * (3.14159265358979323846 / 180.0); }

using Unary = FormulaInstruction::Unary;
using Binary = FormulaInstruction::Binary;

constexpr std::array<std::pair<std::string_view, Unary>, 34> unary_functions{{
    {"sin", std::sin},     {"cos", std::cos},     {"tan", std::tan},     {"asin", std::asin},     {"acos", std::acos},
    {"atan", std::atan},   {"sinh", std::sinh},   {"cosh", std::cosh},   {"tanh", std::tanh},     {"asinh", std::asinh},
    {"acosh", std::acosh}, {"atanh", std::atanh}, {"exp", std::exp},     {"exp2", std::exp2},     {"expm1", std::expm1},
    {"log1p", std::log1p}, {"log", std::log},     {"log2", std::log2},   {"log10", std::log10},   {"sqrt", std::sqrt},
    {"cbrt", std::cbrt},   {"fabs", std::fabs},   {"abs", std::fabs},    {"absolute", std::fabs}, {"floor", floor_of},
    {"ceil", ceil_of},     {"trunc", truncated},  {"degrees", degrees},  {"radians", radians},    {"erf", std::erf},
    {"erfc", std::erfc},   {"arcsin", std::asin}, {"arccos", std::acos}, {"arctan", std::atan},
}};
constexpr std::array<std::pair<std::string_view, Binary>, 4> binary_functions{{
    {"atan2", std::atan2},
    {"hypot", std::hypot},
    {"pow", std::pow},
    {"copysign", std::copysign},
}};

template <class Table>
auto find_in(const Table& table, std::string_view name) -> decltype(table.front().second) {
  const auto found = std::find_if(table.begin(), table.end(), [&](const auto& row) { return row.first == name; });
  return found == table.end() ? nullptr : found->second;
}

/// The nodes right below one, for the kinds that a constant may be made of; nothing for the others.
std::optional<std::vector<const Node*>> parts_of(const Node& node) {
  std::vector<const Node*> parts;
  switch (node.kind) {
    case NodeKind::constant:
    case NodeKind::name:
      break;
    case NodeKind::tuple:
    case NodeKind::list:
      for (const NodePtr& item : static_cast<const SequenceNode&>(node).items) parts.push_back(item.get());
      break;
    case NodeKind::unary:
      parts = {static_cast<const UnaryNode&>(node).operand.get()};
      break;
    case NodeKind::binary: {
      const auto& binary = static_cast<const BinaryNode&>(node);
      parts = {binary.left.get(), binary.right.get()};
      break;
    }
    case NodeKind::logical:
      for (const NodePtr& operand : static_cast<const LogicalNode&>(node).operands) parts.push_back(operand.get());
      break;
    case NodeKind::compare: {
      const auto& compare = static_cast<const CompareNode&>(node);
      parts.push_back(compare.first.get());
      for (const auto& [op, operand] : compare.rest) parts.push_back(operand.get());
      break;
    }
    case NodeKind::conditional: {
      const auto& choice = static_cast<const ConditionalNode&>(node);
      parts = {choice.condition.get(), choice.then.get(), choice.otherwise.get()};
      break;
    }
    case NodeKind::call: {
      const auto& call = static_cast<const CallNode&>(node);
      parts.push_back(call.callee.get());
      for (const CallNode::Item& item : call.arguments) parts.push_back(item.value.get());
      break;
    }
    case NodeKind::attribute:
      parts = {static_cast<const AttributeNode&>(node).object.get()};
      break;
    case NodeKind::subscript: {
      const auto& subscript = static_cast<const SubscriptNode&>(node);
      parts = {subscript.object.get(), subscript.index.get()};
      break;
    }
    default:
      return std::nullopt;
  }
  return parts;
}

class Compiler {
 public:
  Compiler(const Expression& expression, const std::vector<std::string>& parameters, const FormulaBindings& bindings)
      : expression_(expression), parameters_(parameters), bindings_(bindings) {}

  FormulaProgram run() {
    compile(expression_.root());
    program_.depth = static_cast<std::size_t>(deepest_);
    if (program_.depth > deepest_stack) throw Unsuitable();
    return std::move(program_);
  }

 private:
  /// What a node gives. It matters only for the sign of a zero, which Python's integers do not have.
  enum class Gives { real, integer };

  Gives compile(const Node& node) {
    if (is_constant(node)) return push(folded(node));
    switch (node.kind) {
      case NodeKind::name:
        return compile_argument(static_cast<const NameNode&>(node));
      case NodeKind::unary:
        return compile_unary(static_cast<const UnaryNode&>(node));
      case NodeKind::binary:
        return compile_binary(static_cast<const BinaryNode&>(node));
      case NodeKind::logical:
        return compile_logical(static_cast<const LogicalNode&>(node));
      case NodeKind::compare:
        return compile_compare(static_cast<const CompareNode&>(node));
      case NodeKind::conditional:
        return compile_conditional(static_cast<const ConditionalNode&>(node));
      case NodeKind::call:
        return compile_call(static_cast<const CallNode&>(node));
      default:
        throw Unsuitable();
    }
  }

  int parameter(std::string_view name) const {
    const auto found = std::find(parameters_.begin(), parameters_.end(), name);
    return found == parameters_.end() ? -1 : static_cast<int>(found - parameters_.begin());
  }

  /// Neither a parameter nor what may change occurs: a function of the file may count its calls, or read a variable
  /// that is set later.
  bool is_constant(const Node& node) const {
    if (node.kind == NodeKind::name) {
      const auto& name = static_cast<const NameNode&>(node);
      if (parameter(name.id) >= 0) return false;
      const auto bound = bindings_.find(name.id);
      return bound == bindings_.end() || !may_change(bound->second);
    }
    const auto parts = parts_of(node);
    return parts && std::all_of(parts->begin(), parts->end(), [&](const Node* part) { return is_constant(*part); });
  }

  Value value_of(const Node& node) const {
    struct NoCommands : CommandHost {
      bool is_command(std::string_view) const override { return false; }
      std::vector<std::string> command_names() const override { return {}; }
      Value call(const CommandCall&, bool) override { throw Unsuitable(); }
      bool force(const ConceptPtr& handle) override { return handle->data != nullptr; }
    } host;
    Diagnostics diagnostics;
    Evaluator evaluator(host, diagnostics, [](std::string_view) {});
    return evaluator.evaluate(node, expression_.file(), [&](std::string_view name) -> std::optional<Value> {
      const auto bound = bindings_.find(name);
      return bound == bindings_.end() ? std::nullopt : std::optional(bound->second);
    });
  }

  Value folded(const Node& node) const {
    Value value = value_of(node);
    if (value.is_bool()) return Value(static_cast<std::int64_t>(value.as_bool()));
    if (!value.is_number() || value.is_big_integer()) throw Unsuitable();
    return value;
  }

  FormulaInstruction& emit(FormulaOp op, int effect) {
    if (program_.instructions.size() >= longest_program) throw Unsuitable();
    height_ += effect;
    deepest_ = std::max(deepest_, height_);
    FormulaInstruction& made = program_.instructions.emplace_back();
    made.op = op;
    return made;
  }

  Gives push(const Value& number) {
    emit(FormulaOp::number, 1).number = number.as_real();
    return number.is_integer() ? Gives::integer : Gives::real;
  }

  /// Ends an operation on integers: there is no negative zero.
  Gives integer_result() {
    emit(FormulaOp::unary, 0).unary = whole;
    return Gives::integer;
  }

  std::size_t emit_jump(FormulaOp op, int effect) {
    emit(op, effect);
    return program_.instructions.size() - 1;
  }

  void land(std::size_t jump) {
    program_.instructions[jump].index = static_cast<std::uint32_t>(program_.instructions.size());
  }

  Gives compile_argument(const NameNode& name) {
    const int index = parameter(name.id);
    if (index < 0) throw Unsuitable();
    emit(FormulaOp::argument, 1).index = static_cast<std::uint32_t>(index);
    return Gives::real;
  }

  Gives compile_unary(const UnaryNode& node) {
    const Gives operand = compile(*node.operand);
    if (node.op == Operator::plus) return operand;
    if (node.op == Operator::logical_not) {
      emit(FormulaOp::logical_not, 0);
      return Gives::integer;
    }
    if (node.op != Operator::minus) throw Unsuitable();
    emit(FormulaOp::negate, 0);
    return operand == Gives::integer ? integer_result() : Gives::real;
  }

  Gives compile_binary(const BinaryNode& node) {
    const Gives left = compile(*node.left);
    const Gives right = compile(*node.right);
    emit_arithmetic(node.op);
    const bool integer = left == Gives::integer && right == Gives::integer;
    const bool stays = node.op != Operator::divide && node.op != Operator::power;
    return integer && stays ? integer_result() : Gives::real;
  }

  void emit_arithmetic(Operator op) {
    switch (op) {
      case Operator::add:
        emit(FormulaOp::add, -1);
        break;
      case Operator::subtract:
        emit(FormulaOp::subtract, -1);
        break;
      case Operator::multiply:
        emit(FormulaOp::multiply, -1);
        break;
      case Operator::divide:
        emit(FormulaOp::divide, -1);
        break;
      case Operator::floor_divide:
        emit(FormulaOp::floor_divide, -1);
        break;
      case Operator::modulo:
        emit(FormulaOp::modulo, -1);
        break;
      case Operator::power:
        emit(FormulaOp::power, -1);
        break;
      default:
        throw Unsuitable();
    }
  }

  void compile_comparison(Operator op, const Node& left, const Node& right) {
    compile(left);
    compile(right);
    switch (op) {
      case Operator::less:
        emit(FormulaOp::less, -1);
        break;
      case Operator::less_equal:
        emit(FormulaOp::less_equal, -1);
        break;
      case Operator::greater:
        emit(FormulaOp::greater, -1);
        break;
      case Operator::greater_equal:
        emit(FormulaOp::greater_equal, -1);
        break;
      case Operator::equal:
        emit(FormulaOp::equal, -1);
        break;
      case Operator::not_equal:
        emit(FormulaOp::not_equal, -1);
        break;
      default:
        throw Unsuitable();
    }
  }

  /// a < b < c is a < b and b < c.
  Gives compile_compare(const CompareNode& node) {
    std::vector<std::size_t> jumps;
    const Node* left = node.first.get();
    for (const auto& [op, right] : node.rest) {
      compile_comparison(op, *left, *right);
      left = right.get();
      if (&right != &node.rest.back().second) jumps.push_back(emit_jump(FormulaOp::keep_if_false, -1));
    }
    for (const std::size_t jump : jumps) land(jump);
    return Gives::integer;
  }

  Gives compile_logical(const LogicalNode& node) {
    std::vector<std::size_t> jumps;
    const FormulaOp op = node.conjunction ? FormulaOp::keep_if_false : FormulaOp::keep_if_true;
    bool integer = true;
    for (const NodePtr& operand : node.operands) {
      integer = compile(*operand) == Gives::integer && integer;
      if (&operand != &node.operands.back()) jumps.push_back(emit_jump(op, -1));
    }
    for (const std::size_t jump : jumps) land(jump);
    return integer ? Gives::integer : Gives::real;
  }

  Gives compile_conditional(const ConditionalNode& node) {
    compile(*node.condition);
    const std::size_t to_otherwise = emit_jump(FormulaOp::jump_if_false, -1);
    const Gives then = compile(*node.then);
    const std::size_t to_end = emit_jump(FormulaOp::jump, -1);  // the other branch starts one lower
    land(to_otherwise);
    const Gives otherwise = compile(*node.otherwise);
    land(to_end);
    return then == otherwise ? then : Gives::real;
  }

  Gives compile_call(const CallNode& node) {
    if (!is_constant(*node.callee) && node.callee->kind != NodeKind::name) throw Unsuitable();
    if (node.arguments.empty() || node.arguments.size() > deepest_stack) throw Unsuitable();
    const Value callee = callee_of(*node.callee);
    for (const CallNode::Item& item : node.arguments) {
      if (item.kind != CallNode::Kind::positional) throw Unsuitable();
      compile(*item.value);
    }
    return emit_call(callee, static_cast<std::uint16_t>(node.arguments.size()));
  }

  Value callee_of(const Node& node) const {
    if (node.kind != NodeKind::name) return value_of(node);
    const auto& name = static_cast<const NameNode&>(node);
    const auto bound = bindings_.find(name.id);
    return bound == bindings_.end() ? value_of(node) : bound->second;
  }

  FormulaInstruction& emit_counted(FormulaOp op, std::uint16_t count) {
    FormulaInstruction& made = emit(op, 1 - static_cast<int>(count));
    made.count = count;
    return made;
  }

  Gives emit_call(const Value& callee, std::uint16_t count) {
    if (const auto* builtin = callee.as_object<BuiltinObject>()) return emit_builtin(builtin->name, count);
    if (const auto* type = callee.as_object<TypeObject>()) return emit_conversion(type->name, count);
    if (const auto* function = callee.as_object<FunctionObject>()) {
      emit_counted(FormulaOp::file_function, count).index = static_cast<std::uint32_t>(program_.file_functions.size());
      program_.file_functions.push_back(function);
      return Gives::real;
    }
    const RealFunction* function =
        callee.is_concept() && callee.as_concept()->data ? callee.as_concept()->data->real_function() : nullptr;
    if (function == nullptr || std::max<std::size_t>(function->parameters().size(), 1) != count) throw Unsuitable();
    emit_counted(FormulaOp::concept_function, count).index =
        static_cast<std::uint32_t>(program_.concept_functions.size());
    program_.concept_functions.push_back(function);
    return Gives::real;
  }

  Gives emit_builtin(const std::string& name, std::uint16_t count) {
    if ((name == "min" || name == "max") && count > 1) {
      emit_counted(name == "min" ? FormulaOp::minimum : FormulaOp::maximum, count);
      return Gives::real;
    }
    if (const Binary function = find_in(binary_functions, name); function != nullptr && count == 2) {
      emit(FormulaOp::binary, -1).binary = function;
      return Gives::real;
    }
    const Unary function = name == "round" ? rounded : find_in(unary_functions, name);
    if (function == nullptr || count != 1) throw Unsuitable();
    emit(FormulaOp::unary, 0).unary = function;
    return function == floor_of || function == ceil_of || function == truncated || function == rounded ? Gives::integer
                                                                                                       : Gives::real;
  }

  Gives emit_conversion(const std::string& type, std::uint16_t count) {
    if (count != 1 || (type != "int" && type != "float")) throw Unsuitable();
    emit(FormulaOp::unary, 0).unary = type == "int" ? truncated : same;
    return type == "int" ? Gives::integer : Gives::real;
  }

  const Expression& expression_;
  const std::vector<std::string>& parameters_;
  const FormulaBindings& bindings_;
  FormulaProgram program_;
  int height_ = 0;
  int deepest_ = 0;
};

}  // namespace

FormulaProgram compile_formula(const Expression& expression, const std::vector<std::string>& parameters,
                               const FormulaBindings& bindings) {
  try {
    return Compiler(expression, parameters, bindings).run();
  } catch (const Unsuitable&) {
    return {};
  } catch (const DiagnosticError&) {
    return {};  // a constant part fails: so will the tree, each time that it comes to that part
  } catch (const std::runtime_error&) {
    return {};  // a function is not defined where a constant part asks for it: likewise
  }
}

}  // namespace comma::interpreter
