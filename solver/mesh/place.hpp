// Places of nodes as vectors.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "solver/error.hpp"
#include "solver/mesh/mesh.hpp"

namespace comma::solver {

inline Eigen::Vector3d to_vector(const Point& point) { return Eigen::Vector3d(point.data()); }
inline Point to_point(const Eigen::Vector3d& at) { return {at[0], at[1], at[2]}; }
inline Eigen::Vector3d place(const Mesh& mesh, int node) { return to_vector(mesh.nodes[node]); }

/// Of all nodes.
inline std::vector<Eigen::Vector3d> places(const Mesh& mesh) {
  std::vector<Eigen::Vector3d> result;
  result.reserve(mesh.nodes.size());
  for (const Point& node : mesh.nodes) result.push_back(to_vector(node));
  return result;
}

/// A plane mesh whose nodes have left the plane is one in space from then on.
inline void leave_plane(Mesh& mesh) {
  constexpr double rounding = 1e-12;
  double largest = 0.0, out = 0.0;
  for (const Point& at : mesh.nodes) {
    largest = std::max({largest, std::abs(at[0]), std::abs(at[1])});
    out = std::max(out, std::abs(at[2]));
  }
  if (out > rounding * largest) mesh.dimension = 3;
}

/// The direction with length 1. Throws Error `zero-vector`.
inline Eigen::Vector3d unit(const Eigen::Vector3d& direction) {
  const double length = direction.norm();
  if (!(length > 0.0)) throw Error("zero-vector", "a direction must not be the zero vector");
  return direction / length;
}

}  // namespace comma::solver
