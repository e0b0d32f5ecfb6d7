// Continua whose material has a memory, in small strains or large ones, with the template of elastic ones beneath.
#pragma once

#include <optional>
#include <vector>

#include "solver/elements/naming_cell.hpp"
#include "solver/elements/solids/continuum_block.hpp"
#include "solver/materials/behaviour/large_strain.hpp"
#include "solver/materials/behaviour/point_law.hpp"

namespace comma::solver {

/// Keeps what each integration point was when the step began; all that it computes is of a trial from there, until
/// accept() makes one the next step's beginning. Large strains are on the initial geometry: internal forces F S grad N
/// over the initial volume.
template <int Dim, int Nodes, bool Axisymmetric>
class InelasticBlock : public ContinuumBlock<Dim, Nodes, Axisymmetric> {
  using Base = ContinuumBlock<Dim, Nodes, Axisymmetric>;

 protected:
  using Base::size;
  using Base::strains;
  using typename Base::Coordinates;
  using typename Base::Displacements;
  using typename Base::Point;
  using typename Base::Stiffness;
  using typename Base::Strain;
  using typename Base::StrainRow;

 public:
  InelasticBlock(const BlockInput& input, std::vector<int> cells)
      : Base(input, std::move(cells)),
        law_(input.behaviour_of(this->cells_.front()), this->formulation_ == Formulation::plane_stress ||
                                                           this->formulation_ == Formulation::plane_stress_reduced) {
    collect_constants(input);
    past_.resize(this->cells_.size() * this->samples_.size());
  }

  bool is_linear() const override { return law_.is_linear(); }
  bool is_elastically_linear() const override { return !law_.is_large(); }
  bool is_initially_linear() const override { return law_.is_large() || is_elastically_linear(); }
  bool has_memory() const override { return true; }

  void add_stiffness(const Eigen::VectorXd& u, const VariableState& state, std::span<const int> column_starts,
                     double* values) const override {
    assemble(u, state, column_starts, values, &PointLaw::respond);
  }
  bool is_symmetric() const override { return law_.is_symmetric(); }
  bool is_elastically_symmetric() const override { return true; }
  void add_skew_stiffness(const Eigen::VectorXd& u, const VariableState& state,
                          std::vector<Eigen::Triplet<double>>& entries) const override {
    for_each_in_batches<Stiffness>(
        this->map_.element_count(), may_be_concurrent(state),
        [&](int element, Stiffness& k) { skew_tangent(element, u, state, k); },
        [&](int element, const Stiffness& k) { this->map_.append_skew_half(element, k, entries); });
  }
  void add_elastic_stiffness(const Eigen::VectorXd& u, const VariableState& state, std::span<const int> column_starts,
                             double* values) const override {
    assemble(u, state, column_starts, values, &PointLaw::respond_elastically);
  }
  void add_initial_stiffness(const Eigen::VectorXd& u, const VariableState& state, std::span<const int> column_starts,
                             double* values) const override {
    if (law_.is_large())
      Base::add_stiffness(u, state, column_starts, values);
    else
      add_elastic_stiffness(u, state, column_starts, values);
  }

  void add_internal_forces(const Eigen::VectorXd& u, const VariableState& state, ForceSum forces) const override {
    add_law_forces(u, state, forces, &PointLaw::respond);
  }

  void add_starting_stiffness(const Eigen::VectorXd& u, const VariableState& state, std::span<const int> column_starts,
                              double* values) const override {
    assemble(u, state, column_starts, values, law_.is_large() ? &PointLaw::begin_as_it_was : &PointLaw::begin);
  }
  void add_starting_forces(const Eigen::VectorXd& u, const VariableState& state, ForceSum forces) const override {
    if (!law_.is_large()) {
      add_law_forces(u, state, forces, &PointLaw::begin);
      return;
    }
    add_forces(u, state, forces, [&](int element, int g, const Coordinates& x, const Eigen::Matrix3d& gradient) {
      return law_.stress_of_results(gradient, respond(element, g, x, gradient, state, &PointLaw::begin_as_it_was));
    });
    add_change_of_variables(u, state, forces);
  }
  void add_variable_forces(const Eigen::VectorXd& u, const VariableState& state, ForceSum forces) const override {
    add_forces(u, state, forces, [&](int element, int g, const Coordinates& x, const Eigen::Matrix3d& gradient) {
      const Constants constants(*this, element, g, x, state);
      return law_.stress_of_variables(
          {gradient, constants.inelastic, *constants.plastic, past_[point_index(element, g)]});
    });
  }

