#include <algorithm>

#include <fmt/format.h>

#include "commands/commands.hpp"
#include "commands/model/angles.hpp"
#include "commands/occurrences.hpp"
#include "commands/selection.hpp"
#include "interpreter/diagnostic.hpp"
#include "solver/mesh/conversion.hpp"
#include "solver/mesh/refinement.hpp"
#include "solver/mesh/slave_cut.hpp"
#include "solver/mesh/transform.hpp"

namespace comma::commands {

namespace {

using interpreter::DiagnosticError;
using solver::Conversion;

// The keywords that change the type of cells.
constexpr std::pair<const char*, Conversion> conversions[] = {{"LINE_QUAD", Conversion::to_quadratic},
                                                              {"QUAD_LINE", Conversion::to_linear},
                                                              {"HEXA20_27", Conversion::hexa20_to_27},
                                                              {"PENTA15_18", Conversion::penta15_to_18}};

solver::Mesh with_changed_cells(const Keywords& change, const solver::Mesh& mesh) {
  const std::string& option = change.text("OPTION");
  const auto cells = selected_cells(change, mesh);
  if (option == "QUAD_TRIA3") return solver::with_triangles(mesh, cells);
  return solver::converted(mesh, cells, option == "TRIA6_7" ? Conversion::tria6_to_7 : Conversion::quad8_to_9);
}

// A file that serves several meshes asks each for what only some of them need.
void tell_if_unchanged(const solver::Mesh& before, const solver::Mesh& after, const Keywords& change,
                       const std::string& name, const Context& context) {
  if (after.cell_types != before.cell_types) return;
  context.diagnostics.alarm(
      "unchanged-mesh",
      "CREA_MAILLAGE: " + name + " leaves the mesh as it is: none of the cells is of a type that it changes",
      change.span, "leave it out, or name other cells");
}

// RESTREINT keeps the groups that it names, unless TOUT_GROUP_MA or TOUT_GROUP_NO keeps all.
void keep_named(const Keywords& restriction, const std::string& names, const std::string& all, solver::Groups& groups) {
  if (restriction.has(all) && restriction.text(all) == "OUI") return;
  const auto kept = restriction.texts(names);
  for (auto group = groups.begin(); group != groups.end();)
    group = std::ranges::find(kept, group->first) == kept.end() ? groups.erase(group) : std::next(group);
}

solver::Mesh restrict_to(const Keywords& restriction, const solver::Mesh& mesh) {
  if (restriction.given("GROUP_NO"))
    named_node_groups(restriction, "GROUP_NO", mesh);  // tells a name that does not exist
  solver::Mesh result =
      solver::restricted(mesh, selected_cells(restriction, mesh, {.all = "", .node_groups = "", .nodes = ""}));
  keep_named(restriction, "GROUP_MA", "TOUT_GROUP_MA", result.cell_groups);
  keep_named(restriction, "GROUP_NO", "TOUT_GROUP_NO", result.node_groups);
  return result;
}

solver::Mesh cut_slave_faces(const Keywords& cut, const solver::Mesh& mesh) {
  const auto faces = selected_cells(cut, mesh, {"", "", "", "GROUP_MA_ESCL", ""});
  return solver::with_cut_slave_faces(
      mesh, faces, cut.text("DECOUPE_HEXA") == "HEXA" ? solver::HexaCut::hexahedra : solver::HexaCut::pyramids);
}

// The row of the table that REPERE means: that of GROUP_MA, else the one that there is.
const std::vector<Cell>& section_row(const Keywords& frame, const Table& table) {
  const int place = table.column("LIEU");
  const std::string wanted = frame.given("GROUP_MA") ? frame.texts("GROUP_MA").front() : "";
  std::vector<const std::vector<Cell>*> found;
  for (const auto& row : table.rows) {
    const auto* name = place < 0 ? nullptr : std::get_if<std::string>(&row[static_cast<std::size_t>(place)]);
    if (wanted.empty() || (name != nullptr && without_padding(*name) == wanted)) found.push_back(&row);
  }
  if (found.size() == 1) return *found.front();
  throw DiagnosticError(
      "wrong-count", fmt::format("CREA_MAILLAGE: {} rows of the table can be meant, and one is needed", found.size()),
      frame.span_of("TABLE"), "name the section by GROUP_MA");
}

double section_value(const Keywords& frame, const Table& table, const std::vector<Cell>& row, const char* name) {
  const int column = table.column(name);
  const auto* value = column < 0 ? nullptr : std::get_if<double>(&row[static_cast<std::size_t>(column)]);
  if (value != nullptr) return *value;
  throw DiagnosticError("unknown-column", fmt::format("CREA_MAILLAGE: the table has no value {}", name),
                        frame.span_of("TABLE"), "give the table that POST_ELEM, CARA_GEOM makes");
}

// The mesh of a section in axes through its centre, turned to the principal ones.
void move_to_frame(const Keywords& frame, solver::Mesh& mesh) {
  const Table& table = frame.data<TableConcept>("TABLE").table;
  const auto& row = section_row(frame, table);
  if (frame.given("NOM_ORIG"))
    solver::translate(mesh,
                      {-section_value(frame, table, row, "CDG_Y"), -section_value(frame, table, row, "CDG_Z"), 0});
  if (frame.given("NOM_ROTA"))
    solver::rotate(mesh, {}, {0.0, 0.0, 1.0}, -section_value(frame, table, row, "ALPHA") * degree);
}

}  // namespace

Product crea_maillage(const Call& call, Context& context) {
  solver::Mesh mesh = *call.data<MeshConcept>("MAILLAGE").mesh;
  const auto take_converted = [&](solver::Mesh converted, const Keywords& change, const std::string& name) {
    tell_if_unchanged(mesh, converted, change, name, context);
    mesh = std::move(converted);
  };
  for (const auto& [name, conversion] : conversions) {
    each_occurrence(call, name, [&](const Keywords& one) {
      take_converted(solver::converted(mesh, selected_cells(one, mesh), conversion), one, name);
    });
  }
  each_occurrence(call, "MODI_MAILLE",
                  [&](const Keywords& one) { take_converted(with_changed_cells(one, mesh), one, one.text("OPTION")); });
  each_occurrence(call, "CREA_MAILLE",
                  [&](const Keywords& one) { solver::double_cells(mesh, selected_cells(one, mesh), one.text("NOM")); });
  each_occurrence(call, "CREA_POI1", [&](const Keywords& one) {
    solver::add_points(mesh, selected_nodes(one, mesh), one.given("NOM_GROUP_MA") ? one.text("NOM_GROUP_MA") : "");
  });
  each_occurrence(call, "DECOUPE_LAC", [&](const Keywords& one) { mesh = cut_slave_faces(one, mesh); });
  each_occurrence(call, "RESTREINT", [&](const Keywords& one) { mesh = restrict_to(one, mesh); });
  each_occurrence(call, "REPERE", [&](const Keywords& one) { move_to_frame(one, mesh); });
  each_occurrence(call, "RAFFINEMENT", [&](const Keywords& one) {
    for (std::int64_t level = 0; level < one.integer("NIVEAU"); ++level) mesh = solver::refined(mesh);
  });
  context.console.detail(fmt::format("  {} nodes, {} cells", mesh.node_count(), mesh.cell_count()));
  auto product = std::make_shared<MeshConcept>();
  product->mesh = std::make_shared<solver::Mesh>(std::move(mesh));
  return product;
}

}  // namespace comma::commands
