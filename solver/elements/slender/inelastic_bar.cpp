#include "solver/elements/slender/inelastic_bar.hpp"

#include <array>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "solver/elements/naming_cell.hpp"
#include "solver/elements/slender/slender_member.hpp"
#include "solver/elements/translation.hpp"
#include "solver/error.hpp"
#include "solver/materials/behaviour/von_mises.hpp"

namespace comma::solver {

namespace {

constexpr std::array<std::string_view, 1> axial_force = {"N"};
/// Of the stresses, what rounding leaves of an equation between them.
constexpr double bar_rounding_share = 1e-14;
constexpr int back_stress_size = 6;

/// The bulk modulus may be infinite.
double young_of(const PlasticModuli& moduli) { return 9.0 * moduli.shear / (3.0 + moduli.shear / moduli.bulk); }

double ratio_or_one(double now, double before) { return before != 0.0 ? now / before : 1.0; }

/// What the material is at an instant.
struct BarMaterial {
  PlasticPoint plastic;
  double expansion = 0.0;  ///< strain of the command variables, and imposed one
};

/// A bar where a step begins, or at a trial.
struct BarState {
  double strain = 0.0;
  double expansion = 0.0;  ///< as above
  double stress = 0.0;
  double back_stress = 0.0;
  double p = 0.0;
  double p_compression = 0.0;  ///< where compression hardens by itself
  double flow = 0.0;           ///< by which p grew in the step that led here
  bool flowing = false;
  PlasticModuli moduli;
};

struct BarResponse {
  BarState state;
  double tangent;
};

BarResponse integrate(const BarState& past, const BarMaterial& now, double strain) {
  const double young = young_of(now.plastic);
  const double past_young = past.moduli.shear != 0.0 ? young_of(past.moduli) : 0.0;
  const double increment = strain - past.strain - (now.expansion - past.expansion);
  BarResponse response{past, young};
  BarState& state = response.state;
  state.strain = strain;
  state.expansion = now.expansion;
  state.moduli = now.plastic;
  state.flow = 0.0;
  state.flowing = false;
  state.stress = ratio_or_one(young, past_young) * past.stress + young * increment;
  state.back_stress = ratio_or_one(now.plastic.kinematic, past.moduli.kinematic) * past.back_stress;
  if (std::holds_alternative<NoYield>(now.plastic.curve)) return response;
  const double hardness = young + 1.5 * now.plastic.kinematic;
  const double relative = state.stress - 1.5 * state.back_stress;
  const double size = std::abs(relative);
  const bool is_apart = relative < 0.0 && !std::holds_alternative<NoYield>(now.plastic.compression);
  const HardeningCurve& curve = is_apart ? now.plastic.compression : now.plastic.curve;
  double& p = is_apart ? state.p_compression : state.p;
  const auto flow_tangent = [&] { return young - young * young / (hardness + hardening(curve, p).second); };
  if (!(size > hardening(curve, p).first * (1.0 + bar_rounding_share))) {
    // Nothing moves yet: what flowed in the last step is taken to flow on.
    state.flowing = past.flowing && increment == 0.0;
    if (state.flowing) response.tangent = flow_tangent();
    return response;
  }
  const double flow = std::copysign(plastic_increment(curve, size, hardness, p), relative);
  state.flow = std::abs(flow);
  p += state.flow;
  state.flowing = true;
  state.stress -= young * flow;
  state.back_stress += now.plastic.kinematic * flow;
  response.tangent = flow_tangent();
  return response;
}

/// A bar that has flowed in the last step goes on by the tangent of the flow (R5.03.81); `duration`: of this step, in
/// those of the last one.
BarResponse extrapolate_flow(const BarState& past, const BarMaterial& now, double strain, double duration) {
  const double young = young_of(now.plastic);
  const double slope = past.flow > 0.0 ? hardening(now.plastic.curve, past.p + duration * past.flow).second : 0.0;
  BarResponse response{past, past.flow > 0.0 ? young * slope / (young + slope) : young};
  response.state.strain = strain;
  response.state.expansion = now.expansion;
  const double past_young = past.moduli.shear != 0.0 ? young_of(past.moduli) : 0.0;
  response.state.stress = ratio_or_one(young, past_young) * past.stress +
                          response.tangent * (strain - past.strain - (now.expansion - past.expansion));
  return response;
}

template <int Dim>
class InelasticBar final : public ElementBlock {
  static constexpr int size = 2 * Dim;
  using Matrix = Eigen::Matrix<double, size, size>;
  using Direction = Eigen::Matrix<double, Dim, 1>;

