#include "interpreter/tools/catalogue_yaml.hpp"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string_view>

namespace comma::interpreter::tools {
namespace {

using Names = std::initializer_list<std::string_view>;

[[noreturn]] void fail(const std::string& path, const YAML::Node& node, const std::string& message) {
  throw std::runtime_error(fmt::format("{}:{}: {}", path, node.Mark().line + 1, message));
}

template <class T>
std::optional<T> number_from(const std::string& text) {
  T value{};
  const char* begin = text.data() + (text.starts_with('+') ? 1 : 0);
  const char* end = text.data() + text.size();
  const auto [last, error] = std::from_chars(begin, end, value);
  return error == std::errc() && last == end && begin != end ? std::optional(value) : std::nullopt;
}

/// Only true and false are booleans and only digits are numbers: YAML's own rules would read the words NON, Y or 1_2
/// wrongly.
Json scalar_from(const YAML::Node& node) {
  const std::string& text = node.Scalar();
  const bool quoted = node.Tag() == "!";
  if (quoted) return text;
  if (text == "true") return true;
  if (text == "false") return false;
  if (const auto integer = number_from<std::int64_t>(text)) return *integer;
  if (const auto real = number_from<double>(text); real && text.find_first_of("0123456789") != std::string::npos)
    return *real;
  return text;
}

/// YAML -> JSON of the same shape; `<<` merges are spread, and a key met twice is an error.
class Converter {
 public:
  explicit Converter(std::string path) : path_(std::move(path)) {}

  Json convert(const YAML::Node& node) const {
    if (node.IsMap()) return convert_map(node);
    if (node.IsSequence()) {
      Json list = Json::array();
      for (const auto& item : node) list.push_back(convert(item));
      return list;
    }
    if (node.IsScalar()) return scalar_from(node);
    return nullptr;
  }

 private:
  Json convert_map(const YAML::Node& node) const {
    Json map = Json::object();
    for (const auto& entry : node) {
      const std::string key = entry.first.as<std::string>();
      if (key == "<<") {
        spread(convert(entry.second), map);
      } else if (map.contains(key) && !has_merge(node)) {
        fail(path_, entry.first, key + " is written twice");
      } else {
        map[key] = convert(entry.second);
      }
    }
    return map;
  }

  /// `<<: *one` or `<<: [*one, *two]`
  static void spread(const Json& merged, Json& map) {
    if (merged.is_array()) {
      for (const Json& part : merged) spread(part, map);
      return;
    }
    for (const auto& [name, value] : merged.items())
      if (!map.contains(name)) map[name] = value;
  }

  static bool has_merge(const YAML::Node& node) { return static_cast<bool>(node["<<"]); }

  std::string path_;
};

YAML::Node load(const std::string& yaml, const std::string& path) {
  try {
    return YAML::Load(yaml);
  } catch (const YAML::Exception& error) {
    throw std::runtime_error(fmt::format("{}:{}: {}", path, error.mark.line + 1, error.msg));
  }
}

/// Brings the JSON of a page into the one form that the interpreter reads, and refuses what the format does not have.
class PageBuilder {
 public:
  PageBuilder(std::string path, const SharedParts& shared) : path_(std::move(path)), shared_(shared) {}

  Json page(Json json) const {
    json.erase("shapes");  // a place for YAML anchors
    allow(json, "the page",
          {"command", "doc", "category", "example", "note", "produces", "cost", "role", "standalone", "destroys",
           "supported", "reuse", "keywords", "unsupported", "further", "rules", "blocks", "use"});
    demand(json, "the page", {"command", "doc", "category"});
    choose(json, "cost", {"cheap", "solve"});
    choose(json, "role", {"value", "verdict", "output", "naming", "setup"});
    choose(
        json, "category",
        {"mesh", "model", "material", "loads", "contact", "solve", "post-process", "verify", "functions", "session"});
    if (json.contains("reuse")) check_reuse(json["reuse"]);
    const std::string name = json.value("command", "");
    return level(std::move(json), name);
  }

 private:
  [[noreturn]] void refuse(const std::string& where, const std::string& message) const {
    throw std::runtime_error(fmt::format("{}: {}: {}", path_, where, message));
  }

  void allow(const Json& json, const std::string& where, Names keys) const {
    if (!json.is_object()) refuse(where, "a mapping is expected");
    for (const auto& [key, value] : json.items())
      if (std::ranges::find(keys, key) == keys.end()) refuse(where, fmt::format("the format has no key '{}'", key));
  }

