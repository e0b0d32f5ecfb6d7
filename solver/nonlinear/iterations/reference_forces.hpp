// Forces against which residuals are measured component by component (R5.03.01, RESI_REFE_RELA and RESI_COMP_RELA).
#pragma once

#include <array>
#include <optional>
#include <vector>

#include <Eigen/Dense>

#include "solver/constraints/elimination.hpp"
#include "solver/nonlinear/static_analysis.hpp"

namespace comma::solver {

/// At each degree of freedom the least over the elements there of what reference efforts would make of internal force:
/// in a continuum the integral of the stress times the gradient of the node's shape function (round an axis its value
/// over the radius as well), its components and weights taken by their size and added, over the number of integration
/// points; of mixed elements over that of the components of the stress, and integrals of the strain for the pressure
/// and of the stress for the swelling; in bars, beams, springs the resultants themselves; in plates times a length of
/// the cell.
class ReferenceForces {
 public:
  /// Computes nothing unless the options ask for RESI_REFE_RELA. Throws Error `missing-reference` where an element has
  /// none of the efforts that are given.
  ReferenceForces(const Model& model, const DofMap& dofs, const Elimination& elimination, const NewtonOptions& options);

  /// The largest share that a component of a reduced residual has of its reference; 0 where none is asked for.
  double share(const Eigen::VectorXd& residual) const;
  /// The same of forces at all degrees of freedom.
  double share_of_all(const Eigen::VectorXd& forces) const;

  /// Reduced unknowns are those of this elimination from now on.
  void renumber(const Elimination& elimination);

  /// A step begins with these internal forces, one a degree of freedom.
  void begin_step(const Eigen::VectorXd& internal_forces);

  /// The largest of the shares that the largest residual of each kind of component has of the largest internal force of
  /// that kind where the step began; a kind without such a force takes the largest of all. What a balance of pressures
  /// or changes of volume lacks is no force: its residual, weighed (RowWeights) to be of the size of one, takes the
  /// largest of the translations. Nothing where there is none at all.
  std::optional<double> share_by_component(const Eigen::VectorXd& residual) const;
  std::optional<double> share_by_component_of_all(const Eigen::VectorXd& forces) const;

 private:
  double share_of_kind(double force, int kind) const;

  const DofMap& dofs_;
  Eigen::VectorXd all_;  ///< empty unless RESI_REFE_RELA is asked for
  Eigen::VectorXd reduced_;
  std::vector<int> kinds_;                         ///< the component of each reduced unknown
  std::array<double, component_count> largest_{};  ///< internal force by component
};

/// Over all degrees of freedom; zero where no element is. Throws as above.
Eigen::VectorXd reference_forces(const Model& model, const DofMap& dofs, const ReferenceEfforts& efforts);

}  // namespace comma::solver
