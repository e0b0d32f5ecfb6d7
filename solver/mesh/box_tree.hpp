// A binary tree of bounding boxes for nearest-item searches.
#pragma once

#include <limits>
#include <vector>

#include <Eigen/Geometry>

namespace comma::solver {

using Box = Eigen::AlignedBox<double, 3>;

/// Split at the median of the longest side; a search visits O(log n) items when they are spread out.
class BoxTree {
 public:
  explicit BoxTree(std::vector<Box> boxes);

  /// Calls `visit(item)` for items in the order of nearness of their boxes' branches; it returns the distance that an
  /// item must not exceed to be worth a visit (infinity at first).
  template <class Visit>
  void search(const Eigen::Vector3d& point, Visit visit) const {
    if (!items_.empty())
      search(0, static_cast<int>(items_.size()), 0, point, std::numeric_limits<double>::infinity(), visit);
  }

 private:
  void build(int first, int last, int node);

  template <class Visit>
  double search(int first, int last, int node, const Eigen::Vector3d& point, double bound, Visit& visit) const {
    if (nodes_[node].exteriorDistance(point) > bound) return bound;
    if (last - first <= leaf_size) {
      for (int i = first; i < last; ++i)
        if (boxes_[items_[i]].exteriorDistance(point) <= bound) bound = visit(items_[i]);
      return bound;
    }
    const int middle = first + (last - first) / 2;
    const int left = 2 * node + 1;
    const int right = left + 1;
    if (nodes_[left].exteriorDistance(point) <= nodes_[right].exteriorDistance(point)) {
      bound = search(first, middle, left, point, bound, visit);
      return search(middle, last, right, point, bound, visit);
    }
    bound = search(middle, last, right, point, bound, visit);
    return search(first, middle, left, point, bound, visit);
  }

  static constexpr int leaf_size = 4;
  std::vector<Box> boxes_;
  std::vector<int> items_;
  std::vector<Box> nodes_;  ///< children of node k at 2k+1 and 2k+2
};

}  // namespace comma::solver
