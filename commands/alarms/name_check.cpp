#include "commands/alarms/name_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <set>
#include <string>
#include <vector>

#include "commands/alarms/known_names.hpp"
#include "commands/concepts.hpp"
#include "commands/fields/field_reading.hpp"
#include "interpreter/item_span.hpp"
#include "solver/mesh/groups.hpp"

namespace comma::commands {

using namespace interpreter;

namespace {

/// The levels that may stand at one place of a call: a factor's keywords can depend on conditions.
using Levels = std::vector<const LevelPage*>;

/// The concepts around a keyword: those of its factor, then those of the call. Null stands for one that is not known.
using Reach = std::vector<const Concept*>;

void collect_pages(const LevelPage& level, std::string_view name, std::vector<const KeywordPage*>& found) {
  for (const KeywordPage& keyword : level.keywords) {
    if (keyword.name == name) found.push_back(&keyword);
  }
  for (const BlockPage& block : level.blocks) collect_pages(block.inside, name, found);
}

std::vector<const KeywordPage*> pages_of(const Levels& levels, std::string_view name) {
  std::vector<const KeywordPage*> found;
  for (const LevelPage* level : levels) collect_pages(*level, name, found);
  return found;
}

bool takes_concepts(const std::vector<const KeywordPage*>& pages) {
  const auto is_concept = [](const TypePage& type) { return type.kind == Kind::concept_kind; };
  return std::ranges::any_of(pages,
                             [&](const KeywordPage* page) { return std::ranges::any_of(page->types, is_concept); });
}

void collect_concepts(const Value& value, const std::vector<const KeywordPage*>& pages, Reach& reach) {
  if (value.is_concept()) reach.push_back(value.as_concept().get());
  if (value.is_unknown() && takes_concepts(pages)) reach.push_back(nullptr);
  if (!value.is_sequence()) return;
  for (const Value& item : value.items()) collect_concepts(item, pages, reach);
}

/// Everything that reading these concepts reads.
std::set<const Concept*> closure_of(const Reach& reach) {
  std::set<const Concept*> closure;
  std::vector<const Concept*> open(reach.begin(), reach.end());
  while (!open.empty()) {
    const Concept* handle = open.back();
    open.pop_back();
    if (!closure.insert(handle).second) continue;
    for (const ConceptPtr& behind : handle->reads_through) open.push_back(behind.get());
  }
  return closure;
}

std::string hint_for(const std::string& name, const std::vector<std::string>& known, std::string_view what) {
  constexpr std::size_t most_listed = 12;
  const std::string near = nearest(name, known);
  if (!near.empty()) return fmt::format("did you mean {}?", near);
  if (known.empty()) return fmt::format("there is no {} at all", what);
  if (known.size() > most_listed) return "";
  return fmt::format("there is {}", fmt::join(known, ", "));
}

struct PlacedText {
  std::string text;
  std::size_t index = 0, count = 1;  ///< which of how many values
};

std::vector<PlacedText> placed_texts_of(const Value& value) {
  if (value.is_text()) return {{value.as_text(), 0, 1}};
  std::vector<PlacedText> texts;
  if (!value.is_sequence()) return texts;
  const auto items = value.items();
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (items[i].is_text()) texts.push_back({items[i].as_text(), i, items.size()});
  }
  return texts;
}

/// The texts of a value, one or several.
std::vector<std::string> texts_of(const Value& value) {
  std::vector<std::string> texts;
  for (PlacedText& placed : placed_texts_of(value)) texts.push_back(std::move(placed.text));
  return texts;
}

class NameCheck {
 public:
  NameCheck(const CommandNode& node, const CommandGraph& graph, const Catalogue& catalogue, Diagnostics& diagnostics)
      : node_(node), graph_(graph), catalogue_(catalogue), diagnostics_(diagnostics) {}

