// What may be wrong with a solution of contact although its equations are solved.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "solver/contact/contact_points.hpp"
#include "solver/contact/definition.hpp"
#include "solver/contact/pairing.hpp"
#include "solver/mesh/mesh.hpp"

namespace comma::solver {

enum class DoubtKind : std::uint8_t {
  soft_penalty,      ///< slave points sink in by a good part of what they would without contact
  deep_penalty,      ///< they sink in by a good part of the size of the slave side
  soft_bound,        ///< bounds that give way are passed by a good part of what they would be without
  coarse_gradients,  ///< projected gradients end where nodes are inside the master by a good part of what they would be
                     ///< without contact
  coarse_friction,   ///< friction still changes where its iterations end (ContactDefinition::friction_tolerance)
  soft_friction,     ///< points that stick creep by a good part of what they would slip without friction
  unshared_friction,     ///< points between nodes rub by shears of the nodes, no solution by shares of the limit having
                         ///< been found
  lowered_augmentation,  ///< between nodes the augmentation is softer than given, no solution having been found with
                         ///< that
  opening_by_gaps,  ///< points between nodes that have penalties open by their gaps, no solution having been found in
                    ///< which pressures of the nodes hold them
  bridged_gap,      ///< surfaces that are held together from the first on (MixedZone::bilateral) were apart
  held_overlap,     ///< conditions on displacements hold a point inside the master, and a penalty gives it no force
  passed_over,      ///< the active set leaves nodes inside the master that an iteration has moved outwards
                    ///< (ActiveSetProblem::beginning)
  passed_master,    ///< master nodes between slave points have gone through the slave side
  passed_average,  ///< under local average contact slave nodes are inside the master: patches hold it in the mean alone
  weak_friction,   ///< points between nodes that slide bear less than the limit of friction: that is of the multipliers
                   ///< of nodes they share with open ones
  strong_friction,    ///< or bear more: a point that opens leaves friction to others of its face, which press less
  coarse_face,        ///< points between nodes overlap: faces that are partly in contact press for all of their points
                      ///< together
  kept_facet,         ///< points that hopped between two facets are left on one of them
  restless_geometry,  ///< updates move the surfaces to and fro, and would go on doing so
  watched_overlap,    ///< bodies lie in each other where contact is watched, and not enforced
  stale_geometry  ///< the gap between the surfaces as they are is not the one that was solved for: they have moved on
                  ///< since they were paired
};

struct ContactDoubt {
  DoubtKind kind = DoubtKind::soft_penalty;
  int zone = 0;
  double share =
      0.0;  ///< of the depth, slip or motion in what the kind compares it with; `passed_over`: the depth;
            ///< `passed_master`, `passed_average`, `coarse_face`: of the mean depth of nodes or points in what contact
            ///< pushes back (infinite where it pushes nothing); `coarse_friction`: by which unknowns change, in the
            ///< largest; `weak_friction`, `strong_friction`: of what points
            ///< that slide lack in the limit of all, or points bear beyond theirs
  double length = 0.0;   ///< m: depth or slip
  double penalty = 0.0;  ///< the present one; `coarse_gradients`: the tolerance (m); `coarse_friction`: that of a share
  double wanted = 0.0;   ///< one that would leave a share of `penalty_goal`
  int cell = -1;         ///< slave face of a held overlap
  int node = -1;  ///< slave node of a stale geometry, a watched overlap or a bridged gap, the node that moves most of a
                  ///< restless one
};

/// The deepest of each kind in each zone.
class ContactDoubts {
 public:
  /// Takes the doubt if there is no deeper one of its kind in its zone.
  void note(const ContactDoubt& doubt);
  const std::vector<ContactDoubt>& all() const { return all_; }
  /// In words, what neither supports nor contact hold in the end, and the loads do not move either: where it stands is
  /// arbitrary.
  void note_loose(const std::string& motions) { loose_ = motions; }
  const std::string& loose() const { return loose_; }

