#include "interpreter/values/repr.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <vector>

#include "interpreter/values/big_integer.hpp"
#include "interpreter/values/dict.hpp"
#include "interpreter/values/dtype.hpp"
#include "interpreter/values/exception.hpp"

namespace comma::interpreter {

namespace {

/// What is nested deeper than anyone writes shows "..." from here on.
constexpr std::size_t deepest_shown = 200;

/// 4300 digits are as many bits as this: turning more into text would take quadratic time.
constexpr double bits_of_most_digits = 4300.0 / 0.30102999566398120;

/// The containers that are being written: one that holds itself shows "..." there, as in Python.
using Path = std::vector<const void*>;

/// Python switches to the exponent form below 1e-4 and from 1e16 on.
constexpr int smallest_plain_exponent = -4;
constexpr int largest_plain_exponent = 16;

void write(const Value& value, std::string& out, Path& path);
const void* identity_of(const Value& value);
void write_container(const Value& value, const void* identity, std::string& out, Path& path);

void write_items(std::span<const Value> items, std::string& out, Path& path) {
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (i > 0) out += ", ";
    write(items[i], out, path);
  }
}

void write_dict(const Dict& dict, std::string& out, Path& path) {
  if (dict.factory) {
    out += "defaultdict(";
    write(*dict.factory, out, path);
    out += ", ";
  }
  out += '{';
  bool first = true;
  for (const Dict::Entry& entry : dict.entries()) {
    if (!entry.live) continue;
    if (!first) out += ", ";
    first = false;
    write(entry.key, out, path);
    out += ": ";
    write(entry.value, out, path);
  }
  out += dict.factory ? "})" : "}";
}

void write_set(const Value& value, std::string& out, Path& path) {
  const bool frozen = value.type_name() == "frozenset";
  const Dict& keys = value.as_set();
  if (keys.size() == 0) {
    out += frozen ? "frozenset()" : "set()";
    return;
  }
  out += frozen ? "frozenset({" : "{";
  write_items(keys.keys(), out, path);
  out += frozen ? "})" : "}";
}

void write_factor(const Dict& factor, std::string& out, Path& path) {
  out += "_F(";
  bool first = true;
  for (const Dict::Entry& entry : factor.entries()) {
    if (!entry.live) continue;
    if (!std::exchange(first, false)) out += ", ";
    out += (entry.key.is_text() ? entry.key.as_text() : entry.key.repr()) + "=";
    write(entry.value, out, path);
  }
  out += ')';
}

void write(const Value& value, std::string& out, Path& path) {
  if (value.is_none()) {
    out += "None";
  } else if (value.is_unknown()) {
    out += "<unknown>";
  } else if (value.is_bool()) {
    out += value.as_bool() ? "True" : "False";
  } else if (value.is_integer()) {
    out += std::to_string(value.as_integer());
  } else if (value.is_big_integer()) {
    out += decimal_digits(value.as_big_integer());
  } else if (value.is_real()) {
    out += repr_of(value.as_real());
  } else if (value.is_complex()) {
    out += repr_of(value.as_complex());
  } else if (value.is_text()) {
    out += repr_of(std::string_view(value.as_text()));
  } else if (const void* identity = identity_of(value)) {
    write_container(value, identity, out, path);
  } else if (value.is_concept()) {
    out += value.as_concept()->name;
  } else {
    out += value.as_object<Object>()->repr();
  }
}

const void* identity_of(const Value& value) {
  if (value.is_list()) return &value.as_list();
  if (value.is_tuple()) return std::get<std::shared_ptr<Tuple>>(value.storage()).get();
  if (value.is_dict()) return &value.as_dict();
  if (value.is_set()) return &value.as_set();
  return value.as_object<ExceptionObject>();
}

void write_container(const Value& value, const void* identity, std::string& out, Path& path) {
  const char* brackets = value.is_list() ? "[]" : value.is_tuple() ? "()" : "{}";
  if (path.size() > deepest_shown || std::find(path.begin(), path.end(), identity) != path.end()) {
    out += brackets[0] + std::string("...") + brackets[1];
    return;
  }
  path.push_back(identity);
  if (value.is_sequence()) {
    out += brackets[0];
    write_items(value.items(), out, path);
    if (value.is_tuple() && value.items().size() == 1) out += ',';
    out += brackets[1];
  } else if (value.is_factor()) {
    write_factor(value.as_dict(), out, path);
  } else if (value.is_dict()) {
    write_dict(value.as_dict(), out, path);
  } else if (value.is_set()) {
    write_set(value, out, path);
  } else if (const auto* error = value.as_object<ExceptionObject>()) {
    out += class_of(error->kind).name;
    out += '(';
    write_items(error->arguments, out, path);
    out += ')';
  }
  path.pop_back();
}

std::string complex_part(double value) {
  std::string text = repr_of(value);
  if (text.size() > 2 && text.ends_with(".0")) text.resize(text.size() - 2);
  return text;
}

}  // namespace

