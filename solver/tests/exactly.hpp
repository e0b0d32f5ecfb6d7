// What a computation gives of a value that is known in closed form.
#pragma once

#include <catch2/catch.hpp>

namespace comma::solver {

/// Equal but for rounding: some hundred thousand roundings that all go one way. Catch's own default, 1.2e-5, is that of
/// single precision.
inline Approx exactly(double value) { return Approx(value).epsilon(1e-10); }

}  // namespace comma::solver
