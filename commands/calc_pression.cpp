#include <array>
#include <cmath>

#include "commands/analysis/problem_building.hpp"
#include "commands/analysis/result_reading.hpp"
#include "commands/analysis/same_mesh.hpp"
#include "commands/commands.hpp"
#include "commands/selection.hpp"
#include "solver/fields/field_computation.hpp"
#include "solver/fields/stresses/boundary_pressure.hpp"
#include "solver/mesh/place.hpp"

namespace comma::commands {

namespace {

// GEOMETRIE: as the mesh is, or moved by the displacements of the step.
std::vector<Eigen::Vector3d> positions_at(const Call& call, const solver::Mesh& mesh, const solver::ResultStep& step) {
  std::vector<Eigen::Vector3d> positions = solver::places(mesh);
  if (call.text("GEOMETRIE") == "INITIALE") return positions;
  const auto found = step.fields.find("DEPL");
  if (found == step.fields.end()) return positions;
  const auto& displacement = std::get<solver::NodalField>(found->second);
  constexpr std::array<const char*, 3> names = {"DX", "DY", "DZ"};
  for (int axis = 0; axis < 3; ++axis) {
    const int column = displacement.component(names[static_cast<std::size_t>(axis)]);
    for (int node = 0; column >= 0 && node < mesh.node_count(); ++node) {
      const double moved = displacement.at(node, column);
      if (!std::isnan(moved)) positions[static_cast<std::size_t>(node)][axis] += moved;
    }
  }
  return positions;
}

void add_pressures(const Call& call, Context& context, ResultConcept& data) {
  FieldsOfSteps computation(call, data);
  const solver::Mesh& mesh = data.result.mesh();
  require_mesh(call, "MAILLAGE", call.data<MeshConcept>("MAILLAGE").mesh.get(), mesh);
  const auto cells = needed(selected_cells(call, mesh), call, "cell");
  warn_of_missing_instants("CALC_PRESSION", call, context.diagnostics);
  for (const solver::ResultStep* chosen : selected_steps(call, data.result)) {
    const auto index = static_cast<std::size_t>(chosen - data.result.steps.data());
    solver::ResultStep& step = data.result.steps[index];
    const solver::Field stresses = computation.compute("SIEF_NOEU", index);
    step.fields.insert_or_assign("PRES_NOEU", solver::boundary_pressure(mesh, std::get<solver::NodalField>(stresses),
                                                                        cells, positions_at(call, mesh, step)));
  }
  computation.warn_of_limited_sources(context.diagnostics);
}

}  // namespace

Product calc_pression(const Call& call, Context& context) {
  return result_with(call, [&](ResultConcept& result) { add_pressures(call, context, result); });
}

}  // namespace comma::commands
