// How much the strains of a step go on in their own direction, as a function of a load intensity (R5.03.80, PILOTAGE
// TYPE='DEFORMATION').
#pragma once

#include <vector>

#include <Eigen/Dense>

#include "solver/elements/assembler.hpp"
#include "solver/nonlinear/static_analysis.hpp"

namespace comma::solver {

/// At each point that is strained where the step begins, the change of its strain projected on the direction of that
/// strain (tensors, by their products; in plane stress without EPZZ, as Code_Aster 17.3 does): the largest of all
/// points is controlled. Small strains of continua.
class StrainControl {
 public:
  /// From the displacements u, where the step begins. `cells`: those that are looked at; empty: all. Keeps references
  /// to problem and dofs. Throws Error `missing-strain` where no point is strained yet, `missing-cells` where there is
  /// no continuum, `unsupported` in large strains.
  StrainControl(const StaticProblem& problem, const DofMap& dofs, const Assembler& assembler,
                const std::vector<int>& cells, const Eigen::VectorXd& u);

  /// The intensities x, rising, at which the largest projection is `wanted`, for the increment constant + x linear of
  /// the displacements.
  std::vector<double> intensities(double wanted, const Eigen::VectorXd& constant, const Eigen::VectorXd& linear) const;

 private:
  struct Point {
    int cell;
    int point;
    Eigen::Matrix<double, 6, 1> direction;  ///< of length 1 as a tensor; tensor components
  };

  ElementField strains_of(const Eigen::VectorXd& u) const;

  const StaticProblem& problem_;
  const DofMap& dofs_;
  const VariableState& state_;
  std::vector<Point> points_;
};

}  // namespace comma::solver
