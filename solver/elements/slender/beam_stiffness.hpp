// The exact stiffness of a straight, uniform beam on two nodes, in its own axes (R3.08.01).
#pragma once

#include <array>

#include <Eigen/Dense>

#include "solver/elements/slender/section.hpp"
#include "solver/materials/elasticity.hpp"

namespace comma::solver {

/// Degrees of freedom: translations and rotations of the first node, then of the second.
template <class Scalar>
using BeamMatrixOf = Eigen::Matrix<Scalar, 12, 12>;
using BeamMatrix = BeamMatrixOf<double>;

/// Bending of a uniform beam in one plane: deflection and slope at both ends. `softening` is the ratio of shear to
/// bending flexibility, 12 E I / (G A_reduced L^2); 0 for Euler's beam.
template <class Scalar>
Eigen::Matrix<Scalar, 4, 4> uniform_bending(double rigidity, const Scalar& l, const Scalar& softening) {
  const Scalar twelve(12.0), six = 6.0 * l, far = (2.0 - softening) * l * l, near = (4.0 + softening) * l * l;
  Eigen::Matrix<Scalar, 4, 4> plane;
  plane << twelve, six, -twelve, six,  //
      six, near, -six, far,            //
      -twelve, -six, twelve, -six,     //
      six, far, -six, near;
  return (Scalar(rigidity) / (l * l * l * (1.0 + softening))) * plane;
}

/// Adds bending in one plane: deflections at rows v1, v2 and rotations at r1, r2, with rotation = sign * slope.
template <class Scalar>
void add_bending(BeamMatrixOf<Scalar>& k, const Eigen::Matrix<Scalar, 4, 4>& plane, const std::array<int, 4>& rows,
                 double sign) {
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j)
      k(rows[static_cast<std::size_t>(i)], rows[static_cast<std::size_t>(j)]) +=
          (i % 2 == j % 2 ? 1.0 : sign) * plane(i, j);
  }
}

template <class Scalar>
void add_beam_spring(BeamMatrixOf<Scalar>& k, const Scalar& stiffness, int first, int second) {
  k(first, first) += stiffness;
  k(second, second) += stiffness;
  k(first, second) -= stiffness;
  k(second, first) -= stiffness;
}

/// The displacements of the centre of torsion, which bend a beam, from those of the centroid: the latter plus what the
/// torsion of the section adds (R3.08.01, eccentric centre of torsion).
inline BeamMatrix centre_from_centroid(const BeamSection& section) {
  BeamMatrix shift = BeamMatrix::Identity();
  for (const int node : {0, 6}) {
    shift(node + 1, node + 3) = -section.centre_z;
    shift(node + 2, node + 3) = section.centre_y;
  }
  return shift;
}

inline bool is_eccentric(const BeamSection& section) { return section.centre_y != 0.0 || section.centre_z != 0.0; }

/// The stiffness of a beam of a length; `shear`: Timoshenko's beam, else Euler's.
template <class Scalar>
BeamMatrixOf<Scalar> uniform_beam(const BeamSection& section, const IsotropicModuli& material, const Scalar& length,
                                  bool shear) {
  const double shear_modulus = material.young / (2 * (1 + material.poisson));
  BeamMatrixOf<Scalar> k = BeamMatrixOf<Scalar>::Constant(Scalar(0.0));
  add_beam_spring<Scalar>(k, Scalar(material.young * section.area) / length, 0, 6);
  add_beam_spring<Scalar>(k, Scalar(shear_modulus * section.torsion) / length, 3, 9);
  const Scalar scale = (shear ? 12 * material.young / (shear_modulus * section.area) : 0.0) / (length * length);
  add_bending<Scalar>(
      k,
      uniform_bending<Scalar>(material.young * section.inertia_z, length, section.inertia_z * section.shear_y * scale),
      {1, 5, 7, 11}, 1.0);
  add_bending<Scalar>(
      k,
      uniform_bending<Scalar>(material.young * section.inertia_y, length, section.inertia_y * section.shear_z * scale),
      {2, 4, 8, 10}, -1.0);
  if (!is_eccentric(section)) return k;
  const BeamMatrixOf<Scalar> shift = centre_from_centroid(section).template cast<Scalar>();
  return shift.transpose() * k * shift;
}

}  // namespace comma::solver
