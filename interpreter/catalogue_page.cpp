#include "interpreter/catalogue_page.hpp"

#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

namespace comma::interpreter {
namespace {

using Json = nlohmann::ordered_json;

std::string text_at(const Json& json, const char* key, std::string otherwise = {}) {
  const auto found = json.find(key);
  return found == json.end() ? std::move(otherwise) : found->get<std::string>();
}

bool flag_at(const Json& json, const char* key, bool otherwise) {
  const auto found = json.find(key);
  return found == json.end() ? otherwise : found->get<bool>();
}

std::vector<std::string> texts(const Json& json) {
  if (json.is_string()) return {json.get<std::string>()};
  return json.get<std::vector<std::string>>();
}

Value value_from(const Json& json) {
  if (json.is_boolean()) return Value(json.get<bool>());
  if (json.is_number_integer()) return Value(json.get<std::int64_t>());
  if (json.is_number()) return Value(json.get<double>());
  if (json.is_string()) return Value(json.get<std::string>());
  if (!json.is_array()) throw std::runtime_error("catalogue: a default or a word is a number, a text or a list of them");
  std::vector<Value> items;
  for (const Json& item : json) items.push_back(value_from(item));
  return Value::tuple(std::move(items));
}

std::shared_ptr<const Expression> condition_from(const std::string& when) {
  return std::make_shared<const Expression>(when, "<condition of a block>");
}

std::vector<TypePage> types_from(const Json& json) {
  std::vector<TypePage> types;
  for (const std::string& word : texts(json)) {
    const auto kind = kind_named(word);
    types.push_back(kind ? TypePage{*kind, ""} : TypePage{Kind::concept_kind, word});
  }
  return types;
}

WordPage word_from(Value value, const Json& about) {
  WordPage word;
  word.value = std::move(value);
  if (about.is_string()) word.doc = about.get<std::string>();
  if (!about.is_object()) return word;
  word.doc = text_at(about, "doc");
  word.supported = flag_at(about, "supported", true);
  word.no_effect = text_at(about, "no_effect");
  return word;
}

/// A list of bare words, or a mapping from each word to its line of documentation or its properties.
std::vector<WordPage> words_from(const Json& json, bool integers) {
  std::vector<WordPage> words;
  if (json.is_array()) {
    for (const Json& word : json) words.push_back(word_from(value_from(word), Json()));
    return words;
  }
  for (const auto& [word, about] : json.items()) {
    Value value = integers ? Value(static_cast<std::int64_t>(std::stoll(word))) : Value(word);
    words.push_back(word_from(std::move(value), about));
  }
  return words;
}

Bounds bounds_from(const Json& json) {
  const auto number = [&](const char* key) -> std::optional<double> {
    const auto found = json.find(key);
    if (found == json.end()) return std::nullopt;
    return found->get<double>();
  };
  return {number("above"), number("at_least"), number("below"), number("at_most")};
}

int count_from(const Json& json) { return json.is_string() ? unlimited : json.get<int>(); }

LevelPage level_from(const Json& json);

KeywordPage keyword_from(const std::string& name, const Json& json) {
  KeywordPage keyword;
  keyword.name = name;
  if (const auto found = json.find("aliases"); found != json.end()) keyword.aliases = texts(*found);
  keyword.doc = text_at(json, "doc");
  keyword.unit = text_at(json, "unit");
  keyword.types = types_from(json.at("type"));
  if (const auto found = json.find("max"); found != json.end()) keyword.max_count = count_from(*found);
  if (const auto found = json.find("min"); found != json.end()) keyword.min_count = count_from(*found);
  if (const auto found = json.find("words"); found != json.end()) keyword.words = words_from(*found, keyword.types.front().kind == Kind::integer);
  keyword.bounds = bounds_from(json);
  keyword.required = flag_at(json, "required", false);
  keyword.supported = flag_at(json, "supported", true);
  keyword.no_effect = text_at(json, "no_effect");
  const auto standard = json.find("default");
  if (keyword.is_factor()) {
    keyword.present_by_default = standard != json.end();
    keyword.inside = level_from(json);
  } else if (standard != json.end()) {
    keyword.default_value = value_from(*standard);
  }
  return keyword;
}

RulePage rule_from(const Json& json) {
  const auto rule = json.begin();
  const auto kind = rule_named(rule.key());
  if (!kind) throw std::runtime_error("catalogue: no rule is called " + rule.key());
  return {*kind, texts(rule.value())};
}

BlockPage block_from(const Json& json) {
  BlockPage block;
  block.when = json.at("when").get<std::string>();
  block.condition = condition_from(block.when);
  block.inside = level_from(json);
  return block;
}

LevelPage level_from(const Json& json) {
  LevelPage level;
  if (const auto found = json.find("keywords"); found != json.end())
    for (const auto& [name, keyword] : found->items()) level.keywords.push_back(keyword_from(name, keyword));
  if (const auto found = json.find("rules"); found != json.end())
    for (const Json& rule : *found) level.rules.push_back(rule_from(rule));
  if (const auto found = json.find("blocks"); found != json.end())
    for (const Json& block : *found) level.blocks.push_back(block_from(block));
  return level;
}

std::vector<ProductPage> products_from(const Json& json) {
  if (json.is_null()) return {};
  if (json.is_string()) return {ProductPage{"", nullptr, json.get<std::string>()}};
  std::vector<ProductPage> products;
  for (const Json& item : json) {
    const std::string when = text_at(item, "when");
    products.push_back({when, when.empty() ? nullptr : condition_from(when), item.at("type").get<std::string>()});
  }
  return products;
}

Role role_from(const std::string& word) {
  if (word == "verdict") return Role::verdict;
  if (word == "output") return Role::output;
  if (word == "setup") return Role::setup;
  return Role::value;
}

void read_reuse(const Json& json, CommandPage& page) {
  const auto found = json.find("reuse");
  if (found == json.end()) return;
  page.reuse = text_at(*found, "policy") == "compulsory" ? Reuse::compulsory : Reuse::allowed;
  page.reuse_same_as = texts(found->at("same_as"));
}

Json json_from(std::span<const std::uint8_t> bytes) { return Json::from_msgpack(bytes.begin(), bytes.end()); }

}  // namespace

CommandPage page_from_json(const Json& json) {
  CommandPage page;
  page.name = json.at("command").get<std::string>();
  page.doc = text_at(json, "doc");
  page.category = text_at(json, "category");
  page.example = text_at(json, "example");
  page.note = text_at(json, "note");
  if (const auto found = json.find("produces"); found != json.end()) page.products = products_from(*found);
  page.cost = text_at(json, "cost", "cheap") == "solve" ? Cost::solve : Cost::cheap;
  page.role = role_from(text_at(json, "role"));
  page.standalone = flag_at(json, "standalone", false);
  page.supported = flag_at(json, "supported", true);
  read_reuse(json, page);
  page.inside = level_from(json);
  return page;
}

CommandPage decode_page(std::span<const std::uint8_t> bytes) { return page_from_json(json_from(bytes)); }

std::vector<ConceptTypePage> decode_types(std::span<const std::uint8_t> bytes) {
  std::vector<ConceptTypePage> types;
  const Json json = json_from(bytes);
  for (const auto& [name, about] : json.items()) {
    ConceptTypePage type{name, text_at(about, "doc"), {}};
    if (const auto found = about.find("is_a"); found != about.end()) type.is_a = texts(*found);
    types.push_back(std::move(type));
  }
  return types;
}

}  // namespace comma::interpreter
