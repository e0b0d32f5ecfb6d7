#include "commands/commands.hpp"
#include "commands/selection.hpp"
#include "solver/error.hpp"
#include "solver/mesh/orientation.hpp"

namespace comma::commands {

namespace {

void orient(const Keywords& skin, solver::Mesh& mesh, const PlaceKeywords& skin_names, const PlaceKeywords& support_names,
            const Context& context) {
  const auto cells = selected_cells(skin, mesh, skin_names);
  const auto support = selected_cells(skin, mesh, support_names);
  const int turned = solver::orient_skin(mesh, cells, support);
  context.console.detail("  " + std::to_string(turned) + " of " + std::to_string(cells.size()) + " skin cells turned outwards");
}

PlaceKeywords cell_group_keyword(const std::string& name) { return {"", "", "", name, ""}; }

}  // namespace

Product modi_maillage(const Call& call, Context& context) {
  solver::Mesh& mesh = *call.data<MeshConcept>("MAILLAGE").mesh;
  for (const Keywords& skin : call.factors("ORIE_PEAU")) {
    orient(skin, mesh, cell_group_keyword("GROUP_MA_PEAU"), cell_group_keyword("GROUP_MA_INTERNE"), context);
  }
  for (const Keywords& skin : call.factors("ORIE_PEAU_2D")) {
    orient(skin, mesh, cell_group_keyword("GROUP_MA"), cell_group_keyword("GROUP_MA_SURF"), context);
  }
  for (const Keywords& skin : call.factors("ORIE_PEAU_3D")) {
    orient(skin, mesh, cell_group_keyword("GROUP_MA"), cell_group_keyword("GROUP_MA_VOLU"), context);
  }
  return nullptr;
}

}  // namespace comma::commands
