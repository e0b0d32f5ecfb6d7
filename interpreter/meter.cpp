#include "interpreter/meter.hpp"

#include <fmt/format.h>

#include "interpreter/exception.hpp"

namespace comma::interpreter {

namespace {

/// Memory written in about the time of one step of the evaluator.
constexpr std::uint64_t bytes_per_step = 64;

/// Limb operations in about the time of one step.
constexpr std::uint64_t operations_per_step = 16;

}  // namespace

void Meter::work(std::uint64_t operations) {
  steps_ += operations / operations_per_step;
  if (steps_ > limits_.steps) stop_steps();
}

void Meter::check_integer(std::uint64_t bits) const {
  if (bits <= limits_.integer_bits) return;
  throw LimitReached(
      "limit-memory",
      fmt::format("this makes an integer of more than {} bits: the run is stopped", limits_.integer_bits), {},
      "compute with float where the last digit does not matter");
}

void Meter::stop_steps() const {
  throw LimitReached("limit-steps", fmt::format("this takes more than {} steps: the run is stopped", limits_.steps), {},
                     "look for a loop that never ends");
}

void Meter::allocate(std::uint64_t bytes) {
  if (bytes > limits_.largest_object) {
    throw LimitReached(
        "limit-memory",
        fmt::format("this makes an object of more than {} MB: the run is stopped", limits_.largest_object >> 20), {},
        "look for a product or a range that is too large");
  }
  steps_ += bytes / bytes_per_step;
  if (steps_ > limits_.steps) stop_steps();
}

}  // namespace comma::interpreter
