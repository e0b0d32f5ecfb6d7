// From elements to the global system: stiffness, internal forces, external forces, stresses.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Dense>

#include "solver/elements/slender/section.hpp"
#include "solver/fields/data/field.hpp"
#include "solver/linear/linear_solver.hpp"
#include "solver/linear/unsymmetric_solver.hpp"
#include "solver/loads/load.hpp"
#include "solver/materials/command_variables.hpp"
#include "solver/materials/material.hpp"
#include "solver/model/behaviour.hpp"
#include "solver/model/model.hpp"

namespace comma::solver {

class ElementBlock;
class ImposedStrains;

/// Sums element contributions over all degrees of freedom of a DofMap (no condition applied yet). Blocks of like cells
/// are sorted once, in the constructor, and nothing is allocated inside an element loop. Keeps references to its
/// arguments.
class Assembler {
 public:
  /// Throws Error `missing-material` / `missing-properties` naming a cell that lacks what its element needs,
  /// `wrong-size` for a spring's matrix, `invalid-material`, `invalid-properties`, `distorted-cell`, `unsupported` for
  /// a formulation on a cell type without such an element. `behaviours`: null or empty for linear elasticity in small
  /// strains everywhere. Throws Error `unsupported` where an element knows no other. Materials with a memory begin
  /// undisplaced and without stress.
  Assembler(const Model& model, const MaterialField& materials, const ElementProperties& properties, const DofMap& dofs,
            const BehaviourOfCells* behaviours = nullptr);
  ~Assembler();

  /// Takes the command variables of the materials at a time: from now on stiffness, forces, stresses and energies are
  /// those of that instant. Before the first call no command variable is known. Throws Error `out-of-function`,
  /// `incompatible-field`.
  void set_time(double time);
  const VariableState& state() const { return state_; }
  /// From now on energies without a memory are less the initial strains that the loads impose at a time, and so is what
  /// laws see with the pressure as an unknown; others have them as forces (external_forces()). Keeps pointers into the
  /// loads.
  void impose_strains(std::span<const AppliedLoad> loads, double time);
  bool imposes_strains() const { return imposed_ != nullptr; }

  /// Lower triangle of the symmetric part of the tangent stiffness at u (size n x n, force / length); the pattern never
  /// changes between calls. Rows of continua, bars and beams add up to exactly zero over each translation (see
  /// translation.hpp), so that a residual b - K x taken in extended precision leaves rigid motions to what really holds
  /// them.
  SymmetricMatrix stiffness(const Eigen::VectorXd& u) const;

  /// The same of what stands for the tangent where nothing but a symmetric one will do; iterations correct the rest.
  SymmetricMatrix symmetric_stiffness(const Eigen::VectorXd& u) const;

  /// The same as if materials could only answer elastically from where they are.
  SymmetricMatrix elastic_stiffness(const Eigen::VectorXd& u) const;

  /// The same as ELASTIQUE of Code_Aster has it (ElementBlock::add_initial_stiffness).
  SymmetricMatrix initial_stiffness(const Eigen::VectorXd& u) const;

  /// Lower triangle of what the stresses at u, less those of the strains that impose_strains() has given, add to the
  /// stiffness of small displacements from there (initial stress stiffness, R7.05.01). Throws Error `unsupported` where
  /// an element knows none.
  SymmetricMatrix geometric_stiffness(const Eigen::VectorXd& u) const;

  /// Whether stiffness() is the whole tangent, for every u.
  bool is_symmetric() const;
  /// The same of elements whose tangent is the same for every u.
  bool has_symmetric_linear_part() const;
  /// The rest of the tangent at u where it is not: (K - K^T) / 2 (n x n), entries only where elements are unsymmetric.
  SkewMatrix skew_stiffness(const Eigen::VectorXd& u) const;
  /// The same beside elastic_stiffness().
  SkewMatrix elastic_skew_stiffness(const Eigen::VectorXd& u) const;
  /// The same beside initial_stiffness().
  SkewMatrix initial_skew_stiffness(const Eigen::VectorXd& u) const;

