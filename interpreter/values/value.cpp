#include "interpreter/values/value.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include "interpreter/values/big_integer.hpp"
#include "interpreter/values/dict.hpp"
#include "interpreter/values/repr.hpp"

namespace comma::interpreter {

namespace {

/// Moves the children of a container that nobody else holds to the list of what is still to be released.
void take_children(Value& value, std::vector<Value>& pending) {
  const auto& storage = value.storage();
  if (const auto* tuple = std::get_if<std::shared_ptr<Tuple>>(&storage); tuple && tuple->use_count() == 1) {
    for (Value& item : (*tuple)->items) pending.push_back(std::move(item));
    (*tuple)->items.clear();
  } else if (const auto* list = std::get_if<std::shared_ptr<List>>(&storage); list && list->use_count() == 1) {
    for (Value& item : (*list)->items) pending.push_back(std::move(item));
    (*list)->items.clear();
  } else if (const auto* dict = std::get_if<std::shared_ptr<Dict>>(&storage); dict && dict->use_count() == 1) {
    for (Value& item : (*dict)->values()) pending.push_back(std::move(item));
    (*dict)->clear();
  }
}

/// Releases values without recursion: a list in a list in a list ... may be deeper than the stack.
void release(std::vector<Value> pending) {
  while (!pending.empty()) {
    Value value = std::move(pending.back());
    pending.pop_back();
    take_children(value, pending);
  }
}

bool is_container(const Value& value) { return value.is_sequence() || value.is_dict(); }

[[noreturn]] void throw_wrong_type(const Value& value, const char* wanted) {
  throw std::logic_error(fmt::format("a value of type {} was read as {}", value.type_name(), wanted));
}

template <class T>
const T& get(const Value& value, const char* wanted) {
  const T* content = std::get_if<T>(&value.storage());
  if (content == nullptr) throw_wrong_type(value, wanted);
  return *content;
}

}  // namespace

std::string Object::repr() const { return "<" + type_name() + ">"; }

Sequence::Sequence(std::vector<Value> values) : items(std::move(values)) {}

Sequence::~Sequence() {
  for (const Value& item : items) {
    if (!is_container(item)) continue;
    release(std::move(items));
    break;
  }
}

Dict::~Dict() {
  for (const Entry& entry : entries_) {
    if (!is_container(entry.value)) continue;
    std::vector<Value> children = values();
    clear();
    release(std::move(children));
    break;
  }
}

Value::Value() = default;
Value::Value(bool value) : storage_(value) {}
Value::Value(std::int64_t value) : storage_(value) {}
Value::Value(double value) : storage_(value) {}
Value::Value(std::complex<double> value) : storage_(value) {}
Value::Value(std::string text) : storage_(std::make_shared<const std::string>(std::move(text))) {}
Value::Value(ConceptPtr handle) : storage_(std::move(handle)) {}
Value::Value(std::shared_ptr<Tuple> sequence) : storage_(std::move(sequence)) {}
Value::Value(std::shared_ptr<List> sequence) : storage_(std::move(sequence)) {}
Value::Value(std::shared_ptr<Dict> mapping) : storage_(std::move(mapping)) {}
Value::Value(std::shared_ptr<Set> set) : storage_(std::move(set)) {}
Value::Value(std::shared_ptr<Object> object) : storage_(std::move(object)) {}

Value Value::tuple(std::vector<Value> items) { return Value(std::make_shared<Tuple>(std::move(items))); }
Value Value::list(std::vector<Value> items) { return Value(std::make_shared<List>(std::move(items))); }

Value Value::dict(std::vector<std::pair<std::string, Value>> items) {
  auto mapping = std::make_shared<Dict>();
  for (auto& [key, value] : items) mapping->set(Value(std::move(key)), std::move(value));
  return Value(std::move(mapping));
}

Value Value::integer(BigInteger value) {
  if (value.fits_int64()) return Value(value.to_int64());
  return Value(Storage(std::make_shared<const BigInteger>(std::move(value))));
}

Value Value::unknown() { return Value(Storage(Unknown{})); }

bool Value::is_unknown() const { return std::holds_alternative<Unknown>(storage_); }
bool Value::is_none() const { return std::holds_alternative<std::monostate>(storage_); }
bool Value::is_bool() const { return std::holds_alternative<bool>(storage_); }
bool Value::is_integer() const { return std::holds_alternative<std::int64_t>(storage_); }
bool Value::is_big_integer() const { return std::holds_alternative<std::shared_ptr<const BigInteger>>(storage_); }
bool Value::is_real() const { return std::holds_alternative<double>(storage_); }
bool Value::is_number() const { return is_integer() || is_real() || is_big_integer(); }
bool Value::is_complex() const { return std::holds_alternative<std::complex<double>>(storage_); }
bool Value::is_text() const { return std::holds_alternative<std::shared_ptr<const std::string>>(storage_); }
bool Value::is_tuple() const { return std::holds_alternative<std::shared_ptr<Tuple>>(storage_); }
bool Value::is_list() const { return std::holds_alternative<std::shared_ptr<List>>(storage_); }
bool Value::is_sequence() const { return is_tuple() || is_list(); }
bool Value::is_dict() const { return std::holds_alternative<std::shared_ptr<Dict>>(storage_); }
bool Value::is_set() const { return std::holds_alternative<std::shared_ptr<Set>>(storage_); }
bool Value::is_factor() const { return is_dict() && as_dict().factor != nullptr; }
bool Value::is_concept() const { return std::holds_alternative<ConceptPtr>(storage_); }

bool Value::is_callable() const {
  const auto* object = std::get_if<std::shared_ptr<Object>>(&storage_);
  return object != nullptr && (*object)->is_callable();
}

bool Value::as_bool() const { return get<bool>(*this, "bool"); }
std::int64_t Value::as_integer() const { return get<std::int64_t>(*this, "int"); }

double Value::as_real() const {
  if (is_integer()) return static_cast<double>(as_integer());
  if (is_big_integer()) return as_big_integer().to_double();
  return get<double>(*this, "float");
}

std::complex<double> Value::as_complex() const {
  if (is_number()) return as_real();
  return get<std::complex<double>>(*this, "complex");
}

const std::string& Value::as_text() const { return *get<std::shared_ptr<const std::string>>(*this, "str"); }

std::span<const Value> Value::items() const {
  if (is_list()) return as_list();
  return get<std::shared_ptr<Tuple>>(*this, "tuple")->items;
}

const ConceptPtr& Value::as_concept() const { return get<ConceptPtr>(*this, "concept"); }
const BigInteger& Value::as_big_integer() const { return *get<std::shared_ptr<const BigInteger>>(*this, "int"); }
Dict& Value::as_dict() const { return *get<std::shared_ptr<Dict>>(*this, "dict"); }
Dict& Value::as_set() const { return *get<std::shared_ptr<Set>>(*this, "set")->keys; }
std::vector<Value>& Value::as_list() const { return get<std::shared_ptr<List>>(*this, "list")->items; }

std::string Value::type_name() const {
  if (is_concept()) return as_concept()->type;
  if (const auto* object = std::get_if<std::shared_ptr<Object>>(&storage_)) return (*object)->type_name();
  if (const auto* set = std::get_if<std::shared_ptr<Set>>(&storage_)) return (*set)->frozen ? "frozenset" : "set";
  if (is_factor()) return "_F";
  static constexpr const char* names[] = {"NoneType", "unknown", "bool", "int",  "float", "complex", "str",
                                          "int",      "tuple",   "list", "dict", "set",   "concept"};
  return names[storage_.index()];
}

std::string Value::repr() const { return repr_of(*this); }

}  // namespace comma::interpreter
