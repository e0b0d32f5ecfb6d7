// Points and vectors that keywords give.
#pragma once

#include <algorithm>
#include <string>

#include <Eigen/Core>

#include "interpreter/graph/call.hpp"
#include "solver/mesh/mesh.hpp"

namespace comma::commands {

/// The reals of a keyword, three at most; 0 where they end.
inline solver::Point point_of(const interpreter::Keywords& keywords, const std::string& keyword) {
  solver::Point point{};
  std::ranges::copy(keywords.reals(keyword), point.begin());
  return point;
}

inline Eigen::Vector3d vector_of(const interpreter::Keywords& keywords, const std::string& keyword) {
  return Eigen::Vector3d(point_of(keywords, keyword).data());
}

}  // namespace comma::commands
