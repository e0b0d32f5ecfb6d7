// Forces and moments of plates about their own middle (POST_CHAMP, COQU_EXCENT; U4.81.05, R3.07.06), and the strains
// that go with them (R3.07.03).
#pragma once

#include <array>
#include <span>

#include <Eigen/Dense>

#include "solver/elements/slender/section.hpp"
#include "solver/fields/data/field.hpp"
#include "solver/fields/points/continuum_points.hpp"

namespace comma::solver {

/// NXX ... QY.
using PlateForces = Eigen::Matrix<double, 8, 1>;

/// Reads them out of a field that outlives it.
class PlateForceReader {
 public:
  /// Throws Error `unknown-component` for a field without them.
  explicit PlateForceReader(const ElementField& field);

  PlateForces at(int cell, int point) const;

 private:
  const ElementField& field_;
  std::array<int, 8> columns_;
};

/// Throws Error `missing-properties` for a plate without thickness.
const PlateSection& plate_section(const Model& model, const ElementProperties& properties, int cell);

/// NXX ... QY of the plates among `cells`, whose moments are given about the surface of the mesh: about the
/// mid-surface, from which the offset e separates it, they are M - e N. Throws Error `unknown-component` for a field
/// without these components, `not-a-plate` where none of the cells is a plate, `missing-properties` for a plate without
/// section.
ElementField forces_about_middle(const Model& model, const ElementProperties& properties, const ElementField& forces,
                                 std::span<const int> cells);

/// DEGE_ELNO: EXX EYY EXY KXX KYY KXY GAX GAY that elastic plates have where their forces (EFGE_ELNO: NXX ... QY,
/// moments about the surface of the mesh) are known; in own axes, about that surface, EXY and KXY being halves of
/// angles, thermal elongation included. GAX and GAY are 0 of plates that do not shear.
ElementField plate_strains(const FieldInput& input, const ElementField& forces);

}  // namespace comma::solver
