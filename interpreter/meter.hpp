// What a command file may use of the machine. Every limit ends in a diagnostic, never in a crash or a hang.
#pragma once

#include <cstddef>
#include <cstdint>

namespace comma::interpreter {

struct Limits {
  std::uint64_t steps = 50'000'000;          ///< statements, loop turns, calls, and bulk work in proportion
  std::uint64_t largest_object = 64U << 20;  ///< bytes of one text or list
  std::uint64_t integer_bits = 1U << 20;     ///< of one integer: a product of two such takes about a second
  int call_depth = 1000;                     ///< functions within functions: Python's own limit
  std::size_t stack_bytes = 4U << 20;        ///< of the native stack, half of what a thread commonly has
};

/// Counts what is used; throws LimitReached ("limit-steps", "limit-memory") when it is too much.
class Meter {
 public:
  explicit Meter(const Limits& limits) : limits_(limits) {}
  void step() {
    if (++steps_ > limits_.steps) stop_steps();
  }
  /// Before something of this size is made; making it counts as steps, so that many large things end a run as well.
  void allocate(std::uint64_t bytes);
  /// `count` items of a list or a tuple.
  void allocate_items(std::uint64_t count) { allocate(count * 24); }
  /// Before arithmetic on long integers: `operations` on 32-bit limbs.
  void work(std::uint64_t operations);
  /// Before an integer of that many bits is made.
  void check_integer(std::uint64_t bits) const;
  const Limits& limits() const { return limits_; }

 private:
  [[noreturn]] void stop_steps() const;

  Limits limits_;
  std::uint64_t steps_ = 0;
};

}  // namespace comma::interpreter
