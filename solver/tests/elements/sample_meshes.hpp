// Small meshes for the tests of elements.
#pragma once

#include <cmath>
#include <memory>

#include "solver/elements/assembler.hpp"
#include "solver/mesh/reference_element.hpp"

namespace comma::solver::testing {

/// The reference cell of a type as a mesh of one cell, moved by a smooth map: `bend` = 0 leaves it affine (but sheared
/// and stretched), else sides curve.
inline std::shared_ptr<Mesh> single_cell(CellType type, double bend = 0.0) {
  auto mesh = std::make_shared<Mesh>();
  mesh->dimension = dimension(type) == 3 ? 3 : 2;
  std::vector<int> nodes;
  for (const auto& at : reference_nodes(type)) {
    const double x = 2.0 + 1.1 * at[0] + 0.2 * at[1] + 0.15 * at[2] + bend * at[0] * at[1];
    const double y = 1.0 - 0.1 * at[0] + 0.9 * at[1] + 0.1 * at[2] - bend * at[1] * at[2] + 0.5 * bend * at[0] * at[1];
    const double z = mesh->dimension == 2 ? 0.0 : 0.3 + 0.2 * at[0] - 0.1 * at[1] + 1.2 * at[2] + bend * at[0] * at[2];
    nodes.push_back(mesh->node_count());
    mesh->nodes.push_back({x, y, z});
  }
  mesh->add_cell(type, nodes);
  return mesh;
}

inline std::shared_ptr<const Material> elastic(double young, double poisson) {
  Material material;
  material.elasticity = IsotropicElasticity{young, poisson};
  return std::make_shared<const Material>(material);
}

/// A model with everything that an assembler needs; keeps it all alive.
struct Body {
  Model model;
  MaterialField materials;
  ElementProperties properties;
  std::unique_ptr<DofMap> dofs;
  std::unique_ptr<Assembler> assembler;

  Body(std::shared_ptr<Mesh> mesh, std::vector<Formulation> formulations, std::shared_ptr<const Material> material,
       ElementProperties springs = {})
      : model{std::move(mesh), std::move(formulations)}, properties(std::move(springs)) {
    materials.by_cell.assign(model.mesh->cell_types.size(), std::move(material));
    dofs = std::make_unique<DofMap>(model);
    assembler = std::make_unique<Assembler>(model, materials, properties, *dofs);
  }

  Body(std::shared_ptr<Mesh> mesh, Formulation formulation, std::shared_ptr<const Material> material)
      : Body(mesh, std::vector<Formulation>(mesh->cell_types.size(), formulation), std::move(material)) {}

  Eigen::VectorXd zero() const { return Eigen::VectorXd::Zero(dofs->size()); }
  Eigen::MatrixXd dense_stiffness() const {
    const SymmetricMatrix lower = assembler->stiffness(zero());
    const SymmetricMatrix full = lower.selfadjointView<Eigen::Lower>();
    return full;
  }
  /// Displacements by a function of place and component.
  template <class F>
  Eigen::VectorXd displacements(F&& at) const {
    Eigen::VectorXd u(dofs->size());
    for (int dof = 0; dof < dofs->size(); ++dof) {
      u[dof] = at(model.mesh->nodes[dofs->node_of(dof)], static_cast<int>(dofs->component_of(dof)));
    }
    return u;
  }
};

inline constexpr CellType plane_types[] = {CellType::tria3, CellType::tria6, CellType::tria7,
                                           CellType::quad4, CellType::quad8, CellType::quad9};
inline constexpr CellType solid_types[] = {CellType::tetra4, CellType::tetra10, CellType::pyram5,  CellType::pyram13,
                                           CellType::penta6, CellType::penta15, CellType::penta18, CellType::hexa8,
                                           CellType::hexa20, CellType::hexa27};

}  // namespace comma::solver::testing
