// How the material of each cell behaves: how strains follow from displacements, and stresses from strains.
#pragma once

#include <cstdint>
#include <vector>

namespace comma::solver {

enum class Kinematics : std::uint8_t {
  small,           ///< the symmetric part of the gradient
  green_lagrange,  ///< large displacements and rotations, on the initial geometry
  logarithmic,     ///< ln(F^T F) / 2, with laws of small strains (R5.03.24)
  multiplicative,  ///< F = F^e F^p, for isotropic hardening (R5.03.21)
  updated,         ///< small strains of each step's displacement, on the geometry where it ends (PETIT_REAC, U4.51.11)
  large_rotations  ///< large displacements and rotations of beams, small strains (GROT_GDEP, U4.51.11)
};

enum class Relation : std::uint8_t {
  elastic,
  hyperelastic,        ///< rubber, in Green and Lagrange's strains (R5.03.19)
  isotropic_linear,    ///< von Mises, isotropic hardening linear in the plastic strain (R5.03.02)
  isotropic_traction,  ///< ... by a traction curve
  isotropic_power,     ///< ... by a power law
  reversible_linear,   ///< elasticity along the curves of isotropic hardening (Hencky): no flow, no memory (R5.03.20)
  reversible_traction,
  reversible_power,
  isotropic_nonlinear,  ///< ... by saturating exponentials and a power
  kinematic_linear,     ///< von Mises, the centre of the yield surface moving with the plastic strain
  mixed_linear,         ///< both, the isotropic part linear (R5.03.16)
  mixed_traction,       ///< both, the isotropic part from a traction curve
  asymmetric_linear,    ///< of bars: isotropic hardening, linear, one for tension and one for compression (R5.03.09)
  contact_spring,       ///< contact and friction inside a discrete element (R5.03.17)
  bilinear_spring,      ///< a discrete element whose components are elastic with two slopes (R5.03.17)
  hardening_spring,     ///< a discrete element whose components flow, with kinematic hardening (R5.03.17)
};

struct CellBehaviour {
  Kinematics kinematics = Kinematics::small;
  Relation relation = Relation::elastic;
  /// Elasticity adds up from step to step from the stresses of the initial state, as laws with a memory do.
  bool from_initial_state = false;
  /// By how much of the first yield stress a point in plane stress may miss its yield surface; 0: as rounding lets it.
  double return_tolerance = 0.0;
  /// Annealing takes hardening away at the end of each step.
  bool restores_hardening = false;

  auto operator<=>(const CellBehaviour&) const = default;
};

/// Elasticity along a curve of hardening.
constexpr bool is_reversible(Relation relation) {
  return relation == Relation::reversible_linear || relation == Relation::reversible_traction ||
         relation == Relation::reversible_power;
}

/// Von Mises' plasticity whose yield surface grows and does not move.
constexpr bool is_isotropic(Relation relation) {
  return relation == Relation::isotropic_linear || relation == Relation::isotropic_traction ||
         relation == Relation::isotropic_power || relation == Relation::isotropic_nonlinear;
}

/// Small strains, which are sums of those of the steps.
constexpr bool has_small_strains(Kinematics kinematics) {
  return kinematics == Kinematics::small || kinematics == Kinematics::updated;
}

/// Whether stresses depend on more than the displacements of the moment.
constexpr bool has_memory(const CellBehaviour& behaviour) {
  return behaviour.relation != Relation::elastic ||
         (behaviour.from_initial_state &&
          (behaviour.kinematics == Kinematics::small || behaviour.kinematics == Kinematics::green_lagrange)) ||
         behaviour.kinematics == Kinematics::logarithmic || behaviour.kinematics == Kinematics::multiplicative ||
         behaviour.kinematics == Kinematics::updated || behaviour.kinematics == Kinematics::large_rotations;
}

/// One a cell; empty: linear elasticity in small strains everywhere.
using BehaviourOfCells = std::vector<CellBehaviour>;

}  // namespace comma::solver
