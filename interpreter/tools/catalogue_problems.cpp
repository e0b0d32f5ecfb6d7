#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "interpreter/catalogue/check_rules.hpp"
#include "interpreter/catalogue/check_value.hpp"
#include "interpreter/tools/catalogue_yaml.hpp"

namespace comma::interpreter::tools {
namespace {

using NameSet = std::set<std::string, std::less<>>;

/// The names of a level and of all its blocks.
void collect_names(const LevelPage& level, NameSet& names) {
  for (const KeywordPage& keyword : level.keywords) names.insert(keyword.name);
  for (const BlockPage& block : level.blocks) collect_names(block.inside, names);
}

/// Walks a page and notes what contradicts itself.
class Inspector {
 public:
  Inspector(const CommandPage& page, const Catalogue& catalogue) : page_(page), catalogue_(catalogue) {}

  std::vector<std::string> run() {
    if (page_.doc.empty()) note(page_.name, "has no documentation");
    for (const ProductPage& product : page_.products) known_type(page_.name, product.type);
    for (const std::string& path : page_.reuse_same_as) reuse_path(path);
    NameSet names;
    factor_level(page_.inside, page_.name, names);
    for (const ProductPage& product : page_.products)
      if (product.condition) condition(*product.condition, page_.name, names);
    return std::move(problems_);
  }

 private:
  void note(const std::string& where, const std::string& what) { problems_.push_back(where + ": " + what); }

  void known_type(const std::string& where, const std::string& type) {
    if (type != "any" && catalogue_.describe_type(type) == type)
      note(where, fmt::format("'{}' is neither a kind of value nor listed in concept_types.yaml", type));
  }

  void reuse_path(const std::string& path) {
    NameSet names;
    collect_names(page_.inside, names);
    if (!names.contains(path.substr(0, path.find('/')))) note(page_.name, "reuse names the unknown keyword " + path);
  }

  /// A command or a factor: the level where names, rules and conditions see each other. `visible` holds the names
  /// around it.
  void factor_level(const LevelPage& level, const std::string& where, NameSet& visible) {
    NameSet here;
    collect_names(level, here);
    visible.insert(here.begin(), here.end());
    block_level(level, where, here, visible);
  }

  void block_level(const LevelPage& level, const std::string& where, const NameSet& here, const NameSet& visible) {
    for (const KeywordPage& keyword : level.keywords) inspect(keyword, where + "/" + keyword.name, here, visible);
    if (level.further) inspect(*level.further, where + "/(any other name)", here, visible);
    for (const RulePage& rule : level.rules)
      for (const std::string& name : rule.keywords)
        if (!here.contains(name))
          note(where, fmt::format("the rule '{}' names the unknown keyword {}", describe_rule(rule), name));
    for (const BlockPage& block : level.blocks) {
      condition(*block.condition, where, visible);
      block_level(block.inside, where, here, visible);
    }
  }

  void condition(const Expression& expression, const std::string& where, const NameSet& visible) {
    for (const std::string& name : expression.variables())
      if (!visible.contains(name))
        note(where, fmt::format("the condition '{}' names the unknown keyword {}", expression.text(), name));
  }

  void inspect(const KeywordPage& keyword, const std::string& where, const NameSet& here, const NameSet& visible) {
    if (keyword.doc.empty()) note(where, "has no documentation");
    if (keyword.types.empty()) note(where, "has no type");
    for (const TypePage& type : keyword.types)
      if (type.kind == Kind::concept_kind) known_type(where, type.concept_type);
    for (const std::string& alias : keyword.aliases)
      if (here.contains(alias)) note(where, "the alias " + alias + " is a keyword too");
    const bool standard = keyword.default_value || keyword.present_by_default;
    if (keyword.required && standard) note(where, "is required and has a default");
    if (keyword.max_count != unlimited && keyword.max_count < keyword.min_count) note(where, "max is less than min");
    inspect_default(keyword, where);
    if (!keyword.is_factor()) return;
    NameSet around = visible;
    factor_level(keyword.inside, where, around);
  }

  void inspect_default(const KeywordPage& keyword, const std::string& where) {
    if (!keyword.default_value) return;
    Diagnostics found;
    CheckContext context{catalogue_, found};
    check_value(*keyword.default_value, keyword, where, Span(), context);
    for (const Diagnostic& diagnostic : found.items())
      if (diagnostic.severity == Severity::error && (diagnostic.code != "unsupported" || keyword.supported))
        note(where, "its default: " + diagnostic.message);
  }

  const CommandPage& page_;
  const Catalogue& catalogue_;
  std::vector<std::string> problems_;
};

}  // namespace

std::vector<std::string> problems_of(const CommandPage& page, const Catalogue& catalogue) {
  return Inspector(page, catalogue).run();
}

}  // namespace comma::interpreter::tools
