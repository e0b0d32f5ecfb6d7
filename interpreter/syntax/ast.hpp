// The tree of a file. The parser builds it and decides which variable each name means; the evaluator walks it.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "interpreter/source.hpp"
#include "interpreter/values/value.hpp"

namespace comma::interpreter {

enum class Operator {
  add,
  subtract,
  multiply,
  divide,
  floor_divide,
  modulo,
  power,
  matrix_multiply,
  left_shift,
  right_shift,
  bit_and,
  bit_or,
  bit_xor,
  plus,
  minus,
  invert,
  logical_not,
  less,
  less_equal,
  greater,
  greater_equal,
  equal,
  not_equal,
  in,
  not_in,
  is,
  is_not,
};
std::string_view symbol_of(Operator op);

enum class NodeKind {
  constant,
  name,
  formatted,
  tuple,
  list,
  set,
  dict,
  unary,
  binary,
  logical,
  compare,
  conditional,
  lambda,
  comprehension,
  call,
  attribute,
  subscript,
  slice,
  starred,
  broken,
};

/// An expression. `depth` is the height of the tree below it: the parser bounds it, so that walking it needs bounded
/// stack.
struct Node {
  Node(NodeKind which, std::uint32_t from, std::uint32_t to) : kind(which), begin(from), end(to) {}
  virtual ~Node() = default;
  NodeKind kind;
  std::uint32_t begin;
  std::uint32_t end;
  int depth = 1;
  bool parenthesised = false;
};
using NodePtr = std::unique_ptr<Node>;

struct ConstantNode : Node {
  ConstantNode(Value content, std::uint32_t from, std::uint32_t to)
      : Node(NodeKind::constant, from, to), value(std::move(content)) {}
  Value value;
};

/// A variable. Local ones live in slot `slot` of the function `hops` functions further out; global ones are found by
/// name.
struct NameNode : Node {
  NameNode(std::string word, std::uint32_t from, std::uint32_t to)
      : Node(NodeKind::name, from, to), id(std::move(word)) {}
  std::string id;
  bool global = true;
  int hops = 0;
  int slot = -1;
};

/// An f-string: texts and replacement fields in turn.
struct FormattedNode : Node {
  using Node::Node;
  struct Piece {
    std::string text;     ///< stands before the field
    NodePtr value;        ///< null: there is no field, only text
    char conversion = 0;  ///< 'r', 's', 'a' or 0
    NodePtr format;       ///< a FormattedNode or null
  };
  std::vector<Piece> pieces;
};

/// Tuple, list or set display.
struct SequenceNode : Node {
  using Node::Node;
  std::vector<NodePtr> items;
};

/// A pair without key is **mapping.
struct DictNode : Node {
  using Node::Node;
  std::vector<std::pair<NodePtr, NodePtr>> items;
};

struct UnaryNode : Node {
  using Node::Node;
  Operator op = Operator::plus;
  NodePtr operand;
};

struct BinaryNode : Node {
  using Node::Node;
  Operator op = Operator::add;
  NodePtr left, right;
};

/// `a and b and c`, `a or b or c`.
struct LogicalNode : Node {
  using Node::Node;
  bool conjunction = true;
  std::vector<NodePtr> operands;
};

struct CompareNode : Node {
  using Node::Node;
  NodePtr first;
  std::vector<std::pair<Operator, NodePtr>> rest;
};

struct ConditionalNode : Node {
  using Node::Node;
  NodePtr condition, then, otherwise;
};

struct CallNode : Node {
  using Node::Node;
  enum class Kind { positional, spread, keyword, spread_keywords };
  struct Item {
    Kind kind = Kind::positional;
    std::string name;
    std::uint32_t name_begin = 0, name_end = 0;
    NodePtr value;
    /// An argument before it has the same name, which has been reported: this one does not count.
    bool repeated = false;
  };
  NodePtr callee;
  std::vector<Item> arguments;
};

struct AttributeNode : Node {
  using Node::Node;
  NodePtr object;
  std::string name;
  std::uint32_t name_begin = 0;
};

struct SubscriptNode : Node {
  using Node::Node;
  NodePtr object, index;
};

struct SliceNode : Node {
  using Node::Node;
  NodePtr start, stop, step;
};

struct StarredNode : Node {
  using Node::Node;
  NodePtr value;
};

struct FunctionCode;

struct LambdaNode : Node {
  using Node::Node;
  std::shared_ptr<const FunctionCode> code;
  std::vector<NodePtr> defaults;
};

/// A comprehension is a small function of its own; only its first iterable is evaluated outside.
struct ComprehensionNode : Node {
  using Node::Node;
  enum class Kind { list, set, dict, generator };
  struct Clause {
    NodePtr target, iterable;
    std::vector<NodePtr> conditions;
  };
  Kind produces = Kind::list;
  NodePtr element, value;  ///< `value` only for a dict
  std::vector<Clause> clauses;
  std::vector<std::string> slots;
};

enum class StatementKind {
  expression,
  assign,
  augmented,
  if_,
  while_,
  for_,
  function,
  return_,
  pass,
  break_,
  continue_,
  del,
  assert_,
  try_,
  with_,
  raise,
  import,
  import_from,
  broken,
};

struct Statement {
  Statement(StatementKind which, std::uint32_t from, std::uint32_t to) : kind(which), begin(from), end(to) {}
  virtual ~Statement() = default;
  StatementKind kind;
  std::uint32_t begin;
  std::uint32_t end;
};
using StatementPtr = std::unique_ptr<Statement>;
using Block = std::vector<StatementPtr>;

/// pass, break, continue: no contents.
struct PlainStatement : Statement {
  using Statement::Statement;
};

/// An expression, `return value`, `del targets` (value is the target or a tuple of them).
struct ValueStatement : Statement {
  using Statement::Statement;
  NodePtr value;  ///< may be null in `return`
};

/// a = b = value; an annotated one has one target and perhaps no value.
struct AssignStatement : Statement {
  using Statement::Statement;
  std::vector<NodePtr> targets;
  NodePtr value;
};

struct AugmentedStatement : Statement {
  using Statement::Statement;
  NodePtr target, value;
  Operator op = Operator::add;
};

struct IfStatement : Statement {
  using Statement::Statement;
  std::vector<std::pair<NodePtr, Block>> branches;
  Block otherwise;
};

struct WhileStatement : Statement {
  using Statement::Statement;
  NodePtr condition;
  Block body, otherwise;
};

struct ForStatement : Statement {
  using Statement::Statement;
  NodePtr target, iterable;
  Block body, otherwise;
};

struct FunctionStatement : Statement {
  using Statement::Statement;
  NodePtr name;  ///< a NameNode
  std::shared_ptr<const FunctionCode> code;
  std::vector<NodePtr> defaults;
};

struct AssertStatement : Statement {
  using Statement::Statement;
  NodePtr condition, message;
};

struct RaiseStatement : Statement {
  using Statement::Statement;
  NodePtr error, cause;
};

struct TryStatement : Statement {
  using Statement::Statement;
  struct Handler {
    NodePtr type;  ///< null catches all
    NodePtr name;  ///< a NameNode or null
    Block body;
  };
  Block body;
  std::vector<Handler> handlers;
  Block otherwise, finally;
};

/// with manager as target: body
struct WithStatement : Statement {
  using Statement::Statement;
  NodePtr manager;
  NodePtr target;  ///< or null
  Block body;
};

struct ImportStatement : Statement {
  using Statement::Statement;
  struct Item {
    std::string path;
    NodePtr name;  ///< what it is bound to, a NameNode; null for `*`
    bool renamed = false;
    std::uint32_t begin = 0, end = 0;
  };
  std::string module;  ///< of `from module import ...`
  std::uint32_t module_begin = 0, module_end = 0;
  std::vector<Item> items;
};

/// What could not be read, and has been reported. What it would have bound is unknown from here on.
struct BrokenStatement : Statement {
  using Statement::Statement;
  std::vector<NodePtr> names;   ///< NameNodes
  bool loses_any_name = false;  ///< names that nobody can tell, too
};

/// A parameter takes the slot of its index. Defaults are matched by `default_index` into the list made at definition.
struct Parameter {
  enum class Kind { normal, rest, keyword_only, keywords };
  std::string name;
  Kind kind = Kind::normal;
  int default_index = -1;
  bool positional_only = false;
};

/// A name that a function uses and does not bind itself. A local one of a function around it lies `name->hops - level`
/// frames further out than the frame in which the function was made.
struct OuterUse {
  const NameNode* name = nullptr;
  int level = 0;
};

/// A def or a lambda: it lives as long as a function value refers to it, whatever becomes of its file's tree.
struct FunctionCode {
  std::string name;
  std::shared_ptr<const SourceFile> file;
  std::vector<Parameter> parameters;
  std::vector<std::string> slots;  ///< names of the local variables; parameters first
  std::vector<OuterUse> outer_uses;
  bool changes_outer = false;  ///< it binds variables of the file or of a function around it
  Block body;
  NodePtr result;  ///< of a lambda
};

/// A whole file. Functions keep their own code alive, so it may be dropped after it has run.
struct Ast {
  std::shared_ptr<const SourceFile> file;
  Block statements;
};

}  // namespace comma::interpreter
