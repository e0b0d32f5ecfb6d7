#include "interpreter/item_span.hpp"

#include <vector>

#include "interpreter/diagnostic.hpp"
#include "interpreter/syntax/lexer.hpp"

namespace comma::interpreter {

namespace {

/// The items between the brackets that the text at `whole` begins and ends with; none if it is no plain display.
std::vector<Span> items_of(const Span& whole) {
  Diagnostics told_before;
  Lexer lexer(whole.file, told_before, whole.begin, whole.end, true);
  std::vector<Span> items;
  int depth = 0;
  bool fresh = true;  // at the beginning of an item
  for (Token token = lexer.next(); token.kind != TokenKind::end; token = lexer.next()) {
    const bool opens = token.text == "(" || token.text == "[" || token.text == "{";
    const bool closes = token.text == ")" || token.text == "]" || token.text == "}";
    if (depth == 0 && (!opens || token.begin != whole.begin)) return {};
    if (closes && --depth == 0) continue;
    if (depth == 1 && (token.text == "for" || token.text == "*")) return {};
    if (depth == 1 && token.text == ",") {
      fresh = true;
    } else if (depth >= 1) {
      if (fresh) items.push_back({whole.file, token.begin, token.end});
      items.back().end = token.end;
      fresh = false;
    }
    if (opens) ++depth;
  }
  return items;
}

}  // namespace

Span item_span(const Span& whole, std::size_t index, std::size_t count) {
  if (!whole) return whole;
  const std::vector<Span> items = items_of(whole);
  return items.size() == count && index < count ? items[index] : whole;
}

}  // namespace comma::interpreter
