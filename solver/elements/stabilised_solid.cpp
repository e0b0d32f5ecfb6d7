// Hexahedra on eight nodes with one point of integration and a stabilisation (3D_SI; hourglass.hpp). Their stresses are
// those of the point and twelve forces on the hourglass patterns, S1X .. S4Z, which are part of what the next step
// begins from.
#include <algorithm>
#include <cmath>

#include "solver/elements/hourglass.hpp"
#include "solver/elements/inelastic_block.hpp"
#include "solver/model/stress_names.hpp"

namespace comma::solver {

namespace {

constexpr int stress_count = solid_stress_names.size();
constexpr int pattern_count = hourglass_force_names.size();
constexpr int shown_count = stress_count + pattern_count;
constexpr auto shown_names = [] {
  std::array<std::string_view, shown_count> names;
  std::ranges::copy(hourglass_force_names, std::ranges::copy(solid_stress_names, names.begin()).out);
  return names;
}();
using PatternForces = Eigen::Matrix<double, pattern_count, 1>;

PatternForces in_a_column(const Hourglass::Patterns& patterns) {
  PatternForces column;
  for (int pattern = 0; pattern < 4; ++pattern) column.segment<3>(3 * pattern) = patterns.row(pattern).transpose();
  return column;
}

Hourglass::Patterns in_rows(const PatternForces& column) {
  Hourglass::Patterns patterns;
  for (int pattern = 0; pattern < 4; ++pattern) patterns.row(pattern) = column.segment<3>(3 * pattern).transpose();
  return patterns;
}

/// The stresses alone out of what is shown.
std::vector<double> of_points(std::span<const double> shown) {
  std::vector<double> stresses;
  for (std::size_t cell = 0; cell * shown_count < shown.size(); ++cell)
    stresses.insert(stresses.end(), shown.begin() + static_cast<std::ptrdiff_t>(cell * shown_count),
                    shown.begin() + static_cast<std::ptrdiff_t>(cell * shown_count + stress_count));
  return stresses;
}

/// A block with one point, and the patterns besides. `Base` gives `pattern_forces` and the tangent of the patterns.
template <class Base>
class Stabilised : public Base {
 public:
  using Base::Base;

  std::span<const std::string_view> stress_names() const override { return shown_names; }

  void add_stiffness(const Eigen::VectorXd& u, const VariableState& state, std::span<const int> column_starts,
                     double* values) const override {
    Base::add_stiffness(u, state, column_starts, values);
    add_pattern_stiffness(u, state, column_starts, values);
  }
  void add_internal_forces(const Eigen::VectorXd& u, const VariableState& state, ForceSum forces) const override {
    Base::add_internal_forces(u, state, forces);
    add_pattern_forces(u, state, forces);
  }
  void add_forces_of_stresses(const Eigen::VectorXd& u, const VariableState& state, std::span<const double> shown,
                              ForceSum forces) const override {
    if (shown.empty()) return add_internal_forces(u, state, forces);
    Base::add_forces_of_stresses(u, state, of_points(shown), forces);
    for (int element = 0; element < this->map_.element_count(); ++element)
      spread(element, shown_patterns(shown, element), forces);
  }
  void stresses(const Eigen::VectorXd& u, const VariableState& state, std::span<double> out) const override {
    std::vector<double> points(out.size() / shown_count * stress_count);
    Base::stresses(u, state, points);
    for (int element = 0; element < this->map_.element_count(); ++element) {
      double* target =
          std::copy_n(points.data() + element * stress_count, stress_count, out.data() + element * shown_count);
      const PatternForces patterns = pattern_forces(element, u, state);
      std::copy(patterns.begin(), patterns.end(), target);
    }
  }
  void subtract_imposed_stresses(const ImposedStrains& imposed, const VariableState& state,
                                 std::span<double> out) const override {
    std::vector<double> points = of_points(out);
    Base::subtract_imposed_stresses(imposed, state, points);
    for (int element = 0; element < this->map_.element_count(); ++element)
      std::copy_n(points.data() + element * stress_count, stress_count, out.data() + element * shown_count);
  }
  void add_initial_stress_forces(std::span<const double> shown, ForceSum forces) const override {
    Base::add_initial_stress_forces(of_points(shown), forces);
  }
  void energies(const Eigen::VectorXd& u, const VariableState& state, std::span<double> out) const override {
    Base::energies(u, state, out);
    for (int element = 0; element < this->map_.element_count(); ++element)
      out[static_cast<std::size_t>(element)] +=
          0.5 *
          pattern_forces(element, u, state).dot(in_a_column(hourglass(element).amplitudes(displacements(element, u))));
  }
  void energy_densities(const Eigen::VectorXd& u, const VariableState& state, std::span<const double> shown,
                        std::span<const double> variables, std::span<double> out) const override {
    Base::energy_densities(u, state, of_points(shown), variables, out);
  }

