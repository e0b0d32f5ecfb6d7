// Forces of the size that a user expects, against which residuals are measured (R5.03.01, RESI_REFE_RELA).
#pragma once

#include <Eigen/Dense>

#include "solver/constraints/elimination.hpp"
#include "solver/nonlinear/static_analysis.hpp"

namespace comma::solver {

/// At each degree of freedom the mean over the elements there of what reference efforts would make of internal force: in a continuum the
/// integral of the stress times the gradient of the node's shape function, its components taken by their size and added; of mixed elements the least of their means, and integrals of the strain for the pressure and of the stress for the swelling; in bars, beams, springs
/// the resultants themselves; in plates times a length of the cell.
class ReferenceForces {
 public:
  /// Computes nothing unless the options ask for RESI_REFE_RELA. Throws Error `missing-reference` where an element has none of the efforts
  /// that are given.
  ReferenceForces(const Model& model, const DofMap& dofs, const Elimination& elimination, const NewtonOptions& options);

  /// The largest share that a component of a reduced residual has of its reference; 0 where none is asked for.
  double share(const Eigen::VectorXd& residual) const;

 private:
  Eigen::VectorXd reduced_;
};

/// Over all degrees of freedom; zero where no element is. Throws as above.
Eigen::VectorXd reference_forces(const Model& model, const DofMap& dofs, const ReferenceEfforts& efforts);

}  // namespace comma::solver
