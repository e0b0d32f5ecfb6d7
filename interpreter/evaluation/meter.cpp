#include "interpreter/evaluation/meter.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <utility>

#include "interpreter/values/exception.hpp"

namespace comma::interpreter {

namespace {

/// Memory written in about the time of one step of the evaluator.
constexpr std::uint64_t bytes_per_step = 64;
/// Limb operations in about the time of one step.
constexpr std::uint64_t operations_per_step = 16;
/// Between two looks at the clock and at the memory: about a millisecond of work.
constexpr std::uint64_t steps_between_looks = 8192;

/// Memory that the process occupies, in bytes; 0 where the system does not tell.
std::uint64_t resident_memory() {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen("/proc/self/statm", "r"), std::fclose);
  unsigned long total = 0, resident = 0;
  if (!file || std::fscanf(file.get(), "%lu %lu", &total, &resident) != 2) return 0;
  return static_cast<std::uint64_t>(resident) * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

}  // namespace

void Meter::look() {
  const bool first = started_ == Clock::time_point{};
  if (first) {
    started_ = Clock::now();
    memory_at_start_ = resident_memory();
  }
  if (steps_ > limits_.steps) {
    throw LimitReached("limit-steps", fmt::format("this takes more than {} steps: the run is stopped", limits_.steps),
                       {}, "look for a loop that never ends; --max-steps sets the limit");
  }
  if (std::chrono::duration<double>(Clock::now() - started_).count() > limits_.seconds) {
    throw LimitReached("limit-time", fmt::format("this takes longer than {:g} s: the run is stopped", limits_.seconds),
                       {}, "look for a loop that does too much; --max-seconds sets the limit");
  }
  const std::uint64_t memory = resident_memory();
  if (std::exchange(others_worked_, false) && memory > growth_)
    memory_at_start_ = std::max(memory_at_start_, memory - growth_);
  growth_ = std::max(memory, memory_at_start_) - memory_at_start_;
  if (growth_ > limits_.memory) {
    throw LimitReached("limit-memory",
                       fmt::format("this takes more than {} MB: the run is stopped", limits_.memory >> 20), {},
                       "look for lists that only grow; --max-memory sets the limit");
  }
  next_look_ = std::min(steps_ + steps_between_looks, limits_.steps + 1);
}

void Meter::check_object(std::uint64_t bytes) const {
  const std::uint64_t largest = std::min(limits_.largest_object, limits_.memory);
  if (bytes > largest) {
    throw LimitReached("limit-memory",
                       fmt::format("this makes an object of more than {} MB: the run is stopped", largest >> 20), {},
                       "look for a product or a range that is too large");
  }
}

void Meter::allocate(std::uint64_t bytes) {
  check_object(bytes);
  steps_ += bytes / bytes_per_step;
  if (steps_ >= next_look_) look();
}

void Meter::work(std::uint64_t operations) {
  steps_ += operations / operations_per_step;
  if (steps_ >= next_look_) look();
}

void Meter::check_integer(std::uint64_t bits) const {
  if (bits <= limits_.integer_bits) return;
  throw LimitReached(
      "limit-memory",
      fmt::format("this makes an integer of more than {} bits: the run is stopped", limits_.integer_bits), {},
      "compute with float where the last digit does not matter");
}

Meter::Pause::Pause(Meter& meter) : meter_(meter), around_(std::exchange(meter.pause_, this)), begun_(Clock::now()) {}

Meter::Pause::~Pause() {
  meter_.pause_ = around_;
  // What lies inside another pause is counted there.
  if (around_ == nullptr) count_out();
}

void Meter::Pause::count_out() {
  // A shorter one (the cell of a table) cannot have taken much.
  constexpr auto worth_counting = std::chrono::milliseconds(1);
  const auto length = Clock::now() - begun_;
  if (meter_.started_ == Clock::time_point{} || length < worth_counting) return;
  meter_.started_ += length;
  meter_.others_worked_ = true;
}

Meter::Resume::Resume(Meter& meter) : meter_(meter), paused_(std::exchange(meter.pause_, nullptr)) {
  if (paused_ != nullptr) paused_->count_out();
}

Meter::Resume::~Resume() {
  meter_.pause_ = paused_;
  if (paused_ != nullptr) paused_->begun_ = Clock::now();
}

}  // namespace comma::interpreter
