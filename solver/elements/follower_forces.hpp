// Loads that follow the body: pressures and forces on its deformed boundary (TYPE_CHARGE='SUIV', U4.51.03).
#pragma once

#include <span>
#include <vector>

#include <Eigen/Dense>
#include <Eigen/Sparse>

#include "solver/elements/cell_quadrature.hpp"
#include "solver/loads/load.hpp"
#include "solver/model/model.hpp"

namespace comma::solver {

/// Pressure p and shear q act as the traction -p n + q t on the boundary as it lies at the displacements u, whose
/// normal n, tangent t and measure they take (Bonet, Wood, "Nonlinear continuum mechanics for finite element analysis",
/// section 8.5). Functions take the initial place, and the deformed one where they are of that kind
/// (deformed_place.hpp). A distributed force keeps its direction and acts on the measure of the moved boundary; its
/// functions take the initial place. Axisymmetric loads are per radian of the deformed radius.
class FollowerForces {
 public:
  /// Keeps references to its arguments. Of the loads pressures and distributed forces on skin cells alone count. Throws
  /// what check_pressure() and check_distributed_force() throw (external_forces.hpp).
  FollowerForces(const Model& model, const DofMap& dofs, std::span<const AppliedLoad> loads);

  bool empty() const { return loads_.empty(); }
  void set_time(double time) { time_ = time; }

  /// Forces (one a degree of freedom) at the displacements u.
  Eigen::VectorXd at(const Eigen::VectorXd& u) const;
  /// Their derivatives by u (n x n), which are not symmetric; round an axis what the change of the radius adds is
  /// transposed, as in Code_Aster 17.3: iterations that a loose criterion ends end where they do there. The change of a
  /// pressure with the deformed place is a difference quotient.
  Eigen::SparseMatrix<double> tangent(const Eigen::VectorXd& u) const;

 private:
  struct Traction;
  struct SkinLoad;
  template <class Visit>
  void each_point(const Eigen::VectorXd& u, Visit&& visit) const;
  template <class Visit>
  void each_point_of(const SkinLoad& load, const Eigen::VectorXd& u, Visit&& visit) const;
  Traction traction(const SkinLoad& load, const CellSample& sample, const CellPoint& initial,
                    const CellPoint& now) const;
  Eigen::Vector3d pressure_gradient(const PressureLoad& load, double factor, const CellPoint& initial,
                                    const CellPoint& now) const;

  const Model& model_;
  const DofMap& dofs_;
  std::span<const AppliedLoad> loads_;
  double time_ = 0.0;
  mutable CellSamples samples_;
};

}  // namespace comma::solver