  /// Internal forces at u (n), those of restrained thermal expansion included; accumulated in extended precision so
  /// that the equilibrium of a stiff body held by weak springs is not drowned in rounding.
  Eigen::VectorXd internal_forces(const Eigen::VectorXd& u) const;

  /// By what residuals (n) are multiplied before they are measured beside forces: 1 for forces; Young's modulus over
  /// the size of the cell where the balance is one of volumes (the pressure's), one over that size where it is one of
  /// stresses times volumes (the swelling's). Empty where all are forces.
  Eigen::VectorXd residual_weights() const;

  /// Whether there are elements without a memory that may have stresses beside those of their displacements: springs,
  /// bars, beams and plates.
  bool takes_initial_stresses() const;
  /// Whether they have some in the field.
  bool has_initial_stresses(const Eigen::VectorXd& u, const ElementField& stresses) const;

  /// The internal forces (n) of a field of stresses as stresses() gives it. Where materials have no memory, those of u,
  /// with what springs, bars, beams and plates have besides.
  Eigen::VectorXd forces_of_stresses(const Eigen::VectorXd& u, const ElementField& stresses) const;

  /// Whether stresses depend on more than the displacements of the moment: then stiffness(), internal_forces() and the
  /// fields are those of a trial u, from where the last accept() or resume() put the step's beginning.
  bool has_memory() const;
  /// From now on stiffness and internal forces are those of plastic strains that go on growing, `ratio` times as much
  /// as in the last step, and linear in u; nothing: as they are. Throws Error `unsupported` when they are asked for
  /// where a law does not know how.
  void extrapolate(std::optional<double> ratio);
  /// The step has converged at u, at the assembler's instant.
  void accept(const Eigen::VectorXd& u);
  /// A step begins at u, at the assembler's instant. `stresses`, `variables`: as stresses() and internal_variables()
  /// give them; null: zero. Throws Error `incompatible-field` where a field lacks a cell, a point or a component;
  /// `unsupported` for stresses that an element without memory does not have at u, but for springs, bars, beams and
  /// plates: what they have besides stays, in internal_forces() and stresses(). Plates must have such stresses through
  /// their thickness as forces make. What holds rotations about the normal of plates is in no stress: it is that of u.
  void resume(const Eigen::VectorXd& u, const ElementField* stresses, const ElementField* variables);
  /// After resume() without stresses: discrete elements, bars and beams whose forces follow from displacements begin
  /// with none at u and the command variables of the instant, and go on by what both add (Code_Aster 17.3; continua and
  /// plates keep the stresses of u).
  void begin_without_forces(const Eigen::VectorXd& u);
  /// VARI_ELGA: internal variables V1, V2 ... at the Gauss points (U4.51.11); cells with fewer have none in the other
  /// components.
  ElementField internal_variables(const Eigen::VectorXd& u) const;

  /// Elastic energy for an initial volume at the Gauss points of cells with a memory (TOTALE), from stresses and
  /// internal variables.
  ElementField energy_densities(const Eigen::VectorXd& u, const ElementField& stresses,
                                const ElementField& variables) const;

  /// Where a step starts at u, nothing having moved yet: the tangent of the flow as it was, and the internal forces
  /// with what the command variables have changed taken up elastically. Elsewhere, and without a memory, the same as
  /// stiffness() and internal_forces().
  SymmetricMatrix starting_stiffness(const Eigen::VectorXd& u) const;
  Eigen::VectorXd starting_forces(const Eigen::VectorXd& u) const;

  /// The forces (n) with which elastic materials would hold up the strains of the command variables, and laws with a
  /// memory imposed ones, on the initial geometry, in large strains too (Code_Aster 17.3); empty where none is given.
  /// Linear statics read K u = f_ext + f_strains.
  Eigen::VectorXd variable_forces() const;

  /// External forces (n) of the loads at a time (see external_forces.hpp), on the initial geometry; initial strains
  /// take part as the forces of the stresses that would undo them, initial stresses by their own.
  Eigen::VectorXd external_forces(std::span<const AppliedLoad> loads, double time) const;

  /// The part of external_forces() that initial strains have where stresses() are less by them.
  Eigen::VectorXd initial_strain_forces(std::span<const AppliedLoad> loads, double time) const;

