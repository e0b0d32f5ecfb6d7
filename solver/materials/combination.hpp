// Several materials as one.
#pragma once

#include "solver/materials/material.hpp"

namespace comma::solver {

/// What either of two materials has. Where both have it, that of the first counts, but for the elasticity of rubber at
/// rest, which gives way to one that is given.
Material combined(const Material& first, const Material& second);

}  // namespace comma::solver
