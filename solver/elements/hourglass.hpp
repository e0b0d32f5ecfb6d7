// What one point of integration does not see of a hexahedron on eight nodes (T. Belytschko, L. P. Bindeman, Assumed
// strain stabilization of the eight node hexahedral element, CMAME 105, 1993; R3.06.11).
#pragma once

#include <array>

#include <Eigen/Dense>

#include "solver/elements/reference_element.hpp"
#include "solver/materials/elasticity.hpp"

namespace comma::solver {

/// With xi, eta, zeta the reference coordinates, the patterns h are eta zeta, xi zeta, xi eta and xi eta zeta. The
/// displacements of the nodes leave of each what is orthogonal to linear fields, g (pattern, axis), and the
/// displacements that go with it are the sum of h g. Which strains of a pattern count depends on its direction: along
/// the cell's own axes, as in the paper's section on corotation.
class Hourglass {
 public:
  using Places = Eigen::Matrix<double, 8, 3>;       ///< one node a row; also displacements and forces
  using Patterns = Eigen::Matrix<double, 4, 3>;     ///< g, and the forces that do work on it
  using Stiffness = Eigen::Matrix<double, 12, 12>;  ///< on g, axis by axis within a pattern

  /// Which part of the strains of the patterns counts: without parasitic shear, and without what would lock in bending,
  /// or without change of volume.
  enum class Projection : std::uint8_t {
    bending,    ///< ASQBI: a bent elastic body of this Poisson's ratio is as stiff as it is
    deviatoric  ///< ADS: for bodies that flow
  };

  explicit Hourglass(const Places& places);

  /// g of displacements, and the forces on the nodes of forces on g.
  Patterns amplitudes(const Places& displacements) const { return gamma_.transpose() * displacements; }
  Places nodal_forces(const Patterns& forces) const { return gamma_ * forces; }

  /// The integral of B^T D B over the cell by its eight points, B the strains that count.
  Stiffness stiffness(const Matrix6d& law, Projection projection) const;
  /// The same on the displacements of the nodes, (x, y, z) by node.
  Eigen::Matrix<double, 24, 24> nodal_stiffness(const Stiffness& stiffness) const;

 private:
  struct Point {
    double weight;
    Patterns gradients;  ///< of the patterns along the own axes
  };

  Eigen::Matrix3d axes_;  ///< the cell's own, one a row
  Eigen::Matrix<double, 8, 4> gamma_;
  std::array<Point, 8> points_;
};

}  // namespace comma::solver