  void add_forces_of_stresses(const Eigen::VectorXd& u, const VariableState& state, std::span<const double> reported,
                              ForceSum forces) const override {
    add_forces(u, state, forces, [&](int element, int g, const Coordinates&, const Eigen::Matrix3d& gradient) {
      const Vector6d stress = padded(reported.data() + (element * this->point_count() + g) * strains);
      return law_.is_large() ? second_stress_of(gradient, stress) : stress;
    });
  }

  /// The law sees whole strains, as in Code_Aster 17.3: imposed ones push by Hooke's law on the initial geometry.
  void impose(const ImposedStrains*) override {}
  bool shows_imposed_strains() const override { return true; }
  void subtract_imposed_stresses(const ImposedStrains&, const VariableState&, std::span<double>) const override {}

  void stresses(const Eigen::VectorXd& u, const VariableState& state, std::span<double> out) const override {
    double* target = out.data();
    visit(u, state, [&](std::size_t, const Eigen::Matrix3d&, const PointResponse& response) {
      Eigen::Map<Strain> written(target);
      written = response.reported.template head<strains>();
      target += strains;
    });
  }

  void extrapolate(std::optional<double> ratio) override { extrapolation_ = ratio; }

  int variable_count() const override { return law_.variable_count(); }
  void variables(const Eigen::VectorXd& u, const VariableState& state, std::span<double> out) const override {
    double* target = out.data();
    visit(u, state, [&](std::size_t, const Eigen::Matrix3d&, const PointResponse& response) {
      target = std::copy_n(response.variables.begin(), law_.variable_count(), target);
    });
  }

  void energies(const Eigen::VectorXd&, const VariableState&, std::span<double> out) const override {
    std::ranges::fill(out, absent);
  }

  void energy_densities(const Eigen::VectorXd& u, const VariableState& state, std::span<const double> reported,
                        std::span<const double> variables, std::span<double> out) const override {
    const auto count = static_cast<std::size_t>(law_.variable_count());
    each_point(u, state, [&](int element, int g, const Coordinates& x, const Eigen::Matrix3d& gradient) {
      const std::size_t index = point_index(element, g);
      const Constants constants(*this, element, g, x, state);
      PointPast at;
      at.gradient = gradient;
      at.inelastic = constants.inelastic;
      at.moduli = *constants.plastic;
      std::copy_n(variables.data() + index * count, count, at.variables.begin());
      at.stress = law_.own_stress(at, padded(reported.data() + index * strains), true);
      out[index] = law_.elastic_energy(at, *constants.plastic);
    });
  }

  void accept(const Eigen::VectorXd& u, const VariableState& state) override {
    visit(u, state, [&](std::size_t point, const Eigen::Matrix3d& gradient, const PointResponse& response) {
      past_[point].gradient = gradient;
      past_[point].stress = response.own;
      past_[point].flow = law_.flow_between(past_[point].variables, response.variables);
      past_[point].variables = response.variables;
    });
    remember_materials(state);
  }

  void resume(const Eigen::VectorXd& u, const VariableState& state, std::span<const double> reported,
              std::span<const double> variables) override {
    const auto count = static_cast<std::size_t>(law_.variable_count());
    remember_materials(state);
    each_point(u, state, [&](int element, int g, const Coordinates&, const Eigen::Matrix3d& gradient) {
      const std::size_t index = point_index(element, g);
      PointPast& past = past_[index];
      past.gradient = gradient;
      past.stress.setZero();
      past.variables.fill(0.0);
      past.flow = 0.0;
      if (!variables.empty()) std::copy_n(variables.data() + index * count, count, past.variables.begin());
      std::optional<Vector6d> shown;
      if (!reported.empty()) shown = padded(reported.data() + index * strains);
      past.stress = law_.first_stress(past, shown, !variables.empty());
    });
  }

 protected:
  using Respond = PointResponse (PointLaw::*)(const PointInput&) const;

