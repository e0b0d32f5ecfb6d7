#include "solver/contact_law/secant_friction.hpp"

#include <algorithm>

namespace comma::solver {

using Eigen::Matrix2d;
using Eigen::Vector2d;

SecantShear secant_shear(const ContactLaw& law, double pressure, const Vector2d& slip, double relief) {
  const double size = slip.norm();
  const double limit = law.friction * std::max(0.0, pressure);
  SecantShear shear;
  if (law.friction_penalty() * size <= limit) {
    shear.status = ContactStatus::sticking;
    shear.linear.stiffness = law.friction_penalty() * Matrix2d::Identity();
    shear.value = law.friction_penalty() * slip;
    return shear;
  }
  const Vector2d along = slip / size;
  shear.value = limit * along;
  shear.linear.stiffness = limit / size * (Matrix2d::Identity() - relief * along * along.transpose());
  shear.linear.at_rest = shear.value - shear.linear.stiffness * slip;
  return shear;
}

}  // namespace comma::solver
