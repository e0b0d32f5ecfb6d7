// The node of a set that is nearest to a place.
#pragma once

#include <limits>
#include <utility>
#include <vector>

#include "solver/mesh/box_tree.hpp"
#include "solver/mesh/place.hpp"

namespace comma::solver {

/// A tree of the places of nodes. The mesh must outlive it and stay as it is.
class NearestNode {
 public:
  NearestNode(const Mesh& mesh, std::vector<int> nodes) : mesh_(mesh), nodes_(std::move(nodes)), tree_(boxes()) {}

  /// The nearest node, of those within `reach` if that is given; of equals, the first of the set. -1 if there is none.
  int operator()(const Eigen::Vector3d& point, double reach = std::numeric_limits<double>::infinity()) const {
    int best = -1;
    double least = reach;
    tree_.search(point, [&](int item) {
      const double distance = (place(mesh_, nodes_[static_cast<std::size_t>(item)]) - point).norm();
      if (distance < least || (distance == least && (best < 0 || item < best))) {
        least = distance;
        best = item;
      }
      return least;
    });
    return best < 0 ? -1 : nodes_[static_cast<std::size_t>(best)];
  }

 private:
  std::vector<Box> boxes() const {
    std::vector<Box> result;
    for (const int node : nodes_) result.emplace_back(place(mesh_, node));
    return result;
  }

  const Mesh& mesh_;
  std::vector<int> nodes_;
  BoxTree tree_;
};

}  // namespace comma::solver
