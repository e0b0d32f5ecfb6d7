// Displacements imposed along directions of their own: oblique axes, normals of a skin, axes of a beam.
#pragma once

#include <map>
#include <span>

#include <Eigen/Dense>

#include "solver/loads/load.hpp"
#include "solver/mesh/axes.hpp"
#include "solver/model/model.hpp"

namespace comma::solver {

enum class Motion : std::uint8_t { translation, rotation };

/// direction . u(node) = value, or its rotation about the direction (taken as a unit vector). Components that the
/// direction does not have are left out. With a function, it replaces `value`. Throws Error `zero-vector`.
LinearRelation along(int node, Motion motion, const Eigen::Vector3d& direction, double value,
                     const FieldFunction& function, const Origin& origin);

/// Axes (rows) of a beam at one of its nodes: x along the cell towards the node, y the part of `y_direction` across x,
/// z = x cross y (U4.44.01, DDL_POUTRE/VECT_Y). Throws Error `zero-vector` when that part vanishes.
Eigen::Matrix3d beam_axes(const Mesh& mesh, int cell, int node, const Eigen::Vector3d& y_direction);

/// The one bar or beam cell that ends at a node, among `candidates` or, if that is empty, all cells of the model.
/// Throws Error `ambiguous-axes` when there is none or several.
int beam_at_node(const Model& model, int node, std::span<const int> candidates = {});

/// Unit normal at each node of skin cells: the mean of the unit normals that the cells have there (U4.44.01,
/// FACE_IMPO). Edges in the plane have theirs on the right of their direction, faces by the right-hand rule. Throws
/// Error `not-a-skin` for a cell without normal (an edge in space, a solid), `degenerate-facet` where normals cancel.
std::map<int, Eigen::Vector3d> mean_normals(const Mesh& mesh, std::span<const int> cells);

/// Unit tangent at each node of edges: the mean of the unit tangents that the edges have there, from their first node
/// to their second (U4.44.01, ARETE_IMPO). Throws Error `not-an-edge` for another cell, `degenerate-facet` where
/// tangents cancel.
std::map<int, Eigen::Vector3d> mean_tangents(const Mesh& mesh, std::span<const int> cells);

/// The tangent of a plane skin to its normal: the normal turned by +90 degrees.
Eigen::Vector3d plane_tangent(const Eigen::Vector3d& normal);

}  // namespace comma::solver
