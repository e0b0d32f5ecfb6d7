// When Newton's iterations may stop.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "solver/constraints/elimination.hpp"
#include "solver/elements/assembler.hpp"
#include "solver/nonlinear/static_analysis.hpp"

namespace comma::solver {

/// What a residual is measured against: the largest of the loads and of what they leave to supports and contact, the
/// size of the force of the command variables at the same unknown added (R5.03.01; 17.3 adds sizes, whatever the
/// signs). `variable_forces`: as Assembler::variable_forces() gives them.
double load_size(const Eigen::VectorXd& loads, const Eigen::VectorXd& internal, const Eigen::VectorXd& variable_forces);

/// Measures residuals beside forces where some rows are none: see Assembler::residual_weights().
class RowWeights {
 public:
  /// Those of the assembler's instant.
  void take(const Assembler& assembler, const Elimination& elimination);
  Eigen::VectorXd weighed(const Eigen::VectorXd& reduced_residual) const;
  /// The same of all degrees of freedom.
  Eigen::VectorXd weighed_all(const Eigen::VectorXd& residual) const;
  /// load_size() with weights.
  double load_size(const Eigen::VectorXd& loads, const Eigen::VectorXd& internal,
                   const Eigen::VectorXd& variable_forces) const;

 private:
  Eigen::VectorXd all_;  ///< empty: 1
  Eigen::VectorXd reduced_;
};

/// Residual against loads, both as the largest component over the degrees of freedom (R5.03.01, convergence criteria):
/// RESI_GLOB_RELA asks |R| <= r |L|, L the external forces with the reactions of supports and contact; RESI_GLOB_MAXI
/// asks |R| <= r; RESI_REFE_RELA asks |R_i| <= r F_i of each component, F_i its reference force; RESI_COMP_RELA asks it
/// of the largest residual and the largest internal force of each kind of component. Where the loads vanish a relative
/// test means nothing: the criterion then is absolute, as large a residual as the least loaded converged step would
/// have been allowed. A residual that is all rounding also passes the relative test: a body that moves freely has no
/// load but rounding to compare with.
class ConvergenceCriterion {
 public:
  explicit ConvergenceCriterion(const NewtonOptions& options) : options_(options) {}

  struct Measure {
    double absolute = 0.0;
    double relative = 0.0;  ///< -1 where the loads vanish
    bool converged = false;
    double excess = 0.0;  ///< by what factor the residual exceeds what is asked; at most 1 where it has converged
  };

  /// `residual` and `load`: the largest components, in force. `is_rounding`: no component exceeds what rounding makes
  /// of it. `referred`: the largest share that a component of the residual has of its reference force, read where
  /// RESI_REFE_RELA is given; `by_component`: that of RESI_COMP_RELA, nothing where no internal force is known yet:
  /// then the residual is measured against the loads.
  Measure measure(double residual, double load, bool is_rounding, double referred = 0.0,
                  std::optional<double> by_component = std::nullopt) const;

  /// Remembers the load of a converged step, or of the state that a computation begins with. One that has vanished is
  /// no measure of later ones.
  void accept(double load);

  /// The bodies have been in balance under such loads, in the step or before: of what is left where these have gone,
  /// contact that has been lost for instance, their rounding is no load.
  void take_up(double load) { largest_load_ = std::max(largest_load_, load); }

 private:
  bool has_vanished(double load) const;
  double relative_limit() const { return options_.relative_residual.value_or(default_relative_residual); }

  /// RESI_GLOB_RELA where the user gives neither criterion.
  static constexpr double default_relative_residual = 1e-6;
  /// Loads below this share of the smallest so far have vanished.
  static constexpr double vanishing_load = 1e-6;
  /// What rounding makes of loads that have gone, as a share of them.
  static constexpr double rounding_of_loads = 1e-13;
  /// Absolute limit (force) while no loaded step is known.
  static constexpr double default_absolute_residual = 1e-6;

  NewtonOptions options_;
  double smallest_load_ = -1.0;
  double largest_load_ = 0.0;
};

}  // namespace comma::solver
