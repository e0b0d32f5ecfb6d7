#include "solver/unilateral/conditions.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "solver/error.hpp"
#include "solver/linear/row_matrix.hpp"

namespace comma::solver {
namespace {

/// Imposed values may miss a bound by this share of the terms before they contradict it: above any rounding in T and g.
constexpr double feasibility_tolerance = 1e-9;

int require_dof(const DofMap& dofs, const Mesh& mesh, int node, Component component) {
  const int dof = dofs.dof(node, component);
  if (dof >= 0) return dof;
  throw Error(
      "unknown-dof",
      fmt::format("node {} carries no {}, which a unilateral condition uses", mesh.node_name(node), name_of(component)),
      "check the condition's components, or that the model gives an element to the node's cells");
}

/// The size of what is summed in A g - b: what roundings are measured against.
double term_size(const Inequalities& full, int row, const Eigen::VectorXd& offset) {
  double size = std::max(std::abs(full.bounds[row]), full.sizes.size() ? full.sizes[row] : 0.0);
  for (RowMatrix::InnerIterator it(full.rows, row); it; ++it) size += std::abs(it.value() * offset[it.col()]);
  return size;
}

}  // namespace

double largest_entry(const RowMatrix& rows, int row) {
  double largest = 0.0;
  for (RowMatrix::InnerIterator it(rows, row); it; ++it) largest = std::max(largest, std::abs(it.value()));
  return largest;
}

Inequalities unilateral_rows(std::span<const UnilateralCondition> conditions, const Mesh& mesh, const DofMap& dofs,
                             double time) {
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<double> bounds;
  std::vector<double> softness;
  for (const UnilateralCondition& condition : conditions) {
    for (const int node : condition.nodes) {
      const int row = static_cast<int>(bounds.size());
      const Point& at = mesh.nodes[node];
      for (std::size_t k = 0; k < condition.components.size(); ++k)
        entries.emplace_back(row, require_dof(dofs, mesh, node, condition.components[k]),
                             condition.coefficients[k](at, time));
      bounds.push_back(condition.bound(at, time));
      softness.push_back(condition.penalty > 0.0 ? 1.0 / condition.penalty : 0.0);
    }
  }
  Inequalities result;
  result.rows.resize(static_cast<Eigen::Index>(bounds.size()), dofs.size());
  result.rows.setFromTriplets(entries.begin(), entries.end());
  result.bounds = Eigen::Map<const Eigen::VectorXd>(bounds.data(), static_cast<Eigen::Index>(bounds.size()));
  result.softness = Eigen::Map<const Eigen::VectorXd>(softness.data(), static_cast<Eigen::Index>(softness.size()));
  return result;
}

ReducedInequalities reduce(const Inequalities& full, const Elimination& elimination, const Eigen::VectorXd& offset,
                           const std::function<std::string(int row)>& describe) {
  const RowMatrix product = full.rows * RowMatrix(elimination.transformation());
  const Eigen::VectorXd bounds = full.bounds - full.rows * offset;
  ReducedInequalities reduced;
  std::vector<Eigen::Triplet<double>> entries;
  for (int row = 0; row < static_cast<int>(product.rows()); ++row) {
    const double threshold = empty_row_tolerance * largest_entry(full.rows, row);
    const int position = static_cast<int>(reduced.origin.size());
    bool empty = true;
    for (RowMatrix::InnerIterator it(product, row); it; ++it) {
      if (std::abs(it.value()) <= threshold) continue;
      entries.emplace_back(position, static_cast<int>(it.col()), it.value());
      empty = false;
    }
    if (!empty) {
      reduced.origin.push_back(row);
    } else if (full.softness_of(row) == 0.0 && bounds[row] < -feasibility_tolerance * term_size(full, row, offset)) {
      throw Error("contradictory-conditions",
                  fmt::format("imposed displacements violate {} by {:.6g}", describe(row), -bounds[row]),
                  "the node is held where the condition forbids it to be: change the imposed value or the condition");
    }
  }
  const Eigen::Index count = static_cast<Eigen::Index>(reduced.origin.size());
  reduced.inequalities.rows.resize(count, elimination.reduced_size());
  reduced.inequalities.rows.setFromTriplets(entries.begin(), entries.end());
  reduced.inequalities.bounds.resize(count);
  reduced.inequalities.softness.resize(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    reduced.inequalities.bounds[i] = bounds[reduced.origin[i]];
    reduced.inequalities.softness[i] = full.softness_of(reduced.origin[i]);
  }
  return reduced;
}

std::string describe_row(const Inequalities& inequalities, int row, const Mesh& mesh, const DofMap& dofs) {
  std::string text;
  for (RowMatrix::InnerIterator it(inequalities.rows, row); it; ++it) {
    const int dof = static_cast<int>(it.col());
    text += fmt::format("{}{:.6g}*{}({})", text.empty() ? "" : " + ", it.value(), name_of(dofs.component_of(dof)),
                        mesh.node_name(dofs.node_of(dof)));
  }
  return fmt::format("{} <= {:.6g}", text.empty() ? "0" : text, inequalities.bounds[row]);
}

}  // namespace comma::solver
