// Relations between the nodes of two sets that face each other.
#pragma once

#include <limits>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Dense>

#include "solver/loads/load.hpp"
#include "solver/mesh/mesh.hpp"
#include "solver/mesh/placement.hpp"

namespace comma::solver {

struct NodePair {
  int first;
  int second;
};

/// Pairs each node of the first set, once moved by `placement`, with the nearest of the second; the order is that of
/// the first set. Throws Error `no-facing-nodes` for sets of different size (nodes given twice count once), for a node
/// whose nearest one is already another's, and for one further than `farthest` from it.
std::vector<NodePair> facing_nodes(const Mesh& mesh, std::span<const int> first, std::span<const int> second,
                                   const Placement& placement = {},
                                   double farthest = std::numeric_limits<double>::infinity());

/// One term of a relation, at each pair: coefficient times a component, or times the displacement along the node's
/// normal.
struct FacingTerm {
  std::optional<Component> component;  ///< empty: along the normal
  double coefficient = 1.0;
};

/// For each pair: the terms at its first node plus those at its second equal `value` (or the function, at the first
/// node). Each side has its own normals, which point away from each other where two skins face: u1.n1 + u2.n2 = 0 lets
/// neither open nor close. `first_normals` and `second_normals` are looked into only where a term asks for them; Error
/// `no-normal` names a node without.
std::vector<LinearRelation> facing_relations(const Mesh& mesh, std::span<const NodePair> pairs,
                                             std::span<const FacingTerm> first, std::span<const FacingTerm> second,
                                             const std::map<int, Eigen::Vector3d>& first_normals,
                                             const std::map<int, Eigen::Vector3d>& second_normals, double value,
                                             const FieldFunction& function, const Origin& origin);

}  // namespace comma::solver
