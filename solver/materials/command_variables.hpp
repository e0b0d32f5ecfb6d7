// Command variables: fields known beforehand on which materials depend, temperature first of all (U4.43.03, AFFE_VARC).
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "solver/fields/data/field.hpp"
#include "solver/functions/function.hpp"
#include "solver/materials/property.hpp"

namespace comma::solver {

/// A field at one instant; its first component counts. On nodes, at element nodes, at Gauss points or one value a cell.
struct VariableSnapshot {
  double instant = 0.0;
  std::shared_ptr<const Field> field;
};

/// One variable on some cells. Between two snapshots it is linear in time.
struct CommandVariable {
  Parameter variable = Parameter::temperature;
  std::vector<int> cells;  ///< empty: all
  double reference = std::numeric_limits<double>::quiet_NaN();
  std::vector<VariableSnapshot> snapshots;  ///< rising instants
  Extension left = Extension::excluded;     ///< before the first snapshot
  Extension right = Extension::excluded;
  std::function<double(double)> instant = {};  ///< of the snapshots, at a time of the computation; empty: that time
};

/// The command variables of a body at one instant.
class VariableState {
 public:
  VariableState() = default;
  /// Of two variables of the same kind on one cell the later counts. Throws Error `out-of-function` for a time outside
  /// the snapshots where that is excluded, `incompatible-field` for snapshots that do not fit each other or the mesh,
  /// and for something that is no command variable.
  VariableState(const Mesh& mesh, std::span<const CommandVariable> variables, double time);

  double time() const { return time_; }
  bool empty() const { return entries_.empty(); }
  /// Whether any cell has a strain that is known beforehand.
  bool gives_strains() const { return gives_strains_; }

  static constexpr int all_points = -1;
  /// Fills in time and command variables at a point of a cell. `shape`: the shape functions at the point, one a node of
  /// the cell; `point`: its number among the Gauss points, or `all_points` for the mean over
  /// them. Throws Error `incompatible-field` when a field at Gauss points has not this point.
  void sample(int cell, std::span<const int> nodes, std::span<const double> shape, int point, MaterialPoint& out) const;

 private:
  struct Entry {
    Parameter variable;
    double reference;
    Field field;
  };
  double value(const Entry& entry, int cell, std::span<const int> nodes, std::span<const double> shape,
               int point) const;

  double time_ = 0.0;
  bool gives_strains_ = false;
  std::vector<Entry> entries_;
  /// For each variable that occurs, the entry of each cell (-1: none).
  std::array<std::vector<int>, command_variable_count> entry_of_cell_;
};

}  // namespace comma::solver
