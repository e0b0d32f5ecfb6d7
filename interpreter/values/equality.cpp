// Equality and hashing, the two that must agree: equal values hash alike.
#include <cmath>
#include <functional>

#include "interpreter/values/big_integer.hpp"
#include "interpreter/values/dict.hpp"
#include "interpreter/values/exception.hpp"
#include "interpreter/values/operations.hpp"

namespace comma::interpreter {

namespace {

/// Deeper than any data of a command file; a list that holds itself must not exhaust the stack.
constexpr int deepest_compared = 500;

bool equal_at(const Value& a, const Value& b, int depth);

bool equal_to_real(const Value& integer, double real) {
  if (!std::isfinite(real) || real != std::trunc(real)) return false;
  const BigInteger exact = integer.is_big_integer() ? integer.as_big_integer() : BigInteger(*small_integer(integer));
  return exact == BigInteger::from_double(real);
}

bool equal_numbers(const Value& a, const Value& b) {
  if (a.is_complex() || b.is_complex()) {
    const Value& z = a.is_complex() ? a : b;
    const Value& other = a.is_complex() ? b : a;
    if (other.is_complex()) return z.as_complex() == other.as_complex();
    return z.as_complex().imag() == 0.0 && equal_numbers(Value(z.as_complex().real()), other);
  }
  if (a.is_real() && b.is_real()) return a.as_real() == b.as_real();
  if (a.is_real()) return equal_to_real(b, a.as_real());
  if (b.is_real()) return equal_to_real(a, b.as_real());
  if (a.is_big_integer() && b.is_big_integer()) return a.as_big_integer() == b.as_big_integer();
  const auto x = small_integer(a);
  return x && x == small_integer(b);
}

bool equal_items(std::span<const Value> a, std::span<const Value> b, int depth) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!equal_at(a[i], b[i], depth + 1)) return false;
  }
  return true;
}

bool equal_dicts(const Dict& a, const Dict& b, int depth) {
  if (a.size() != b.size()) return false;
  for (const Dict::Entry& entry : a.entries()) {
    if (!entry.live) continue;
    const Value* other = b.find(entry.key);
    if (other == nullptr || !equal_at(entry.value, *other, depth + 1)) return false;
  }
  return true;
}

bool equal_objects(const Value& a, const Value& b) {
  if (const auto* x = a.as_object<ExceptionClassObject>()) {
    const auto* y = b.as_object<ExceptionClassObject>();
    return y != nullptr && x->kind == y->kind;
  }
  const auto* x = a.as_object<Object>();
  const auto* y = b.as_object<Object>();
  return x == y || (x != nullptr && y != nullptr && x->equals(*y));
}

bool equal_at(const Value& a, const Value& b, int depth) {
  if (depth > deepest_compared) raise(ErrorKind::recursion, "maximum recursion depth exceeded in comparison");
  if (is_numeric(a) && is_numeric(b)) return equal_numbers(a, b);
  if (a.storage().index() != b.storage().index()) return false;
  if (a.is_none()) return true;
  if (a.is_text()) return a.as_text() == b.as_text();
  if (a.is_sequence() && a.items().data() == b.items().data() && a.items().size() == b.items().size()) return true;
  if (a.is_sequence()) return equal_items(a.items(), b.items(), depth);
  if (a.is_dict()) return &a.as_dict() == &b.as_dict() || equal_dicts(a.as_dict(), b.as_dict(), depth);
  if (a.is_set()) return equal_dicts(a.as_set(), b.as_set(), depth);
  if (a.is_concept()) return a.as_concept() == b.as_concept();
  return equal_objects(a, b);
}

std::size_t hash_real(double value) {
  if (std::isfinite(value) && value == std::trunc(value)) {
    return hash_of(Value::integer(BigInteger::from_double(value)));
  }
  return std::hash<double>{}(value);
}

std::size_t combine(std::size_t seed, std::size_t hash) { return seed * 1000003 ^ (hash + 0x9E3779B97F4A7C15ULL); }

std::size_t hash_at(const Value& value, int depth) {
  if (depth > deepest_compared) raise(ErrorKind::recursion, "maximum recursion depth exceeded in hash()");
  if (const auto integer = small_integer(value)) return std::hash<std::int64_t>{}(*integer);
  if (value.is_real()) return hash_real(value.as_real());
  if (value.is_text()) return std::hash<std::string>{}(value.as_text());
  if (value.is_big_integer()) return std::hash<std::string>{}(value.as_big_integer().to_string(16));
  if (value.is_none() || value.is_unknown()) return value.storage().index();
  if (value.is_concept()) return std::hash<const void*>{}(value.as_concept().get());
  if (value.is_complex()) {
    const auto z = value.as_complex();
    return z.imag() == 0.0 ? hash_real(z.real()) : combine(hash_real(z.real()), hash_real(z.imag()));
  }
  if (value.is_tuple()) {
    std::size_t hash = value.items().size();
    for (const Value& item : value.items()) hash = combine(hash, hash_at(item, depth + 1));
    return hash;
  }
  if (value.type_name() == "frozenset") {
    std::size_t hash = 0;  // the order of the keys must not matter
    for (const Value& key : value.as_set().keys()) hash += hash_at(key, depth + 1);
    return hash;
  }
  if (const auto* error = value.as_object<ExceptionClassObject>()) return static_cast<std::size_t>(error->kind);
  if (const auto* object = value.as_object<Object>()) return object->hash();
  raise(ErrorKind::type, "unhashable type: '" + value.type_name() + "'",
        value.is_list() ? "use a tuple where a list would be a key" : "");
}

}  // namespace

bool equal(const Value& a, const Value& b) { return equal_at(a, b, 0); }

std::size_t hash_of(const Value& value) { return hash_at(value, 0); }

}  // namespace comma::interpreter
