#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "solver/elements/discrete/discrete_elements.hpp"
#include "solver/error.hpp"

namespace comma::solver {

namespace {

constexpr int most_components = component_count;
constexpr int axis_count = 6;
constexpr int variables_of_axis = 3;  ///< of a spring that flows
using Components = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, most_components, 1>;
using ComponentMatrix =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, most_components, most_components>;
using EndMatrix =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 2 * most_components, 2 * most_components>;

class DiscreteLaw final : public DiscreteElements {
 public:
  DiscreteLaw(const BlockInput& input, std::vector<int> cells)
      : DiscreteElements(input, std::move(cells)), relation_(input.behaviour_of(cells_.front()).relation) {
    for (const int cell : cells_) members_.push_back(member(input, cell));
  }

  void add_stiffness(const Eigen::VectorXd& u, const VariableState& state, std::span<const int> column_starts,
                     double* values) const override {
    for (int element = 0; element < map_.element_count(); ++element)
      add(element, answer(element, u, state).tangent, column_starts, values);
  }
  void add_elastic_stiffness(const Eigen::VectorXd&, const VariableState& state, std::span<const int> column_starts,
                             double* values) const override {
    for (int element = 0; element < map_.element_count(); ++element)
      add(element, elastic(element, state), column_starts, values);
  }
  void add_internal_forces(const Eigen::VectorXd& u, const VariableState& state, ForceSum forces) const override {
    for (int element = 0; element < map_.element_count(); ++element)
      add(element, answer(element, u, state).force, forces);
  }
  void add_forces_of_stresses(const Eigen::VectorXd&, const VariableState&, std::span<const double> reported,
                              ForceSum forces) const override {
    const int k = map_.components();
    for (int element = 0; element < map_.element_count(); ++element)
      add(element, Eigen::Map<const Components>(reported.data() + begin_of(element, k), k), forces);
  }

  void stresses(const Eigen::VectorXd& u, const VariableState& state, std::span<double> out) const override {
    const int k = map_.components();
    for (int element = 0; element < map_.element_count(); ++element) {
      double* own = out.data() + begin_of(element, k);
      Eigen::Map<Components>(own, k) = answer(element, u, state).force;
      repeat_at_second_end(own, k);
    }
  }

  bool is_linear() const override { return false; }
  bool is_elastically_linear() const override { return is_constant(); }
  bool is_constant() const override {
    return std::ranges::all_of(members_, [&](const Member& each) {
      return std::ranges::all_of(each.laws->bilinear, [](const auto& law) {
        return !law || (law->first.is_constant() && law->last.is_constant());
      });
    });
  }
  bool has_memory() const override { return true; }

  /// Of all six axes, whether the element has them or not, as Code_Aster numbers them: the stage of each, or what it
  /// remembers.
  int variable_count() const override { return is_bilinear() ? axis_count : axis_count * variables_of_axis; }
  void variables(const Eigen::VectorXd& u, const VariableState& state, std::span<double> out) const override {
    const int count = variable_count();
    std::ranges::fill(out, 0.0);
    for (int element = 0; element < map_.element_count(); ++element) {
      const Answer reached = answer(element, u, state);
      double* own = out.data() + begin_of(element, count);
      for (int c = 0; c < map_.components(); ++c) {
        if (is_bilinear()) {
          own[axis(c)] = stage(element, c, reached);
          continue;
        }
        const SpringPast& now = reached.past[static_cast<std::size_t>(c)];
        own[variables_of_axis * axis(c)] = now.plastic;
        own[variables_of_axis * axis(c) + 1] = now.flowed;
        own[variables_of_axis * axis(c) + 2] = now.spent;
      }
      repeat_at_second_end(own, count);
    }
  }

  void energies(const Eigen::VectorXd&, const VariableState&, std::span<double>) const override {
    throw_no_energies("discrete elements with a law", mesh_.cell_name(cells_.front()));
  }
  void energy_densities(const Eigen::VectorXd&, const VariableState&, std::span<const double>, std::span<const double>,
                        std::span<double> out) const override {
    std::ranges::fill(out, absent);
  }

  void accept(const Eigen::VectorXd& u, const VariableState& state) override {
    for (int element = 0; element < map_.element_count(); ++element)
      members_[static_cast<std::size_t>(element)].past = answer(element, u, state).past;
  }

