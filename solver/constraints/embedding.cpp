#include "solver/constraints/embedding.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "solver/contact/projection.hpp"
#include "solver/elements/cell_quadrature.hpp"
#include "solver/error.hpp"
#include "solver/mesh/box_tree.hpp"
#include "solver/mesh/conversion.hpp"
#include "solver/mesh/place.hpp"

namespace comma::solver {

namespace {

/// A shape function's value this small at a host's node is rounding: the point lies on the opposite facet.
constexpr double negligible_weight = 1e-12;
/// Reference coordinates are of order one; Newton's last step doubles the digits.
constexpr double embedding_tolerance = 1e-8;
constexpr double far_outside_cell = 1e3;
constexpr int most_embedding_iterations = 30;
/// How far outside the reference cell, as a share of its extent, a point still counts as inside.
constexpr double inside_tolerance = 1e-10;
/// How far outside a cell that is chosen by its corners a point still has a place of its own in it, as a share of the
/// reference cell (17.3: QUAD8 between 0.00997 and 0.01005, TRIA6 between 0.00995 and 0.01005; QUAD4 between 0.009 and
/// 0.011).
constexpr double beside_tolerance = 0.01;
/// Distances to cells that differ by less of what all cells extend over are equal.
constexpr double same_distance = 1e-12;

/// `share` of its extent: the reference cell goes from -1 to 1 or from 0 to 1.
bool is_inside(CellType type, const ReferencePoint& at, double share) {
  const auto [x, y, z] = at;
  const double s = share, t = 2.0 * share;
  const int corners = corner_count(type);
  if (dimension(type) == 1) return std::abs(x) <= 1.0 + t;
  if (dimension(type) == 2 && corners == 3) return x >= -s && y >= -s && x + y <= 1.0 + s;
  if (dimension(type) == 2) return std::abs(x) <= 1.0 + t && std::abs(y) <= 1.0 + t;
  switch (corners) {
    case 4:
      return x >= -s && y >= -s && z >= -s && x + y + z <= 1.0 + s;  // tetrahedron
    case 5:
      return z >= -s && std::abs(x) + std::abs(y) <= 1.0 - z + t;  // pyramid
    case 6:
      return std::abs(x) <= 1.0 + t && y >= -s && z >= -s && y + z <= 1.0 + s;  // pentahedron
    default:
      return std::abs(x) <= 1.0 + t && std::abs(y) <= 1.0 + t && std::abs(z) <= 1.0 + t;  // hexahedron
  }
}

std::vector<double> weights_at(CellType type, const ReferencePoint& at) {
  const Eigen::VectorXd weights = shape_functions(type, at);
  return {weights.begin(), weights.end()};
}

/// Where a point of space lies in the reference cell, from a place that is near; nothing where the mapping has no
/// inverse there.
std::optional<ReferencePoint> reference_place(const Mesh& mesh, int cell, const Eigen::Vector3d& point,
                                              ReferencePoint at) {
  const CellType type = mesh.cell_types[cell];
  const int directions = dimension(type);
  for (int iteration = 0; iteration < most_embedding_iterations; ++iteration) {
    const CellPoint here = locate(mesh, cell, {1.0, shape_functions(type, at), shape_derivatives(type, at)});
    const Eigen::Vector3d miss = point - here.at;
    const Eigen::VectorXd step = directions == 3 ? Eigen::VectorXd(here.tangents.partialPivLu().solve(miss))
                                                 : here.tangents.leftCols(directions).colPivHouseholderQr().solve(miss);
    if (!step.allFinite() || step.norm() > far_outside_cell) return std::nullopt;
    for (int c = 0; c < directions; ++c) at[c] += step[c];
    if (step.norm() <= embedding_tolerance) return at;
  }
  return std::nullopt;
}

/// The shape functions of a solid at a point of space inside it; empty if it lies outside.
std::optional<std::vector<double>> weights_inside(const Mesh& mesh, int cell, const Eigen::Vector3d& point) {
  const CellType type = mesh.cell_types[cell];
  ReferencePoint middle{};
  const auto nodes = reference_nodes(type).first(static_cast<std::size_t>(corner_count(type)));
  for (const ReferencePoint& node : nodes) {
    for (int c = 0; c < 3; ++c) middle[c] += node[c] / static_cast<double>(nodes.size());
  }
  const auto at = reference_place(mesh, cell, point, middle);
  return at && is_inside(type, *at, inside_tolerance) ? std::optional(weights_at(type, *at)) : std::nullopt;
}

/// A node at the place that it is brought to.
struct Guest {
  int node;
  Eigen::Vector3d at;
};

/// The nearest point of a facet of the cell: its orthogonal foot, or where that lies outside of a face one of an edge.
Embedding on_facet(const Mesh& mesh, const Guest& guest, int cell, CellType type, std::span<const int> local) {
  std::vector<Eigen::Vector3d> points;
  for (const int a : local) points.push_back(place(mesh, mesh.cell(cell)[a]));
  Embedding result{guest.node, cell, std::vector<double>(mesh.cell(cell).size(), 0.0),
                   std::numeric_limits<double>::infinity()};
  const auto foot = project_exactly(guest.at, type, points);
  if (foot && (dimension(type) == 1 || foot->outside <= inside_tolerance)) {
    result.distance = foot->distance;
    for (std::size_t a = 0; a < local.size(); ++a) result.weights[local[a]] = foot->weights[a];
    return result;
  }
  if (dimension(type) == 1) return result;
  for (const BoundaryFacet& edge : boundary_facets(type)) {
    std::vector<int> ends;
    for (int a = 0; a < node_count(edge.type); ++a) ends.push_back(local[static_cast<std::size_t>(edge.nodes[a])]);
    Embedding here = on_facet(mesh, guest, cell, edge.type, ends);
    if (here.distance < result.distance) result = std::move(here);
  }
  return result;
}

Embedding on_cell(const Mesh& mesh, const Guest& guest, int cell) {
  const CellType type = mesh.cell_types[cell];
  if (dimension(type) < 3) {
    std::vector<int> local(mesh.cell(cell).size());
    for (std::size_t a = 0; a < local.size(); ++a) local[a] = static_cast<int>(a);
    return on_facet(mesh, guest, cell, type, local);
  }
  if (auto weights = weights_inside(mesh, cell, guest.at)) return {guest.node, cell, std::move(*weights), 0.0};
  Embedding best{guest.node, cell, {}, std::numeric_limits<double>::infinity()};
  for (const BoundaryFacet& facet : boundary_facets(type)) {
    const std::vector<int> local(facet.nodes.begin(), facet.nodes.begin() + node_count(facet.type));
    Embedding here = on_facet(mesh, guest, cell, facet.type, local);
    if (here.distance < best.distance) best = std::move(here);
  }
  return best;
}

std::vector<Box> boxes_of(const Mesh& mesh, std::span<const int> cells) {
  std::vector<Box> boxes;
  for (const int cell : cells) {
    Box& box = boxes.emplace_back();
    for (const int node : mesh.cell(cell)) box.extend(place(mesh, node));
  }
  return boxes;
}

/// The cells that the corners make, as cells 0, 1 ... on the same nodes.
Mesh straight_cells(const Mesh& mesh, std::span<const int> cells) {
  Mesh straight;
  straight.dimension = mesh.dimension;
  straight.nodes = mesh.nodes;
  for (const int cell : cells) {
    const CellType type = mesh.cell_types[cell];
    straight.add_cell(straight_type(type), mesh.cell(cell).first(static_cast<std::size_t>(corner_count(type))));
  }
  return straight;
}

/// Where the weights of the corners put a place in the reference cell.
ReferencePoint straight_place(CellType type, std::span<const double> weights) {
  ReferencePoint at{};
  const auto corners = reference_nodes(type).first(weights.size());
  for (std::size_t a = 0; a < corners.size(); ++a)
    for (int c = 0; c < 3; ++c) at[c] += weights[a] * corners[a][c];
  return at;
}

/// The weights of all nodes of a cell whose corners have those of `host`: at the point itself where it lies in the cell
/// or nearly so, else where the corners put the nearest place in the reference cell, and so on lines and on surfaces in
/// space.
std::vector<double> whole_weights(const Mesh& mesh, int cell, const Eigen::Vector3d& point, const Embedding& host) {
  const CellType type = mesh.cell_types[cell];
  const ReferencePoint near = straight_place(type, host.weights);
  if (dimension(type) < mesh.dimension) return weights_at(type, near);
  const auto found = reference_place(mesh, cell, point, near);
  return weights_at(type, found && is_inside(type, *found, beside_tolerance) ? *found : near);
}

/// The hosts among straight cells; `cell` is -1 where none is within `farthest`.
std::vector<Embedding> straight_hosts(const Mesh& straight, std::span<const Guest> guests, double farthest) {
  std::vector<int> cells(static_cast<std::size_t>(straight.cell_count()));
  std::iota(cells.begin(), cells.end(), 0);
  const std::vector<Box> boxes = boxes_of(straight, cells);
  Box all;
  for (const Box& box : boxes) all.extend(box);
  const double same = boxes.empty() ? 0.0 : same_distance * all.diagonal().norm();
  const BoxTree tree(boxes);
  std::vector<Embedding> result;
  for (const Guest& guest : guests) {
    Embedding best{guest.node, -1, {}, std::numeric_limits<double>::infinity()};
    tree.search(guest.at, [&](int cell) {
      Embedding here = on_cell(straight, guest, cell);
      const double least = std::min(best.distance, here.distance);
      const bool is_near = here.distance <= least + same;
      if (is_near && (cell < best.cell || best.distance > least + same)) best = std::move(here);
      return least + same;
    });
    if (!(best.distance <= farthest)) best.cell = -1;
    result.push_back(std::move(best));
  }
  return result;
}

/// The hosts of all, with the weights of whole cells.
std::vector<Embedding> hosts_within(const Mesh& mesh, std::span<const Guest> guests, std::span<const int> cells,
                                    double farthest) {
  std::vector<int> rising(cells.begin(), cells.end());
  std::ranges::sort(rising);
  const Mesh straight = straight_cells(mesh, rising);
  auto hosts = straight_hosts(straight, guests, farthest);
  for (std::size_t i = 0; i < hosts.size(); ++i) {
    Embedding& host = hosts[i];
    if (host.cell < 0) continue;
    const int own = rising[static_cast<std::size_t>(host.cell)];
    if (host.distance > 0.0 || straight.cell_types[host.cell] != mesh.cell_types[own])
      host.weights = whole_weights(mesh, own, guests[i].at, host);
    host.cell = own;
  }
  return hosts;
}

std::vector<Embedding> nearest_hosts(const Mesh& mesh, std::span<const Guest> guests, std::span<const int> cells,
                                     double farthest) {
  auto result = hosts_within(mesh, guests, cells, farthest);
  for (const Embedding& embedding : result)
    if (embedding.cell < 0)
      throw Error("no-host", fmt::format("node {} is tied to no cell: the nearest is at {:.6g}",
                                         mesh.node_name(embedding.node), embedding.distance));
  return result;
}

}  // namespace

std::vector<Embedding> embed(const Mesh& mesh, std::span<const int> nodes, std::span<const int> cells,
                             double farthest) {
  std::set<int> known;
  for (const int cell : cells) known.insert(mesh.cell(cell).begin(), mesh.cell(cell).end());
  std::vector<Guest> guests;
  for (const int node : nodes)
    if (known.insert(node).second) guests.push_back({node, place(mesh, node)});
  return nearest_hosts(mesh, guests, cells, farthest);
}

std::vector<Embedding> embed_moved(const Mesh& mesh, std::span<const int> nodes, std::span<const int> cells,
                                   const Placement& placement, double farthest) {
  std::set<int> known;
  std::vector<Guest> guests;
  for (const int node : nodes)
    if (known.insert(node).second) guests.push_back({node, placement(place(mesh, node))});
  return nearest_hosts(mesh, guests, cells, farthest);
}

std::vector<Embedding> embed_places(const Mesh& mesh, std::span<const Eigen::Vector3d> places,
                                    std::span<const int> cells, double farthest) {
  std::vector<Guest> guests;
  for (const Eigen::Vector3d& at : places) guests.push_back({static_cast<int>(guests.size()), at});
  return hosts_within(mesh, guests, cells, farthest);
}

namespace {

/// From the nearest place of the host to the node.
Eigen::Vector3d arm_of(const Mesh& mesh, const Embedding& embedding) {
  Eigen::Vector3d arm = place(mesh, embedding.node);
  const auto host = mesh.cell(embedding.cell);
  for (std::size_t a = 0; a < host.size(); ++a) arm -= embedding.weights[a] * place(mesh, host[a]);
  return arm;
}

/// The terms of one component: those of rotations are what they do at the end of the arm.
LinearRelation shell_relation(const Mesh& mesh, const Embedding& embedding, int c, const Eigen::Vector3d& arm,
                              const Origin& origin) {
  LinearRelation relation{{{embedding.node, static_cast<Component>(c), 1.0}}, 0.0, {}, origin};
  const auto host = mesh.cell(embedding.cell);
  for (std::size_t a = 0; a < host.size(); ++a) {
    const double weight = embedding.weights[a];
    if (std::abs(weight) <= negligible_weight) continue;
    relation.terms.push_back({host[a], static_cast<Component>(c), -weight});
    for (int k = 0; c < 3 && k < 3; ++k) {
      const double turned = Eigen::Vector3d::Unit(k).cross(arm)[c];
      if (std::abs(turned) > negligible_weight * arm.norm())
        relation.terms.push_back({host[a], static_cast<Component>(3 + k), -weight * turned});
    }
  }
  return relation;
}

/// A relation for each component that a node carries.
template <class RelationOf>
std::vector<LinearRelation> relations_to_shells(const Mesh& mesh, const DofMap& dofs,
                                                std::span<const Embedding> embeddings, RelationOf&& relation_of) {
  std::vector<LinearRelation> relations;
  for (const Embedding& embedding : embeddings) {
    if (dofs.dof(mesh.cell(embedding.cell)[0], Component::drx) < 0)
      throw Error("unknown-dof",
                  fmt::format("cell {} is to hold nodes as a shell does, but its nodes have no rotations",
                              mesh.cell_name(embedding.cell)));
    for (int c = 0; c < 6; ++c)
      if (dofs.dof(embedding.node, static_cast<Component>(c)) >= 0) relations.push_back(relation_of(embedding, c));
  }
  return relations;
}

}  // namespace

std::vector<LinearRelation> shell_embedding_relations(const Mesh& mesh, const DofMap& dofs,
                                                      std::span<const Embedding> embeddings, const Origin& origin) {
  return relations_to_shells(mesh, dofs, embeddings, [&](const Embedding& embedding, int c) {
    return shell_relation(mesh, embedding, c, arm_of(mesh, embedding), origin);
  });
}

std::vector<LinearRelation> shell_joint_relations(const Mesh& mesh, const DofMap& dofs,
                                                  std::span<const Embedding> embeddings, const Origin& origin) {
  return relations_to_shells(mesh, dofs, embeddings, [&](const Embedding& embedding, int c) {
    return shell_relation(mesh, embedding, c, Eigen::Vector3d::Zero(), origin);
  });
}

namespace {

/// direction . u of a node equals that of the place where it is tied, along the direction turned.
LinearRelation relation_along(const Mesh& mesh, const Embedding& embedding, const Eigen::Vector3d& direction,
                              const Eigen::Vector3d& turned, const Origin& origin) {
  LinearRelation relation{{}, 0.0, {}, origin};
  for (int c = 0; c < 3; ++c)
    if (std::abs(direction[c]) > negligible_weight)
      relation.terms.push_back({embedding.node, static_cast<Component>(c), direction[c]});
  const auto host = mesh.cell(embedding.cell);
  for (std::size_t a = 0; a < host.size(); ++a)
    for (int c = 0; c < 3; ++c)
      if (const double factor = embedding.weights[a] * turned[c]; std::abs(factor) > negligible_weight)
        relation.terms.push_back({host[a], static_cast<Component>(c), -factor});
  return relation;
}

}  // namespace

std::vector<LinearRelation> embedding_relations(const Mesh& mesh, const DofMap& dofs,
                                                std::span<const Embedding> embeddings, const Origin& origin,
                                                const Eigen::Matrix3d& rotation) {
  std::vector<LinearRelation> relations;
  for (const Embedding& embedding : embeddings)
    for (int c = 0; c < 3; ++c)
      if (dofs.dof(embedding.node, static_cast<Component>(c)) >= 0)
        relations.push_back(relation_along(mesh, embedding, Eigen::Vector3d::Unit(c), rotation.col(c), origin));
  return relations;
}

std::vector<LinearRelation> normal_embedding_relations(const Mesh& mesh, const DofMap& dofs,
                                                       std::span<const Embedding> embeddings,
                                                       const std::map<int, Eigen::Vector3d>& normals,
                                                       const Origin& origin, const Eigen::Matrix3d& rotation) {
  std::vector<LinearRelation> relations;
  for (const Embedding& embedding : embeddings) {
    const auto normal = normals.find(embedding.node);
    if (normal == normals.end())
      throw Error("no-normal", fmt::format("node {} has no normal", mesh.node_name(embedding.node)),
                  "name the faces or edges on which it lies");
    for (int c = 0; c < 3; ++c) {
      const auto component = static_cast<Component>(c);
      if (std::abs(normal->second[c]) <= negligible_weight || dofs.dof(embedding.node, component) >= 0) continue;
      throw Error("unknown-dof",
                  fmt::format("the normal of node {} has a part along {}, which the node does not carry",
                              mesh.node_name(embedding.node), name_of(component)),
                  "name the edges of plane bodies, and the faces of solids");
    }
    relations.push_back(relation_along(mesh, embedding, normal->second, rotation * normal->second, origin));
  }
  return relations;
}

namespace {

/// Adds factor . u at the place of the host.
void add_place(const Mesh& mesh, const Embedding& host, const Eigen::Vector3d& factor, LinearRelation& relation) {
  const auto nodes = mesh.cell(host.cell);
  for (std::size_t a = 0; a < nodes.size(); ++a)
    for (int c = 0; c < 3; ++c)
      if (const double term = host.weights[a] * factor[c]; std::abs(term) > negligible_weight)
        relation.terms.push_back({nodes[a], static_cast<Component>(c), term});
}

/// The rotation about a direction across the normal is that of the fibre.
LinearRelation fibre_rotation(const Mesh& mesh, int node, std::span<const Embedding> ends,
                              const Eigen::Vector3d& normal, const Eigen::Vector3d& about, double thickness,
                              const Origin& origin) {
  LinearRelation relation{{}, 0.0, {}, origin};
  for (int c = 0; c < 3; ++c)
    if (std::abs(about[c]) > negligible_weight)
      relation.terms.push_back({node, static_cast<Component>(3 + c), about[c]});
  const Eigen::Vector3d along = about.cross(normal) / thickness;
  add_place(mesh, ends[0], along, relation);
  add_place(mesh, ends[1], -along, relation);
  return relation;
}

}  // namespace

std::vector<LinearRelation> fibre_relations(const Mesh& mesh, const DofMap& dofs, std::span<const int> nodes,
                                            std::span<const int> cells, const std::map<int, Eigen::Vector3d>& normals,
                                            double thickness, double farthest, const Origin& origin) {
  std::vector<LinearRelation> relations = embedding_relations(
      mesh, dofs, embed_moved(mesh, nodes, cells, Placement(), farthest), origin, Eigen::Matrix3d::Identity());
  for (const int node : nodes) {
    const auto found = normals.find(node);
    if (found == normals.end())
      throw Error("no-normal", fmt::format("the field of normals has none at node {}", mesh.node_name(node)));
    if (dofs.dof(node, Component::drx) < 0)
      throw Error("unknown-dof", fmt::format("node {} has no rotations, as nodes of shells do", mesh.node_name(node)));
    const Eigen::Vector3d normal = unit(found->second);
    const std::array<Eigen::Vector3d, 2> at = {place(mesh, node) - 0.5 * thickness * normal,
                                               place(mesh, node) + 0.5 * thickness * normal};
    const auto ends = embed_places(mesh, at, cells, std::numeric_limits<double>::infinity());
    const Eigen::Vector3d first = normal.unitOrthogonal();
    for (const Eigen::Vector3d& about : {first, Eigen::Vector3d(normal.cross(first))})
      relations.push_back(fibre_rotation(mesh, node, ends, normal, about, thickness, origin));
  }
  return relations;
}

}  // namespace comma::solver
