// How many threads the BLAS of a library that was loaded at run time works with.
#pragma once

#include <algorithm>
#include <thread>

#include "solver/linear/shared_library.hpp"

namespace comma::solver {

/// Operations from which a factorisation gains by more than one thread. Below, waiting takes a third more of the
/// processors for a few per cent of time, and twice the time where others use them.
inline constexpr double many_operations = 3e10;

/// Where the BLAS does not let itself be told, nothing happens.
class BlasThreads {
 public:
  explicit BlasThreads(const SharedLibrary& library)
      : set_(library.function_if_any<void(int)>("openblas_set_num_threads")) {}

  void use(int count) const {
    if (set_) set_(count);
  }
  void use_all() const { use(static_cast<int>(std::max(1u, std::thread::hardware_concurrency()))); }

 private:
  void (*set_)(int);
};

/// All threads where they are wanted, and one again at the end of the scope.
class AllThreads {
 public:
  explicit AllThreads(const BlasThreads& threads, bool wanted = true) : threads_(threads) {
    if (wanted) threads_.use_all();
  }
  ~AllThreads() { threads_.use(1); }
  AllThreads(const AllThreads&) = delete;
  AllThreads& operator=(const AllThreads&) = delete;

 private:
  const BlasThreads& threads_;
};

}  // namespace comma::solver
