#include "commands/tables/section_table.hpp"

#include <algorithm>
#include <array>

#include "commands/concepts.hpp"
#include "commands/model/angles.hpp"
#include "commands/model/parts_of_model.hpp"
#include "solver/fields/integrals/plane_section.hpp"
#include "solver/mesh/place.hpp"

namespace comma::commands {

namespace {

using interpreter::Keywords;
using solver::AreaMoments;
using solver::PlaneSection;

// The axes of the mesh, X and Y, are called Y and Z in a section.
void add_moments(Row& row, const AreaMoments& moments, const std::string& ending) {
  row.insert(row.end(),
             {{"IY_" + ending, moments.first}, {"IZ_" + ending, moments.second}, {"IYZ_" + ending, moments.product}});
}

void add_section(Row& row, const PlaneSection& section, const std::string& ending) {
  row.insert(
      row.end(),
      {{"A" + ending, section.area}, {"CDG_Y" + ending, section.centre[0]}, {"CDG_Z" + ending, section.centre[1]}});
  add_moments(row, section.moments, "G" + ending);
}

// How far the nodes go from the centre, along its principal axes.
void add_extent(Row& row, const Keywords& occurrence, const solver::Mesh& mesh, const std::vector<int>& cells,
                const PlaneSection& section, double angle) {
  const Eigen::Rotation2Dd back(-angle);
  Eigen::AlignedBox2d extent;
  double farthest = 0.0;
  for (const int node : mesh.nodes_of_cells(cells)) {
    const Eigen::Vector2d at = solver::place(mesh, node).head<2>();
    for (const double sx : {1.0, -1.0})
      for (const double sy : {1.0, -1.0}) {
        if ((sx < 0.0 && !occurrence.has("SYME_Y")) || (sy < 0.0 && !occurrence.has("SYME_X"))) continue;
        const Eigen::Vector2d arm = Eigen::Vector2d(sx * at[0], sy * at[1]) - section.centre;
        extent.extend(back * arm);
        farthest = std::max(farthest, arm.norm());
      }
  }
  row.insert(row.end(), {{"Y_MAX", extent.max()[0]},
                         {"Z_MAX", extent.max()[1]},
                         {"Y_MIN", extent.min()[0]},
                         {"Z_MIN", extent.min()[1]},
                         {"R_MAX", farthest}});
}

Row row_of_section(const Keywords& occurrence, const solver::Model& model, const Part& part) {
  Row row = place_columns(part);
  const PlaneSection meshed = solver::plane_section(model, part.cells);
  PlaneSection whole = meshed;
  if (occurrence.has("SYME_X")) whole = solver::with_image(whole, true);
  if (occurrence.has("SYME_Y")) whole = solver::with_image(whole, false);
  const solver::PrincipalMoments principal = solver::principal_moments(whole.moments);
  add_section(row, meshed, "_M");
  add_extent(row, occurrence, *model.mesh, part.cells, whole, principal.angle);
  add_section(row, whole, "");
  row.insert(row.end(), {{"IY", principal.least}, {"IZ", principal.greatest}, {"ALPHA", principal.angle / degree}});
  Eigen::Vector2d origin = whole.centre;
  if (occurrence.has("ORIG_INER")) {
    const auto given = occurrence.reals("ORIG_INER");
    origin = {given[0], given[1]};
  }
  row.insert(row.end(), {{"Y_P", origin[0]}, {"Z_P", origin[1]}});
  add_moments(row, solver::moments_about(whole, origin), "P");
  return row;
}

}  // namespace

void list_sections(Table& table, const interpreter::Call& call) {
  const solver::Model& model = *call.data<ModelConcept>("MODELE").model;
  for (const Keywords& occurrence : call.factors("CARA_GEOM"))
    for (const Part& part : parts_of(call, occurrence, *model.mesh))
      table.add_row(row_of_section(occurrence, model, part));
}

}  // namespace comma::commands
