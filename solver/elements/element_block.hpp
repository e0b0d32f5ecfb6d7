// A block of like elements: the one place where calls are virtual, once a block and never an element.
#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "solver/elements/slender/section.hpp"
#include "solver/elements/solids/imposed_strains.hpp"
#include "solver/elements/sparse_pattern.hpp"
#include "solver/fields/data/field.hpp"
#include "solver/materials/elasticity.hpp"
#include "solver/model/behaviour.hpp"

namespace comma::solver {

/// What blocks are made from.
struct BlockInput {
  const Model& model;
  const MaterialField& materials;
  const ElementProperties& properties;
  const DofMap& dofs;
  const SparsePattern& pattern;
  const BehaviourOfCells* behaviours;  ///< null or empty: linear elasticity in small strains

  CellBehaviour behaviour_of(int cell) const {
    return behaviours && !behaviours->empty() ? (*behaviours)[static_cast<std::size_t>(cell)] : CellBehaviour{};
  }
};

/// Internal forces add up in extended precision (64 significant bits).
using ForceSum = std::span<long double>;

/// `state` everywhere: the command variables of the instant.
class ElementBlock {
 public:
  virtual ~ElementBlock() = default;

  /// The symmetric part of the tangent.
  virtual void add_stiffness(const Eigen::VectorXd& u, const VariableState& state, std::span<const int> column_starts,
                             double* values) const = 0;
  virtual void add_internal_forces(const Eigen::VectorXd& u, const VariableState& state, ForceSum forces) const = 0;
  /// The tangent as if the material could only answer elastically from here on.
  virtual void add_elastic_stiffness(const Eigen::VectorXd& u, const VariableState& state,
                                     std::span<const int> column_starts, double* values) const {
    add_stiffness(u, state, column_starts, values);
  }
  /// What Code_Aster 17.3 takes for an elastic tangent: in solids that of small strains on the initial geometry,
  /// without stresses, whatever the strains are.
  virtual void add_initial_stiffness(const Eigen::VectorXd& u, const VariableState& state,
                                     std::span<const int> column_starts, double* values) const {
    add_elastic_stiffness(u, state, column_starts, values);
  }
  /// The tangent and the internal forces from which a step starts, nothing having moved yet (PointLaw::begin).
  virtual void add_starting_stiffness(const Eigen::VectorXd& u, const VariableState& state,
                                      std::span<const int> column_starts, double* values) const {
    add_stiffness(u, state, column_starts, values);
  }
  virtual void add_starting_forces(const Eigen::VectorXd& u, const VariableState& state, ForceSum forces) const {
    add_internal_forces(u, state, forces);
  }
  /// The forces at u = 0 with which the elastic material would hold up the strains of the command variables; 0 of
  /// elements with a memory that know none.
  virtual void add_variable_forces(const Eigen::VectorXd& u, const VariableState& state, ForceSum forces) const;
  /// What stresses, laid out as in stresses(), add to the stiffness when the element turns, in small displacements
  /// (R7.05.01). Throws Error `unsupported` where the element knows none.
  virtual void add_geometric_stiffness(std::span<const double> stresses, const VariableState& state,
                                       std::span<const int> column_starts, double* values) const;
  /// By what the rows that are no forces are multiplied to be of the size of forces; other rows are left alone.
  virtual void weigh_rows(const VariableState&, std::span<double>) const {}
  /// The internal forces of known stresses, laid out as in stresses(), of plates as in forces() at the points of
  /// integration; those of u alone where the material has no memory. In plane stress with large strains they are on the
  /// initial thickness, as Code_Aster has FORC_NODA, so that they miss balance by the change of thickness.
  virtual void add_forces_of_stresses(const Eigen::VectorXd& u, const VariableState& state, std::span<const double>,
                                      ForceSum forces) const {
    add_internal_forces(u, state, forces);
  }
  /// Whether an element without a memory may start from stresses that are not those of its displacements, and has them
  /// beside these from there on: add_forces_of_stresses() then takes the stresses for what they are.
  virtual bool takes_initial_stresses() const { return false; }
  /// Whether these grow with Young's modulus from there on, as forces do whose strain stays; and that modulus of each
  /// element.
  virtual bool scales_initial_stresses() const { return false; }
  virtual void write_moduli(const VariableState&, std::span<double>) const {}
  /// Whether add_stiffness() is the whole tangent; the same in all states.
  virtual bool is_symmetric() const { return true; }
  /// The same of add_elastic_stiffness().
  virtual bool is_elastically_symmetric() const { return is_symmetric(); }
  /// The same of add_initial_stiffness().
  virtual bool is_initially_symmetric() const { return is_elastically_symmetric(); }
  /// A symmetric stiffness by which iterations converge where the tangent is none; the symmetric part of the tangent
  /// unless an element knows a better one.
  virtual void add_symmetric_stiffness(const Eigen::VectorXd& u, const VariableState& state,
                                       std::span<const int> column_starts, double* values) const {
    add_stiffness(u, state, column_starts, values);
  }
  /// Appends the skew-symmetric part (K - K^T) / 2 of the tangent: its entries below the diagonal, by degree of
  /// freedom.
  virtual void add_skew_stiffness(const Eigen::VectorXd&, const VariableState&,
                                  std::vector<Eigen::Triplet<double>>&) const {}

