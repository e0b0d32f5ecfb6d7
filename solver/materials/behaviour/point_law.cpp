#include "solver/materials/behaviour/point_law.hpp"

#include "solver/error.hpp"
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

}  // namespace

PointLaw::PointLaw(const CellBehaviour& behaviour, bool in_plane) : behaviour_(behaviour), in_plane_(in_plane) {
  if (behaviour.kinematics != Kinematics::multiplicative) return;
  if (in_plane) throw Error("unsupported", "the multiplicative split of strains is not known in plane stress", "take DEFORMATION='GDEF_LOG'");
  if (own_count() > 2) throw Error("unsupported", "the multiplicative split of strains goes with isotropic hardening only", "take DEFORMATION='GDEF_LOG'");
}

int PointLaw::own_count() const {
  switch (behaviour_.relation) {
    case Relation::elastic: return 1;
    case Relation::kinematic_linear: return tensor_size + 1;
    case Relation::mixed_linear:
    case Relation::mixed_traction: return 2 + tensor_size;
    default: return 2;
  }
}

int PointLaw::variable_count() const {
  return own_count() + (is_large() ? tensor_size : 0);
}

PlasticState PointLaw::state_of(const PointPast& past) const {
  PlasticState state;
  state.stress = past.stress;
  const auto& v = past.variables;
  switch (behaviour_.relation) {
    case Relation::elastic: break;
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
    case Relation::elastic: break;
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
      v[1] = state.flowing ? 1.0 : 0.0;
  }
}

PlasticResponse PointLaw::integrate(const PointPast& past, const PlasticPoint& now, const Vector6d& increment) const {
  PlasticState state = state_of(past);
  if (behaviour_.kinematics == Kinematics::logarithmic) state.stress = Eigen::Map<const Vector6d>(past.variables.data() + own_count());
  return in_plane_ ? integrate_von_mises_in_plane(past.moduli, now, state, increment) : integrate_von_mises(past.moduli, now, state, increment);
}

PointResponse PointLaw::small(const PointInput& input, const PlasticPoint& now) const {
  const Vector6d increment = small_strain(input.gradient) - small_strain(input.past.gradient) - (input.inelastic - input.past.inelastic);
  const PlasticResponse result = integrate(input.past, now, increment);
  PointResponse response{result.state.stress, result.tangent, result.state.stress, {}};
  write(result.state, response);
  return response;
}

PointResponse PointLaw::logarithmic(const PointInput& input, const PlasticPoint& now) const {
  const LogarithmicStrain strain(input.gradient);
  const Vector6d increment = strain.strain() - LogarithmicStrain(input.past.gradient).strain() - (input.inelastic - input.past.inelastic);
  const PlasticResponse result = integrate(input.past, now, increment);
  const Vector6d& t = result.state.stress;
  PointResponse response{strain.second_stress(t), strain.second_tangent(result.tangent, t), Vector6d::Zero(), {}};
  response.reported = cauchy_stress(input.gradient, response.stress);
  write(result.state, response);
  Eigen::Map<Vector6d>(response.variables.data() + own_count()) = t;
  return response;
}

PointResponse PointLaw::multiplicative(const PointInput& input, const PlasticPoint& now) const {
  const PlasticState past = state_of(input.past);
  const Eigen::Map<const Vector6d> compression(input.past.variables.data() + own_count());
  const MultiplicativeState state{Eigen::Matrix3d::Identity() - 2.0 * tensor_of_stress(compression), past.p, past.flowing};
  const MultiplicativeResponse result = integrate_multiplicative(now, state, input.past.gradient, input.gradient, input.inelastic[0]);
  PointResponse response{result.stress, result.tangent, cauchy_stress(input.gradient, result.stress), {}};
  PlasticState reached;
  reached.p = result.state.p;
  reached.flowing = result.state.flowing;
  write(reached, response);
  Eigen::Map<Vector6d>(response.variables.data() + own_count()) =
      components_of_stress(0.5 * (Eigen::Matrix3d::Identity() - result.state.elastic));
  return response;
}

PointResponse PointLaw::respond_with(const PointInput& input, const PlasticPoint& now) const {
  if (behaviour_.kinematics == Kinematics::multiplicative) return multiplicative(input, now);
  return behaviour_.kinematics == Kinematics::logarithmic ? logarithmic(input, now) : small(input, now);
}

void PointLaw::take_stress(PointPast& past, bool has_variables) const {
  if (behaviour_.kinematics != Kinematics::logarithmic || has_variables) return;
  const LogarithmicStrain strain(past.gradient);
  Eigen::Map<Vector6d>(past.variables.data() + own_count()) = strain.stress_of(second_stress_of(past.gradient, past.stress));
}

PointResponse PointLaw::respond(const PointInput& input) const { return respond_with(input, input.constants); }

PointResponse PointLaw::respond_elastically(const PointInput& input) const {
  const PlasticPoint elastic{input.constants, NoYield{}};
  return respond_with(input, elastic);
}

}  // namespace comma::solver
