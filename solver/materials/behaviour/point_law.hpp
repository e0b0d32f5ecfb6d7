// The law of one integration point that has a memory: kinematics, constitutive relation and plane stress put together.
#pragma once

#include <array>
#include <optional>
#include <span>

#include <Eigen/Dense>

#include "solver/materials/behaviour/restoration.hpp"
#include "solver/materials/behaviour/von_mises.hpp"
#include "solver/model/behaviour.hpp"

namespace comma::solver {

/// No relation has more internal variables.
inline constexpr int most_variables = 16;

/// A point where the step began.
struct PointPast {
  Eigen::Matrix3d gradient = Eigen::Matrix3d::Zero();  ///< H = du / dX
  /// Of the law's own strain: Cauchy's, T of the logarithm, or the second Piola-Kirchhoff.
  Vector6d stress = Vector6d::Zero();
  Vector6d inelastic = Vector6d::Zero();  ///< strain of the command variables
  PlasticModuli moduli;
  std::array<double, most_variables> variables{};
  double flow = 0.0;  ///< by how much the cumulated plastic strain grew in the last step
};

/// What there is now. `inelastic`, `constants`: of the command variables of the moment.
struct PointInput {
  const Eigen::Matrix3d& gradient;
  const Vector6d& inelastic;
  const PlasticPoint& constants;
  const PointPast& past;
  bool begins = false;  ///< nothing has moved yet: see PointLaw::begin
};

struct PointResponse {
  /// Whose work on the strain is that of the forces: in large strains the second Piola-Kirchhoff stress.
  Vector6d stress;
  Matrix6d tangent;   ///< its derivative by the (Green-Lagrange) strain; PointLaw::is_symmetric
  Vector6d reported;  ///< the stress that results show: Cauchy's in large strains, in plane stress on the thickness as
                      ///< it has become by logarithmic strains, on the initial one by Green and Lagrange's
  Vector6d own = Vector6d::Zero();  ///< the stress of the law's own strain, which the next step begins with
  std::array<double, most_variables> variables{};
};

class PointLaw {
 public:
  /// `in_plane`: without stress across the plane. Throws Error `unsupported` for what does not go together: the
  /// multiplicative split with plane stress or with kinematic hardening, rubber with other strains than Green and
  /// Lagrange's, hardening that is restored and is not that of VMIS_ISOT_LINE, VMIS_ISOT_TRAC or VMIS_ECMI_LINE.
  PointLaw(const CellBehaviour& behaviour, bool in_plane);

  /// Large strains have their forces on the deformed, small ones on the initial geometry.
  bool is_large() const { return behaviour_.kinematics != Kinematics::small; }
  /// Whether the tangent of displacements has what the stress adds when the strain's variation turns, and what that of
  /// hoops round an axis adds. Code_Aster 17.3 leaves out both with PETIT_REAC, the second but with SIMO_MIEHE: with
  /// the same tangents, iterations that a loose criterion ends end where they do there.
  bool has_geometric_part() const { return is_large() && behaviour_.kinematics != Kinematics::updated; }
  bool has_hoop_part() const { return behaviour_.kinematics == Kinematics::multiplicative; }
  /// Whether the tangent is symmetric. That of the multiplicative split is not: what flows has no potential there.
  bool is_symmetric() const { return behaviour_.kinematics != Kinematics::multiplicative; }
  /// Whether the tangent never changes.
  bool is_linear() const { return !is_large() && behaviour_.relation == Relation::elastic; }
  Relation relation() const { return behaviour_.relation; }
  bool restores_hardening() const { return behaviour_.restores_hardening; }

  /// Internal variables V1, V2 ...: the cumulated plastic strain and the indicator of flow (1 or 0) of isotropic
  /// hardening, by saturating exponentials the six plastic strains as well (not with the multiplicative split), and in
  /// plane stress and small strains the strain across the plane; the six of the back stress and the indicator of
  /// kinematic hardening; cumulated strain, indicator and back stress of both together; one zero of elasticity
  /// (U4.51.11). Logarithmic strains add the six components of their stress T, the multiplicative split those of (I -
  /// b) / 2, b the whole elastic part (J^(2/3) that of determinant 1). Behind all others stands the cumulated strain
  /// before the hardening was restored.
  int variable_count() const;

  /// Throws Error `integration-failure`, `out-of-function`.
  PointResponse respond(const PointInput& input) const;
  /// The same as if nothing could flow from here on.
  PointResponse respond_elastically(const PointInput& input) const;

