// Augmentations of the law of contact beside the stiffness of the bodies.
#pragma once

#include <cstddef>

#include "solver/nonlinear/contact/faced_contact.hpp"
#include "solver/nonlinear/iterations/tangent_system.hpp"

namespace comma::solver {

/// Where all points that share a multiplier lie on its node the solution does not depend on the augmentation; one as
/// stiff as the bodies suits any unit of length. Where points lie between nodes it does, but the softer the less: one
/// too soft beside the bodies is raised to where the solution hardly changes, and pressures no longer lose their digits
/// in it.
class ContactAugmentations {
 public:
  /// Keeps references to its arguments.
  ContactAugmentations(FacedContact& contact, const TangentSystem& tangent) : contact_(contact), tangent_(tangent) {}

  void start_step() { share_ = 1.0; }
  /// Gives the laws of the points their augmentations, as the stiffness at hand asks for them.
  void apply();
  /// A point between nodes that opens while these press on loses friction at once, since its limit is that of the
  /// pressure without the augmentation: no statuses need hold the law then. A softer augmentation makes that jump
  /// smaller. Whether any became softer.
  bool lower();
  /// Below what is given, in this step.
  bool are_lowered() const { return share_ < 1.0; }

  /// By what pressure a length the bodies at a point resist: together, to which the softer one gives way, where the
  /// point lies between nodes; else what the unknowns that move it resist by.
  double stiffness(std::size_t p) const { return contact_.points()[p].node >= 0 ? at_node(p) : between_nodes(p); }

 private:
  double between_nodes(std::size_t p) const;
  double at_node(std::size_t p) const;
  double given(const MixedZone& zone) const;

  FacedContact& contact_;
  const TangentSystem& tangent_;
  double share_ = 1.0;  ///< of what is given, between nodes: lowered in a step where nothing else leads to a solution
};

}  // namespace comma::solver
