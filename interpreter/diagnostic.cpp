#include "interpreter/diagnostic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <utility>

namespace comma::interpreter {

namespace {

/// Longer lines are cut around the caret, so that a generated file does not flood the terminal.
constexpr std::size_t widest_line = 160;

std::size_t count_characters(std::string_view text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

/// Tabs are kept under tabs so that the caret stands below its character in any terminal.
std::string blanks_under(std::string_view text) {
  std::string blanks;
  for (char c : text) {
    if (c == '\t')
      blanks += '\t';
    else if ((static_cast<unsigned char>(c) & 0xC0) != 0x80)
      blanks += ' ';
  }
  return blanks;
}

/// A recursion has many calls, which say nothing new.
constexpr std::size_t most_calls_told = 4;

std::string render_place(const Span& span) {
  const Position place = span.file->position(span.begin);
  return fmt::format("{}:{}:{}", span.file->path(), place.line, place.column);
}

std::string render_excerpt(const Span& span) {
  const Position place = span.file->position(span.begin);
  const std::string_view line = span.file->line(place.line);
  const auto line_begin = static_cast<std::size_t>(line.data() - span.file->text().data());
  const std::size_t column =
      std::min<std::size_t>(span.begin - std::min<std::size_t>(line_begin, span.begin), line.size());
  const std::size_t marked_end =
      std::clamp<std::size_t>(span.end - std::min<std::size_t>(line_begin, span.end), column, line.size());

  std::size_t from = 0;
  std::size_t until = line.size();
  if (line.size() > widest_line) {
    from = column > widest_line / 2 ? column - widest_line / 2 : 0;
    until = std::min(line.size(), from + widest_line);
  }
  while (from > 0 && (static_cast<unsigned char>(line[from]) & 0xC0) == 0x80) --from;
  const std::string before = from > 0 ? "... " : "";
  const std::string after = until < line.size() ? " ..." : "";
  const std::string number = std::to_string(place.line);
  const std::size_t width =
      count_characters(line.substr(column, std::min(marked_end, until) - std::min(column, until)));

  std::string text = fmt::format("  {} | {}{}{}\n", number, before, line.substr(from, until - from), after);
  text += fmt::format("  {} | {}{}^{}", std::string(number.size(), ' '), std::string(before.size(), ' '),
                      blanks_under(line.substr(from, column - from)), std::string(width > 1 ? width - 1 : 0, '~'));
  return text;
}

/// Optimal string alignment: insertions, deletions, substitutions and swaps of neighbours cost one each.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> cost(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) cost[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) cost[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t change = a[i - 1] == b[j - 1] ? 0 : 1;
      cost[i][j] = std::min({cost[i - 1][j] + 1, cost[i][j - 1] + 1, cost[i - 1][j - 1] + change});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        cost[i][j] = std::min(cost[i][j], cost[i - 2][j - 2] + 1);
      }
    }
  }
  return cost[a.size()][b.size()];
}

std::string lower(std::string_view word) {
  std::string text(word);
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

std::size_t common_prefix(std::string_view a, std::string_view b) {
  return static_cast<std::size_t>(std::ranges::mismatch(a, b).in1 - a.begin());
}

/// No known word is longer; a longer one is no misspelling of any, and its distance table would be a waste.
constexpr std::size_t longest_known_word = 64;

}  // namespace

std::string_view name_of(Severity severity) {
  switch (severity) {
    case Severity::error:
      return "error";
    case Severity::alarm:
      return "alarm";
    case Severity::info:
      return "info";
  }
  return "error";
}

std::string render(const Diagnostic& diagnostic) {
  std::string text;
  if (diagnostic.span) text = render_place(diagnostic.span) + ": ";
  text += fmt::format("{}: {} [{}]", name_of(diagnostic.severity), diagnostic.message, diagnostic.code);
  std::string margin = "  ";
  if (diagnostic.span) {
    text += "\n" + render_excerpt(diagnostic.span);
    margin.append(std::to_string(diagnostic.span.file->position(diagnostic.span.begin).line).size() + 1, ' ');
  }
  if (!diagnostic.hint.empty()) text += "\n" + margin + "= hint: " + diagnostic.hint;
  for (std::size_t k = 0; k < std::min(diagnostic.called_from.size(), most_calls_told); ++k)
    text += "\n" + margin + "= called at " + render_place(diagnostic.called_from[k]);
  return text;
}

void Diagnostics::add(Diagnostic diagnostic) {
  if (handled_ && diagnostic.severity == Severity::error) diagnostic.severity = Severity::alarm;
  if (diagnostic.called_from.empty()) diagnostic.called_from = called_from();
  items_.push_back(std::move(diagnostic));
}

void Diagnostics::error(std::string code, std::string message, Span span, std::string hint) {
  add({Severity::error, std::move(code), std::move(message), std::move(hint), std::move(span), {}});
}

void Diagnostics::alarm(std::string code, std::string message, Span span, std::string hint) {
  add({Severity::alarm, std::move(code), std::move(message), std::move(hint), std::move(span), {}});
}

std::vector<Diagnostic> Diagnostics::distinct() const {
  std::vector<Diagnostic> told;
  for (const Diagnostic& item : items_)
    if (std::find(told.begin(), told.end(), item) == told.end()) told.push_back(item);
  return told;
}

bool Diagnostics::has_errors() const {
  return std::any_of(items_.begin(), items_.end(), [](const Diagnostic& d) { return d.severity == Severity::error; });
}

std::string nearest(std::string_view word, const std::vector<std::string>& known) {
  if (word.empty() || word.size() > longest_known_word) return {};
  const std::size_t most = std::max<std::size_t>(word.size() / 3, word.size() > 1 ? 1 : 0);
  const std::string folded = lower(word);
  std::string best;
  std::size_t best_distance = most + 1;
  std::pair<bool, std::size_t> best_likeness;
  for (const std::string& candidate : known) {
    if (candidate.size() > word.size() + most || candidate.size() + most < word.size() || candidate == word) continue;
    // A word in the wrong case is one slip, however long it is.
    const std::size_t distance = std::min(edit_distance(word, candidate), edit_distance(folded, lower(candidate)) + 1);
    if (distance > most || distance > best_distance) continue;
    // Of words as near, the one of the same letters, and then the one that begins like the written one: a slip in the
    // first letters is rare.
    const std::pair likeness(std::ranges::is_permutation(folded, lower(candidate)),
                             common_prefix(folded, lower(candidate)));
    if (distance == best_distance && likeness <= best_likeness) continue;
    best_distance = distance;
    best_likeness = likeness;
    best = candidate;
  }
  return best;
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& known) {
  const std::string near = nearest(word, known);
  return near.empty() ? "" : fmt::format("did you mean {}?", near);
}

}  // namespace comma::interpreter
