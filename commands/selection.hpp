// Nodes and cells that keywords name: TOUT, GROUP_NO, GROUP_MA, NOEUD, MAILLE.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "interpreter/graph/call.hpp"
#include "solver/mesh/mesh.hpp"

namespace comma::commands {

/// The keywords that name places, under the names they have in the occurrence at hand (GROUP_MA_ESCL ...). An empty
/// name is not looked at.
struct PlaceKeywords {
  std::string all = "TOUT";
  std::string node_groups = "GROUP_NO";
  std::string nodes = "NOEUD";
  std::string cell_groups = "GROUP_MA";
  std::string cells = "MAILLE";
};

/// Nodes by their own keywords alone, and cells by theirs.
inline const PlaceKeywords node_places = {"", "GROUP_NO", "NOEUD", "", ""};
inline const PlaceKeywords cell_places = {"", "", "", "GROUP_MA", "MAILLE"};

/// The nodes that the keywords name, those of named cells included, each once, in the order of the file.
/// Throws DiagnosticError `unknown-group`, `unknown-node`, `unknown-cell` at the keyword's value, with the nearest
/// name.
std::vector<int> selected_nodes(const interpreter::Keywords& keywords, const solver::Mesh& mesh,
                                const PlaceKeywords& names = {});

/// Those that SANS_GROUP_NO, SANS_NOEUD, SANS_GROUP_MA and SANS_MAILLE name, with this ending ("_1") where there is
/// one.
std::set<int> excluded_nodes(const interpreter::Keywords& keywords, const solver::Mesh& mesh,
                             const std::string& ending = "");

/// selected_nodes() less excluded_nodes().
std::vector<int> remaining_nodes(const interpreter::Keywords& keywords, const solver::Mesh& mesh,
                                 const PlaceKeywords& names = {}, const std::string& ending = "");

/// One node a name, groups opened in their own order, repetitions kept: what lists of terms go along with. Throws as
/// above.
std::vector<int> listed_nodes(const interpreter::Keywords& keywords, const solver::Mesh& mesh,
                              const std::string& node_groups, const std::string& nodes);

/// The cells that the keywords name, each once. Throws as above.
std::vector<int> selected_cells(const interpreter::Keywords& keywords, const solver::Mesh& mesh,
                                const PlaceKeywords& names = {});

/// The same, or all of the mesh where the keywords name none.
std::vector<int> cells_or_all(const interpreter::Keywords& keywords, const solver::Mesh& mesh);

/// The groups that a keyword names, one by one. Throw as above.
using NamedGroups = std::vector<std::vector<int>> (*)(const interpreter::Keywords& keywords, const std::string& keyword,
                                                      const solver::Mesh& mesh);
std::vector<std::vector<int>> named_node_groups(const interpreter::Keywords& keywords, const std::string& keyword,
                                                const solver::Mesh& mesh);
std::vector<std::vector<int>> named_cell_groups(const interpreter::Keywords& keywords, const std::string& keyword,
                                                const solver::Mesh& mesh);

/// The one node that a keyword names, or another by its group. Throws as above, and DiagnosticError `wrong-count` for a
/// group of several nodes.
int single_node(const interpreter::Keywords& keywords, const std::string& node_keyword,
                const std::string& group_keyword, const solver::Mesh& mesh);

/// Whether any of the keywords is given.
bool names_a_place(const interpreter::Keywords& keywords, const PlaceKeywords& names = {});

/// What was selected, of which there must be some. Throws DiagnosticError `empty-group` where what the keywords name
/// holds none.
std::vector<int> needed(std::vector<int> selected, const interpreter::Keywords& keywords, const char* what);

}  // namespace comma::commands
