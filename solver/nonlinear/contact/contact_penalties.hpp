// The penalties of a contact as they change while steps are solved.
#pragma once

#include <functional>
#include <vector>

#include <Eigen/Dense>

#include "solver/contact_law/adapted_penalties.hpp"
#include "solver/contact_law/raised_penalties.hpp"
#include "solver/nonlinear/contact/contact_augmentations.hpp"
#include "solver/nonlinear/contact/faced_contact.hpp"

namespace comma::solver {

/// Gives the laws of the points the penalties of their zones: as given, raised (RaisedPenalties), or adapted to depths
/// (AdaptedPenalties); a depth that an event of the step limits stands for all others.
class ContactPenalties {
 public:
  /// Those that a step begins with and may be taken back to.
  struct State {
    RaisedPenalties raised;
    AdaptedPenalties adapted;
  };

  /// Keeps references to its arguments.
  ContactPenalties(FacedContact& contact, const ContactAugmentations& augmentations)
      : contact_(contact),
        augmentations_(augmentations),
        state_{RaisedPenalties(contact.definition.zones.size()), {}} {}

  /// `closed`: whether points press on each other as it begins.
  void start_step(bool closed);
  /// Points have been faced anew.
  void note_faced() { state_.adapted.face(contact_.definition, contact_.points(), contact_.mesh); }
  void apply();

  /// Whether a zone gives way (ALGO_CONT='PENALISATION').
  bool exist() const;
  /// Between nodes the pressure of a penalty is that of the states of all points of the face, and these are by it:
  /// there may be none that go together. From now on, in this step, gaps alone are closed or not. Whether any point has
  /// such a law.
  bool open_by_gaps();
  bool opens_by_gaps() const { return opens_by_gaps_; }

  /// From now on penalties are raised, at most by a factor, until no point is deeper than this (a length).
  void limit_depth(double depth, double most_stiffening) { state_.raised.limit_depth(depth, most_stiffening); }
  /// Raises the penalty of zones where points lie deeper at u than allowed, or points that stick slip by more
  /// (MixedZone::largest_slip); whether there were any. Throws Error `no-convergence` where that does not help.
  bool stiffen(const Eigen::VectorXd& u);
  /// Adapts the penalties of points to their depths at u (MixedZone::adapts_penalty), once. `without_contact`: what
  /// gaps are then, empty where nothing but contact holds the bodies; `stiffest`: the largest term of the stiffness.
  /// Both are asked for where they are needed. Whether any changed.
  bool adapt(const Eigen::VectorXd& u, const std::function<Eigen::VectorXd()>& without_contact,
             const std::function<double()>& stiffest);
  /// See AdaptedPenalties.
  bool began_adapted() const { return state_.adapted.began_adapted(); }

  const RaisedPenalties& raised() const { return state_.raised; }
  RaisedPenalties& raised() { return state_.raised; }
  const State& state() const { return state_; }
  void take_back_to(const State& state) { state_ = state; }

 private:
  bool adapts(std::size_t zone) const;
  Excess excess_at(const Eigen::VectorXd& jumps) const;
  std::vector<double> depths(const Eigen::VectorXd& jumps) const;

  FacedContact& contact_;
  const ContactAugmentations& augmentations_;
  State state_;
  bool opens_by_gaps_ = false;
};

}  // namespace comma::solver
