// How much a field changes in a step (DELTA_GRANDEUR of U4.34.03).
#pragma once

#include <vector>

#include "solver/fields/data/field.hpp"
#include "solver/mesh/mesh.hpp"
#include "solver/nonlinear/steps/step_sequence.hpp"

namespace comma::solver {

/// The watched values of a step, in a fixed order; what is absent there counts as zero. Throws Error `missing-field`,
/// `unknown-component`.
std::vector<double> watched_values(const WatchedIncrement& watched, const ResultStep& step, const Mesh& mesh);

/// The largest change between two of them.
double largest_change(const std::vector<double>& before, const std::vector<double>& after);

}  // namespace comma::solver