 protected:
  virtual PatternForces pattern_forces(int element, const Eigen::VectorXd& u, const VariableState& state) const = 0;
  virtual Hourglass::Stiffness pattern_stiffness(int element, const Eigen::VectorXd& u,
                                                 const VariableState& state) const = 0;

  Hourglass hourglass(int element) const { return Hourglass(this->coordinates(element)); }
  Hourglass::Places displacements(int element, const Eigen::VectorXd& u) const {
    return Base::relative_displacements(u, this->dofs_of(element)).relative;
  }
  static PatternForces shown_patterns(std::span<const double> shown, int element) {
    return Eigen::Map<const PatternForces>(shown.data() + element * shown_count + stress_count);
  }

  void add_pattern_stiffness(const Eigen::VectorXd& u, const VariableState& state, std::span<const int> column_starts,
                             double* values) const {
    for (int element = 0; element < this->map_.element_count(); ++element) {
      Eigen::Matrix<double, 24, 24> k = hourglass(element).nodal_stiffness(pattern_stiffness(element, u, state));
      k = (0.5 * (k + k.transpose())).eval();
      make_translation_exact<8, 3>(k, Base::invariant_directions());
      this->map_.add(element, k.data(), column_starts, values);
    }
  }
  void add_pattern_forces(const Eigen::VectorXd& u, const VariableState& state, ForceSum forces) const {
    for (int element = 0; element < this->map_.element_count(); ++element)
      spread(element, pattern_forces(element, u, state), forces);
  }

 private:
  void spread(int element, const PatternForces& patterns, ForceSum forces) const {
    Base::scatter_forces(hourglass(element).nodal_forces(in_rows(patterns)), this->dofs_of(element), forces);
  }
};

/// Linear elasticity: the patterns bend as an elastic body does.
class StabilisedElastic final : public Stabilised<ContinuumBlock<3, 8, false>> {
  using Base = Stabilised<ContinuumBlock<3, 8, false>>;

 public:
  StabilisedElastic(const BlockInput& input, std::vector<int> cells) : Base(input, std::move(cells)) {
    for (const int cell : cells_) isotropic_material(input, cell);
  }

 private:
  Hourglass::Stiffness pattern_stiffness(int element, const Eigen::VectorXd&,
                                         const VariableState& state) const override {
    const Behaviour behaviour(*this, element, 0, coordinates(element), state);
    return hourglass(element).stiffness(*behaviour.law, Hourglass::Projection::bending);
  }
  PatternForces pattern_forces(int element, const Eigen::VectorXd& u, const VariableState& state) const override {
    return pattern_stiffness(element, u, state) * in_a_column(hourglass(element).amplitudes(displacements(element, u)));
  }
};

/// Laws with a memory in small strains: in each step the patterns change by the tangent of the law at the point
/// (ssnv196a), without change of volume where the body may flow.
class StabilisedInelastic final : public Stabilised<InelasticBlock<3, 8, false>> {
  using Base = Stabilised<InelasticBlock<3, 8, false>>;