  virtual std::span<const int> cells() const = 0;
  /// Stresses have this many points a cell ...
  virtual int point_count() const = 0;
  /// ... and these components.
  virtual std::span<const std::string_view> stress_names() const = 0;
  /// Writes the stresses of all elements, cell after cell, point after point (cells x points x names).
  virtual void stresses(const Eigen::VectorXd& u, const VariableState& state, std::span<double> out) const = 0;
  /// Plates have forces a length in the place of stresses(): how many of these places there are a cell (0 of other
  /// elements), and the forces there (cells x places x plate_force_names), less those of the imposed strains.
  virtual int force_point_count(PlatePlaces) const { return 0; }
  virtual void forces(PlatePlaces, const Eigen::VectorXd&, const ImposedStrains*, const VariableState&,
                      std::span<double>) const {}
  /// Writes the elastic energy of each element (one value a cell); absent where the material has a memory.
  virtual void energies(const Eigen::VectorXd& u, const VariableState& state, std::span<double> out) const = 0;
  /// What it is made of: the names of parts, none where it is known as a whole alone, and their values (cells x parts).
  virtual std::span<const std::string_view> energy_names() const { return {}; }
  virtual void energy_parts(const Eigen::VectorXd&, const VariableState&, std::span<double>) const {}
  virtual bool is_linear() const = 0;
  /// Whether add_elastic_stiffness() is the same for every u.
  virtual bool is_elastically_linear() const { return is_linear(); }
  /// The same of add_initial_stiffness().
  virtual bool is_initially_linear() const { return is_elastically_linear(); }
  /// Whether the stiffness is the same in all states.
  virtual bool is_constant() const = 0;

  /// Internal variables at each point; elasticity has one, which stays zero (U4.51.11).
  virtual int variable_count() const { return 1; }
  /// Writes them (cells x points x variables).
  virtual void variables(const Eigen::VectorXd&, const VariableState&, std::span<double> out) const {
    std::ranges::fill(out, 0.0);
  }
  /// Whether stresses depend on more than the displacements of the moment.
  virtual bool has_memory() const { return false; }
  /// Of materials with a memory: writes the elastic energy for an initial volume at each point (cells x points), of
  /// stresses and variables laid out as above.
  virtual void energy_densities(const Eigen::VectorXd&, const VariableState&, std::span<const double>,
                                std::span<const double>, std::span<double>) const {}
  /// A step has converged at u: the next begins there.
  virtual void accept(const Eigen::VectorXd&, const VariableState&) {}
  /// From now on stiffness and internal forces are those of plastic strains that go on growing, `ratio` times as much
  /// as in the last step (PointLaw::respond_extrapolated); nothing: as they are.
  virtual void extrapolate(std::optional<double>) {}
  /// A step begins at u with stresses and variables laid out as above; zero where empty.
  virtual void resume(const Eigen::VectorXd&, const VariableState&, std::span<const double>, std::span<const double>) {}

