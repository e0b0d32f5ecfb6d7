#include "interpreter/catalogue/explain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>

#include "interpreter/catalogue/check_rules.hpp"
#include "interpreter/catalogue/check_value.hpp"
#include "interpreter/catalogue/foreign_commands.hpp"
#include "interpreter/diagnostic.hpp"

namespace comma::interpreter {
namespace {

constexpr std::array<std::string_view, 10> categories{"mesh",  "model",        "material", "loads",     "contact",
                                                      "solve", "post-process", "verify",   "functions", "session"};

/// A keyword with the conditions under which its level has it.
struct Place {
  const KeywordPage* keyword = nullptr;
  std::string conditions;
};

std::vector<Place> places_of(const LevelPage& level) {
  std::vector<Place> places;
  visit_keywords(level, [&](const KeywordPage& keyword, const std::string& conditions) {
    places.push_back({&keyword, conditions});
  });
  return places;
}

/// A page of text under construction.
class Writer {
 public:
  explicit Writer(const Catalogue& catalogue) : catalogue_(catalogue) {}

  template <class... Arguments>
  void line(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Arguments>(arguments)...);
    text_ += '\n';
  }

  void command(const CommandPage& page) {
    line("{} - {}", page.name, page.doc);
    line("");
    line("  category   {}", page.category);
    products(page);
    reuse(page);
    line("  supported  {}", page.supported           ? "yes"
                            : only_writes(page.role) ? "not yet: using it is an alarm, and it is left out"
                                                     : "not yet: using it is an error");
    if (!page.note.empty()) line("  note       {}", page.note);
    level(page.inside);
    example(page);
  }

  void keyword(const std::string& path, const Place& place) {
    const KeywordPage& page = *place.keyword;
    line("{} - {}", path, page.doc);
    line("");
    line("  type       {}", types(page));
    if (page.holds_many() || page.is_factor()) line("  count      {}", count(page));
    if (!page.unit.empty()) line("  unit       {}", page.unit);
    if (const std::string bounds = describe_bounds(page.bounds); !bounds.empty()) line("  bounds     {}", bounds);
    if (page.required) line("  required   yes");
    if (page.default_value) line("  default    {}", page.default_value->repr());
    if (page.present_by_default) line("  default    _F() with the defaults of its keywords");
    if (!place.conditions.empty()) line("  only when  {}", place.conditions);
    if (!page.aliases.empty()) line("  older name {}", fmt::join(page.aliases, ", "));
    line("  supported  {}", page.supported ? "yes" : "not yet: using it is an error");
    if (!page.counts_when.empty()) line("  counts     when {}", page.counts_when);
    if (!page.no_effect.empty()) line("  no effect  {}", page.no_effect);
    words(page);
    if (page.is_factor()) level(page.inside);
  }

  std::string take() { return std::move(text_); }

 private:
  void products(const CommandPage& page) {
    if (page.products.empty()) line("  gives      nothing");
    for (const ProductPage& product : page.products)
      line("  gives      {} ({}){}", with_article(catalogue_.describe_type(product.type)), product.type,
           product.when.empty() ? "" : " when " + product.when);
  }

  void reuse(const CommandPage& page) {
    if (page.reuse == Reuse::none) return;
    const std::string_view policy = page.reuse == Reuse::compulsory ? "compulsory"
                                    : page.reuse == Reuse::beside   ? "allowed (a new concept all the same)"
                                                                    : "allowed";
    line("  reuse      {}, with the concept of {}", policy, fmt::join(page.reuse_same_as, " or "));
  }

  std::string types(const KeywordPage& page) const {
    return page.is_factor() ? "factor: _F(...)" : describe_types(page, catalogue_);
  }

  static std::string count(const KeywordPage& page) {
    return describe_count(page.min_count, page.max_count, page.is_factor() ? "occurrence" : "value");
  }

  void words(const KeywordPage& page) {
    if (page.words.empty()) return;
    line("");
    line("  words");
    for (const WordPage& word : page.words)
      line("    {:<20} {}{}", word.value.repr(), word.doc, word.supported ? "" : " [not supported yet]");
  }

  void level(const LevelPage& level_page) {
    line("");
    line("  keywords");
    keywords(level_page, "    ");
  }

