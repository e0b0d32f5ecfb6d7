// What IMPR_RESU writes: the part of a result, a field or a mesh that the keywords choose.
#pragma once

#include <memory>
#include <string>

#include "commands/commands.hpp"
#include "commands/concepts.hpp"

namespace comma::commands {

// What one occurrence of RESU writes: the chosen part of a result, or of a field as a result of one step whose field
// has no name of its own. Without a result, the mesh alone.
struct PrintedPart {
  std::shared_ptr<const solver::Mesh> shared_mesh;
  std::string name;
  solver::Result result;
  bool mesh_alone = false;

  const solver::Mesh& mesh() const { return *shared_mesh; }
};

/// Of an occurrence of RESU. `med`: nodes choose nothing of fields on cells there, and in text the values at them.
PrintedPart part_of(const Keywords& print, bool med);

/// Of what is left out: names that nothing has, fields with several values a point, fields that nodes do not reach.
void warn_of_missing_names(const Keywords& print, interpreter::Diagnostics& diagnostics);
void warn_of_layers(const Keywords& print, interpreter::Diagnostics& diagnostics);
void warn_of_fields_out_of_reach(const Keywords& print, bool med, interpreter::Diagnostics& diagnostics);

}  // namespace comma::commands
