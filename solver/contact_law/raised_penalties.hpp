// Penalties of contact that grow until points go no deeper, and slip no more, than allowed.
#pragma once

#include <optional>
#include <vector>

#include "solver/contact/definition.hpp"
#include "solver/contact_law/condensed_problem.hpp"

namespace comma::solver {

/// What is too much in each zone: the deepest point and the one that slips furthest while it sticks, as multiples of
/// what is allowed.
struct Excess {
  explicit Excess(std::size_t zones)
      : depth(zones, 0.0), slip(zones, 0.0), soft_contact(zones, 1.0), soft_friction(zones, 1.0) {}

  std::vector<double> depth;
  std::vector<double> slip;
  /// The stiffness of the bodies over the penalty given, where that is softer (>= 1).
  std::vector<double> soft_contact, soft_friction;
};

/// The penalties of the zones of a contact are raised by one factor a zone (U4.34.03: ACTION='ADAPT_COEF_PENA' of the
/// event INTERPENETRATION; U4.44.11: those of friction by ADAPTATION='ADAPT_COEF' with GLIS_MAXI), and never lowered.
class RaisedPenalties {
 public:
  /// Beyond, rounding of the gaps makes pressures.
  static constexpr double most_beside_bodies = 1e12;

  explicit RaisedPenalties(std::size_t zones = 0) : contact_(zones, 1.0), friction_(zones, 1.0) {}

  /// From now on all zones allow this depth (a length), and no factor goes beyond `most`.
  void limit_depth(double depth, double most);
  /// How deep points may go; nothing where nothing limits them.
  std::optional<double> allowed_depth() const { return depth_limit_; }

  /// Whether any is not as it was given.
  bool are_raised() const;
  /// Those of a zone raised as much as those of another among others; what limits them stays.
  void go_on_from(const RaisedPenalties& others, std::size_t other, std::size_t zone);

  /// Raises the penalties of zones where something is too much; whether there were any. Throws Error `no-convergence`
  /// where factors have become too large.
  bool raise(const Excess& excess);
  /// Gives the law of a point of the zone its penalties as they are now.
  void apply(const MixedZone& zone, int number, CondensedPoint& point) const;
  double contact_penalty(const MixedZone& zone, int number) const {
    return zone.augmentation * contact_[static_cast<std::size_t>(number)];
  }
  double friction_penalty(const MixedZone& zone, int number) const {
    return zone.friction_penalty * friction_[static_cast<std::size_t>(number)];
  }

 private:
  std::vector<double> contact_;   ///< by which the penalty of each zone is raised, >= 1
  std::vector<double> friction_;  ///< the same of its penalty of friction
  std::optional<double> depth_limit_;
  std::optional<double> most_;  ///< as given; nothing: `most_beside_bodies` times what is as stiff as the bodies
};

}  // namespace comma::solver
