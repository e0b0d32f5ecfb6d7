// Moving the nodes of a mesh (MODI_MAILLAGE, U4.23.04). Cells and groups stay.
#pragma once

#include <span>

#include "solver/fields/data/field.hpp"
#include "solver/mesh/mesh.hpp"

namespace comma::solver {

void scale(Mesh& mesh, double factor);
void translate(Mesh& mesh, const Point& shift);

/// Turns the mesh about the axis through `point`, by `angle` radians and the right-hand rule. Throws Error
/// `zero-vector`.
void rotate(Mesh& mesh, const Point& point, const Point& axis, double angle);

/// Mirrors the mesh in the plane through `point`. Cells keep the order of their nodes, so they run in the other sense
/// afterwards. Throws Error `zero-vector`.
void mirror(Mesh& mesh, const Point& point, const Point& normal);

/// Gives coordinates in the axes whose first is along `x` and whose second lies in the plane of `x` and `y`. Throws
/// Error `zero-vector` if the two do not span a plane.
void change_axes(Mesh& mesh, const Point& x, const Point& y);

/// Adds DX, DY, DZ of the field to the coordinates; nodes that do not carry them stay. Throws Error
/// `incompatible-field` if the field is not one of displacements on this mesh.
void displace(Mesh& mesh, const NodalField& displacements);

}  // namespace comma::solver