 private:
  std::vector<ContactDoubt> all_;
  std::string loose_;
};

/// Places are exact to this share of a facet's size.
inline constexpr double rounding_of_place = 1e-10;
/// A length below this share of the size of the mesh is what rounding leaves where nothing presses any more.
inline constexpr double rounding_of_length = 1e-15;
/// Contact forces are short by about the share that points sink in: below this it passes for what a penalty is expected
/// to leave.
inline constexpr double doubtful_share = 1e-2;
/// A depth beyond this share of the size of the slave side is no more a contact.
inline constexpr double doubtful_depth = 0.1;
/// What the penalty that is proposed leaves.
inline constexpr double penalty_goal = 1e-3;
/// Contact forces are short by about the share that master nodes have gone through on the mean; below this it passes
/// for what a mesh leaves.
inline constexpr double doubtful_passage = 0.05;

/// Friction is short by this share of its limit over the whole zone; below, that passes for what a mesh leaves.
inline constexpr double doubtful_friction = 0.05;

/// The penalty that leaves `penalty_goal`, the next power of ten, where the present one leaves `share`: both in series
/// with the compliance of the bodies.
double wanted_penalty(double penalty, double share);

/// A doubt about a penalty that leaves the doubt's length of `reach`, what there would be without it; none where that
/// is within `doubtful_share`, or rounding beside `size`, that of the mesh.
void note_soft_penalty(ContactDoubt doubt, double reach, double size, ContactDoubts& doubts);

/// Doubts of kind `passed_master`: on the mean, the master nodes that touch the slave side or are inside it have gone
/// in, beyond where the mesh has them at first, by more than `doubtful_passage` of the most that contact pushes back.
/// Each counts by what it stands for of the faces: the middle nodes of quadratic ones bear most of what presses there.
/// Of zones of local averages without a pairing distance, which see all of the master side, slave nodes inside the
/// master are looked for instead (`passed_average`). Zones whose penalty is known to be soft have no such doubts. Where
/// contact pushes nothing back at all, master nodes count that lay in front of the slave side at first and are behind
/// it.
class PassedMaster {
 public:
  PassedMaster(const ContactDefinition& definition, const Mesh& mesh) : definition_(definition), mesh_(mesh) {}

  /// After each step. `pushed_back`: how far contact forces move the surfaces of each zone apart; `time`: at which
  /// thicknesses are read. Zones whose surfaces cannot be paired the other way round are passed over.
  void look(Positions positions, std::span<const double> pushed_back, double time);
  /// After the last one; after other doubts.
  void conclude(ContactDoubts& doubts) const;

 private:
  struct Depths {
    double size = 0.0;                      ///< of the largest slave face met
    std::unordered_map<int, double> depth;  ///< of the master nodes that face the slave side; negative outside
  };
  void look_at(int index, Positions positions, double pushed, double time);
  const std::unordered_map<int, double>& shares(int index);
  Depths depths(const ContactZone& zone, Positions positions, double time) const;

  const ContactDefinition& definition_;
  const Mesh& mesh_;
  std::map<int, double> pushed_back_;        ///< by zone, the most
  std::unordered_map<int, Depths> initial_;  ///< by zone
  std::map<int, double> deepest_;            ///< by zone, on the mean
  /// By zone, of the nodes that are looked at: the magnitude of the integral of their shape functions.
  std::unordered_map<int, std::unordered_map<int, double>> shares_;
};

/// By how much a slave node stands off its place on the facet, along the pair's normal; negative where it has gone in.
double gap_at(const ContactPair& pair, const Mesh& mesh, Positions positions);

/// Slave nodes whose gap, as pairs `before` have it, is not that of pairs `now`, of the surfaces as they are.
/// `pushed_back`: how far contact forces move the slave side of each zone, the measure of what counts.
struct StaleGaps {
  const std::vector<ContactPair>& before;
  const std::vector<ContactPair>& now;
  std::span<const double> pushed_back;
};

/// Doubts of kind `stale_geometry`, of errors beyond `doubtful_share` of what contact pushes back. Zones of local
/// averages have other gaps:
void note_stale_geometry(const ContactDefinition& definition, const Mesh& mesh, Positions positions,
                         const StaleGaps& gaps, ContactDoubts& doubts);
/// The same of their mean gaps, as the points `before` have them and as the points `now` of the same patches have them.
void note_stale_averages(const ContactDefinition& definition, const Mesh& mesh, Positions positions,
                         std::span<const ContactPoint> before, std::span<const ContactPoint> now,
                         std::span<const double> pushed_back, ContactDoubts& doubts);

}  // namespace comma::solver
