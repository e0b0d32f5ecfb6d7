#include "interpreter/catalogue/catalogue_page.hpp"

#include <stdexcept>
#include <string>

#include "interpreter/catalogue/message_pack.hpp"

namespace comma::interpreter {
namespace {

std::string text_at(const Packed& packed, const char* key, std::string otherwise = {}) {
  const Packed* found = packed.find(key);
  return found == nullptr ? std::move(otherwise) : std::string(found->text());
}

bool flag_at(const Packed& packed, const char* key, bool otherwise) {
  const Packed* found = packed.find(key);
  return found == nullptr ? otherwise : found->flag();
}

std::vector<std::string> texts(const Packed& packed) {
  if (packed.is_text()) return {std::string(packed.text())};
  std::vector<std::string> result;
  for (const Packed& item : packed.list()) result.emplace_back(item.text());
  return result;
}

Value value_from(const Packed& packed) {
  if (packed.is_flag()) return Value(packed.flag());
  if (packed.is_integer()) return Value(packed.integer());
  if (packed.is_real()) return Value(packed.number());
  if (packed.is_text()) return Value(std::string(packed.text()));
  if (!packed.is_list())
    throw std::runtime_error("catalogue: a default or a word is a number, a text or a list of them");
  std::vector<Value> items;
  for (const Packed& item : packed.list()) items.push_back(value_from(item));
  return Value::tuple(std::move(items));
}

std::shared_ptr<const Expression> condition_from(const std::string& when) {
  return std::make_shared<const Expression>(when, "<condition of a block>");
}

std::vector<TypePage> types_from(const Packed& packed) {
  std::vector<TypePage> types;
  for (const std::string& word : texts(packed)) {
    const auto kind = kind_named(word);
    types.push_back(kind ? TypePage{*kind, ""} : TypePage{Kind::concept_kind, word});
  }
  return types;
}

WordPage word_from(Value value, const Packed& about) {
  WordPage word;
  word.value = std::move(value);
  if (about.is_text()) word.doc = about.text();
  if (!about.is_map()) return word;
  word.doc = text_at(about, "doc");
  word.supported = flag_at(about, "supported", true);
  word.no_effect = text_at(about, "no_effect");
  return word;
}

/// A list of bare words, or a mapping from each word to its line of documentation or its properties.
std::vector<WordPage> words_from(const Packed& packed, bool integers) {
  std::vector<WordPage> words;
  if (packed.is_list()) {
    for (const Packed& word : packed.list()) words.push_back(word_from(value_from(word), Packed()));
    return words;
  }
  words.reserve(packed.map().size());
  for (const auto& [word, about] : packed.map()) {
    Value value = integers ? Value(static_cast<std::int64_t>(std::stoll(std::string(word)))) : Value(std::string(word));
    words.push_back(word_from(std::move(value), about));
  }
  return words;
}

Bounds bounds_from(const Packed& packed) {
  const auto number = [&](const char* key) -> std::optional<double> {
    const Packed* found = packed.find(key);
    if (found == nullptr) return std::nullopt;
    return found->number();
  };
  return {number("above"), number("at_least"), number("below"), number("at_most")};
}

int count_from(const Packed& packed) { return packed.is_text() ? unlimited : static_cast<int>(packed.integer()); }

LevelPage level_from(const Packed& packed);

KeywordPage keyword_from(std::string_view name, const Packed& packed) {
  KeywordPage keyword;
  keyword.name = name;
  if (const Packed* found = packed.find("aliases")) keyword.aliases = texts(*found);
  keyword.doc = text_at(packed, "doc");
  keyword.unit = text_at(packed, "unit");
  keyword.types = types_from(*packed.find("type"));
  if (const Packed* found = packed.find("max")) keyword.max_count = count_from(*found);
  if (const Packed* found = packed.find("min")) keyword.min_count = count_from(*found);
  if (const Packed* found = packed.find("words"))
    keyword.words = words_from(*found, keyword.types.front().kind == Kind::integer);
  keyword.bounds = bounds_from(packed);
  keyword.required = flag_at(packed, "required", false);
  keyword.supported = flag_at(packed, "supported", true);
  keyword.no_effect = text_at(packed, "no_effect");
  keyword.missed = flag_at(packed, "missed", false);
  keyword.counts_when = text_at(packed, "counts_when");
  if (!keyword.counts_when.empty()) keyword.counts = condition_from(keyword.counts_when);
  const Packed* standard = packed.find("default");
  if (keyword.is_factor()) {
    keyword.present_by_default = standard != nullptr;
    keyword.inside = level_from(packed);
  } else if (standard != nullptr) {
    keyword.default_value = value_from(*standard);
  }
  return keyword;
}

RulePage rule_from(const Packed& packed) {
  const auto& [word, keywords] = packed.map().at(0);
  const auto kind = rule_named(word);
  if (!kind) throw std::runtime_error("catalogue: no rule is called " + std::string(word));
  return {*kind, texts(keywords)};
}

BlockPage block_from(const Packed& packed) {
  BlockPage block;
  block.when = text_at(packed, "when");
  block.condition = condition_from(block.when);
  block.inside = level_from(packed);
  return block;
}

LevelPage level_from(const Packed& packed) {
  LevelPage level;
  if (const Packed* found = packed.find("keywords"))
    for (const auto& [name, keyword] : found->map()) level.keywords.push_back(keyword_from(name, keyword));
  if (const Packed* found = packed.find("rules"))
    for (const Packed& rule : found->list()) level.rules.push_back(rule_from(rule));
  if (const Packed* found = packed.find("blocks"))
    for (const Packed& block : found->list()) level.blocks.push_back(block_from(block));
  if (const Packed* found = packed.find("further"))
    level.further = std::make_shared<const KeywordPage>(keyword_from("", *found));
  return level;
}

std::vector<ProductPage> products_from(const Packed& packed) {
  if (packed.is_null()) return {};
  if (packed.is_text()) return {ProductPage{"", nullptr, std::string(packed.text()), ""}};
  std::vector<ProductPage> products;
  for (const Packed& item : packed.list()) {
    const std::string when = text_at(item, "when");
    products.push_back(
        {when, when.empty() ? nullptr : condition_from(when), text_at(item, "type"), text_at(item, "like")});
  }
  return products;
}

Role role_from(const std::string& word) {
  if (word == "verdict") return Role::verdict;
  if (word == "output") return Role::output;
  if (word == "naming") return Role::naming;
  if (word == "setup") return Role::setup;
  return Role::value;
}

void read_reuse(const Packed& packed, CommandPage& page) {
  const Packed* found = packed.find("reuse");
  if (found == nullptr) return;
  const std::string policy = text_at(*found, "policy");
  page.reuse = policy == "compulsory" ? Reuse::compulsory : policy == "beside" ? Reuse::beside : Reuse::allowed;
  page.reuse_same_as = texts(*found->find("same_as"));
}

}  // namespace

CommandPage decode_page(std::span<const std::uint8_t> bytes) {
  const Packed packed = Packed::read(bytes);
  CommandPage page;
  page.name = text_at(packed, "command");
  page.doc = text_at(packed, "doc");
  page.category = text_at(packed, "category");
  page.example = text_at(packed, "example");
  page.note = text_at(packed, "note");
  if (const Packed* found = packed.find("produces")) page.products = products_from(*found);
  page.cost = text_at(packed, "cost", "cheap") == "solve" ? Cost::solve : Cost::cheap;
  page.role = role_from(text_at(packed, "role"));
  page.standalone = flag_at(packed, "standalone", false);
  page.destroys = flag_at(packed, "destroys", false);
  page.supported = flag_at(packed, "supported", true);
  read_reuse(packed, page);
  page.inside = level_from(packed);
  return page;
}

std::vector<ConceptTypePage> decode_types(std::span<const std::uint8_t> bytes) {
  std::vector<ConceptTypePage> types;
  const Packed packed = Packed::read(bytes);
  for (const auto& [name, about] : packed.map()) {
    ConceptTypePage type{std::string(name), text_at(about, "doc"), {}};
    if (const Packed* found = about.find("is_a")) type.is_a = texts(*found);
    types.push_back(std::move(type));
  }
  return types;
}

}  // namespace comma::interpreter
