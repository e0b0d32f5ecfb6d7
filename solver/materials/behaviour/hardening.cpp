#include "solver/materials/behaviour/hardening.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "solver/error.hpp"

namespace comma::solver {

namespace {

/// The first point of a traction curve must lie on the elastic line, within this share of its strain: measured curves
/// have few digits.
constexpr double elastic_line_share = 0.02;

double plastic_modulus(double young, double slope) {
  if (!(slope < young)) {
    throw Error("invalid-material",
                fmt::format("the slope of the hardening is {}, but must be less than Young's modulus {}", slope, young),
                "D_SIGM_EPSI is the slope of the traction curve, over the total strain");
  }
  return slope / (1.0 - slope / young);  // young * slope would overflow before the modulus, which is above -young, does
}

/// Below the first point the first piece goes on.
std::pair<double, double> on_piece(const PiecewiseCurve& curve, double p) {
  const auto& points = curve.points;
  const auto next =
      std::upper_bound(points.begin(), points.end(), p, [](double at, const auto& point) { return at < point.first; });
  if (next == points.end() || points.size() == 1) {
    if (curve.ends && p > points.back().first) {
      throw Error("out-of-function",
                  fmt::format("the plastic strain reaches {:.6g}, beyond the last point ({:.6g}) of the traction curve",
                              p, points.back().first),
                  "give more points, or say how the curve goes on (PROL_DROITE)");
    }
    return {points.back().second + curve.last_slope * (p - points.back().first), curve.last_slope};
  }
  const auto& from = next == points.begin() ? *next : *(next - 1);
  const auto& to = next == points.begin() ? *(next + 1) : *next;
  const double slope = (to.second - from.second) / (to.first - from.first);
  return {from.second + slope * (p - from.first), slope};
}

std::pair<double, double> on_power(const PowerCurve& curve, double p) {
  if (!(p > 0.0)) return {curve.yield, curve.power < 1.0 ? std::numeric_limits<double>::infinity() : curve.factor};
  const double grown = curve.factor * std::pow(p, curve.power);
  return {curve.yield + grown, curve.power * grown / p};
}

std::pair<double, double> on_nonlinear(const NonlinearHardening& law, double p) {
  if (p < law.plateau) return {on_nonlinear(law, law.plateau).first, 0.0};
  const double first = law.first * std::exp(-law.first_rate * p);
  const double second = law.second * std::exp(-law.second_rate * p);
  double value = law.initial + law.slope * p + (law.first - first) + (law.second - second);
  double slope = law.slope + law.first_rate * first + law.second_rate * second;
  if (law.power_factor != 0.0) {
    value += law.power_factor * std::pow(p + law.power_offset, law.power);
    slope += law.power_factor * law.power * std::pow(p + law.power_offset, law.power - 1.0);
  }
  return {value, slope};
}

PiecewiseCurve linear_curve(const LinearHardening& law, double young, double kinematic, const MaterialPoint& at) {
  const double modulus = plastic_modulus(young, law.slope(at)) - 1.5 * kinematic;
  return {{{0.0, law.yield(at)}}, modulus, false};
}

double elastic_slope(const TabulatedFunction& curve) { return curve.y.front() / curve.x.front(); }

/// A traction curve over the plastic strain, the elastic part being that of its own first point.
PiecewiseCurve over_plastic_strain(const TabulatedFunction& curve) {
  const double young = elastic_slope(curve);
  PiecewiseCurve result;
  for (std::size_t k = 0; k < curve.x.size(); ++k) {
    const double p = k == 0 ? 0.0 : curve.x[k] - curve.y[k] / young;
    if (k > 0 && !(p > result.points.back().first)) {
      throw Error("invalid-material",
                  fmt::format("the traction curve is steeper than the elastic line at the strain {:.6g}", curve.x[k]));
    }
    result.points.emplace_back(p, curve.y[k]);
  }
  if (curve.right == Extension::linear && result.points.size() > 1) {
    const auto& last = result.points.back();
    const auto& before = result.points[result.points.size() - 2];
    result.last_slope = (last.second - before.second) / (last.first - before.first);
  }
  result.ends = curve.right == Extension::excluded;
  return result;
}

/// (1 - share) a + share b, with the points of both.
PiecewiseCurve between(const PiecewiseCurve& a, const PiecewiseCurve& b, double share) {
  std::vector<double> places;
  for (const auto* curve : {&a, &b})
    for (const auto& point : curve->points) places.push_back(point.first);
  std::ranges::sort(places);
  places.erase(std::unique(places.begin(), places.end()), places.end());
  PiecewiseCurve unended[] = {a, b};
  unended[0].ends = unended[1].ends = false;
  PiecewiseCurve result;
  for (const double p : places)
    result.points.emplace_back(p,
                               (1.0 - share) * on_piece(unended[0], p).first + share * on_piece(unended[1], p).first);
  result.last_slope = (1.0 - share) * a.last_slope + share * b.last_slope;
  result.ends = a.ends || b.ends;
  return result;
}

/// R(p) and Young's modulus at a temperature.
std::pair<PiecewiseCurve, double> traction_curve(const TractionHardening& law, const MaterialPoint& at) {
  const auto own = [&](std::size_t index) {
    return std::pair(over_plastic_strain(law.curves[index]), elastic_slope(law.curves[index]));
  };
  if (law.curves.size() == 1) return own(0);
  const double temperature = at[Parameter::temperature];
  if (std::isnan(temperature))
    throw Error("missing-variable", "traction curves depend on the temperature, which is not given here",
                "give it by AFFE_MATERIAU/AFFE_VARC");
  const auto& nodes = law.temperatures;
  if ((temperature < nodes.front() && law.left == Extension::excluded) ||
      (temperature > nodes.back() && law.right == Extension::excluded)) {
    throw Error("out-of-function",
                fmt::format("the temperature {:.6g} lies outside those of the traction curves, {:.6g} to {:.6g}",
                            temperature, nodes.front(), nodes.back()));
  }
  if (temperature <= nodes.front() && law.left == Extension::constant) return own(0);
  if (temperature >= nodes.back() && law.right == Extension::constant) return own(nodes.size() - 1);
  const auto above = std::upper_bound(nodes.begin() + 1, nodes.end() - 1, temperature);
  const auto k = static_cast<std::size_t>(above - nodes.begin());
  const double share = (temperature - nodes[k - 1]) / (nodes[k] - nodes[k - 1]);
  // R(p) is what is interpolated, not the stress over the strain (R5.03.02).
  const auto below = own(k - 1);
  const auto beyond = own(k);
  return {between(below.first, beyond.first, share), (1.0 - share) * below.second + share * beyond.second};
}

void check_elastic_line(double slope, double young) {
  if (std::abs(slope - young) <= elastic_line_share * young) return;
  throw Error("invalid-material",
              fmt::format("the first point of the traction curve does not lie on the elastic line: its slope is "
                          "{:.6g}, Young's modulus {:.6g}",
                          slope, young),
              "the curve begins at the yield point, where the strain is the stress over Young's modulus");
}

void set_elasticity(double young, double poisson, PlasticPoint& point) {
  point.shear = young / (2 * (1 + poisson));
  point.bulk = young / (3 * (1 - 2 * poisson));
}

const char* keyword_of(Relation relation) {
  switch (relation) {
    case Relation::isotropic_traction:
    case Relation::reversible_traction:
    case Relation::mixed_traction:
      return "TRACTION";
    case Relation::isotropic_power:
    case Relation::reversible_power:
      return "ECRO_PUIS";
    case Relation::isotropic_nonlinear:
      return "ECRO_NL";
    case Relation::asymmetric_linear:
      return "ECRO_ASYM_LINE";
    default:
      return "ECRO_LINE or ECRO_LINE_FO";
  }
}

/// A radius of the yield surface, and a trial stress that flow lowers: without them a point would count as elastic in
/// silence.
void check_surface(const PlasticPoint& point) {
  for (const HardeningCurve* curve : {&point.curve, &point.compression}) {
    const double yield = hardening(*curve, 0.0).first;
    if (std::holds_alternative<NoYield>(*curve) || (yield >= 0.0 && std::isfinite(yield))) continue;
    const std::string found = std::isnan(yield) ? "not a number" : fmt::format("{:.6g}", yield);
    throw Error("invalid-material", fmt::format("the yield stress is {}, but must be a positive number or zero", found),
                "look at the constants of the hardening");
  }
  const double falls = hardening(point.curve, 0.0).second;
  if (!(3.0 * point.shear + 1.5 * std::max(0.0, point.kinematic) + falls > 0.0)) {
    throw Error("invalid-material",
                fmt::format("the yield stress falls by {:.6g} times the plastic strain where flow begins, steeper than "
                            "the stress can follow",
                            -falls),
                "look at the constants of the hardening");
  }
  if (point.kinematic >= 0.0 || 3.0 * point.shear + 1.5 * point.kinematic > 0.0) return;
  throw Error("invalid-material",
              fmt::format("the centre of the yield surface moves backwards by {:.6g} times the plastic strain, more "
                          "than the material is stiff",
                          -point.kinematic),
              "look at the constant of PRAGER, or at D_SIGM_EPSI");
}

PowerCurve power_curve(const PowerHardening& law, double young, const MaterialPoint& at) {
  const double yield = law.yield(at), power = 1.0 / law.exponent(at);
  return {yield, yield * std::pow(young / (law.factor(at) * yield), power), power};
}

NonlinearHardening nonlinear_curve(const NonlinearHardeningOf<Property>& law, const MaterialPoint& at) {
  return {law.initial(at),     law.slope(at),        law.first(at),        law.first_rate(at), law.second(at),
          law.second_rate(at), law.power_factor(at), law.power_offset(at), law.power(at),      law.plateau(at)};
}

bool is_mixed(Relation relation) { return relation == Relation::mixed_linear || relation == Relation::mixed_traction; }

PlasticPoint point_of_relation(const IsotropicElasticity& elasticity, const Plasticity& plasticity, Relation relation,
                               const MaterialPoint& at) {
  const IsotropicModuli elastic = moduli(elasticity, at);
  PlasticPoint point;
  set_elasticity(elastic.young, elastic.poisson, point);
  if (is_mixed(relation)) {
    if (!plasticity.prager) throw_missing_material("PRAGER or PRAGER_FO");
    point.kinematic = (*plasticity.prager)(at);
  }
  switch (relation) {
    case Relation::elastic:
    case Relation::contact_spring:
    case Relation::bilinear_spring:
    case Relation::hardening_spring:
      return point;
    case Relation::hyperelastic:
      if (!plasticity.hyperelasticity) throw_missing_material("ELAS_HYPER");
      point.hyperelasticity = &*plasticity.hyperelasticity;
      return point;
    case Relation::isotropic_linear:
    case Relation::reversible_linear:
    case Relation::mixed_linear:
      if (!plasticity.linear) throw_missing_material(keyword_of(relation));
      point.curve = linear_curve(*plasticity.linear, elastic.young, point.kinematic, at);
      return point;
    case Relation::kinematic_linear:
      if (!plasticity.linear) throw_missing_material(keyword_of(relation));
      point.kinematic = 2.0 / 3.0 * plastic_modulus(elastic.young, plasticity.linear->slope(at));
      point.curve = PiecewiseCurve{{{0.0, plasticity.linear->yield(at)}}, 0.0, false};
      return point;
    case Relation::isotropic_traction:
    case Relation::reversible_traction:
    case Relation::mixed_traction: {
      if (!plasticity.traction) throw_missing_material(keyword_of(relation));
      auto [curve, young] = traction_curve(*plasticity.traction, at);
      check_elastic_line(young, elastic.young);
      set_elasticity(young, elastic.poisson, point);
      for (auto& [p, radius] : curve.points) radius -= 1.5 * point.kinematic * p;
      curve.last_slope -= 1.5 * point.kinematic;
      point.curve = std::move(curve);
      return point;
    }
    case Relation::asymmetric_linear:
      if (!plasticity.asymmetric) throw_missing_material(keyword_of(relation));
      point.curve = linear_curve(plasticity.asymmetric->tension, elastic.young, 0.0, at);
      point.compression = linear_curve(plasticity.asymmetric->compression, elastic.young, 0.0, at);
      return point;
    case Relation::isotropic_power:
    case Relation::reversible_power: {
      if (!plasticity.power) throw_missing_material(keyword_of(relation));
      point.curve = power_curve(*plasticity.power, elastic.young, at);
      return point;
    }
    case Relation::isotropic_nonlinear:
      if (!plasticity.nonlinear) throw_missing_material(keyword_of(relation));
      point.curve = nonlinear_curve(*plasticity.nonlinear, at);
      return point;
  }
  return point;
}

}  // namespace

std::pair<double, double> hardening(const HardeningCurve& curve, double p) {
  if (const auto* piecewise = std::get_if<PiecewiseCurve>(&curve)) return on_piece(*piecewise, p);
  if (const auto* power = std::get_if<PowerCurve>(&curve)) return on_power(*power, p);
  if (const auto* nonlinear = std::get_if<NonlinearHardening>(&curve)) return on_nonlinear(*nonlinear, p);
  return {std::numeric_limits<double>::infinity(), 0.0};
}

void throw_missing_material(std::string_view keyword) {
  throw Error("missing-material", fmt::format("the behaviour needs {} of the material", keyword),
              "give it in DEFI_MATERIAU");
}

bool is_constant(const IsotropicElasticity& elasticity, const Plasticity& plasticity, Relation relation) {
  if (!elasticity.young.is_constant() || !elasticity.poisson.is_constant()) return false;
  if (is_mixed(relation) && plasticity.prager && !plasticity.prager->is_constant()) return false;
  switch (relation) {
    case Relation::isotropic_linear:
    case Relation::reversible_linear:
    case Relation::kinematic_linear:
    case Relation::mixed_linear:
      return plasticity.linear && plasticity.linear->slope.is_constant() && plasticity.linear->yield.is_constant();
    case Relation::isotropic_traction:
    case Relation::reversible_traction:
    case Relation::mixed_traction:
      return plasticity.traction && plasticity.traction->curves.size() == 1;
    default:
      return true;
  }
}

PlasticPoint plastic_point(const IsotropicElasticity& elasticity, const Plasticity& plasticity, Relation relation,
                           const MaterialPoint& at) {
  PlasticPoint point = point_of_relation(elasticity, plasticity, relation, at);
  check_surface(point);
  return point;
}

}  // namespace comma::solver
