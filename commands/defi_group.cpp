#include "commands/commands.hpp"
#include "interpreter/diagnostic.hpp"
#include "solver/error.hpp"

namespace comma::commands {

namespace {

using interpreter::DiagnosticError;
using Groups = std::map<std::string, std::vector<int>, std::less<>>;

const std::vector<int>& cell_group(const Keywords& keywords, const std::string& keyword, const solver::Mesh& mesh,
                                   const std::string& name) {
  try {
    return mesh.cell_group(name);
  } catch (const solver::Error& error) {
    throw DiagnosticError(error.code(), keyword + ": " + error.what(), keywords.span_of(keyword), error.hint());
  }
}

// A group is never replaced in silence: Code_Aster stops on a name that is taken (U4.22.01).
void add_group(Groups& groups, const std::string& name, std::vector<int> nodes, const Keywords& made_by) {
  if (!groups.emplace(name, std::move(nodes)).second) {
    throw DiagnosticError("group-exists", "DEFI_GROUP: the mesh has a group " + name + " of nodes already", made_by.span,
                          "choose another NOM, or drop this line");
  }
}

// TOUT_GROUP_MA: one node group for each cell group, under the same name; a node group of that name stays as it is.
void node_groups_of_all_cell_groups(solver::Mesh& mesh) {
  for (const auto& [name, cells] : mesh.cell_groups) mesh.node_groups.emplace(name, mesh.nodes_of_cells(cells));
}

void node_groups_of_named_cell_groups(const Keywords& creation, solver::Mesh& mesh) {
  const auto groups = creation.texts("GROUP_MA");
  const auto names = creation.given("NOM") ? creation.texts("NOM") : groups;
  if (names.size() != groups.size()) {
    throw DiagnosticError("wrong-count", "DEFI_GROUP: NOM gives " + std::to_string(names.size()) + " names to " +
                                             std::to_string(groups.size()) + " groups",
                          creation.span_of("NOM"), "give one name a group, or leave NOM out to keep the groups' names");
  }
  for (std::size_t i = 0; i < groups.size(); ++i) {
    add_group(mesh.node_groups, names[i], mesh.nodes_of_cells(cell_group(creation, "GROUP_MA", mesh, groups[i])), creation);
  }
}

}  // namespace

Product defi_group(const Call& call, Context&) {
  solver::Mesh& mesh = *call.data<MeshConcept>("MAILLAGE").mesh;
  for (const Keywords& creation : call.factors("CREA_GROUP_NO")) {
    if (creation.given("TOUT_GROUP_MA")) {
      node_groups_of_all_cell_groups(mesh);
    } else {
      node_groups_of_named_cell_groups(creation, mesh);
    }
  }
  return nullptr;
}

}  // namespace comma::commands
