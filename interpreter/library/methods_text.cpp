// The methods of str that cut, join, search and fill; those that look at letters are in methods_letters.cpp.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "interpreter/library/builtins.hpp"
#include "interpreter/syntax/utf8.hpp"
#include "interpreter/values/format.hpp"
#include "interpreter/values/operations.hpp"

namespace comma::interpreter {

namespace {

using Points = std::vector<char32_t>;

const std::string& text_argument(const CallArguments& arguments, std::size_t index, std::string_view function) {
  const Value& value = arguments[index];
  if (!value.is_text())
    raise(ErrorKind::type, fmt::format("{} argument {} must be str, not {}", function, index + 1, value.type_name()));
  return value.as_text();
}

enum class Side { both, left, right };

Value strip_side(const Value& self, const CallArguments& arguments, std::string_view name, Side side) {
  expect_arguments(name, arguments, 0, 1);
  const bool chosen = arguments.size() == 1 && !arguments[0].is_none();
  const Points which = chosen ? decode_utf8(text_argument(arguments, 0, fmt::format("{}()", name))) : Points();
  const auto goes = [&](char32_t c) {
    return chosen ? std::find(which.begin(), which.end(), c) != which.end() : is_blank_character(c);
  };
  const Points points = decode_utf8(self.as_text());
  std::size_t begin = 0, end = points.size();
  if (side != Side::right)
    while (begin < end && goes(points[begin])) ++begin;
  if (side != Side::left)
    while (end > begin && goes(points[end - 1])) --end;
  return encode_utf8(
      {points.begin() + static_cast<std::ptrdiff_t>(begin), points.begin() + static_cast<std::ptrdiff_t>(end)});
}

Value strip(Evaluator&, const Value& self, const CallArguments& arguments) {
  return strip_side(self, arguments, "strip", Side::both);
}
Value lstrip(Evaluator&, const Value& self, const CallArguments& arguments) {
  return strip_side(self, arguments, "lstrip", Side::left);
}
Value rstrip(Evaluator&, const Value& self, const CallArguments& arguments) {
  return strip_side(self, arguments, "rstrip", Side::right);
}

std::int64_t most_splits(const CallArguments& arguments) {
  const Value* limit = arguments.size() > 1 ? &arguments[1] : arguments.find("maxsplit");
  const std::int64_t most = limit != nullptr ? index_of(*limit) : -1;
  return most < 0 ? std::numeric_limits<std::int64_t>::max() : most;
}

const Value* separator_of(const CallArguments& arguments) {
  const Value* separator = arguments.size() > 0 ? &arguments[0] : arguments.find("sep");
  return separator == nullptr || separator->is_none() ? nullptr : separator;
}

std::vector<Value> split_blanks(const Points& points, std::int64_t most) {
  std::vector<Value> parts;
  std::size_t i = 0;
  while (true) {
    while (i < points.size() && is_blank_character(points[i])) ++i;
    if (i >= points.size()) return parts;
    std::size_t end = i;
    if (static_cast<std::int64_t>(parts.size()) < most) {
      while (end < points.size() && !is_blank_character(points[end])) ++end;
    } else {
      end = points.size();  // the rest as it stands, trailing blanks and all
    }
    parts.emplace_back(encode_utf8(
        {points.begin() + static_cast<std::ptrdiff_t>(i), points.begin() + static_cast<std::ptrdiff_t>(end)}));
    if (end >= points.size() || static_cast<std::int64_t>(parts.size()) > most) return parts;
    i = end;
  }
}

std::string checked_separator(const Value& separator) {
  if (!separator.is_text()) raise(ErrorKind::type, "must be str or None, not " + separator.type_name());
  if (separator.as_text().empty()) raise(ErrorKind::value, "empty separator");
  return separator.as_text();
}

Value split(Evaluator& evaluator, const Value& self, const CallArguments& arguments) {
  expect_arguments("split", arguments, 0, 2, {"sep", "maxsplit"});
  const std::int64_t most = most_splits(arguments);
  const std::string& text = self.as_text();
  evaluator.meter().allocate(text.size());
  const Value* separator = separator_of(arguments);
  if (separator == nullptr) return Value::list(split_blanks(decode_utf8(text), most));
  const std::string by = checked_separator(*separator);
  std::vector<Value> parts;
  std::size_t from = 0;
  for (std::size_t at = text.find(by); at != std::string::npos && static_cast<std::int64_t>(parts.size()) < most;
       at = text.find(by, from)) {
    parts.emplace_back(text.substr(from, at - from));
    from = at + by.size();
  }
  parts.emplace_back(text.substr(from));
  return Value::list(std::move(parts));
}

Value rsplit(Evaluator& evaluator, const Value& self, const CallArguments& arguments) {
  expect_arguments("rsplit", arguments, 0, 2, {"sep", "maxsplit"});
  const std::int64_t most = most_splits(arguments);
  const Value* separator = separator_of(arguments);
  // Splitting from the right is splitting the mirrored text from the left.
  Points points = decode_utf8(self.as_text());
  std::reverse(points.begin(), points.end());
  CallArguments mirrored;
  if (separator != nullptr) {
    Points by = decode_utf8(checked_separator(*separator));
    std::reverse(by.begin(), by.end());
    mirrored.positional.emplace_back(encode_utf8(by));
  } else {
    mirrored.positional.emplace_back();
  }
  mirrored.positional.emplace_back(most);
  const Value parts = split(evaluator, Value(encode_utf8(points)), mirrored);
  std::vector<Value> out;
  for (const Value& part : parts.items()) {
    Points own = decode_utf8(part.as_text());
    std::reverse(own.begin(), own.end());
    out.insert(out.begin(), Value(encode_utf8(own)));
  }
  return Value::list(std::move(out));
}

Value splitlines(Evaluator&, const Value& self, const CallArguments& arguments) {
  expect_arguments("splitlines", arguments, 0, 1, {"keepends"});
  const Value* option = arguments.size() > 0 ? &arguments[0] : arguments.find("keepends");
  const bool keep = option != nullptr && truth(*option);
  const std::string& text = self.as_text();
  std::vector<Value> lines;
  std::size_t from = 0;
  while (from < text.size()) {
    std::size_t end = text.find_first_of("\n\r\v\f\x1c\x1d\x1e", from);
    if (end == std::string::npos) end = text.size();
    std::size_t next = std::min(end + 1, text.size());
    if (end + 1 < text.size() && text[end] == '\r' && text[end + 1] == '\n') ++next;
    lines.emplace_back(text.substr(from, (keep ? next : end) - from));
    from = next;
  }
  return Value::list(std::move(lines));
}

Value join(Evaluator& evaluator, const Value& self, const CallArguments& arguments) {
  expect_arguments("join", arguments, 1, 1);
  std::string out;
  std::size_t index = 0;
  for (const Value& item : list_of(arguments[0], evaluator.meter())) {
    if (item.is_unknown()) return item;
    if (!item.is_text()) {
      raise(ErrorKind::type, fmt::format("sequence item {}: expected str instance, {} found", index, item.type_name()),
            "convert the items with str(...)");
    }
    if (index++ > 0) out += self.as_text();
    out += item.as_text();
    // Beforehand for the next item: the separator alone, many times over, may be too much.
    evaluator.meter().allocate(item.as_text().size());
    evaluator.meter().check_object(out.size() + self.as_text().size());
  }
  return out;
}

Value replace(Evaluator& evaluator, const Value& self, const CallArguments& arguments) {
  expect_arguments("replace", arguments, 2, 3);
  const std::string& old = text_argument(arguments, 0, "replace()");
  const std::string& fresh = text_argument(arguments, 1, "replace()");
  std::int64_t left = arguments.size() > 2 ? index_of(arguments[2]) : -1;
  const std::string& text = self.as_text();
  std::string out;
  std::size_t from = 0;
  while (left != 0) {
    const std::size_t at = old.empty() ? from : text.find(old, from);
    if (at == std::string::npos || at > text.size()) break;
    out += text.substr(from, at - from) + fresh;
    evaluator.meter().allocate(out.size() > 4096 ? fresh.size() : 0);
    if (out.size() > evaluator.meter().limits().largest_object) evaluator.meter().allocate(out.size());
    from = at + old.size();
    --left;
    if (!old.empty()) continue;
    if (at >= text.size()) return out;
    std::size_t length = 1;
    code_point_at(text, at, length);
    out += text.substr(at, length);
    from = at + length;
  }
  return out + text.substr(from);
}

/// Python's start and end arguments, as byte offsets; nothing when they exclude every place.
std::optional<std::pair<std::size_t, std::size_t>> byte_range(const std::string& text, const CallArguments& arguments,
                                                              std::size_t first) {
  SliceObject slice;
  if (arguments.size() > first) slice.start = arguments[first];
  if (arguments.size() > first + 1) slice.stop = arguments[first + 1];
  const auto length = static_cast<std::int64_t>(count_code_points(text));
  if (slice.start.is_integer() && slice.start.as_integer() > length) return std::nullopt;
  const SliceRange range = resolve_slice(slice, length);
  const auto bytes = [&](std::int64_t characters) {
    std::size_t at = 0, step = 1;
    for (; characters > 0 && at < text.size(); --characters, at += step) code_point_at(text, at, step);
    return at;
  };
  return std::pair{bytes(range.start), bytes(range.start + range.count)};
}

std::int64_t find_in(const Value& self, const CallArguments& arguments, std::string_view name, bool last) {
  expect_arguments(name, arguments, 1, 3);
  const std::string& wanted = text_argument(arguments, 0, fmt::format("{}()", name));
  const std::string& text = self.as_text();
  const auto range = byte_range(text, arguments, 1);
  if (!range) return -1;
  const std::string part = text.substr(range->first, range->second - range->first);
  const std::size_t at = last ? part.rfind(wanted) : part.find(wanted);
  if (at == std::string::npos) return -1;
  return static_cast<std::int64_t>(count_code_points(std::string_view(text).substr(0, range->first + at)));
}

Value find(Evaluator&, const Value& self, const CallArguments& arguments) {
  return find_in(self, arguments, "find", false);
}
Value rfind(Evaluator&, const Value& self, const CallArguments& arguments) {
  return find_in(self, arguments, "rfind", true);
}

Value index(Evaluator&, const Value& self, const CallArguments& arguments) {
  const std::int64_t place = find_in(self, arguments, "index", false);
  if (place < 0) raise(ErrorKind::value, "substring not found");
  return place;
}

Value rindex(Evaluator&, const Value& self, const CallArguments& arguments) {
  const std::int64_t place = find_in(self, arguments, "rindex", true);
  if (place < 0) raise(ErrorKind::value, "substring not found");
  return place;
}

Value count(Evaluator&, const Value& self, const CallArguments& arguments) {
  expect_arguments("count", arguments, 1, 3);
  const std::string& wanted = text_argument(arguments, 0, "count()");
  const auto range = byte_range(self.as_text(), arguments, 1);
  if (!range) return 0;
  const std::string part = self.as_text().substr(range->first, range->second - range->first);
  if (wanted.empty()) return static_cast<std::int64_t>(count_code_points(part)) + 1;
  std::int64_t found = 0;
  for (std::size_t at = part.find(wanted); at != std::string::npos; at = part.find(wanted, at + wanted.size())) ++found;
  return found;
}

bool matches_edge(const Value& self, const CallArguments& arguments, std::string_view name, bool start) {
  expect_arguments(name, arguments, 1, 3);
  const auto range = byte_range(self.as_text(), arguments, 1);
  if (!range) return false;
  const std::string part = self.as_text().substr(range->first, range->second - range->first);
  const auto fits = [&](const Value& edge) {
    if (!edge.is_text())
      raise(ErrorKind::type, fmt::format("{} first arg must be str or a tuple of str, not {}", name, edge.type_name()));
    return start ? part.starts_with(edge.as_text()) : part.ends_with(edge.as_text());
  };
  if (!arguments[0].is_tuple()) return fits(arguments[0]);
  return std::any_of(arguments[0].items().begin(), arguments[0].items().end(), fits);
}

Value startswith(Evaluator&, const Value& self, const CallArguments& arguments) {
  return matches_edge(self, arguments, "startswith", true);
}
Value endswith(Evaluator&, const Value& self, const CallArguments& arguments) {
  return matches_edge(self, arguments, "endswith", false);
}

Value removeprefix(Evaluator&, const Value& self, const CallArguments& arguments) {
  expect_arguments("removeprefix", arguments, 1, 1);
  const std::string& part = text_argument(arguments, 0, "removeprefix()");
  return self.as_text().starts_with(part) ? self.as_text().substr(part.size()) : self.as_text();
}

Value removesuffix(Evaluator&, const Value& self, const CallArguments& arguments) {
  expect_arguments("removesuffix", arguments, 1, 1);
  const std::string& part = text_argument(arguments, 0, "removesuffix()");
  return self.as_text().ends_with(part) ? self.as_text().substr(0, self.as_text().size() - part.size())
                                        : self.as_text();
}

Value adjust(Evaluator& evaluator, const Value& self, const CallArguments& arguments, std::string_view name,
             char align) {
  expect_arguments(name, arguments, 1, 2);
  const std::int64_t width = index_of(arguments[0]);
  std::string fill = arguments.size() > 1 ? text_argument(arguments, 1, fmt::format("{}()", name)) : " ";
  if (count_code_points(fill) != 1) raise(ErrorKind::type, "The fill character must be exactly one character long");
  const auto length = static_cast<std::int64_t>(count_code_points(self.as_text()));
  if (width <= length) return self;
  evaluator.meter().allocate(static_cast<std::uint64_t>(width));
  const std::int64_t missing = width - length;
  // str.center puts the odd blank left of a text of odd length in an even field, and so on: CPython's rule.
  const std::int64_t left = align == '<' ? 0 : align == '>' ? missing : missing / 2 + (missing & width & 1);
  std::string out;
  for (std::int64_t i = 0; i < left; ++i) out += fill;
  out += self.as_text();
  for (std::int64_t i = left; i < missing; ++i) out += fill;
  return out;
}

Value ljust(Evaluator& evaluator, const Value& self, const CallArguments& arguments) {
  return adjust(evaluator, self, arguments, "ljust", '<');
}
Value rjust(Evaluator& evaluator, const Value& self, const CallArguments& arguments) {
  return adjust(evaluator, self, arguments, "rjust", '>');
}
Value center(Evaluator& evaluator, const Value& self, const CallArguments& arguments) {
  return adjust(evaluator, self, arguments, "center", '^');
}

Value zfill(Evaluator& evaluator, const Value& self, const CallArguments& arguments) {
  expect_arguments("zfill", arguments, 1, 1);
  const std::int64_t missing = index_of(arguments[0]) - static_cast<std::int64_t>(count_code_points(self.as_text()));
  if (missing <= 0) return self;
  evaluator.meter().allocate(static_cast<std::uint64_t>(missing));
  std::string out = self.as_text();
  const std::size_t at = !out.empty() && (out[0] == '-' || out[0] == '+') ? 1 : 0;
  return out.insert(at, static_cast<std::size_t>(missing), '0');
}

Value partition_at(const Value& self, const CallArguments& arguments, std::string_view name, bool last) {
  expect_arguments(name, arguments, 1, 1);
  const std::string by = checked_separator(arguments[0]);
  const std::string& text = self.as_text();
  const std::size_t at = last ? text.rfind(by) : text.find(by);
  if (at == std::string::npos) return last ? Value::tuple({"", "", self}) : Value::tuple({self, "", ""});
  return Value::tuple({Value(text.substr(0, at)), Value(by), Value(text.substr(at + by.size()))});
}

Value partition(Evaluator&, const Value& self, const CallArguments& arguments) {
  return partition_at(self, arguments, "partition", false);
}
Value rpartition(Evaluator&, const Value& self, const CallArguments& arguments) {
  return partition_at(self, arguments, "rpartition", true);
}
Value expandtabs(Evaluator& evaluator, const Value& self, const CallArguments& arguments) {
  expect_arguments("expandtabs", arguments, 0, 1, {"tabsize"});
  const Value* option = arguments.size() > 0 ? &arguments[0] : arguments.find("tabsize");
  const std::int64_t size = option != nullptr ? std::clamp<std::int64_t>(index_of(*option), 0, 1000) : 8;
  std::string out;
  std::int64_t column = 0;
  for (char c : self.as_text()) {
    if (c != '\t') {
      out += c;
      column = c == '\n' || c == '\r' ? 0 : column + 1;
      continue;
    }
    const std::int64_t blanks = size > 0 ? size - column % size : 0;
    out.append(static_cast<std::size_t>(blanks), ' ');
    column += blanks;
    evaluator.meter().allocate(static_cast<std::uint64_t>(blanks));
  }
  return out;
}

/// Gives str.format its values: by number, by name, with .attribute and [key] behind.
class FieldReader {
 public:
  FieldReader(Evaluator& evaluator, const CallArguments& arguments) : evaluator_(evaluator), arguments_(arguments) {}

