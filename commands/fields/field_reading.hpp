// Reading fields by RESULTAT and NOM_CHAM or by CHAM_GD, step by step, as the commands that make tables do.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "commands/analysis/result_reading.hpp"
#include "commands/concepts.hpp"
#include "commands/tables/table.hpp"
#include "interpreter/diagnostic.hpp"
#include "interpreter/graph/call.hpp"

namespace comma::commands {

/// A field, what it lies on, and the columns of a table that say where it comes from: RESU, NOM_CHAM, NUME_ORDRE, INST,
/// or CHAM_GD.
struct FieldSource {
  const solver::Field& field;
  const solver::Mesh& mesh;
  const solver::Model* model;  ///< null for a field that knows its mesh alone
  std::vector<std::pair<std::string, Cell>> columns;
  std::shared_ptr<const solver::Field> made = {};  ///< what `field` is where it was made for the reader
};

/// What a reader makes of fields that have several values a point, in the thickness of plates.
enum class ValuesAPoint : std::uint8_t { one, any };

/// One a selected step of RESULTAT, or the field CHAM_GD; with NOM_VARI its components are names of internal variables.
/// Throws DiagnosticError `unknown-step`, `unknown-field`, `wrong-type`, `layered-field` for one with several values a
/// point where one is wanted.
std::vector<FieldSource> field_sources(const interpreter::Keywords& keywords, ValuesAPoint wanted = ValuesAPoint::one);

/// The field at nodes: as it is, or the mean over the cells (all when null) of a field at the nodes of cells. Throws
/// DiagnosticError `unsupported` for one at other points.
solver::NodalField at_nodes(const interpreter::Keywords& keywords, const FieldSource& source,
                            const std::vector<int>* cells = nullptr);

/// What the columns NOEUD and MAILLE say: the name, or the bare number where the mesh gives none (as Code_Aster does
/// since nodes and cells of files keep no names).
std::string table_node(const solver::Mesh& mesh, int node);
std::string table_cell(const solver::Mesh& mesh, int cell);

/// The indices of the components that NOM_CMP or NOM_VARI names, all when it is not given. Throws DiagnosticError
/// `unknown-component`.
std::vector<int> chosen_components(const interpreter::Keywords& keywords, const std::vector<std::string>& components);
/// Whether only bodies in space have the component, or plates and beams.
bool is_out_of_plane(const std::string& name);
/// The components that NOM_CMP names and the field has. Of internal variables, V1, V2 ..., there are as many as the
/// laws in the field have: others are left out, with an alarm, and so is what only bodies in space have (DZ, SIXZ ...).
/// Throws DiagnosticError `unknown-component` for other names, and where none is left.
std::vector<std::string> known_components(const interpreter::Keywords& keywords,
                                          const std::vector<std::string>& components,
                                          interpreter::Diagnostics& diagnostics);

}  // namespace comma::commands
