// Imports and attributes: which modules there are, and what lies in a value behind a dot.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "interpreter/evaluation/evaluator.hpp"
#include "interpreter/failure_messages.hpp"
#include "interpreter/library/builtins.hpp"
#include "interpreter/values/array.hpp"
#include "interpreter/values/dtype.hpp"
#include "interpreter/values/host_object.hpp"
#include "interpreter/values/operations.hpp"

namespace comma::interpreter {

namespace {

Value module_value(const std::shared_ptr<ModuleObject>& module) { return Value(std::shared_ptr<Object>(module)); }

std::optional<Value> exception_attribute(const ExceptionObject& error, std::string_view name) {
  if (name == "args") return Value::tuple(error.arguments);
  if (name == "id_message" && error.failure) return Value(std::string(message_id_of(error.failure->code)));
  if (name == "message" || name == "msg") return Value(error.text());
  if (name == "code" && error.kind == ErrorKind::system_exit)
    return error.arguments.empty() ? Value() : error.arguments[0];
  return std::nullopt;
}

std::optional<Value> number_attribute(const Value& value, std::string_view name) {
  if (name == "real")
    return value.is_complex() ? Value(value.as_complex().real()) : unary_operation(Operator::plus, value);
  if (name == "imag")
    return value.is_complex() ? Value(value.as_complex().imag()) : value.is_real() ? Value(0.0) : Value(0);
  if (name == "numerator" && integer_of(value)) return unary_operation(Operator::plus, value);
  if (name == "denominator" && integer_of(value)) return Value(1);
  return std::nullopt;
}

std::optional<Value> array_attribute(const ArrayObject& array, std::string_view name) {
  if (name == "size") return Value(static_cast<std::int64_t>(array.size()));
  if (name == "ndim") return Value(static_cast<std::int64_t>(array.shape.size()));
  if (name == "T") return transposed(array);
  if (name == "dtype") return dtype_value(array.type);
  if (name != "shape") return std::nullopt;
  std::vector<Value> lengths;
  for (std::size_t length : array.shape) lengths.emplace_back(static_cast<std::int64_t>(length));
  return Value::tuple(std::move(lengths));
}

std::optional<Value> data_attribute(const Value& value, std::string_view name) {
  if (is_numeric(value)) return number_attribute(value, name);
  if (const auto* error = value.as_object<ExceptionObject>()) return exception_attribute(*error, name);
  if (const auto* array = value.as_object<ArrayObject>()) return array_attribute(*array, name);
  if (name == "__name__") {
    if (const auto* type = value.as_object<TypeObject>()) return Value(type->name);
    if (const auto* type = value.as_object<ExceptionClassObject>())
      return Value(std::string(class_of(type->kind).name));
    if (const auto* function = value.as_object<FunctionObject>()) return Value(function->code->name);
    if (const auto* function = value.as_object<BuiltinObject>()) return Value(function->name);
  }
  if (const auto* function = value.as_object<BuiltinObject>();
      function != nullptr && function->name == "chain" && name == "from_iterable")
    return Value(std::shared_ptr<Object>(std::make_shared<BuiltinObject>("from_iterable", chain_of)));
  if (const auto* range = value.as_object<RangeObject>()) {
    if (name == "start") return Value(range->start);
    if (name == "stop") return Value(range->stop);
    if (name == "step") return Value(range->step);
  }
  return std::nullopt;
}

/// What every concept has, whatever its data.
bool is_common_attribute(std::string_view name) {
  return name == "name" || name == "nom" || name == "userName" || name == "getName";
}

/// type(e).__name__ works for every value: what type() gives is a TypeObject or an exception class.
Value type_attribute_owner(const TypeObject& type) {
  if (type.name == "str") return Value("");
  if (type.name == "list") return Value::list({});
  if (type.name == "tuple") return Value::tuple({});
  if (type.name == "dict") return Value::dict({});
  if (type.name == "float") return Value(0.0);
  return Value();
}

}  // namespace

Value Evaluator::has_attribute(const ConceptPtr& handle, const std::string& name) {
  if (is_common_attribute(name) || source_behind(*handle, name)) return Value(true);
  return with_host([&]() -> Value {
    if (!host_.force(handle)) return Value::unknown();
    const std::vector<std::string> names = handle->data->method_names();
    return Value(std::find(names.begin(), names.end(), name) != names.end());
  });
}

Value Evaluator::attribute(const Value& object, const std::string& name) {
  if (object.is_unknown()) return object;
  if (auto* thing = object.as_object<AbsentObject>()) return use_absent(*thing, thing->path + "." + name);
  if (const auto* module = object.as_object<ModuleObject>()) {
    if (const auto member = module->members.find(name); member != module->members.end()) return member->second;
    if (auto inner = find_module(module->name + "." + name)) return module_value(inner);
    if (module->brings_commands && host_.is_command(name))
      return Value(std::shared_ptr<Object>(std::make_shared<CommandObject>(name)));
    std::vector<std::string> names;
    for (const auto& [member, value] : module->members) names.push_back(member);
    std::string hint = did_you_mean(name, names);
    if (hint.empty()) hint = "comma has only a part of this module";
    raise(ErrorKind::attribute, fmt::format("module '{}' has no attribute '{}'", module->name, name), std::move(hint));
  }
  if (object.is_concept()) {
    if (name == "name" || name == "nom" || name == "userName") return Value(object.as_concept()->name);
    return Value(std::shared_ptr<Object>(std::make_shared<ConceptMethod>(object.as_concept(), name)));
  }
  if (const auto* foreign = object.as_object<HostObject>()) {
    if (auto value = foreign->attribute(name)) return *value;
    raise(ErrorKind::attribute, fmt::format("'{}' object has no attribute '{}'", object.type_name(), name),
          did_you_mean(name, foreign->attribute_names()));
  }
  if (auto value = data_attribute(object, name)) return *value;
  if (const Method method = find_method(object, name)) {
    return Value(std::shared_ptr<Object>(std::make_shared<BoundMethod>(object, name, method)));
  }
  if (const auto* type = object.as_object<TypeObject>()) {
    if (type->name == "dict" && name == "fromkeys") return attribute(Value::dict({}), name);
    // str.upper(text): the method with its object as first argument.
    if (const Method method = find_method(type_attribute_owner(*type), name)) {
      return Value(std::shared_ptr<Object>(std::make_shared<UnboundMethod>(name, method)));
    }
    raise(ErrorKind::attribute, fmt::format("type object '{}' has no attribute '{}'", type->name, name));
  }
  raise(ErrorKind::attribute, fmt::format("'{}' object has no attribute '{}'", object.type_name(), name),
        did_you_mean(name, method_names(object)));
}

namespace {

/// Why a module is left out whose use does not say it.
std::string_view reason_of(std::string_view module) {
  const std::string_view first = module.substr(0, module.find('.'));
  for (const std::string_view clock : {"time", "datetime", "timeit"})
    if (first == clock) return "a command file knows no clock";
  for (const std::string_view outside :
       {"subprocess", "shutil", "glob", "pathlib", "tempfile", "socket", "pickle", "io"})
    if (first == outside)
      return "a command file reaches no file, process or network: use LIRE_*, IMPR_* and the units of the .export";
  return "a command file may import math, numpy (a part), copy, itertools, functools, operator, collections, string, "
         "and the modules of code_aster";
}

std::shared_ptr<ExceptionObject> no_module(const std::string& path, const Span& span) {
  std::string hint = did_you_mean(path, module_names());
  if (hint.empty()) hint = reason_of(path);
  auto error = make_exception(ErrorKind::module_not_found, fmt::format("No module named '{}'", path), std::move(hint));
  error->span = span;
  return error;
}

}  // namespace

/// Within a `try` the import itself fails, as in Python: there the file asks whether the module is there.
Value Evaluator::absent(std::string path, bool whole, std::shared_ptr<ExceptionObject> error) const {
  if (tries_ > 0) throw RaisedError(std::move(error));
  return Value(std::shared_ptr<Object>(std::make_shared<AbsentObject>(std::move(path), whole, std::move(error))));
}

Value Evaluator::use_absent(AbsentObject& thing, const std::string& path) {
  if (recovering() && std::exchange(thing.told, true)) return Value::unknown();
  auto error = std::make_shared<ExceptionObject>(*thing.error);
  if (error->kind == ErrorKind::module_not_found)
    error->arguments = {Value(fmt::format("{} cannot be used: {}", path, thing.error->text()))};
  error->span = Span();
  throw RaisedError(std::move(error));
}

Value Evaluator::import_module(const std::string& path, Span span) {
  if (auto module = find_module(path)) return module_value(module);
  return absent(path, true, no_module(path, span));
}

void Evaluator::execute_import(const ImportStatement& statement) {
  for (const auto& item : statement.items) {
    const Span span = span_of(item.begin, item.end);
    const Value module = import_module(item.path, span);
    const std::size_t dot = item.path.find('.');
    const bool whole = item.renamed || dot == std::string::npos;
    store(static_cast<const NameNode&>(*item.name), whole ? module : import_module(item.path.substr(0, dot), span));
  }
}

Value Evaluator::import_member(const Value& module, const ImportStatement& statement,
                               const ImportStatement::Item& item) {
  const std::string path = statement.module + "." + item.path;
  if (const auto* missing = module.as_object<AbsentObject>()) return absent(path, false, missing->error);
  try {
    return attribute(module, item.path);
  } catch (const RaisedError& error) {
    auto refused =
        make_exception(ErrorKind::import, fmt::format("cannot import name '{}' from '{}'", item.path, statement.module),
                       error.object()->hint);
    refused->span = span_of(item.begin, item.end);
    return absent(path, false, std::move(refused));
  }
}

void Evaluator::execute_import_from(const ImportStatement& statement) {
  const Value value = import_module(statement.module, span_of(statement.module_begin, statement.module_end));
  for (const auto& item : statement.items) {
    if (item.name) {
      store(static_cast<const NameNode&>(*item.name), import_member(value, statement, item));
      continue;
    }
    // Which names an absent module would bring nobody knows. The commands themselves are known without import.
    if (const auto* missing = value.as_object<AbsentObject>()) throw RaisedError(missing->error);
    for (const auto& [name, member] : value.as_object<ModuleObject>()->members) globals_[name] = member;
  }
}

}  // namespace comma::interpreter
