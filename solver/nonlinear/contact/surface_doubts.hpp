// What the surfaces of contact tell of each step that has converged.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "solver/contact/doubts.hpp"

namespace comma::solver {

/// A step as its surfaces show it.
struct SurfaceState {
  double instant = 0.0;
  Positions now;
  std::vector<double> pushed_back;  ///< how far contact forces move the surfaces of each zone apart (lengths)
  /// The pairs that were solved with, where the geometry may have moved on since; empty: it has not.
  std::function<std::vector<ContactPair>()> pairs;
  std::span<const ContactPoint> averages;  ///< the points that were solved with, where there are patches of averages
  std::function<std::vector<ContactPoint>()> averages_as_is;  ///< the same as the surfaces are now
};

/// Looks for master nodes that go through the slave side, and for gaps that are not those which were solved for.
class SurfaceDoubts {
 public:
  /// Keeps references.
  SurfaceDoubts(const ContactDefinition& contact, const Mesh& mesh)
      : contact_(contact), mesh_(mesh), passed_master_(contact, mesh) {}

  /// After each step. Surfaces that cannot be paired, or not any more, tell nothing.
  void look(const SurfaceState& state, ContactDoubts& doubts);
  /// After the last step.
  void conclude(ContactDoubts& doubts) const { passed_master_.conclude(doubts); }

 private:
  const ContactDefinition& contact_;
  const Mesh& mesh_;
  PassedMaster passed_master_;
};

}  // namespace comma::solver
