#include "solver/materials/contact_spring.hpp"

namespace comma::solver {

ContactSpringResponse respond(const ContactSpring& spring, double gap, const Eigen::Vector2d& displacement,
                              const Eigen::Vector2d& slip) {
  // Of the bound, what rounding leaves of a force that has been brought back to it.
  constexpr double rounding_share = 1e-14;
  ContactSpringResponse response{Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero(), displacement,
                                 ContactSpringStatus::open};
  if (gap > 0.0) return response;
  response.force[0] = spring.normal * gap;
  response.tangent(0, 0) = spring.normal;
  const Eigen::Vector2d trial = spring.tangential * (displacement - slip);
  const double size = trial.norm();
  const double bound = -spring.friction * response.force[0];
  if (size <= bound * (1.0 + rounding_share)) {
    response.status = ContactSpringStatus::sticking;
    response.slip = slip;
    response.force.tail<2>() = trial;
    response.tangent.bottomRightCorner<2, 2>() = spring.tangential * Eigen::Matrix2d::Identity();
    return response;
  }
  const Eigen::Vector2d direction = trial / size;
  response.status = ContactSpringStatus::slipping;
  response.force.tail<2>() = bound * direction;
  response.slip = displacement - bound / spring.tangential * direction;
  response.tangent.bottomLeftCorner<2, 1>() = -spring.friction * spring.normal * direction;
  response.tangent.bottomRightCorner<2, 2>() =
      bound / size * spring.tangential * (Eigen::Matrix2d::Identity() - direction * direction.transpose());
  return response;
}

}  // namespace comma::solver
