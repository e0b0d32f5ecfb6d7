#include <fmt/format.h>

#include "commands/commands.hpp"
#include "commands/selection.hpp"
#include "interpreter/diagnostic.hpp"
#include "solver/error.hpp"
#include "solver/mesh/joining.hpp"

namespace comma::commands {

namespace {

solver::JoinedMesh put_together(const Call& call) {
  const solver::Mesh& first = *call.data<MeshConcept>("MAILLAGE_1").mesh;
  const solver::Mesh& second = *call.data<MeshConcept>("MAILLAGE_2").mesh;
  if (call.text("OPERATION") == "SUPERPOSE") return solver::superposed(first, second);
  const Keywords& glue = call.factor("COLLAGE");
  const auto here = selected_cells(glue, first, {"", "", "", "GROUP_MA_1", ""});
  const auto there = selected_cells(glue, second, {"", "", "", "GROUP_MA_2", ""});
  try {
    return solver::glued(first, second, here, there);
  } catch (const solver::Error& error) {
    throw interpreter::DiagnosticError(error.code(), std::string("ASSE_MAILLAGE: ") + error.what(), glue.span,
                                       error.hint());
  }
}

}  // namespace

Product asse_maillage(const Call& call, Context& context) {
  solver::JoinedMesh joined = put_together(call);
  for (const auto& [before, after] : joined.renamed) {
    context.console.progress(
        fmt::format("ASSE_MAILLAGE: the group {} of {} is now {}", before, call.concept_of("MAILLAGE_2")->name, after));
  }
  auto product = std::make_shared<MeshConcept>();
  product->mesh = std::make_shared<solver::Mesh>(std::move(joined.mesh));
  return product;
}

}  // namespace comma::commands
