#include "solver/contact/straight_faces.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <set>
#include <string>

namespace comma::solver {

namespace {

using Eigen::Vector3d;

constexpr int corners = 4;

/// Of the QUAD8 faces: `visit` the middle node of each edge and its ends.
template <typename Visit>
void for_each_edge(const Mesh& mesh, std::span<const int> cells, const Visit& visit) {
  for (const int cell : cells) {
    if (mesh.cell_types[static_cast<std::size_t>(cell)] != CellType::quad8) continue;
    const auto nodes = mesh.cell(cell);
    for (std::size_t edge = 0; edge < corners; ++edge)
      visit(nodes[corners + edge], nodes[edge], nodes[(edge + 1) % corners]);
  }
}

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

bool has_tied_edges(const ContactZone& zone) { return zone.resolved && !zone.mixed.bilateral && !zone.mixed.penalised; }

std::vector<int> contact_nodes(const Mesh& mesh, const ContactZone& zone) {
  std::set<int> nodes;
  for (const int cell : zone.slave_cells) {
    const auto all = mesh.cell(cell);
    const auto taken = has_tied_edges(zone) && mesh.cell_types[cell] == CellType::quad8 ? all.first(corners) : all;
    nodes.insert(taken.begin(), taken.end());
  }
  return {nodes.begin(), nodes.end()};
}

bool has_straight_faces(const Mesh& mesh, const ContactZone& zone) {
  const auto is_straight = [&](int cell) { return mesh.cell_types[static_cast<std::size_t>(cell)] == CellType::quad8; };
  return std::ranges::any_of(zone.master_cells, is_straight) || std::ranges::any_of(zone.slave_cells, is_straight);
}

std::vector<Vector3d> straight_positions(const Mesh& mesh, const ContactZone& zone,
                                         std::span<const Vector3d> positions) {
  std::vector<Vector3d> straight(positions.begin(), positions.end());
  for (const auto* cells : {&zone.master_cells, &zone.slave_cells})
    for_each_edge(mesh, *cells, [&](int middle, int first, int second) {
      straight[static_cast<std::size_t>(middle)] =
          0.5 * (positions[static_cast<std::size_t>(first)] + positions[static_cast<std::size_t>(second)]);
    });
  return straight;
}

void straighten(const Mesh& mesh, std::span<const int> cells, std::unordered_map<int, Vector3d>& normals) {
  for_each_edge(mesh, cells, [&](int middle, int first, int second) {
    normals.at(middle) = 0.5 * (normals.at(first) + normals.at(second));
  });
}

void take_corners(CellType type, std::span<double> weights) {
  if (type != CellType::quad8) return;
  for (std::size_t edge = 0; edge < corners; ++edge) {
    const double half = 0.5 * weights[corners + edge];
    weights[edge] += half;
    weights[(edge + 1) % corners] += half;
    weights[corners + edge] = 0.0;
  }
}

std::vector<LinearRelation> straight_edges(const Mesh& mesh, const DofMap& dofs, const ContactDefinition& contact) {
  const auto origin = std::make_shared<const std::string>("the straight edges of contact faces with eight nodes");
  std::set<int> tied;
  std::vector<LinearRelation> relations;
  for (const ContactZone& zone : contact.zones) {
    if (!has_tied_edges(zone)) continue;
    for (const auto* cells : {&zone.master_cells, &zone.slave_cells}) {
      for (const int cell : *cells) {
        if (mesh.cell_types[cell] == CellType::quad8) tie_edges(mesh, dofs, cell, origin, tied, relations);
      }
    }
  }
  return relations;
}

}  // namespace comma::solver
