// Values at nodes along a way, in the axes that REPERE names, and the rows of tables that come of them (U4.81.21).
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "commands/tables/table.hpp"
#include "interpreter/graph/call.hpp"
#include "solver/fields/data/rotation.hpp"

namespace comma::commands {

/// Entry i is at the node `nodes[i]` and has the row `rows[i]` of the field; a node may have several entries.
struct NodeValues {
  Row head;  ///< the columns that say where the values come from
  const solver::Mesh& mesh;
  std::vector<int> nodes;
  std::vector<int> rows;
  solver::NodalField field;
  std::function<Row(std::size_t entry)> label;  ///< the columns that say which entry a row is
};

/// The distances from the first entry, from entry to entry.
std::vector<double> abscissas(const NodeValues& values);

/// Axes that go round a line (REPERE='POLAIRE', 'CYLINDRIQUE' with ORIGINE and AXE_Z); nothing for other frames.
std::optional<solver::NodeAxes> round_axes(const interpreter::Keywords& action, const solver::Mesh& mesh);

/// The axes of ANGL_NAUT.
Eigen::Matrix3d axes_by_angles(const interpreter::Keywords& action);

/// The axes that REPERE names, at the nodes of a line; nothing for 'GLOBAL'. Throws what the axes throw.
std::optional<solver::NodeAxes> frame_axes(const interpreter::Keywords& action, const solver::Mesh& mesh,
                                           const std::vector<int>& nodes);

/// Components that keep their direction have nothing to do in another frame: throws DiagnosticError `unsupported` for
/// one that is asked for and that a row carries.
void check_frame(const std::string& command, const interpreter::Keywords& action, const std::vector<int>& rows,
                 const solver::NodalField& field);

/// The field in the axes of REPERE, or what INVARIANT, ELEM_PRINCIPAUX, TRAC_NOR and TRAC_DIR make of it. `line`: the
/// nodes of `values`, each once.
void take_wanted_values(const std::string& command, const interpreter::Keywords& action, const std::vector<int>& line,
                        NodeValues& values);

/// The components that the action names, all by default.
std::vector<int> wanted_components(const interpreter::Keywords& action, const solver::NodalField& field);

/// One row an entry where any of the components is carried: head, label, ABSC_CURV, COOR_X ..., the components.
void add_entries(Table& table, const interpreter::Keywords& action, const NodeValues& values);

/// One row a quantity: the mean along the line, the slope, the extremes and the ends of the straight line of the same
/// mean and slope.
void add_line_means(Table& table, const interpreter::Keywords& action, const NodeValues& values);

/// The values of a component in the entries that carry it, and their abscissas.
struct Profile {
  std::vector<double> abscissas, values;
};
/// Throws DiagnosticError `unknown-component` where no entry carries it.
Profile profile(const NodeValues& values, int component);

}  // namespace comma::commands
