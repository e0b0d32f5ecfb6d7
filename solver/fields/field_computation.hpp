// Further fields of a result, each from those that it needs (CALC_CHAMP, U4.81.04).
#pragma once

#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "solver/elements/assembler.hpp"
#include "solver/fields/data/field.hpp"
#include "solver/fields/points/continuum_points.hpp"
#include "solver/nonlinear/static_analysis.hpp"

namespace comma::solver {

/// The steps of a result that were computed from another problem (reuse=).
struct OtherPhases {
  std::size_t begin = 0;                                      ///< the first step of the phase between them
  std::size_t end = std::numeric_limits<std::size_t>::max();  ///< the first one after it
  std::function<const Field&(const std::string& name, std::size_t step)> field;  ///< of a step outside
  bool stiffness_changes = false;  ///< materials, sections or the model of an earlier phase are others
};

/// Computes fields by their names: stresses SIEF, SIGM, EFGE, SIPO, SIPM, SIRO; strains EPSI, EPME, EPSG, EPMG, EPSL,
/// EPSP, EPVC, EPFP, EPFD, DEGE; criteria SIEQ, EPEQ, EPMQ, EPGQ; DERA, which compares a step with the next one (absent
/// at the last); INDIC_SEUIL, INDIC_ENER (X1, see loading_indicators.hpp); command variables VARC; energies ENEL, ETOT,
/// EPOT and what POST_ELEM calls ENER_TOTALE and ENER_POT; forces FORC_NODA, REAC_NODA. _ELGA is at Gauss points, _ELNO
/// at the nodes of each cell (by local smoothing, see extrapolation.hpp; SIEF, SIGM, SIEQ, EPSI and EPEQ of plates at
/// places in their thickness, see plate_stresses.hpp), _NOEU at nodes (the mean over the cells around each), _ELEM on
/// the whole cell. A field that the step holds already is taken as it is where another needs it.
///
/// Keeps references to its arguments.
class FieldComputation {
 public:
  /// `others`: of which what adds up from step to step, or compares steps, takes its fields. Throws what Assembler
  /// does.
  FieldComputation(const StaticProblem& problem, const Result& result, OtherPhases others = {});

  static bool knows(std::string_view name);

  /// The field `name` of a step, on `cells` only (or averaged over these only) if they are given: FORC_NODA is then
  /// what these cells alone bear, and REAC_NODA that less the loads at their nodes (U4.81.24, section 1). SIRO_ELEM
  /// lies on skin cells, all of the model's without `cells`. Throws Error `unsupported` for another name and for one
  /// that plates do not have in comma, `unknown-field` naming one that the step lacks, and what the functions of
  /// solver/fields throw.
  Field compute(std::string_view name, std::size_t step, std::optional<std::span<const int>> cells = {});

  /// The same of the whole model, or what the step holds of it; good until fields of the step after the next are
  /// computed.
  const Field& needed(const std::string& name, std::size_t step);

  /// The same, but computed anew where the step holds it of some cells only: what adds up from step to step or over a
  /// cell, and what compares steps, takes this one.
  const Field& whole(const std::string& name, std::size_t step);
  /// One that the step need not hold.
  const Field& computed(const std::string& name, std::size_t step);

  /// Whether ENER_POT, the energy that the displacements of a step would have in linear elasticity and small strains,
  /// is what the body has stored.
  bool stores_potential_energy(std::size_t step);

  /// The fields of the steps that have been taken as they are and lie on some cells only: what was computed from them
  /// lacks the rest.
  const std::set<std::string>& limited_sources() const { return limited_sources_; }

 private:
  using Key = std::pair<std::size_t, std::string>;
  using Rule = Field (FieldComputation::*)(std::size_t);
  static const std::map<std::string, Rule, std::less<>>& rules();

  Field derive(std::string_view name, std::size_t step, std::optional<std::span<const int>> cells = {});
  Field means_at_nodes(const std::string& quantity, std::size_t step, std::optional<std::span<const int>> cells);
  const ElementField& element_field(const std::string& name, std::size_t step);
  bool holds_whole(const std::string& name, std::size_t step) const;
  const ElementField& whole_field(const std::string& name, std::size_t step);
  const NodalField& displacement(std::size_t step);
  void move_to(std::size_t step);
  FieldInput input() const;

