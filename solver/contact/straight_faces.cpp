#include "solver/contact/straight_faces.hpp"

#include <array>
#include <memory>
#include <set>
#include <string>

namespace comma::solver {

namespace {

constexpr int corners = 4;

void tie_edges(const Mesh& mesh, const DofMap& dofs, int cell, const Origin& origin, std::set<int>& tied,
               std::vector<LinearRelation>& relations) {
  const auto nodes = mesh.cell(cell);
  for (int edge = 0; edge < corners; ++edge) {
    const int middle = nodes[static_cast<std::size_t>(corners + edge)];
    if (!tied.insert(middle).second) continue;
    const int first = nodes[static_cast<std::size_t>(edge)],
              second = nodes[static_cast<std::size_t>((edge + 1) % corners)];
    for (const Component component : {Component::dx, Component::dy, Component::dz}) {
      if (dofs.dof(middle, component) < 0) continue;
      relations.push_back(
          {{{middle, component, 1.0}, {first, component, -0.5}, {second, component, -0.5}}, 0.0, {}, origin});
    }
  }
}

}  // namespace

std::vector<int> contact_nodes(const Mesh& mesh, const ContactZone& zone) {
  std::set<int> nodes;
  for (const int cell : zone.slave_cells) {
    const auto all = mesh.cell(cell);
    const auto taken = zone.resolved && mesh.cell_types[cell] == CellType::quad8 ? all.first(corners) : all;
    nodes.insert(taken.begin(), taken.end());
  }
  return {nodes.begin(), nodes.end()};
}

std::vector<LinearRelation> straight_edges(const Mesh& mesh, const DofMap& dofs, const ContactDefinition& contact) {
  const auto origin = std::make_shared<const std::string>("the straight edges of contact faces with eight nodes");
  std::set<int> tied;
  std::vector<LinearRelation> relations;
  for (const ContactZone& zone : contact.zones) {
    if (!zone.resolved) continue;
    for (const auto* cells : {&zone.master_cells, &zone.slave_cells}) {
      for (const int cell : *cells) {
        if (mesh.cell_types[cell] == CellType::quad8) tie_edges(mesh, dofs, cell, origin, tied, relations);
      }
    }
  }
  return relations;
}

}  // namespace comma::solver
