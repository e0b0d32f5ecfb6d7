#include "solver/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <thread>
#include <vector>

namespace comma::solver {

void run_parts(int count, const std::function<void(int)>& part) {
  std::vector<std::exception_ptr> failures(static_cast<std::size_t>(std::max(count, 0)));
  std::atomic<int> next = 0;
  const auto work = [&] {
    for (int k = next++; k < count; k = next++) {
      try {
        part(k);
      } catch (...) {
        failures[static_cast<std::size_t>(k)] = std::current_exception();
      }
    }
  };
  const int others = std::min(count, static_cast<int>(std::max(1u, std::thread::hardware_concurrency()))) - 1;
  std::vector<std::jthread> threads;
  for (int k = 0; k < others; ++k) threads.emplace_back(work);
  work();
  threads.clear();  // waits
  for (const std::exception_ptr& failure : failures)
    if (failure) std::rethrow_exception(failure);
}

}  // namespace comma::solver