 public:
  InelasticBar(const BlockInput& input, std::vector<int> cells)
      : mesh_(*input.model.mesh),
        behaviour_(input.behaviour_of(cells.front())),
        cells_(std::move(cells)),
        map_(input.pattern, input.dofs, input.model.components_of(cells_.front()), 2, gather_nodes(mesh_, cells_)),
        past_(cells_.size()),
        past_stretch_(cells_.size(), Direction::Zero()) {
    for (const int cell : cells_) members_.push_back(member(input, cell));
  }

  void add_stiffness(const Eigen::VectorXd& u, const VariableState& state, std::span<const int> column_starts,
                     double* values) const override {
    for (int element = 0; element < map_.element_count(); ++element)
      map_.add(element, matrix(element, place(element, u), respond(element, u, state).tangent).data(), column_starts,
               values);
  }
  void add_elastic_stiffness(const Eigen::VectorXd& u, const VariableState& state, std::span<const int> column_starts,
                             double* values) const override {
    for (int element = 0; element < map_.element_count(); ++element) {
      const double young = young_of(material(element, state).plastic);
      map_.add(element, matrix(element, place(element, u), young).data(), column_starts, values);
    }
  }
  void add_initial_stiffness(const Eigen::VectorXd&, const VariableState& state, std::span<const int> column_starts,
                             double* values) const override {
    for (int element = 0; element < map_.element_count(); ++element) {
      const double young = young_of(material(element, state).plastic);
      map_.add(element, matrix(element, first_place(element), young).data(), column_starts, values);
    }
  }

  void add_internal_forces(const Eigen::VectorXd& u, const VariableState& state, ForceSum forces) const override {
    for (int element = 0; element < map_.element_count(); ++element)
      add_force(element, place(element, u).along,
                members_[static_cast<std::size_t>(element)].area * respond(element, u, state).state.stress, forces);
  }
  void add_variable_forces(const Eigen::VectorXd& u, const VariableState& state, ForceSum forces) const override {
    for (int element = 0; element < map_.element_count(); ++element) {
      const BarMaterial now = material(element, state);
      add_force(element, place(element, u).along,
                members_[static_cast<std::size_t>(element)].area * young_of(now.plastic) * now.expansion, forces);
    }
  }
  void add_forces_of_stresses(const Eigen::VectorXd& u, const VariableState&, std::span<const double> reported,
                              ForceSum forces) const override {
    for (int element = 0; element < map_.element_count(); ++element)
      add_force(element, place(element, u).along, reported[static_cast<std::size_t>(element)], forces);
  }
  void add_initial_stress_forces(std::span<const double> stresses, ForceSum forces) const override {
    for (int element = 0; element < map_.element_count(); ++element)
      if (const double force = stresses[static_cast<std::size_t>(element)]; !std::isnan(force))
        add_force(element, first_place(element).along, force, forces);
  }

