#include "solver/materials/behaviour/point_law.hpp"

#include <cmath>

#include "solver/error.hpp"
#include "solver/materials/behaviour/hyperelastic.hpp"
#include "solver/materials/behaviour/large_strain.hpp"
#include "solver/materials/behaviour/logarithmic_strain.hpp"
#include "solver/materials/behaviour/multiplicative.hpp"

namespace comma::solver {

namespace {

constexpr int tensor_size = 6;

Vector6d small_strain(const Eigen::Matrix3d& h) {
  Vector6d strain;
  strain << h(0, 0), h(1, 1), h(2, 2), h(0, 1) + h(1, 0), h(0, 2) + h(2, 0), h(1, 2) + h(2, 1);
  return strain;
}

/// The same in all directions.
bool is_spherical(const Vector6d& strain) {
  return strain[0] == strain[1] && strain[1] == strain[2] && strain.tail<3>().isZero(0.0);
}

/// Whether the centre of the yield surface moves.
bool moves(Relation relation) {
  return relation == Relation::kinematic_linear || relation == Relation::mixed_linear ||
         relation == Relation::mixed_traction;
}

/// As tensor components.
Vector6d elastic_strain(const Vector6d& stress, const PlasticModuli& moduli) {
  const double pressure = stress.head<3>().sum() / 3.0;
  Vector6d strain = stress;
  strain.head<3>().array() -= pressure;
  strain /= 2.0 * moduli.shear;
  strain.head<3>().array() += pressure / (3.0 * moduli.bulk);
  return strain;
}

bool keeps_tensor(Kinematics kinematics) {
  return kinematics == Kinematics::logarithmic || kinematics == Kinematics::multiplicative;
}

/// The energy behind the pressure of the multiplicative split, e being the thermal expansion.
double volume_energy(double bulk, double expansion, double j) {
  return 0.5 * bulk * (0.5 * (j * j - 1.0) - std::log(j)) - 1.5 * bulk * expansion * (j - 1.0 / j);
}

/// Where that pressure vanishes: J (J^2 - 1) = 3 e (J^2 + 1).
double free_volume(double expansion) {
  double j = 1.0;
  constexpr int rounds = 20;  // from 1 on, expansions being small: more than enough
  for (int round = 0; round < rounds; ++round)
    j -= (j * (j * j - 1.0) - 3.0 * expansion * (j * j + 1.0)) / (3.0 * j * j - 1.0 - 6.0 * expansion * j);
  return j;
}

/// b of determinant 1 out of the variables (I - b) / 2 of the whole elastic part.
Eigen::Matrix3d elastic_part(const double* variables) {
  const Eigen::Matrix3d b =
      Eigen::Matrix3d::Identity() - 2.0 * tensor_of_stress(Vector6d(Eigen::Map<const Vector6d>(variables)));
  return b / std::cbrt(b.determinant());
}

/// The strain across the plane in plane stress: all volume is elastic or thermal.
double strain_across(const Vector6d& strain, const Vector6d& stress, const Vector6d& inelastic,
                     const PlasticModuli& now) {
  return stress.head<3>().sum() / (3.0 * now.bulk) + inelastic.head<3>().sum() - strain[0] - strain[1];
}

/// Green and Lagrange's, with shear angles.
Vector6d green_strain(const Eigen::Matrix3d& h) {
  Vector6d strain = components_of_stress(green_lagrange_strain(h));
  strain.tail<3>() *= 2.0;
  return strain;
}

}  // namespace

PointLaw::PointLaw(const CellBehaviour& behaviour, bool in_plane) : behaviour_(behaviour), in_plane_(in_plane) {
  if (behaviour.relation == Relation::asymmetric_linear)
    throw Error("unsupported", "hardening apart in tension and in compression is a law of bars",
                "give RELATION='VMIS_ASYM_LINE' to groups of bars alone");
  if (behaviour.relation == Relation::hyperelastic) {
    if (behaviour.kinematics != Kinematics::green_lagrange)
      throw Error("unsupported", "rubber has large strains on the initial geometry",
                  "take DEFORMATION='GREEN_LAGRANGE'");
  }
  if (is_reversible(behaviour.relation) && behaviour.kinematics != Kinematics::small &&
      behaviour.kinematics != Kinematics::green_lagrange)
    throw Error("unsupported", "elasticity along a curve of hardening has small strains, or Green and Lagrange's",
                "take DEFORMATION='PETIT' or 'GREEN_LAGRANGE'");
  if (behaviour.restores_hardening && !may_be_restored(behaviour.relation))
    throw Error("unsupported",
                "POST_INCR='REST_ECRO' restores the hardening of VMIS_ISOT_LINE, VMIS_ISOT_TRAC and "
                "VMIS_ECMI_LINE alone",
                "take one of these relations, or leave POST_INCR out");
  if (behaviour.kinematics != Kinematics::multiplicative) return;
  if (in_plane)
    throw Error("unsupported", "the multiplicative split of strains is not known in plane stress",
                "take DEFORMATION='GDEF_LOG'");
  if (moves(behaviour.relation))
    throw Error("unsupported", "the multiplicative split of strains goes with isotropic hardening only",
                "take DEFORMATION='GDEF_LOG'");
}

int PointLaw::own_count() const {
  switch (behaviour_.relation) {
    case Relation::elastic:
    case Relation::hyperelastic:
    case Relation::reversible_linear:
    case Relation::reversible_traction:
    case Relation::reversible_power:
      return 1;
    case Relation::kinematic_linear:
      return tensor_size + 1;
    case Relation::mixed_linear:
    case Relation::mixed_traction:
      return 2 + tensor_size;
    case Relation::isotropic_nonlinear:
      return keeps_plastic_strain() ? 2 + tensor_size + (keeps_strain_across() ? 1 : 0) : 2;
    default:
      return 2;
  }
}

// Code_Aster's VMIS_ISOT_NL alone shows it (U4.51.11); of the multiplicative split it is no sum of strains.
bool PointLaw::keeps_plastic_strain() const {
  return behaviour_.relation == Relation::isotropic_nonlinear && behaviour_.kinematics != Kinematics::multiplicative;
}

// In small strains alone: Code_Aster has VMIS_ISOT_NL in plane stress by De Borst's method, which keeps it, and refuses
// it with GDEF_LOG.
bool PointLaw::keeps_strain_across() const {
  return behaviour_.relation == Relation::isotropic_nonlinear && in_plane_ && has_small_strains(behaviour_.kinematics);
}

int PointLaw::variable_count() const {
  return own_count() + (keeps_tensor(behaviour_.kinematics) ? tensor_size : 0) + (restores_hardening() ? 1 : 0);
}

PlasticState PointLaw::state_of(const PointPast& past) const {
  PlasticState state;
  if (is_reversible(behaviour_.relation)) return state;
  state.stress = past.stress;
  const auto& v = past.variables;
  switch (behaviour_.relation) {
    case Relation::elastic:
    case Relation::hyperelastic:
      break;
    case Relation::kinematic_linear:
      state.back_stress = Eigen::Map<const Vector6d>(v.data());
      state.flowing = v[tensor_size] > 0.5;
      break;
    case Relation::mixed_linear:
    case Relation::mixed_traction:
      state.back_stress = Eigen::Map<const Vector6d>(v.data() + 2);
      [[fallthrough]];
    default:
      state.p = v[0];
      state.flowing = v[1] > 0.5;
  }
  return state;
}

void PointLaw::write(const PlasticState& state, PointResponse& response) const {
  auto& v = response.variables;
  switch (behaviour_.relation) {
    case Relation::elastic:
    case Relation::hyperelastic:
      break;
    case Relation::kinematic_linear:
      Eigen::Map<Vector6d>(v.data()) = state.back_stress;
      v[tensor_size] = state.flowing ? 1.0 : 0.0;
      break;
    case Relation::mixed_linear:
    case Relation::mixed_traction:
      Eigen::Map<Vector6d>(v.data() + 2) = state.back_stress;
      [[fallthrough]];
    default:
      v[0] = state.p;
      if (!is_reversible(behaviour_.relation)) v[1] = state.flowing ? 1.0 : 0.0;
  }
}

void PointLaw::write_plastic_strain(const PointInput& input, const Vector6d& increment, const PlasticState& state,
                                    PointResponse& response) const {
  if (!keeps_plastic_strain()) return;
  if (keeps_strain_across()) {
    const Vector6d total = small_strain(input.gradient);
    response.variables[2 + tensor_size] = strain_across(total, state.stress, input.inelastic, input.constants);
  }
  const Eigen::Map<const Vector6d> before(input.past.variables.data() + 2);
  Eigen::Map<Vector6d> plastic(response.variables.data() + 2);
  plastic = before;
  if (!(state.p > input.past.variables[0])) return;
  const PlasticModuli& first = input.past.moduli.shear != 0.0 ? input.past.moduli : input.constants;
  Vector6d change = increment;
  change.tail<3>() *= 0.5;
  change -= elastic_strain(state.stress, input.constants) - elastic_strain(input.past.stress, first);
  if (in_plane_) change[2] = -change[0] - change[1];
  plastic += change;
}

PlasticResponse PointLaw::integrate(const PointInput& input, const PlasticPoint& now, const Vector6d& increment) const {
  const PointPast& past = input.past;
  const PlasticState state = state_of(past);
  if (input.begins)
    return (in_plane_ ? begin_von_mises_in_plane : begin_von_mises)(past.moduli, now, state, past.inelastic,
                                                                    input.inelastic);
  if (!in_plane_) return integrate_von_mises(past.moduli, now, state, increment);
  return integrate_von_mises_in_plane(past.moduli, now, state, increment,
                                      is_reversible(behaviour_.relation) ? 0.0 : behaviour_.return_tolerance);
}

/// The strain that the law sees, less that of the command variables: of what is reversible the whole one.
Vector6d PointLaw::since_last(const PointInput& input, Vector6d (*strain)(const Eigen::Matrix3d&)) const {
  const Vector6d now = strain(input.gradient) - input.inelastic;
  return is_reversible(behaviour_.relation) ? now : now - (strain(input.past.gradient) - input.past.inelastic);
}

PointResponse PointLaw::small(const PointInput& input, const PlasticPoint& now) const {
  const Vector6d increment = since_last(input, small_strain);
  const PlasticResponse result = integrate(input, now, increment);
  const Vector6d& stress = result.state.stress;
  PointResponse response{stress, result.tangent, stress, stress, {}};
  write(result.state, response);
  write_plastic_strain(input, increment, result.state, response);
  return response;
}

/// The tangent leaves out how the geometry changes the strain itself, which is of the order of the stresses over the
/// moduli.
PointResponse PointLaw::updated(const PointInput& input, const PlasticPoint& now) const {
  const Eigen::Matrix3d back = deformation_gradient(input.gradient).inverse();
  const Eigen::Matrix3d moved = (input.gradient - input.past.gradient) * back;
  const Vector6d increment = small_strain(moved) - (input.inelastic - input.past.inelastic);
  const PlasticResponse result = integrate(input, now, increment);
  const Vector6d& stress = result.state.stress;
  PointResponse response{second_stress_of(input.gradient, stress), Matrix6d::Zero(), stress, stress, {}};
  for (int k = 0; k < tensor_size; ++k) {
    Vector6d strain = Vector6d::Unit(k);
    strain.tail<3>() *= 0.5;
    const Eigen::Matrix3d spatial = back.transpose() * tensor_of_stress(strain) * back;
    Vector6d components = components_of_stress(spatial);
    components.tail<3>() *= 2.0;
    response.tangent.col(k) = second_stress_of(input.gradient, result.tangent * components);
  }
  write(result.state, response);
  write_plastic_strain(input, increment, result.state, response);
  return response;
}

PointResponse PointLaw::logarithmic(const PointInput& input, const PlasticPoint& now) const {
  const LogarithmicStrain strain(input.gradient);
  const Vector6d increment =
      strain.strain() - LogarithmicStrain(input.past.gradient).strain() - (input.inelastic - input.past.inelastic);
  const PlasticResponse result = integrate(input, now, increment);
  const Vector6d& t = result.state.stress;
  PointResponse response{strain.second_stress(t), strain.second_tangent(result.tangent, t), Vector6d::Zero(), t, {}};
  response.reported = cauchy_stress(input.gradient, response.stress);
  // As Code_Aster 17.3 has it, the thickness does not expand with the strains of command variables.
  if (in_plane_) response.reported /= std::exp(strain_across(strain.strain(), t, Vector6d::Zero(), now));
  write(result.state, response);
  write_plastic_strain(input, increment, result.state, response);
  Eigen::Map<Vector6d>(response.variables.data() + own_count()) = t;
  return response;
}

PointResponse PointLaw::multiplicative(const PointInput& input, const PlasticPoint& now) const {
  if (!is_spherical(input.inelastic)) {
    throw Error("unsupported",
                "the multiplicative split of strains takes up an expansion alike in all directions alone, not this "
                "strain that is known beforehand",
                "take DEFORMATION='GDEF_LOG'");
  }
  const PlasticState past = state_of(input.past);
  const MultiplicativeState state{elastic_part(input.past.variables.data() + own_count()), past.p, past.flowing};
  const MultiplicativeResponse result =
      integrate_multiplicative(now, state, input.past.gradient, input.gradient, input.inelastic[0]);
  PointResponse response{
      result.stress, result.tangent, cauchy_stress(input.gradient, result.stress), result.stress, {}};
  PlasticState reached;
  reached.p = result.state.p;
  reached.flowing = result.state.flowing;
  write(reached, response);
  const double volume = std::cbrt(deformation_gradient(input.gradient).determinant());
  Eigen::Map<Vector6d>(response.variables.data() + own_count()) =
      components_of_stress(0.5 * (Eigen::Matrix3d::Identity() - volume * volume * result.state.elastic));
  return response;
}

PointResponse PointLaw::respond_with(const PointInput& input, const PlasticPoint& now) const {
  if (behaviour_.relation == Relation::hyperelastic) return rubber(input, now);
  switch (behaviour_.kinematics) {
    case Kinematics::green_lagrange:
      return green(input, now);
    case Kinematics::logarithmic:
      return logarithmic(input, now);
    case Kinematics::multiplicative:
      return multiplicative(input, now);
    case Kinematics::updated:
      return updated(input, now);
    default:
      return small(input, now);
  }
}

Vector6d PointLaw::own_stress(const PointPast& past, const Vector6d& reported, bool has_variables) const {
  switch (behaviour_.kinematics) {
    case Kinematics::small:
    case Kinematics::large_rotations:  // of beams
    case Kinematics::updated:
      return reported;
    case Kinematics::green_lagrange:
      return second_stress_of(past.gradient, reported);
    case Kinematics::logarithmic:
      if (has_variables) return Eigen::Map<const Vector6d>(past.variables.data() + own_count());
      return LogarithmicStrain(past.gradient).stress_of(second_stress_of(past.gradient, reported));
    case Kinematics::multiplicative:
      return Vector6d::Zero();
  }
  return reported;
}

bool PointLaw::has_whole_strain(bool is_given) const {
  if (behaviour_.kinematics == Kinematics::updated) return false;
  if (keeps_plastic_strain()) return true;
  const bool is_of_strains =
      behaviour_.kinematics == Kinematics::small || behaviour_.kinematics == Kinematics::logarithmic;
  return behaviour_.relation == Relation::elastic && is_of_strains && !is_given;
}

Vector6d PointLaw::strain_of(const Eigen::Matrix3d& gradient) const {
  if (behaviour_.kinematics == Kinematics::logarithmic) return LogarithmicStrain(gradient).strain();
  return behaviour_.kinematics == Kinematics::green_lagrange ? green_strain(gradient) : small_strain(gradient);
}

Vector6d PointLaw::first_stress(const PointPast& past, const std::optional<Vector6d>& reported,
                                bool has_variables) const {
  if (has_whole_strain(reported.has_value())) {
    Vector6d elastic = strain_of(past.gradient) - past.inelastic;
    if (keeps_plastic_strain()) {
      const Eigen::Map<const Vector6d> plastic(past.variables.data() + 2);
      elastic.head<3>() -= plastic.head<3>();
      elastic.tail<3>() -= 2.0 * plastic.tail<3>();
    }
    return held_up(past.moduli, elastic);
  }
  if (!reported && !has_variables) return Vector6d::Zero();
  return own_stress(past, reported.value_or(Vector6d::Zero()), has_variables);
}

double PointLaw::elastic_energy(const PointPast& at, const PlasticPoint& constants) const {
  if (behaviour_.relation == Relation::hyperelastic)
    return hyperelastic_energy(
        *constants.hyperelasticity,
        in_plane_ ? gradient_in_plane_stress(*constants.hyperelasticity, at.gradient) : at.gradient);
  if (behaviour_.kinematics == Kinematics::multiplicative) {
    const double j = deformation_gradient(at.gradient).determinant();
    const double rest = free_volume(at.inelastic[0]);
    const double stretch = elastic_part(at.variables.data() + own_count()).trace() - 3.0;
    return volume_energy(constants.bulk, at.inelastic[0], j) - volume_energy(constants.bulk, at.inelastic[0], rest) +
           0.5 * constants.shear * stretch;
  }
  const double pressure = at.stress.head<3>().sum() / 3.0;
  Vector6d deviator = at.stress;
  deviator.head<3>().array() -= pressure;
  const double square = deviator.head<3>().squaredNorm() + 2.0 * deviator.tail<3>().squaredNorm();
  return 0.25 * square / constants.shear + 0.5 * pressure * pressure / constants.bulk;
}

PointResponse PointLaw::green(const PointInput& input, const PlasticPoint& now) const {
  const Vector6d increment = since_last(input, green_strain);
  deformation_gradient(input.gradient);  // which must not be turned inside out
  const PlasticResponse result = integrate(input, now, increment);
  const Vector6d& stress = result.state.stress;
  PointResponse response{stress, result.tangent, cauchy_stress(input.gradient, stress), stress, {}};
  write(result.state, response);
  write_plastic_strain(input, increment, result.state, response);
  return response;
}

PointResponse PointLaw::rubber(const PointInput& input, const PlasticPoint& now) const {
  if (!input.inelastic.isZero(0.0)) throw Error("unsupported", "rubber takes up no strain of the command variables");
  const Eigen::Matrix3d gradient =
      in_plane_ ? gradient_in_plane_stress(*now.hyperelasticity, input.gradient) : input.gradient;
  HyperelasticResponse result = hyperelastic_response(*now.hyperelasticity, gradient);
  if (in_plane_) {
    constexpr int across = 2;
    result.stress[across] = 0.0;
    result.tangent -= (result.tangent.col(across) * result.tangent.row(across) / result.tangent(across, across)).eval();
  }
  return {result.stress, result.tangent, cauchy_stress(input.gradient, result.stress), result.stress, {}};
}

PointResponse PointLaw::respond(const PointInput& input) const { return respond_with(input, input.constants); }

PointResponse PointLaw::respond_elastically(const PointInput& input) const {
  PlasticPoint elastic{input.constants, NoYield{}};
  elastic.hyperelasticity = input.constants.hyperelasticity;
  return respond_with(input, elastic);
}

/// Whether nothing has moved since the step began but what the command variables say.
bool PointLaw::is_start(const PointInput& input) const {
  const PointPast& past = input.past;
  const bool has_changed = input.inelastic != past.inelastic || input.constants.shear != past.moduli.shear ||
                           input.constants.bulk != past.moduli.bulk;
  return behaviour_.relation != Relation::hyperelastic && has_changed && past.moduli.shear != 0.0 &&
         input.gradient == past.gradient;
}

bool PointLaw::flows_on() const {
  return !is_reversible(behaviour_.relation) && behaviour_.kinematics != Kinematics::multiplicative;
}

PointResponse PointLaw::begin(const PointInput& input) const {
  if (!is_start(input) || !flows_on()) return respond(input);
  PointInput beginning = input;
  beginning.begins = true;
  return respond(beginning);
}

PointResponse PointLaw::begin_as_it_was(const PointInput& input) const {
  if (!is_start(input)) return respond(input);
  PointPast past = input.past;
  if (flows_on()) past.inelastic.setZero();  // of an equal strain before and now nothing changes the stress
  return respond({input.gradient, past.inelastic, input.constants, past, flows_on()});
}

Vector6d PointLaw::change_of_variables(const PointInput& input) const {
  if (!is_start(input)) return Vector6d::Zero();
  return held_up(input.past.moduli, input.past.inelastic) - stress_of_variables(input);
}

Vector6d PointLaw::held_up(const PlasticModuli& moduli, const Vector6d& inelastic) const {
  if (behaviour_.relation == Relation::hyperelastic || inelastic.isZero(0.0)) return Vector6d::Zero();
  return (in_plane_ ? elastic_stress_in_plane : elastic_stress)(moduli, inelastic);
}

Vector6d PointLaw::stress_of_results(const Eigen::Matrix3d& gradient, const PointResponse& response) const {
  const bool thins = in_plane_ && behaviour_.kinematics == Kinematics::logarithmic;
  return thins ? second_stress_of(gradient, response.reported) : response.stress;
}

void PointLaw::restore(const HardeningRestoration& restoration, const MaterialPoint& at, double time,
                       const PointPast& past, PointResponse& response) const {
  const auto before = static_cast<std::size_t>(variable_count() - 1);
  const Hardened left = restored(restoration, at, time, {response.variables[0], past.variables[before]});
  response.variables[0] = left.strain;
  response.variables[before] = left.before;
}

double PointLaw::flow_between(const std::array<double, most_variables>& before,
                              const std::array<double, most_variables>& after) const {
  return own_count() == 2 ? after[0] - before[0] : 0.0;
}

/// A point that has flowed in the last step goes on along the normal that it has, by the tangent of the flow itself: C
/// - 9 mu^2 / (3 mu + R') s s^T / s_eq^2 with the deviator s where the step begins.
PointResponse PointLaw::respond_extrapolated(const PointInput& input, double ratio) const {
  const bool is_known = behaviour_.relation == Relation::elastic || (own_count() == 2 && !in_plane_);
  if (!is_known || is_large() || restores_hardening())
    throw Error("unsupported",
                "METHODE='IMPLEX' extrapolates ELAS, VMIS_ISOT_LINE, VMIS_ISOT_TRAC and VMIS_ISOT_PUIS in small "
                "strains alone, without POST_INCR, and not in plane stress",
                "take METHODE='NEWTON'");
  PointResponse response = respond_elastically(input);
  if (behaviour_.relation == Relation::elastic || !(input.past.flow > 0.0)) return response;
  Vector6d deviator = input.past.stress;
  deviator.head<3>().array() -= deviator.head<3>().mean();
  Vector6d normal = deviator;  // with shear angles
  normal.tail<3>() *= 2.0;
  const double shear = input.constants.shear;
  const double slope = hardening(input.constants.curve, input.past.variables[0] + ratio * input.past.flow).second;
  const double equivalent = std::sqrt(1.5 * deviator.dot(normal));
  const Matrix6d kept = Matrix6d::Identity() -
                        4.5 * shear / ((3.0 * shear + slope) * equivalent * equivalent) * deviator * normal.transpose();
  response.stress = input.past.stress + kept * (response.stress - input.past.stress);
  response.tangent = kept * response.tangent;
  response.reported = response.own = response.stress;
  return response;
}

}  // namespace comma::solver