  Value operator()(std::string_view name) {
    const std::size_t end = std::min(name.find_first_of(".["), name.size());
    Value value = base(name.substr(0, end));
    std::string_view rest = name.substr(end);
    while (!rest.empty()) {
      if (rest[0] == '.') {
        const std::size_t stop = std::min(rest.find_first_of(".[", 1), rest.size());
        value = evaluator_.attribute(value, std::string(rest.substr(1, stop - 1)));
        rest.remove_prefix(stop);
        continue;
      }
      const std::size_t close = rest.find(']');
      if (close == rest.npos) raise(ErrorKind::value, "Missing ']' in format string");
      const std::string key(rest.substr(1, close - 1));
      const bool number = !key.empty() && key.size() < 10 &&
                          std::all_of(key.begin(), key.end(), [](char c) { return c >= '0' && c <= '9'; });
      value =
          subscript(value, number ? Value(static_cast<std::int64_t>(std::stoll(key))) : Value(key), evaluator_.meter());
      rest.remove_prefix(close + 1);
    }
    return value;
  }

 private:
  Value base(std::string_view name) {
    const bool number = std::all_of(name.begin(), name.end(), [](char c) { return c >= '0' && c <= '9'; });
    if (!number) {
      if (const Value* value = arguments_.find(name)) return *value;
      auto error = make_exception(ErrorKind::key, "");
      error->arguments = {Value(std::string(name))};
      throw RaisedError(std::move(error));
    }
    if (name.size() > 6) raise(ErrorKind::value, "Too many decimal digits in format string");
    if (name.empty() ? manual_ : automatic_) {
      raise(ErrorKind::value, name.empty()
                                  ? "cannot switch from manual field specification to automatic field numbering"
                                  : "cannot switch from automatic field numbering to manual field specification");
    }
    (name.empty() ? automatic_ : manual_) = true;
    const std::size_t index = name.empty() ? next_++ : static_cast<std::size_t>(std::stoul(std::string(name)));
    if (index < arguments_.size()) return arguments_[index];
    raise(ErrorKind::index, fmt::format("Replacement index {} out of range for positional args tuple", index));
  }

