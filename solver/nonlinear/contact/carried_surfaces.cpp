#include "solver/nonlinear/contact/carried_surfaces.hpp"

#include <vector>

#include <fmt/format.h>

#include "solver/error.hpp"

namespace comma::solver {
namespace {

/// Nodes of elements with stiffness, and those that a condition moves.
std::vector<bool> carried_nodes(const StaticProblem& problem) {
  const Model& model = *problem.model;
  std::vector<bool> carried(static_cast<std::size_t>(model.mesh->node_count()), false);
  for (int cell = 0; cell < model.mesh->cell_count(); ++cell) {
    if (model.components_of(cell) == 0 || model.is_skin(cell)) continue;
    for (const int node : model.mesh->cell(cell)) carried[static_cast<std::size_t>(node)] = true;
  }
  for (const auto* loads : {&problem.loads, &problem.driven})
    for (const AppliedLoad& each : *loads)
      for (const LinearRelation& relation : each.load->relations)
        for (const LinearRelation::Term& term : relation.terms) carried[static_cast<std::size_t>(term.node)] = true;
  for (const RigidLink& link : problem.turning_links)
    for (const int node : link.nodes) carried[static_cast<std::size_t>(node)] = true;
  return carried;
}

}  // namespace

void require_carried_surfaces(const StaticProblem& problem) {
  if (!problem.contact) return;
  const Model& model = *problem.model;
  const std::vector<bool> carried = carried_nodes(problem);
  for (const ContactZone& zone : problem.contact->zones) {
    for (const auto* cells : {&zone.master_cells, &zone.slave_cells}) {
      for (const int cell : *cells) {
        if (model.components_of(cell) == 0) continue;  // that it has no unknowns is told where they are looked for
        for (const int node : model.mesh->cell(cell)) {
          if (carried[static_cast<std::size_t>(node)]) continue;
          throw Error("floating-surface",
                      fmt::format("{} is a {} surface of contact, and nothing carries it: its node {} belongs to no "
                                  "element with stiffness, and no condition moves it",
                                  model.mesh->cell_name(cell), cells == &zone.master_cells ? "master" : "slave",
                                  model.mesh->node_name(node)),
                      "leave the cell out of the surface (DEFI_GROUP), give what is behind it an element "
                      "(AFFE_MODELE), or impose its motion where it is rigid");
        }
      }
    }
  }
}

}  // namespace comma::solver
