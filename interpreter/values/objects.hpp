// The kinds of value that only the evaluator works with.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "interpreter/syntax/ast.hpp"
#include "interpreter/values/dict.hpp"
#include "interpreter/values/exception.hpp"
#include "interpreter/values/value.hpp"

namespace comma::interpreter {

class Evaluator;

/// For destructors: releases what an object held once the destructor is over, so that a chain of objects that hold one
/// another (a function in the frame of a function in the frame ...) may be longer than the stack is deep.
void release_later(std::shared_ptr<void> held);

/// What stands in the brackets of a call, evaluated; *sequences and **mappings are spread.
struct CallArguments {
  struct Named {
    std::string name;
    Value value;
    Span name_span, value_span;
  };
  std::vector<Value> positional;
  std::vector<Named> named;
  bool open = false;  ///< there are further ones that are not known (those of an unknown **mapping)
  Span callee_span, span;
  std::string target;  ///< the variable that takes the value

  CallArguments() = default;
  explicit CallArguments(std::vector<Value> values) : positional(std::move(values)) {}

  std::size_t size() const { return positional.size(); }
  const Value& operator[](std::size_t index) const { return positional[index]; }
  const Value* find(std::string_view name) const;
  bool any_unknown() const;
};

using Builtin = Value (*)(Evaluator&, const CallArguments&);

struct BuiltinObject : Object {
  BuiltinObject(std::string word, Builtin code) : name(std::move(word)), function(code) {}
  std::string name;
  Builtin function;
  std::string type_name() const override { return "builtin_function_or_method"; }
  std::string repr() const override { return "<built-in function " + name + ">"; }
  bool is_callable() const override { return true; }
};

using Method = Value (*)(Evaluator&, const Value& self, const CallArguments&);

struct BoundMethod : Object {
  BoundMethod(Value object, std::string word, Method code)
      : self(std::move(object)), name(std::move(word)), method(code) {}
  Value self;
  std::string name;
  Method method;
  std::string type_name() const override { return "builtin_function_or_method"; }
  std::string repr() const override { return "<built-in method " + name + " of " + self.type_name() + " object>"; }
  bool is_callable() const override { return true; }
};

/// str.upper: the object comes as first argument.
struct UnboundMethod : Object {
  UnboundMethod(std::string word, Method code) : name(std::move(word)), method(code) {}
  std::string name;
  Method method;
  std::string type_name() const override { return "method_descriptor"; }
  std::string repr() const override { return "<method '" + name + "'>"; }
  bool is_callable() const override { return true; }
};

/// MA.getNumberOfNodes: which methods a concept has is known to its data only.
struct ConceptMethod : Object {
  ConceptMethod(ConceptPtr concept_handle, std::string word)
      : handle(std::move(concept_handle)), name(std::move(word)) {}
  ConceptPtr handle;
  std::string name;
  std::string type_name() const override { return "method"; }
  bool is_callable() const override { return true; }
};

/// A command as a value: NAME without a call.
struct CommandObject : Object {
  explicit CommandObject(std::string word) : name(std::move(word)) {}
  std::string name;
  std::string type_name() const override { return "command"; }
  std::string repr() const override { return name; }
  bool is_callable() const override { return true; }
  bool equals(const Object& other) const override;
};

/// The local variables of one call. Functions defined in it keep it alive.
struct Frame {
  std::shared_ptr<Frame> outer;
  std::vector<std::optional<Value>> slots;
};

/// Where a function belongs: its evaluator, or null when that is gone. A formula may outlive the statement that made
/// it.
struct FunctionHome {
  Evaluator* evaluator = nullptr;
};

struct FunctionObject : Object {
  FunctionObject() = default;
  ~FunctionObject() override;
  FunctionObject(const FunctionObject&) = delete;
  FunctionObject& operator=(const FunctionObject&) = delete;
  std::shared_ptr<const FunctionHome> home;
  std::shared_ptr<const FunctionCode> code;
  std::vector<Value> defaults;
  std::shared_ptr<Frame> outer;
  std::string type_name() const override { return "function"; }
  std::string repr() const override { return "<function " + code->name + ">"; }
  bool is_callable() const override { return true; }
};

/// int, str, list ...: called, they convert; isinstance compares them.
struct TypeObject : Object {
  explicit TypeObject(std::string word) : name(std::move(word)) {}
  std::string name;
  std::string type_name() const override { return "type"; }
  std::string repr() const override { return "<class '" + name + "'>"; }
  bool is_callable() const override { return true; }
  bool equals(const Object& other) const override;
  std::size_t hash() const override { return std::hash<std::string>{}(name); }
};

struct ModuleObject : Object {
  std::string name;
  std::map<std::string, Value, std::less<>> members;
  bool brings_commands = false;  ///< its other names are the commands
  std::string type_name() const override { return "module"; }
  std::string repr() const override { return "<module '" + name + "'>"; }
};

/// A module that comma does not have, or what a file imports out of one that does not have it. The import alone is no
/// error: many files import out of habit what they never use.
struct AbsentObject : Object {
  AbsentObject(std::string what, bool whole, std::shared_ptr<ExceptionObject> why)
      : path(std::move(what)), is_module(whole), error(std::move(why)) {}
  std::string path;  ///< "subprocess", "math.sinus"
  bool is_module;
  std::shared_ptr<ExceptionObject> error;  ///< what Python's import would raise
  bool told = false;                       ///< one mistake makes one error
  std::string type_name() const override { return "module"; }
  std::string repr() const override { return "<module '" + path + "'>"; }
};

struct RangeObject : Object {
  RangeObject(std::int64_t from, std::int64_t to, std::int64_t by) : start(from), stop(to), step(by) {}
  std::int64_t start, stop, step;
  std::int64_t size() const;
  std::int64_t at(std::int64_t index) const { return start + index * step; }
  std::string type_name() const override { return "range"; }
  std::string repr() const override;
  bool equals(const Object& other) const override;
};

struct SliceObject : Object {
  Value start, stop, step;
  std::string type_name() const override { return "slice"; }
  std::string repr() const override { return "slice(" + start.repr() + ", " + stop.repr() + ", " + step.repr() + ")"; }
};

/// d.keys(), d.values(), d.items(): they follow the dict.
struct DictView : Object {
  enum class Kind { keys, values, items };
  DictView(std::shared_ptr<Dict> mapping, Kind which) : dict(std::move(mapping)), kind(which) {}
  std::shared_ptr<Dict> dict;
  Kind kind;
  std::vector<Value> list() const;
  std::string type_name() const override;
  std::string repr() const override { return type_name() + "(" + Value::list(list()).repr() + ")"; }
  bool equals(const Object& other) const override;
};

/// What a loop draws values from.
struct Iterator : Object {
  explicit Iterator(std::string word) : name(std::move(word)) {}
  std::string name;
  std::string type_name() const override { return name; }
  std::string repr() const override { return "<" + name + " object>"; }
  /// The next value, or nothing at the end (and for ever after).
  virtual std::optional<Value> next() = 0;
};

/// An iterator from a function that gives the next value or nothing.
struct FunctionIterator : Iterator {
  FunctionIterator(std::string word, std::function<std::optional<Value>()> code)
      : Iterator(std::move(word)), function(std::move(code)) {}
  std::function<std::optional<Value>()> function;
  std::optional<Value> next() override;
};

Value make_iterator(std::string name, std::function<std::optional<Value>()> next);

/// Over anything that can be looped over; raises TypeError for the rest.
std::shared_ptr<Iterator> iterate(const Value& value);

}  // namespace comma::interpreter
