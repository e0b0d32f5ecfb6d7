#include "solver/contact/row_entries.hpp"

#include <fmt/format.h>

#include "solver/error.hpp"

namespace comma::solver {

void RowEntries::add(int row, int node, const Eigen::Vector3d& coefficients) {
  for (int axis = 0; axis < 3; ++axis) {
    if (coefficients[axis] == 0.0) continue;
    const int dof = dofs_.dof(node, translation_components[axis]);
    if (dof < 0)
      throw Error(
          "unknown-dof",
          fmt::format("node {} of a contact surface carries no {}", mesh_.node_name(node),
                      name_of(translation_components[axis])),
          "the model gives its cells no element: extend AFFE_MODELE, or take the cells out of the contact zone");
    entries_.emplace_back(row, dof, coefficients[axis]);
  }
}

Eigen::SparseMatrix<double, Eigen::RowMajor> RowEntries::matrix(Eigen::Index rows) const {
  Eigen::SparseMatrix<double, Eigen::RowMajor> result(rows, dofs_.size());
  result.setFromTriplets(entries_.begin(), entries_.end());
  return result;
}

}  // namespace comma::solver
