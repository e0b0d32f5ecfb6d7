#include "solver/linear/large_pages.hpp"

#include <sys/mman.h>

#include <cstdint>
#include <cstdlib>

namespace comma::solver {

namespace {

constexpr std::size_t page = std::size_t{1} << 21;
/// Below, what is left over of the last page counts.
constexpr std::size_t least = 2 * page;

constexpr std::size_t rounded_up(std::size_t bytes) { return (bytes + page - 1) / page * page; }

}  // namespace

void* allocate_in_large_pages(std::size_t bytes) {
  if (bytes < least || bytes > SIZE_MAX - page) return std::malloc(bytes);
  void* memory = std::aligned_alloc(page, rounded_up(bytes));
  if (memory != nullptr) madvise(memory, rounded_up(bytes), MADV_HUGEPAGE);
  return memory;
}

}  // namespace comma::solver