  bool run() {
    if (const std::string& name = node_.call.command; name == "DEFI_GROUP" || name == "CREA_MAILLAGE")
      collect_own_names(node_.call);
    // Loads and contact speak of displacements.
    const std::string& command = node_.call.command;
    const bool of_displacements = command == "DEFI_CONTACT" || command.starts_with("AFFE_CHAR_MECA");
    const std::vector<std::string> fields(of_displacements ? 1 : 0, "DEPL");
    check_level(node_.call, {&catalogue_.page(command).inside}, {}, command, fields);
    return right_;
  }

 private:
  /// One keyword with what its names are looked up in.
  struct Site {
    const Keyword& keyword;
    std::string label;
    const Reach& reach;
    const std::vector<std::string>& fields;  ///< NOM_CHAM beside it
  };

  /// A call may use the groups that it makes (DEFI_GROUP, CREA_MAILLAGE): what it gives names to is known to it.
  void collect_own_names(const Keywords& keywords) {
    for (const Keyword& keyword : keywords.items) {
      if (keyword.name.starts_with("NOM")) {
        for (std::string& name : texts_of(keyword.value)) own_names_.insert(std::move(name));
      }
      for (const Keywords& factor : keyword.factors) {
        collect_own_names(factor);
        if (keyword.name == "CREA_GROUP_NO") collect_node_groups(factor);
      }
    }
  }

  /// DEFI_GROUP calls the nodes of a cell group by the cell group's name unless NOM gives another.
  void collect_node_groups(const Keywords& creation) {
    if (creation.given("TOUT_GROUP_MA")) every_cell_group_ = true;
    if (!creation.given("GROUP_MA") || creation.given("NOM")) return;
    for (std::string& name : texts_of(creation.at("GROUP_MA").value)) own_node_groups_.insert(std::move(name));
  }

  void check_level(const Keywords& keywords, const Levels& levels, const Reach& outer, const std::string& label,
                   const std::vector<std::string>& outer_fields) {
    Reach reach = outer;
    for (const Keyword& keyword : keywords.items)
      collect_concepts(keyword.value, pages_of(levels, keyword.name), reach);
    const std::vector<std::string> fields =
        keywords.given("NOM_CHAM") ? texts_of(keywords.at("NOM_CHAM").value) : outer_fields;
    for (const Keyword& keyword : keywords.items) {
      if (!keyword.given) continue;
      const auto pages = pages_of(levels, keyword.name);
      const std::string name = label + "/" + keyword.name;
      if (keyword.factors.empty()) {
        check_value({keyword, name, reach, fields}, pages);
        continue;
      }
      Levels inner;
      for (const KeywordPage* page : pages) {
        if (page->is_factor()) inner.push_back(&page->inside);
      }
      for (const Keywords& factor : keyword.factors) check_level(factor, inner, reach, name, fields);
    }
  }

  void check_value(const Site& site, const std::vector<const KeywordPage*>& pages) {
    std::set<Kind> kinds;
    for (const KeywordPage* page : pages) {
      if (!page->words.empty()) return;  // the syntax has judged it
      for (const TypePage& type : page->types) kinds.insert(type.kind);
    }
    if (kinds.size() != 1) return;
    switch (*kinds.begin()) {
      case Kind::node_group:
        return check_groups(site, "node", &solver::Mesh::node_groups, "cell", &solver::Mesh::cell_groups);
      case Kind::cell_group:
        return check_groups(site, "cell", &solver::Mesh::cell_groups, "node", &solver::Mesh::node_groups);
      case Kind::node:
        return check_members(site, "node", &solver::Mesh::find_node);
      case Kind::cell:
        return check_members(site, "cell", &solver::Mesh::find_cell);
      case Kind::component:
        return check_components(site);
      case Kind::field:
        return check_fields(site);
      case Kind::parameter:
        return check_parameters(site);
      default:
        return;
    }
  }

  using Groups = solver::Groups;

