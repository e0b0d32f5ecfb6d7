// Places of a mesh, each once, as several groups name them.
#pragma once

#include <utility>
#include <vector>

namespace comma::commands {

/// A list without repetition of numbers from 0 to `size` - 1 that keeps its order of arrival.
class OrderedSet {
 public:
  explicit OrderedSet(int size) : seen_(static_cast<std::size_t>(size), false) {}
  void add(int index) {
    if (seen_[index]) return;
    seen_[index] = true;
    items_.push_back(index);
  }
  template <class Range>
  void add_all(const Range& range) {
    for (const int index : range) add(index);
  }
  std::vector<int> take() { return std::move(items_); }

 private:
  std::vector<bool> seen_;
  std::vector<int> items_;
};

}  // namespace comma::commands
