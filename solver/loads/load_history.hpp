// A load that a result holds at nodes or on cells, in time (U4.44.01, EVOL_CHAR).
#pragma once

#include <span>
#include <vector>

#include "solver/fields/data/field.hpp"

namespace comma::solver {

/// A component of fields at rising instants, linear in time between them; one alone holds at all times. Fields are at
/// nodes, at the nodes of cells, or one value a cell.
class LoadHistory {
 public:
  void add(double instant, Field field, int component);
  bool empty() const { return entries_.empty(); }
  /// At which instants the node has a value, of fields at nodes.
  Coverage coverage(int node) const { return coverage(-1, {&node, 1}); }
  /// At which instants all nodes of the cell have one there.
  Coverage coverage(int cell, std::span<const int> nodes) const;
  /// At a node, of fields at nodes. Throws Error `out-of-function` for a time before the first or after the last
  /// instant.
  double at(int node, double time) const { return at(-1, 0, node, time); }
  /// At node number `local` of a cell, which is `node` of the mesh.
  double at(int cell, int local, int node, double time) const;

 private:
  struct Entry {
    Field field;
    int component;
    double value(int cell, int local, int node) const;
  };
  std::vector<double> instants_;
  std::vector<Entry> entries_;
};

}  // namespace comma::solver
