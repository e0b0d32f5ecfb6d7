// Places of nodes as vectors.
#pragma once

#include <Eigen/Core>

#include "solver/mesh/mesh.hpp"

namespace comma::solver {

inline Eigen::Vector3d to_vector(const Point& point) { return Eigen::Vector3d(point.data()); }
inline Point to_point(const Eigen::Vector3d& at) { return {at[0], at[1], at[2]}; }
inline Eigen::Vector3d place(const Mesh& mesh, int node) { return to_vector(mesh.nodes[node]); }

}  // namespace comma::solver
