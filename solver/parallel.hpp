// Work in parts, on as many threads as the machine has.
#pragma once

#include <functional>

namespace comma::solver {

/// Runs part(0) .. part(count - 1), which must not write to the same places, and waits for them all. What a part does
/// may not depend on the number of threads: results are then the same on every machine. Throws what the first part that
/// failed threw.
void run_parts(int count, const std::function<void(int)>& part);

}  // namespace comma::solver
