// The parts of a model that POST_ELEM makes rows of (U4.81.22).
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "commands/fields/field_reading.hpp"
#include "commands/tables/table.hpp"
#include "interpreter/diagnostic.hpp"
#include "interpreter/graph/call.hpp"
#include "solver/mesh/mesh.hpp"
#include "solver/model/model.hpp"

namespace comma::commands {

/// A part of the model with the name and kind that its row shows.
struct Part {
  std::string name, kind;
  std::vector<int> cells;
};

/// TOUT, then one part a group, then one a cell.
std::vector<Part> parts_of(const interpreter::Call& call, const interpreter::Keywords& occurrence,
                           const solver::Mesh& mesh);

/// The same, and after several groups of an occurrence what they make together, UNION_GROUP_MA, a cell of two groups
/// once.
std::vector<Part> parts_and_union(const interpreter::Call& call, const interpreter::Keywords& occurrence,
                                  const solver::Mesh& mesh);

/// LIEU and ENTITE.
Row place_columns(const Part& part);

/// TOUT, GROUP_MA or MAILLE, under its own name.
Row named_place(const Part& part);

/// Takes away the cells of another dimension than "1D", "2D" or "3D" says.
void keep_dimension(Part& part, const solver::Mesh& mesh, const std::string& dimension);

/// Alarm `cells-left-out`: elements of the part that have no volume to integrate over, beams, plates and discrete
/// elements.
void warn_of_cells_left_out(const char* keyword, const interpreter::Keywords& occurrence, const Part& part,
                            const solver::Model& model, interpreter::Diagnostics& diagnostics);

/// MODELE, else the model of RESULTAT or CHAM_GD. Throws DiagnosticError `missing-keyword` where there is none.
std::shared_ptr<const solver::Model> model_behind(const interpreter::Call& call);

/// A field that can be integrated over cells; one at nodes goes to the nodes of each cell first.
solver::ElementField on_elements(const FieldSource& source, const solver::Model& model);

/// The keywords of the call with the field that the occurrence names.
interpreter::Keywords with_field(const interpreter::Call& call, const interpreter::Keywords& occurrence);

}  // namespace comma::commands
