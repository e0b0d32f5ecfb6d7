#include "interpreter/values/format.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "interpreter/syntax/utf8.hpp"
#include "interpreter/values/exception.hpp"
#include "interpreter/values/operations.hpp"
#include "interpreter/values/repr.hpp"

namespace comma::interpreter {

namespace {

/// Wider than any line; more is a mistake that would only fill the memory.
constexpr int widest_field = 1'000'000;
/// No double has more digits than this in plain notation.
constexpr int most_digits = 1100;

/// [[fill]align][sign][#][0][width][,|_][.precision][type]
struct Spec {
  std::string fill = " ";
  char align = 0;
  char sign = '-';
  bool alternate = false;
  int width = 0;
  char grouping = 0;
  int precision = -1;
  char type = 0;
};

bool is_align(char c) { return c == '<' || c == '>' || c == '^' || c == '='; }

int read_number(std::string_view spec, std::size_t& at) {
  int number = -1;
  while (at < spec.size() && spec[at] >= '0' && spec[at] <= '9') {
    number = std::max(number, 0) * 10 + (spec[at++] - '0');
    if (number > widest_field) raise(ErrorKind::value, "Too many decimal digits in format string");
  }
  return number;
}

Spec parse_spec(std::string_view text, const Value& value) {
  Spec spec;
  std::size_t at = 0;
  std::size_t fill_length = 1;
  bool has_fill = false;
  if (!text.empty()) code_point_at(text, 0, fill_length);
  if (text.size() > fill_length && is_align(text[fill_length])) {
    spec.fill = std::string(text.substr(0, fill_length));
    spec.align = text[fill_length];
    at = fill_length + 1;
    has_fill = true;
  } else if (!text.empty() && is_align(text[0])) {
    spec.align = text[at++];
  }
  if (at < text.size() && (text[at] == '+' || text[at] == '-' || text[at] == ' ')) spec.sign = text[at++];
  if (at < text.size() && text[at] == '#') spec.alternate = ++at > 0;
  if (at < text.size() && text[at] == '0') {
    ++at;
    if (!has_fill) spec.fill = "0";
    if (spec.align == 0) spec.align = value.is_text() ? '<' : '=';
  }
  spec.width = std::max(read_number(text, at), 0);
  if (at < text.size() && (text[at] == ',' || text[at] == '_')) spec.grouping = text[at++];
  if (at < text.size() && text[at] == '.') {
    spec.precision = read_number(text, ++at);
    if (spec.precision < 0) raise(ErrorKind::value, "Format specifier missing precision");
  }
  if (at < text.size()) spec.type = text[at++];
  if (at < text.size()) {
    raise(ErrorKind::value,
          fmt::format("Invalid format specifier '{}' for object of type '{}'", text, value.type_name()),
          "a spec is [[fill]align][sign][width][.precision][type], as in >10.3f");
  }
  return spec;
}

[[noreturn]] void raise_unknown_type(const Spec& spec, const Value& value) {
  raise(ErrorKind::value, fmt::format("Unknown format code '{}' for object of type '{}'", spec.type, value.type_name()),
        value.is_text() ? "convert it to a number first, or use 's'" : "");
}

std::string pad(const std::string& body, const Spec& spec, char default_align) {
  const auto length = static_cast<int>(count_code_points(body));
  if (length >= spec.width) return body;
  const int missing = spec.width - length;
  const char align = spec.align == 0 ? default_align : spec.align;
  const int before = align == '<' ? 0 : align == '^' ? missing / 2 : missing;
  std::string out;
  for (int i = 0; i < before; ++i) out += spec.fill;
  out += body;
  for (int i = before; i < missing; ++i) out += spec.fill;
  return out;
}

std::string group_digits(const std::string& digits, char separator, std::size_t every) {
  std::string out;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && (digits.size() - i) % every == 0) out += separator;
    out += digits[i];
  }
  return out;
}

