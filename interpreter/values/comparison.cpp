// Truth, order, membership, identity.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <compare>

#include "interpreter/values/array.hpp"
#include "interpreter/values/host_object.hpp"
#include "interpreter/values/operations.hpp"

namespace comma::interpreter {

namespace {

constexpr int deepest_ordered = 500;

std::partial_ordering order_integer_and_real(const Value& integer, double real) {
  if (std::isnan(real)) return std::partial_ordering::unordered;
  if (std::isinf(real)) return real > 0 ? std::partial_ordering::less : std::partial_ordering::greater;
  const auto whole = *integer_of(integer) <=> BigInteger::from_double(real);
  if (whole != 0) return whole;
  const double fraction = real - std::trunc(real);
  return fraction > 0   ? std::partial_ordering::less
         : fraction < 0 ? std::partial_ordering::greater
                        : std::partial_ordering::equivalent;
}

std::partial_ordering order_numbers(const Value& a, const Value& b) {
  if (a.is_real() && b.is_real()) return a.as_real() <=> b.as_real();
  if (a.is_integer() && b.is_integer()) return a.as_integer() <=> b.as_integer();
  if (b.is_real()) return order_integer_and_real(a, b.as_real());
  if (a.is_real()) return 0 <=> order_integer_and_real(b, a.as_real());
  return *integer_of(a) <=> *integer_of(b);
}

[[noreturn]] void raise_not_ordered(Operator op, const Value& a, const Value& b) {
  raise(
      ErrorKind::type,
      fmt::format("'{}' not supported between instances of '{}' and '{}'", symbol_of(op), a.type_name(), b.type_name()),
      a.is_text() != b.is_text() ? "convert one of them with str(...), int(...) or float(...)" : "");
}

bool fits(Operator op, std::partial_ordering order) {
  switch (op) {
    case Operator::less:
      return order < 0;
    case Operator::less_equal:
      return order <= 0;
    case Operator::greater:
      return order > 0;
    default:
      return order >= 0;
  }
}

bool is_subset(const Dict& a, const Dict& b) {
  return std::all_of(a.entries().begin(), a.entries().end(),
                     [&](const Dict::Entry& entry) { return !entry.live || b.find(entry.key) != nullptr; });
}

bool order_sets(Operator op, const Dict& a, const Dict& b) {
  switch (op) {
    case Operator::less:
      return a.size() < b.size() && is_subset(a, b);
    case Operator::less_equal:
      return is_subset(a, b);
    case Operator::greater:
      return order_sets(Operator::less, b, a);
    default:
      return is_subset(b, a);
  }
}

bool ordered(Operator op, const Value& a, const Value& b, int depth);

bool order_sequences(Operator op, std::span<const Value> a, std::span<const Value> b, int depth) {
  const std::size_t common = std::min(a.size(), b.size());
  for (std::size_t i = 0; i < common; ++i) {
    if (!equal(a[i], b[i])) return ordered(op, a[i], b[i], depth + 1);
  }
  return fits(op, a.size() <=> b.size());
}

bool ordered(Operator op, const Value& a, const Value& b, int depth) {
  if (depth > deepest_ordered) raise(ErrorKind::recursion, "maximum recursion depth exceeded in comparison");
  if (a.is_unknown() || b.is_unknown()) return false;
  if (is_numeric(a) && is_numeric(b) && !a.is_complex() && !b.is_complex()) return fits(op, order_numbers(a, b));
  if (a.is_text() && b.is_text()) return fits(op, a.as_text() <=> b.as_text());
  if ((a.is_list() && b.is_list()) || (a.is_tuple() && b.is_tuple()))
    return order_sequences(op, a.items(), b.items(), depth);
  if (a.is_set() && b.is_set()) return order_sets(op, a.as_set(), b.as_set());
  raise_not_ordered(op, a, b);
}

/// Whether any number of the array equals the item, which is stretched to it.
bool holds_equal(const Value& array, const Value& item) {
  Meter meter{Limits{}};
  const Value equal_places = array_operation(Operator::equal, array, item, meter);
  return std::ranges::any_of(equal_places.as_object<ArrayObject>()->numbers().data,
                             [](double set) { return set != 0.0; });
}

bool contains_text(const Value& container, const Value& item) {
  if (!item.is_text()) {
    raise(ErrorKind::type, "'in <string>' requires string as left operand, not " + item.type_name(),
          "write a tuple, with a comma: ('A',)");
  }
  return container.as_text().find(item.as_text()) != std::string::npos;
}

}  // namespace

bool holds_unknown(const Value& value, int depth) {
  if (value.is_unknown()) return true;
  if (!value.is_sequence() || depth > deepest_ordered) return false;
  return std::ranges::any_of(value.items(), [&](const Value& item) { return holds_unknown(item, depth + 1); });
}

bool truth(const Value& value) {
  if (value.is_bool()) return value.as_bool();
  if (value.is_none()) return false;
  if (value.is_integer()) return value.as_integer() != 0;
  if (value.is_real()) return value.as_real() != 0.0;
  if (value.is_complex()) return value.as_complex() != 0.0;
  if (const auto* array = value.as_object<ArrayObject>(); array != nullptr && array->size() == 1)
    return array->at(0) != 0.0;
  if (value.as_object<ArrayObject>() != nullptr) {
    raise(ErrorKind::value, "the truth of an array with several elements is ambiguous", "use any(...) or all(...)");
  }
  const auto length = length_of(value);
  return !length || *length > 0;
}

bool less_than(const Value& a, const Value& b) { return ordered(Operator::less, a, b, 0); }

bool identical(const Value& a, const Value& b) {
  if (a.storage().index() != b.storage().index()) return false;
  if (a.is_none()) return true;
  if (a.is_bool() || a.is_integer()) return equal(a, b);
  if (a.is_real()) return a.as_real() == b.as_real();
  if (a.is_text()) return a.as_text() == b.as_text();
  if (a.is_sequence()) return a.is_list() ? &a.as_list() == &b.as_list() : a.items().data() == b.items().data();
  if (a.is_dict()) return &a.as_dict() == &b.as_dict();
  if (a.is_set()) return &a.as_set() == &b.as_set();
  return equal(a, b);
}

bool contains(const Value& container, const Value& item) {
  if (container.is_text()) return contains_text(container, item);
  if (container.is_dict()) return container.as_dict().find(item) != nullptr;
  if (container.is_set()) return container.as_set().find(item) != nullptr;
  if (const auto* view = container.as_object<DictView>(); view != nullptr && view->kind == DictView::Kind::keys) {
    return view->dict->find(item) != nullptr;
  }
  if (const auto* range = container.as_object<RangeObject>()) {
    const auto number = integer_of(item);
    if (number && number->fits_int64()) {
      const std::int64_t n = number->to_int64();
      const bool inside = range->step > 0 ? n >= range->start && n < range->stop : n <= range->start && n > range->stop;
      return inside && (n - range->start) % range->step == 0;
    }
  }
  if (container.is_concept() || container.is_none() || is_numeric(container)) {
    raise(ErrorKind::type, "argument of type '" + container.type_name() + "' is not iterable");
  }
  if (container.as_object<ArrayObject>() != nullptr) return holds_equal(container, item);
  const auto iterator = iterate(container);
  while (auto candidate = iterator->next()) {
    if (equal(*candidate, item)) return true;
  }
  return false;
}

Value compare(Operator op, const Value& a, const Value& b) {
  if (op == Operator::is) return a.is_unknown() || b.is_unknown() ? Value::unknown() : Value(identical(a, b));
  if (op == Operator::is_not) return a.is_unknown() || b.is_unknown() ? Value::unknown() : Value(!identical(a, b));
  if (a.is_unknown() || b.is_unknown()) return Value::unknown();
  if (op == Operator::in || op == Operator::not_in) {
    const bool found = contains(b, a);
    if (!found && (holds_unknown(a) || holds_unknown(b))) return Value::unknown();
    return found == (op == Operator::in);
  }
  if (holds_unknown(a) || holds_unknown(b)) return Value::unknown();
  if (const auto* foreign = a.as_object<HostObject>())
    if (auto result = foreign->compared(op, b)) return *result;
  const bool either_text = a.is_text() || b.is_text();
  if (!either_text && (a.as_object<ArrayObject>() != nullptr || b.as_object<ArrayObject>() != nullptr)) {
    Meter meter{Limits{}};
    return array_operation(op, a, b, meter);
  }
  if (op == Operator::equal) return equal(a, b);
  if (op == Operator::not_equal) return !equal(a, b);
  return ordered(op, a, b, 0);
}

}  // namespace comma::interpreter
