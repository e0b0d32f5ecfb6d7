// "%8.3f" % value and "{0:8.3f}".format(value).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "interpreter/syntax/utf8.hpp"
#include "interpreter/values/exception.hpp"
#include "interpreter/values/format.hpp"
#include "interpreter/values/operations.hpp"
#include "interpreter/values/repr.hpp"

namespace comma::interpreter {

namespace {

constexpr int widest_legacy_field = 1'000'000;
constexpr int beyond_any_field = widest_legacy_field + 1;

/// Reads "%..." conversions one after the other and draws their values.
class PercentFormatter {
 public:
  PercentFormatter(const std::string& text, const Value& arguments, Meter& meter)
      : text_(text), arguments_(arguments), meter_(meter) {}

  std::string run() {
    std::string out;
    while (at_ < text_.size()) {
      if (text_[at_] != '%') {
        out += text_[at_++];
        continue;
      }
      ++at_;
      if (at_ < text_.size() && text_[at_] == '%') {
        out += text_[at_++];
        continue;
      }
      out += conversion();
    }
    const bool leftover = arguments_.is_tuple()
                              ? drawn_ < arguments_.items().size()
                              : drawn_ == 0 && !by_name_ && !arguments_.is_dict() && !arguments_.is_list();
    if (leftover)
      raise(ErrorKind::type, "not all arguments converted during string formatting", "count the % in the text");
    return out;
  }

 private:
  Value draw() {
    if (arguments_.is_tuple()) {
      if (drawn_ < arguments_.items().size()) return arguments_.items()[drawn_++];
    } else if (drawn_++ == 0) {
      return arguments_;
    }
    raise(ErrorKind::type, "not enough arguments for format string", "give one value for each %");
  }

  int number_or_star() {
    if (at_ < text_.size() && text_[at_] == '*') {
      ++at_;
      const Value width = draw();
      if (!integer_of(width)) raise(ErrorKind::type, "* wants int");
      return static_cast<int>(std::clamp<std::int64_t>(index_of(width), -beyond_any_field, beyond_any_field));
    }
    int number = 0;
    while (at_ < text_.size() && text_[at_] >= '0' && text_[at_] <= '9')
      number = std::min(number * 10 + (text_[at_++] - '0'), beyond_any_field);
    return number;
  }

  Value named_value() {
    const std::size_t close = text_.find(')', at_);
    if (close == std::string::npos) raise(ErrorKind::value, "incomplete format key");
    const Value key(text_.substr(at_ + 1, close - at_ - 1));
    at_ = close + 1;
    by_name_ = true;
    if (!arguments_.is_dict()) raise(ErrorKind::type, "format requires a mapping", "give a dict after %");
    return subscript(arguments_, key, meter_);
  }

  std::string conversion() {
    std::optional<Value> value;
    if (at_ < text_.size() && text_[at_] == '(') value = named_value();
    std::string flags;
    while (at_ < text_.size() && std::string_view("-+ #0").find(text_[at_]) != std::string_view::npos)
      flags += text_[at_++];
    int width = number_or_star();
    if (width < 0) {
      flags += '-';
      width = -width;
    }
    int precision = -1;
    if (at_ < text_.size() && text_[at_] == '.') {
      ++at_;
      precision = std::max(0, number_or_star());
    }
    while (at_ < text_.size() && (text_[at_] == 'l' || text_[at_] == 'h' || text_[at_] == 'L')) ++at_;
    if (at_ >= text_.size()) raise(ErrorKind::value, "incomplete format");
    const char type = text_[at_++];
    if (std::string_view("diouxXeEfFgGcrsa").find(type) == std::string_view::npos) {
      raise(ErrorKind::value,
            fmt::format("unsupported format character '{}' (0x{:x}) at index {}", type,
                        static_cast<unsigned char>(type), at_ - 1),
            "write %% for the character itself");
    }
    if (!value) value = draw();
    if (width > widest_legacy_field) raise(ErrorKind::value, "width too big");
    const bool cuts_text = std::string_view("rsa").find(type) != std::string_view::npos;
    if (precision > widest_legacy_field && !cuts_text) raise(ErrorKind::value, "precision too big");
    meter_.allocate(static_cast<std::uint64_t>(width + std::max(precision, 0)));
    return fill(body(*value, type, flags, precision), flags, width, type);
  }

  std::string body(const Value& value, char type, const std::string& flags, int precision) {
    if (type == 's' || type == 'r' || type == 'a') {
      const Value shown = type == 's' ? Value(text_of(value)) : convert_value(value, type);
      return precision < 0 || precision > widest_legacy_field
                 ? shown.as_text()
                 : format_value(shown, "." + std::to_string(precision), meter_);
    }
    if (type == 'c') return character(value);
    if (std::string_view("eEfFgG").find(type) != std::string_view::npos) return real(value, type, flags, precision);
    return integer(value, type, flags, precision);
  }

  std::string character(const Value& value) {
    if (value.is_text() && count_code_points(value.as_text()) == 1) return value.as_text();
    if (!integer_of(value)) raise(ErrorKind::type, "%c requires int or char");
    std::string out;
    const std::int64_t code = index_of(value);
    if (code < 0 || code > 0x10FFFF) raise(ErrorKind::overflow, "%c arg not in range(0x110000)");
    append_utf8(out, static_cast<char32_t>(code));
    return out;
  }

  static std::string sign_spec(const std::string& flags) {
    return flags.find('+') != std::string::npos ? "+" : flags.find(' ') != std::string::npos ? " " : "";
  }

