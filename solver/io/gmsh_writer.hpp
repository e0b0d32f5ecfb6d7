// Meshes and fields for Gmsh (its reference manual, MSH file format version 2.2, text).
#pragma once

#include <span>
#include <string>
#include <vector>

#include "solver/fields/data/field.hpp"

namespace comma::solver {

/// One view of Gmsh: values of a field at one step.
struct GmshView {
  std::string name;
  double instant = 0.0;
  int step = 0;
  const Field* field = nullptr;
  /// Columns of the field, in Gmsh's order: one value, three of a vector or nine of a tensor, row by row; -1 stands for
  /// 0.
  std::vector<int> columns;
};

/// The nodes, those of the `cells`, and the views on them: $NodeData, $ElementData or, at the nodes of cells,
/// $ElementNodeData. Places that carry none of the columns are left out of a view. Throws Error `unsupported` for a
/// cell type that Gmsh does not have, and for a field at Gauss points.
std::string format_gmsh(const Mesh& mesh, std::span<const int> cells, std::span<const GmshView> views);

}  // namespace comma::solver
