// Laws of one component of a discrete element: bilinear elasticity, and plasticity whose hardening is kinematic
// (R5.03.17, DIS_BILI_ELAS and DIS_ECRO_CINE).
#pragma once

#include <array>
#include <optional>

#include "solver/materials/property.hpp"

namespace comma::solver {

/// Elastic with one stiffness up to a force, and another beyond.
struct BilinearSpring {
  Property first{};    ///< KDEB: force over displacement, > 0
  Property last{};     ///< KFIN
  double bound = 0.0;  ///< FPRE, > 0
};

/// The centre X of the elastic domain |F - X| <= yield moves with the plastic displacement a: X = slope a / (1 + (slope
/// |a| / limit)^power)^(1 / power).
struct HardeningSpring {
  double yield = 0.0;  ///< LIMY, > 0
  double slope = 0.0;  ///< KCIN, >= 0
  double power = 0.0;  ///< PUIS, > 1; 0: the centre moves in proportion
  double limit = 0.0;  ///< LIMU, > 0: the most that the centre moves
};

/// In own axes; a component without a law has the stiffness of the element.
struct SpringLaws {
  std::array<std::optional<BilinearSpring>, 3> bilinear;    ///< of DX, DY, DZ
  std::array<std::optional<HardeningSpring>, 6> hardening;  ///< of DX, DY, DZ, DRX, DRY, DRZ
};

struct SpringResponse {
  double force;
  double tangent;        ///< derivative of the force by the displacement
  double plastic = 0.0;  ///< the part of the displacement that the force does not come from
};

/// The force at a displacement, with the stiffnesses as they are at the moment.
SpringResponse bilinear_response(double first, double last, double bound, double displacement);

/// The same of a spring with the elastic stiffness, > 0, from the plastic displacement where the step began; implicit
/// in the step.
SpringResponse hardening_response(const HardeningSpring& law, double stiffness, double displacement, double plastic);

}  // namespace comma::solver
