#include "solver/materials/elasticity.hpp"

#include <cmath>

#include <fmt/format.h>

#include "solver/error.hpp"

namespace comma::solver {

void check_elasticity(const IsotropicElasticity& material) {
  if (!(material.young > 0.0) || !std::isfinite(material.young)) {
    throw Error("invalid-material", fmt::format("Young's modulus is {}, but it must be positive", material.young));
  }
  if (!(material.poisson > -1.0 && material.poisson < 0.5)) {
    throw Error("invalid-material", fmt::format("Poisson's ratio is {}, but it must lie between -1 and 0.5, both excluded", material.poisson),
                material.poisson == 0.5 ? "a value such as 0.4999 is nearly incompressible" : "");
  }
}

Eigen::Matrix<double, 6, 6> solid_stiffness(const IsotropicElasticity& material) {
  const double mu = material.young / (2 * (1 + material.poisson));
  const double lambda = material.young * material.poisson / ((1 + material.poisson) * (1 - 2 * material.poisson));
  Eigen::Matrix<double, 6, 6> stiffness = Eigen::Matrix<double, 6, 6>::Zero();
  stiffness.topLeftCorner<3, 3>().setConstant(lambda);
  stiffness.diagonal().head<3>().array() += 2 * mu;
  stiffness.diagonal().tail<3>().setConstant(mu);
  return stiffness;
}

Eigen::Matrix4d plane_strain_stiffness(const IsotropicElasticity& material) {
  return solid_stiffness(material).topLeftCorner<4, 4>();
}

Eigen::Matrix4d plane_stress_stiffness(const IsotropicElasticity& material) {
  const double direct = material.young / (1 - material.poisson * material.poisson);
  Eigen::Matrix4d stiffness = Eigen::Matrix4d::Zero();
  stiffness(0, 0) = stiffness(1, 1) = direct;
  stiffness(0, 1) = stiffness(1, 0) = direct * material.poisson;
  stiffness(3, 3) = material.young / (2 * (1 + material.poisson));
  return stiffness;
}

}  // namespace comma::solver
