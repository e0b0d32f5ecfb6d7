// The model: which finite element each cell carries, and where degrees of freedom therefore exist.
#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "solver/mesh/mesh.hpp"
#include "solver/model/component.hpp"

namespace comma::solver {

/// The mechanical assumption of a cell. `none`: the cell carries no element.
enum class Formulation : std::uint8_t {
  none,
  solid,
  solid_reduced,
  plane_strain,
  plane_strain_reduced,
  plane_stress,
  plane_stress_reduced,
  axisymmetric,
  axisymmetric_reduced,
  bar,
  bar_2d,
  euler_beam,
  timoshenko_beam,
  spring_3d,
  spring_rotation_3d,
  spring_2d,
  spring_rotation_2d,
  thin_plate,
  shear_plate,
  solid_pressure,
  plane_strain_pressure,
  axisymmetric_pressure,  // with the pressure as an unknown
  solid_swelling,
  plane_strain_swelling,
  axisymmetric_swelling  // with the change of volume besides
};

/// Dimension of the cells that carry a continuum formulation's stiffness: 3 for solids, 2 for plane and axisymmetric
/// bodies, 0 for formulations without a continuum.
int continuum_dimension(Formulation formulation);
/// Whether elements of a formulation exist on cells of a type at all, skin elements included.
bool has_element(Formulation formulation, CellType type);
bool is_axisymmetric(Formulation formulation);
/// How many fields an element has besides displacements: 1 for the pressure, 2 with the change of volume, else 0.
int mixed_field_count(Formulation formulation);
/// Whether elements are flat plates in space, with three translations and three rotations a node.
bool is_plate(Formulation formulation);
bool is_bar(Formulation formulation);
/// Springs, masses and dampers, on points and segments.
bool is_discrete(Formulation formulation);
bool is_beam(Formulation formulation);
bool is_plane_stress(Formulation formulation);  ///< with full or reduced integration
bool is_reduced(Formulation formulation);       ///< integrated at fewer points
/// Whether elements have one point of integration, and forces on hourglass patterns besides.
bool is_stabilised(Formulation formulation, CellType type);

/// Elements on cells. Cells of lower dimension than their continuum formulation (the edges of a plane model, the faces
/// and edges of a solid one) are skin elements: they carry no stiffness but take pressure and contact. The edges of
/// plates are skin elements too, which take forces along a line.
struct Model {
  std::shared_ptr<Mesh> mesh;             ///< shared: a group added to the mesh later is known here
  std::vector<Formulation> formulations;  ///< one a cell

  /// Whether the cell is the skin of its formulation's continuum or plate rather than part of it.
  bool is_skin(int cell) const;
  /// The components that the element of a cell gives to each of its nodes (0 where it carries none).
  ComponentMask components_of(int cell) const;
  /// What it gives to its corners besides.
  ComponentMask corner_components_of(int cell) const;
  /// Whether any cell has more unknowns than displacements and rotations: its stiffness is then that of a saddle.
  bool is_mixed() const;
};

/// The numbering of degrees of freedom: those of a node are consecutive, in the order of Component; a node without any
/// element has none.
class DofMap {
 public:
  explicit DofMap(const Model& model);

  int size() const { return starts_.back(); }
  int node_count() const { return static_cast<int>(masks_.size()); }
  ComponentMask components(int node) const { return masks_[node]; }
  /// Index of the degree of freedom, -1 where the node has no such component.
  int dof(int node, Component component) const;
  /// The node's first degree of freedom (where it has none: that of the next node that has).
  int first_dof(int node) const { return starts_[node]; }
  int node_of(int dof) const { return nodes_[dof]; }
  Component component_of(int dof) const { return components_[dof]; }

 private:
  std::vector<ComponentMask> masks_;
  std::vector<int> starts_;
  std::vector<int> nodes_;
  std::vector<Component> components_;
};

}  // namespace comma::solver
