// Strain energies of continua from their stresses (CALC_CHAMP, ENERGIE; POST_ELEM; R4.09.01).
// Assembler::elastic_energies has those of all elements from displacements.
#pragma once

#include <optional>
#include <span>

#include "solver/fields/data/field.hpp"
#include "solver/fields/points/continuum_points.hpp"
#include "solver/model/behaviour.hpp"

namespace comma::solver {

/// ENEL_ELGA: 1/2 stress : compliance : stress per volume at Gauss points (TOTALE).
ElementField elastic_energy_density(const FieldInput& input, const ElementField& stresses);

/// The same from elastic strains (EPME or EPMG at Gauss points): 1/2 strain : stiffness : strain for an initial volume.
ElementField strain_energy_density(const FieldInput& input, const ElementField& strains);

/// ETOT_ELGA: the work of the stresses per volume since the unstressed state, by the trapezoidal rule: `previous` plus
/// 1/2 (stress + stress before) : (strain - strain before). Strains are EPSI at Gauss points. The fields of the step
/// before are null at the first one. Throws Error `incompatible-field` where they lie on other points.
ElementField total_energy_density(const ElementField& stresses, const ElementField& strains,
                                  const ElementField* stresses_before, const ElementField* strains_before,
                                  const ElementField* previous);

/// The energy that flow with isotropic hardening has taken up per volume, the integral of R to V1 of `variables`
/// (VARI_ELGA), at the points of cells with such a law in small strains (TOTALE); no points elsewhere.
ElementField hardening_energy_density(const FieldInput& input, const ElementField& variables,
                                      const BehaviourOfCells& behaviours);

/// Adds to ENEL_ELGA of elastic hexahedra with one point (3D_SI) that of the stress that varies over them, FSTAB1 ..
/// FSTAB72 of `stresses`, as a mean over the volume of the point.
void add_stabilisation_energy(const FieldInput& input, const ElementField& stresses, ElementField& densities);

/// Adds to ETOT_ELGA of hexahedra with one point the work of this stress since the step before, by the trapezoidal
/// rule. The fields of the step before are null at the first one.
void add_stabilisation_work(const FieldInput& input, const ElementField& stresses, const NodalField& displacements,
                            const ElementField* stresses_before, const NodalField* displacements_before,
                            ElementField& densities);

/// The work of the normal forces (N of `forces`) of bars since the step before, on the change of their lengths, by the
/// trapezoidal rule: one value (TOTALE) for each of the bars. The fields of the step before are null at the first one.
ElementField bar_work(const Model& model, std::span<const int> bars, const ElementField& forces,
                      const NodalField& displacements, const ElementField* forces_before,
                      const NodalField* displacements_before);

/// Whether a cell has a stress that varies over it among its stresses.
bool is_stabilised(const ElementField& stresses, int cell);

/// The integral over each continuum cell of the components of a field at Gauss points or at element nodes (ENEL_ELEM
/// from ENEL_ELGA): one value a cell and component. Volumes are those of ContinuumPoint.
ElementField integrate_cells(const Model& model, const ElementField& field);

/// The same of a field at nodes over faces or edges: areas or lengths, times r in axisymmetric models.
ElementField integrate_skin(const Model& model, const NodalField& field, std::span<const int> cells);

/// The same along two-node lines, of a field that is linear between their ends: the length times the mean of the values
/// of the cell.
ElementField integrate_lines(const Mesh& mesh, const ElementField& field, std::span<const int> cells);

/// The length of each two-node line (component VOL).
ElementField line_lengths(const Mesh& mesh);

/// The volume of each continuum cell (component VOL).
ElementField cell_volumes(const Model& model);

/// The sum of a component over cells (all that carry it when none are given).
double sum_over_cells(const ElementField& field, int component, std::optional<std::span<const int>> cells = {});

}  // namespace comma::solver
