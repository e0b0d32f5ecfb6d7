// When the updates of the geometry within a step may end (RESI_GEOM, U4.44.11).
#pragma once

#include <deque>
#include <optional>
#include <utility>
#include <vector>

#include "solver/contact/contact_points.hpp"
#include "solver/contact/doubts.hpp"
#include "solver/contact/pairing.hpp"
#include "solver/model/model.hpp"
#include "solver/nonlinear/failure.hpp"

namespace comma::solver {

/// How far nodes have moved.
struct GeometryChange {
  double share = 0.0;  ///< of the largest displacement of the step before the move (after the first move of a step);
                       ///< 0 where only rounding moves
  int worst = -1;      ///< the node that moved most; -1: none did
};

/// From displacements `paired` to `now`, in a step that began at `start`: all nodes count, and displacements by their
/// length (ssnv104h tells). The share is what Code_Aster 17.3 prints for each geometry, to all six digits.
GeometryChange geometry_change(const Mesh& mesh, const DofMap& dofs, const Eigen::VectorXd& start,
                               const Eigen::VectorXd& paired, const Eigen::VectorXd& now);

/// Follows the updates of one step.
class GeometryUpdates {
 public:
  /// `start`: the displacements at the beginning of the step. All arguments are kept by reference.
  GeometryUpdates(const ContactDefinition& contact, const Mesh& mesh, const DofMap& dofs, const Eigen::VectorXd& start);

  /// Whether no node has moved from `paired` (the displacements when surfaces were last paired) to `now` by more than
  /// RESI_GEOM of the largest displacement of this step (see geometry_change), or the prescribed number of updates is
  /// done; or where it goes to and fro (see restless()).
  bool settled(const Eigen::VectorXd& paired, const Eigen::VectorXd& now);

  /// Of a geometry that is settled: that it moves to and fro by more than the user asks for (of Newton's method: than
  /// the root of what is aimed at), or that points that hop between two facets have been left on one of them by more
  /// than what hardly shows. `pairs`, `points`: the last ones, whichever there are.
  void note_doubts(const std::vector<ContactPair>& pairs, const std::vector<ContactPoint>& points,
                   ContactDoubts& doubts) const;

  /// By how much of the largest displacement of the step a geometry that is settled goes on moving to and fro, within
  /// what is tolerated of it: points that hop between two facets, or a penalty whose rounding moves them. 0: it is at
  /// rest.
  double restless() const { return restless_; }

  /// By how much of its size points keep the facet that they faced when surfaces are paired next (FacedFacet): nothing
  /// at first, and more and more of it in updates that do not settle.
  double margin() const;

  /// The displacements at which surfaces are to be paired next: those of the last solution, or of updates that do not
  /// come nearer to rest the relaxed ones (Aitken's factor of vectors: Kuettler and Wall, Computational Mechanics 43,
  /// 2008, section 3), and of those that come nearer where many digits are wanted the accelerated ones. `paired`,
  /// `now`: as settled() was given.
  Eigen::VectorXd relaxed(const Eigen::VectorXd& paired, const Eigen::VectorXd& now);

  /// To be told the pairs of each geometry: facets that return after others took their place, several times over, will
  /// go on returning.
  void note_cycle(const std::vector<ContactPair>& pairs);

  /// Error `contact-cycling` or `no-convergence` when as many updates are done as the definition allows.
  void require_more(double time) const;

 private:
  const ContactDefinition& contact_;
  const Mesh& mesh_;
  const DofMap& dofs_;
  const Eigen::VectorXd& start_;
  double margin_of(int done) const;
  bool only_rounding_moves() const;
  std::optional<Eigen::VectorXd> accelerated(const Eigen::VectorXd& paired, const Eigen::VectorXd& now);
  bool goes_to_and_fro() const;

  GeometryHistory history_;
  double restless_ = 0.0;
  double relaxation_ = 1.0;
  Eigen::VectorXd last_move_;  ///< of the solution from where its surfaces were paired
  /// Where surfaces were paired and where nodes went from there, in the updates that are accelerated.
  std::deque<std::pair<Eigen::VectorXd, Eigen::VectorXd>> earlier_;
  int worst_ = -1;  ///< the node that moved most
  std::vector<std::vector<ContactPair>> visited_;
};

}  // namespace comma::solver
