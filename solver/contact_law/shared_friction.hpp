// Friction whose multipliers are shares of its limit.
#pragma once

#include <functional>

#include "solver/contact_law/condensed_contact.hpp"

namespace comma::solver {

/// Solutions of a condensed problem with the laws as they stand: from wherever, or from a state that is near (`attempt`
/// by Newton's method alone).
struct CondensedMethods {
  using Method = std::function<CondensedSolution(const CondensedProblem& problem, CondensedState& state)>;
  Method solve;
  Method refine;
  Method attempt;
  Method smooth;
  Method stand_in;
};

/// Whether points have a share_augmentation.
bool has_shared_friction(const CondensedProblem& problem);

/// The multiplier of friction of R5.03.52 is a share of the limit: the shear at a point is friction * pressure * share,
/// both interpolated, and COEF_FROT or COEF_PENA_FROT add to the share by the slip. On nodes without a penalty this is
/// the law of Alart and Curnier all the same. Shares are sought from the multipliers expected and from those of the
/// state. Where these lead nowhere, or nothing presses yet, so that shares say nothing, a solution by shears comes
/// first, the augmentation of which is that of shares at the largest pressure; it stands where no solution by shares is
/// found, unless there is a penalty. The largest pressure that weighs shares is that of the solution on the surface of
/// the point: what is not connected to it does not count. Multipliers in `state` are pressures and shears at the nodes,
/// before and after.
CondensedSolution solve_shared_friction(const CondensedProblem& problem, CondensedState& state,
                                        const CondensedMethods& methods);

}  // namespace comma::solver
