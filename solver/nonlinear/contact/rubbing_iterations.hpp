// Iterations that go by fixed points on contact while friction follows by Newton's method.
#pragma once

#include <cstddef>

#include <Eigen/Dense>

#include "solver/contact/doubts.hpp"
#include "solver/contact_law/condensed_contact.hpp"
#include "solver/nonlinear/contact/faced_contact.hpp"

namespace comma::solver {

/// What Code_Aster 17.3 does iteration by iteration for standard friction by Newton's method alone with a loose
/// criterion (RESI_FROT), so that its figures are the same: geometry and closed points stay while friction changes, by
/// shares of its limit.
class RubbingIterations {
 public:
  /// Keeps a reference to its argument.
  explicit RubbingIterations(FacedContact& contact) : contact_(contact) {}

  /// Whether contacts of that kind are solved so.
  static bool suit(const ContactDefinition& definition);

  /// Nothing is known of an iteration before.
  void forget();
  /// Iterations begin, again and again, where the step does, without shears; the pressures at hand weigh those of the
  /// first.
  void begin_again();
  /// Solves with closed points and the linearised friction at hand, on the compliance of the rows.
  CondensedSolution solve(SchurComplement& schur);
  void note_solved() { solved_ = contact_.rows.full().transpose() * contact_.forces; }
  /// After a correction that has led to u: friction is what its law says there. Returns the number of points whose
  /// status changed.
  int linearise(const Eigen::VectorXd& u);
  /// Whether unknowns have changed by no more than RESI_FROT of the largest.
  bool may_end() const { return change_ <= contact_.definition.friction_tolerance; }
  /// Of iterations that have ended at u: opens points that pull, and closes those that overlap. How many.
  int change_points(const Eigen::VectorXd& u);
  /// Of friction that the criterion leaves coarse.
  void note_doubts(ContactDoubts& doubts) const;

  /// Forces of the last linear solve, on all degrees of freedom.
  const Eigen::VectorXd& solved() const { return solved_; }

 private:
  ContactLaw law_by_shares(std::size_t p, double pressure) const;
  void note_friction(const Eigen::VectorXd& u, const Eigen::VectorXd& shares);

  FacedContact& contact_;
  /// Displacements in the step, pressures and shares of friction after the iteration before; empty: all zero.
  Eigen::VectorXd last_;
  double change_ = 0.0;  ///< of the largest of these in the last iteration
  Eigen::VectorXd solved_;
};

}  // namespace comma::solver