/// Sign, prefix, whole digits and the rest put together; '=' fills between sign and digits.
std::string assemble(bool negative, const std::string& prefix, std::string whole, const std::string& rest,
                     const Spec& spec, std::size_t group = 3) {
  std::string sign = negative ? "-" : spec.sign == '-' ? "" : std::string(1, spec.sign);
  sign += prefix;
  const bool fill_inside = spec.align == '=';
  if (spec.grouping != 0) {
    // Zeros that fill a grouped number are grouped too: format(1234, '09,') is '0,001,234'.
    if (fill_inside && spec.fill == "0") {
      const auto fixed = static_cast<int>(sign.size() + rest.size());
      while (static_cast<int>(group_digits("0" + whole, spec.grouping, group).size()) + fixed <= spec.width)
        whole.insert(0, "0");
      if (static_cast<int>(group_digits(whole, spec.grouping, group).size()) + fixed < spec.width) whole.insert(0, "0");
    }
    whole = group_digits(whole, spec.grouping, group);
  }
  std::string body = whole + rest;
  if (!fill_inside) return pad(sign + body, spec, '>');
  Spec inside = spec;
  inside.align = '>';
  inside.width = std::max(0, spec.width - static_cast<int>(sign.size()));
  return sign + pad(body, inside, '>');
}

/// The digits of |value| in one of the formats e, f, g (upper case given by the letter).
std::string real_digits(double value, char type, int precision, bool alternate) {
  if (std::isnan(value)) return type >= 'a' ? "nan" : "NAN";
  if (std::isinf(value)) return type >= 'a' ? "inf" : "INF";
  precision = std::min(precision, most_digits);
  switch (type) {
    case 'e':
      return alternate ? fmt::format("{:#.{}e}", value, precision) : fmt::format("{:.{}e}", value, precision);
    case 'E':
      return alternate ? fmt::format("{:#.{}E}", value, precision) : fmt::format("{:.{}E}", value, precision);
    case 'f':
    case 'F':
      return alternate ? fmt::format("{:#.{}f}", value, precision) : fmt::format("{:.{}f}", value, precision);
    case 'G':
      return alternate ? fmt::format("{:#.{}G}", value, std::max(precision, 1))
                       : fmt::format("{:.{}G}", value, std::max(precision, 1));
    default:
      return alternate ? fmt::format("{:#.{}g}", value, std::max(precision, 1))
                       : fmt::format("{:.{}g}", value, std::max(precision, 1));
  }
}

/// Without a type: like g, but as long as needed, and never without a digit behind the point.
std::string plain_digits(double value, const Spec& spec) {
  if (spec.precision < 0) return repr_of(value);
  std::string digits = real_digits(value, 'g', spec.precision, spec.alternate);
  if (!std::isfinite(value)) return digits;
  const std::size_t mark = digits.find('e');
  if (mark == std::string::npos) {
    // Here g would show a whole number without point; Python then goes to the exponent form one digit earlier.
    if (digits.find('.') != std::string::npos) return digits;
    const int shown = static_cast<int>(digits.size());
    if (shown < std::max(spec.precision, 1)) return digits + ".0";
    std::string scientific = fmt::format("{:.{}e}", value, std::max(spec.precision, 1) - 1);
    const std::size_t e = scientific.find('e');
    std::string mantissa = scientific.substr(0, e);
    if (mantissa.find('.') != std::string::npos) {
      while (mantissa.back() == '0') mantissa.pop_back();
      if (mantissa.back() == '.') mantissa.pop_back();
    }
    return mantissa + scientific.substr(e);
  }
  return digits;
}

std::string format_real(double value, Spec spec, const Value& shown) {
  const bool negative = std::signbit(value) && !std::isnan(value);
  const double size = std::abs(value);
  std::string digits;
  if (spec.type == 0) {
    digits = plain_digits(size, spec);
  } else if (spec.type == '%') {
    digits = real_digits(size * 100.0, 'f', spec.precision < 0 ? 6 : spec.precision, spec.alternate) + "%";
  } else if (std::string_view("eEfFgGn").find(spec.type) != std::string_view::npos) {
    digits =
        real_digits(size, spec.type == 'n' ? 'g' : spec.type, spec.precision < 0 ? 6 : spec.precision, spec.alternate);
  } else {
    raise_unknown_type(spec, shown);
  }
  const std::size_t end =
      std::isfinite(value) ? std::min(digits.find_first_not_of("0123456789"), digits.size()) : digits.size();
  if (!std::isfinite(value)) spec.grouping = 0;
  return assemble(negative, "", digits.substr(0, end), digits.substr(end), spec);
}

