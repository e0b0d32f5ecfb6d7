// copy: a value of its own, flat or down to the bottom.
#include <array>
#include <unordered_map>

#include "interpreter/library/builtins.hpp"
#include "interpreter/values/array.hpp"
#include "interpreter/values/host_object.hpp"
#include "interpreter/values/operations.hpp"

namespace comma::interpreter {

namespace copying {

namespace {

constexpr int deepest_copied = 500;  // Python's own recursion ends at about as many levels

class Copying {
 public:
  Copying(Meter& meter, bool deep) : meter_(meter), deep_(deep) {}

  Value copy(const Value& value) {
    if (value.is_list()) return copy_list(value);
    if (value.is_dict()) return copy_dict(value);
    if (value.is_set()) return make_set(value.as_set().keys(), value.type_name() == "frozenset");
    if (value.is_tuple()) return deep_ ? Value::tuple(inner(value.items())) : value;
    if (value.is_concept())
      raise(ErrorKind::type, "a concept cannot be copied",
            "make another one by a command, or put the concept itself into a new list");
    if (const auto* array = value.as_object<ArrayObject>()) return make_value(array->numbers());
    if (value.as_object<Iterator>() != nullptr || value.as_object<HostObject>() != nullptr)
      raise(ErrorKind::type, "a '" + value.type_name() + "' object cannot be copied");
    return value;  // numbers, texts, functions: nothing changes them
  }

 private:
  /// What lies within: copied too where the copy goes deep. One thing met twice becomes one copy.
  Value part(const Value& value) {
    if (!deep_) return value;
    const void* identity = identity_of(value);
    if (const auto found = made_.find(identity); identity != nullptr && found != made_.end()) return found->second;
    if (++depth_ > deepest_copied) raise(ErrorKind::recursion, "maximum recursion depth exceeded");
    Value own = copy(value);
    --depth_;
    if (identity != nullptr) made_.emplace(identity, own);
    return own;
  }

  static const void* identity_of(const Value& value) {
    if (value.is_list()) return &value.as_list();
    if (value.is_dict()) return &value.as_dict();
    if (value.is_set()) return &value.as_set();
    return value.as_object<ArrayObject>();
  }

  std::vector<Value> inner(std::span<const Value> items) {
    meter_.allocate_items(items.size());
    std::vector<Value> own;
    for (const Value& item : items) own.push_back(part(item));
    return own;
  }

  Value copy_list(const Value& value) {
    Value own = Value::list({});
    if (deep_) made_.emplace(&value.as_list(), own);  // before what lies within: the list may hold itself
    own.as_list() = inner(std::vector<Value>(value.as_list()));
    return own;
  }

  Value copy_dict(const Value& value) {
    auto own = std::make_shared<Dict>();
    own->factory = value.as_dict().factory;
    own->factor = value.as_dict().factor;
    if (deep_) made_.emplace(&value.as_dict(), Value(own));
    meter_.allocate_items(2 * value.as_dict().size());
    for (const Value& key : value.as_dict().keys()) own->set(part(key), part(*value.as_dict().find(key)));
    return Value(std::move(own));
  }

  Meter& meter_;
  bool deep_;
  int depth_ = 0;
  std::unordered_map<const void*, Value> made_;
};

Value copy(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("copy", arguments, 1, 1);
  return Copying(evaluator.meter(), false).copy(arguments[0]);
}

Value deepcopy(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("deepcopy", arguments, 1, 1);
  return Copying(evaluator.meter(), true).copy(arguments[0]);
}

constexpr std::array table = {FunctionRow{"copy", copy}, FunctionRow{"deepcopy", deepcopy}};

}  // namespace

}  // namespace copying

std::span<const FunctionRow> copy_functions() { return copying::table; }

}  // namespace comma::interpreter