  std::span<const int> cells() const override { return cells_; }
  int point_count() const override { return 1; }
  std::span<const std::string_view> stress_names() const override { return axial_force; }
  bool is_linear() const override { return false; }
  bool is_elastically_linear() const override { return !is_updated(); }
  bool is_initially_linear() const override { return true; }
  bool is_constant() const override {
    return std::ranges::all_of(members_, [](const Member& each) { return each.constant; });
  }
  bool has_memory() const override { return true; }
  void extrapolate(std::optional<double> duration) override {
    if (duration && (behaviour_.relation == Relation::kinematic_linear || is_mixed() || is_asymmetric()))
      throw Error("unsupported",
                  "METHODE='IMPLEX' extrapolates ELAS, VMIS_ISOT_LINE, VMIS_ISOT_TRAC and VMIS_ISOT_PUIS of bars alone",
                  "take METHODE='NEWTON'");
    extrapolation_ = duration;
  }

  void stresses(const Eigen::VectorXd& u, const VariableState& state, std::span<double> out) const override {
    for (int element = 0; element < map_.element_count(); ++element)
      out[static_cast<std::size_t>(element)] =
          members_[static_cast<std::size_t>(element)].area * respond(element, u, state).state.stress;
  }

  int variable_count() const override {
    if (behaviour_.relation == Relation::elastic) return 1;
    if (behaviour_.relation == Relation::kinematic_linear) return back_stress_size + 1;
    if (is_asymmetric()) return 4;
    return is_mixed() ? 2 + back_stress_size : 2;
  }
  void variables(const Eigen::VectorXd& u, const VariableState& state, std::span<double> out) const override {
    std::ranges::fill(out, 0.0);
    if (behaviour_.relation == Relation::elastic) return;
    for (int element = 0; element < map_.element_count(); ++element) {
      const BarState reached = respond(element, u, state).state;
      const auto of_element = out.subspan(static_cast<std::size_t>(element * variable_count()));
      of_element[place_of_flow(reached.stress)] = reached.flowing ? 1.0 : 0.0;
      if (is_asymmetric()) of_element[2] = reached.p_compression;
      if (behaviour_.relation != Relation::kinematic_linear) of_element[0] = reached.p;
      if (moves_centre()) of_element[place_of_back_stress()] = shown_back_stress() * reached.back_stress;
    }
  }

  void energies(const Eigen::VectorXd& u, const VariableState& state, std::span<double> out) const override {
    for (int element = 0; element < map_.element_count(); ++element) {
      const Member& own = members_[static_cast<std::size_t>(element)];
      const BarState reached = respond(element, u, state).state;
      out[static_cast<std::size_t>(element)] =
          own.length * own.area * reached.stress * reached.stress / (2.0 * young_of(reached.moduli));
    }
  }
  void energy_densities(const Eigen::VectorXd&, const VariableState&, std::span<const double>, std::span<const double>,
                        std::span<double> out) const override {
    std::ranges::fill(out, absent);
  }

  void accept(const Eigen::VectorXd& u, const VariableState& state) override {
    for (int element = 0; element < map_.element_count(); ++element) {
      past_[static_cast<std::size_t>(element)] = respond(element, u, state).state;
      past_stretch_[static_cast<std::size_t>(element)] = stretch(element, u);
    }
  }

  void resume(const Eigen::VectorXd& u, const VariableState& state, std::span<const double> reported,
              std::span<const double> variables) override {
    for (int element = 0; element < map_.element_count(); ++element) {
      const auto index = static_cast<std::size_t>(element);
      const BarMaterial now = material(element, state);
      BarState& past = past_[index];
      past = BarState{};
      past.strain = is_updated() ? 0.0 : place(element, u).strain;
      past_stretch_[index] = stretch(element, u);
      past.expansion = now.expansion;
      past.moduli = now.plastic;
      if (!reported.empty()) past.stress = reported[index] / members_[index].area;
      if (variables.empty() || behaviour_.relation == Relation::elastic) continue;
      const auto of_element = variables.subspan(index * static_cast<std::size_t>(variable_count()));
      past.flowing = of_element[place_of_flow(past.stress)] > 0.5;
      if (is_asymmetric()) past.p_compression = of_element[2];
      if (behaviour_.relation != Relation::kinematic_linear) past.p = of_element[0];
      if (moves_centre()) past.back_stress = of_element[place_of_back_stress()] / shown_back_stress();
    }
  }

