// Materials and their distribution over a mesh.
#pragma once

#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "solver/materials/command_variables.hpp"
#include "solver/materials/contact_spring.hpp"
#include "solver/materials/plasticity.hpp"
#include "solver/materials/property.hpp"
#include "solver/materials/spring_law.hpp"

namespace comma::solver {

/// No temperature of definition: expansion is measured from the reference temperature.
inline constexpr double from_reference = std::numeric_limits<double>::quiet_NaN();

/// Mean thermal expansion, and the temperature from which it was measured.
struct Expansion {
  Expansion(double constant = 0.0)
      : coefficient(constant) {}  // NOLINT(google-explicit-constructor): a number is an expansion
  Expansion(Property measured, double from = from_reference)  // NOLINT(google-explicit-constructor)
      : coefficient(std::move(measured)), definition_temperature(from) {}
  Property coefficient;
  double definition_temperature = from_reference;
};

/// Isotropic linear elasticity. Stresses in the unit of `young`.
struct IsotropicElasticity {
  Property young{};    ///< Young's modulus, > 0
  Property poisson{};  ///< in (-1, 0.5]
  Property density{};
  Expansion expansion{};
  Property drying_shrinkage{};     ///< K_DESSIC: strain for a unit of water content
  Property hydration_shrinkage{};  ///< B_ENDOGE: shrinkage at full hydration
};

/// Orthotropic linear elasticity in the axes L, T, N of each cell. Pairs are in the order LT, LN, TN; a stress along L
/// shrinks T by poisson[LT] / young[L] (R4.01.02).
struct OrthotropicElasticity {
  std::array<Property, 3> young{};  ///< L, T, N
  std::array<Property, 3> poisson{};
  std::array<Property, 3> shear{};
  Property density{};
  std::array<Expansion, 3> expansion{};  ///< L, T, N
};

/// Isotropic in the plane (L, T), with the axis N: an orthotropic law whose shear modulus in the plane follows from the
/// others.
struct TransverseElasticity {
  Property young{};           ///< in the plane
  Property young_normal{};    ///< along N
  Property poisson{};         ///< LT
  Property poisson_normal{};  ///< LN: a stress along L shrinks N by poisson_normal / young
  Property shear_normal{};    ///< G_LN
  Property density{};
  Expansion expansion{};
  Expansion expansion_normal{};
};
OrthotropicElasticity as_orthotropic(const TransverseElasticity& material);

using Elasticity = std::variant<IsotropicElasticity, OrthotropicElasticity>;

struct Material {
  std::optional<Elasticity> elasticity;
  Plasticity plasticity{};
  std::optional<ContactSpring> contact_spring;  ///< of discrete elements
  SpringLaws springs;                           ///< of discrete elements
  bool knows_bilinear_springs = false;
  bool knows_hardening_springs = false;
};

/// The material of each cell; null where none is given.
struct MaterialField {
  std::vector<std::shared_ptr<const Material>> by_cell;
  std::vector<CommandVariable> variables;
};

}  // namespace comma::solver