  std::string real(const Value& value, char type, const std::string& flags, int precision) {
    if (!is_numeric(value) || value.is_complex())
      raise(ErrorKind::type, "must be real number, not " + value.type_name());
    std::string spec = sign_spec(flags) + (flags.find('#') != std::string::npos ? "#" : "");
    spec += fmt::format(".{}{}", precision < 0 ? 6 : precision, type);
    return format_value(Value(real_of(value)), spec, meter_);
  }

  std::string integer(const Value& value, char type, const std::string& flags, int precision) {
    Value number = value;
    const bool decimal = type == 'd' || type == 'i' || type == 'u';
    if (value.is_real() && decimal) {
      if (std::isnan(value.as_real())) raise(ErrorKind::value, "cannot convert float NaN to integer");
      if (std::isinf(value.as_real())) raise(ErrorKind::overflow, "cannot convert float infinity to integer");
      number = Value::integer(BigInteger::from_double(value.as_real()));
    } else if (!integer_of(value)) {
      raise(ErrorKind::type, fmt::format("%{} format: {} is required, not {}", type,
                                         decimal ? "a real number" : "an integer", value.type_name()));
    }
    const BigInteger big = *integer_of(number);
    const int base = decimal ? 10 : type == 'o' ? 8 : 16;
    std::string digits = base == 10 ? decimal_digits(big.magnitude()) : big.magnitude().to_string(base);
    if (precision > static_cast<int>(digits.size()))
      digits.insert(0, static_cast<std::size_t>(precision) - digits.size(), '0');
    if (type == 'X')
      std::transform(digits.begin(), digits.end(), digits.begin(),
                     [](char c) { return c >= 'a' ? static_cast<char>(c - 32) : c; });
    const std::string prefix = flags.find('#') != std::string::npos && !decimal ? std::string("0") + type : "";
    return (big.is_negative() ? "-" : sign_spec(flags)) + prefix + digits;
  }

  static std::string fill(std::string body, const std::string& flags, int width, char type) {
    const int missing = width - static_cast<int>(count_code_points(body));
    if (missing <= 0) return body;
    const auto blanks = static_cast<std::size_t>(missing);
    if (flags.find('-') != std::string::npos) return body + std::string(blanks, ' ');
    const bool number = std::string_view("crsa").find(type) == std::string_view::npos;
    if (!number || flags.find('0') == std::string::npos) return std::string(blanks, ' ') + body;
    std::size_t digits = body[0] == '-' || body[0] == '+' || body[0] == ' ' ? 1 : 0;
    if (body.size() > digits + 1 && body[digits] == '0' && (body[digits + 1] | 0x20) == 'x') digits += 2;
    return body.insert(digits, blanks, '0');
  }

  const std::string& text_;
  const Value& arguments_;
  Meter& meter_;
  std::size_t at_ = 0;
  std::size_t drawn_ = 0;
  bool by_name_ = false;
};

/// "{name!r:spec}" without its braces: three parts.
struct Field {
  std::string_view name, spec;
  char conversion = 0;
};

Field split_field(std::string_view inside) {
  Field field;
  std::size_t end = 0;
  int brackets = 0;
  while (end < inside.size() && ((inside[end] != '!' && inside[end] != ':') || brackets > 0)) {
    if (inside[end] == '[') ++brackets;
    if (inside[end] == ']') --brackets;
    ++end;
  }
  field.name = inside.substr(0, end);
  if (end < inside.size() && inside[end] == '!') {
    if (end + 1 >= inside.size()) raise(ErrorKind::value, "end of string while looking for conversion specifier");
    field.conversion = inside[end + 1];
    if (std::string_view("rsa").find(field.conversion) == std::string_view::npos) {
      raise(ErrorKind::value, fmt::format("Unknown conversion specifier {}", field.conversion));
    }
    end += 2;
    if (end < inside.size() && inside[end] != ':') raise(ErrorKind::value, "expected ':' after conversion specifier");
  }
  if (end < inside.size()) field.spec = inside.substr(end + 1);
  return field;
}

std::string format_level(std::string_view text, const std::function<Value(std::string_view)>& value_of, Meter& meter,
                         int level) {
  if (level > 1) raise(ErrorKind::value, "Max string recursion exceeded");
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if ((c == '{' || c == '}') && i + 1 < text.size() && text[i + 1] == c) {
      out += c;
      ++i;
    } else if (c == '}') {
      raise(ErrorKind::value, "Single '}' encountered in format string", "write }} for the character itself");
    } else if (c != '{') {
      out += c;
    } else {
      std::size_t close = i + 1;
      for (int depth = 0; close < text.size() && (text[close] != '}' || depth > 0); ++close) {
        if (text[close] == '{') ++depth;
        if (text[close] == '}') --depth;
      }
      if (close >= text.size())
        raise(ErrorKind::value,
              i + 1 < text.size() ? "expected '}' before end of string" : "Single '{' encountered in format string",
              "write {{ for the character itself");
      const Field field = split_field(text.substr(i + 1, close - i - 1));
      Value value = value_of(field.name);
      if (field.conversion != 0) value = convert_value(value, field.conversion);
      const bool nested = field.spec.find_first_of("{}") != field.spec.npos;
      const std::string spec = nested ? format_level(field.spec, value_of, meter, level + 1) : std::string(field.spec);
      out += format_value(value, spec, meter);
      i = close;
    }
  }
  return out;
}

}  // namespace

std::string format_percent(const std::string& text, const Value& arguments, Meter& meter) {
  return PercentFormatter(text, arguments, meter).run();
}

std::string format_fields(const std::string& text, const std::function<Value(std::string_view)>& field, Meter& meter) {
  return format_level(text, field, meter, 0);
}

}  // namespace comma::interpreter
