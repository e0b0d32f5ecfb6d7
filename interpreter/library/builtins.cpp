#include "interpreter/library/builtins.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

#include "interpreter/syntax/utf8.hpp"
#include "interpreter/values/array.hpp"
#include "interpreter/values/format.hpp"
#include "interpreter/values/operations.hpp"
#include "interpreter/values/repr.hpp"

namespace comma::interpreter {

void expect_arguments(std::string_view function, const CallArguments& arguments, std::size_t fewest, std::size_t most,
                      std::initializer_list<std::string_view> keywords) {
  for (const auto& item : arguments.named) {
    if (std::find(keywords.begin(), keywords.end(), item.name) != keywords.end()) continue;
    raise(ErrorKind::type, keywords.size() == 0
                               ? fmt::format("{}() takes no keyword arguments", function)
                               : fmt::format("'{}' is an invalid keyword argument for {}()", item.name, function));
  }
  const std::size_t given = arguments.size();
  if (given >= fewest && given <= most) return;
  const std::size_t bound = given < fewest ? fewest : most;
  const std::string_view relation = fewest == most ? "exactly" : given < fewest ? "at least" : "at most";
  raise(ErrorKind::type, fmt::format("{}() takes {} {} argument{} ({} given)", function, relation,
                                     bound == 1 ? "one" : std::to_string(bound), bound == 1 ? "" : "s", given));
}

namespace {

Value print(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("print", arguments, 0, arguments.size(), {"sep", "end", "file", "flush"});
  const auto option = [&](std::string_view name, const char* fallback) {
    const Value* value = arguments.find(name);
    if (value == nullptr || value->is_none()) return std::string(fallback);
    if (!value->is_text())
      raise(ErrorKind::type, fmt::format("{} must be None or a string, not {}", name, value->type_name()));
    return value->as_text();
  };
  const std::string separator = option("sep", " ");
  std::string out;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    if (i > 0) out += separator;
    out += text_of(arguments[i]);
  }
  out += option("end", "\n");
  evaluator.meter().allocate(out.size());
  evaluator.print(out);
  return {};
}

Value len(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("len", arguments, 1, 1);
  if (const auto length = length_of(arguments[0])) return *length;
  if (arguments[0].is_concept()) {
    const ConceptPtr& handle = arguments[0].as_concept();
    if (!evaluator.host().force(handle)) return Value::unknown();
    if (const auto length = handle->data->length()) return *length;
  }
  raise(ErrorKind::type, fmt::format("object of type '{}' has no len()", arguments[0].type_name()));
}

Value abs(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("abs", arguments, 1, 1);
  const Value& x = arguments[0];
  if (const auto integer = integer_of(x)) return Value::integer(integer->magnitude());
  if (x.is_real()) return std::abs(x.as_real());
  if (x.is_complex()) return std::abs(x.as_complex());
  if (x.as_object<ArrayObject>() != nullptr) {
    Numbers numbers = numbers_of(x, evaluator.meter());
    for (double& item : numbers.data) item = std::abs(item);
    return make_value(std::move(numbers));
  }
  raise(ErrorKind::type, fmt::format("bad operand type for abs(): '{}'", x.type_name()));
}

/// Half of the last kept digit goes to the even neighbour, on the exact decimal value of the double.
Value round_real(double x, std::int64_t digits) {
  if (!std::isfinite(x) || digits > 323) return x;
  if (digits < -308) return std::copysign(0.0, x);
  if (digits >= 0) {
    const std::string text = fmt::format("{:.{}f}", x, digits);
    return std::strtod(text.c_str(), nullptr);
  }
  const double scale = std::pow(10.0, static_cast<double>(-digits));
  return std::nearbyint(x / scale) * scale;
}

Value round_integer(const BigInteger& x, std::int64_t digits) {
  if (digits >= 0) return Value::integer(x);
  if (digits < -10000) return 0;
  const BigInteger scale = BigInteger::power(BigInteger(10), static_cast<std::uint64_t>(-digits));
  auto [quotient, rest] = BigInteger::floor_divide(x, scale);
  const BigInteger twice = rest + rest;
  if (twice > scale || (twice == scale && quotient.is_odd())) quotient = quotient + BigInteger(1);
  return Value::integer(quotient * scale);
}

Value round(Evaluator&, const CallArguments& arguments) {
  expect_arguments("round", arguments, 1, 2, {"ndigits"});
  const Value& x = arguments[0];
  const Value* digits = arguments.size() > 1 ? &arguments[1] : arguments.find("ndigits");
  const bool whole = digits == nullptr || digits->is_none();
  if (const auto integer = integer_of(x))
    return whole ? Value::integer(*integer) : round_integer(*integer, index_of(*digits));
  if (!x.is_real()) raise(ErrorKind::type, fmt::format("type {} doesn't define __round__ method", x.type_name()));
  if (!whole) return round_real(x.as_real(), index_of(*digits));
  if (std::isnan(x.as_real())) raise(ErrorKind::value, "cannot convert float NaN to integer");
  if (std::isinf(x.as_real())) raise(ErrorKind::overflow, "cannot convert float infinity to integer");
  return Value::integer(BigInteger::from_double(std::nearbyint(x.as_real())));
}

Value isinstance(Evaluator&, const CallArguments& arguments) {
  expect_arguments("isinstance", arguments, 2, 2);
  return is_instance(arguments[0], arguments[1]);
}

Value callable(Evaluator&, const CallArguments& arguments) {
  expect_arguments("callable", arguments, 1, 1);
  return arguments[0].is_callable();
}

Value repr(Evaluator&, const CallArguments& arguments) {
  expect_arguments("repr", arguments, 1, 1);
  return repr_of(arguments[0]);
}

Value ascii(Evaluator&, const CallArguments& arguments) {
  expect_arguments("ascii", arguments, 1, 1);
  return convert_value(arguments[0], 'a');
}

Value format(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("format", arguments, 1, 2);
  if (arguments.size() == 2 && !arguments[1].is_text())
    raise(ErrorKind::type, "format() argument 2 must be str, not " + arguments[1].type_name());
  return format_value(arguments[0], arguments.size() == 2 ? arguments[1].as_text() : "", evaluator.meter());
}

Value hash(Evaluator&, const CallArguments& arguments) {
  expect_arguments("hash", arguments, 1, 1);
  return static_cast<std::int64_t>(hash_of(arguments[0]) >> 3);
}

Value divmod(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("divmod", arguments, 2, 2);
  for (const Value& value : arguments.positional) {
    if (!is_numeric(value) || value.is_complex()) {
      raise(ErrorKind::type, fmt::format("unsupported operand type(s) for divmod(): '{}' and '{}'",
                                         arguments[0].type_name(), arguments[1].type_name()));
    }
  }
  return Value::tuple({binary_operation(Operator::floor_divide, arguments[0], arguments[1], evaluator.meter()),
                       binary_operation(Operator::modulo, arguments[0], arguments[1], evaluator.meter())});
}

/// a**b modulo m, the square-and-multiply way.
Value power_modulo(const Value& a, const Value& b, const Value& m, Meter& meter) {
  const auto base = integer_of(a), exponent = integer_of(b), modulus = integer_of(m);
  if (!base || !exponent || !modulus)
    raise(ErrorKind::type, "pow() 3rd argument not allowed unless all arguments are integers");
  if (modulus->is_zero()) raise(ErrorKind::value, "pow() 3rd argument cannot be 0");
  if (exponent->is_negative())
    raise(ErrorKind::value, "pow() with a negative exponent and a modulus is not part of the command language");
  const auto reduce = [&](const BigInteger& x) { return BigInteger::floor_divide(x, *modulus).second; };
  BigInteger result = reduce(BigInteger(1)), factor = reduce(*base);
  for (BigInteger n = *exponent; !n.is_zero(); n = n.shifted_right(1)) {
    meter.work(2 * (modulus->bit_length() / 32 + 1) * (modulus->bit_length() / 32 + 1) + n.bit_length() / 32 + 16);
    if (n.is_odd()) result = reduce(result * factor);
    factor = reduce(factor * factor);
  }
  return Value::integer(result);
}

Value pow(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("pow", arguments, 2, 3);
  if (arguments.size() == 3) return power_modulo(arguments[0], arguments[1], arguments[2], evaluator.meter());
  return power(arguments[0], arguments[1], evaluator.meter());
}

Value in_base(const CallArguments& arguments, std::string_view function, int base, std::string_view prefix) {
  expect_arguments(function, arguments, 1, 1);
  const auto x = integer_of(arguments[0]);
  if (!x)
    raise(ErrorKind::type, fmt::format("'{}' object cannot be interpreted as an integer", arguments[0].type_name()));
  return (x->is_negative() ? "-" : "") + std::string(prefix) + x->magnitude().to_string(base);
}

Value hex(Evaluator&, const CallArguments& arguments) { return in_base(arguments, "hex", 16, "0x"); }
Value oct(Evaluator&, const CallArguments& arguments) { return in_base(arguments, "oct", 8, "0o"); }
Value bin(Evaluator&, const CallArguments& arguments) { return in_base(arguments, "bin", 2, "0b"); }

Value chr(Evaluator&, const CallArguments& arguments) {
  expect_arguments("chr", arguments, 1, 1);
  const std::int64_t code = index_of(arguments[0]);
  if (code < 0 || code > 0x10FFFF || (code >= 0xD800 && code < 0xE000))
    raise(ErrorKind::value, "chr() arg not in range(0x110000)");
  std::string text;
  append_utf8(text, static_cast<char32_t>(code));
  return text;
}

Value ord(Evaluator&, const CallArguments& arguments) {
  expect_arguments("ord", arguments, 1, 1);
  if (!arguments[0].is_text())
    raise(ErrorKind::type, fmt::format("ord() expected string of length 1, but {} found", arguments[0].type_name()));
  const auto points = decode_utf8(arguments[0].as_text());
  if (points.size() != 1)
    raise(ErrorKind::type, fmt::format("ord() expected a character, but string of length {} found", points.size()));
  return static_cast<std::int64_t>(points[0]);
}

const std::string& attribute_name(const Value& value) {
  if (!value.is_text()) raise(ErrorKind::type, "attribute name must be string, not '" + value.type_name() + "'");
  return value.as_text();
}

std::optional<Value> attribute_or_nothing(Evaluator& evaluator, const Value& object, const std::string& name) {
  try {
    return evaluator.attribute(object, name);
  } catch (const RaisedError& error) {
    if (error.object()->kind != ErrorKind::attribute) throw;
    return std::nullopt;
  }
}

Value hasattr(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("hasattr", arguments, 2, 2);
  if (arguments[0].is_concept())
    return evaluator.has_attribute(arguments[0].as_concept(), attribute_name(arguments[1]));
  return attribute_or_nothing(evaluator, arguments[0], attribute_name(arguments[1])).has_value();
}

Value getattr(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("getattr", arguments, 2, 3);
  if (arguments.size() == 2) return evaluator.attribute(arguments[0], attribute_name(arguments[1]));
  if (arguments[0].is_concept()) {
    const Value has = evaluator.has_attribute(arguments[0].as_concept(), attribute_name(arguments[1]));
    if (has.is_unknown()) return has;
    return truth(has) ? evaluator.attribute(arguments[0], attribute_name(arguments[1])) : arguments[2];
  }
  return attribute_or_nothing(evaluator, arguments[0], attribute_name(arguments[1])).value_or(arguments[2]);
}

Value identity(Evaluator&, const CallArguments& arguments) {
  expect_arguments("id", arguments, 1, 1);
  return static_cast<std::int64_t>(std::hash<std::string>{}(repr_of(arguments[0])) >> 4);
}

/// _F is made by the evaluator itself, which knows where its keywords stand.
Value factor(Evaluator&, const CallArguments&) { return {}; }

struct Refusal {
  std::string_view name, reason;
};

constexpr std::string_view no_files = "a command file reaches no file: use LIRE_*, IMPR_* and the units of the .export";
constexpr std::string_view no_code = "text is not run as code in a command file";
constexpr std::string_view no_looking = "variables are not looked up by name: use a dict";
constexpr std::array refusals = {
    Refusal{"open", no_files},
    Refusal{"input", "a command file asks nothing while it runs"},
    Refusal{"eval", no_code},
    Refusal{"exec", no_code},
    Refusal{"compile", no_code},
    Refusal{"__import__", "write 'import' on a line of its own"},
    Refusal{"globals", no_looking},
    Refusal{"locals", no_looking},
    Refusal{"vars", no_looking},
    Refusal{"dir", no_looking},
    Refusal{"setattr", "attributes cannot be assigned"},
    Refusal{"delattr", "attributes cannot be deleted"},
    Refusal{"bytes", "texts are str"},
    Refusal{"bytearray", "texts are str"},
    Refusal{"super", "there are no classes"},
    Refusal{"issubclass", "use isinstance(...)"},
    Refusal{"exit", "use sys.exit() after 'import sys'"},
    Refusal{"quit", "use sys.exit() after 'import sys'"},
};

constexpr std::array general_table = {
    FunctionRow{"print", print},
    FunctionRow{"len", len},
    FunctionRow{"abs", abs},
    FunctionRow{"round", round},
    FunctionRow{"isinstance", isinstance},
    FunctionRow{"callable", callable},
    FunctionRow{"repr", repr},
    FunctionRow{"ascii", ascii},
    FunctionRow{"format", format},
    FunctionRow{"hash", hash},
    FunctionRow{"divmod", divmod},
    FunctionRow{"pow", pow},
    FunctionRow{"hex", hex},
    FunctionRow{"oct", oct},
    FunctionRow{"bin", bin},
    FunctionRow{"chr", chr},
    FunctionRow{"ord", ord},
    FunctionRow{"hasattr", hasattr},
    FunctionRow{"getattr", getattr},
    FunctionRow{"id", identity},
    FunctionRow{"_F", factor},
};

using NameTable = std::unordered_map<std::string_view, Value>;

NameTable make_builtins() {
  NameTable names;
  for (const auto rows : {basic_functions(), sequence_functions()}) {
    for (const FunctionRow& row : rows) {
      names.emplace(
          row.name,
          Value(std::shared_ptr<Object>(std::make_shared<BuiltinObject>(std::string(row.name), row.function))));
    }
  }
  for (const char* type : {"int", "float", "str", "bool", "complex", "list", "tuple", "dict", "set", "frozenset",
                           "type", "object", "range", "slice"}) {
    names.emplace(type, Value(std::shared_ptr<Object>(std::make_shared<TypeObject>(type))));
  }
  for (int kind = 0; kind < static_cast<int>(ErrorKind::aster); ++kind) {
    const ErrorClass& row = class_of(static_cast<ErrorKind>(kind));
    names.emplace(row.name, Value(std::shared_ptr<Object>(std::make_shared<ExceptionClassObject>(row.kind))));
  }
  for (const char* alias : {"IOError", "EnvironmentError"}) {
    names.emplace(alias, Value(std::shared_ptr<Object>(std::make_shared<ExceptionClassObject>(ErrorKind::os))));
  }
  names.emplace("AsterError", Value(std::shared_ptr<Object>(std::make_shared<ExceptionClassObject>(ErrorKind::aster))));
  names.emplace("__name__", Value("__main__"));
  return names;
}

const NameTable& builtins() {
  static const NameTable names = make_builtins();
  return names;
}

}  // namespace