  /// Whether the tangent is the same for every u.
  bool is_linear() const;
  /// Whether initial_stiffness() is the same for every u.
  bool is_initially_linear() const;
  /// Changes whenever the stiffness at a given u may have changed: with each set_time if properties depend on command
  /// variables or time, else never.
  int stiffness_version() const { return version_; }

  /// Stresses at the Gauss points (SIEF_ELGA): SIXX SIYY SIZZ SIXY (2D), with SIXZ SIYZ in 3D; N for bars; N VY VZ MT
  /// MFY MFZ in own axes for beams (at both ends) and as far as they have them for discrete elements (at their last
  /// node), N > 0 in tension; SIXX ... SIYZ for plates in their own axes, at places in their thickness
  /// (plate_stresses.hpp).
  ElementField stresses(const Eigen::VectorXd& u) const;
  /// The same less the stresses of the initial strains that the loads impose at a time.
  ElementField stresses(const Eigen::VectorXd& u, std::span<const AppliedLoad> loads, double time) const;

  /// The forces NXX NYY NXY MXX MYY MXY QX QY of plates, a length, in own axes, moments about the surface of the mesh,
  /// less those of the initial strains that the loads impose at a time; other cells have none. Those of u alone,
  /// whatever the step began with.
  ElementField plate_forces(const Eigen::VectorXd& u, PlatePlaces places, std::span<const AppliedLoad> loads,
                            double time) const;

  /// What they have in a field of stresses beside those of u, at the points of integration; nothing where that is all.
  std::optional<ElementField> plate_forces_beside(const Eigen::VectorXd& u, const ElementField& stresses) const;

  /// Elastic energy of each element without memory (EPOT_ELEM: TOTALE, and its parts in beams and plates,
  /// energy_parts.hpp), that of (strain - strain of the command variables - what impose_strains() has given).
  /// Axisymmetric bodies: per radian.
  ElementField elastic_energies(const Eigen::VectorXd& u) const;

 private:
  ElementField stresses(const Eigen::VectorXd& u, const ImposedStrains* imposed) const;
  ElementField plate_forces(const Eigen::VectorXd& u, PlatePlaces places, const ImposedStrains* imposed) const;
  bool has_plates() const;
  Eigen::VectorXd with_initial(Eigen::VectorXd forces) const;
  ElementField with_initial(ElementField plate_forces) const;
  std::vector<double> stresses_in(const ElementBlock& block, const Eigen::VectorXd& u,
                                  const ImposedStrains* imposed) const;
  std::vector<double> excess_of(const ElementBlock& block, const Eigen::VectorXd& u, const ElementField& given) const;
  std::vector<double> excess_of_plates(const ElementBlock& block, const Eigen::VectorXd& u,
                                       const ElementField& given) const;
  void add_initial_stress_forces(std::span<const AppliedLoad> loads, double time, std::span<long double> sums) const;
  void take_initial_stresses(const ElementBlock& block, const Eigen::VectorXd& u, const ElementField& given);
  ElementField field_at_points(std::string quantity, std::vector<std::string> components) const;
  void add_initial_stresses(const ElementBlock& block, std::vector<double> values);
  void sum_initial_forces();

  struct Blocks;
  const Model& model_;
  const MaterialField& materials_;
  const ElementProperties& properties_;
  const DofMap& dofs_;
  std::unique_ptr<Blocks> blocks_;
  VariableState state_;
  std::unique_ptr<const ImposedStrains> imposed_;  ///< null: none
  /// What elements without a memory have beside the stresses of their displacements; of plates forces.
  struct InitialStresses {
    const ElementBlock* block;
    std::vector<double> values;
    std::vector<double> moduli;  ///< Young's, of each element, that go with them; empty where they do not count
    std::vector<double> now(const VariableState& state) const;
  };
  std::vector<InitialStresses> initial_stresses_;
  Eigen::VectorXd initial_forces_;  ///< of these; empty: none
  int version_ = 0;
};

/// A vector over the degrees of freedom as a nodal field ("DEPL_R", components of the map, NaN where a node has none).
NodalField to_field(const Eigen::VectorXd& values, const DofMap& dofs, std::string quantity);

}  // namespace comma::solver
