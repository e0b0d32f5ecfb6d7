#include "commands/commands.hpp"
#include "solver/io/aster_mesh_file.hpp"
#include "solver/io/med_file.hpp"

namespace comma::commands {

namespace {

solver::Mesh read(const Call& call, const Context& context) {
  const bool text = call.text("FORMAT") == "ASTER";
  const int unit = static_cast<int>(call.integer("UNITE"));
  const std::vector<std::string> extensions = text ? std::vector<std::string>{"mail", "aster"} : std::vector<std::string>{"mmed", "med"};
  const std::string path = context.files.input(unit, extensions).string();
  context.console.progress("  reads " + path);
  return text ? solver::read_aster_mesh(path) : solver::read_med_mesh(path, call.has("NOM_MED") ? call.text("NOM_MED") : "");
}

}  // namespace

Product lire_maillage(const Call& call, Context& context) {
  auto product = std::make_shared<MeshConcept>();
  product->mesh = std::make_shared<solver::Mesh>(read(call, context));
  const solver::Mesh& mesh = *product->mesh;
  context.console.detail("  " + std::to_string(mesh.node_count()) + " nodes, " + std::to_string(mesh.cell_count()) +
                         " cells, " + std::to_string(mesh.cell_groups.size()) + " cell groups, " +
                         std::to_string(mesh.node_groups.size()) + " node groups");
  return product;
}

}  // namespace comma::commands
