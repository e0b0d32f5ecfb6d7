// Libraries that are loaded only when a computation asks for them.
#pragma once

#include <string>

namespace comma::solver {

/// A shared library opened at run time. MUMPS, CHOLMOD and the BLAS below them take longer to load (some 5 ms) than a
/// small scene takes to solve, so the program does not link them. Once loaded they stay: the BLAS starts threads of its
/// own.
class SharedLibrary {
 public:
  /// Throws Error `missing-library` naming the file and the loader's reason.
  explicit SharedLibrary(const std::string& file);

  /// The address of a function, here or in a library below; null where there is none.
  template <typename Function>
  Function* function_if_any(const char* name) const {
    return reinterpret_cast<Function*>(symbol_if_any(name));
  }
  /// The address of a variable, here or in a library below; null where there is none.
  template <typename Variable>
  Variable* variable_if_any(const char* name) const {
    return static_cast<Variable*>(symbol_if_any(name));
  }
  /// The address of a function. Throws Error `missing-library` if there is none of that name.
  template <typename Function>
  Function* function(const char* name) const {
    return reinterpret_cast<Function*>(symbol(name));
  }

 private:
  void* symbol(const char* name) const;
  void* symbol_if_any(const char* name) const;

  std::string file_;
  void* handle_;
};

}  // namespace comma::solver
