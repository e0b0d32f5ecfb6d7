#include "solver/elements/slender/beam_interpolation.hpp"

#include <array>

#include "solver/elements/quadrature.hpp"

namespace comma::solver {

namespace {

using Interpolation = Eigen::Matrix<double, 6, 12>;

/// Bending in one plane: deflection row `v` and rotation row `r`, whose end values stand in columns v, r, v + 6 and r +
/// 6, with rotation = sign * slope in the absence of shear.
void interpolate_bending(Interpolation& h, double s, double length, double softening, int v, int r, double sign) {
  const double c = 1.0 / (1.0 + softening);
  const double l = sign * length;
  h(v, v) = c * (1.0 + softening - softening * s - 3.0 * s * s + 2.0 * s * s * s);
  h(v, r) = c * l * (s * (1.0 + softening / 2.0) - s * s * (2.0 + softening / 2.0) + s * s * s);
  h(v, v + 6) = 1.0 - h(v, v);
  h(v, r + 6) = c * l * (-softening / 2.0 * s - s * s * (1.0 - softening / 2.0) + s * s * s);
  h(r, v) = 6.0 * c / l * (s * s - s);
  h(r, r) = c * (1.0 + softening - (4.0 + softening) * s + 3.0 * s * s);
  h(r, v + 6) = -h(r, v);
  h(r, r + 6) = c * (3.0 * s * s - (2.0 - softening) * s);
}

}  // namespace

BeamInterpolation timoshenko_interpolation(const BeamSection& section, const IsotropicModuli& material, double length) {
  const double shear_modulus = material.young / (2.0 * (1.0 + material.poisson));
  const double scale = 12.0 * material.young / (shear_modulus * section.area * length * length);
  return {length, scale * section.inertia_z * section.shear_y, scale * section.inertia_y * section.shear_z};
}

Interpolation interpolate(const BeamInterpolation& beam, double position) {
  Interpolation h = Interpolation::Zero();
  for (const int axial : {0, 3}) {
    h(axial, axial) = 1.0 - position;
    h(axial, axial + 6) = position;
  }
  interpolate_bending(h, position, beam.length, beam.softening_y, 1, 5, 1.0);
  interpolate_bending(h, position, beam.length, beam.softening_z, 2, 4, -1.0);
  return h;
}

Eigen::Matrix<double, 12, 1> end_forces(const BeamInterpolation& beam, const LineLoad& load) {
  // On cubic displacements: four points are exact to degree 7.
  static const Quadrature points = quadrature(CellType::seg2, "FPG4");
  const BeamInterpolation stiff_in_shear = {beam.length, 0.0, 0.0};
  Eigen::Matrix<double, 12, 1> forces = Eigen::Matrix<double, 12, 1>::Zero();
  for (const QuadraturePoint& point : points) {
    const double s = 0.5 * (1.0 + point.at[0]);
    forces += 0.5 * point.weight * beam.length * (interpolate(stiff_in_shear, s).transpose() * load(s));
  }
  return forces;
}

}  // namespace comma::solver