std::string format_integer(const Value& value, Spec spec) {
  if (spec.type != 0 && std::string_view("eEfFgG%").find(spec.type) != std::string_view::npos) {
    return format_real(real_of(value), spec, value);
  }
  if (spec.precision >= 0)
    raise(ErrorKind::value, "Precision not allowed in integer format specifier", "use f, e or g");
  const BigInteger number = *integer_of(value);
  if (spec.type == 'c') {
    std::string character;
    append_utf8(character, static_cast<char32_t>(std::clamp<std::int64_t>(index_of(value), 0, 0x10FFFF)));
    return pad(character, spec, '<');
  }
  int base = 10;
  std::string prefix;
  if (spec.type == 'x' || spec.type == 'X')
    base = 16;
  else if (spec.type == 'o')
    base = 8;
  else if (spec.type == 'b')
    base = 2;
  else if (spec.type != 0 && spec.type != 'd' && spec.type != 'n')
    raise_unknown_type(spec, value);
  if (spec.alternate && base != 10) prefix = std::string("0") + spec.type;
  std::string digits = base == 10 ? decimal_digits(number.magnitude()) : number.magnitude().to_string(base);
  if (spec.type == 'X')
    std::transform(digits.begin(), digits.end(), digits.begin(),
                   [](char c) { return c >= 'a' ? static_cast<char>(c - 32) : c; });
  return assemble(number.is_negative(), prefix, digits, "", spec, base == 10 ? 3 : 4);
}

std::string format_text(const std::string& text, const Spec& spec, const Value& value) {
  if (spec.type != 0 && spec.type != 's') raise_unknown_type(spec, value);
  if (spec.align == '=') raise(ErrorKind::value, "'=' alignment not allowed in string format specifier");
  if (spec.sign != '-') raise(ErrorKind::value, "Sign not allowed in string format specifier");
  std::string shown = text;
  if (spec.precision >= 0 && static_cast<int>(count_code_points(text)) > spec.precision) {
    auto points = decode_utf8(text);
    points.resize(static_cast<std::size_t>(spec.precision));
    shown = encode_utf8(points);
  }
  return pad(shown, spec, '<');
}

std::string format_complex(std::complex<double> value, Spec spec, const Value& shown) {
  Spec part = spec;
  part.width = 0;
  part.align = 0;
  const auto plain = [&](double x) {
    std::string text = format_real(x, part, shown);
    if (spec.type == 0 && text.ends_with(".0")) text.resize(text.size() - 2);
    return text;
  };
  const bool bare = spec.type == 0;
  std::string real = bare && value.real() == 0.0 && !std::signbit(value.real()) ? "" : plain(value.real());
  part.sign = real.empty() ? spec.sign : '+';
  std::string body = real + plain(value.imag()) + "j";
  return pad(bare && !real.empty() ? "(" + body + ")" : body, spec, '>');
}

}  // namespace

std::string format_value(const Value& value, std::string_view text, Meter& meter) {
  if (text.empty()) return text_of(value);
  const Spec spec = parse_spec(text, value);
  meter.allocate(static_cast<std::uint64_t>(spec.width));
  if (value.is_text()) return format_text(value.as_text(), spec, value);
  if (integer_of(value)) return format_integer(value, spec);
  if (value.is_real()) return format_real(value.as_real(), spec, value);
  if (value.is_complex()) return format_complex(value.as_complex(), spec, value);
  if (value.is_concept() || value.as_object<ExceptionObject>() != nullptr)
    return format_text(text_of(value), spec, value);
  raise(ErrorKind::type, "unsupported format string passed to " + value.type_name() + ".__format__",
        "convert it with str(...) first");
}

Value convert_value(const Value& value, char conversion) {
  if (value.is_unknown()) return value;
  if (conversion == 's') return text_of(value);
  if (conversion == 'r') return repr_of(value);
  std::string out;
  for (char32_t c : decode_utf8(repr_of(value))) {
    if (c < 0x80)
      out += static_cast<char>(c);
    else if (c < 0x100)
      out += fmt::format("\\x{:02x}", static_cast<unsigned>(c));
    else if (c < 0x10000)
      out += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    else
      out += fmt::format("\\U{:08x}", static_cast<unsigned>(c));
  }
  return out;
}

}  // namespace comma::interpreter