std::string decimal_digits(const BigInteger& value) {
  if (static_cast<double>(value.bit_length()) > bits_of_most_digits) {
    raise(ErrorKind::value, "Exceeds the limit (4300 digits) for integer string conversion",
          "show it as float, or with hex(...)");
  }
  return value.to_string();
}

std::string repr_of(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::scientific).ptr;
  std::string_view shown(buffer, static_cast<std::size_t>(end - buffer));
  std::string sign;
  if (shown.front() == '-') {
    sign = "-";
    shown.remove_prefix(1);
  }
  const std::size_t mark = shown.find('e');
  int exponent = 0;
  const std::size_t digits_of_exponent = mark + (shown[mark + 1] == '+' ? 2 : 1);
  std::from_chars(shown.data() + digits_of_exponent, shown.data() + shown.size(), exponent);
  if (exponent < smallest_plain_exponent || exponent >= largest_plain_exponent) return sign + std::string(shown);

  std::string digits(1, shown[0]);
  if (mark > 2) digits += shown.substr(2, mark - 2);
  if (exponent < 0) return sign + "0." + std::string(static_cast<std::size_t>(-exponent - 1), '0') + digits;
  const auto whole = static_cast<std::size_t>(exponent) + 1;
  if (digits.size() <= whole) return sign + digits + std::string(whole - digits.size(), '0') + ".0";
  return sign + digits.substr(0, whole) + "." + digits.substr(whole);
}

std::string repr_of(std::complex<double> value) {
  const std::string imaginary = complex_part(value.imag());
  if (value.real() == 0.0 && !std::signbit(value.real())) return imaginary + "j";
  const bool needs_sign = imaginary[0] != '-';
  return "(" + complex_part(value.real()) + (needs_sign ? "+" : "") + imaginary + "j)";
}

std::string repr_of(std::string_view text) {
  const char quote = text.find('\'') != text.npos && text.find('"') == text.npos ? '"' : '\'';
  std::string out(1, quote);
  for (char c : text) {
    if (c == quote || c == '\\') {
      out += '\\';
      out += c;
    } else if (c == '\n') {
      out += "\\n";
    } else if (c == '\r') {
      out += "\\r";
    } else if (c == '\t') {
      out += "\\t";
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) {
      out += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
    } else {
      out += c;
    }
  }
  out += quote;
  return out;
}

std::string repr_of(const Value& value) {
  std::string out;
  Path path;
  write(value, out, path);
  return out;
}

std::string text_of(const Value& value) {
  if (value.is_text()) return value.as_text();
  if (const auto* error = value.as_object<ExceptionObject>()) return error->text();
  if (const auto* array = value.as_object<ArrayObject>()) return array->text();
  if (const auto* type = value.as_object<DtypeObject>()) return type->text();
  return repr_of(value);
}

}  // namespace comma::interpreter
