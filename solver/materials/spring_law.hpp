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

/// The centre X of the elastic domain |F - X| <= yield moves with a displacement a that counts while the spring flows:
/// X = slope a / (1 + (slope |a| / limit)^power)^(1 / power). So the force rises by `slope` over the whole
/// displacement, as Code_Aster 17.3 has it, not over its plastic part.
struct HardeningSpring {
  double yield = 0.0;  ///< LIMY, > 0
  double slope = 0.0;  ///< KCIN, >= 0: force over displacement where it flows
  double power = 0.0;  ///< PUIS, > 1; 0: the centre moves in proportion
  double limit = 0.0;  ///< LIMU, > 0: the most that the centre moves
};

/// In own axes; a component without a law has the stiffness of the element.
struct SpringLaws {
  std::array<std::optional<BilinearSpring>, 3> bilinear;    ///< of DX, DY, DZ
  std::array<std::optional<HardeningSpring>, 6> hardening;  ///< of DX, DY, DZ, DRX, DRY, DRZ
};

/// What a spring that hardens remembers.
struct SpringPast {
  double plastic = 0.0;  ///< the part of the displacement that the force does not come from
  double flowed = 0.0;   ///< the displacement while it flowed, which moves the centre
  double spent = 0.0;    ///< the work on the plastic displacement
};

struct SpringResponse {
  double force;
  double tangent;  ///< derivative of the force by the displacement
  SpringPast reached{};
};

/// The force at a displacement, with the stiffnesses as they are at the moment.
SpringResponse bilinear_response(double first, double last, double bound, double displacement);

/// The same of a spring with the elastic stiffness, > 0, from where the step began: exact in a step of one sense.
SpringResponse hardening_response(const HardeningSpring& law, double stiffness, double displacement,
                                  const SpringPast& past);

/// `flowed` that puts the centre at a place within its limit.
double flowed_for_centre(const HardeningSpring& law, double place);

}  // namespace comma::solver