  Field stresses(std::size_t step);
  Field stress_field_at_points(std::size_t step);
  Field stress_field_at_nodes(std::size_t step);
  Field stresses_and_forces_at_nodes(std::size_t step);
  ElementField plate_stresses_at_nodes(std::size_t step);
  /// Whether loads strain any of the cells beforehand (PRE_EPSI).
  bool strains_act_on(std::size_t step, std::span<const int> cells) const;
  std::vector<int> plates() const;
  bool has_plates() const;
  const ElementField& stresses_beside_plates(std::size_t step);
  ElementField plate_forces(std::size_t step);
  std::optional<ElementField> plate_forces_beside(std::size_t step);
  ElementField plate_forces_at_nodes(std::size_t step);
  ElementField plate_forces_at_corners(std::size_t step);
  ElementField whole_plate_forces(std::size_t step);
  ElementField layer_strains_of(const ElementField& plate_forces) const;
  /// Stresses and forces of elements at their nodes, with the forces of plates at their corners.
  ElementField forces_at_nodes(std::size_t step);
  Field section_force_field(std::size_t step);
  Field end_forces(std::size_t step);
  Field fibre_stresses(std::size_t step);
  Field largest_stresses(std::size_t step);
  ElementField with_flow_of_bars(ElementField strains, std::size_t step);
  Field section_strains(std::size_t step);
  Field section_strains_at_points(std::size_t step);
  /// `of_members`: section forces of bars and beams, `of_plates`: those of plates, both known about their own axes.
  Field strains_of_forces(std::string_view name, const ElementField& of_members, const ElementField& of_plates,
                          std::size_t step);
  Field total_strains(std::size_t step);
  Field total_strains_at_nodes(std::size_t step);
  Field mechanical_strains(std::size_t step);
  Field plastic_strains_at_points(std::size_t step);
  Field green_strains(std::size_t step);
  Field mechanical_green_strains(std::size_t step);
  Field logarithmic_strains(std::size_t step);
  Field variable_strains(std::size_t step);
  Field strains_of_creep(std::size_t step);
  Field command_variables(std::size_t step);
  Field stress_criteria_at_points(std::size_t step);
  Field stress_criteria_at_nodes(std::size_t step);
  void require_added_strains(std::string_view name) const;
  std::vector<int> cells_in_green_strains() const;
  void require_elastic_patterns(const ElementField& stresses) const;
  bool has_bars_with_memory() const;
  Field elastic_energy(std::size_t step);
  Field elastic_energy_of_cells(std::size_t step);
  Field potential_energy_of_cells(std::size_t step);
  Field energy_of_displacements(std::size_t step);
  /// An assembler of these laws (null: linear elasticity in small strains) at the instant of the step.
  std::unique_ptr<Assembler> assembler_of(const BehaviourOfCells* laws, std::size_t step) const;
  /// Where the stresses of the step are not what the displacements give with these laws.
  std::optional<int> cell_of_other_stresses(const Assembler& elastic, std::size_t step);
  bool departs_from_linear() const;
  void know_earlier(const std::string& name, std::size_t step);
  Field total_energy(std::size_t step);
  Field total_energy_of_cells(std::size_t step);
  Field energy_of_state(std::size_t step);
  void require_elastic_work(const std::vector<int>& others, std::size_t step);
  ElementField work_of_bars(const std::vector<int>& bars, std::size_t step);
  Field internal_variables(std::size_t step);
  Field unloading(std::size_t step);
  bool some_flow() const;
  Field yield_of_loading(std::size_t step);
  Field energy_of_loading(std::size_t step);
  const Field& remembered(std::string_view name, std::size_t step) const;
  const ElementField* remembered_stresses(std::size_t step) const;
  bool began_with_stresses() const;
  void require_no_initial_stresses(std::string_view name, std::size_t step);
  Field internal_forces(std::size_t step);
  bool has_beams_that_turn() const;
  void turn_beams(Assembler& assembler, const DofMap& dofs, std::size_t step);
  Field internal_forces_of(std::span<const int> cells, std::size_t step);
  Field reactions(std::size_t step);
  Field reactions_of(std::span<const int> cells, std::size_t step);

  const StaticProblem& problem_;
  const Result& result_;
  OtherPhases others_;
  DofMap dofs_;
  Assembler assembler_;
  std::optional<std::size_t> step_;
  std::map<Key, Field> known_;
  std::set<std::string> limited_sources_;
};

}  // namespace comma::solver