  /// From now on these are imposed, until others are given; null: none. Energies without a memory are less by them, and
  /// so is the strain that a law sees of an element with the pressure as an unknown.
  virtual void impose(const ImposedStrains*) {}
  /// Adds the forces with which the stresses of the imposed strains (Hooke's law times them) push the nodes apart; none
  /// where impose() gave them.
  virtual void add_imposed_strain_forces(const ImposedStrains&, const VariableState&, ForceSum) const {}
  /// Adds the forces with which initial stresses, laid out as in stresses() and absent in cells without, push the nodes
  /// apart on the initial geometry. Throws Error `unsupported` where the element knows none.
  virtual void add_initial_stress_forces(std::span<const double> stresses, ForceSum forces) const;
  /// Takes the stresses of imposed strains away from `out`, laid out as in stresses().
  virtual void subtract_imposed_stresses(const ImposedStrains&, const VariableState&, std::span<double>) const {}
  /// Whether it takes none away although imposed strains push: results then show the stress that the law has of the
  /// whole strain, and forces that balance those of the imposed ones.
  virtual bool shows_imposed_strains() const { return false; }
};

/// Whether like cells get an element with a memory: not anisotropic elasticity, which follows from displacements alone
/// whatever it starts from; but Green and Lagrange's strains in plane stress do, though elastic, for the element knows
/// plane stress in large strains.
bool keeps_memory(const BlockInput& input, std::span<const int> cells);

/// Blocks for cells that share type and formulation.
std::unique_ptr<ElementBlock> make_continuum_block(const BlockInput& input, std::vector<int> cells);
std::unique_ptr<ElementBlock> make_plane_block(const BlockInput& input, std::vector<int> cells);
std::unique_ptr<ElementBlock> make_solid_block(const BlockInput& input, std::vector<int> cells);
std::unique_ptr<ElementBlock> make_inelastic_plane_block(const BlockInput& input, std::vector<int> cells);
std::unique_ptr<ElementBlock> make_inelastic_solid_block(const BlockInput& input, std::vector<int> cells);
/// Hexahedra on eight nodes with one point.
std::unique_ptr<ElementBlock> make_stabilised_block(const BlockInput& input, std::vector<int> cells);
std::unique_ptr<ElementBlock> make_mixed_plane_block(const BlockInput& input, std::vector<int> cells);
std::unique_ptr<ElementBlock> make_mixed_solid_block(const BlockInput& input, std::vector<int> cells);
std::unique_ptr<ElementBlock> make_discrete_block(const BlockInput& input, std::vector<int> cells);
std::unique_ptr<ElementBlock> make_slender_block(const BlockInput& input, std::vector<int> cells);
std::unique_ptr<ElementBlock> make_plate_block(const BlockInput& input, std::vector<int> cells);

/// The elastic material of a cell, checked where its constants are known. Throws Error `missing-material` naming the
/// cell, `invalid-material`.
CellMaterial elastic_material(const BlockInput& input, int cell);
/// The same for bars, beams and plates, which need an isotropic one. Throws Error `unsupported` for others.
const IsotropicElasticity& isotropic_material(const BlockInput& input, int cell);

/// The nodes of cells of one type, one cell after the other.
std::vector<int> gather_nodes(const Mesh& mesh, std::span<const int> cells);

/// Error for a cell that has no element: formulation and cell type do not go together.
[[noreturn]] void throw_unsupported_element(const Model& model, int cell);
/// Error `unsupported`, of elements whose energies are not known; `elements`: their kind.
[[noreturn]] void throw_no_energies(std::string_view elements, const std::string& cell);

}  // namespace comma::solver
