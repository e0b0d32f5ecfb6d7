#include <bit>

#include "solver/model/model.hpp"

namespace comma::solver {

DofMap::DofMap(const Model& model) : masks_(model.mesh->nodes.size(), 0), starts_(1, 0) {
  const Mesh& mesh = *model.mesh;
  for (int cell = 0; cell < mesh.cell_count(); ++cell) {
    const ComponentMask mask = model.components_of(cell);
    const auto nodes = mesh.cell(cell);
    for (const int node : nodes) masks_[node] |= mask;
    const ComponentMask at_corners = model.corner_components_of(cell);
    if (at_corners == 0) continue;
    for (const int node : nodes.first(static_cast<std::size_t>(corner_count(mesh.cell_types[cell]))))
      masks_[node] |= at_corners;
  }
  starts_.reserve(masks_.size() + 1);
  for (int node = 0; node < node_count(); ++node) {
    for (int c = 0; c < component_count; ++c) {
      const auto component = static_cast<Component>(c);
      if (!contains(masks_[node], component)) continue;
      nodes_.push_back(node);
      components_.push_back(component);
    }
    starts_.push_back(static_cast<int>(nodes_.size()));
  }
}

int DofMap::dof(int node, Component component) const {
  const ComponentMask mask = masks_[node];
  if (!contains(mask, component)) return -1;
  const auto before = static_cast<ComponentMask>(mask & (mask_of(component) - 1));
  return starts_[node] + std::popcount(before);
}

}  // namespace comma::solver
