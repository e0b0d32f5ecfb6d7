// What concepts give a file besides numbers and concepts, such as the rows of a table: the commands say what lies
// behind its dots.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "interpreter/syntax/ast.hpp"
#include "interpreter/values/value.hpp"

namespace comma::interpreter {

struct HostObject : Object {
  /// Nothing where there is none of this name.
  virtual std::optional<Value> attribute(std::string_view name) const = 0;
  /// All names, for hints.
  virtual std::vector<std::string> attribute_names() const = 0;
  /// What len() gives; nothing for an object without length.
  virtual std::optional<std::int64_t> length() const { return std::nullopt; }
  /// What ==, !=, <, <=, >, >= with a value on the right give; nothing: as for any object.
  virtual std::optional<Value> compared(Operator, const Value&) const { return std::nullopt; }
  /// What & and | with a value on the right give; nothing: as for any object.
  virtual std::optional<Value> combined(Operator, const Value&) const { return std::nullopt; }
  /// What lies at object[index]; nothing where nothing does.
  virtual std::optional<Value> item(const Value&) const { return std::nullopt; }
  /// The list that a loop over it runs through; nothing for an object without items.
  virtual std::optional<Value> iterated() const { return std::nullopt; }
  /// object[index] = value, and del object[index]; false where this is not possible.
  virtual bool store_item(const Value&, const Value&) { return false; }
  virtual bool delete_item(const Value&) { return false; }
};

class Evaluator;
struct CallArguments;

/// A method of such an object. Its code may throw DiagnosticError.
template <class Signature>
struct HostCallable : Object {
  using Code = std::function<Signature>;

  HostCallable(std::string word, Code what) : name(std::move(word)), code(std::move(what)) {}
  std::string name;
  Code code;
  std::string type_name() const override { return "method"; }
  std::string repr() const override { return "<method '" + name + "'>"; }
  bool is_callable() const override { return true; }
};

/// One that takes keywords, or calls functions of the file.
using HostMethod = HostCallable<Value(Evaluator&, const CallArguments& arguments)>;
/// One without keywords.
using HostFunction = HostCallable<Value(const std::vector<Value>& arguments)>;

}  // namespace comma::interpreter
