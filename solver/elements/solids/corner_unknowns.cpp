#include "solver/elements/solids/corner_unknowns.hpp"

#include <algorithm>
#include <array>

#include "solver/elements/element_block.hpp"
#include "solver/mesh/reference_element.hpp"

namespace comma::solver {

namespace {

constexpr std::array<Component, 2> all_fields = {Component::pressure, Component::swelling};

}  // namespace

CellType linear_cell(const Model& model, int cell) {
  switch (model.mesh->cell_types[cell]) {
    case CellType::tria6:
      return CellType::tria3;
    case CellType::quad8:
      return CellType::quad4;
    case CellType::tetra10:
      return CellType::tetra4;
    case CellType::penta15:
      return CellType::penta6;
    case CellType::hexa20:
      return CellType::hexa8;
    default:
      throw_unsupported_element(model, cell);
  }
}

CornerUnknowns::CornerUnknowns(const SparsePattern& pattern, const DofMap& dofs, int fields, int corners)
    : pattern_(pattern), dofs_(dofs), fields_(all_fields.begin(), all_fields.begin() + fields), corners_(corners) {}

void CornerUnknowns::dofs(std::span<const int> nodes, int* out) const {
  for (const Component field : fields_)
    for (int corner = 0; corner < corners_; ++corner)
      *out++ = dofs_.dof(nodes[static_cast<std::size_t>(corner)], field);
}

/// The entry (row, column) of the lower triangle: columns of a node share their rows, the first of them holding them
/// all.
std::ptrdiff_t CornerUnknowns::place(int row, int column, std::span<const int> column_starts) const {
  const int row_node = dofs_.node_of(row), column_node = dofs_.node_of(column);
  const int start = column_starts[static_cast<std::size_t>(column)];
  if (row_node == column_node) return start + row - column;
  return start - (column - dofs_.first_dof(column_node)) + pattern_.pair_offset(row_node, column_node) + row -
         dofs_.first_dof(row_node);
}

void CornerUnknowns::add(std::span<const int> nodes, std::span<const int> displacements, const double* coupling,
                         const double* own, int stride, std::span<const int> column_starts, double* values) const {
  std::array<int, all_fields.size() * max_nodes> unknowns;
  dofs(nodes, unknowns.data());
  for (std::size_t j = 0; j < static_cast<std::size_t>(count()); ++j) {
    for (const int dof : displacements) {
      const auto [low, high] = std::minmax(dof, unknowns[j]);
      values[place(high, low, column_starts)] += *coupling++;
    }
    // A collapsed cell has a corner twice: both orders of the pair then fall on one entry.
    for (std::size_t i = 0; i < static_cast<std::size_t>(count()); ++i)
      if (unknowns[i] >= unknowns[j])
        values[place(unknowns[i], unknowns[j], column_starts)] += own[j * static_cast<std::size_t>(stride) + i];
  }
}

}  // namespace comma::solver