  /// The law sees whole strains, as in Code_Aster 17.3: imposed ones push by Young's modulus along the first direction.
  bool shows_imposed_strains() const override { return true; }
  void add_imposed_strain_forces(const ImposedStrains& imposed, const VariableState& state,
                                 ForceSum forces) const override {
    for (int element = 0; element < map_.element_count(); ++element) {
      const auto index = static_cast<std::size_t>(element);
      if (!imposed.acts_on(cells_[index])) continue;
      const double elongation = imposed.slender(cells_[index], centre(element))[0];
      add_force(element, first_place(element).along,
                members_[index].area * young_of(material(element, state).plastic) * elongation, forces);
    }
  }

 private:
  struct Member {
    Direction along;
    double length;
    double area;
    const IsotropicElasticity* elasticity;
    const Plasticity* plasticity;
    bool constant;
  };

  bool is_mixed() const {
    return behaviour_.relation == Relation::mixed_linear || behaviour_.relation == Relation::mixed_traction;
  }
  bool is_asymmetric() const { return behaviour_.relation == Relation::asymmetric_linear; }
  std::size_t place_of_flow(double stress) const { return is_asymmetric() && stress < 0.0 ? 3 : 1; }
  bool moves_centre() const { return behaviour_.relation == Relation::kinematic_linear || is_mixed(); }
  std::size_t place_of_back_stress() const { return is_mixed() ? 2 : 0; }
  /// Kinematic hardening alone shows X of |stress - X| <= SY (R5.03.09), both together that of the tensor.
  double shown_back_stress() const { return is_mixed() ? 1.0 : 1.5; }

  Member member(const BlockInput& input, int cell) const {
    const auto found = input.properties.sections.find(cell);
    if (found == input.properties.sections.end()) {
      throw Error("missing-properties",
                  fmt::format("the bar or beam on cell {} has no cross-section", mesh_.cell_name(cell)));
    }
    if (!(found->second.area > 0.0)) {
      throw Error("invalid-properties",
                  fmt::format("the cross-section of cell {} needs a positive area", mesh_.cell_name(cell)));
    }
    const auto nodes = mesh_.cell(cell);
    Direction way;
    for (int c = 0; c < Dim; ++c)
      way[c] = mesh_.nodes[static_cast<std::size_t>(nodes[1])][static_cast<std::size_t>(c)] -
               mesh_.nodes[static_cast<std::size_t>(nodes[0])][static_cast<std::size_t>(c)];
    const IsotropicElasticity& elasticity = isotropic_material(input, cell);
    const Plasticity& plasticity = input.materials.by_cell[static_cast<std::size_t>(cell)]->plasticity;
    return {way.normalized(), way.norm(),  found->second.area,
            &elasticity,      &plasticity, solver::is_constant(elasticity, plasticity, behaviour_.relation)};
  }

  /// Command variables count by their mean over the two nodes.
  BarMaterial material(int element, const VariableState& state) const {
    const auto index = static_cast<std::size_t>(element);
    const Member& own = members_[index];
    return naming_cell(mesh_, cells_[index], [&]() -> BarMaterial {
      const MaterialPoint at = middle_of(mesh_, cells_[index], state);
      return {plastic_point(*own.elasticity, *own.plasticity, behaviour_.relation, at),
              state.empty() ? 0.0 : inelastic_axial_strain(*own.elasticity, at)};
    });
  }

  Eigen::Vector3d centre(int element) const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const int node : map_.nodes(element))
      sum += Eigen::Map<const Eigen::Vector3d>(mesh_.nodes[static_cast<std::size_t>(node)].data());
    return 0.5 * sum;
  }

  /// Where a bar is, and its strain: on the initial geometry, or (PETIT_REAC) the sum over the steps of their stretch
  /// on the geometry where each ends (U4.51.11).
  struct Place {
    Direction along;
    double length;
    double strain;
  };

