// What a command file may use of the machine. Every limit ends in a diagnostic, never in a crash or a hang.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>

namespace comma::interpreter {

/// The work of commands does not count: it is the evaluator's own steps, memory and time that are bounded.
struct Limits {
  std::uint64_t steps = 50'000'000;               ///< statements, loop turns, calls, and bulk work in proportion
  std::uint64_t largest_object = 64U << 20;       ///< bytes of one text or list
  std::uint64_t integer_bits = 1U << 20;          ///< of one integer: a product of two such takes about a second
  std::uint64_t memory = std::uint64_t{2} << 30;  ///< bytes by which the evaluator may make the process grow
  double seconds = 60.0;                          ///< wall-clock time
  int call_depth = 1000;                          ///< functions within functions: Python's own limit
  std::size_t stack_bytes = 4U << 20;             ///< of the native stack, half of what a thread commonly has
};

/// Counts what is used; throws LimitReached ("limit-steps", "limit-memory", "limit-time") when it is too much.
class Meter {
 public:
  explicit Meter(const Limits& limits) : limits_(limits) {}
  void step() {
    if (++steps_ >= next_look_) look();
  }
  /// Before something of this size is made; making it counts as steps, so that many large things end a run as well.
  void allocate(std::uint64_t bytes);
  /// The size alone, of something that has been counted or grows bit by bit.
  void check_object(std::uint64_t bytes) const;
  /// `count` items of a list or a tuple.
  void allocate_items(std::uint64_t count) { allocate(count * 24); }
  /// Before arithmetic on long integers: `operations` on 32-bit limbs.
  void work(std::uint64_t operations);
  /// Before an integer of that many bits is made.
  void check_integer(std::uint64_t bits) const;
  const Limits& limits() const { return limits_; }

  /// While it lives, someone else works: neither the time nor the memory counts.
  class Pause {
   public:
    explicit Pause(Meter& meter);
    ~Pause();
    Pause(const Pause&) = delete;
    Pause& operator=(const Pause&) = delete;

   private:
    friend class Meter;
    void count_out();

    Meter& meter_;
    Pause* around_;
    std::chrono::steady_clock::time_point begun_;
  };

  /// While it lives, within a pause, the file's own work goes on (that of a file that it includes).
  class Resume {
   public:
    explicit Resume(Meter& meter);
    ~Resume();
    Resume(const Resume&) = delete;
    Resume& operator=(const Resume&) = delete;

   private:
    Meter& meter_;
    Pause* paused_;
  };

 private:
  using Clock = std::chrono::steady_clock;

  /// Compares steps, time and memory with their limits, now and then.
  void look();

  Limits limits_;
  std::uint64_t steps_ = 0;
  std::uint64_t next_look_ = 1;
  std::uint64_t memory_at_start_ = 0;
  std::uint64_t growth_ = 0;    ///< of the memory, at the last look
  bool others_worked_ = false;  ///< since the last look: what the memory has grown by is theirs
  Clock::time_point started_{};
  Pause* pause_ = nullptr;  ///< the innermost one; null while the file itself works
};

}  // namespace comma::interpreter
