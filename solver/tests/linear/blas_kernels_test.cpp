#include "solver/linear/blas_kernels.hpp"

#include <cstdlib>
#include <string>

#include <catch2/catch.hpp>

using namespace comma::solver;

namespace {

constexpr const char* chosen = "OPENBLAS_CORETYPE";

std::string present() {
  const char* value = std::getenv(chosen);
  return value ? value : "";
}

}  // namespace

TEST_CASE("Kernels are those of the widest instructions") {
  CHECK(blas_kernels({.avx2 = true, .avx512 = true}) == "SkylakeX");
  CHECK(blas_kernels({.avx2 = true}) == "Haswell");
  CHECK(blas_kernels({}).empty());
}

TEST_CASE("The user's choice of kernels stands, and where there is none the processor decides") {
  const std::string before = present();
  setenv(chosen, "Nehalem", 1);
  choose_blas_kernels();
  CHECK(present() == "Nehalem");
  unsetenv(chosen);
  choose_blas_kernels();
  CHECK(present() == blas_kernels(instruction_sets()));
  before.empty() ? unsetenv(chosen) : setenv(chosen, before.c_str(), 1);
}
