// Checks on the arrays of a MED file that the MED library itself leaves out.
#pragma once

#include "solver/io/med_library.hpp"

namespace comma::solver {

/// The MED library reads whole arrays into buffers whose size the caller takes from attributes beside them. Where the
/// two disagree, in a damaged file, that would write past the end of the buffer; so they are compared first. Nor may an
/// array claim more than its file can hold. Throws Error `damaged-mesh` naming the array.
void check_med_arrays(const MedFile& file);

}  // namespace comma::solver
