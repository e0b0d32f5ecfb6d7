#include "commands/solve_alarms.hpp"

#include <fmt/format.h>

#include "interpreter/diagnostic.hpp"
#include "solver/elements/locking.hpp"

namespace comma::commands {

void warn_of_locking(const interpreter::Call& call, const solver::StaticProblem& problem, Context& context) {
  const auto risk = solver::find_locking(*problem.model, *problem.materials);
  if (!risk) return;
  const solver::Mesh& mesh = *problem.model->mesh;
  context.diagnostics.alarm(
      "near-incompressible",
      fmt::format("{}: NU = {} in {} fully integrated cells, {} ({}) the first: such cells lock, displacements may come out far too small",
                  call.command, risk->poisson, risk->cells, mesh.cell_name(risk->first_cell),
                  solver::name_of(mesh.cell_types[static_cast<std::size_t>(risk->first_cell)])),
      call.span, "use quadratic cells with MODELISATION='D_PLAN_SI', 'AXIS_SI' or '3D_SI', and compare two meshes");
}

void warn_of_indefinite_stiffness(const interpreter::Call& call, const solver::Counters& counters_before, Context& context) {
  if (context.counters.indefinite_factorisations == counters_before.indefinite_factorisations) return;
  context.diagnostics.alarm(
      "indefinite-stiffness",
      fmt::format("{}: the stiffness is not positive definite: some motion gives energy instead of taking it, and the solution may be "
                  "far from that of the body",
                  call.command),
      call.span, "look for springs of negative stiffness; curved TETRA10 with NU near 0.5 need MODELISATION='3D_SI'");
}

}  // namespace comma::commands
