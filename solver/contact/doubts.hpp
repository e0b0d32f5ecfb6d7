// What may be wrong with a solution of contact although its equations are solved.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "solver/contact/definition.hpp"
#include "solver/contact/pairing.hpp"
#include "solver/mesh/mesh.hpp"

namespace comma::solver {

enum class DoubtKind : std::uint8_t {
  soft_penalty,   ///< slave points sink in by a good part of what they would without contact
  deep_penalty,   ///< they sink in by a good part of the size of the slave side
  soft_friction,  ///< points that stick creep by a good part of what they would slip without contact
  held_overlap,   ///< conditions on displacements hold a point inside the master, and a penalty gives it no force
  sparse_points,  ///< slave points are so far apart that master nodes between them can go through the slave side
  stale_geometry  ///< the gap between the surfaces as they are is not the one that was solved for: they have moved on since they were paired
};

struct ContactDoubt {
  DoubtKind kind = DoubtKind::soft_penalty;
  int zone = 0;
  double share = 0.0;    ///< of the depth or slip in what the kind compares it with; `sparse_points`: distance of slave points over size of master facets
  double length = 0.0;   ///< m: depth or slip
  double penalty = 0.0;  ///< the present one
  double wanted = 0.0;   ///< one that would leave a share of `penalty_goal`
  int cell = -1;         ///< slave face of a held overlap
  int node = -1;         ///< slave node of a stale geometry
};

/// The deepest of each kind in each zone.
class ContactDoubts {
 public:
  /// Takes the doubt if there is no deeper one of its kind in its zone.
  void note(const ContactDoubt& doubt);
  const std::vector<ContactDoubt>& all() const { return all_; }

 private:
  std::vector<ContactDoubt> all_;
};

/// Contact forces are short by about the share that points sink in: below this it passes for what a penalty is expected to leave.
inline constexpr double doubtful_share = 1e-2;
/// A depth beyond this share of the size of the slave side is no more a contact.
inline constexpr double doubtful_depth = 0.1;
/// What the penalty that is proposed leaves.
inline constexpr double penalty_goal = 1e-3;
/// On meshes in two dimensions resultants are wrong by 3 % where slave points lie two master facets apart, by 11 % where it is four
/// (docs/stability.md).
inline constexpr double sparse_spacing = 3.0;

/// The penalty that leaves `penalty_goal`, the next power of ten, where the present one leaves `share`: both in series with the
/// compliance of the bodies.
double wanted_penalty(double penalty, double share);

/// Doubts of kind `sparse_points`. `point_counts`: slave points of each zone; `facets`: the master facets that they face, zone by
/// zone; `gives_way`: whether a node can move: master surfaces that are held all over cannot go anywhere.
void note_sparse_points(const ContactDefinition& definition, const Mesh& mesh, const std::vector<int>& point_counts,
                        const std::vector<std::vector<int>>& facets, const std::function<bool(int)>& gives_way, ContactDoubts& doubts);

/// By how much a slave node stands off its place on the facet, along the pair's normal; negative where it has gone in.
double gap_at(const ContactPair& pair, const Mesh& mesh, Positions positions);

/// Slave nodes whose gap, as pairs `before` have it, is not that of pairs `now`, of the surfaces as they are. `pushed_back`: how far contact
/// forces move the slave side, the measure of what counts.
struct StaleGaps {
  const std::vector<ContactPair>& before;
  const std::vector<ContactPair>& now;
  double pushed_back = 0.0;
};

/// Doubts of kind `stale_geometry`, of errors beyond `doubtful_share` of what contact pushes back.
void note_stale_geometry(const ContactDefinition& definition, const Mesh& mesh, Positions positions, const StaleGaps& gaps, ContactDoubts& doubts);

}  // namespace comma::solver
