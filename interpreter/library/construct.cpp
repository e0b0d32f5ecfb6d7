// int(...), float(...), str(...), list(...): the types called as functions.
#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "interpreter/library/builtins.hpp"
#include "interpreter/values/array.hpp"
#include "interpreter/values/operations.hpp"
#include "interpreter/values/repr.hpp"

namespace comma::interpreter {

namespace {

std::string_view strip(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\n\r\f\v");
  if (first == text.npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\n\r\f\v") - first + 1);
}

/// Underscores may stand between digits only.
std::optional<std::string> without_underscores(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '_') {
      out += text[i];
      continue;
    }
    const auto digit = [](char c) { return (c >= '0' && c <= '9') || ((c | 0x20) >= 'a' && (c | 0x20) <= 'z'); };
    if (i == 0 || i + 1 == text.size() || !digit(text[i - 1]) || !digit(text[i + 1])) return std::nullopt;
  }
  return out;
}

std::optional<Value> integer_from_text(std::string_view text, int base) {
  auto digits = without_underscores(strip(text));
  if (!digits || digits->empty() || digits->size() > 5000) return std::nullopt;
  const bool negative = digits->front() == '-';
  if (negative || digits->front() == '+') digits->erase(0, 1);
  const char mark = digits->size() > 2 && (*digits)[0] == '0' ? static_cast<char>((*digits)[1] | 0x20) : '\0';
  const int marked = mark == 'x' ? 16 : mark == 'o' ? 8 : mark == 'b' ? 2 : 0;
  if (marked != 0 && (base == marked || base == 0)) {
    digits->erase(0, 2);
    base = marked;
  }
  if (base == 0) base = 10;
  const auto value = BigInteger::parse(*digits, base);
  if (!value) return std::nullopt;
  return Value::integer(negative ? -*value : *value);
}

std::optional<double> real_from_text(std::string_view text) {
  auto digits = without_underscores(strip(text));
  if (!digits || digits->empty()) return std::nullopt;
  const bool negative = digits->front() == '-';
  if (negative || digits->front() == '+') digits->erase(0, 1);
  std::string low;
  for (char c : *digits) low += static_cast<char>(c >= 'A' && c <= 'Z' ? c | 0x20 : c);
  double value = 0.0;
  if (low == "inf" || low == "infinity") {
    value = HUGE_VAL;
  } else if (low == "nan") {
    value = std::nan("");
  } else {
    if (low.empty() || !((low[0] >= '0' && low[0] <= '9') || low[0] == '.')) return std::nullopt;
    const auto result = std::from_chars(low.data(), low.data() + low.size(), value);
    if (result.ptr != low.data() + low.size()) return std::nullopt;
    if (result.ec == std::errc::result_out_of_range)
      value = std::strtod(low.c_str(), nullptr);
    else if (result.ec != std::errc())
      return std::nullopt;
  }
  return negative ? -value : value;
}

/// An array of one number counts as that number.
Value single_number(const Value& source) {
  const auto* array = source.as_object<ArrayObject>();
  return array != nullptr && array->size() == 1 ? array_number(array->at(0), array->type) : source;
}

Value make_integer(const CallArguments& arguments) {
  expect_arguments("int", arguments, 0, 2, {"base"});
  if (arguments.size() == 0) return 0;
  const Value source = single_number(arguments[0]);
  const Value* base = arguments.size() > 1 ? &arguments[1] : arguments.find("base");
  if (source.is_text()) {
    const std::int64_t radix = base != nullptr ? index_of(*base) : 10;
    if (radix != 0 && (radix < 2 || radix > 36)) raise(ErrorKind::value, "int() base must be >= 2 and <= 36, or 0");
    if (auto value = integer_from_text(source.as_text(), static_cast<int>(radix))) return *value;
    raise(ErrorKind::value, fmt::format("invalid literal for int() with base {}: {}", radix, source.repr()),
          real_from_text(source.as_text()) ? "it is a real number: int(float(...))" : "");
  }
  if (base != nullptr) raise(ErrorKind::type, "int() can't convert non-string with explicit base");
  if (const auto integer = integer_of(source)) return Value::integer(*integer);
  if (!source.is_real()) {
    raise(ErrorKind::type,
          fmt::format("int() argument must be a string, a bytes-like object or a real number, not '{}'",
                      source.type_name()));
  }
  if (std::isnan(source.as_real())) raise(ErrorKind::value, "cannot convert float NaN to integer");
  if (std::isinf(source.as_real())) raise(ErrorKind::overflow, "cannot convert float infinity to integer");
  return Value::integer(BigInteger::from_double(source.as_real()));
}

Value make_real(const CallArguments& arguments) {
  expect_arguments("float", arguments, 0, 1);
  if (arguments.size() == 0) return 0.0;
  const Value source = single_number(arguments[0]);
  if (source.is_text()) {
    if (const auto value = real_from_text(source.as_text())) return *value;
    raise(ErrorKind::value, fmt::format("could not convert string to float: {}", source.repr()),
          source.as_text().find(',') != std::string::npos ? "the decimal sign is the point" : "");
  }
  if (!is_numeric(source) || source.is_complex()) {
    raise(ErrorKind::type,
          fmt::format("float() argument must be a string or a real number, not '{}'", source.type_name()));
  }
  return real_of(source);
}

Value make_complex(const CallArguments& arguments) {
  expect_arguments("complex", arguments, 0, 2, {"real", "imag"});
  const auto part = [&](std::size_t index, const char* name) -> std::complex<double> {
    const Value* value = arguments.size() > index ? &arguments[index] : arguments.find(name);
    if (value == nullptr) return 0.0;
    if (!is_numeric(*value))
      raise(ErrorKind::type, fmt::format("complex() argument must be a number, not '{}'", value->type_name()));
    return value->is_complex() ? value->as_complex() : real_of(*value);
  };
  const auto real = part(0, "real"), imaginary = part(1, "imag");
  return std::complex<double>(real.real() - imaginary.imag(), real.imag() + imaginary.real());
}

Value make_dict(Evaluator& evaluator, const CallArguments& arguments) {
  if (arguments.size() > 1)
    raise(ErrorKind::type, fmt::format("dict expected at most 1 argument, got {}", arguments.size()));
  auto dict = std::make_shared<Dict>();
  if (arguments.size() == 1 && arguments[0].is_dict()) {
    dict->update(arguments[0].as_dict());
  } else if (arguments.size() == 1) {
    std::size_t index = 0;
    for (const Value& pair : list_of(arguments[0], evaluator.meter())) {
      const std::vector<Value> parts = list_of(pair, evaluator.meter());
      if (parts.size() != 2) {
        raise(ErrorKind::value,
              fmt::format("dictionary update sequence element #{} has length {}; 2 is required", index, parts.size()));
      }
      dict->set(parts[0], parts[1]);
      ++index;
    }
  }
  for (const auto& item : arguments.named) dict->set(Value(item.name), item.value);
  return Value(std::move(dict));
}

Value make_range(const CallArguments& arguments) {
  expect_arguments("range", arguments, 1, 3);
  const std::int64_t first = index_of(arguments[0]);
  const std::int64_t step = arguments.size() > 2 ? index_of(arguments[2]) : 1;
  if (step == 0) raise(ErrorKind::value, "range() arg 3 must not be zero");
  const auto range = arguments.size() == 1 ? std::make_shared<RangeObject>(0, first, 1)
                                           : std::make_shared<RangeObject>(first, index_of(arguments[1]), step);
  return Value(std::shared_ptr<Object>(range));
}

Value make_slice(const CallArguments& arguments) {
  expect_arguments("slice", arguments, 1, 3);
  auto slice = std::make_shared<SliceObject>();
  if (arguments.size() == 1) {
    slice->stop = arguments[0];
  } else {
    slice->start = arguments[0];
    slice->stop = arguments[1];
    if (arguments.size() == 3) slice->step = arguments[2];
  }
  return Value(std::shared_ptr<Object>(std::move(slice)));
}

Value type_of(const CallArguments& arguments) {
  expect_arguments("type", arguments, 1, 1);
  if (const auto* error = arguments[0].as_object<ExceptionObject>()) {
    return Value(std::shared_ptr<Object>(std::make_shared<ExceptionClassObject>(error->kind)));
  }
  const std::string name = arguments[0].type_name();
  if (const Value* known = builtin_value(name); known != nullptr && known->as_object<TypeObject>() != nullptr)
    return *known;
  return Value(std::shared_ptr<Object>(std::make_shared<TypeObject>(name)));
}

}  // namespace

Value construct(Evaluator& evaluator, const std::string& type, const CallArguments& arguments) {
  if (type == "int") return make_integer(arguments);
  if (type == "float") return make_real(arguments);
  if (type == "complex") return make_complex(arguments);
  if (type == "dict") return make_dict(evaluator, arguments);
  if (type == "range") return make_range(arguments);
  if (type == "slice") return make_slice(arguments);
  if (type == "type") return type_of(arguments);
  expect_arguments(type, arguments, 0, 1);
  const bool given = arguments.size() > 0;
  if (type == "str") return given ? text_of(arguments[0]) : std::string();
  if (type == "bool") return given && truth(arguments[0]);
  std::vector<Value> items;
  if (type == "object") return Value(std::shared_ptr<Object>(std::make_shared<TypeObject>("object")));
  if (given) items = list_of(arguments[0], evaluator.meter());
  if (type == "list") return Value::list(std::move(items));
  if (type == "tuple") return given && arguments[0].is_tuple() ? arguments[0] : Value::tuple(std::move(items));
  if (type == "set" || type == "frozenset") return make_set(items, type == "frozenset");
  raise(ErrorKind::type, fmt::format("cannot create '{}' instances", type));
}

}  // namespace comma::interpreter
