// Contact forces found point by point: slow, but finds its way where Newton's method does not.
#pragma once

#include <Eigen/Dense>

#include "solver/contact_law/condensed_problem.hpp"

namespace comma::solver {

/// Non-smooth Gauss-Seidel (Moreau and Jean; Acary and Brogliato, Numerical Methods for Nonsmooth Dynamical Systems,
/// 2008, chapter 13): each point in turn takes the force that its law asks for, the others' forces being held.
/// Overwrites statuses, multipliers and jumps by what it finds, which is near the solution, not the solution. Does
/// nothing, and returns false, unless all points lie on nodes.
bool relax_condensed(SchurComplement& schur, const CondensedProblem& problem, CondensedState& state,
                     Eigen::VectorXd& jumps);

}  // namespace comma::solver
