#include "solver/elements/slender/varying_section.hpp"

#include <array>
#include <cmath>

#include "solver/elements/quadrature.hpp"

namespace comma::solver {

namespace {

/// How one characteristic varies: (1 + c s)^power.
class Variation {
 public:
  Variation(double first, double last, int power)
      : first_(first), power_(power), growth_(std::pow(last / first, 1.0 / power) - 1.0) {}

  double at(double s) const { return first_ * std::pow(1.0 + growth_ * s, power_); }

  /// Integrals of (1 - s)^k / at(s) over the beam, k = 0, 1, 2. With 1 + c s = e^(l t), l = ln(1 + c), they become
  /// integrals of smooth exponentials, whatever the ratio of the ends.
  std::array<double, 3> inverse_moments() const {
    static const Quadrature points = quadrature(CellType::seg2, "FPG4");
    constexpr int panels = 64;
    const double l = std::log1p(growth_);
    std::array<double, 3> moments{};
    for (int panel = 0; panel < panels; ++panel) {
      for (const QuadraturePoint& point : points) {
        const double t = (panel + 0.5 * (1.0 + point.at[0])) / panels;
        const double s = growth_ == 0.0 ? t : std::expm1(l * t) / growth_;
        const double slope = growth_ == 0.0 ? 1.0 : std::exp(l * t) * l / growth_;
        double term = 0.5 * point.weight / panels * slope / at(s);
        for (double& moment : moments) {
          moment += term;
          term *= 1.0 - s;
        }
      }
    }
    return moments;
  }

 private:
  double first_;
  int power_;
  double growth_;
};

double uniform_equivalent(double first, double last, int power) {
  return 1.0 / Variation(first, last, power).inverse_moments()[0];
}

/// A shear factor from areas: 0 stands for a section that is rigid in shear.
double factor_at(double first, double first_area, double last, double last_area, int power, double area, double s) {
  if (first == 0.0 || last == 0.0) return 0.0;
  return area / Variation(first_area / first, last_area / last, power).at(s);
}

}  // namespace

BeamSection section_at(const BeamSection& section, double position) {
  if (!varies(section)) return section;
  const BeamSection& end = *section.end;
  const VariationPowers& powers = section.powers;
  const int n = powers.area;
  const auto linear = [&](double first, double last) { return first + position * (last - first); };
  BeamSection result = section;
  result.end = nullptr;
  result.area = Variation(section.area, end.area, n).at(position);
  result.inertia_y = Variation(section.inertia_y, end.inertia_y, powers.inertia_y).at(position);
  result.inertia_z = Variation(section.inertia_z, end.inertia_z, powers.inertia_z).at(position);
  result.torsion = Variation(section.torsion, end.torsion, powers.torsion).at(position);
  result.shear_y = factor_at(section.shear_y, section.area, end.shear_y, end.area, n, result.area, position);
  result.shear_z = factor_at(section.shear_z, section.area, end.shear_z, end.area, n, result.area, position);
  result.reach_y = linear(section.reach_y, end.reach_y);
  result.reach_z = linear(section.reach_z, end.reach_z);
  result.torsion_reach = linear(section.torsion_reach, end.torsion_reach);
  return result;
}

double axial_area(const BeamSection& section) {
  return varies(section) ? uniform_equivalent(section.area, section.end->area, section.powers.area) : section.area;
}

double torsion_constant(const BeamSection& section) {
  return varies(section) ? uniform_equivalent(section.torsion, section.end->torsion, section.powers.torsion)
                         : section.torsion;
}

Eigen::Matrix4d bending_stiffness(const BendingPlane& plane, double length, double rigidity, double shear_rigidity) {
  const auto bending = Variation(plane.inertia_start, plane.inertia_end, plane.inertia_power).inverse_moments();
  const double scale = length / rigidity;
  Eigen::Matrix2d flexibility;  // deflection and slope of the second end under a force and a moment there
  flexibility << bending[2] * length * length, bending[1] * length, bending[1] * length, bending[0];
  flexibility *= scale;
  if (shear_rigidity > 0.0) {
    const auto shear = Variation(plane.shear_area_start, plane.shear_area_end, plane.area_power).inverse_moments();
    flexibility(0, 0) += length / shear_rigidity * shear[0];
  }
  Eigen::Matrix<double, 2, 4> relative;  // to the first end's rigid motion
  relative << -1, -length, 1, 0,         //
      0, -1, 0, 1;
  const Eigen::Matrix4d stiffness = relative.transpose() * flexibility.inverse() * relative;
  return 0.5 * (stiffness + stiffness.transpose());
}

}  // namespace comma::solver
