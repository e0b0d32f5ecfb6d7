// Memory in pages of 2 MB. A factor is written for the first time page by page: with pages of 4 kB a fifth of a run
// goes to the system's handing them out.
#pragma once

#include <cstddef>

namespace comma::solver {

/// As malloc(), to be freed by free(). Large blocks begin at a page of 2 MB and ask the system for such pages; where it
/// has none they are as others.
void* allocate_in_large_pages(std::size_t bytes);

}  // namespace comma::solver
