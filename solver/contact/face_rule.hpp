// Integration rules on the slave faces of the mixed formulation of contact.
#pragma once

#include <vector>

#include <Eigen/Dense>

#include "solver/contact/definition.hpp"
#include "solver/mesh/cell_type.hpp"

namespace comma::solver {

struct FacePoint {
  Eigen::Vector2d xi;   ///< in the facet's reference cell (see facet.hpp)
  double weight = 0.0;  ///< the weights of a rule add up to the measure of the reference cell
  int stands_for = -1;  ///< of a point between nodes: the node of the face, by its number there, that it stands for
};

/// The points of a rule (U4.44.11, INTEGRATION): `automatic` puts them at the corners of linear faces (trapezium rule)
/// and takes Simpson's rule on quadratic ones, but on triangles of six nodes Gauss's of six points, each of which
/// stands for the node that it is next to (Code_Aster 17.3); `gauss`: order^d points on lines and quadrangles, on
/// triangles the families of 1, 3, 4, 6, 7 and 12 points; `simpson`: composite, `order` pieces a side; `newton_cotes`:
/// order + 1 points a side, closed. Order 0 is the default of the rule: 3, 1 and 3. Throws Error `unsupported` for a
/// Gauss rule of order 7 or 8 on a triangle, or a cell that is no facet.
std::vector<FacePoint> face_rule(CellType type, ContactRule rule, int order);

}  // namespace comma::solver
