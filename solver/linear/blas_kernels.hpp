// Which of its kernels the BLAS works with. OpenBLAS tells a processor by its model, and takes one newer than itself
// for one of 2004: without the instructions that it does not look for factorisations take two to three times as long.
#pragma once

#include <string_view>

namespace comma::solver {

/// Those that kernels differ by.
struct InstructionSets {
  bool avx2 = false;    ///< with FMA
  bool avx512 = false;  ///< F, DQ, BW and VL
};

/// Of the processor that this runs on, as far as the system lets them be used.
InstructionSets instruction_sets();

/// The name that OpenBLAS has for the kernels that go with them; empty: its own choice is as good as any.
std::string_view blas_kernels(const InstructionSets& sets);

/// Has OpenBLAS take kernels by what the processor can do, unless the user says which (OPENBLAS_CORETYPE). To be called
/// before the library is loaded; any other BLAS does not mind.
void choose_blas_kernels();

}  // namespace comma::solver
