#include "solver/contact/gap.hpp"

#include <fmt/format.h>

#include "solver/contact/extent.hpp"
#include "solver/contact/row_entries.hpp"
#include "solver/mesh/place.hpp"

namespace comma::solver {
namespace {

using Eigen::Vector3d;

/// Gaps are known to the rounding of coordinates: as a share of them, what a condition's tolerance makes of it.
constexpr double coordinate_share = 1e-5;

}  // namespace

Inequalities gap_rows(std::span<const ContactPair> pairs, const Mesh& mesh, const DofMap& dofs,
                      std::vector<int>& row_pairs) {
  RowEntries entries(mesh, dofs);
  std::vector<double> bounds, sizes;
  row_pairs.clear();
  for (std::size_t index = 0; index < pairs.size(); ++index) {
    const ContactPair& pair = pairs[index];
    if (pair.status != PairingStatus::paired) continue;
    const int row = static_cast<int>(bounds.size());
    Vector3d apart = place(mesh, pair.slave);
    entries.add(row, pair.slave, -pair.normal);
    const auto nodes = mesh.cell(pair.facet);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      apart -= pair.weights[i] * place(mesh, nodes[i]);
      entries.add(row, nodes[i], pair.weights[i] * pair.normal);
    }
    bounds.push_back(pair.normal.dot(apart) - pair.thickness);
    sizes.push_back(extent(mesh, pair.facet) + coordinate_share * place(mesh, pair.slave).cwiseAbs().maxCoeff());
    row_pairs.push_back(static_cast<int>(index));
  }
  Inequalities result;
  result.rows = entries.matrix(static_cast<Eigen::Index>(bounds.size()));
  result.bounds = Eigen::Map<const Eigen::VectorXd>(bounds.data(), static_cast<Eigen::Index>(bounds.size()));
  result.sizes = Eigen::Map<const Eigen::VectorXd>(sizes.data(), static_cast<Eigen::Index>(sizes.size()));
  return result;
}

}  // namespace comma::solver