std::span<const FunctionRow> basic_functions() { return general_table; }

bool is_instance(const Value& value, const Value& type) {
  if (type.is_tuple()) {
    return std::any_of(type.items().begin(), type.items().end(),
                       [&](const Value& one) { return is_instance(value, one); });
  }
  if (const auto* error = type.as_object<ExceptionClassObject>()) {
    const auto* object = value.as_object<ExceptionObject>();
    return object != nullptr && is_subclass(object->kind, error->kind);
  }
  if (const auto* builtin = type.as_object<BuiltinObject>(); builtin != nullptr && builtin->name == "_F")
    return value.is_factor();
  const auto* wanted = type.as_object<TypeObject>();
  if (wanted == nullptr) raise(ErrorKind::type, "isinstance() arg 2 must be a type, a tuple of types, or a union");
  const std::string name = value.type_name();
  return wanted->name == name || wanted->name == "object" || (wanted->name == "int" && name == "bool") ||
         (wanted->name == "dict" && value.is_dict());
}

std::string_view refusal_of(std::string_view name) {
  const auto found =
      std::find_if(refusals.begin(), refusals.end(), [&](const Refusal& row) { return row.name == name; });
  return found == refusals.end() ? std::string_view() : found->reason;
}

const Value* builtin_value(std::string_view name) {
  const auto found = builtins().find(name);
  return found == builtins().end() ? nullptr : &found->second;
}

std::vector<std::string> builtin_names() {
  std::vector<std::string> names;
  for (const auto& [name, value] : builtins()) names.emplace_back(name);
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace comma::interpreter
