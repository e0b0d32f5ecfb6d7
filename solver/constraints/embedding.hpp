// Nodes that move with the cell in or on which they lie.
#pragma once

#include <limits>
#include <map>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "solver/loads/load.hpp"
#include "solver/mesh/placement.hpp"
#include "solver/model/model.hpp"

namespace comma::solver {

/// Where a node is tied to a cell.
struct Embedding {
  int node;
  int cell;
  std::vector<double> weights;  ///< shape functions of the cell there, one a node
  double distance = 0.0;        ///< from the node to that point, 0 inside the cell
};

/// Each node with the nearest of the cells (edges, faces or solids) and the point of it that is nearest. As in
/// Code_Aster 17.3 nearness is that to the cells which the corners make, of equals (but for rounding) the first; the
/// weights are those of the whole cell at the node, up to a hundredth of the reference cell outside of it, and further
/// off (on lines, and on surfaces in space, whatever the distance) those where the corners put the nearest place. Nodes
/// of the cells themselves are left out: they move with them anyway. Throws Error `no-host` for a node further than
/// `farthest` from all cells.
std::vector<Embedding> embed(const Mesh& mesh, std::span<const int> nodes, std::span<const int> cells,
                             double farthest = std::numeric_limits<double>::infinity());

/// The same for the places to which nodes are brought, those of the cells included.
std::vector<Embedding> embed_moved(const Mesh& mesh, std::span<const int> nodes, std::span<const int> cells,
                                   const Placement& placement,
                                   double farthest = std::numeric_limits<double>::infinity());

/// The same for places in space, `node` being the number of the place; `cell` is -1 for one further than `farthest`
/// from all cells.
std::vector<Embedding> embed_places(const Mesh& mesh, std::span<const Eigen::Vector3d> places,
                                    std::span<const int> cells, double farthest);

/// rotation u(node) = sum of weight * u(cell's node), for each translation that the node has (U4.44.01, LIAISON_MAIL):
/// the displacement turns with the movement that brought the node to the cell.
std::vector<LinearRelation> embedding_relations(const Mesh& mesh, const DofMap& dofs,
                                                std::span<const Embedding> embeddings, const Origin& origin,
                                                const Eigen::Matrix3d& rotation = Eigen::Matrix3d::Identity());

/// The same along the normal of each node alone, which turns as well: n . u(node) = (rotation n) . sum of weight * u.
/// Throws Error `no-normal` for a node without, `unknown-dof` where the node does not carry what its normal has.
std::vector<LinearRelation> normal_embedding_relations(const Mesh& mesh, const DofMap& dofs,
                                                       std::span<const Embedding> embeddings,
                                                       const std::map<int, Eigen::Vector3d>& normals,
                                                       const Origin& origin,
                                                       const Eigen::Matrix3d& rotation = Eigen::Matrix3d::Identity());

/// The same to shells, whose points move with the rotations of their nodes: with P the place of the cell that is
/// nearest to the node M, u(M) = sum of weight * (u_i + rotation_i x PM), and rotation(M) = sum of weight * rotation_i
/// where M has rotations (TYPE_RACCORD='MASSIF_COQUE'). Throws Error `unknown-dof` for a cell whose nodes have
/// no rotations.
std::vector<LinearRelation> shell_embedding_relations(const Mesh& mesh, const DofMap& dofs,
                                                      std::span<const Embedding> embeddings, const Origin& origin);

/// Of shells to shells Code_Aster has the displacements and rotations of P for those of M, wherever M lies
/// (TYPE_RACCORD='COQUE'): the rotation of P does not move the end of the arm PM. Throws as shell_embedding_relations.
std::vector<LinearRelation> shell_joint_relations(const Mesh& mesh, const DofMap& dofs,
                                                  std::span<const Embedding> embeddings, const Origin& origin);

/// Nodes of a shell whose edge ends on or in a solid (TYPE_RACCORD='COQUE_MASSIF'): u(M) = sum of weight * u, and
/// across the normal n of the shell its rotation is that of the fibre of the solid through M, from P1 = M - thickness /
/// 2 n to P2 = M + thickness / 2 n: n x (u(P2) - u(P1)) = thickness * (rotation less its part along n). Throws Error
/// `no-normal` for a node without, `unknown-dof` for one without rotations, `no-host` as embed.
std::vector<LinearRelation> fibre_relations(const Mesh& mesh, const DofMap& dofs, std::span<const int> nodes,
                                            std::span<const int> cells, const std::map<int, Eigen::Vector3d>& normals,
                                            double thickness, double farthest, const Origin& origin);

}  // namespace comma::solver
