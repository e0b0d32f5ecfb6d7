// What blocks of discrete elements have in common, whatever their law.
#pragma once

#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "solver/elements/discrete_forces.hpp"

namespace comma::solver {

/// Points or segments of one kind. Initial stresses change their stiffness by nothing.
class DiscreteElements : public ElementBlock {
 public:
  std::span<const int> cells() const override { return cells_; }
  int point_count() const override { return 1; }
  std::span<const std::string_view> stress_names() const override { return discrete_force_names(formulation_); }
  void add_geometric_stiffness(std::span<const double>, const VariableState&, std::span<const int>, double*) const override {}

 protected:
  DiscreteElements(const BlockInput& input, std::vector<int> cells)
      : mesh_(*input.model.mesh),
        formulation_(input.model.formulations[static_cast<std::size_t>(cells.front())]),
        translations_(discrete_translations(formulation_)),
        node_count_(static_cast<int>(mesh_.cell(cells.front()).size())),
        cells_(std::move(cells)),
        map_(input.pattern, input.dofs, input.model.components_of(cells_.front()), node_count_, gather_nodes(mesh_, cells_)) {}

  const Mesh& mesh_;
  Formulation formulation_;
  int translations_;  ///< of the components at a node
  int node_count_;
  std::vector<int> cells_;
  ElementMap map_;
};

}  // namespace comma::solver
