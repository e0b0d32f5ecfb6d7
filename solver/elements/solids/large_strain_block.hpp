// Continua in large displacements and rotations: Green-Lagrange strains on the initial geometry, with the template of
// small strains beneath.
#pragma once

#include "solver/elements/solids/continuum_block.hpp"

namespace comma::solver {

/// E = (H + H^T + H^T H) / 2 with H = du/dX, second Piola-Kirchhoff stresses S = D (E - strains of the command
/// variables), internal forces F S grad N on the initial volume (total Lagrangian; R5.03.22, GREEN_LAGRANGE of
/// U4.51.11). stresses() are Cauchy's, F S F^T / det F. Made for large rotations; Hooke's law between S and E is a law
/// of small strains.
template <int Dim, int Nodes, bool Axisymmetric>
class LargeStrainBlock final : public ContinuumBlock<Dim, Nodes, Axisymmetric> {
  using Base = ContinuumBlock<Dim, Nodes, Axisymmetric>;
  using Base::size;
  using Base::strains;
  using typename Base::Behaviour;
  using typename Base::Coordinates;
  using typename Base::Displacements;
  using typename Base::Law;
  using typename Base::Point;
  using typename Base::Sample;
  using typename Base::Stiffness;
  using typename Base::Strain;
  using typename Base::StrainRow;

 public:
  using Base::Base;

  bool is_linear() const override { return false; }
  bool is_constant() const override { return false; }

  void add_stiffness(const Eigen::VectorXd& u, const VariableState& state, std::span<const int> column_starts,
                     double* values) const override {
    add_tangents(u, state, state, column_starts, values);
  }

  void add_initial_stiffness(const Eigen::VectorXd& u, const VariableState& state, std::span<const int> column_starts,
                             double* values) const override {
    Base::add_stiffness(u, state, column_starts, values);
  }
  bool is_initially_linear() const override { return true; }

  /// Where a step begins, what the command variables have changed pushes on the initial geometry, and what stresses add
  /// to the tangent is as it was: Code_Aster 17.3 takes both so.
  void add_starting_stiffness(const Eigen::VectorXd& u, const VariableState& state, std::span<const int> column_starts,
                              double* values) const override {
    add_tangents(u, state, has_moved(u) ? state : earlier_, column_starts, values);
  }
  void add_starting_forces(const Eigen::VectorXd& u, const VariableState& state, ForceSum forces) const override {
    if (has_moved(u)) return add_internal_forces(u, state, forces);
    add_internal_forces(u, earlier_, forces);
    const Eigen::VectorXd at_rest = Eigen::VectorXd::Zero(u.size());
    this->add_variable_forces(at_rest, earlier_, forces);
    std::vector<long double> now(forces.size(), 0.0L);
    this->add_variable_forces(at_rest, state, now);
    for (std::size_t i = 0; i < forces.size(); ++i) forces[i] -= now[i];
  }
  void accept(const Eigen::VectorXd& u, const VariableState& state) override {
    if (state.empty()) return;
    earlier_ = state;
    earlier_displacements_ = u;
  }
  void resume(const Eigen::VectorXd& u, const VariableState& state, std::span<const double>,
              std::span<const double>) override {
    accept(u, state);
  }

  void add_internal_forces(const Eigen::VectorXd& u, const VariableState& state, ForceSum forces) const override {
    std::array<int, size> dofs;
    for (int element = 0; element < this->map_.element_count(); ++element) {
      this->map_.dofs(element, dofs.data());
      const Displacements displacements = Base::relative_displacements(u, dofs);
      const Coordinates x = this->coordinates(element);
      Coordinates force = Coordinates::Zero();
      for (int g = 0; g < this->point_count(); ++g) {
        const Deformed at(*this, element, g, x, displacements, state);
        const Strain stress = at.point.weight * at.stress;
        for (int a = 0; a < Nodes; ++a) force.row(a) += (at.row(a).transpose() * stress).transpose();
      }
      Base::scatter_forces(force, dofs, forces);
    }
  }

  /// Imposed strains push on the initial geometry, and are no part of the strain.
  bool shows_imposed_strains() const override { return true; }
  void subtract_imposed_stresses(const ImposedStrains&, const VariableState&, std::span<double>) const override {}

  void stresses(const Eigen::VectorXd& u, const VariableState& state, std::span<double> out) const override {
    std::array<int, size> dofs;
    double* target = out.data();
    for (int element = 0; element < this->map_.element_count(); ++element) {
      this->map_.dofs(element, dofs.data());
      const Displacements displacements = Base::relative_displacements(u, dofs);
      const Coordinates x = this->coordinates(element);
      for (int g = 0; g < this->point_count(); ++g) {
        const Deformed at(*this, element, g, x, displacements, state);
        const Eigen::Matrix3d cauchy =
            at.gradient * tensor(at.stress) * at.gradient.transpose() / at.gradient.determinant();
        Eigen::Map<Strain> written(target);
        written = components(cauchy);
        target += strains;
      }
    }
  }

