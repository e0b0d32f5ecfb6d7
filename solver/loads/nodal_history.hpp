// A load that a result holds at nodes, in time (U4.44.01, EVOL_CHAR).
#pragma once

#include <vector>

#include "solver/fields/field.hpp"

namespace comma::solver {

/// The first component of fields at rising instants, linear in time between them; one alone holds at all times.
class NodalHistory {
 public:
  void add(double instant, NodalField field);
  bool empty() const { return instants_.empty(); }
  /// Whether the node has a value at every instant.
  bool covers(int node) const;
  /// Throws Error `out-of-function` for a time before the first or after the last instant.
  double at(int node, double time) const;

 private:
  std::vector<double> instants_;
  std::vector<NodalField> fields_;
};

}  // namespace comma::solver
