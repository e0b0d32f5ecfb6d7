// Penalties of contact that every point has for itself, and that its depth adapts.
#pragma once

#include <span>
#include <vector>

#include "solver/contact/contact_points.hpp"
#include "solver/contact/definition.hpp"
#include "solver/mesh/mesh.hpp"

namespace comma::solver {

/// By how much the penalty of a point grows that lies at `depth`, and lay at `before` the last time (lengths; negative
/// where it is open), with depth > allowed > 0. What Code_Aster 17.3 has of the rule of Bussetta, Marceau and Ponthot
/// (Computational Mechanics 49, 2012), but at least as many times as the point is too deep.
double penalty_growth(double depth, double before, double allowed);

/// How large a master facet counts (a length), by the corners of the undeformed mesh: its length, the sum of both
/// diagonals of a quadrangle, the distance of the third corner of a triangle from the middle of the others.
double facet_size(const Mesh& mesh, int facet);

/// What Code_Aster 17.3 does with ADAPTATION='ADAPT_COEF' and ALGO_CONT='PENALISATION' (U4.44.11), as its figures tell.
/// A step begins with the least penalty of the zone at all points, 1e5 times the ratio of the largest to the smallest
/// master facet that points of it face. The penalty of a point that is too deep grows; one that would then be more than
/// the largest term of the stiffness is divided by a hundred. The first times in a step it does not fall below the
/// least. Where even the least is stiff beside the bodies, points so come to lie at a hundred times the depth allowed
/// at most.
class AdaptedPenalties {
 public:
  /// Points are faced (anew); they come in the same order each time.
  void face(const ContactDefinition& definition, std::span<const ContactPoint> points, const Mesh& mesh);
  /// `closed`: whether points press on each other as it begins.
  void start_step(bool closed);
  /// Whether the first penalties of the step have been at hand from the start, for the law of contact to have held with
  /// them once more than in a first step.
  bool began_adapted() const { return kept_least_ > 1; }

  /// How deep points would lie without contact: before the first adaptation of a step that did not begin so.
  void note_depths(std::vector<double> depths);

  /// A pressure a length.
  double penalty(std::size_t point) const { return penalties_[point]; }
  /// Whether any point of zones that `adapts` is deeper than allowed (depths as below).
  bool is_too_deep(std::span<const char> adapts, std::span<const double> depths) const;
  /// Adapts those of points of zones that `adapts` to their depths (lengths, negative where open). `stiffest`: the
  /// largest term of the stiffness; `keeps_least`: none falls below the least of its zone, however often. Whether any
  /// changed.
  bool adapt(std::span<const char> adapts, std::span<const double> depths, double stiffest, bool keeps_least);
  /// The depth that the zone allows.
  double allowed_depth(std::size_t zone) const { return zones_[zone].allowed; }

 private:
  struct Zone {
    double least = 0.0;
    double allowed = 0.0;
  };
  void begin_with_least();

  std::vector<Zone> zones_;
  std::vector<int> zone_of_;  ///< of each point
  std::vector<double> penalties_;
  std::vector<double> before_;  ///< depths at the last adaptation
  int adaptations_ = 0;         ///< in the step
  int kept_least_ = 1;          ///< how many of them fall below no least penalty
  bool is_first_step_ = true;
};

}  // namespace comma::solver