  void energies(const Eigen::VectorXd& u, const VariableState& state, std::span<double> out) const override {
    std::array<int, size> dofs;
    for (int element = 0; element < this->map_.element_count(); ++element) {
      this->map_.dofs(element, dofs.data());
      const Displacements displacements = Base::relative_displacements(u, dofs);
      const Coordinates x = this->coordinates(element);
      out[element] = 0.0;
      for (int g = 0; g < this->point_count(); ++g) {
        const Deformed at(*this, element, g, x, displacements, state);
        out[element] += 0.5 * at.point.weight * at.elastic.dot(at.stress);
      }
    }
  }

 private:
  static Eigen::Matrix3d tensor(const Strain& s) {
    Eigen::Matrix3d t = Eigen::Matrix3d::Zero();
    t.diagonal() << s(0), s(1), s(2);
    t(0, 1) = t(1, 0) = s(3);
    if constexpr (Dim == 3) {
      t(0, 2) = t(2, 0) = s(4);
      t(1, 2) = t(2, 1) = s(5);
    }
    return t;
  }

  static Strain components(const Eigen::Matrix3d& t) {
    Strain s;
    s.template head<4>() << t(0, 0), t(1, 1), t(2, 2), t(0, 1);
    if constexpr (Dim == 3) s.template tail<2>() << t(0, 2), t(1, 2);
    return s;
  }

  /// What an integration point knows of its deformation.
  struct Deformed {
    const Sample& sample;
    Point point;
    Behaviour behaviour;
    Eigen::Matrix3d gradient = Eigen::Matrix3d::Identity();  ///< F
    Strain elastic;  ///< Green-Lagrange's less that of the command variables; shears doubled
    Strain stress;   ///< second Piola-Kirchhoff

    Deformed(const LargeStrainBlock& block, int element, int g, const Coordinates& x, const Displacements& u,
             const VariableState& state)
        : sample(block.samples_[g]), point(Base::locate(x, sample)), behaviour(block, element, g, x, state) {
      // From H rather than from F: small strains must not drown in the rounding of 1.
      const Eigen::Matrix3d h = Base::gradient_of_displacement(u, sample, point);
      gradient += h;
      const Eigen::Matrix3d green = 0.5 * (h + h.transpose() + h.transpose() * h);
      elastic = components(green);
      elastic.template tail<strains - 3>() *= 2.0;
      elastic -= behaviour.inelastic;
      stress.noalias() = *behaviour.law * elastic;
    }

    /// The variation of E that a displacement of node a causes.
    StrainRow row(int a) const { return Base::green_lagrange_row(gradient, sample, point, a); }
  };

  bool has_moved(const Eigen::VectorXd& u) const {
    return earlier_displacements_.size() != u.size() || earlier_displacements_ != u;
  }

  /// `of_stresses`: the command variables of the stresses that the tangent has a part of.
  void add_tangents(const Eigen::VectorXd& u, const VariableState& state, const VariableState& of_stresses,
                    std::span<const int> column_starts, double* values) const {
    Stiffness k;
    std::array<int, size> dofs;
    for (int element = 0; element < this->map_.element_count(); ++element) {
      this->map_.dofs(element, dofs.data());
      tangent(element, Base::relative_displacements(u, dofs), state, of_stresses, k);
      this->map_.add(element, k.data(), column_starts, values);
    }
  }

  void tangent(int element, const Displacements& u, const VariableState& state, const VariableState& of_stresses,
               Stiffness& k) const {
    const Coordinates x = this->coordinates(element);
    k.setZero();
    std::array<StrainRow, Nodes> rows;
    for (int g = 0; g < this->point_count(); ++g) {
      const Deformed at(*this, element, g, x, u, state);
      for (int a = 0; a < Nodes; ++a) rows[a] = at.row(a);
      Base::add_material(*at.behaviour.law, at.point.weight, rows, k);
      const bool is_same_state = &of_stresses == &state;
      Base::add_geometric(at.point, is_same_state ? at.stress : Deformed(*this, element, g, x, u, of_stresses).stress,
                          k);
    }
    k.template triangularView<Eigen::StrictlyUpper>() = k.transpose();
    make_translation_exact<Nodes, Dim>(k, Base::invariant_directions());
  }

  VariableState earlier_;  ///< where the step began
  Eigen::VectorXd earlier_displacements_;
};

/// An elastic block of continua, in small or large strains as the behaviour of its cells has it.
template <int Dim, int Nodes, bool Axisymmetric>
std::unique_ptr<ElementBlock> make_elastic_block(const BlockInput& input, std::vector<int> cells) {
  if (input.behaviour_of(cells.front()).kinematics == Kinematics::green_lagrange)
    return std::make_unique<LargeStrainBlock<Dim, Nodes, Axisymmetric>>(input, std::move(cells));
  return std::make_unique<ContinuumBlock<Dim, Nodes, Axisymmetric>>(input, std::move(cells));
}

}  // namespace comma::solver
