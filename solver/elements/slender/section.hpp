// What discrete elements, bars, beams and plates have beside their mesh: stiffnesses, sections, orientations.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <unordered_map>

#include <Eigen/Dense>

#include "solver/mesh/mesh.hpp"
#include "solver/model/model.hpp"

namespace comma::solver {

/// The stiffness of a discrete element, in global axes already: on a point k x k, on a segment 2k x 2k, k components a
/// node.
struct DiscreteStiffness {
  Eigen::MatrixXd matrix;
  /// Rows: the element's own axes, in which its forces N, VY, VZ ... are given whatever the frame of its stiffness.
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
};

/// In which axes the values of a discrete stiffness are given.
enum class DiscreteFrame : std::uint8_t { global, local };

/// Axes (rows) along a direction that is not zero, the second horizontal (in the plane of the global X and Y), and Y
/// where the first is along Z but for rounding; the second and third are then turned about the first by `roll`, in
/// radians.
Eigen::Matrix3d level_axes(const Eigen::Vector3d& along, double roll = 0.0);

/// Own axes (rows) of a cell. A segment has level_axes() from its first node to its second: yaw, pitch and roll of
/// U4.42.01, ORIENTATION. A point has the global axes, turned by `roll` about X. Throws Error `distorted-cell` for a
/// segment without length.
Eigen::Matrix3d own_axes(const Mesh& mesh, int cell, double roll = 0.0);

/// How the axes of an element are turned (AFFE_CARA_ELEM ORIENTATION of U4.42.01).
struct Orientation {
  double roll = 0.0;  ///< of a segment, in radians: see own_axes
  /// Axes (rows) of a point, and of a segment without length.
  Eigen::Matrix3d point_axes = Eigen::Matrix3d::Identity();
  double no_length = 0.0;  ///< a segment no longer than this (m) counts as one without length
};

/// Whether the cell has an own first axis: whether it is a segment longer than `no_length` (m).
bool has_direction(const Mesh& mesh, int cell, double no_length = 0.0);

/// The axes (rows) of the discrete element on a cell: own_axes() of a segment, the orientation's of a cell without
/// direction.
Eigen::Matrix3d discrete_axes(const Mesh& mesh, int cell, const Orientation& orientation);

/// The roll that turns the second own axis of a segment towards `y`, as far as the first axis lets it. Throws Error
/// `zero-vector` if `y` lies along the segment, or is zero; `distorted-cell` as own_axes.
double roll_towards(const Mesh& mesh, int cell, const Eigen::Vector3d& y);

/// Axes (rows) whose first is along `x` and whose second lies in the plane of `x` and `y`, on the side of `y`
/// (VECT_X_Y). Throws Error `zero-vector` if the two do not span a plane.
Eigen::Matrix3d axes_along(const Eigen::Vector3d& x, const Eigen::Vector3d& y);

/// Components that the element of a discrete formulation has at each node.
int discrete_components(Formulation formulation);

/// From one value a component: on a point diag(values); on a segment [D -D; -D D] with D = diag(values) (U4.42.01,
/// K_T_D_N, K_TR_D_N, K_T_D_L, K_TR_D_L). Throws Error `wrong-size` unless there is one value for each component of the
/// formulation.
DiscreteStiffness diagonal_stiffness(const Mesh& mesh, int cell, Formulation formulation,
                                     std::span<const double> values, DiscreteFrame frame,
                                     const Orientation& orientation = {});

/// From the upper triangle of the symmetric matrix, column by column, k (k+1) / 2 values with k the number of
/// components on a point, twice that on a segment (U4.42.01, K_T_N, K_TR_N, K_T_L, K_TR_L).
DiscreteStiffness symmetric_stiffness(const Mesh& mesh, int cell, Formulation formulation,
                                      std::span<const double> values, DiscreteFrame frame,
                                      const Orientation& orientation = {});

/// From all values of the matrix, column by column: k^2 of them on a point, 4 k^2 on a segment (U4.42.01, SYME='NON').
/// It need not be symmetric.
DiscreteStiffness unsymmetric_stiffness(const Mesh& mesh, int cell, Formulation formulation,
                                        std::span<const double> values, DiscreteFrame frame,
                                        const Orientation& orientation = {});

/// What is known of a section's outline: enough to say where its axial stress is largest.
enum class SectionShape : std::uint8_t { general, rectangle, circle };

/// Along a beam whose section varies a characteristic goes with this power of a linear function of the place.
struct VariationPowers {
  int area = 2;
  int inertia_y = 4;
  int inertia_z = 4;
  int torsion = 4;
};

/// The cross-section of a bar or beam, in its own axes. Bars use the area alone.
struct BeamSection {
  double area = 0.0;
  double inertia_y = 0.0;  ///< second moment about the own y axis: bending in the plane (x, z)
  double inertia_z = 0.0;
  double torsion = 0.0;  ///< torsion constant
  double shear_y = 1.0;  ///< A over the reduced section along y, >= 1 (A_Y of U4.42.01); used by Timoshenko beams
  double shear_z = 1.0;
  double centre_y = 0.0;  ///< from the centroid to the centre of torsion, along y
  double centre_z = 0.0;
  double roll = 0.0;  ///< see own_axes
  SectionShape shape = SectionShape::general;
  double reach_y = 1.0;  ///< distance from the axis to the outermost fibre along y (RY of U4.42.01)
  double reach_z = 1.0;  ///< along z (RZ)
  /// Torsional moment times this over the torsion constant is the largest shear stress (RT).
  double torsion_reach = 1.0;
  /// The section at the second node; null where it is the same along the beam. Roll, centre of torsion and shape are
  /// those of the first node.
  std::shared_ptr<const BeamSection> end = nullptr;
  VariationPowers powers{};  ///< see varying_section.hpp
};

/// Where the forces of a plate are wanted.
enum class PlatePlaces : std::uint8_t { corners, integration_points };

/// What a plate has beside its mesh (AFFE_CARA_ELEM, COQUE of U4.42.01).
struct PlateSection {
  double thickness = 0.0;
  double offset = 0.0;  ///< from the mesh to the mid-surface, along the normal of the cell
  int layers = 1;       ///< of equal thickness; their stresses are given below, in the middle of and above each
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();  ///< its part in the plane of the plate is the first own axis
  double shear_factor = 5.0 / 6.0;                       ///< effective share of the thickness in shear
  /// Resistance to rotation about the normal, which plates do not have. Positive: that share of the smallest resistance
  /// to rotation in the plane, at each node against the ground. Negative: its amount is the share of E times the
  /// thickness with which the rotation is tied to that of the membrane, (dv/dx - du/dy) / 2. Zero: none.
  double drilling = 1e-5;
};

/// The mass matrix of a discrete element in global axes, of the size of its stiffness.
using DiscreteMass = Eigen::MatrixXd;

/// A rigid body: on a point at an offset from it, on a segment (without offset) one at each end (so in Code_Aster
/// 17.3), as M_T_D_N, M_TR_D_N, M_T_D_L and M_TR_D_L of U4.42.01. Offset and tensor are in the axes of `frame`.
struct DiscreteInertia {
  double mass = 0.0;
  Eigen::Matrix3d tensor = Eigen::Matrix3d::Zero();  ///< about the centre of mass; used where the element has rotations
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();  ///< from the node to the centre of mass
};

/// Throws Error `unsupported` for an offset on a segment or on an element without rotations.
DiscreteMass rigid_mass(const Mesh& mesh, int cell, Formulation formulation, const DiscreteInertia& inertia,
                        DiscreteFrame frame, const Orientation& orientation = {});

/// From the upper triangle of the symmetric matrix, as symmetric_stiffness (M_T_N, M_TR_N, M_T_L, M_TR_L).
DiscreteMass symmetric_mass(const Mesh& mesh, int cell, Formulation formulation, std::span<const double> values,
                            DiscreteFrame frame, const Orientation& orientation = {});

/// From all values, as unsymmetric_stiffness.
DiscreteMass unsymmetric_mass(const Mesh& mesh, int cell, Formulation formulation, std::span<const double> values,
                              DiscreteFrame frame, const Orientation& orientation = {});

/// Characteristics by cell index. Discrete elements without an entry in `masses` have none.
struct ElementProperties {
  /// Axes L, T, N (rows) of anisotropic materials; the global axes where none are given.
  std::unordered_map<int, Eigen::Matrix3d> material_axes;
  std::unordered_map<int, DiscreteStiffness> discrete;
  std::unordered_map<int, DiscreteMass> masses;
  std::unordered_map<int, BeamSection> sections;
  std::unordered_map<int, PlateSection> plates;
};

}  // namespace comma::solver
