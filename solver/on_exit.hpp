// What is to be done however a scope is left.
#pragma once

#include <utility>

namespace comma::solver {

/// Calls its function when it goes out of scope.
template <class Function>
class OnExit {
 public:
  explicit OnExit(Function function) : function_(std::move(function)) {}
  ~OnExit() { function_(); }
  OnExit(const OnExit&) = delete;
  OnExit& operator=(const OnExit&) = delete;

 private:
  Function function_;
};

}  // namespace comma::solver
