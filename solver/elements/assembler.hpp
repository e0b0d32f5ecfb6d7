// From elements to the global system: stiffness, internal forces, external forces, stresses.
#pragma once

#include <memory>
#include <span>

#include <Eigen/Dense>

#include "solver/elements/section.hpp"
#include "solver/fields/field.hpp"
#include "solver/linear/linear_solver.hpp"
#include "solver/loads/load.hpp"
#include "solver/materials/material.hpp"
#include "solver/model/model.hpp"

namespace comma::solver {

class ImposedStrains;

/// Sums element contributions over all degrees of freedom of a DofMap (no condition applied yet). Blocks of like cells are
/// sorted once, in the constructor, and nothing is allocated inside an element loop. Keeps references to its arguments.
class Assembler {
 public:
  /// Throws Error `missing-material` / `missing-properties` naming a cell that lacks what its element needs, `wrong-size` for a
  /// spring's matrix, `invalid-material`, `invalid-properties`, `distorted-cell`, `unsupported` for a formulation on a cell type
  /// without such an element.
  Assembler(const Model& model, const MaterialField& materials, const ElementProperties& properties, const DofMap& dofs);
  ~Assembler();

  /// Lower triangle of the tangent stiffness at u (size n x n, force / length); the pattern never changes between calls. Rows of
  /// continua, bars and beams add up to exactly zero over each translation (see translation.hpp), so that a residual b - K x taken in
  /// extended precision leaves rigid motions to what really holds them.
  SymmetricMatrix stiffness(const Eigen::VectorXd& u) const;

  /// Internal forces at u (n), accumulated in extended precision so that the equilibrium of a stiff body held by weak
  /// springs is not drowned in rounding.
  Eigen::VectorXd internal_forces(const Eigen::VectorXd& u) const;

  /// External forces (n) of the loads at a time (see external_forces.hpp), on the initial geometry; initial strains take part as
  /// the forces of the stresses that would undo them.
  Eigen::VectorXd external_forces(std::span<const AppliedLoad> loads, double time) const;

  /// The part of external_forces() that initial strains have.
  Eigen::VectorXd initial_strain_forces(std::span<const AppliedLoad> loads, double time) const;

  /// Whether the tangent is the same for every u.
  bool is_linear() const;

  /// Stresses at the Gauss points (SIEF_ELGA): SIXX SIYY SIZZ SIXY (2D), with SIXZ SIYZ in 3D; N for bars; N VY VZ MT MFY MFZ in own
  /// axes for beams (at both ends) and as far as they have them for discrete elements (at their last node). N > 0 in tension.
  ElementField stresses(const Eigen::VectorXd& u) const;
  /// The same less the stresses of the initial strains that the loads impose at a time.
  ElementField stresses(const Eigen::VectorXd& u, std::span<const AppliedLoad> loads, double time) const;

 private:
  ElementField stresses(const Eigen::VectorXd& u, const ImposedStrains* imposed) const;

  struct Blocks;
  const Model& model_;
  const MaterialField& materials_;
  const ElementProperties& properties_;
  const DofMap& dofs_;
  std::unique_ptr<Blocks> blocks_;
};

/// A vector over the degrees of freedom as a nodal field ("DEPL_R", components of the map, NaN where a node has none).
NodalField to_field(const Eigen::VectorXd& values, const DofMap& dofs, std::string quantity);

}  // namespace comma::solver