  std::size_t point_index(int element, int g) const {
    return static_cast<std::size_t>(element) * this->samples_.size() + static_cast<std::size_t>(g);
  }

  static Vector6d padded(const double* stress) {
    Vector6d result = Vector6d::Zero();
    result.head<strains>() = Eigen::Map<const Strain>(stress);
    return result;
  }

  /// The constants once for each material that does not vary.
  void collect_constants(const BlockInput& input) {
    std::map<const Material*, int> known;
    for (const int cell : this->cells_) {
      const Material* material = input.materials.by_cell[static_cast<std::size_t>(cell)].get();
      const auto [entry, is_new] = known.try_emplace(material, static_cast<int>(plastic_materials_.size()));
      if (is_new) plastic_materials_.push_back(plastic_material(input, cell, *material));
      plastic_material_of_element_.push_back(entry->second);
    }
  }

  struct PlasticMaterial {
    const IsotropicElasticity* elasticity;
    const Plasticity* plasticity;
    bool constant;
    PlasticPoint point;
  };

  PlasticMaterial plastic_material(const BlockInput& input, int cell, const Material& material) const {
    const IsotropicElasticity& elasticity = isotropic_material(input, cell);
    if (law_.restores_hardening() && !material.plasticity.restoration)
      naming_cell(this->mesh_, cell, [] { throw_missing_material("REST_ECRO"); });
    PlasticMaterial result{
        &elasticity, &material.plasticity, solver::is_constant(elasticity, material.plasticity, law_.relation()), {}};
    if (result.constant)
      result.point = naming_cell(this->mesh_, cell, [&] {
        return compressible(plastic_point(elasticity, material.plasticity, law_.relation(), MaterialPoint()));
      });
    return result;
  }

  const PlasticMaterial& plastic_material_of(int element) const {
    return plastic_materials_[static_cast<std::size_t>(
        plastic_material_of_element_[static_cast<std::size_t>(element)])];
  }

  static PlasticPoint compressible(PlasticPoint point) {
    if (!std::isfinite(point.bulk)) require_compressible(0.5);
    return point;
  }

  /// What the material is at a point.
  struct Constants {
    const PlasticPoint* plastic;
    Vector6d inelastic = Vector6d::Zero();
    PlasticPoint own;  ///< written when it varies alone

    Constants(const InelasticBlock& block, int element, int g, const Coordinates& x, const VariableState& state) {
      const PlasticMaterial& material = block.plastic_material_of(element);
      const auto& elastic = block.materials_[block.material_of_element_[element]];
      plastic = &material.point;
      const bool strained = elastic.strained(state);
      if (block.imposed_ != nullptr) inelastic = block.imposed_strain(element, g, x);
      if (material.constant && !strained) return;
      const MaterialPoint at = block.material_point(element, g, x, state);
      if (strained) inelastic += inelastic_strain(elastic.material, at);
      if (material.constant) return;
      own = compressible(plastic_point(*material.elasticity, *material.plasticity, block.law_.relation(), at));
      plastic = &own;
    }
    Constants(const Constants&) = delete;
    Constants& operator=(const Constants&) = delete;
  };

  /// Plane bodies have no strains out of their plane but that across it.
  Vector6d imposed_strain(int element, int g, const Coordinates& x) const {
    Vector6d strain = Vector6d::Zero();
    strain.head<strains>() = Base::imposed_strain(*this->imposed_, element, g, x);
    return strain;
  }

  PointResponse respond(int element, int g, const Coordinates& x, const Eigen::Matrix3d& gradient,
                        const VariableState& state, Respond how) const {
    return naming_cell(this->mesh_, this->cells_[static_cast<std::size_t>(element)], [&] {
      const Constants constants(*this, element, g, x, state);
      const PointInput input{gradient, constants.inelastic, *constants.plastic, past_[point_index(element, g)]};
      return extrapolation_ ? law_.respond_extrapolated(input, *extrapolation_) : (law_.*how)(input);
    });
  }

  void remember_materials(const VariableState& state) {
    since_ = state.time();
    for (int element = 0; element < this->map_.element_count(); ++element) {
      const Coordinates x = this->coordinates(element);
      for (int g = 0; g < this->point_count(); ++g) {
        naming_cell(this->mesh_, this->cells_[static_cast<std::size_t>(element)], [&] {
          const Constants constants(*this, element, g, x, state);
          past_[point_index(element, g)].inelastic = constants.inelastic;
          past_[point_index(element, g)].moduli = *constants.plastic;
        });
      }
    }
  }

