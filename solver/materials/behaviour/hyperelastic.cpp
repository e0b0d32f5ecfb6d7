#include "solver/materials/behaviour/hyperelastic.hpp"

#include <algorithm>
#include <cmath>

#include "solver/error.hpp"
#include "solver/materials/behaviour/large_strain.hpp"

namespace comma::solver {

HyperelasticResponse hyperelastic_response(const Hyperelasticity& material,
                                           const Eigen::Matrix3d& displacement_gradient) {
  const Eigen::Matrix3d f = deformation_gradient(displacement_gradient);
  const Eigen::Matrix3d c = f.transpose() * f;
  const Eigen::Matrix3d c_inverse = c.inverse();
  const double jacobian = f.determinant();
  const double shape = std::pow(jacobian, -2.0 / 3.0);
  const double i1 = c.trace();
  const double i2 = 0.5 * (i1 * i1 - c.cwiseProduct(c).sum());
  const Vector6d one = components_of_stress(Eigen::Matrix3d::Identity());
  const Vector6d inverse = components_of_stress(c_inverse);
  const Vector6d other = components_of_stress(i1 * Eigen::Matrix3d::Identity() - c);
  const Matrix6d change_of_inverse = derivative_of_inverse(c_inverse);
  Matrix6d identity = Matrix6d::Identity();
  identity.diagonal().tail<3>().setConstant(0.5);

  // First and second derivatives of the invariants by C; those of C^-1 are by the strain, which is half of it.
  const Vector6d d1 = shape * (one - i1 / 3.0 * inverse);
  const Vector6d d2 = shape * shape * (other - 2.0 / 3.0 * i2 * inverse);
  const Matrix6d dd1 = shape * (-(one * inverse.transpose() + inverse * one.transpose()) / 3.0 +
                                i1 / 9.0 * inverse * inverse.transpose() - i1 / 6.0 * change_of_inverse);
  const Matrix6d dd2 =
      shape * shape *
      (one * one.transpose() - identity - 2.0 / 3.0 * (inverse * other.transpose() + other * inverse.transpose()) +
       4.0 / 9.0 * i2 * inverse * inverse.transpose() - i2 / 3.0 * change_of_inverse);
  const double slope1 = material.c10 + 2.0 * material.c20 * (shape * i1 - 3.0);
  const double pressure = material.bulk * (jacobian - 1.0) * jacobian;

  HyperelasticResponse response;
  response.stress = 2.0 * slope1 * d1 + 2.0 * material.c01 * d2 + pressure * inverse;
  response.tangent = 4.0 * (slope1 * dd1 + 2.0 * material.c20 * d1 * d1.transpose() + material.c01 * dd2) +
                     material.bulk * (2.0 * jacobian - 1.0) * jacobian * inverse * inverse.transpose() +
                     pressure * change_of_inverse;
  return response;
}

Eigen::Matrix3d gradient_in_plane_stress(const Hyperelasticity& material,
                                         const Eigen::Matrix3d& displacement_gradient) {
  constexpr int most_iterations = 100;
  constexpr double settled = 1e-15;  // of the square of the thickness: rounding leaves as much
  Eigen::Matrix3d gradient = displacement_gradient;
  gradient(2, 2) = 0.0;
  const double area = deformation_gradient(gradient).determinant();
  double square = 1.0 / (area * area);  // of the thickness, which keeps the volume at first
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    gradient(2, 2) = std::sqrt(square) - 1.0;
    const HyperelasticResponse response = hyperelastic_response(material, gradient);
    const double change = -2.0 * response.stress[2] / response.tangent(2, 2);
    if (std::abs(change) <= settled * square) return gradient;
    const double before = square;
    square = std::clamp(square + change, 0.25 * square, 4.0 * square);
    if (square == before) return gradient;
  }
  throw Error("integration-failure", "rubber in plane stress finds no thickness", "take smaller steps");
}

double hyperelastic_energy(const Hyperelasticity& material, const Eigen::Matrix3d& displacement_gradient) {
  const Eigen::Matrix3d f = deformation_gradient(displacement_gradient);
  const Eigen::Matrix3d c = f.transpose() * f;
  const double jacobian = f.determinant();
  const double shape = std::pow(jacobian, -2.0 / 3.0);
  const double first = shape * c.trace() - 3.0;
  const double second = shape * shape * 0.5 * (c.trace() * c.trace() - c.squaredNorm()) - 3.0;
  return material.c10 * first + material.c01 * second + material.c20 * first * first +
         0.5 * material.bulk * (jacobian - 1.0) * (jacobian - 1.0);
}

IsotropicModuli small_strain_moduli(const Hyperelasticity& material) {
  const double shear = 2.0 * (material.c10 + material.c01);
  return {9.0 * material.bulk * shear / (3.0 * material.bulk + shear),
          (3.0 * material.bulk - 2.0 * shear) / (2.0 * (3.0 * material.bulk + shear))};
}

}  // namespace comma::solver