  /// The same for a point where a step begins: what has flowed goes on flowing, and what the command variables have
  /// changed is taken up elastically (begin_von_mises). Where the point has moved already, or is of the multiplicative
  /// split, as respond().
  PointResponse begin(const PointInput& input) const;
  /// The same in large strains, where what the command variables have changed pushes on the initial geometry
  /// (change_of_variables()): the stress is as it was, and so is what it adds to the tangent.
  PointResponse begin_as_it_was(const PointInput& input) const;
  /// What they have changed of the stress (as PointResponse::stress, on the initial geometry); zero where
  /// begin_as_it_was() is respond().
  Vector6d change_of_variables(const PointInput& input) const;
  /// The stress (as PointResponse::stress) that FORC_NODA has of a response, and from which Code_Aster 17.3 begins a
  /// step: in plane stress with logarithmic strains that of the results on the initial thickness, else the response's.
  Vector6d stress_of_results(const Eigen::Matrix3d& gradient, const PointResponse& response) const;
  /// The stress (as PointResponse::stress) with which the elastic material would hold up the strain of the command
  /// variables.
  Vector6d stress_of_variables(const PointInput& input) const { return held_up(input.constants, input.inelastic); }

  /// The same as respond() for a point that goes on as in the last step, flowing where it flowed, `ratio` times as
  /// much: linear in the strain (R5.03.81; after Oliver, Huespe and Cante, Computer Methods in Applied Mechanics and
  /// Engineering 197, 2008). Throws Error `unsupported` but for elasticity and isotropic hardening in small strains,
  /// without plane stress, that is not restored.
  PointResponse respond_extrapolated(const PointInput& input, double ratio) const;
  /// Takes away of what has been reached what annealing does in a step of length `time`, at whose end the point is
  /// `at`. Throws what restored() does.
  void restore(const HardeningRestoration& restoration, const MaterialPoint& at, double time, const PointPast& past,
               PointResponse& response) const;

  /// By how much the cumulated plastic strain has grown; 0 for laws without one.
  double flow_between(const std::array<double, most_variables>& before,
                      const std::array<double, most_variables>& after) const;

  /// The law's own stress at a point that has a gradient, moduli and, if `has_variables`, variables, from the stress
  /// that results show.
  Vector6d own_stress(const PointPast& past, const Vector6d& reported, bool has_variables) const;

  /// The same where a computation begins, without stresses or with those that it is given. As in Code_Aster 17.3, the
  /// stress of VMIS_ISOT_NL follows from the whole strain less the plastic one among the variables whatever is given,
  /// and so does that of elasticity, of small or logarithmic strains, where none is; other laws begin with none.
  Vector6d first_stress(const PointPast& past, const std::optional<Vector6d>& reported, bool has_variables) const;

  /// The elastic energy for an initial volume of a point with its gradient, own stress and variables.
  double elastic_energy(const PointPast& at, const PlasticPoint& constants) const;

 private:
  bool is_start(const PointInput& input) const;
  bool flows_on() const;
  Vector6d held_up(const PlasticModuli& moduli, const Vector6d& inelastic) const;
  bool has_whole_strain(bool is_given) const;
  Vector6d strain_of(const Eigen::Matrix3d& gradient) const;
  PointResponse respond_with(const PointInput& input, const PlasticPoint& now) const;
  int own_count() const;
  PlasticState state_of(const PointPast& past) const;
  void write(const PlasticState& state, PointResponse& response) const;
  bool keeps_plastic_strain() const;
  bool keeps_strain_across() const;
  void write_plastic_strain(const PointInput& input, const Vector6d& increment, const PlasticState& state,
                            PointResponse& response) const;
  Vector6d since_last(const PointInput& input, Vector6d (*strain)(const Eigen::Matrix3d&)) const;
  PlasticResponse integrate(const PointInput& input, const PlasticPoint& now, const Vector6d& increment) const;
  PointResponse green(const PointInput& input, const PlasticPoint& now) const;
  PointResponse rubber(const PointInput& input, const PlasticPoint& now) const;
  PointResponse small(const PointInput& input, const PlasticPoint& now) const;
  PointResponse updated(const PointInput& input, const PlasticPoint& now) const;
  PointResponse logarithmic(const PointInput& input, const PlasticPoint& now) const;
  PointResponse multiplicative(const PointInput& input, const PlasticPoint& now) const;

  CellBehaviour behaviour_;
  bool in_plane_;
};

}  // namespace comma::solver
