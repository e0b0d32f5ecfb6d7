// R(p): how the radius of von Mises' yield surface grows with the cumulated plastic strain.
#pragma once

#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "solver/materials/elasticity.hpp"
#include "solver/materials/plasticity.hpp"
#include "solver/model/behaviour.hpp"

namespace comma::solver {

/// Straight between points (p rising from 0), and beyond the last with a slope of its own.
struct PiecewiseCurve {
  std::vector<std::pair<double, double>> points;  ///< p, R
  double last_slope = 0.0;
  bool ends = false;  ///< beyond the last point the curve is not defined
};

/// yield + factor p^power.
struct PowerCurve {
  double yield = 0.0;
  double factor = 0.0;
  double power = 1.0;
};

/// No yield surface: the material stays elastic.
struct NoYield {};

using HardeningCurve = std::variant<NoYield, PiecewiseCurve, PowerCurve, NonlinearHardening>;

/// R(p) and dR/dp. Throws Error `out-of-function` beyond the end of a traction curve that is not continued.
std::pair<double, double> hardening(const HardeningCurve& curve, double p);

/// The factors between strains and stresses at a point.
struct PlasticModuli {
  double shear = 0.0;      ///< mu
  double bulk = 0.0;       ///< K
  double kinematic = 0.0;  ///< C
};

/// What a point needs for von Mises plasticity.
struct PlasticPoint : PlasticModuli {
  HardeningCurve curve;
  const Hyperelasticity* hyperelasticity = nullptr;  ///< of rubber
  HardeningCurve compression = NoYield{};            ///< where it is another one than `curve`, that of tension
};

/// Throws Error `missing-material` naming the keyword that a behaviour lacks.
[[noreturn]] void throw_missing_material(std::string_view keyword);

/// Whether a relation finds the same at all points and times.
bool is_constant(const IsotropicElasticity& elasticity, const Plasticity& plasticity, Relation relation);

/// The constants of a relation at a point. A bilinear curve of slope T has R = yield + E T / (E - T) p, less 3/2 C
/// where the surface moves as well; with kinematic hardening alone C = 2/3 E T / (E - T) (R5.03.02, R5.03.16). Throws
/// Error `missing-material` naming the keyword that the relation lacks, `invalid-material` for a slope that is not
/// below Young's modulus, a curve whose first point lies off the elastic line, a yield stress below zero or not finite,
/// a yield stress that falls more steeply than the elastic stress, or a surface that moves backwards by more than the
/// material is stiff.
PlasticPoint plastic_point(const IsotropicElasticity& elasticity, const Plasticity& plasticity, Relation relation,
                           const MaterialPoint& at);

}  // namespace comma::solver
