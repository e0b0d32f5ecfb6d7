#include "interpreter/repr.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "interpreter/big_integer.hpp"
#include "interpreter/dict.hpp"
#include "interpreter/exception.hpp"

namespace comma::interpreter {

namespace {

/// A list that holds itself, or one nested deeper than anyone writes, shows "..." from here on.
constexpr int deepest_shown = 200;

/// Python switches to the exponent form below 1e-4 and from 1e16 on.
constexpr int smallest_plain_exponent = -4;
constexpr int largest_plain_exponent = 16;

void write(const Value& value, std::string& out, int depth);

void write_items(std::span<const Value> items, std::string& out, int depth) {
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (i > 0) out += ", ";
    write(items[i], out, depth + 1);
  }
}

void write_dict(const Dict& dict, std::string& out, int depth) {
  out += '{';
  bool first = true;
  for (const Dict::Entry& entry : dict.entries()) {
    if (!entry.live) continue;
    if (!first) out += ", ";
    first = false;
    write(entry.key, out, depth + 1);
    out += ": ";
    write(entry.value, out, depth + 1);
  }
  out += '}';
}

void write_set(const Value& value, std::string& out, int depth) {
  const bool frozen = value.type_name() == "frozenset";
  const Dict& keys = value.as_set();
  if (keys.size() == 0) {
    out += frozen ? "frozenset()" : "set()";
    return;
  }
  out += frozen ? "frozenset({" : "{";
  write_items(keys.keys(), out, depth);
  out += frozen ? "})" : "}";
}

void write_factor(const Factor& factor, std::string& out, int depth) {
  out += "_F(";
  for (std::size_t i = 0; i < factor.arguments.size(); ++i) {
    if (i > 0) out += ", ";
    out += factor.arguments[i].name + "=";
    write(*factor.arguments[i].value, out, depth + 1);
  }
  out += ')';
}

void write(const Value& value, std::string& out, int depth) {
  if (depth > deepest_shown) {
    out += "...";
  } else if (value.is_none()) {
    out += "None";
  } else if (value.is_unknown()) {
    out += "<unknown>";
  } else if (value.is_bool()) {
    out += value.as_bool() ? "True" : "False";
  } else if (value.is_integer()) {
    out += std::to_string(value.as_integer());
  } else if (value.is_big_integer()) {
    out += value.as_big_integer().to_string();
  } else if (value.is_real()) {
    out += repr_of(value.as_real());
  } else if (value.is_complex()) {
    out += repr_of(value.as_complex());
  } else if (value.is_text()) {
    out += repr_of(std::string_view(value.as_text()));
  } else if (value.is_tuple()) {
    out += '(';
    write_items(value.items(), out, depth);
    out += value.items().size() == 1 ? ",)" : ")";
  } else if (value.is_list()) {
    out += '[';
    write_items(value.items(), out, depth);
    out += ']';
  } else if (value.is_dict()) {
    write_dict(value.as_dict(), out, depth);
  } else if (value.is_set()) {
    write_set(value, out, depth);
  } else if (value.is_factor()) {
    write_factor(value.as_factor(), out, depth);
  } else if (value.is_concept()) {
    out += value.as_concept()->name;
  } else {
    out += value.as_object<Object>()->repr();
  }
}

std::string complex_part(double value) {
  std::string text = repr_of(value);
  if (text.size() > 2 && text.ends_with(".0")) text.resize(text.size() - 2);
  return text;
}

}  // namespace

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
  write(value, out, 0);
  return out;
}

std::string text_of(const Value& value) {
  if (value.is_text()) return value.as_text();
  if (const auto* error = value.as_object<ExceptionObject>()) return error->text();
  return repr_of(value);
}

}  // namespace comma::interpreter