  bool is_updated() const { return behaviour_.kinematics == Kinematics::updated; }

  /// What the second node has moved relative to the first.
  Direction stretch(int element, const Eigen::VectorXd& u) const {
    std::array<int, size> dofs;
    map_.dofs(element, dofs.data());
    Direction moved;
    for (std::size_t c = 0; c < Dim; ++c) moved[static_cast<int>(c)] = u[dofs[Dim + c]] - u[dofs[c]];
    return moved;
  }

  Place first_place(int element) const {
    const Member& own = members_[static_cast<std::size_t>(element)];
    return {own.along, own.length, 0.0};
  }

  Place place(int element, const Eigen::VectorXd& u) const {
    Place now = first_place(element);
    const Direction moved = stretch(element, u);
    if (!is_updated()) {
      now.strain = now.along.dot(moved) / now.length;
      return now;
    }
    const auto index = static_cast<std::size_t>(element);
    const Direction chord = now.length * now.along + moved;
    now.length = chord.norm();
    if (!(now.length > 0.0))
      throw Error("integration-failure",
                  fmt::format("the bar of cell {} has no length left", mesh_.cell_name(cells_[index])),
                  "take shorter steps");
    now.along = chord / now.length;
    now.strain = past_[index].strain + now.along.dot(moved - past_stretch_[index]) / now.length;
    return now;
  }

  BarResponse respond(int element, const Eigen::VectorXd& u, const VariableState& state) const {
    const BarState& past = past_[static_cast<std::size_t>(element)];
    const double strain = place(element, u).strain;
    if (extrapolation_) return extrapolate_flow(past, material(element, state), strain, *extrapolation_);
    return integrate(past, material(element, state), strain);
  }

  /// Without what a bar that turns adds to it, as Code_Aster 17.3 has it: iterations converge linearly then.
  Matrix matrix(int element, const Place& at, double tangent) const {
    const double area = members_[static_cast<std::size_t>(element)].area;
    const Eigen::Matrix<double, Dim, Dim> block = tangent * area / at.length * (at.along * at.along.transpose());
    Matrix k;
    k << block, -block, -block, block;
    std::array<bool, Dim> invariant;
    invariant.fill(true);
    make_translation_exact<2, Dim>(k, invariant);
    return k;
  }

  void add_force(int element, const Direction& along, double force, ForceSum forces) const {
    std::array<int, size> dofs;
    map_.dofs(element, dofs.data());
    for (int c = 0; c < Dim; ++c) {
      forces[static_cast<std::size_t>(dofs[static_cast<std::size_t>(c)])] -= force * along[c];
      forces[static_cast<std::size_t>(dofs[static_cast<std::size_t>(Dim + c)])] += force * along[c];
    }
  }

  const Mesh& mesh_;
  CellBehaviour behaviour_;
  std::vector<int> cells_;
  ElementMap map_;
  std::vector<Member> members_;
  std::vector<BarState> past_;
  std::vector<Direction> past_stretch_;  ///< of the second node relative to the first
  std::optional<double> extrapolation_;
};

}  // namespace

std::unique_ptr<ElementBlock> make_inelastic_bar_block(const BlockInput& input, std::vector<int> cells) {
  const CellBehaviour behaviour = input.behaviour_of(cells.front());
  if (behaviour.relation == Relation::hyperelastic || !has_small_strains(behaviour.kinematics)) {
    throw Error("unsupported",
                fmt::format("cell {}: bars flow in small strains, by von Mises' criterion",
                            input.model.mesh->cell_name(cells.front())),
                "give these cells DEFORMATION='PETIT' or 'PETIT_REAC' and RELATION='ELAS' or 'VMIS_...'");
  }
  if (input.model.formulations[static_cast<std::size_t>(cells.front())] == Formulation::bar_2d)
    return std::make_unique<InelasticBar<2>>(input, std::move(cells));
  return std::make_unique<InelasticBar<3>>(input, std::move(cells));
}

}  // namespace comma::solver