  /// The gradient that the law is given where that of the displacement is H: the same, unless an element has a volume
  /// of its own.
  virtual Eigen::Matrix3d law_gradient(const Eigen::VectorXd&, const VariableState&, int, int, const Coordinates&,
                                       const Eigen::Matrix3d& gradient) const {
    return gradient;
  }

  /// Calls visitor(element, g, coordinates, H that the law is given) for each point.
  template <class Visitor>
  void each_point(const Eigen::VectorXd& u, const VariableState& state, Visitor&& visitor) const {
    std::array<int, size> dofs;
    for (int element = 0; element < this->map_.element_count(); ++element) {
      this->map_.dofs(element, dofs.data());
      const Displacements displacements = Base::relative_displacements(u, dofs);
      const Coordinates x = this->coordinates(element);
      for (int g = 0; g < this->point_count(); ++g)
        visitor(element, g, x,
                law_gradient(u, state, element, g, x,
                             Base::gradient_of_displacement(displacements, this->samples_[g],
                                                            Base::locate(x, this->samples_[g]))));
    }
  }

  /// The response where a step ends.
  PointResponse reached(int element, int g, const Coordinates& x, const Eigen::Matrix3d& gradient,
                        const VariableState& state) const {
    PointResponse response = respond(element, g, x, gradient, state, &PointLaw::respond);
    if (law_.restores_hardening())
      law_.restore(*plastic_material_of(element).plasticity->restoration, this->material_point(element, g, x, state),
                   state.time() - since_, past_[point_index(element, g)], response);
    return response;
  }

  /// Calls visitor(index of the point, H, response where a step ends).
  template <class Visitor>
  void visit(const Eigen::VectorXd& u, const VariableState& state, Visitor&& visitor) const {
    each_point(u, state, [&](int element, int g, const Coordinates& x, const Eigen::Matrix3d& gradient) {
      visitor(point_index(element, g), gradient, reached(element, g, x, gradient, state));
    });
  }

  /// The variation of the strain that a displacement of node a causes: of Green and Lagrange's at F = I + H in large
  /// strains.
  StrainRow row(const Eigen::Matrix3d& gradient, int g, const Point& point, int a) const {
    if (!law_.is_large()) return Base::strain_row(this->samples_[g], point, a);
    return Base::green_lagrange_row(Eigen::Matrix3d::Identity() + gradient, this->samples_[g], point, a);
  }

  void add_law_forces(const Eigen::VectorXd& u, const VariableState& state, ForceSum forces, Respond how) const {
    add_forces(u, state, forces, [&](int element, int g, const Coordinates& x, const Eigen::Matrix3d& gradient) {
      return respond(element, g, x, gradient, state, how).stress;
    });
  }

  /// What the command variables have changed since the last step, on the initial geometry.
  void add_change_of_variables(const Eigen::VectorXd& u, const VariableState& state, ForceSum forces) const {
    if (state.empty()) return;
    const Eigen::VectorXd at_rest = Eigen::VectorXd::Zero(u.size());
    add_forces(at_rest, state, forces, [&](int element, int g, const Coordinates& x, const Eigen::Matrix3d&) {
      const Constants constants(*this, element, g, x, state);
      const auto& sample = this->samples_[static_cast<std::size_t>(g)];
      const Eigen::Matrix3d gradient = Base::gradient_of_displacement(
          Base::relative_displacements(u, this->dofs_of(element)), sample, Base::locate(x, sample));
      return law_.change_of_variables(
          {gradient, constants.inelastic, *constants.plastic, past_[point_index(element, g)]});
    });
  }

  /// `stress_at`(element, g, coordinates, H): the stress whose work on the strain is that of the forces.
  template <class StressAt>
  void add_forces(const Eigen::VectorXd& u, const VariableState& state, ForceSum forces, StressAt&& stress_at) const {
    for_each_in_batches<Coordinates>(
        this->map_.element_count(), may_be_concurrent(state),
        [&](int element, Coordinates& force) { force = forces_of(element, u, stress_at); },
        [&](int element, const Coordinates& force) { Base::scatter_forces(force, this->dofs_of(element), forces); });
  }