  void demand(const Json& json, const std::string& where, Names keys) const {
    for (const std::string_view key : keys)
      if (!json.contains(key)) refuse(where, fmt::format("the key '{}' is missing", key));
  }

  void choose(const Json& json, const char* key, Names words) const {
    if (!json.contains(key)) return;
    if (std::ranges::find(words, json[key].get<std::string>()) == words.end())
      refuse(key, fmt::format("'{}' is none of {}", json[key].get<std::string>(), fmt::join(words, ", ")));
  }

  void check_reuse(const Json& reuse) const {
    allow(reuse, "reuse", {"policy", "same_as"});
    demand(reuse, "reuse", {"policy", "same_as"});
    choose(reuse, "policy", {"allowed", "compulsory", "beside"});
  }

  /// Fetches what `use:` names and spreads "DX, DY, DZ: {...}" into three keywords.
  Json level(Json json, const std::string& where) const {
    if (json.contains("use")) json = with_shared(std::move(json), where);
    if (json.contains("keywords")) json["keywords"] = keywords(json["keywords"], where);
    if (json.contains("unsupported")) add_unsupported(json, where);
    if (json.contains("further")) json["further"] = keyword(json["further"], where + "/(any other name)");
    if (json.contains("rules"))
      for (const Json& rule : json["rules"]) check_rule(rule, where);
    if (json.contains("blocks"))
      for (Json& block : json["blocks"]) {
        allow(block, where + " block", {"when", "keywords", "unsupported", "rules", "blocks", "use"});
        demand(block, where + " block", {"when"});
        const std::string inside = fmt::format("{} (when {})", where, block["when"].get<std::string>());
        block = level(std::move(block), inside);
      }
    return json;
  }

  Json with_shared(Json json, const std::string& where) const {
    const Json names = json["use"].is_array() ? json["use"] : Json::array({json["use"]});
    json.erase("use");
    for (const Json& name : names) {
      const auto found = shared_.find(name.get<std::string>());
      if (found == shared_.end()) refuse(where, fmt::format("there is no shared part '{}'", name.get<std::string>()));
      const std::string path = "shared/" + found->first + ".yaml";
      Json part = Converter(path).convert(load(found->second, path));
      part.erase("shapes");
      if (part.contains("use")) part = with_shared(std::move(part), path);
      json = merge(part, std::move(json));
    }
    return json;
  }

  /// The page's own keywords, rules and blocks first, then those of the shared part; the page's own keys win.
  static Json merge(const Json& part, Json own) {
    for (const auto& [key, value] : part.items()) {
      if (!own.contains(key))
        own[key] = value;
      else if (key == "keywords" || key == "unsupported")
        append_missing(own[key], value);
      else if (key == "rules" || key == "blocks")
        own[key].insert(own[key].end(), value.begin(), value.end());
    }
    return own;
  }

  static void append_missing(Json& own, const Json& part) {
    for (const auto& [name, keyword] : part.items())
      if (!own.contains(name)) own[name] = keyword;
  }

  /// `unsupported:` has the shape of `keywords:`; comma knows these keywords and does not act on them yet.
  void add_unsupported(Json& json, const std::string& where) const {
    const Json later = keywords(json["unsupported"], where);
    json.erase("unsupported");
    for (const auto& [name, about] : later.items()) {
      if (json["keywords"].contains(name)) refuse(where, name + " is written twice");
      json["keywords"][name] = about;
      json["keywords"][name]["supported"] = false;
    }
  }

  Json keywords(const Json& written, const std::string& where) const {
    if (!written.is_object()) refuse(where, "keywords: a mapping is expected");
    Json spread = Json::object();
    for (const auto& [names, about] : written.items()) {
      std::istringstream list(names);
      for (std::string name; std::getline(list, name, ',');) {
        name.erase(0, name.find_first_not_of(' '));
        name.erase(name.find_last_not_of(' ') + 1);
        if (spread.contains(name)) refuse(where, name + " is written twice");
        spread[name] = keyword(about, where + "/" + name);
      }
    }
    return spread;
  }

