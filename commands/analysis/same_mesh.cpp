#include "commands/analysis/same_mesh.hpp"

#include "interpreter/diagnostic.hpp"

namespace comma::commands {

void require_mesh(const interpreter::Keywords& keywords, const char* keyword, const solver::Mesh* own,
                  const solver::Mesh& mesh) {
  if (own == nullptr || own == &mesh) return;
  throw interpreter::DiagnosticError(
      "other-mesh",
      keywords.concept_of(keyword)->name + " lies on another mesh than the rest of what the command is given",
      keywords.span_of(keyword), "make it anew on the same mesh");
}

}  // namespace comma::commands