  /// Without variables the force tells what is plastic, and how far the centre has moved if it flowed just now.
  void resume(const Eigen::VectorXd& u, const VariableState&, std::span<const double> reported,
              std::span<const double> variables) override {
    if (is_bilinear()) return;
    const int k = map_.components();
    for (int element = 0; element < map_.element_count(); ++element) {
      Member& own = members_[static_cast<std::size_t>(element)];
      if (!variables.empty()) {
        const double* from = variables.data() + begin_of(element, variable_count());
        for (int c = 0; c < k; ++c) {
          const double* of_axis = from + variables_of_axis * axis(c);
          own.past[static_cast<std::size_t>(c)] = {of_axis[0], of_axis[1], of_axis[2]};
        }
      } else if (!reported.empty()) {
        const Components moved = displacement(element, u);
        for (int c = 0; c < k; ++c) {
          const HardeningSpring* law = hardening(element, c);
          if (law == nullptr) continue;
          const double force = reported[begin_of(element, k) + static_cast<std::size_t>(c)];
          const double beyond = std::max(0.0, std::abs(force) - law->yield);
          own.past[static_cast<std::size_t>(c)] = {moved[c] - force / own.stiffness[c],
                                                   flowed_for_centre(*law, std::copysign(beyond, force)), 0.0};
        }
      }
    }
  }

 private:
  struct Member {
    const SpringLaws* laws;
    ComponentMatrix turn;                       ///< from the components in global axes to those in own ones
    Components stiffness;                       ///< of each component, in own axes
    std::array<SpringPast, axis_count> past{};  ///< where the step began
  };
  struct Answer {
    Components force, tangent;
    std::array<SpringPast, axis_count> past;
  };

  bool is_bilinear() const { return relation_ == Relation::bilinear_spring; }
  const Member& at(int element) const { return members_[static_cast<std::size_t>(element)]; }

  /// DX, DY, DZ, DRX, DRY, DRZ as 0 to 5; the rotation of the plane is about Z.
  int axis(int component) const { return component < translations_ ? component : translations_ == 2 ? 5 : component; }
  const BilinearSpring* bilinear(int element, int component) const {
    if (!is_bilinear() || component >= translations_) return nullptr;
    const auto& law = at(element).laws->bilinear[static_cast<std::size_t>(component)];
    return law ? &*law : nullptr;
  }
  const HardeningSpring* hardening(int element, int component) const {
    if (is_bilinear()) return nullptr;
    const auto& law = at(element).laws->hardening[static_cast<std::size_t>(axis(component))];
    return law ? &*law : nullptr;
  }

  Member member(const BlockInput& input, int cell) const {
    const DiscreteStiffness& stiffness = discrete_stiffness(input, cell);
    const Material* material =
        input.materials.by_cell.empty() ? nullptr : input.materials.by_cell[static_cast<std::size_t>(cell)].get();
    if (material == nullptr || (is_bilinear() ? !material->knows_bilinear_springs : !material->knows_hardening_springs))
      throw Error(
          "missing-material",
          fmt::format("the discrete element on cell {} has a law that its material lacks", mesh_.cell_name(cell)),
          fmt::format("give it {} in DEFI_MATERIAU", is_bilinear() ? "DIS_BILI_ELAS" : "DIS_ECRO_CINE"));
    const int k = map_.components();
    Member made{&material->springs, turn_of(stiffness.axes), Components::Zero(k), {}};
    const ComponentMatrix own = made.turn * stiffness.matrix.topLeftCorner(k, k) * made.turn.transpose();
    made.stiffness = own.diagonal();
    if (!is_diagonal(stiffness.matrix, made))
      throw Error(
          "unsupported",
          fmt::format("the discrete element on cell {} has a law for each component, and a stiffness that couples them",
                      mesh_.cell_name(cell)),
          "give it a diagonal stiffness in its own axes (REPERE='LOCAL')");
    for (int c = 0; c < k; ++c)
      if (!is_bilinear() && material->springs.hardening[static_cast<std::size_t>(axis(c))] &&
          !(made.stiffness[c] > 0.0))
        throw Error("invalid-material",
                    fmt::format("the discrete element on cell {} hardens in a component without elastic stiffness",
                                mesh_.cell_name(cell)),
                    "give it one in AFFE_CARA_ELEM");
    return made;
  }

  ComponentMatrix turn_of(const Eigen::Matrix3d& axes) const {
    const int k = map_.components();
    ComponentMatrix turn = ComponentMatrix::Identity(k, k);
    turn.topLeftCorner(translations_, translations_) = axes.topLeftCorner(translations_, translations_);
    if (k == 6) turn.bottomRightCorner<3, 3>() = axes;
    return turn;
  }

