// What discrete and slender elements have beside their mesh: stiffnesses, sections, orientations.
#pragma once

#include <unordered_map>

#include <Eigen/Dense>

namespace comma::solver {

/// The stiffness of a discrete element, in global axes already: on a point k x k, on a segment 2k x 2k, k components a node.
struct DiscreteStiffness {
  Eigen::MatrixXd matrix;
};

/// Characteristics by cell index.
struct ElementProperties {
  std::unordered_map<int, DiscreteStiffness> discrete;
};

}  // namespace comma::solver
