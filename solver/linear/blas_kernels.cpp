#include "solver/linear/blas_kernels.hpp"

#include <cstdlib>
#include <string>

namespace comma::solver {

InstructionSets instruction_sets() {
#if defined(__x86_64__)
  return {.avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"),
          .avx512 = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
                    __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl")};
#else
  return {};
#endif
}

std::string_view blas_kernels(const InstructionSets& sets) {
  if (sets.avx512) return "SkylakeX";
  return sets.avx2 ? "Haswell" : "";
}

void choose_blas_kernels() {
  const std::string kernels(blas_kernels(instruction_sets()));
  constexpr int keep = 0;
  if (!kernels.empty()) setenv("OPENBLAS_CORETYPE", kernels.c_str(), keep);
}

}  // namespace comma::solver
