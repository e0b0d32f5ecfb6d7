#include "commands/selection.hpp"

#include <numeric>

#include <fmt/format.h>

#include "commands/ordered_set.hpp"
#include "solver/error.hpp"
#include "solver/mesh/name_finder.hpp"

namespace comma::commands {

using interpreter::DiagnosticError;
using interpreter::Keywords;

namespace {

bool takes(const Keywords& keywords, const std::string& name) { return !name.empty() && keywords.given(name); }

// Calls visit(group) for each group that the keyword names; a name that does not exist is told at the keyword's value.
template <class Find, class Visit>
void each_group(const Keywords& keywords, const std::string& keyword, Find find, Visit visit) {
  for (const std::string& name : keywords.texts(keyword)) {
    try {
      visit(find(name));
    } catch (const solver::Error& error) {
      throw DiagnosticError(error.code(), keyword + ": " + error.what(), keywords.span_of(keyword), error.hint());
    }
  }
}

template <class Find, class Visit>
void each_name(const Keywords& keywords, const std::string& keyword, const char* code, const char* what, Find find,
               Visit visit) {
  for (const std::string& name : keywords.texts(keyword)) {
    const int index = find(name);
    if (index < 0) {
      throw DiagnosticError(code, keyword + ": the mesh has no " + what + " " + name, keywords.span_of(keyword));
    }
    visit(index);
  }
}

}  // namespace

std::vector<int> selected_cells(const Keywords& keywords, const solver::Mesh& mesh, const PlaceKeywords& names) {
  OrderedSet cells(mesh.cell_count());
  if (takes(keywords, names.all)) {
    std::vector<int> all(static_cast<std::size_t>(mesh.cell_count()));
    std::iota(all.begin(), all.end(), 0);
    return all;
  }
  if (takes(keywords, names.cell_groups)) {
    each_group(
        keywords, names.cell_groups, [&](const std::string& name) { return mesh.cell_group(name); },
        [&](const std::vector<int>& group) { cells.add_all(group); });
  }
  if (takes(keywords, names.cells)) {
    each_name(
        keywords, names.cells, "unknown-cell", "cell",
        [found = solver::NameFinder(mesh, solver::NameFinder::Kind::cells)](const std::string& name) mutable {
          return found.find(name);
        },
        [&](int index) { cells.add(index); });
  }
  return cells.take();
}

std::vector<int> selected_nodes(const Keywords& keywords, const solver::Mesh& mesh, const PlaceKeywords& names) {
  OrderedSet nodes(mesh.node_count());
  if (takes(keywords, names.all)) {
    for (int node = 0; node < mesh.node_count(); ++node) nodes.add(node);
    return nodes.take();
  }
  if (takes(keywords, names.node_groups)) {
    each_group(
        keywords, names.node_groups, [&](const std::string& name) { return mesh.node_group(name); },
        [&](const std::vector<int>& group) { nodes.add_all(group); });
  }
  if (takes(keywords, names.nodes)) {
    each_name(
        keywords, names.nodes, "unknown-node", "node",
        [found = solver::NameFinder(mesh, solver::NameFinder::Kind::nodes)](const std::string& name) mutable {
          return found.find(name);
        },
        [&](int index) { nodes.add(index); });
  }
  for (const int cell : selected_cells(keywords, mesh, names)) nodes.add_all(mesh.cell(cell));
  return nodes.take();
}

std::set<int> excluded_nodes(const Keywords& keywords, const solver::Mesh& mesh, const std::string& ending) {
  const auto nodes = selected_nodes(
      keywords, mesh,
      {"", "SANS_GROUP_NO" + ending, "SANS_NOEUD" + ending, "SANS_GROUP_MA" + ending, "SANS_MAILLE" + ending});
  return {nodes.begin(), nodes.end()};
}

std::vector<int> remaining_nodes(const Keywords& keywords, const solver::Mesh& mesh, const PlaceKeywords& names,
                                 const std::string& ending) {
  auto nodes = selected_nodes(keywords, mesh, names);
  const auto left_out = excluded_nodes(keywords, mesh, ending);
  std::erase_if(nodes, [&](int node) { return left_out.contains(node); });
  return nodes;
}

std::vector<int> listed_nodes(const Keywords& keywords, const solver::Mesh& mesh, const std::string& node_groups,
                              const std::string& nodes) {
  std::vector<int> listed;
  if (takes(keywords, node_groups)) {
    each_group(
        keywords, node_groups, [&](const std::string& name) { return mesh.node_group(name); },
        [&](const std::vector<int>& group) { listed.insert(listed.end(), group.begin(), group.end()); });
  }
  if (takes(keywords, nodes)) {
    each_name(
        keywords, nodes, "unknown-node", "node",
        [found = solver::NameFinder(mesh, solver::NameFinder::Kind::nodes)](const std::string& name) mutable {
          return found.find(name);
        },
        [&](int index) { listed.push_back(index); });
  }
  return listed;
}

std::vector<std::vector<int>> named_node_groups(const Keywords& keywords, const std::string& keyword,
                                                const solver::Mesh& mesh) {
  std::vector<std::vector<int>> groups;
  each_group(
      keywords, keyword, [&](const std::string& name) { return mesh.node_group(name); },
      [&](const std::vector<int>& group) { groups.push_back(group); });
  return groups;
}

std::vector<std::vector<int>> named_cell_groups(const Keywords& keywords, const std::string& keyword,
                                                const solver::Mesh& mesh) {
  std::vector<std::vector<int>> groups;
  each_group(
      keywords, keyword, [&](const std::string& name) { return mesh.cell_group(name); },
      [&](const std::vector<int>& group) { groups.push_back(group); });
  return groups;
}

int single_node(const Keywords& keywords, const std::string& node_keyword, const std::string& group_keyword,
                const solver::Mesh& mesh) {
  const auto nodes = selected_nodes(
      keywords, mesh, {.all = "", .node_groups = group_keyword, .nodes = node_keyword, .cell_groups = "", .cells = ""});
  if (nodes.size() == 1) return nodes.front();
  const std::string& keyword = keywords.given(group_keyword) ? group_keyword : node_keyword;
  throw DiagnosticError("wrong-count",
                        keyword + " names " + std::to_string(nodes.size()) + " nodes where one is wanted",
                        keywords.span_of(keyword), "name a group of one node");
}

std::vector<int> cells_or_all(const Keywords& keywords, const solver::Mesh& mesh) {
  if (names_a_place(keywords)) return selected_cells(keywords, mesh);
  std::vector<int> all(static_cast<std::size_t>(mesh.cell_count()));
  std::iota(all.begin(), all.end(), 0);
  return all;
}

bool names_a_place(const Keywords& keywords, const PlaceKeywords& names) {
  for (const std::string* name : {&names.all, &names.node_groups, &names.nodes, &names.cell_groups, &names.cells}) {
    if (takes(keywords, *name)) return true;
  }
  return false;
}

std::vector<int> needed(std::vector<int> selected, const Keywords& keywords, const char* what) {
  if (selected.empty())
    throw DiagnosticError("empty-group", fmt::format("what is named here holds no {}", what), keywords.span,
                          "look at the groups, and at what is left out");
  return selected;
}

}  // namespace comma::commands
