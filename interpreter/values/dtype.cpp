// The types of arrays as values.
#include "interpreter/values/dtype.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "interpreter/values/operations.hpp"

namespace comma::interpreter {

namespace {

struct TypeRow {
  std::string_view word;
  NumberType type;
};

constexpr std::array type_words = {
    TypeRow{"float", NumberType::real}, TypeRow{"float64", NumberType::real}, TypeRow{"d", NumberType::real},
    TypeRow{"f8", NumberType::real},    TypeRow{"int", NumberType::integer},  TypeRow{"int64", NumberType::integer},
    TypeRow{"i8", NumberType::integer}, TypeRow{"bool", NumberType::boolean}, TypeRow{"bool_", NumberType::boolean},
    TypeRow{"?", NumberType::boolean},
};

std::optional<NumberType> type_of_word(std::string_view word) {
  const auto* row = std::ranges::find(type_words, word, &TypeRow::word);
  return row == type_words.end() ? std::nullopt : std::optional(row->type);
}

std::optional<NumberType> known_type(const Value& word) {
  if (word.is_text()) return type_of_word(word.as_text());
  if (const auto* type = word.as_object<DtypeObject>()) return type->type;
  if (const auto* type = word.as_object<TypeObject>()) return type_of_word(type->name);
  return std::nullopt;
}

}  // namespace

bool DtypeObject::equals(const Object& other) const {
  if (const auto* same = dynamic_cast<const DtypeObject*>(&other)) return same->type == type;
  const auto* word = dynamic_cast<const TypeObject*>(&other);
  return word != nullptr && type_of_word(word->name) == type;
}

std::optional<Value> DtypeObject::attribute(std::string_view name) const {
  if (name == "name") return Value(text());
  if (name == "kind") return Value(type == NumberType::real ? "f" : type == NumberType::integer ? "i" : "b");
  if (name == "itemsize") return Value(type == NumberType::boolean ? 1 : 8);
  return std::nullopt;
}

std::optional<Value> DtypeObject::compared(Operator op, const Value& other) const {
  if (op != Operator::equal && op != Operator::not_equal) return std::nullopt;
  return Value((known_type(other) == type) == (op == Operator::equal));
}

Value dtype_value(NumberType type) { return Value(std::shared_ptr<Object>(std::make_shared<DtypeObject>(type))); }

std::optional<NumberType> number_type_of(const Value& word) {
  if (word.is_none()) return std::nullopt;
  if (const auto type = known_type(word)) return type;
  raise(ErrorKind::not_implemented, fmt::format("arrays are of float, int or bool, not of {}", word.repr()));
}

}  // namespace comma::interpreter
