#include "commands/commands.hpp"
#include "commands/selection.hpp"

namespace comma::commands {

Product affe_materiau(const Call& call, Context&) {
  const solver::Mesh& mesh = call.has("MAILLAGE") ? *call.data<MeshConcept>("MAILLAGE").mesh
                                                  : *call.data<ModelConcept>("MODELE").model->mesh;
  auto field = std::make_shared<solver::MaterialField>();
  field->by_cell.resize(static_cast<std::size_t>(mesh.cell_count()));
  for (const Keywords& assignment : call.factors("AFFE")) {
    if (assignment.concepts("MATER").size() > 1) {
      throw interpreter::DiagnosticError("unsupported", "AFFE_MATERIAU: comma gives a cell one material", assignment.span_of("MATER"),
                                         "put all laws into one DEFI_MATERIAU");
    }
    const auto& material = interpreter::data_of<MaterialConcept>(assignment.concepts("MATER").front(), "MATER").material;
    for (const int cell : selected_cells(assignment, mesh)) field->by_cell[cell] = material;
  }
  auto product = std::make_shared<MaterialFieldConcept>();
  product->field = std::move(field);
  return product;
}

}  // namespace comma::commands