 public:
  StabilisedInelastic(const BlockInput& input, std::vector<int> cells)
      : Base(input, std::move(cells)),
        projection_(input.behaviour_of(cells_.front()).relation == Relation::elastic
                        ? Hourglass::Projection::bending
                        : Hourglass::Projection::deviatoric),
        started_(cells_.size()) {}

  void add_elastic_stiffness(const Eigen::VectorXd& u, const VariableState& state, std::span<const int> column_starts,
                             double* values) const override {
    InelasticBlock::add_elastic_stiffness(u, state, column_starts, values);
    add_pattern_stiffness(u, state, column_starts, values);
  }
  void add_starting_stiffness(const Eigen::VectorXd& u, const VariableState& state, std::span<const int> column_starts,
                              double* values) const override {
    InelasticBlock::add_starting_stiffness(u, state, column_starts, values);
    add_pattern_stiffness(u, state, column_starts, values);
  }
  void add_starting_forces(const Eigen::VectorXd& u, const VariableState& state, ForceSum forces) const override {
    InelasticBlock::add_starting_forces(u, state, forces);
    add_pattern_forces(u, state, forces);
  }
  bool is_elastically_linear() const override { return false; }
  void accept(const Eigen::VectorXd& u, const VariableState& state) override {
    for (int element = 0; element < map_.element_count(); ++element)
      start(element, u, pattern_forces(element, u, state));
    Base::accept(u, state);
  }
  void resume(const Eigen::VectorXd& u, const VariableState& state, std::span<const double> shown,
              std::span<const double> variables) override {
    Base::resume(u, state, of_points(shown), variables);
    for (int element = 0; element < map_.element_count(); ++element)
      start(element, u, shown.empty() ? PatternForces(PatternForces::Zero()) : shown_patterns(shown, element));
  }

 private:
  /// Where the step began.
  struct Start {
    PatternForces forces = PatternForces::Zero();
    PatternForces amplitudes = PatternForces::Zero();
  };

  void start(int element, const Eigen::VectorXd& u, const PatternForces& forces) {
    started_[static_cast<std::size_t>(element)] = {
        forces, in_a_column(hourglass(element).amplitudes(displacements(element, u)))};
  }
  Hourglass::Stiffness pattern_stiffness(int element, const Eigen::VectorXd& u,
                                         const VariableState& state) const override {
    const Coordinates x = coordinates(element);
    const auto moved = relative_displacements(u, dofs_of(element));
    const Eigen::Matrix3d gradient = gradient_of_displacement(moved, samples_[0], locate(x, samples_[0]));
    const Matrix6d tangent = respond(element, 0, x, gradient, state, &PointLaw::respond).tangent;
    return hourglass(element).stiffness(tangent, projection_);
  }
  PatternForces pattern_forces(int element, const Eigen::VectorXd& u, const VariableState& state) const override {
    const Start& before = started_[static_cast<std::size_t>(element)];
    const PatternForces change =
        in_a_column(hourglass(element).amplitudes(displacements(element, u))) - before.amplitudes;
    return before.forces + pattern_stiffness(element, u, state) * change;
  }

  Hourglass::Projection projection_;
  std::vector<Start> started_;
};

}  // namespace

std::unique_ptr<ElementBlock> make_stabilised_block(const BlockInput& input, std::vector<int> cells) {
  const int cell = cells.front();
  if (input.behaviour_of(cell).kinematics != Kinematics::small)
    throw Error("unsupported",
                fmt::format("cell {}: hexahedra with one point (3D_SI) are known in small strains alone",
                            input.model.mesh->cell_name(cell)),
                "take MODELISATION='3D', or quadratic cells");
  if (keeps_memory(input, cells)) return std::make_unique<StabilisedInelastic>(input, std::move(cells));
  return std::make_unique<StabilisedElastic>(input, std::move(cells));
}

}  // namespace comma::solver
