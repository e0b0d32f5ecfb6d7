#include "solver/materials/behaviour/large_strain.hpp"

#include "solver/error.hpp"

namespace comma::solver {

using Eigen::Matrix3d;

Matrix3d deformation_gradient(const Matrix3d& displacement_gradient) {
  const Matrix3d f = Matrix3d::Identity() + displacement_gradient;
  if (!(f.determinant() > 0.0)) {
    throw Error("integration-failure",
                "a point is turned inside out: the determinant of its deformation gradient is not positive",
                "take smaller steps");
  }
  return f;
}

Matrix3d green_lagrange_strain(const Matrix3d& h) { return 0.5 * (h + h.transpose() + h.transpose() * h); }

Matrix6d derivative_of_inverse(const Matrix3d& inverse) {
  constexpr int first[] = {0, 1, 2, 0, 0, 1};
  constexpr int second[] = {0, 1, 2, 1, 2, 2};
  Matrix6d d;
  for (int m = 0; m < 6; ++m)
    for (int n = 0; n < 6; ++n)
      d(m, n) = -(inverse(first[m], first[n]) * inverse(second[m], second[n]) +
                  inverse(first[m], second[n]) * inverse(second[m], first[n]));
  return d;
}

Matrix3d tensor_of_stress(const Vector6d& s) {
  Matrix3d t;
  t << s[0], s[3], s[4], s[3], s[1], s[5], s[4], s[5], s[2];
  return t;
}

Vector6d components_of_stress(const Matrix3d& t) {
  Vector6d s;
  s << t(0, 0), t(1, 1), t(2, 2), t(0, 1), t(0, 2), t(1, 2);
  return s;
}

Vector6d cauchy_stress(const Matrix3d& h, const Vector6d& second) {
  const Matrix3d f = Matrix3d::Identity() + h;
  return components_of_stress(f * tensor_of_stress(second) * f.transpose() / f.determinant());
}

Vector6d second_stress_of(const Matrix3d& h, const Vector6d& cauchy) {
  const Matrix3d f = Matrix3d::Identity() + h;
  const Matrix3d inverse = f.inverse();
  return components_of_stress(f.determinant() * inverse * tensor_of_stress(cauchy) * inverse.transpose());
}

}  // namespace comma::solver