  void keywords(const LevelPage& level_page, const std::string& indent) {
    for (const KeywordPage& keyword : level_page.keywords)
      line("{}{}{:<20} {}{}{}", indent, keyword.required ? "* " : "  ", keyword.name, keyword.doc,
           keyword.default_value ? " Default " + keyword.default_value->repr() + "." : "",
           keyword.supported ? "" : " [not supported yet]");
    if (level_page.further) line("{}  any other name       {}", indent, level_page.further->doc);
    for (const RulePage& rule : level_page.rules) line("{}rule: {}", indent, describe_rule(rule));
    for (const BlockPage& block : level_page.blocks) {
      line("{}when {}", indent, block.when);
      keywords(block.inside, indent + "  ");
    }
  }

  void example(const CommandPage& page) {
    if (page.example.empty()) return;
    line("");
    line("  example");
    std::size_t begin = 0;
    while (begin < page.example.size()) {
      const std::size_t end = std::min(page.example.find('\n', begin), page.example.size());
      line("    {}", page.example.substr(begin, end - begin));
      begin = end + 1;
    }
  }

  const Catalogue& catalogue_;
  std::string text_;
};

std::vector<Place> find_places(const LevelPage& level, std::string_view name) {
  std::vector<Place> found;
  for (const Place& place : places_of(level)) {
    const auto& aliases = place.keyword->aliases;
    if (place.keyword->name == name || std::ranges::find(aliases, name) != aliases.end()) found.push_back(place);
  }
  return found;
}

[[noreturn]] void throw_unknown_keyword(const std::string& level, const LevelPage& page, std::string_view name) {
  std::vector<std::string> known;
  for (const Place& place : places_of(page)) known.push_back(place.keyword->name);
  const std::string near = did_you_mean(name, known);
  throw DiagnosticError("unknown-keyword", fmt::format("{} has no keyword {}", level, name), {},
                        near.empty() ? fmt::format("'comma explain {}' lists its keywords", level) : near);
}

/// `rest` is a path below a level, one or several keywords long. A keyword that stands in several blocks is told once
/// for each.
void explain_keyword(Writer& writer, const std::string& above, const LevelPage& level, std::string_view rest) {
  const std::size_t slash = rest.find('/');
  const std::string_view name = rest.substr(0, slash);
  const std::vector<Place> places = find_places(level, name);
  if (places.empty()) throw_unknown_keyword(above, level, name);
  const std::string path = fmt::format("{}/{}", above, places.front().keyword->name);
  if (slash == std::string_view::npos) {
    for (const Place& place : places) {
      if (&place != &places.front()) writer.line("");
      writer.keyword(path, place);
    }
    return;
  }
  const std::string_view below = rest.substr(slash + 1);
  bool told = false;
  for (const Place& place : places) {
    if (find_places(place.keyword->inside, below.substr(0, below.find('/'))).empty()) continue;
    explain_keyword(writer, path, place.keyword->inside, below);
    told = true;
  }
  if (!told) throw_unknown_keyword(path, places.front().keyword->inside, below.substr(0, below.find('/')));
}

}  // namespace

std::string explain_all(const Catalogue& catalogue) {
  Writer writer(catalogue);
  const std::vector<std::string> names = catalogue.names();
  for (const std::string_view category : categories) {
    bool titled = false;
    for (const std::string& name : names) {
      const CommandPage& page = catalogue.page(name);
      if (page.category != category) continue;
      if (!titled) writer.line("{}", category);
      titled = true;
      writer.line("  {:<18} {}{}", name, page.doc, page.supported ? "" : " [not supported yet]");
    }
  }
  writer.line("\nMore: comma explain COMMAND, comma explain COMMAND/KEYWORD");
  return writer.take();
}

std::string explain(const Catalogue& catalogue, std::string_view path) {
  const std::size_t slash = path.find('/');
  const std::string command(path.substr(0, slash));
  if (!catalogue.has(command)) {
    const MissingCommand missing = missing_command(command, catalogue.names());
    throw DiagnosticError(missing.code, missing.message, {},
                          missing.hint.empty() ? "'comma explain' lists the commands" : missing.hint);
  }
  const CommandPage& page = catalogue.page(command);
  Writer writer(catalogue);
  if (slash == std::string_view::npos)
    writer.command(page);
  else
    explain_keyword(writer, command, page.inside, path.substr(slash + 1));
  return writer.take();
}

}  // namespace comma::interpreter
