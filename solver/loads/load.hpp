// Loads and kinematic conditions as data. The commands layer fills them; nonlinear/ assembles them.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "solver/functions/function.hpp"
#include "solver/model/model.hpp"

namespace comma::solver {

/// Where a condition was written, for messages: "beam.comm:12, DDL_IMPO".
using Origin = std::shared_ptr<const std::string>;

/// sum of coefficient * u(node, component) = value (multiplied by the load's time function).
struct LinearRelation {
  struct Term {
    int node;
    Component component;
    double coefficient;
  };
  std::vector<Term> terms;
  double value = 0.0;
  FieldFunction function;  ///< when set, replaces `value`: evaluated at the node of highest number (17.3)
  Origin origin;
  int rigid_link = -1;  ///< the one of Load::rigid_links that it is part of, in small rotations
};

/// Nodes that move together as a rigid body (U4.44.01, LIAISON_SOLIDE).
struct RigidLink {
  std::vector<int> nodes;
  double coincidence = 0.0;  ///< m: below it nodes count as one
  Origin origin;
};

/// A force (or moment) on one component of a node.
struct NodalForce {
  int node;
  Component component;
  double value = 0.0;
  FieldFunction function;  ///< when set, replaces `value`
};

/// A pressure on a skin cell, positive against the outward normal; `shear` along the tangent of a plane edge.
struct PressureLoad {
  int cell;
  double pressure = 0.0;
  double shear = 0.0;
  FieldFunction pressure_function;  ///< when set, replaces `pressure`
  FieldFunction shear_function;
  /// When set, replaces both pressures; interpolated by the shape functions of the cell.
  NodalFunction pressure_at_nodes = {};
};

/// A force per unit of the cell's own measure, in global axes: per volume in a solid, per area in a plane body (of
/// thickness 1) or on a face, per length on an edge. Per radian in an axisymmetric body, where measures are those of
/// the meridian plane times r.
struct DistributedForce {
  int cell;
  std::array<double, 3> force{};
  std::array<FieldFunction, 3> functions;                ///< one that is set replaces that component of `force`
  std::array<NodalFunction, 3> functions_at_nodes = {};  ///< the same, interpolated by the shape functions of the cell
};

/// In which axes the loads of a bar or beam are given: global, or own_axes() of the cell.
enum class BeamAxes : std::uint8_t { global, own };

/// Forces and moments per length on a bar or beam: FX FY FZ MX MY MZ, or N VY VZ MT MFY MFZ in its own axes. They vary
/// linearly between the ends, where functions are evaluated (U4.44.01, FORCE_POUTRE).
struct BeamForce {
  int cell;
  BeamAxes axes = BeamAxes::global;
  std::array<double, 6> force{};
  std::array<FieldFunction, 6> functions;  ///< one that is set replaces that component of `force`
};

/// Weight: each mass m of the cells gets the force m * acceleration. Cells without mass, such as skin cells, take no
/// part.
struct GravityLoad {
  std::vector<int> cells;
  std::array<double, 3> acceleration{};
};

/// Centrifugal force of a steady rotation: m speed^2 times the vector from the axis to the mass.
struct RotationLoad {
  std::vector<int> cells;
  double speed = 0.0;              ///< radians per unit of time
  std::array<double, 3> axis{};    ///< direction, of any length
  std::array<double, 3> centre{};  ///< a point of the axis
};

/// Strain that a solid or plane element has without stress: xx, yy, zz, xy, xz, yz in global axes, as tensor components
/// (half the shear angles). In an axisymmetric body zz is the hoop direction.
struct InitialStrain {
  int cell;
  std::array<double, 6> strain{};
  std::array<FieldFunction, 6> functions;  ///< one that is set replaces that component of `strain`
};

/// The same for a bar or beam in its own axes: elongation along x, then the curvatures d(rotation)/dx about y and z
/// (beams only). Functions are evaluated at the middle of the cell.
struct InitialSlenderStrain {
  int cell;
  std::array<double, 3> strain{};
  std::array<FieldFunction, 3> functions;
};

/// The same for a plate in its own axes, about the surface of the mesh: e_xx, e_yy, e_xy (half the shear angle), then
/// the curvatures k_xx, k_yy, k_xy (half the twist) that bending moments MXX ... of the same sign go with.
struct InitialPlateStrain {
  int cell;
  std::array<double, 6> strain{};
  std::array<FieldFunction, 6> functions;
};

/// Where in the thickness of a plate a force acts.
enum class PlateLevel : std::uint8_t { mesh, middle, upper, lower };

/// Forces and moments per area of a plate: FX FY FZ MX MY MZ, or in its own axes F1 F2 F3 MF1 MF2, whose sixth is not
/// used.
struct PlateForce {
  int cell;
  bool in_own_axes = false;
  PlateLevel level = PlateLevel::mesh;
  std::array<double, 6> force{};
  std::array<FieldFunction, 6> functions;  ///< one that is set replaces that component of `force`
};

struct ElementField;

struct Load {
  std::vector<LinearRelation> relations;
  std::vector<RigidLink> rigid_links;  ///< whose relations are among `relations`
  /// How many unknowns a relation adds where relations are not eliminated (U4.44.01, DOUBLE_LAGRANGE): see
  /// relation_multipliers.hpp.
  int multipliers_per_relation = 2;
  std::vector<NodalForce> nodal_forces;
  std::vector<PressureLoad> pressures;
  std::vector<DistributedForce> distributed_forces;
  std::vector<BeamForce> beam_forces;
  std::vector<GravityLoad> gravities;
  std::vector<RotationLoad> rotations;
  std::vector<InitialStrain> initial_strains;
  std::vector<InitialSlenderStrain> initial_slender_strains;
  std::vector<InitialPlateStrain> initial_plate_strains;
  /// At integration points: EPXX ... of continua, EPXX KY KZ of beams, EXX ... KXY of plates.
  std::vector<std::shared_ptr<const ElementField>> initial_strain_fields;
  /// At integration points: SIXX ...; they push and leave no other trace.
  std::vector<std::shared_ptr<const ElementField>> initial_stress_fields;
  std::vector<PlateForce> plate_forces;
};

/// Whether nothing of it moves a body at any time: conditions that hold it, and no more.
inline bool only_holds(const Load& load) {
  const auto holds = [](const LinearRelation& each) { return each.value == 0.0 && !each.function; };
  return std::ranges::all_of(load.relations, holds) && load.nodal_forces.empty() && load.pressures.empty() &&
         load.distributed_forces.empty() && load.beam_forces.empty() && load.gravities.empty() &&
         load.rotations.empty() && load.initial_strains.empty() && load.initial_slender_strains.empty() &&
         load.initial_plate_strains.empty() && load.initial_strain_fields.empty() &&
         load.initial_stress_fields.empty() && load.plate_forces.empty();
}

/// A load as a computation applies it.
struct AppliedLoad {
  std::shared_ptr<const Load> load;
  TimeFunction multiplier;    ///< empty: 1
  bool differential = false;  ///< its conditions on displacements count from the initial state (DIDI of U4.51.03)
};

}  // namespace comma::solver
