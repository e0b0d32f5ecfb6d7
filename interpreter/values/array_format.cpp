// How arrays are written: as numpy writes them, eight digits behind the point at most, the numbers of one array alike.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "interpreter/values/array.hpp"

namespace comma::interpreter {

namespace {

constexpr int most_digits_shown = 8;              // numpy's precision
constexpr std::size_t line_width = 75;            // its linewidth
constexpr std::size_t most_numbers_shown = 1000;  // its threshold: of larger arrays only the edges are shown
constexpr std::size_t edge_items = 3;

using Words = std::vector<std::string>;

/// The fewest digits behind the point, up to eight, that read back as the number; without zeros at the end.
std::string short_digits(double value, char format) {
  std::string text;
  for (int digits = 0; digits <= most_digits_shown; ++digits) {
    text = format == 'e' ? fmt::format("{:#.{}e}", value, digits) : fmt::format("{:#.{}f}", value, digits);
    if (std::strtod(text.c_str(), nullptr) == value) return text;
  }
  const std::size_t end = std::min(text.find('e'), text.size());
  std::size_t kept = end;
  while (text[kept - 1] == '0') --kept;
  return text.erase(kept, end - kept);
}

bool wants_exponents(const std::vector<double>& values) {
  double largest = 0.0, smallest = HUGE_VAL;
  for (const double value : values) {
    if (!std::isfinite(value) || value == 0.0) continue;
    largest = std::max(largest, std::abs(value));
    smallest = std::min(smallest, std::abs(value));
  }
  return largest > 0.0 && (largest >= 1e8 || smallest < 1e-4 || largest / smallest > 1000.0);
}

/// A number before and behind its point, and its exponent.
struct Split {
  std::string whole, fraction, exponent;
};

Split split(const std::string& text) {
  const std::size_t mark = std::min(text.find('e'), text.size()), point = text.find('.');
  return {text.substr(0, point), text.substr(point + 1, mark - point - 1), text.substr(mark)};
}

std::string written_infinite(double value) { return std::isnan(value) ? "nan" : value < 0.0 ? "-inf" : "inf"; }

Words written_reals(const std::vector<double>& values) {
  const bool exponents = wants_exponents(values);
  std::vector<Split> parts;
  std::size_t left = 0, right = 0, behind = 0;
  for (const double value : values) {
    parts.push_back(std::isfinite(value) ? split(short_digits(value, exponents ? 'e' : 'f')) : Split{});
    left = std::max(left, parts.back().whole.size());
    right = std::max(right, parts.back().fraction.size());
    behind = std::max(behind, parts.back().exponent.size());
  }
  const std::size_t tail = right + behind + 1;
  for (const double value : values) {
    if (std::isfinite(value)) continue;
    const std::size_t length = written_infinite(value).size();
    if (length > tail) left = std::max(left, length - tail);
  }
  Words words;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i])) {
      words.push_back(fmt::format("{:>{}}", written_infinite(values[i]), left + tail));
      continue;
    }
    Split& part = parts[i];
    part.fraction.resize(right, exponents ? '0' : ' ');
    if (exponents && part.exponent.size() < behind) part.exponent.insert(2, behind - part.exponent.size(), '0');
    words.push_back(fmt::format("{:>{}}.{}{}", part.whole, left, part.fraction, part.exponent));
  }
  return words;
}

Words written(const std::vector<double>& values, NumberType type) {
  if (type == NumberType::real) return written_reals(values);
  Words words;
  std::size_t width = 0;
  for (const double value : values) {
    words.push_back(type == NumberType::boolean ? (value != 0.0 ? " True" : "False")
                                                : array_number(value, type).repr());
    width = std::max(width, words.back().size());
  }
  if (type == NumberType::integer)
    for (std::string& word : words) word.insert(0, width - word.size(), ' ');
  return words;
}

/// The places along an axis that are shown; where the middle is left out, `gap` comes first behind it.
struct Shown {
  std::vector<std::size_t> places;
  std::size_t gap = 0;
};

Shown shown_of(std::size_t length, bool edges_only) {
  Shown shown;
  const bool cut = edges_only && length > 2 * edge_items;
  for (std::size_t i = 0; i < length; ++i)
    if (!cut || i < edge_items || i >= length - edge_items) shown.places.push_back(i);
  if (cut) shown.gap = edge_items;
  return shown;
}

/// One row in brackets, in lines no longer than the width.
std::string written_row(std::span<const std::string> words, std::size_t gap, const std::string& separator,
                        std::size_t indent, std::size_t width) {
  std::string done, line(indent, ' ');
  const auto extend = [&](const std::string& word, std::size_t limit) {
    if (line.size() > indent && line.size() + word.size() > limit) {
      done += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
      line.assign(indent, ' ');
    }
    line += word;
  };
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (gap > 0 && i == gap) {
      extend("...", width - 1);
      line += separator;
    }
    const bool last = i + 1 == words.size();
    extend(words[i], width - 1);  // a bracket or a separator may follow
    if (!last) line += separator;
  }
  return "[" + (done + line).substr(indent) + "]";
}

/// The whole array; `indent` is what stands before its first bracket.
std::string written(const ArrayObject& array, const std::string& separator, std::size_t indent, std::size_t width) {
  const bool flat = array.shape.size() == 1;
  const bool edges_only = array.size() > most_numbers_shown;
  const Shown rows = flat ? Shown{{0}, 0} : shown_of(array.shape[0], edges_only);
  const std::size_t columns = array.shape.back();
  const Shown shown = shown_of(columns, edges_only);
  std::vector<double> values;
  for (const std::size_t i : rows.places)
    for (const std::size_t j : shown.places) values.push_back(array.at(i * columns + j));
  const Words words = written(values, array.type);
  const std::size_t count = shown.places.size();
  const auto row = [&](std::size_t i, std::size_t inner_indent, std::size_t inner_width) {
    return written_row(std::span(words).subspan(i * count, count), shown.gap, separator, inner_indent, inner_width);
  };
  if (flat) return row(0, indent + 1, width);
  const std::string between =
      separator.substr(0, separator.find_last_not_of(' ') + 1) + "\n" + std::string(indent + 1, ' ');
  std::string text = "[";
  for (std::size_t i = 0; i < rows.places.size(); ++i) {
    if (i > 0) text += between;
    if (rows.gap > 0 && i == rows.gap) text += "..." + between;
    text += row(i, indent + 2, width - 1);
  }
  return text + "]";
}

}  // namespace

std::string ArrayObject::text() const { return size() == 0 ? "[]" : written(*this, " ", 0, line_width); }

std::string ArrayObject::repr() const {
  if (size() > 0) return "array(" + written(*this, ", ", 6, line_width - 1) + ")";
  if (shape.size() == 1) return fmt::format("array([], dtype={})", name_of(type));
  return fmt::format("array([], shape=({}, {}), dtype={})", shape[0], shape[1], name_of(type));
}

}  // namespace comma::interpreter
