#include "solver/contact/gap.hpp"

#include <fmt/format.h>

#include "solver/contact/extent.hpp"
#include "solver/error.hpp"

namespace comma::solver {
namespace {

using Eigen::Vector3d;

/// Gaps are known to the rounding of coordinates: as a share of them, what a condition's tolerance makes of it.
constexpr double coordinate_share = 1e-5;

Vector3d initial(const Mesh& mesh, int node) { return {mesh.nodes[node][0], mesh.nodes[node][1], mesh.nodes[node][2]}; }

class RowBuilder {
 public:
  RowBuilder(const Mesh& mesh, const DofMap& dofs) : mesh_(mesh), dofs_(dofs) {}

  void add(int row, int node, const Vector3d& coefficients) {
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

  Inequalities finish(const std::vector<double>& bounds) const {
    Inequalities result;
    result.rows.resize(static_cast<Eigen::Index>(bounds.size()), dofs_.size());
    result.rows.setFromTriplets(entries_.begin(), entries_.end());
    result.bounds = Eigen::Map<const Eigen::VectorXd>(bounds.data(), static_cast<Eigen::Index>(bounds.size()));
    return result;
  }

 private:
  const Mesh& mesh_;
  const DofMap& dofs_;
  std::vector<Eigen::Triplet<double>> entries_;
};

}  // namespace

Inequalities gap_rows(std::span<const ContactPair> pairs, const Mesh& mesh, const DofMap& dofs,
                      std::vector<int>& row_pairs) {
  RowBuilder builder(mesh, dofs);
  std::vector<double> bounds, sizes;
  row_pairs.clear();
  for (std::size_t index = 0; index < pairs.size(); ++index) {
    const ContactPair& pair = pairs[index];
    if (pair.status != PairingStatus::paired) continue;
    const int row = static_cast<int>(bounds.size());
    Vector3d apart = initial(mesh, pair.slave);
    builder.add(row, pair.slave, -pair.normal);
    const auto nodes = mesh.cell(pair.facet);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      apart -= pair.weights[i] * initial(mesh, nodes[i]);
      builder.add(row, nodes[i], pair.weights[i] * pair.normal);
    }
    bounds.push_back(pair.normal.dot(apart) - pair.thickness);
    sizes.push_back(extent(mesh, pair.facet) + coordinate_share * initial(mesh, pair.slave).cwiseAbs().maxCoeff());
    row_pairs.push_back(static_cast<int>(index));
  }
  Inequalities result = builder.finish(bounds);
  result.sizes = Eigen::Map<const Eigen::VectorXd>(sizes.data(), static_cast<Eigen::Index>(sizes.size()));
  return result;
}

}  // namespace comma::solver
