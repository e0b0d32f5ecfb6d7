#include "solver/constraints/facing_nodes.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "solver/error.hpp"
#include "solver/mesh/nearest_node.hpp"
#include "solver/mesh/place.hpp"

namespace comma::solver {

namespace {

std::vector<int> each_once(std::span<const int> nodes) {
  std::vector<int> result;
  std::map<int, bool> known;
  for (const int node : nodes) {
    if (known.try_emplace(node, true).second) result.push_back(node);
  }
  return result;
}

void add_terms(const Mesh& mesh, int node, std::span<const FacingTerm> terms,
               const std::map<int, Eigen::Vector3d>& normals, LinearRelation& relation) {
  for (const FacingTerm& term : terms) {
    if (term.component) {
      relation.terms.push_back({node, *term.component, term.coefficient});
      continue;
    }
    const auto found = normals.find(node);
    if (found == normals.end()) {
      throw Error("no-normal",
                  fmt::format("node {} has no normal: it is on none of the skin cells given", mesh.node_name(node)));
    }
    for (int c = 0; c < 3; ++c) {
      if (found->second[c] != 0.0)
        relation.terms.push_back({node, static_cast<Component>(c), term.coefficient * found->second[c]});
    }
  }
}

}  // namespace

std::vector<NodePair> facing_nodes(const Mesh& mesh, std::span<const int> first, std::span<const int> second,
                                   const Placement& placement, double farthest) {
  const std::vector<int> from = each_once(first);
  const std::vector<int> to = each_once(second);
  if (from.size() != to.size()) {
    throw Error("no-facing-nodes", fmt::format("{} nodes are to face {}", from.size(), to.size()),
                "leave out the nodes that have none opposite");
  }
  std::vector<NodePair> pairs;
  if (from.empty()) return pairs;
  const NearestNode nearest(mesh, to);
  std::map<int, int> taken;
  for (const int node : from) {
    const Eigen::Vector3d moved = placement(place(mesh, node));
    const int opposite = nearest(moved);
    const auto [owner, is_free] = taken.try_emplace(opposite, node);
    if (!is_free) {
      throw Error("no-facing-nodes",
                  fmt::format("nodes {} and {} both have node {} as the nearest one opposite",
                              mesh.node_name(owner->second), mesh.node_name(node), mesh.node_name(opposite)));
    }
    const double distance = (place(mesh, opposite) - moved).norm();
    if (distance > farthest) {
      throw Error("no-facing-nodes", fmt::format("the node nearest to {} is {}, at {:.6g}", mesh.node_name(node),
                                                 mesh.node_name(opposite), distance));
    }
    pairs.push_back({node, opposite});
  }
  return pairs;
}

std::vector<LinearRelation> facing_relations(const Mesh& mesh, std::span<const NodePair> pairs,
                                             std::span<const FacingTerm> first, std::span<const FacingTerm> second,
                                             const std::map<int, Eigen::Vector3d>& first_normals,
                                             const std::map<int, Eigen::Vector3d>& second_normals, double value,
                                             const FieldFunction& function, const Origin& origin) {
  std::vector<LinearRelation> relations;
  for (const NodePair& pair : pairs) {
    LinearRelation relation{{}, value, function, origin};
    add_terms(mesh, pair.first, first, first_normals, relation);
    add_terms(mesh, pair.second, second, second_normals, relation);
    relations.push_back(std::move(relation));
  }
  return relations;
}

}  // namespace comma::solver
