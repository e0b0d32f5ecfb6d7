// What one point of integration does not see of a hexahedron on eight nodes (T. Belytschko, L. P. Bindeman, Assumed
// strain stabilization of the eight node hexahedral element, CMAME 105, 1993; R3.06.11), as Code_Aster 17.3 has it.
#pragma once

#include <array>

#include <Eigen/Dense>

#include "solver/materials/elasticity.hpp"
#include "solver/mesh/reference_element.hpp"

namespace comma::solver {

/// With xi, eta, zeta the reference coordinates, the patterns h are eta zeta, xi zeta, xi eta and xi eta zeta. The
/// displacements of the nodes leave of each what is orthogonal to linear fields, g (pattern, axis), and the
/// displacements that go with it are the sum of h g. Which strains of a pattern count depends on its direction, and
/// directions are those of the mesh: the result changes where a cell is turned, or numbered from another corner.
class Hourglass {
 public:
  using Places = Eigen::Matrix<double, 8, 3>;    ///< one node a row; also displacements and forces
  using Patterns = Eigen::Matrix<double, 4, 3>;  ///< g
  /// Of xx, yy, zz, xy, xz, yz: the factors of the derivatives of the patterns, (x, y, z) by pattern. Their sum is the
  /// stress that varies over the cell.
  using Stresses = Eigen::Matrix<double, 6, 12>;
  using Stiffness = Eigen::Matrix<double, 24, 24>;

  /// Which part of the strains of the patterns counts: without parasitic shear, and without what would lock in bending,
  /// or without change of volume.
  enum class Projection : std::uint8_t {
    bending,    ///< ASQBI: a bent elastic body of this Poisson's ratio is as stiff as it is
    deviatoric  ///< ADS: for bodies that flow
  };

  /// Poisson's ratio counts for `bending` alone.
  Hourglass(const Places& places, Projection projection, double poisson);

  Patterns amplitudes(const Places& displacements) const { return gamma_.transpose() * displacements; }

  /// The law times the strains that count.
  Stresses stresses(const Matrix6d& law, const Patterns& amplitudes) const;

  /// The forces on the nodes of a stress that is `middle` and what varies besides, less those that the middle's own
  /// point gives.
  Places forces(const Stresses& stresses, const Vector6d& middle) const;

  /// The derivative of these forces where both stresses follow the law.
  Stiffness stiffness(const Matrix6d& law) const;

  /// The elastic energy of such a stress, less that of the middle's own point.
  double energy(const Matrix6d& law, const Stresses& stresses, const Vector6d& middle) const;

 private:
  using StrainRows = Eigen::Matrix<double, 6, 12>;  // on g, axis by axis within a pattern

  struct Point {
    double weight;
    Patterns derivatives;  ///< of the patterns
  };

  StrainRows rows(const Patterns& derivatives) const;
  Matrix6d counting(const Matrix6d& law) const;

  Projection projection_;
  double poisson_;
  Places gradients_;  ///< of the shape functions at the middle
  Eigen::Matrix<double, 8, 4> gamma_;
  std::array<Point, 8> points_;
  double missing_volume_ = 0.0;  ///< of the middle's own point
};

/// Poisson's ratio of an isotropic law.
double poisson_of(const Matrix6d& law);

}  // namespace comma::solver
