// Contact and friction by laws that are smooth, and less and less so: slow, but needs no status to find its way.
#pragma once

#include <vector>

#include <Eigen/Dense>

#include "solver/contact_law/condensed_problem.hpp"
#include "solver/contact_law/smoothed_law.hpp"

namespace comma::solver {

/// Which augmentations between nodes are those of the law at last; shears otherwise keep those of the bodies.
enum class Augmentations : std::uint8_t { of_law, of_pressures };

/// A smoothing Newton method (C. Chen and O. L. Mangasarian, Computational Optimization and Applications 5, 1996):
/// pressures and limits of friction are rounded off by a pressure that goes to zero, each solution being the start of
/// the next one. Overwrites statuses, multipliers and jumps by what it finds, which is the solution but for roundings.
/// The augmentations are first as stiff as the bodies (`stiffness`, one a point, is set to them); where points lie
/// between nodes, which has the augmentations in the solution, they then change to those of the law, and on nodes they
/// stay. Returns false where it loses its way, or the system has too many unknowns.
bool smooth_condensed(SchurComplement& schur, const CondensedProblem& problem, CondensedState& state,
                      Eigen::VectorXd& jumps, std::vector<PointStiffness>& stiffness, Augmentations augmentations);

}  // namespace comma::solver
