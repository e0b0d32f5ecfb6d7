// How far an elastic prediction of a step goes beyond the yield surface, as a function of a load intensity (R5.03.80).
#pragma once

#include <vector>

#include <Eigen/Dense>

#include "solver/elements/assembler.hpp"
#include "solver/materials/behaviour/hardening.hpp"
#include "solver/nonlinear/static_analysis.hpp"

namespace comma::solver {

/// Von Mises' plasticity with isotropic hardening in small strains. The excess is the prediction over the radius of the
/// yield surface, less one; for VMIS_ISOT_NL a twentieth of it is the plastic strain that the return would make.
class ElasticPrediction {
 public:
  /// From the state at u, where the step begins. `cells`: those that are looked at; empty: all. Keeps no reference to
  /// u. Throws Error `unsupported` for a cell with another law or in large strains, `missing-cells` where there is
  /// none.
  ElasticPrediction(const StaticProblem& problem, const DofMap& dofs, const Assembler& assembler,
                    const std::vector<int>& cells, const Eigen::VectorXd& u);

  /// The intensities x, rising, at which the largest excess of all points is `wanted`, for the increment constant + x
  /// linear of the displacements.
  std::vector<double> intensities(double wanted, const Eigen::VectorXd& constant, const Eigen::VectorXd& linear) const;

 private:
  struct Point {
    std::size_t cell;
    int point;
    PlasticPoint law;
    bool by_strain;  ///< the excess is a plastic strain
    double cumulated;
    Vector6d stress;
  };

  void add_cell(const StaticProblem& problem, int cell, const ElementField& stresses, const ElementField& variables);
  double limit(const Point& point, double wanted) const;

  const DofMap& dofs_;
  Assembler elastic_;  ///< as if nothing flowed
  Eigen::VectorXd rest_;
  std::vector<Point> points_;
};

}  // namespace comma::solver
