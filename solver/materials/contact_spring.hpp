// Contact with Coulomb's friction inside a discrete element (R5.03.17, DIS_CHOC and DIS_CONTACT).
#pragma once

#include <cstdint>

#include <Eigen/Dense>

namespace comma::solver {

/// What a discrete element is made of that pushes and rubs where it is closed.
struct ContactSpring {
  double normal = 0.0;           ///< RIGI_NOR, > 0: force over the depth
  double tangential = 0.0;       ///< RIGI_TAN: force over the sideways displacement before it slips; 0: it resists none
  double friction = 0.0;         ///< COULOMB
  double first_distance = 0.0;   ///< DIST_1: from the first node to the surface around it
  double second_distance = 0.0;  ///< DIST_2: the same of the second node, on segments
  double clearance = 0.0;        ///< JEU: from a point's node to the obstacle
};

enum class ContactSpringStatus : std::uint8_t { open = 0, sticking = 1, slipping = 2 };

/// In the element's own axes, the first along the normal. Forces are those that pull the two sides together: the first
/// is negative where they touch.
struct ContactSpringResponse {
  Eigen::Vector3d force;
  /// Derivative of the force by the gap and the sideways displacements; not symmetric where it slips.
  Eigen::Matrix3d tangent;
  Eigen::Vector2d slip;  ///< the part of the sideways displacements that the force does not come from
  ContactSpringStatus status;
};

/// The force of a spring at a gap (closed where it is not above zero) and sideways displacements, from the slip where
/// the step began:
///     N = k_n gap,  T = k_t (displacement - slip),  |T| <= mu |N|,
/// integrated by a return along T, as perfect plasticity with a bound that N sets. An open spring slips freely.
ContactSpringResponse respond(const ContactSpring& spring, double gap, const Eigen::Vector2d& displacement,
                              const Eigen::Vector2d& slip);

}  // namespace comma::solver