  bool is_diagonal(const Eigen::MatrixXd& matrix, const Member& made) const {
    return is_rounding(matrix - ends(made.turn.transpose() * made.stiffness.asDiagonal() * made.turn), matrix);
  }

  /// [K], or [K -K; -K K] of two nodes.
  EndMatrix ends(const ComponentMatrix& global) const {
    const auto k = global.rows();
    EndMatrix matrix(node_count_ * k, node_count_ * k);
    for (int i = 0; i < node_count_; ++i)
      for (int j = 0; j < node_count_; ++j) matrix.block(i * k, j * k, k, k) = (i == j ? 1.0 : -1.0) * global;
    return matrix;
  }

  /// Of the last node against the first, or against the ground, in own axes.
  Components displacement(int element, const Eigen::VectorXd& u) const {
    std::array<int, 2 * most_components> dofs;
    map_.dofs(element, dofs.data());
    const int k = map_.components();
    Components moved(k);
    for (int c = 0; c < k; ++c) {
      moved[c] = u[dofs[static_cast<std::size_t>((node_count_ - 1) * k + c)]];
      if (node_count_ == 2) moved[c] -= u[dofs[static_cast<std::size_t>(c)]];
    }
    return at(element).turn * moved;
  }

  MaterialPoint middle(int element, const VariableState& state) const {
    const auto nodes = mesh_.cell(cells_[static_cast<std::size_t>(element)]);
    const std::vector<double> shares(nodes.size(), 1.0 / static_cast<double>(nodes.size()));
    MaterialPoint at;
    state.sample(cells_[static_cast<std::size_t>(element)], nodes, shares, VariableState::all_points, at);
    return at;
  }

  Answer answer(int element, const Eigen::VectorXd& u, const VariableState& state) const {
    const Member& own = at(element);
    const Components moved = displacement(element, u);
    Answer result{own.stiffness.cwiseProduct(moved), own.stiffness, own.past};
    for (int c = 0; c < map_.components(); ++c) {
      SpringResponse response{result.force[c], result.tangent[c]};
      if (const BilinearSpring* law = bilinear(element, c)) {
        const MaterialPoint at = middle(element, state);
        response = bilinear_response(law->first(at), law->last(at), law->bound, moved[c]);
      } else if (const HardeningSpring* flow = hardening(element, c)) {
        response = hardening_response(*flow, own.stiffness[c], moved[c], own.past[static_cast<std::size_t>(c)]);
        result.past[static_cast<std::size_t>(c)] = response.reached;
      }
      result.force[c] = response.force;
      result.tangent[c] = response.tangent;
    }
    return result;
  }

  Components elastic(int element, const VariableState& state) const {
    Components stiffness = at(element).stiffness;
    for (int c = 0; c < translations_; ++c)
      if (const BilinearSpring* law = bilinear(element, c)) stiffness[c] = law->first(middle(element, state));
    return stiffness;
  }

  /// Of a bilinear component: 0 where no force acts, 1 on the first slope, 2 on the second.
  double stage(int element, int component, const Answer& reached) const {
    const BilinearSpring* law = bilinear(element, component);
    if (law == nullptr || reached.force[component] == 0.0) return 0.0;
    return std::abs(reached.force[component]) <= law->bound ? 1.0 : 2.0;
  }

  void add(int element, const Components& own, std::span<const int> column_starts, double* values) const {
    const ComponentMatrix global = at(element).turn.transpose() * own.asDiagonal() * at(element).turn;
    const EndMatrix matrix = ends(0.5 * (global + global.transpose()));
    map_.add(element, matrix.data(), column_starts, values);
  }

  void add(int element, const Components& own, ForceSum forces) const {
    std::array<int, 2 * most_components> dofs;
    map_.dofs(element, dofs.data());
    const int k = map_.components();
    const Components global = at(element).turn.transpose() * own;
    for (int c = 0; c < k; ++c) {
      forces[static_cast<std::size_t>(dofs[static_cast<std::size_t>((node_count_ - 1) * k + c)])] += global[c];
      if (node_count_ == 2) forces[static_cast<std::size_t>(dofs[static_cast<std::size_t>(c)])] -= global[c];
    }
  }

  Relation relation_;
  std::vector<Member> members_;
};

}  // namespace

std::unique_ptr<ElementBlock> make_discrete_law_block(const BlockInput& input, std::vector<int> cells) {
  require_small_displacements(input, cells.front(), "laws of discrete elements know");
  return std::make_unique<DiscreteLaw>(input, std::move(cells));
}

}  // namespace comma::solver
