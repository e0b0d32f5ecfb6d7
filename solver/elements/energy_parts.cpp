#include "solver/elements/energy_parts.hpp"

#include "solver/elements/slender/beam_stiffness.hpp"

namespace comma::solver {

Eigen::Vector4d beam_energy_parts(const BeamSection& section, const Eigen::Matrix3d& axes,
                                  const Eigen::Matrix<double, 12, 1>& displacements,
                                  const Eigen::Matrix<double, 12, 1>& forces) {
  using Vector12 = Eigen::Matrix<double, 12, 1>;
  Vector12 moved, force;
  for (int i = 0; i < 12; i += 3) {
    moved.segment<3>(i) = axes * displacements.segment<3>(i);
    force.segment<3>(i) = axes * forces.segment<3>(i);
  }
  // Bending and torsion are apart from each other about the centre of torsion.
  if (is_eccentric(section)) {
    const BeamMatrix shift = centre_from_centroid(section);
    moved = (shift * moved).eval();
    force = (2.0 * BeamMatrix::Identity() - shift).transpose() * force;  // the inverse of I + a is I - a, since a a = 0
  }
  const Vector12 work = 0.5 * moved.cwiseProduct(force);
  return {work[0] + work[6], work[3] + work[9], work[2] + work[4] + work[8] + work[10],
          work[1] + work[5] + work[7] + work[11]};
}

}  // namespace comma::solver
