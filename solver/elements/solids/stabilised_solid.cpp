// Hexahedra on eight nodes with one point of integration and a stabilisation (3D_SI; hourglass.hpp). Their stresses are
// those of the point and what varies beside it over the cell, FSTAB1 .. FSTAB72, which is part of what the next step
// begins from.
#include <algorithm>
#include <cmath>

#include "solver/elements/solids/hourglass.hpp"
#include "solver/elements/solids/inelastic_block.hpp"
#include "solver/model/stress_names.hpp"

namespace comma::solver {

namespace {

constexpr int stress_count = solid_stress_names.size();
constexpr int pattern_count = hourglass_stress_names.size();
constexpr int shown_count = stress_count + pattern_count;
constexpr auto shown_names = [] {
  std::array<std::string_view, shown_count> names;
  std::ranges::copy(hourglass_stress_names, std::ranges::copy(solid_stress_names, names.begin()).out);
  return names;
}();
using Stresses = Hourglass::Stresses;
using RowwiseStresses = Eigen::Matrix<double, 6, 12, Eigen::RowMajor>;  ///< as results show them
static_assert(pattern_count == RowwiseStresses::SizeAtCompileTime);

/// The stresses alone out of what is shown.
std::vector<double> of_points(std::span<const double> shown) {
  std::vector<double> stresses;
  for (std::size_t cell = 0; cell * shown_count < shown.size(); ++cell)
    stresses.insert(stresses.end(), shown.begin() + static_cast<std::ptrdiff_t>(cell * shown_count),
                    shown.begin() + static_cast<std::ptrdiff_t>(cell * shown_count + stress_count));
  return stresses;
}

/// A block with one point, and the patterns besides. `Base` gives the stresses and the tangent of the patterns.
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
      spread(element, hourglass(element, u, state).forces(shown_patterns(shown, element), shown_middle(shown, element)),
             forces);
  }
  void stresses(const Eigen::VectorXd& u, const VariableState& state, std::span<double> out) const override {
    std::vector<double> points(out.size() / shown_count * stress_count);
    Base::stresses(u, state, points);
    for (int element = 0; element < this->map_.element_count(); ++element) {
      double* target =
          std::copy_n(points.data() + element * stress_count, stress_count, out.data() + element * shown_count);
      Eigen::Map<RowwiseStresses> varying(target);
      varying = pattern_stresses(element, u, state);
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
          0.5 * additional_forces(element, u, state).cwiseProduct(displacements(element, u)).sum();
  }
  void energy_densities(const Eigen::VectorXd& u, const VariableState& state, std::span<const double> shown,
                        std::span<const double> variables, std::span<double> out) const override {
    Base::energy_densities(u, state, of_points(shown), variables, out);
  }

 protected:
  virtual Hourglass hourglass(int element, const Eigen::VectorXd& u, const VariableState& state) const = 0;
  virtual Stresses pattern_stresses(int element, const Eigen::VectorXd& u, const VariableState& state) const = 0;
  /// The forces on the nodes beside those of the point, and their derivative.
  virtual Hourglass::Places additional_forces(int element, const Eigen::VectorXd& u,
                                              const VariableState& state) const = 0;
  virtual Hourglass::Stiffness additional_stiffness(int element, const Eigen::VectorXd& u,
                                                    const VariableState& state) const = 0;

  Hourglass::Places displacements(int element, const Eigen::VectorXd& u) const {
    return Base::relative_displacements(u, this->dofs_of(element)).relative;
  }
  static Stresses shown_patterns(std::span<const double> shown, int element) {
    return Eigen::Map<const RowwiseStresses>(shown.data() + element * shown_count + stress_count);
  }
  static Vector6d shown_middle(std::span<const double> shown, int element) {
    return Eigen::Map<const Vector6d>(shown.data() + element * shown_count);
  }

  void add_pattern_stiffness(const Eigen::VectorXd& u, const VariableState& state, std::span<const int> column_starts,
                             double* values) const {
    for (int element = 0; element < this->map_.element_count(); ++element) {
      Hourglass::Stiffness k = additional_stiffness(element, u, state);
      k = (0.5 * (k + k.transpose())).eval();
      make_translation_exact<8, 3>(k, Base::invariant_directions());
      this->map_.add(element, k.data(), column_starts, values);
    }
  }
  void add_pattern_forces(const Eigen::VectorXd& u, const VariableState& state, ForceSum forces) const {
    for (int element = 0; element < this->map_.element_count(); ++element)
      spread(element, additional_forces(element, u, state), forces);
  }

 private:
  void spread(int element, const Hourglass::Places& at_nodes, ForceSum forces) const {
    Base::scatter_forces(at_nodes, this->dofs_of(element), forces);
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
  Matrix6d law_of(int element, const VariableState& state) const {
    return *Behaviour(*this, element, 0, coordinates(element), state).law;
  }
  Hourglass hourglass(int element, const Matrix6d& law) const {
    return {coordinates(element), Hourglass::Projection::bending, poisson_of(law)};
  }
  Hourglass hourglass(int element, const Eigen::VectorXd&, const VariableState& state) const override {
    return hourglass(element, law_of(element, state));
  }
  Hourglass::Stiffness additional_stiffness(int element, const Eigen::VectorXd&,
                                            const VariableState& state) const override {
    const Matrix6d law = law_of(element, state);
    return hourglass(element, law).stiffness(law);
  }
  Stresses pattern_stresses(int element, const Eigen::VectorXd& u, const VariableState& state) const override {
    const Matrix6d law = law_of(element, state);
    const Hourglass cell = hourglass(element, law);
    return cell.stresses(law, cell.amplitudes(displacements(element, u)));
  }
  Hourglass::Places additional_forces(int element, const Eigen::VectorXd& u,
                                      const VariableState& state) const override {
    const Eigen::Matrix<double, 24, 1> moved = displacements(element, u).reshaped<Eigen::RowMajor>();
    const Eigen::Matrix<double, 24, 1> forces = additional_stiffness(element, u, state) * moved;
    return forces.reshaped<Eigen::RowMajor>(8, 3);
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
      start(element, u, state, pattern_stresses(element, u, state));
    Base::accept(u, state);
  }
  void resume(const Eigen::VectorXd& u, const VariableState& state, std::span<const double> shown,
              std::span<const double> variables) override {
    Base::resume(u, state, of_points(shown), variables);
    for (int element = 0; element < map_.element_count(); ++element)
      start(element, u, state, shown.empty() ? Stresses(Stresses::Zero()) : shown_patterns(shown, element));
  }

 private:
  /// Where the step began.
  struct Start {
    Stresses stresses = Stresses::Zero();
    Hourglass::Patterns amplitudes = Hourglass::Patterns::Zero();
  };

  void start(int element, const Eigen::VectorXd& u, const VariableState& state, const Stresses& stresses) {
    started_[static_cast<std::size_t>(element)] = {stresses,
                                                   hourglass(element, u, state).amplitudes(displacements(element, u))};
  }
  PointResponse at_the_point(int element, const Eigen::VectorXd& u, const VariableState& state) const {
    const Coordinates x = coordinates(element);
    const auto moved = relative_displacements(u, dofs_of(element));
    const Eigen::Matrix3d gradient = gradient_of_displacement(moved, samples_[0], locate(x, samples_[0]));
    return respond(element, 0, x, gradient, state, &PointLaw::respond);
  }
  Hourglass hourglass(int element, const Matrix6d& tangent) const {
    const bool bends = projection_ == Hourglass::Projection::bending;
    return {coordinates(element), projection_, bends ? poisson_of(tangent) : 0.0};
  }
  Hourglass hourglass(int element, const Eigen::VectorXd& u, const VariableState& state) const override {
    return hourglass(element, at_the_point(element, u, state).tangent);
  }
  Hourglass::Stiffness additional_stiffness(int element, const Eigen::VectorXd& u,
                                            const VariableState& state) const override {
    const Matrix6d tangent = at_the_point(element, u, state).tangent;
    return hourglass(element, tangent).stiffness(tangent);
  }
  Stresses pattern_stresses(int element, const Eigen::VectorXd& u, const Hourglass& cell,
                            const Matrix6d& tangent) const {
    const Start& before = started_[static_cast<std::size_t>(element)];
    return before.stresses + cell.stresses(tangent, cell.amplitudes(displacements(element, u)) - before.amplitudes);
  }
  Stresses pattern_stresses(int element, const Eigen::VectorXd& u, const VariableState& state) const override {
    const Matrix6d tangent = at_the_point(element, u, state).tangent;
    return pattern_stresses(element, u, hourglass(element, tangent), tangent);
  }
  Hourglass::Places additional_forces(int element, const Eigen::VectorXd& u,
                                      const VariableState& state) const override {
    const PointResponse response = at_the_point(element, u, state);
    const Hourglass cell = hourglass(element, response.tangent);
    return cell.forces(pattern_stresses(element, u, cell, response.tangent), response.stress);
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
