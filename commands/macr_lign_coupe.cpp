#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "commands/commands.hpp"
#include "commands/fields/field_reading.hpp"
#include "commands/model/angles.hpp"
#include "commands/points.hpp"
#include "commands/selection.hpp"
#include "commands/tables/node_values.hpp"
#include "interpreter/diagnostic.hpp"
#include "solver/error.hpp"
#include "solver/fields/data/rotation.hpp"
#include "solver/fields/points/projection.hpp"
#include "solver/mesh/groups.hpp"
#include "solver/mesh/place.hpp"

namespace comma::commands {

namespace {

using interpreter::DiagnosticError;

constexpr const char* cut_name = "MACR_LIGN_COUPE";

// How far outside a body a point still counts as on its surface, as a share of the line's length.
constexpr double on_surface = 1e-7;

// The line of an occurrence: its points as the nodes of a mesh, in order. Of a group of nodes the body's own mesh and
// the nodes on it.
struct CutLine {
  solver::Mesh points;
  std::vector<double> angles;  // of an arc
  std::vector<int> group;      // nodes of the body's mesh
  std::string title;
};

CutLine segment_of(const Keywords& line) {
  CutLine cut;
  const Eigen::Vector3d first = vector_of(line, "COOR_ORIG"), last = vector_of(line, "COOR_EXTR");
  const auto count = static_cast<int>(line.integer("NB_POINTS"));
  if (first == last)
    throw DiagnosticError("zero-vector", "MACR_LIGN_COUPE: the segment has no length", line.span_of("COOR_EXTR"));
  for (int i = 0; i < count; ++i)
    cut.points.nodes.push_back(solver::to_point(first + (last - first) * i / (count - 1.0)));
  return cut;
}

// The axis of an arc: across the plane of X and Y unless DNOR says otherwise.
Eigen::Vector3d axis_of(const Keywords& line, int dimension) {
  if (line.has("DNOR")) return solver::unit(vector_of(line, "DNOR"));
  if (dimension == 2) return Eigen::Vector3d::UnitZ();
  throw DiagnosticError("missing-keyword", "MACR_LIGN_COUPE: an arc in space needs the axis that it goes round",
                        line.span, "give DNOR");
}

CutLine arc_of(const Keywords& line, int dimension) {
  CutLine cut;
  const Eigen::Vector3d centre = vector_of(line, "CENTRE"), arm = vector_of(line, "COOR_ORIG") - centre;
  const Eigen::Vector3d axis = axis_of(line, dimension);
  const auto count = static_cast<int>(line.integer("NB_POINTS"));
  for (int i = 0; i < count; ++i) {
    const double angle = line.real("ANGLE") * i / (count - 1.0);
    const Eigen::AngleAxisd turn(angle * degree, axis);
    cut.points.nodes.push_back(solver::to_point(centre + turn * arm));
    cut.angles.push_back(angle);
  }
  return cut;
}

// A line of cells is walked as they run, from end to end of each; its points are looked for in the body like others.
CutLine line_of_cells(const Keywords& line) {
  const solver::Mesh& mesh = *line.data<MeshConcept>("MAILLAGE").mesh;
  CutLine cut;
  const auto segments = needed(selected_cells(line, mesh, cell_places), line, "cell");
  for (const int segment : segments)
    if (solver::dimension(mesh.cell_types[segment]) != 1)
      throw DiagnosticError("not-a-line", "MACR_LIGN_COUPE: the cells are no line of segments",
                            line.span_of("GROUP_MA"));
  const auto ends = solver::nodes_of_cells(mesh, segments, solver::NodeRole::corner);
  for (const int node : solver::nodes_along_line(mesh, segments))
    if (std::ranges::binary_search(ends, node)) cut.points.nodes.push_back(mesh.nodes[node]);
  return cut;
}

CutLine line_of(const Keywords& line, std::size_t number, const solver::Mesh& mesh) {
  const std::string& type = line.text("TYPE");
  CutLine cut;
  if (type == "SEGMENT") cut = segment_of(line);
  if (type == "ARC") cut = arc_of(line, mesh.dimension);
  if (type == "GROUP_MA") cut = line_of_cells(line);
  if (type == "GROUP_NO") cut.group = needed(selected_nodes(line, mesh, node_places), line, "node");
  cut.points.dimension = mesh.dimension;
  cut.title = line.has("INTITULE")                       ? line.text("INTITULE")
              : type == "GROUP_NO" || type == "GROUP_MA" ? line.texts(type).front()
                                                         : fmt::format("l.coupe{}", number);
  return cut;
}

// The cells in which points are looked for: those of the model, of VIS_A_VIS where that is given.
std::vector<int> host_cells(const Call& call, const FieldSource& source) {
  const solver::Model* model = call.has("MODELE") ? call.data<ModelConcept>("MODELE").model.get() : source.model;
  if (model == nullptr)
    throw DiagnosticError("missing-keyword", "MACR_LIGN_COUPE: the field knows its mesh alone", call.span,
                          "give MODELE");
  if (model->mesh.get() != &source.mesh)
    throw DiagnosticError("incompatible-field", "MACR_LIGN_COUPE: the field lies on another mesh than the model",
                          call.span_of("MODELE"));
  std::vector<int> cells = solver::bulk_cells(*model);
  if (!call.has("VIS_A_VIS")) return cells;
  std::vector<int> chosen;
  for (const Keywords& facing : call.factors("VIS_A_VIS"))
    for (const int cell : selected_cells(facing, source.mesh, {"", "", "", "GROUP_MA_1", "MAILLE_1"}))
      chosen.push_back(cell);
  return solver::intersection_of(std::vector<std::vector<int>>{cells, chosen});
}

// One distance holds for all lines, as in Code_Aster.
double farthest_point(const Call& call) {
  double farthest = 0.0;
  for (const Keywords& line : call.factors("LIGN_COUPE")) farthest = std::max(farthest, line.real("DISTANCE_MAX"));
  return farthest;
}

double length_of(const solver::Mesh& points) {
  double length = 0.0;
  for (std::size_t i = 1; i < points.nodes.size(); ++i)
    length += solver::distance(points.nodes[i - 1], points.nodes[i]);
  return length;
}

// Points outside the body have no row.
void leave_out_far(CutLine& cut, std::vector<solver::Embedding>& hosts, const Keywords& line, Context& context) {
  const std::size_t all = hosts.size();
  std::vector<solver::Embedding> found;
  CutLine kept = cut;
  kept.points.nodes.clear();
  kept.angles.clear();
  for (const solver::Embedding& host : hosts) {
    if (host.cell < 0) continue;
    found.push_back(host);
    kept.points.nodes.push_back(cut.points.nodes[static_cast<std::size_t>(host.node)]);
    if (!cut.angles.empty()) kept.angles.push_back(cut.angles[static_cast<std::size_t>(host.node)]);
  }
  if (found.size() == all) return;
  if (found.empty())
    throw DiagnosticError("no-host", "MACR_LIGN_COUPE: no point of the line lies in the body", line.span,
                          "look at COOR_ORIG and COOR_EXTR, or give DISTANCE_MAX");
  context.diagnostics.alarm(
      "points-outside",
      fmt::format("MACR_LIGN_COUPE: {} of {} points lie outside the body and have no row", all - found.size(), all),
      line.span, "give DISTANCE_MAX to take the nearest place of the body for them");
  cut = std::move(kept);
  hosts = std::move(found);
}

Row head_of_line(const CutLine& cut, const FieldSource& source) {
  Row head = {{"INTITULE", cut.title}};
  for (const auto& [column, cell] : source.columns)
    if (column != "RESU" && column != "CHAM_GD") head.emplace_back(column, cell);
  if (head.size() > 1) return head;
  // A field by itself stands as the first step of a result.
  const std::string quantity = std::visit([](const auto& field) { return field.quantity; }, source.field);
  head.insert(head.end(),
              {{"NOM_CHAM", quantity.substr(0, quantity.find('_'))}, {"NUME_ORDRE", std::int64_t{1}}, {"INST", 0.0}});
  return head;
}

NodeValues at_group(const Call& call, const CutLine& cut, const FieldSource& source) {
  NodeValues values{head_of_line(cut, source), source.mesh, cut.group, cut.group, at_nodes(call, source), {}};
  values.label = [](std::size_t) { return Row(); };
  return values;
}

NodeValues at_points(const CutLine& cut, const FieldSource& source, const std::vector<solver::Embedding>& hosts) {
  const auto* nodal = std::get_if<solver::NodalField>(&source.field);
  NodeValues values{head_of_line(cut, source),
                    cut.points,
                    {},
                    {},
                    nodal != nullptr ? solver::at_places(source.mesh, *nodal, hosts)
                                     : solver::at_places(std::get<solver::ElementField>(source.field), hosts),
                    {}};
  for (std::size_t i = 0; i < hosts.size(); ++i) values.nodes.push_back(static_cast<int>(i));
  values.rows = values.nodes;
  values.label = [angles = cut.angles](std::size_t entry) {
    return angles.empty() ? Row() : Row{{"ANGLE", angles[entry]}};
  };
  return values;
}

// Round the centre of an arc; in the plane Code_Aster has the one shear in SIXY.
void turn_round_centre(const Keywords& line, NodeValues& values) {
  const int dimension = values.mesh.dimension;
  const auto axes = solver::revolution_axes(values.mesh, vector_of(line, "CENTRE"), axis_of(line, dimension));
  values.field = solver::in_axes(values.field, values.rows, axes);
  if (dimension == 2) values.field = solver::with_shear_of_plane(std::move(values.field));
}

// What is made of tensors does not depend on their axes.
bool has_own_kind(const Keywords& line) {
  return line.has("INVARIANT") || line.has("ELEM_PRINCIPAUX") || line.has("TRAC_NOR") || line.has("TRAC_DIR");
}

void turn_along_line(const Keywords& line, NodeValues& values) {
  const auto second = line.has("VECT_Y") ? std::optional(vector_of(line, "VECT_Y")) : std::nullopt;
  values.field = solver::in_axes(values.field, values.rows, solver::chord_axes(values.mesh, values.nodes, second));
}

void take_values(const Keywords& line, NodeValues& values) {
  check_frame(cut_name, line, values.rows, values.field);
  const bool is_round = line.text("REPERE") == "CYLINDRIQUE";
  if (is_round && line.text("TYPE") == "ARC") return turn_round_centre(line, values);
  if (line.text("REPERE") == "LOCAL" && line.text("TYPE") == "ARC")
    throw DiagnosticError("excluded-keyword", "MACR_LIGN_COUPE: an arc has the axes of REPERE='CYLINDRIQUE'",
                          line.span_of("REPERE"));
  if (line.text("REPERE") == "LOCAL" && !has_own_kind(line)) return turn_along_line(line, values);
  take_wanted_values(cut_name, line, values.nodes, values);
  if (is_round && values.mesh.dimension == 2) values.field = solver::with_shear_of_plane(std::move(values.field));
}

void add_rows(Table& table, const Keywords& line, NodeValues values) {
  take_values(line, values);
  if (line.text("OPERATION") == "MOYENNE")
    add_line_means(table, line, values);
  else
    add_entries(table, line, values);
}

// Between Gauss points and from cell to cell a field has no values.
void require_values_between(const Call& call, const FieldSource& source) {
  const auto* element = std::get_if<solver::ElementField>(&source.field);
  if (element == nullptr || element->support == solver::Support::element_node) return;
  const char* keyword = call.has("CHAM_GD") ? "CHAM_GD" : "NOM_CHAM";
  throw DiagnosticError("unsupported", "MACR_LIGN_COUPE: the field has no values at nodes, from which the others come",
                        call.span_of(keyword),
                        "give a field at nodes (..._NOEU, DEPL) or at the nodes of cells (..._ELNO)");
}

void cut_along(Table& table, const Call& call, const Keywords& line, std::size_t number,
               const std::vector<FieldSource>& sources, Context& context) {
  const solver::Mesh& mesh = sources.front().mesh;
  CutLine cut = line_of(line, number, mesh);
  require_values_between(call, sources.front());
  if (!cut.group.empty() && std::holds_alternative<solver::NodalField>(sources.front().field)) {
    for (const FieldSource& source : sources) add_rows(table, line, at_group(call, cut, source));
    return;
  }
  for (const int node : cut.group) cut.points.nodes.push_back(mesh.nodes[node]);
  const auto cells = host_cells(call, sources.front());
  const double farthest = std::max(farthest_point(call), on_surface * length_of(cut.points));
  auto hosts = solver::embed_places(mesh, solver::places(cut.points), cells, farthest);
  leave_out_far(cut, hosts, line, context);
  for (const FieldSource& source : sources) add_rows(table, line, at_points(cut, source, hosts));
}

}  // namespace

Product macr_lign_coupe(const Call& call, Context& context) {
  warn_of_missing_instants(cut_name, call, context.diagnostics);
  const auto sources = field_sources(call);
  auto product = std::make_shared<TableConcept>();
  std::size_t number = 0;
  for (const Keywords& line : call.factors("LIGN_COUPE")) {
    try {
      cut_along(product->table, call, line, ++number, sources, context);
    } catch (const solver::Error& error) {
      throw DiagnosticError(error.code(), fmt::format("{}: {}", cut_name, error.what()), line.span, error.hint());
    }
  }
  return product;
}

}  // namespace comma::commands