  Evaluator& evaluator_;
  const CallArguments& arguments_;
  std::size_t next_ = 0;
  bool automatic_ = false, manual_ = false;
};

Value format(Evaluator& evaluator, const Value& self, const CallArguments& arguments) {
  FieldReader reader(evaluator, arguments);
  return format_fields(
      self.as_text(), [&](std::string_view name) { return reader(name); }, evaluator.meter());
}
constexpr std::array text_table = {
    MethodRow{"strip", strip},
    MethodRow{"lstrip", lstrip},
    MethodRow{"rstrip", rstrip},
    MethodRow{"split", split},
    MethodRow{"rsplit", rsplit},
    MethodRow{"splitlines", splitlines},
    MethodRow{"join", join},
    MethodRow{"replace", replace},
    MethodRow{"find", find},
    MethodRow{"rfind", rfind},
    MethodRow{"index", index},
    MethodRow{"rindex", rindex},
    MethodRow{"count", count},
    MethodRow{"startswith", startswith},
    MethodRow{"endswith", endswith},
    MethodRow{"removeprefix", removeprefix},
    MethodRow{"removesuffix", removesuffix},
    MethodRow{"ljust", ljust},
    MethodRow{"rjust", rjust},
    MethodRow{"center", center},
    MethodRow{"zfill", zfill},
    MethodRow{"partition", partition},
    MethodRow{"rpartition", rpartition},
    MethodRow{"expandtabs", expandtabs},
    MethodRow{"format", format},
};

}  // namespace

std::span<const MethodRow> text_methods() { return text_table; }

}  // namespace comma::interpreter
