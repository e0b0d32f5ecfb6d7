#include "solver/linear/large_pages.hpp"

#include <catch2/catch.hpp>
#include <cstdint>
#include <cstdlib>
#include <memory>

using namespace comma::solver;

namespace {

using Memory = std::unique_ptr<void, decltype(&std::free)>;

bool begins_a_large_page(const void* memory) { return reinterpret_cast<std::uintptr_t>(memory) % (1u << 21) == 0; }

}  // namespace

TEST_CASE("Large blocks begin at a page of 2 MB and may be used to their last byte") {
  constexpr std::size_t odd = (5u << 20) + 3;
  const Memory memory(allocate_in_large_pages(odd), &std::free);
  REQUIRE(memory != nullptr);
  CHECK(begins_a_large_page(memory.get()));
  static_cast<char*>(memory.get())[odd - 1] = 1;
}

TEST_CASE("Small blocks are as others, and one that is too large is refused") {
  const Memory memory(allocate_in_large_pages(100), &std::free);
  CHECK(memory != nullptr);
  CHECK(allocate_in_large_pages(SIZE_MAX) == nullptr);
  CHECK(allocate_in_large_pages(SIZE_MAX / 2) == nullptr);
}
