#include "solver/mesh/box_tree.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace comma::solver {

BoxTree::BoxTree(std::vector<Box> boxes) : boxes_(std::move(boxes)), items_(boxes_.size()) {
  std::iota(items_.begin(), items_.end(), 0);
  if (!items_.empty()) build(0, static_cast<int>(items_.size()), 0);
}

void BoxTree::build(int first, int last, int node) {
  if (static_cast<int>(nodes_.size()) <= node) nodes_.resize(static_cast<std::size_t>(node) + 1);
  Box all;
  for (int i = first; i < last; ++i) all.extend(boxes_[items_[i]]);
  nodes_[node] = all;
  if (last - first <= leaf_size) return;
  Eigen::Index axis = 0;
  all.sizes().maxCoeff(&axis);
  const int middle = first + (last - first) / 2;
  // Equal centres are ordered by index so that the tree, and with it the choice among equals, is the same everywhere.
  std::nth_element(items_.begin() + first, items_.begin() + middle, items_.begin() + last, [&](int a, int b) {
    const double ca = boxes_[a].center()[axis];
    const double cb = boxes_[b].center()[axis];
    return ca != cb ? ca < cb : a < b;
  });
  build(first, middle, 2 * node + 1);
  build(middle, last, 2 * node + 2);
}

}  // namespace comma::solver
