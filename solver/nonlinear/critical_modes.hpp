// The eigenvalue problem behind a check of stability.
#pragma once

#include "solver/constraints/elimination.hpp"
#include "solver/elements/assembler.hpp"
#include "solver/nonlinear/static_analysis.hpp"

namespace comma::solver {

/// Throws Error `unsupported` where the problem has what modes are not known with: contact, unilateral conditions,
/// loads that follow, and large displacements where the stiffness of the stresses is to be apart.
void require_modes(const StabilityAnalysis& analysis, const StaticProblem& problem);

/// Whether the step to an instant, the one of this number (from 1), is one that modes are asked for.
bool is_stability_due(const StabilityAnalysis& analysis, double instant, int number);

/// The modes at u, a converged state of the assembler: see StabilityAnalysis. `kind`: of the stiffness with which the
/// next step would begin; the elastic one counts where that is asked for (Code_Aster 17.3), else the tangent. Throws
/// Error `unsupported`, `singular-matrix`, `no-convergence`.
StabilityReport critical_modes(const StabilityAnalysis& analysis, TangentKind kind, double instant,
                               const Eigen::VectorXd& u, const Assembler& assembler, const Elimination& elimination,
                               const DofMap& dofs);

}  // namespace comma::solver