  void check_groups(const Site& site, std::string_view kind, Groups solver::Mesh::*groups, std::string_view other_kind,
                    Groups solver::Mesh::*others) {
    const auto meshes = meshes_of(site.reach);
    if (meshes.empty()) return;
    const auto has = [&](Groups solver::Mesh::*kind_of_groups, const std::string& name) {
      return std::ranges::any_of(meshes,
                                 [&](const solver::Mesh* mesh) { return (mesh->*kind_of_groups).contains(name); });
    };
    const auto is_own = [&](const std::string& name) {
      if (own_names_.contains(name)) return true;
      if (kind != "node") return false;
      return own_node_groups_.contains(name) || (every_cell_group_ && has(others, name));
    };
    const auto exists = [&](const std::string& name) { return is_own(name) || has(groups, name); };
    const auto hint = [&](const std::string& name) {
      if (has(others, name)) return fmt::format("{} is a {} group of this mesh", name, other_kind);
      std::vector<std::string> offered(own_names_.begin(), own_names_.end());
      for (const solver::Mesh* mesh : meshes)
        std::ranges::move(solver::names_of(mesh->*groups), std::back_inserter(offered));
      return hint_for(name, offered, fmt::format("{} group", kind));
    };
    check_each(site, "unknown-group", fmt::format("the mesh has no {} group", kind), exists, hint);
  }

  void check_members(const Site& site, std::string_view kind, int (solver::Mesh::*find)(std::string_view) const) {
    const auto meshes = meshes_of(site.reach);
    if (meshes.empty()) return;
    const auto exists = [&](const std::string& name) {
      return std::ranges::any_of(meshes, [&](const solver::Mesh* mesh) { return (mesh->*find)(name) >= 0; });
    };
    check_each(site, fmt::format("unknown-{}", kind), fmt::format("the mesh has no {}", kind), exists,
               [](const std::string&) { return std::string(); });
  }

  void check_components(const Site& site) {
    // The moment of a resultant exists where nodes have forces alone.
    if (site.fields.empty() || site.keyword.name == "MOMENT") return;
    const auto models = models_of(site.reach);
    std::vector<std::string> known;
    for (const solver::Model* model : models) {
      for (const std::string& field : site.fields) {
        auto components = components_of_field(field, *model);
        if (!components) return;
        std::ranges::move(*components, std::back_inserter(known));
      }
    }
    if (known.empty()) return;
    std::ranges::sort(known);
    known.erase(std::unique(known.begin(), known.end()), known.end());
    // Relations also speak of displacements along the normal.
    if (site.label.find("/LIAISON_") != std::string::npos) known.emplace_back("DNOR");
    // What plane bodies lack is left out of tables, and is 0 in sums.
    const bool is_optional = site.keyword.name == "RESULTANTE" || site.label.starts_with("CREA_TABLE/RESU");
    const auto exists = [&](const std::string& name) {
      return has_component(known, name) || (is_optional && is_out_of_plane(name));
    };
    const auto hint = [&](const std::string& name) { return hint_for(name, known, "component"); };
    check_each(site, "unknown-component", fmt::format("{} has no component", fmt::join(site.fields, ", ")), exists,
               hint);
  }

  /// Where it is not certain that fields of a mechanical result are meant, only a word that is nearly one is a mistake.
  void check_fields(const Site& site) {
    const bool certain = reads_a(site.reach, {"evol_noli", "evol_elas"});
    const auto exists = [&](const std::string& name) {
      return is_field_name(name) || (!certain && nearest(name, field_names()).empty());
    };
    const auto hint = [](const std::string& name) { return hint_for(name, field_names(), "field"); };
    check_each(site, "unknown-field", "there is no field", exists, hint);
  }

  void check_parameters(const Site& site) {
    const bool of_result = site.keyword.name == "PARA" || site.keyword.name == "NOM_PARA_RESU";
    if (!of_result || !reads_a(site.reach, {"evol_noli"})) return;
    const auto& known = result_parameters();
    // Results have more parameters than those of the list: only a word that is nearly one of them is a mistake.
    const auto exists = [&](const std::string& name) {
      return std::ranges::find(known, name) != known.end() || nearest(name, known).empty();
    };
    const auto hint = [&](const std::string& name) { return hint_for(name, known, "parameter"); };
    check_each(site, "unknown-parameter", "a result has no parameter", exists, hint);
  }

