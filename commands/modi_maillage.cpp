#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "commands/analysis/same_mesh.hpp"
#include "commands/commands.hpp"
#include "commands/model/angles.hpp"
#include "commands/occurrences.hpp"
#include "commands/points.hpp"
#include "commands/selection.hpp"
#include "interpreter/diagnostic.hpp"
#include "solver/mesh/orientation.hpp"
#include "solver/mesh/transform.hpp"

namespace comma::commands {

namespace {

using interpreter::DiagnosticError;
using solver::Point;

// The cosine of the angle of two axes that still counts as none: directions that are written with seven digits.
constexpr double squareness = 1e-6;

PlaceKeywords cell_group_keyword(const std::string& name) { return {"", "", "", name, ""}; }

// A rigid surface has no inside, so its cells stay as they are. A skin of nothing else is a mistake, which orient_skin
// tells.
void leave_out_loose(const Keywords& skin, const solver::Mesh& mesh, const std::vector<int>& support,
                     std::vector<int>& cells, const Context& context) {
  const auto loose = solver::loose_skin(mesh, cells, support);
  if (loose.empty() || loose.size() == cells.size()) return;
  context.diagnostics.alarm(
      "skin-without-support",
      fmt::format("MODI_MAILLAGE: {} of {} skin cells, {} the first, bound no cell and are not turned", loose.size(),
                  cells.size(), mesh.cell_name(loose.front())),
      skin.span, "turn the surface of a rigid body with ORIE_NORM_COQUE");
  const std::set<int> left_out(loose.begin(), loose.end());
  std::erase_if(cells, [&](int cell) { return left_out.contains(cell); });
}

void orient_skin(const Keywords& skin, solver::Mesh& mesh, const char* skin_name, const char* support_name,
                 const Context& context) {
  auto cells = selected_cells(skin, mesh, cell_group_keyword(skin_name));
  const auto support = selected_cells(skin, mesh, cell_group_keyword(support_name));
  leave_out_loose(skin, mesh, support, cells, context);
  const int turned = solver::orient_skin(mesh, cells, support);
  context.console.detail(fmt::format("  {} of {} skin cells turned outwards", turned, cells.size()));
}

using Orient = int (*)(solver::Mesh&, std::span<const int>, const std::optional<solver::OrientationSeed>&);

// ORIE_NORM_COQUE and ORIE_LIGNE: the cells of each group run alike, and as a direction at a node says.
void orient_alike(const Keywords& sheet, solver::Mesh& mesh, const std::string& direction, Orient orient,
                  const Context& context) {
  std::optional<solver::OrientationSeed> seed;
  if (sheet.given(direction)) seed = {single_node(sheet, "NOEUD", "GROUP_NO", mesh), point_of(sheet, direction)};
  for (const auto& cells : named_cell_groups(sheet, "GROUP_MA", mesh)) {
    const int turned = orient(mesh, cells, seed);
    context.console.detail(fmt::format("  {} of {} cells turned", turned, cells.size()));
  }
}

Point difference(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

// The axis is Z in the plane; in space DIR or POIN_2 tells it.
void rotate(const Keywords& rotation, solver::Mesh& mesh) {
  const Point point = point_of(rotation, "POIN_1");
  Point axis = {0.0, 0.0, 1.0};
  if (rotation.given("DIR")) axis = point_of(rotation, "DIR");
  if (rotation.given("POIN_2")) axis = difference(point_of(rotation, "POIN_2"), point);
  const bool tells = rotation.given("DIR") || rotation.given("POIN_2");
  if (!tells && mesh.dimension == 3) {
    throw DiagnosticError("missing-keyword", "MODI_MAILLAGE/ROTATION: in space a rotation needs its axis",
                          rotation.span, "give DIR or POIN_2");
  }
  solver::rotate(mesh, point, axis, rotation.real("ANGLE") * degree);
}

// The mirror is a plane in space, a line in the plane.
void mirror(const Keywords& symmetry, solver::Mesh& mesh) {
  const Point a = point_of(symmetry, "AXE_1");
  if (mesh.dimension == 3 && !symmetry.given("AXE_2")) {
    throw DiagnosticError("missing-keyword", "MODI_MAILLAGE/SYMETRIE: in space a mirror needs two directions",
                          symmetry.span, "give AXE_2");
  }
  const Point b = symmetry.given("AXE_2") ? point_of(symmetry, "AXE_2") : Point{0.0, 0.0, 1.0};
  const Point normal = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  solver::mirror(mesh, point_of(symmetry, "POINT"), normal);
}

void change_axes(const Keywords& axes, solver::Mesh& mesh) {
  const Point x = point_of(axes, "VECT_X");
  if (mesh.dimension == 3 && !axes.given("VECT_Y")) {
    throw DiagnosticError("missing-keyword", "MODI_MAILLAGE/MODI_BASE: in space the new axes need two directions",
                          axes.span, "give VECT_Y");
  }
  const Point y = axes.given("VECT_Y") ? point_of(axes, "VECT_Y") : Point{-x[1], x[0], 0.0};
  const double lengths = std::hypot(x[0], x[1], x[2]) * std::hypot(y[0], y[1], y[2]);
  if (std::abs(x[0] * y[0] + x[1] * y[1] + x[2] * y[2]) > squareness * lengths) {
    throw DiagnosticError("oblique-axes", "MODI_MAILLAGE/MODI_BASE: VECT_X and VECT_Y are not at right angles",
                          axes.span_of("VECT_Y"), "take off VECT_Y what of it lies along VECT_X");
  }
  solver::change_axes(mesh, x, y);
}

void deform(const Keywords& deformation, solver::Mesh& mesh) {
  const auto& concept_data = deformation.data<FieldConcept>("DEPL");
  const auto* field = std::get_if<solver::NodalField>(&concept_data.field);
  if (field == nullptr) {
    throw DiagnosticError("wrong-type", "MODI_MAILLAGE/DEFORME: nodes move by a field on nodes",
                          deformation.span_of("DEPL"), "CREA_CHAMP with TYPE_CHAM=\"NOEU_DEPL_R\" makes one");
  }
  // A copy of the mesh has the same cells.
  if (concept_data.mesh->cell_types != mesh.cell_types || concept_data.mesh->connectivity != mesh.connectivity)
    require_mesh(deformation, "DEPL", concept_data.mesh.get(), mesh);
  solver::displace(mesh, *field);
}

}  // namespace

Product modi_maillage(const Call& call, Context& context) {
  solver::Mesh& mesh = *call.data<MeshConcept>("MAILLAGE").mesh;
  each_occurrence(call, "ORIE_PEAU",
                  [&](const Keywords& one) { orient_skin(one, mesh, "GROUP_MA_PEAU", "GROUP_MA_INTERNE", context); });
  each_occurrence(call, "ORIE_PEAU_2D",
                  [&](const Keywords& one) { orient_skin(one, mesh, "GROUP_MA", "GROUP_MA_SURF", context); });
  each_occurrence(call, "ORIE_PEAU_3D",
                  [&](const Keywords& one) { orient_skin(one, mesh, "GROUP_MA", "GROUP_MA_VOLU", context); });
  each_occurrence(call, "ORIE_NORM_COQUE",
                  [&](const Keywords& one) { orient_alike(one, mesh, "VECT_NORM", solver::orient_normals, context); });
  each_occurrence(call, "ORIE_LIGNE",
                  [&](const Keywords& one) { orient_alike(one, mesh, "VECT_TANG", solver::orient_lines, context); });
  each_occurrence(call, "DEFORME", [&](const Keywords& one) { deform(one, mesh); });
  if (call.given("ECHELLE")) solver::scale(mesh, call.real("ECHELLE"));
  if (call.given("TRANSLATION")) solver::translate(mesh, point_of(call, "TRANSLATION"));
  each_occurrence(call, "MODI_BASE", [&](const Keywords& one) { change_axes(one, mesh); });
  each_occurrence(call, "ROTATION", [&](const Keywords& one) { rotate(one, mesh); });
  each_occurrence(call, "SYMETRIE", [&](const Keywords& one) { mirror(one, mesh); });
  return nullptr;
}

}  // namespace comma::commands
