#include "commands/commands.hpp"
#include "solver/io/aster_mesh_file.hpp"
#include "solver/io/med_file.hpp"

namespace comma::commands {

namespace {

solver::Mesh read(const Call& call, const Context& context) {
  const std::string& format = call.text("FORMAT");
  const int unit = static_cast<int>(call.integer("UNITE"));
  if (format == "ASTER") return solver::read_aster_mesh(context.files.input(unit, {"mail", "aster"}).string());
  const std::string name = call.has("NOM_MED") ? call.text("NOM_MED") : "";
  return solver::read_med_mesh(context.files.input(unit, {"mmed", "med"}).string(), name);
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
