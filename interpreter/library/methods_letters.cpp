// The methods of str that look at letters: upper, title, isdigit ... Case is that of ASCII and Latin-1.
#include <algorithm>
#include <array>

#include "interpreter/library/builtins.hpp"
#include "interpreter/syntax/utf8.hpp"

namespace comma::interpreter {

namespace {

using Points = std::vector<char32_t>;

bool is_lower(char32_t c) { return (c >= 'a' && c <= 'z') || (c >= 0xDF && c <= 0xFF && c != 0xF7); }
bool is_upper(char32_t c) { return (c >= 'A' && c <= 'Z') || (c >= 0xC0 && c <= 0xDE && c != 0xD7); }
bool is_decimal(char32_t c) { return c >= '0' && c <= '9'; }
bool is_alpha(char32_t c) { return is_lower(c) || is_upper(c) || c == 0xAA || c == 0xB5 || c == 0xBA || c >= 0x100; }
char32_t to_lower(char32_t c) { return is_upper(c) ? c + 32 : c; }
char32_t to_upper(char32_t c) { return is_lower(c) && c != 0xDF && c != 0xFF ? c - 32 : c; }
template <class Change>
Value change_characters(const Value& self, Change change) {
  Points points = decode_utf8(self.as_text());
  change(points);
  return encode_utf8(points);
}

Value upper(Evaluator&, const Value& self, const CallArguments& arguments) {
  expect_arguments("upper", arguments, 0, 0);
  std::string out;
  for (char32_t c : decode_utf8(self.as_text())) {
    if (c == 0xDF)
      out += "SS";
    else
      append_utf8(out, to_upper(c));
  }
  return out;
}

Value lower(Evaluator&, const Value& self, const CallArguments& arguments) {
  expect_arguments("lower", arguments, 0, 0);
  return change_characters(self, [](Points& p) { std::transform(p.begin(), p.end(), p.begin(), to_lower); });
}

Value swapcase(Evaluator&, const Value& self, const CallArguments& arguments) {
  expect_arguments("swapcase", arguments, 0, 0);
  return change_characters(self, [](Points& p) {
    std::transform(p.begin(), p.end(), p.begin(), [](char32_t c) { return is_upper(c) ? to_lower(c) : to_upper(c); });
  });
}

Value capitalize(Evaluator&, const Value& self, const CallArguments& arguments) {
  expect_arguments("capitalize", arguments, 0, 0);
  return change_characters(self, [](Points& p) {
    for (std::size_t i = 0; i < p.size(); ++i) p[i] = i == 0 ? to_upper(p[i]) : to_lower(p[i]);
  });
}

Value title(Evaluator&, const Value& self, const CallArguments& arguments) {
  expect_arguments("title", arguments, 0, 0);
  return change_characters(self, [](Points& p) {
    for (std::size_t i = 0; i < p.size(); ++i) p[i] = i > 0 && is_alpha(p[i - 1]) ? to_lower(p[i]) : to_upper(p[i]);
  });
}
template <class Test>
bool all_characters(const Value& self, Test test) {
  const Points points = decode_utf8(self.as_text());
  return !points.empty() && std::all_of(points.begin(), points.end(), test);
}

Value isdigit(Evaluator&, const Value& self, const CallArguments&) { return all_characters(self, is_decimal); }
Value isalpha(Evaluator&, const Value& self, const CallArguments&) { return all_characters(self, is_alpha); }
Value isalnum(Evaluator&, const Value& self, const CallArguments&) {
  return all_characters(self, [](char32_t c) { return is_alpha(c) || is_decimal(c); });
}
Value isspace(Evaluator&, const Value& self, const CallArguments&) { return all_characters(self, is_blank_character); }

Value isupper(Evaluator&, const Value& self, const CallArguments&) {
  const Points points = decode_utf8(self.as_text());
  return std::any_of(points.begin(), points.end(), is_upper) && std::none_of(points.begin(), points.end(), is_lower);
}

Value islower(Evaluator&, const Value& self, const CallArguments&) {
  const Points points = decode_utf8(self.as_text());
  return std::any_of(points.begin(), points.end(), is_lower) && std::none_of(points.begin(), points.end(), is_upper);
}

Value isidentifier(Evaluator&, const Value& self, const CallArguments&) {
  const Points points = decode_utf8(self.as_text());
  return !points.empty() && !is_decimal(points[0]) &&
         all_characters(self, [](char32_t c) { return is_alpha(c) || is_decimal(c) || c == '_'; });
}
constexpr std::array letter_table = {
    MethodRow{"upper", upper},           MethodRow{"lower", lower},
    MethodRow{"capitalize", capitalize}, MethodRow{"title", title},
    MethodRow{"swapcase", swapcase},     MethodRow{"isdigit", isdigit},
    MethodRow{"isdecimal", isdigit},     MethodRow{"isnumeric", isdigit},
    MethodRow{"isalpha", isalpha},       MethodRow{"isalnum", isalnum},
    MethodRow{"isspace", isspace},       MethodRow{"isupper", isupper},
    MethodRow{"islower", islower},       MethodRow{"isidentifier", isidentifier},
    MethodRow{"casefold", lower},
};

}  // namespace

std::span<const MethodRow> letter_methods() { return letter_table; }

}  // namespace comma::interpreter
