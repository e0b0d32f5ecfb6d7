// What a converged step of the mixed formulation gives reason to doubt.
#pragma once

#include <functional>
#include <vector>

#include <Eigen/Dense>

#include "solver/contact/doubts.hpp"
#include "solver/contact_law/raised_penalties.hpp"
#include "solver/nonlinear/contact/faced_contact.hpp"

namespace comma::solver {

/// How far forces on the rows move the bodies there (lengths).
using PushedBy = std::function<Eigen::VectorXd(const Eigen::VectorXd& forces)>;

/// How the bodies answer, and how the law was solved.
struct ContactResponse {
  PushedBy pushed_by;  ///< costs a solve
  std::function<std::vector<double>()> pushed_back;
  const RaisedPenalties& penalties;
  bool by_shears = false;                ///< see CondensedSolution
  bool augmentation_is_lowered = false;  ///< between nodes, below what is given
  bool opens_by_gaps = false;            ///< see ContactLaw
};

/// How far penalties, and faces too coarse for what they touch, let the bodies into each other.
void note_doubts(const SolvedContact& contact, const ContactResponse& response, ContactDoubts& doubts);

/// The rows along which points that are closed hold the bodies, each of unit length, on the reduced unknowns.
RowMatrix closed_rows(const SolvedContact& contact);

/// How far contact forces move the points of each zone, at most (lengths): all of them or those of the zone alone,
/// since those of another zone may push the other way, and 0 of zones that have none, of which the others are no
/// measure.
std::vector<double> pushed_back(const SolvedContact& contact, const PushedBy& pushed_by);

}  // namespace comma::solver