  template <class StressAt>
  Coordinates forces_of(int element, const Eigen::VectorXd& u, const StressAt& stress_at) const {
    const Displacements displacements = Base::relative_displacements(u, this->dofs_of(element));
    const Coordinates x = this->coordinates(element);
    Coordinates force = Coordinates::Zero();
    for (int g = 0; g < this->point_count(); ++g) {
      const Point point = Base::locate(x, this->samples_[g]);
      const Eigen::Matrix3d gradient = Base::gradient_of_displacement(displacements, this->samples_[g], point);
      const Strain stress = point.weight * stress_at(element, g, x, gradient).template head<strains>();
      for (int a = 0; a < Nodes; ++a) force.row(a) += (row(gradient, g, point, a).transpose() * stress).transpose();
    }
    return force;
  }

  void assemble(const Eigen::VectorXd& u, const VariableState& state, std::span<const int> column_starts,
                double* values, Respond how) const {
    for_each_in_batches<Stiffness>(
        this->map_.element_count(), may_be_concurrent(state),
        [&](int element, Stiffness& k) { tangent(element, u, state, how, k); },
        [&](int element, const Stiffness& k) { this->map_.add(element, k.data(), column_starts, values); });
  }

  bool may_be_concurrent(const VariableState& state) const {
    return this->imposed_ == nullptr && this->evaluates_no_function(state) &&
           std::ranges::all_of(plastic_materials_, [](const PlasticMaterial& material) { return material.constant; });
  }

  void tangent(int element, const Eigen::VectorXd& u, const VariableState& state, Respond how, Stiffness& k) const {
    k.setZero();
    each_response(element, u, state, how, [&](int g, const Point& point, const Rows& rows, const PointResponse& at) {
      Base::add_material(in_block(0.5 * (at.tangent + at.tangent.transpose())), point.weight, rows, k);
      const typename Base::Strain stress = at.stress.template head<strains>();
      if (law_.has_geometric_part()) Base::add_geometric(point, stress, k);
      if (law_.has_hoop_part()) Base::add_hoops(this->samples_[g], point, stress, k);
    });
    k.template triangularView<Eigen::StrictlyUpper>() = k.transpose();
    make_translation_exact<Nodes, Dim>(k, Base::invariant_directions());
  }

  /// The skew-symmetric half.
  void skew_tangent(int element, const Eigen::VectorXd& u, const VariableState& state, Stiffness& k) const {
    k.setZero();
    each_response(element, u, state, &PointLaw::respond,
                  [&](int, const Point& point, const Rows& rows, const PointResponse& at) {
                    Base::add_material(in_block(0.5 * (at.tangent - at.tangent.transpose())), point.weight, rows, k);
                  });
    k.template triangularView<Eigen::StrictlyUpper>() = -k.transpose();
  }

  using Rows = std::array<StrainRow, Nodes>;

  /// Calls visitor(g, point, strain rows of the nodes, response) for each point of an element.
  template <class Visitor>
  void each_response(int element, const Eigen::VectorXd& u, const VariableState& state, Respond how,
                     Visitor&& visitor) const {
    const Displacements displacements = Base::relative_displacements(u, this->dofs_of(element));
    const Coordinates x = this->coordinates(element);
    Rows rows;
    for (int g = 0; g < this->point_count(); ++g) {
      const Point point = Base::locate(x, this->samples_[g]);
      const Eigen::Matrix3d gradient = Base::gradient_of_displacement(displacements, this->samples_[g], point);
      for (int a = 0; a < Nodes; ++a) rows[a] = row(gradient, g, point, a);
      visitor(g, point, rows, respond(element, g, x, gradient, state, how));
    }
  }

  static typename Base::Law in_block(const Matrix6d& law) { return law.template topLeftCorner<strains, strains>(); }

  PointLaw law_;
  std::vector<PointPast> past_;  ///< cells x points
  double since_ = 0.0;           ///< when the step began
  std::optional<double> extrapolation_;
  std::vector<PlasticMaterial> plastic_materials_;
  std::vector<int> plastic_material_of_element_;
};

}  // namespace comma::solver
