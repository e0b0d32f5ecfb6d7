// What blocks of discrete elements have in common, whatever their law.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "solver/elements/discrete/discrete_forces.hpp"

namespace comma::solver {

/// Points or segments of one kind. Initial stresses change their stiffness by nothing.
class DiscreteElements : public ElementBlock {
 public:
  std::span<const int> cells() const override { return cells_; }
  /// Segments have a point at each end.
  int point_count() const override { return node_count_; }
  std::span<const std::string_view> stress_names() const override { return discrete_force_names(formulation_); }
  void add_geometric_stiffness(std::span<const double>, const VariableState&, std::span<const int>,
                               double*) const override {}

 protected:
  DiscreteElements(const BlockInput& input, std::vector<int> cells)
      : mesh_(*input.model.mesh),
        formulation_(input.model.formulations[static_cast<std::size_t>(cells.front())]),
        translations_(discrete_translations(formulation_)),
        node_count_(static_cast<int>(mesh_.cell(cells.front()).size())),
        cells_(std::move(cells)),
        map_(input.pattern, input.dofs, input.model.components_of(cells_.front()), node_count_,
             gather_nodes(mesh_, cells_)) {}

  /// Where the values of an element begin in a field, `count` of them a point.
  std::size_t begin_of(int element, int count) const { return static_cast<std::size_t>(element * node_count_ * count); }
  /// The second end, if there is one, is as the first.
  void repeat_at_second_end(double* first, int count) const {
    if (node_count_ == 2) std::copy_n(first, count, first + count);
  }

  bool is_turn(Eigen::Index unknown) const { return unknown % map_.components() >= translations_; }

  /// Whether `rest` is what turning the stiffness into other axes leaves: translations and rotations have units of
  /// their own.
  bool is_rounding(const Eigen::MatrixXd& rest, const Eigen::MatrixXd& stiffness) const {
    constexpr double rounding_share = 1e-12;
    std::array<double, 2> largest = {0.0, 0.0};
    for (Eigen::Index i = 0; i < stiffness.rows(); ++i)
      for (Eigen::Index j = 0; j < stiffness.cols(); ++j)
        if (is_turn(i) == is_turn(j)) largest[is_turn(i)] = std::max(largest[is_turn(i)], std::abs(stiffness(i, j)));
    for (Eigen::Index i = 0; i < rest.rows(); ++i)
      for (Eigen::Index j = 0; j < rest.cols(); ++j)
        if (std::abs(rest(i, j)) > rounding_share * std::sqrt(largest[is_turn(i)]) * std::sqrt(largest[is_turn(j)]))
          return false;
    return true;
  }

  const Mesh& mesh_;
  Formulation formulation_;
  int translations_;  ///< of the components at a node
  int node_count_;
  std::vector<int> cells_;
  ElementMap map_;
};

}  // namespace comma::solver