  Json keyword(Json json, const std::string& where) const {
    if (!json.is_object()) refuse(where, "a mapping with type and doc is expected");
    json = level(std::move(json), where);
    if (json.contains("unsupported_words")) add_unsupported_words(json);
    allow(json, where, {"type",        "doc",      "unit",     "aliases", "min",      "max",       "words",
                        "above",       "at_least", "below",    "at_most", "required", "supported", "no_effect",
                        "counts_when", "default",  "keywords", "rules",   "blocks",   "further",   "missed"});
    if (json.contains("missed") && !json.contains("no_effect"))
      refuse(where, "missed is said of a keyword that has no_effect");
    demand(json, where, {"type", "doc"});
    if (json["type"] == "factor" && !json.contains("keywords") && !json.contains("blocks"))
      refuse(where, "a factor lists its keywords ('keywords: {}' when it has none)");
    if (json.contains("max") && json["max"].is_string() && json["max"] != "many")
      refuse(where, "max is a number or 'many'");
    if (json.contains("words")) check_words(json["words"], where);
    return json;
  }

  /// `unsupported_words: [A, B]` in short for `words: {A: {supported: false}, B: {supported: false}}`.
  static void add_unsupported_words(Json& json) {
    Json words = Json::object();
    if (json.contains("words") && json["words"].is_array()) {
      for (const Json& word : json["words"]) words[word.is_string() ? word.get<std::string>() : word.dump()] = "";
    } else if (json.contains("words")) {
      words = json["words"];
    }
    for (const Json& word : json["unsupported_words"]) words[word.get<std::string>()] = {{"supported", false}};
    json["words"] = words;
    json.erase("unsupported_words");
  }

  void check_words(const Json& words, const std::string& where) const {
    if (words.is_array()) return;
    if (!words.is_object()) refuse(where, "words: a list, or a mapping from words to their documentation, is expected");
    for (const auto& [word, about] : words.items())
      if (about.is_object()) allow(about, where + "=" + word, {"doc", "supported", "no_effect"});
  }

  void check_rule(const Json& rule, const std::string& where) const {
    if (!rule.is_object() || rule.size() != 1 || !rule.begin()->is_array())
      refuse(where, "a rule is one key with the list of its keywords");
    if (!rule_named(rule.begin().key())) refuse(where, fmt::format("no rule is called '{}'", rule.begin().key()));
  }

  std::string path_;
  const SharedParts& shared_;
};

std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error(path.string() + ": cannot be read");
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<std::filesystem::path> yaml_files(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  if (!std::filesystem::exists(folder)) return files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".yaml") files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

}  // namespace

Json page_from_yaml(const std::string& yaml, const std::string& path, const SharedParts& shared) {
  return PageBuilder(path, shared).page(Converter(path).convert(load(yaml, path)));
}

Json types_from_yaml(const std::string& yaml, const std::string& path) {
  const Json types = Converter(path).convert(load(yaml, path));
  for (const auto& [name, about] : types.items())
    if (!about.is_object() || !about.contains("doc"))
      throw std::runtime_error(fmt::format("{}: {}: a mapping with doc is expected", path, name));
  return types;
}

void CompiledCatalogue::add_types(const std::string& yaml, const std::string& path) {
  bytes_[""] = Json::to_msgpack(types_from_yaml(yaml, path));
}

void CompiledCatalogue::add_page(const std::string& yaml, const std::string& path, const SharedParts& shared) {
  const Json page = page_from_yaml(yaml, path, shared);
  const std::string name = page["command"].get<std::string>();
  if (!bytes_.emplace(name, Json::to_msgpack(page)).second)
    throw std::runtime_error(fmt::format("{}: another page describes {} too", path, name));
}

CompiledCatalogue CompiledCatalogue::from_folder(const std::string& folder) {
  SharedParts shared;
  for (const auto& path : yaml_files(std::filesystem::path(folder) / "shared"))
    shared[path.stem().string()] = text_of(path);
  CompiledCatalogue catalogue;
  for (const auto& path : yaml_files(folder)) {
    if (path.stem() == "concept_types")
      catalogue.add_types(text_of(path), path.string());
    else
      catalogue.add_page(text_of(path), path.string(), shared);
  }
  return catalogue;
}

std::vector<CatalogueBlob> CompiledCatalogue::blobs() const {
  std::vector<CatalogueBlob> blobs;
  for (const auto& [name, bytes] : bytes_) blobs.push_back({name, bytes});
  return blobs;
}

}  // namespace comma::interpreter::tools
