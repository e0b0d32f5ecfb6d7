// Elements in batches: what each computes by itself goes on all threads, what they add up goes in their order.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "solver/parallel.hpp"

namespace comma::solver {

/// Calls compute(element, item) for each of `count` elements and then add(element, item), in the order of the elements:
/// sums are the same whatever the number of threads. While one batch is added the next one is computed, on all threads
/// if `concurrent` says that compute() bears it. `Item`: what an element computes; without pointers, made once for each
/// place of a batch.
template <class Item, class Compute, class Add>
void for_each_in_batches(int count, bool concurrent, Compute&& compute, Add&& add) {
  // Two batches stay in the caches; a thread costs some 0.05 ms to start, which so many elements outweigh.
  constexpr int batch_bytes = 4 << 20;
  constexpr int most_elements = 4096;
  constexpr int parts_of_batch = 16;
  constexpr int batch = std::clamp(static_cast<int>(batch_bytes / sizeof(Item)), parts_of_batch, most_elements);
  if (!concurrent || count < batch) {
    std::vector<Item> one(1);
    for (int element = 0; element < count; ++element) {
      compute(element, one.front());
      add(element, one.front());
    }
    return;
  }
  std::array<std::vector<Item>, 2> items = {std::vector<Item>(batch), std::vector<Item>(batch)};
  const auto add_batch = [&](int first, const std::vector<Item>& computed) {
    for (int k = 0; k < batch && first + k < count; ++k) add(first + k, computed[static_cast<std::size_t>(k)]);
  };
  int turn = 0;
  for (int first = 0; first < count; first += batch, turn = 1 - turn) {
    const int size = std::min(batch, count - first);
    run_parts(parts_of_batch + 1, [&](int part) {
      if (part == 0) {
        if (first > 0) add_batch(first - batch, items[static_cast<std::size_t>(1 - turn)]);
        return;
      }
      for (int k = size * (part - 1) / parts_of_batch; k < size * part / parts_of_batch; ++k)
        compute(first + k, items[static_cast<std::size_t>(turn)][static_cast<std::size_t>(k)]);
    });
  }
  add_batch((count - 1) / batch * batch, items[static_cast<std::size_t>(1 - turn)]);
}

/// Calls each(element) for each of `count` elements, on all threads if `concurrent` says that it bears it: what it
/// writes must be the element's own.
template <class Each>
void for_each_apart(int count, bool concurrent, Each&& each) {
  // So many elements outweigh the start of a thread.
  constexpr int fewest_of_part = 512;
  constexpr int most_parts = 16;
  const int parts = concurrent ? std::clamp(count / fewest_of_part, 1, most_parts) : 1;
  const auto share = [&](int part) { return static_cast<int>(static_cast<long>(count) * part / parts); };
  run_parts(parts, [&](int part) {
    for (int element = share(part); element < share(part + 1); ++element) each(element);
  });
}

}  // namespace comma::solver
