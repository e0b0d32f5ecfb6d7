// Contact as the user describes it, in the solver's words.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <unordered_map>
#include <vector>

#include "solver/functions/function.hpp"
#include "solver/model/component.hpp"

namespace comma::solver {

/// Condition  sum over components coefficient(t) * u(node, component) <= bound(t)  at each node.
struct UnilateralCondition {
  std::vector<int> nodes;
  std::vector<Component> components;
  std::vector<FieldFunction> coefficients;  ///< one a component
  FieldFunction bound;
  /// Positive: the bound gives way, and pushes back by this much a unit of what it is passed by; 0: it holds.
  double penalty = 0.0;
};

/// How the inequalities of the discrete formulation are solved.
enum class ContactAlgorithm : std::uint8_t { active_set, projected_gradient };
/// `discrete`: gaps of slave nodes as inequalities (R5.03.50); `mixed`: displacements and pressures on slave faces in a
/// weak form (R5.03.52).
enum class ContactFormulation : std::uint8_t { discrete, mixed };
/// How slave faces are integrated; see face_rule.hpp.
enum class ContactRule : std::uint8_t { automatic, gauss, simpson, newton_cotes };
/// Which points count as closed before the first solution.
enum class InitialContact : std::uint8_t { none, all, interpenetrating };
enum class GeometryUpdate : std::uint8_t { none, automatic, controlled };
enum class NormalRule : std::uint8_t { automatic, fixed, along_y };
enum class NormalSide : std::uint8_t { master, slave, average };

/// How a zone presses and rubs, beyond inequalities. Coefficients are pressures a unit of length in the mixed
/// formulation, forces a unit of length in the discrete one.
struct MixedZone {
  ContactRule rule = ContactRule::automatic;
  int rule_order = 0;               ///< 0: the rule's default
  double augmentation = 100.0;      ///< COEF_CONT: of the pressure by the gap
  bool keeps_augmentation = false;  ///< it is not lowered where no solution is found with it (ADAPTATION='NON')
  bool local_average = false;  ///< the mean gap of each patch of slave faces obeys Signorini's law (ALGO_CONT='LAC')
  bool present_areas = false;  ///< pressures of patches are forces over areas as they are, otherwise over initial ones
                               ///< (TYPE_JACOBIEN='ACTUALISE')
  bool penalised = false;      ///< the pressure is `augmentation` times the depth (ALGO_CONT='PENALISATION')
  /// In place of `augmentation` each point has a penalty that its depth adapts (ADAPTATION='ADAPT_COEF'; see
  /// adapted_penalties.hpp).
  bool adapts_penalty = false;
  std::optional<double> largest_depth;  ///< PENE_MAXI, a length: the depth from which on a penalty is adapted; nothing:
                                        ///< a share of the smallest master facet
  InitialContact initial = InitialContact::interpenetrating;  ///< CONTACT_INIT
  /// GLISSIERE: a point that has closed does not open again (see ContactDefinition::contact_by_newton); in the
  /// discrete formulation all that face the master are closed, across gaps too (Code_Aster 17.3).
  bool bilateral = false;
  double unnoticed_gap = 0.0;  ///< ALARME_JEU, a length: of gaps that are closed so, up to which none is worth a doubt
  double friction = 0.0;       ///< COULOMB
  bool friction_penalised = false;  ///< while it sticks the shear is `friction_penalty` times the slip (E_T); in the
                                    ///< mixed formulation the same of shares of the limit of friction (COEF_PENA_FROT)
  double friction_penalty = 0.0;    ///< a force over a length, or one over a length
  double secant_relief = 0.0;       ///< COEF_MATR_FROT: see secant_shear()
  std::optional<double> largest_slip;  ///< GLIS_MAXI, a length: `friction_penalty` is raised until no point that sticks
                                       ///< slips by more in the step
  /// COEF_FROT: of shares of the limit of friction by the slip, a unit of length.
  double friction_augmentation = 100.0;
  std::vector<int> frictionless_nodes;                          ///< SANS_GROUP_NO_FR
  std::optional<std::array<double, 3>> frictionless_direction;  ///< DIRE_EXCL_FROT: these nodes have no friction along
                                                                ///< it (not null); without: along no direction
};

/// To what a slave node is paired: the nearest facet, or the nearest node (APPARIEMENT='NODAL').
enum class PairingRule : std::uint8_t { facet, node };

/// A pair of surfaces. Slave nodes may not enter master facets.
struct ContactZone {
  std::vector<int> master_cells;
  std::vector<int> slave_cells;
  PairingRule pairing = PairingRule::facet;
  NormalSide normal_side = NormalSide::master;
  NormalRule master_normal = NormalRule::automatic;
  std::array<double, 3>
      master_vector{};  ///< for NormalRule::fixed: the outward normal of the master surface (VECT_MAIT FIXE)
  NormalRule slave_normal = NormalRule::automatic;
  std::array<double, 3> slave_vector{};  ///< the same of the slave surface (VECT_ESCL)
  /// DIRE_APPA: slave points look for the master along it; absent: for the nearest place.
  std::optional<std::array<double, 3>> pairing_direction;
  std::vector<int> excluded_slave_nodes;  ///< SANS_GROUP_NO
  /// TOLE_PROJ_EXT: how far outside a facet's reference cell a projection may fall; < 0: not at all.
  double projection_tolerance = 0.5;
  bool resolved = true;  ///< RESOLUTION: false: contact is not enforced, interpenetration only watched
  double interpenetration_tolerance = 0.0;  ///< TOLE_INTERP: how deep a node of a watched zone may go
  double pairing_distance = -1.0;  ///< TOLE_APPA / DIST_APPA: slave nodes farther than this from the nearest master
                                   ///< node are not paired; < 0: no limit
  FieldFunction master_thickness;  ///< DIST_MAIT: what is added on the master's side, a length; may be empty
  FieldFunction slave_thickness;   ///< DIST_ESCL
  bool thickness_changes = false;  ///< either depends on time
  /// What the elements of slave cells take off the gap (DIST_POUTRE, DIST_COQUE): the radius of a beam, half of the
  /// thickness of a plate. Those of master cells take nothing (Code_Aster 17.3), nor do those not named.
  std::unordered_map<int, double> half_thickness;
  MixedZone mixed;  ///< for zones that is_condensed() speaks of
};

struct ContactDefinition {
  ContactFormulation formulation = ContactFormulation::discrete;
  ContactAlgorithm algorithm = ContactAlgorithm::active_set;
  GeometryUpdate geometry_update = GeometryUpdate::automatic;
  int controlled_updates = 2;        ///< NB_ITER_GEOM, for GeometryUpdate::controlled
  int max_geometry_updates = 10;     ///< ITER_GEOM_MAXI
  double geometry_tolerance = 0.01;  ///< RESI_GEOM
  /// Updates that have long brought the geometry no nearer to rest end where it moves by less than this.
  double restless_tolerance = 0.0;
  double joint_geometry_tolerance = 1e-6;  ///< RESI_GEOM where iterations are joint
  /// ALGO_RESO_CONT='NEWTON': penalties that depths adapt are so until they stay, for each geometry, otherwise once a
  /// geometry; of bilateral zones, points may open again until none changes, otherwise none does.
  bool contact_by_newton = false;
  /// RESI_FROT where friction alone is by Newton's method (ALGO_RESO_CONT and ALGO_RESO_GEOM 'POINT_FIXE'); 0: not
  /// known.
  double friction_tolerance = 0.0;
  bool joint_iterations = false;          ///< one iteration of Newton's method updates statuses, geometry and bodies
                                          ///< (ALGO_RESO_CONT and ALGO_RESO_GEOM 'NEWTON')
  int active_set_factor = 30;             ///< ITER_CONT_MULT: at most this many active-set iterations per slave node
  bool stop_on_interpenetration = false;  ///< STOP_INTERP: too deep a node of a watched zone is an error
  bool has_friction = false;    ///< FROTTEMENT='COULOMB', though all coefficients be zero: fields have its components
  bool smooth_normals = false;  ///< LISSAGE: normals at the nodes are averaged and interpolated between them
  double gradient_tolerance = 1e-8;       ///< RESI_ABSO, for ContactAlgorithm::projected_gradient, a length
  int gradient_iterations = 0;            ///< ITER_GCP_MAXI; 0: chosen by their number
  bool gradient_scaled = false;           ///< PRE_COND
  bool gradient_stays_admissible = true;  ///< RECH_LINEAIRE: see AdmissibleGradientOptions
  std::vector<ContactZone> zones;
};

/// Whether it takes part in the stiffness of the bodies in Code_Aster: all that is weak or penalised.
inline bool has_stiffness(const ContactDefinition& definition) {
  if (definition.formulation == ContactFormulation::mixed) return true;
  return std::ranges::any_of(definition.zones,
                             [](const ContactZone& zone) { return zone.mixed.penalised || zone.mixed.friction > 0.0; });
}

/// Whether contact is more than inequalities: the mixed formulation, and discrete zones that have a penalty, that rub,
/// or that never open again. Such scenes go to MixedContact, discrete ones with points at the slave nodes that stand
/// for forces.
inline bool is_condensed(const ContactDefinition& definition) {
  return has_stiffness(definition) ||
         std::ranges::any_of(definition.zones, [](const ContactZone& zone) { return zone.mixed.bilateral; });
}

}  // namespace comma::solver