  /// Reports each name of the value that does not exist, once, where it stands.
  void check_each(const Site& site, std::string_view code, const std::string& finding,
                  const std::function<bool(const std::string&)>& exists,
                  const std::function<std::string(const std::string&)>& hint) {
    std::set<std::string> missing;
    for (const PlacedText& name : placed_texts_of(site.keyword.value)) {
      if (exists(name.text) || !missing.insert(name.text).second) continue;
      right_ = false;
      // A single value that stands in brackets is one without them here.
      const Span place = item_span(site.keyword.value_span, name.index, name.count);
      std::string message = fmt::format("{}: {} {}", site.label, finding, name.text);
      if (is_reported(message, place)) continue;
      diagnostics_.error(std::string(code), std::move(message), place, hint(name.text));
    }
  }

  /// A value in a loop is one mistake however often it is met, and names that a loop puts together are a few at most.
  bool is_reported(const std::string& message, const Span& span) const {
    constexpr int most_at_a_place = 3;
    int here = 0;
    for (const Diagnostic& item : diagnostics_.items()) {
      const bool is_here = item.severity == Severity::error && item.span && span && item.span.file == span.file &&
                           item.span.begin == span.begin && item.span.end == span.end;
      if (is_here && (item.message == message || ++here == most_at_a_place)) return true;
    }
    return false;
  }

  bool reads_a(const Reach& reach, std::initializer_list<std::string_view> types) const {
    return std::ranges::any_of(
        reach, [&](const Concept* handle) { return handle && std::ranges::find(types, handle->type) != types.end(); });
  }

  /// Everything that reading these concepts reads; nothing where one of them is not known, or what made one names
  /// another that is not.
  std::set<const Concept*> known_closure_of(const Reach& reach) const {
    if (std::ranges::find(reach, nullptr) != reach.end()) return {};
    auto closure = closure_of(reach);
    const auto is_made = [&](const Concept* handle) { return graph_.is_made(*handle); };
    return std::ranges::all_of(closure, is_made) ? std::move(closure) : std::set<const Concept*>();
  }

  /// The meshes behind the concepts; none when one of them is not known for certain at this point of the file.
  std::vector<const solver::Mesh*> meshes_of(const Reach& reach) const {
    std::vector<const solver::Mesh*> meshes;
    for (const Concept* handle : known_closure_of(reach)) {
      if (handle->type != "maillage_sdaster") continue;
      const auto* data = dynamic_cast<const MeshConcept*>(handle->data.get());
      if (data == nullptr || !data->mesh || !is_up_to_date(*handle)) return {};
      meshes.push_back(data->mesh.get());
    }
    return meshes;
  }

  std::vector<const solver::Model*> models_of(const Reach& reach) const {
    std::vector<const solver::Model*> models;
    for (const Concept* handle : known_closure_of(reach)) {
      if (handle->type != "modele_sdaster") continue;
      const auto* data = dynamic_cast<const ModelConcept*>(handle->data.get());
      if (data == nullptr || !data->model || !is_up_to_date(*handle)) return {};
      models.push_back(data->model.get());
    }
    return models;
  }

  /// Whether every call before this one that changes the concept has been run, and none of them is wrong.
  bool is_up_to_date(const Concept& handle) const {
    if (graph_.is_spoiled(handle)) return false;
    for (const CommandNode& other : graph_.nodes()) {
      if (other.id >= node_.id) break;
      const bool changes_names = other.product.get() == &handle && other.call.command != "MODI_MAILLAGE";
      if (changes_names && other.state != NodeState::done) return false;
    }
    return true;
  }

  const CommandNode& node_;
  const CommandGraph& graph_;
  const Catalogue& catalogue_;
  Diagnostics& diagnostics_;
  std::set<std::string, std::less<>> own_names_;
  std::set<std::string, std::less<>> own_node_groups_;
  bool every_cell_group_ = false;  ///< becomes a node group in this call
  bool right_ = true;
};

}  // namespace

bool check_names(const CommandNode& node, const CommandGraph& graph, const Catalogue& catalogue,
                 Diagnostics& diagnostics) {
  return NameCheck(node, graph, catalogue, diagnostics).run();
}

}  // namespace comma::commands
