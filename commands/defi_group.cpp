#include <algorithm>
#include <numbers>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "commands/analysis/result_reading.hpp"
#include "commands/commands.hpp"
#include "commands/fields/field_types.hpp"
#include "commands/model/angles.hpp"
#include "commands/occurrences.hpp"
#include "commands/points.hpp"
#include "commands/selection.hpp"
#include "interpreter/diagnostic.hpp"
#include "solver/constraints/embedding.hpp"
#include "solver/mesh/axes.hpp"
#include "solver/mesh/groups.hpp"
#include "solver/mesh/place.hpp"

namespace comma::commands {

namespace {

using interpreter::DiagnosticError;
using solver::Groups;

// The groups of one kind in a mesh, and how messages call them.
struct Target {
  Groups& groups;
  const char* kind;  // "nodes", "cells"
  const Context& context;
};

// A group is never replaced in silence, and an empty one is not made: Code_Aster does the same (U4.22.01).
void add_group(const Target& target, const std::string& name, std::vector<int> members, const Keywords& made_by) {
  if (members.empty()) {
    target.context.diagnostics.alarm("empty-group",
                                     fmt::format("DEFI_GROUP: the group {} would be empty and is not made", name),
                                     made_by.span, fmt::format("no {} are in the place that this names", target.kind));
    return;
  }
  if (!target.groups.try_emplace(name, std::move(members)).second) {
    throw DiagnosticError("group-exists",
                          fmt::format("DEFI_GROUP: the mesh has a group {} of {} already", name, target.kind),
                          made_by.span, "choose another NOM, or drop this line");
  }
}

// NUME_INIT ... NUME_FIN, or POSITION: a part of a group.
std::vector<int> part_of(std::vector<int> members, const Keywords& creation) {
  const auto count = static_cast<std::int64_t>(members.size());
  std::int64_t first = 1;
  std::int64_t last = count;
  if (creation.given("POSITION")) {
    const std::string& position = creation.text("POSITION");
    first = last = position == "INIT" ? 1 : position == "FIN" ? count : (count + 1) / 2;
  }
  if (creation.given("NUME_INIT")) first = creation.integer("NUME_INIT");
  if (creation.given("NUME_FIN")) last = creation.integer("NUME_FIN");
  if (first > last || last > count) {
    throw DiagnosticError("index-error",
                          fmt::format("DEFI_GROUP: numbers {} to {} are not in a group of {}", first, last, count),
                          creation.span, "members count from 1; NUME_FIN is at least NUME_INIT");
  }
  return {members.begin() + (first - 1), members.begin() + last};
}

// UNION, INTERSEC, DIFFE; nothing when none of them is given.
std::optional<std::vector<int>> combination(const Keywords& creation, const solver::Mesh& mesh, NamedGroups named) {
  if (creation.given("UNION")) return solver::union_of(named(creation, "UNION", mesh));
  if (creation.given("INTERSEC")) return solver::intersection_of(named(creation, "INTERSEC", mesh));
  if (creation.given("DIFFE")) return solver::difference_of(named(creation, "DIFFE", mesh));
  return std::nullopt;
}

// The centre of a shape: POINT, or a node.
solver::Point centre(const Keywords& creation, const solver::Mesh& mesh) {
  if (creation.given("POINT")) return point_of(creation, "POINT");
  return mesh.nodes[static_cast<std::size_t>(single_node(creation, "NOEUD_CENTRE", "GROUP_NO_CENTRE", mesh))];
}

// VECT_NORMALE, or the first axis of ANGL_NAUT.
solver::Point direction(const Keywords& creation) {
  if (creation.given("VECT_NORMALE")) return point_of(creation, "VECT_NORMALE");
  const solver::Point angles = point_of(creation, "ANGL_NAUT");
  const Eigen::Vector3d axis = solver::nautical_axes(angles[0] * degree, angles[1] * degree, 0.0).row(0);
  return {axis[0], axis[1], axis[2]};
}

solver::NodeCriterion criterion(const std::string& word) {
  if (word == "TOUT" || word == "TOUS") return solver::NodeCriterion::all;
  if (word == "SOMMET") return solver::NodeCriterion::corners;
  return word == "MAJORITE" ? solver::NodeCriterion::majority : solver::NodeCriterion::any;
}

std::vector<int> cells_of_option(const Keywords& creation, const solver::Mesh& mesh) {
  const std::string& option = creation.text("OPTION");
  if (option == "FACE_NORMALE") {
    const bool either = creation.text("VERI_SIGNE") == "NON";
    return solver::cells_with_normal(mesh, direction(creation), creation.real("ANGL_PREC") * degree, either);
  }
  if (option == "APPUI") {
    const auto nodes = selected_nodes(creation, mesh, {.all = "", .cell_groups = "", .cells = ""});
    return solver::cells_on_nodes(mesh, nodes, criterion(creation.text("TYPE_APPUI")));
  }
  const solver::NodeCriterion nodes = criterion(creation.text("CRIT_NOEUD"));
  const solver::Point at = centre(creation, mesh);
  if (option == "SPHERE")
    return solver::cells_on_nodes(mesh, solver::nodes_in_ball(mesh, at, creation.real("RAYON")), nodes);
  const solver::Point along = direction(creation);
  if (option == "CYLINDRE") {
    return solver::cells_on_nodes(mesh, solver::nodes_in_cylinder(mesh, at, along, creation.real("RAYON")), nodes);
  }
  return solver::cells_on_nodes(mesh, solver::nodes_on_plane(mesh, at, along, creation.real("DIST")), nodes);  // BANDE
}

// TYPE_MAILLE: "QUAD4" ..., "2D" ..., "TOUT".
bool is_of_type(solver::CellType type, const std::string& word) {
  if (word == "TOUT") return true;
  if (word.size() == 2 && word[1] == 'D') return solver::dimension(type) == word[0] - '0';
  return solver::name_of(type) == word;
}

std::vector<int> cells_of(const Keywords& creation, const solver::Mesh& mesh) {
  if (auto combined = combination(creation, mesh, named_cell_groups)) return *std::move(combined);
  if (creation.given("OPTION")) return cells_of_option(creation, mesh);
  const auto cells = selected_cells(creation, mesh);
  return creation.given("GROUP_MA") ? part_of(cells, creation) : cells;
}

void make_cell_group(const Keywords& creation, solver::Mesh& mesh, const Context& context) {
  auto cells = cells_of(creation, mesh);
  if (creation.given("TYPE_MAILLE")) {
    const auto words = creation.texts("TYPE_MAILLE");
    std::erase_if(cells, [&](int cell) {
      return std::ranges::none_of(words,
                                  [&](const std::string& word) { return is_of_type(mesh.cell_types[cell], word); });
    });
  }
  add_group({mesh.cell_groups, "cells", context}, creation.text("NOM"), std::move(cells), creation);
}

// An end of a line: NOEUD_ORIG or GROUP_NO_ORIG, NOEUD_EXTR or GROUP_NO_EXTR.
std::optional<int> end_of_line(const Keywords& creation, const std::string& end, const solver::Mesh& mesh) {
  if (!creation.given("NOEUD_" + end) && !creation.given("GROUP_NO_" + end)) return std::nullopt;
  return single_node(creation, "NOEUD_" + end, "GROUP_NO_" + end, mesh);
}

std::vector<int> nodes_in_order(const Keywords& creation, const solver::Mesh& mesh) {
  const auto start = end_of_line(creation, "ORIG", mesh);
  const auto end = end_of_line(creation, "EXTR", mesh);
  if (creation.text("OPTION") == "NOEUD_ORDO") {
    std::optional<solver::Point> step;
    if (creation.given("VECT_ORIE")) step = point_of(creation, "VECT_ORIE");
    return solver::nodes_along_line(mesh, selected_cells(creation, mesh), start, end, step);
  }
  if (!start || !end) {
    throw DiagnosticError("missing-keyword", "DEFI_GROUP: SEGM_DROI_ORDO needs both ends of the segment", creation.span,
                          "give GROUP_NO_ORIG and GROUP_NO_EXTR");
  }
  double tolerance = creation.real("PRECISION");
  if (creation.text("CRITERE") == "RELATIF") tolerance *= solver::distance(mesh.nodes[*start], mesh.nodes[*end]);
  return solver::nodes_along_segment(mesh, selected_nodes(creation, mesh), *start, *end, tolerance);
}

// INTERVALLE_VALE: where a component of a field lies between two values.
std::vector<int> nodes_in_interval(const Keywords& creation, const solver::Mesh& mesh) {
  const FieldConcept& data = number_field(creation.concept_of("CHAM_GD"), creation, "CHAM_GD");
  if (data.mesh.get() != &mesh)
    throw DiagnosticError("different-mesh", "DEFI_GROUP: the field lies on another mesh", creation.span_of("CHAM_GD"));
  const auto& field = std::get<solver::NodalField>(data.field);
  const int component = component_of(creation, field.components, creation.text("NOM_CMP"));
  const auto bounds = creation.reals("VALE");
  std::vector<int> nodes;
  for (int node = 0; node < mesh.node_count(); ++node) {
    const double value = field.at(node, component);
    if (value >= bounds[0] && value <= bounds[1]) nodes.push_back(node);  // false where there is none
  }
  return nodes;
}

// INCLUSION: nodes in cells of another mesh, on their boundary but for rounding.
std::vector<int> nodes_inside(const Keywords& creation, const solver::Mesh& mesh) {
  constexpr double rounding = 1e-7;
  const solver::Mesh& other = *creation.data<MeshConcept>("MAILLAGE_INCL").mesh;
  const auto cells = selected_cells(creation, other, {"", "", "", "GROUP_MA_INCL", ""});
  const auto nodes = selected_nodes(creation, mesh);
  std::vector<Eigen::Vector3d> places;
  Eigen::AlignedBox3d extent;
  for (const int node : nodes) {
    places.push_back(solver::place(mesh, node));
    extent.extend(places.back());
  }
  const double farthest = std::max(creation.real("DISTANCE_MAX"), rounding * extent.diagonal().norm());
  std::vector<int> inside;
  for (const solver::Embedding& host : solver::embed_places(other, places, cells, farthest))
    if (host.cell >= 0) inside.push_back(nodes[static_cast<std::size_t>(host.node)]);
  return inside;
}

std::vector<int> nodes_of_option(const Keywords& creation, const solver::Mesh& mesh) {
  const std::string& option = creation.text("OPTION");
  if (option == "NOEUD_ORDO" || option == "SEGM_DROI_ORDO") return nodes_in_order(creation, mesh);
  if (option == "INTERVALLE_VALE") return nodes_in_interval(creation, mesh);
  if (option == "INCLUSION") return nodes_inside(creation, mesh);
  const solver::Point at = centre(creation, mesh);
  const double tolerance = creation.real("PRECISION");
  if (option == "ENV_SPHERE") return solver::nodes_on_sphere(mesh, at, creation.real("RAYON"), tolerance);
  const solver::Point along = direction(creation);
  if (option == "ENV_CYLINDRE") return solver::nodes_on_cylinder(mesh, at, along, creation.real("RAYON"), tolerance);
  return solver::nodes_on_plane(mesh, at, along, tolerance);  // PLAN
}

std::vector<int> nodes_of_cells(const Keywords& creation, const std::vector<int>& cells, const solver::Mesh& mesh) {
  const std::string& which = creation.text("CRIT_NOEUD");
  if (which == "TOUS") return mesh.nodes_of_cells(cells);
  return solver::nodes_of_cells(mesh, cells,
                                which == "SOMMET"   ? solver::NodeRole::corner
                                : which == "MILIEU" ? solver::NodeRole::mid_edge
                                                    : solver::NodeRole::centre);
}

// GROUP_MA: a node group for each cell group, under the names of NOM or the groups' own; one name is for all of them.
void node_groups_of_cell_groups(const Keywords& creation, const solver::Mesh& mesh, const Target& target) {
  const auto groups = creation.texts("GROUP_MA");
  const auto names = creation.given("NOM") ? creation.texts("NOM") : groups;
  std::vector<std::vector<int>> nodes;
  for (const auto& cells : named_cell_groups(creation, "GROUP_MA", mesh))
    nodes.push_back(nodes_of_cells(creation, cells, mesh));
  if (names.size() == 1) return add_group(target, names[0], solver::union_of(nodes), creation);
  if (names.size() != groups.size()) {
    throw DiagnosticError("wrong-count",
                          fmt::format("DEFI_GROUP: NOM gives {} names to {} groups", names.size(), groups.size()),
                          creation.span_of("NOM"),
                          "give one name a group, one for all of them, or leave NOM out to keep the groups' names");
  }
  for (std::size_t i = 0; i < groups.size(); ++i) add_group(target, names[i], std::move(nodes[i]), creation);
}

// Of several in GROUP_NO the first, as Code_Aster 17.3 does.
std::vector<int> first_group(const Keywords& creation, const solver::Mesh& mesh, const Context& context) {
  const auto names = creation.texts("GROUP_NO");
  if (names.size() > 1) {
    context.diagnostics.alarm(
        "first-group", fmt::format("DEFI_GROUP: {} takes the nodes of {} alone", creation.texts("NOM")[0], names[0]),
        creation.span_of("GROUP_NO"), "UNION takes those of several groups");
  }
  return named_node_groups(creation, "GROUP_NO", mesh).front();
}

void make_node_group(const Keywords& creation, solver::Mesh& mesh, const Context& context) {
  const Target target{mesh.node_groups, "nodes", context};
  if (creation.given("TOUT_GROUP_MA")) {
    const auto kept = solver::add_node_groups_of_all_cell_groups(mesh);
    if (kept.empty()) return;
    context.diagnostics.alarm(
        "group-exists",
        fmt::format(
            "DEFI_GROUP: node groups of the names of cell groups stay as they are, with other nodes than those: {}",
            fmt::join(kept, ", ")),
        creation.span);
    return;
  }
  if (creation.given("GROUP_MA") && !creation.given("OPTION"))
    return node_groups_of_cell_groups(creation, mesh, target);
  const auto names = creation.texts("NOM");
  if (names.size() != 1) {
    throw DiagnosticError("wrong-count",
                          fmt::format("DEFI_GROUP: one group is made here, and NOM gives {} names", names.size()),
                          creation.span, "give NOM one name");
  }
  if (auto combined = combination(creation, mesh, named_node_groups))
    return add_group(target, names[0], *std::move(combined), creation);
  if (creation.given("OPTION")) return add_group(target, names[0], nodes_of_option(creation, mesh), creation);
  if (!creation.given("GROUP_NO")) return add_group(target, names[0], selected_nodes(creation, mesh), creation);
  add_group(target, names[0], part_of(first_group(creation, mesh, context), creation), creation);
}

// A group need not be there, so that a loop can remove and make it in each turn (U4.22.01); one that nothing makes may
// be misspelt.
void remove_groups(const Call& call, const std::string& kind, Groups& groups, Context& context) {
  for (const Keywords& removal : call.factors("DETR_" + kind)) {
    for (const std::string& name : removal.texts("NOM")) {
      const auto makes = [&](const Keywords& making) {
        const auto made = making.texts("NOM");
        return std::ranges::find(made, name) != made.end();
      };
      if (groups.erase(name) || std::ranges::any_of(call.factors("CREA_" + kind), makes)) continue;
      context.diagnostics.alarm("no-such-group",
                                fmt::format("DEFI_GROUP/DETR_{}: the mesh has no group {} to remove", kind, name),
                                removal.span_of("NOM"), interpreter::did_you_mean(name, solver::names_of(groups)));
    }
  }
}

}  // namespace

Product defi_group(const Call& call, Context& context) {
  solver::Mesh& mesh = *call.data<MeshConcept>("MAILLAGE").mesh;
  remove_groups(call, "GROUP_MA", mesh.cell_groups, context);
  remove_groups(call, "GROUP_NO", mesh.node_groups, context);
  each_occurrence(call, "CREA_GROUP_MA", [&](const Keywords& one) { make_cell_group(one, mesh, context); });
  each_occurrence(call, "CREA_GROUP_NO", [&](const Keywords& one) { make_node_group(one, mesh, context); });
  return nullptr;
}

}  // namespace comma::commands
