// Forces of loads on the degrees of freedom.
#pragma once

#include <span>

#include "solver/elements/cell_quadrature.hpp"
#include "solver/elements/slender/section.hpp"
#include "solver/loads/load.hpp"
#include "solver/materials/material.hpp"
#include "solver/model/model.hpp"

namespace comma::solver {

/// What forces may depend on.
struct ForceInput {
  const Model& model;
  const MaterialField& materials;
  const ElementProperties& properties;
  const DofMap& dofs;
  const VariableState* state = nullptr;  ///< command variables, on which densities and moduli may depend
};

/// Throws Error `not-a-skin` for a pressure on a cell that is neither a skin cell of a continuum nor a plate,
/// `unsupported` for shear on a face.
void check_pressure(const Model& model, const PressureLoad& load);

/// The pressure of a load (without its multiplier) at a sample of its cell, which lies at `at`, the place that
/// functions are given.
double pressure_at(const PressureLoad& load, const Mesh& mesh, const CellSample& sample, const Point& at, double time);

/// Throws Error `unsupported` for a distributed force on a cell that is no part of a continuum or plate, `unknown-dof`
/// for one along a direction that its nodes do not have.
void check_distributed_force(const Model& model, const DistributedForce& load);

/// The force of a load (without its multiplier) for a unit of measure, at a sample of its cell, as pressure_at().
Eigen::Vector3d distributed_force_at(const DistributedForce& load, const Mesh& mesh, const CellSample& sample,
                                     const Point& at, double time);

/// Adds the forces of the loads at a time to `forces` (one a degree of freedom), on the initial geometry: nodal forces,
/// pressures, distributed forces, forces on beams, gravity and rotation. Initial strains act inside elements: see
/// imposed_strains.hpp.
///
/// A plane edge from node 1 to node 2 has the tangent t = (2 - 1) / |2 - 1| and the normal n = t turned by -90 degrees,
/// which points out of a body whose boundary runs counter-clockwise; a face has its normal by the right-hand rule.
/// Pressure p and shear q act as the traction -p n + q t (U4.44.01, PRES_REP). Axisymmetric loads are per radian.
///
/// Pressures and distributed forces on plates act on the surface of the mesh, on translations alone, which are linear
/// between nodes; a PlateForce acts at any level of the thickness, its height making a moment.
///
/// Gravity and centrifugal forces are those of the mass of continua, bars, beams, plates (about their middle) and
/// discrete elements; what they have across the plane of a plane model is left to the supports that such a model
/// implies.
///
/// Throws Error `unknown-dof` for a force on a component that its node does not carry, `not-a-skin` for a pressure on a
/// cell that is no skin cell, `not-a-beam` for a beam's force elsewhere, `unsupported` for shear on a face, for a
/// distributed force on a cell without continuum, and for gravity or rotation that an axisymmetric model cannot have;
/// `missing-material` naming a cell without density; `zero-vector` for a rotation without axis.
void add_external_forces(const ForceInput& input, std::span<const AppliedLoad> loads, double time,
                         std::span<long double> forces);

}  // namespace comma::solver
