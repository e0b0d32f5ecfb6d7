// Vectors and tensors of a nodal field in other axes.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string_view>

#include <Eigen/Dense>

#include "solver/fields/data/field.hpp"

namespace comma::solver {

/// The axes (rows) at a node.
using NodeAxes = std::function<Eigen::Matrix3d(int node)>;

/// The field at `nodes`, absent elsewhere, with vectors (DX DY DZ; DRX DRY DRZ; FX FY FZ; MX MY MZ) and symmetric
/// tensors (SIXX
/// ... SIYZ; EPXX ... EPYZ) turned into the axes of each node; other components as they are. Of a vector or tensor that
/// a node carries in part, the missing components count as 0, and all of them come out.
NodalField in_axes(const NodalField& field, std::span<const int> nodes, const NodeAxes& axes);

/// Whether a component of the field has a direction that in_axes does not turn: forces and strains of sections, which
/// lie in axes of their own, forces and slips of contact, coordinates.
bool has_own_axes(const NodalField& field, std::string_view component);

/// The axes of bodies of revolution about the line through `origin` along `axis`: r away from the line, z along it, and
/// third the direction in which a right-handed screw along the axis turns (the order of axisymmetric models, which
/// makes the three left-handed). Throws Error `zero-vector` for an axis without length, and when asked for a node on
/// the line.
NodeAxes revolution_axes(const Mesh& mesh, const Eigen::Vector3d& origin, const Eigen::Vector3d& axis);

/// Axes in the plane of X and Y about the origin: r, then the direction in which the angle falls, then Z (which makes
/// the three left-handed; Code_Aster 17.3 has them so). Throws Error `zero-vector` when asked for a node on the Z axis.
NodeAxes polar_axes(const Mesh& mesh);

/// Whether there are axes at a node: not on the line that axes go round.
bool has_axes(const NodeAxes& axes, int node);

/// The same axes; a node that has none takes those of the nearest of `nodes` that has: its own as it is approached from
/// there. Throws what `axes` throws where none has.
NodeAxes with_axes_of_neighbours(const Mesh& mesh, std::span<const int> nodes, NodeAxes axes);

/// Of a body in the plane, turned into axes that go round a line across it (revolution_axes): the one shear that there
/// is, of the first and the third axis, stands in SIXY (EPXY), as in Code_Aster 17.3; those that vanish are taken away.
NodalField with_shear_of_plane(const NodalField& turned);

/// The axes along the broken line through `nodes`: first its tangent, at inner nodes the mean direction of the two
/// segments there; second the part of `y` across it, without `y` (in a plane mesh) the tangent turned by 90 degrees;
/// third their cross product. Throws Error `zero-vector` for a line of one node, for two neighbours at one place, and
/// where `y` lies along the line; `missing-direction` for a mesh in space without `y`.
NodeAxes line_axes(const Mesh& mesh, std::span<const int> nodes, const std::optional<Eigen::Vector3d>& y);

/// The same with the tangent at inner nodes along the chord between their neighbours (MACR_LIGN_COUPE).
NodeAxes chord_axes(const Mesh& mesh, std::span<const int> nodes, const std::optional<Eigen::Vector3d>& y);

/// The mean of the second axes of the segments that meet at a node of the line, each with the segment's own tangent: a
/// traction on it is the mean of those on both segments. Shorter than 1 where the line bends. Throws as line_axes.
std::function<Eigen::Vector3d(int node)> line_normals(const Mesh& mesh, std::span<const int> nodes,
                                                      const std::optional<Eigen::Vector3d>& y);

/// The sums of forces and moments over nodes.
struct Resultant {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  ///< about a point
};

/// Forces stand in `components`, moments of their own in DRX DRY DRZ; absent values count as 0.
Resultant resultant(const Mesh& mesh, const NodalField& forces, std::span<const int> nodes,
                    const Eigen::Vector3d& point, const std::array<std::string, 3>& components = {"DX", "DY", "DZ"});

}  // namespace comma::solver
