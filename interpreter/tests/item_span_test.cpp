#include "interpreter/item_span.hpp"

#include <catch2/catch.hpp>

using namespace comma::interpreter;

namespace {

std::string item(const std::string& text, std::size_t index, std::size_t count) {
  const auto file = std::make_shared<const SourceFile>("a.comm", text);
  const Span span = item_span({file, 0, static_cast<std::uint32_t>(text.size())}, index, count);
  return text.substr(span.begin, span.end - span.begin);
}

}  // namespace

TEST_CASE("An item of a written tuple is found in its place") {
  CHECK(item("('A', 'B')", 1, 2) == "'B'");
  CHECK(item("['A',  # first\n  f(1, 2) + 3,\n]", 1, 2) == "f(1, 2) + 3");
  CHECK(item("((1, 2), -3.0)", 1, 2) == "-3.0");
  CHECK(item("('A')", 0, 1) == "'A'");
}

TEST_CASE("What is not written out item by item is marked as a whole") {
  for (const char* text : {"names", "names(1, 2)", "('A', 'B') + more", "[n for n in (1, 2)]", "(*a, *b)"}) {
    INFO(text);
    CHECK(item(text, 0, 2) == text);
  }
}
