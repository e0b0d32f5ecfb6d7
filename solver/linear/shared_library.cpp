#include "solver/linear/shared_library.hpp"

#include <dlfcn.h>

#include <fmt/format.h>

#include "solver/error.hpp"
#include "solver/linear/blas_kernels.hpp"

namespace comma::solver {

namespace {

[[noreturn]] void fail(const std::string& file) {
  const char* reason = dlerror();
  throw Error("missing-library", fmt::format("cannot use the library {}: {}", file, reason ? reason : "unknown reason"),
              "install the packages that the launcher lists, or choose another linear solver");
}

}  // namespace

SharedLibrary::SharedLibrary(const std::string& file) : file_(file) {
  choose_blas_kernels();
  handle_ = dlopen(file.c_str(), RTLD_LAZY | RTLD_LOCAL | RTLD_NODELETE);
  if (!handle_) fail(file_);
}

void* SharedLibrary::symbol_if_any(const char* name) const { return dlsym(handle_, name); }

void* SharedLibrary::symbol(const char* name) const {
  void* address = symbol_if_any(name);
  if (!address) fail(file_);
  return address;
}

}  // namespace comma::solver
