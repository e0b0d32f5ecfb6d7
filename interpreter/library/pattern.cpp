#include "interpreter/library/pattern.hpp"

#include <fmt/format.h>

#include <regex>

#include "interpreter/values/exception.hpp"

namespace comma::interpreter {

bool finds_pattern(const std::string& text, const std::string& pattern) {
  constexpr std::size_t longest_pattern = 1000;  // its brackets are read by recursion
  if (pattern.size() > longest_pattern) raise(ErrorKind::value, "the pattern is too long");
  try {
    return std::regex_search(text, std::regex(pattern, std::regex::ECMAScript | std::regex_constants::__polynomial));
  } catch (const std::regex_error&) {
    raise(ErrorKind::value, fmt::format("the pattern {} cannot be read", Value(pattern).repr()),
          "write it without groups that are named or look around");
  }
}

}  // namespace comma::interpreter
