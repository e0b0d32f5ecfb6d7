#include "solver/io/text_scanner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

#include "solver/error.hpp"

namespace comma::solver {

namespace {

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\f'; }

}  // namespace

void TextScanner::skip_space() {
  while (at_ < text_.size() && is_space(text_[at_])) ++at_;
}

bool TextScanner::at_end() {
  skip_space();
  return at_ == text_.size();
}

std::string_view TextScanner::peek() {
  skip_space();
  std::size_t end = at_;
  while (end < text_.size() && !is_space(text_[end])) ++end;
  return text_.substr(at_, end - at_);
}

std::string_view TextScanner::word(std::string_view what) {
  const std::string_view found = peek();
  word_start_ = at_;
  if (found.empty()) fail(fmt::format("the file ends where {} should stand", what));
  at_ += found.size();
  return found;
}

int TextScanner::integer(std::string_view what) {
  return integer(what, std::numeric_limits<int>::min(), std::numeric_limits<int>::max());
}

int TextScanner::integer(std::string_view what, int least, int most) {
  const std::string_view found = word(what);
  int value = 0;
  const auto [end, error] = std::from_chars(found.data(), found.data() + found.size(), value);
  if (error != std::errc{} || end != found.data() + found.size())
    fail(fmt::format("{} should stand here, not {:.20}", what, found));
  if (value < least || value > most)
    fail(fmt::format("{} is {}, which is not between {} and {}", what, value, least, most));
  return value;
}

double TextScanner::real(std::string_view what) {
  const std::string_view found = word(what);
  std::string digits(found);
  // Fortran writes exponents with a D.
  std::ranges::replace(digits, 'D', 'E');
  std::ranges::replace(digits, 'd', 'e');
  double value = 0.0;
  const char* begin = digits.data() + (digits.starts_with('+') ? 1 : 0);
  const auto [end, error] = std::from_chars(begin, digits.data() + digits.size(), value);
  if (error != std::errc{} || end != digits.data() + digits.size() || !std::isfinite(value)) {
    fail(fmt::format("{} should stand here, not {:.20}", what, found));
  }
  return value;
}

std::string_view TextScanner::rest_of_line() {
  const std::size_t end = std::min(text_.find('\n', at_), text_.size());
  std::string_view line = text_.substr(at_, end - at_);
  at_ = end;
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

bool TextScanner::skip_to(std::string_view line_start) {
  while (!at_end()) {
    if (peek().starts_with(line_start)) {
      word(line_start);
      return true;
    }
    rest_of_line();
  }
  return false;
}

void TextScanner::fail(const std::string& what, const char* code, const std::string& hint) const {
  const std::string_view before = text_.substr(0, word_start_);
  const auto line = std::ranges::count(before, '\n') + 1;
  const std::size_t line_start = before.rfind('\n') == std::string_view::npos ? 0 : before.rfind('\n') + 1;
  throw Error(code, fmt::format("{}:{}:{}: {}", path_, line, word_start_ - line_start + 1, what), hint);
}

void require_regular_file(const std::string& path) {
  std::error_code failure;
  if (!std::filesystem::exists(path, failure) || failure || std::filesystem::is_regular_file(path, failure)) return;
  throw Error("unreadable-file", fmt::format("{} is not a regular file", path),
              "name a file on a disk: folders, devices and pipes are not read");
}

std::string read_text_file(const std::string& path) {
  require_regular_file(path);
  std::ifstream file(path, std::ios::binary);
  std::stringstream text;
  text << file.rdbuf();
  if (!file) throw Error("missing-file", fmt::format("cannot read {}", path), "see that it exists and may be read");
  return text.str();
}

}  // namespace comma::solver
