#include "solver/elements/rotating_beam.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "solver/elements/beam_points.hpp"
#include "solver/elements/geometric_stiffness.hpp"
#include "solver/elements/slender.hpp"
#include "solver/error.hpp"

namespace comma::solver {

namespace {

constexpr int reported_count = 6 * beam_point_count;

constexpr int roll_variable = 1;
using Vector12d = Eigen::Matrix<double, 12, 1>;

/// The first direction along the chord, the second what is left of the old one across it, turned about the chord by
/// `rotation`.
Eigen::Matrix3d carried_axes(const Eigen::Matrix3d& before, const Eigen::Vector3d& along,
                             const Eigen::Vector3d& rotation) {
  const Eigen::Vector3d x = along.normalized(), old = before.row(1);
  const Eigen::Vector3d y = (old - old.dot(x) * x).normalized(), z = x.cross(y);
  const double twist = rotation.dot(x), c = std::cos(twist), s = std::sin(twist);
  Eigen::Matrix3d axes;
  axes.row(0) = x;
  axes.row(1) = c * y + s * z;
  axes.row(2) = c * z - s * y;
  return axes;
}

/// Where a step begins.
struct BeamPast {
  Eigen::Vector3d along = Eigen::Vector3d::Zero();  ///< from the first node to the second
  double roll = 0.0;                                ///< of the axes before rotations turn them about the chord
  Vector12d displacement = Vector12d::Zero();
  Vector12d force = Vector12d::Zero();  ///< on both ends, in own axes
  double elongation = 0.0;              ///< left by the turns of all steps
};

/// By how much axes are rolled against level_axes().
double roll_of(const Eigen::Matrix3d& axes) {
  const Eigen::Matrix3d level = level_axes(axes.row(0).transpose());
  return std::atan2(axes.row(1).dot(level.row(2)), axes.row(1).dot(level.row(1)));
}

Vector12d turned(const Eigen::Matrix3d& axes, const Vector12d& parts) {
  Vector12d result;
  for (int part = 0; part < 12; part += 3) result.template segment<3>(part) = axes * parts.template segment<3>(part);
  return result;
}

class RotatingBeam final : public ElementBlock {
 public:
  RotatingBeam(const BlockInput& input, std::vector<int> cells)
      : mesh_(*input.model.mesh),
        shear_(input.model.formulations[static_cast<std::size_t>(cells.front())] == Formulation::timoshenko_beam),
        cells_(std::move(cells)),
        map_(input.pattern, input.dofs, input.model.components_of(cells_.front()), 2, gather_nodes(mesh_, cells_)) {
    for (const int cell : cells_) {
      members_.push_back(member(input, cell));
      BeamPast past;
      past.along = initial_chord(cell);
      past.roll = members_.back().section->roll;
      past_.push_back(past);
    }
  }

  void add_stiffness(const Eigen::VectorXd& u, const VariableState& state, std::span<const int> column_starts,
                     double* values) const override {
    require_no_strains(state);
    for (int element = 0; element < map_.element_count(); ++element) {
      map_.add(element, tangent(element, u).data(), column_starts, values);
    }
  }

  void add_internal_forces(const Eigen::VectorXd& u, const VariableState& state, ForceSum forces) const override {
    require_no_strains(state);
    for (int element = 0; element < map_.element_count(); ++element) {
      const Trial now = trial(element, u);
      add(element, turned(now.axes.transpose(), now.force), forces);
    }
  }
  void add_forces_of_stresses(const Eigen::VectorXd& u, const VariableState&, std::span<const double> reported,
                              ForceSum forces) const override {
    for (int element = 0; element < map_.element_count(); ++element)
      add(element, turned(trial(element, u).axes.transpose(), end_forces(reported.data() + reported_count * element)),
          forces);
  }

  std::span<const int> cells() const override { return cells_; }
  int point_count() const override { return beam_point_count; }
  std::span<const std::string_view> stress_names() const override { return beam_force_names; }
  bool is_linear() const override { return false; }
  bool is_constant() const override { return true; }
  bool has_memory() const override { return true; }

  void stresses(const Eigen::VectorXd& u, const VariableState&, std::span<double> out) const override {
    for (int element = 0; element < map_.element_count(); ++element) {
      const Vector12d force = trial(element, u).force;
      std::array<double, 12> ends;
      for (int i = 0; i < 12; ++i) ends[static_cast<std::size_t>(i)] = i < 6 ? -force[i] : force[i];
      write_at_points(ends, out.subspan(static_cast<std::size_t>(reported_count * element), reported_count));
    }
  }

  int variable_count() const override { return rotating_beam_variables; }
  void variables(const Eigen::VectorXd& u, const VariableState&, std::span<double> out) const override {
    for (int element = 0; element < map_.element_count(); ++element) {
      const Trial now = trial(element, u);
      for (int point = 0; point < point_count(); ++point) {
        double* own = out.data() + (point_count() * element + point) * rotating_beam_variables;
        own[0] = 0.0;
        own[roll_variable] = roll_of(now.axes);
        own[2] = now.elongation;
      }
    }
  }

  void energies(const Eigen::VectorXd&, const VariableState&, std::span<double>) const override {
    throw_no_energies("beams in large rotations", mesh_.cell_name(cells_.front()));
  }
  void energy_densities(const Eigen::VectorXd&, const VariableState&, std::span<const double>, std::span<const double>,
                        std::span<double> out) const override {
    std::ranges::fill(out, absent);
  }

  void accept(const Eigen::VectorXd& u, const VariableState&) override {
    for (int element = 0; element < map_.element_count(); ++element) {
      const Trial now = trial(element, u);
      begin(element, u, roll_of(now.axes), now.force);
      past_[static_cast<std::size_t>(element)].elongation = now.elongation;
    }
  }

  /// Without variables the axes are those of the first geometry, carried along as if by one step.
  void resume(const Eigen::VectorXd& u, const VariableState&, std::span<const double> reported,
              std::span<const double> variables) override {
    for (int element = 0; element < map_.element_count(); ++element) {
      const double* own =
          variables.empty() ? nullptr : variables.data() + point_count() * rotating_beam_variables * element;
      const double roll = own == nullptr ? carried_roll(element, u) : own[roll_variable];
      begin(element, u, roll,
            reported.empty() ? Vector12d::Zero().eval() : end_forces(reported.data() + reported_count * element));
      past_[static_cast<std::size_t>(element)].elongation = own == nullptr ? 0.0 : own[2];
    }
  }

  void add_imposed_strain_forces(const ImposedStrains& imposed, const VariableState&, ForceSum) const override {
    for (const int cell : cells_)
      if (imposed.acts_on(cell))
        throw Error("unsupported", fmt::format("cell {}: initial strains are known of beams in small rotations only",
                                               mesh_.cell_name(cell)));
  }

 private:
  struct Member {
    const BeamSection* section;
    IsotropicModuli moduli;
  };
  struct Trial {
    Eigen::Matrix3d axes;
    double length;
    Vector12d force;  ///< on both ends, in own axes
    double elongation;
  };

  Member member(const BlockInput& input, int cell) const {
    const BeamSection& section = slender_section(input, cell);
    const IsotropicElasticity& elasticity = isotropic_material(input, cell);
    if (section.end || !elasticity.young.is_constant() || !elasticity.poisson.is_constant()) {
      throw Error("unsupported",
                  fmt::format("cell {}: beams in large rotations have a section and a material that do not vary",
                              mesh_.cell_name(cell)),
                  "give DEFORMATION='PETIT', or constant properties");
    }
    return {&section, moduli(elasticity, MaterialPoint())};
  }

  void require_no_strains(const VariableState& state) const {
    if (state.empty()) return;
    throw Error("unsupported",
                fmt::format("cell {}: beams in large rotations do not expand with command variables",
                            mesh_.cell_name(cells_.front())),
                "leave out AFFE_VARC, or give DEFORMATION='PETIT'");
  }

  Eigen::Vector3d initial_chord(int cell) const {
    const auto nodes = mesh_.cell(cell);
    return Eigen::Map<const Eigen::Vector3d>(mesh_.nodes[static_cast<std::size_t>(nodes[1])].data()) -
           Eigen::Map<const Eigen::Vector3d>(mesh_.nodes[static_cast<std::size_t>(nodes[0])].data());
  }

  /// The direction from which rolls count changes its place at the vertical: a beam near it keeps none by its number.
  double carried_roll(int element, const Eigen::VectorXd& u) const {
    BeamPast first;
    first.along = initial_chord(cells_[static_cast<std::size_t>(element)]);
    first.roll = members_[static_cast<std::size_t>(element)].section->roll;
    Vector12d step = unknowns(element, u);
    step.segment<3>(6) -= step.head<3>();
    return roll_of(
        carried_axes(level_axes(first.along, first.roll), first.along + step.segment<3>(6), mean_rotation(step)));
  }

  /// `roll`: of the axes as the forces have them.
  void begin(int element, const Eigen::VectorXd& u, double roll, const Vector12d& force) {
    BeamPast& past = past_[static_cast<std::size_t>(element)];
    past.displacement = unknowns(element, u);
    past.along = initial_chord(cells_[static_cast<std::size_t>(element)]) + past.displacement.segment<3>(6) -
                 past.displacement.head<3>();
    past.roll = roll - mean_rotation(past.displacement).dot(past.along.normalized());
    past.force = force;
  }

  Vector12d unknowns(int element, const Eigen::VectorXd& u) const {
    std::array<int, 12> dofs;
    map_.dofs(element, dofs.data());
    Vector12d own;
    for (int i = 0; i < 12; ++i) own[i] = u[dofs[static_cast<std::size_t>(i)]];
    return own;
  }

  /// Of the step, the first node standing still: a translation strains nothing.
  Vector12d increment(int element, const Eigen::VectorXd& u) const {
    Vector12d step = unknowns(element, u) - past_[static_cast<std::size_t>(element)].displacement;
    step.segment<3>(6) -= step.head<3>();
    step.head<3>().setZero();
    return step;
  }

  static Eigen::Vector3d mean_rotation(const Vector12d& displacement) {
    return 0.5 * (displacement.segment<3>(3) + displacement.segment<3>(9));
  }

  Trial trial(int element, const Eigen::VectorXd& u) const {
    const BeamPast& past = past_[static_cast<std::size_t>(element)];
    const Member& own = members_[static_cast<std::size_t>(element)];
    const Vector12d step = increment(element, u);
    const Eigen::Vector3d along = past.along + step.segment<3>(6);
    const double length = along.norm();
    const Eigen::Matrix3d axes =
        carried_axes(level_axes(past.along, past.roll), along, mean_rotation(past.displacement + step));
    const BeamMatrix stiffness = uniform_beam<double>(*own.section, own.moduli, length, shear_);
    return {axes, length, past.force + stiffness * turned(axes, step),
            past.elongation + 1.0 - axes.row(0).dot(past.along.normalized())};
  }

  /// The linear stiffness at the present length and what the present end forces add, in the present axes. Torsion
  /// counts for nothing, nor does how axes and length change under the increments of the step: symmetric, and
  /// iterations converge linearly.
  BeamMatrix tangent(int element, const Eigen::VectorXd& u) const {
    const Member& own = members_[static_cast<std::size_t>(element)];
    const Trial now = trial(element, u);
    BeamMatrix k = uniform_beam<double>(*own.section, own.moduli, now.length, shear_) +
                   beam_geometric_stiffness(*own.section, now.length,
                                            {section_forces(now.force, 0), section_forces(now.force, 6)});
    for (int i = 0; i < 12; i += 3)
      for (int j = 0; j < 12; j += 3)
        k.block<3, 3>(i, j) = (now.axes.transpose() * k.block<3, 3>(i, j) * now.axes).eval();
    return k;
  }

  /// At the end whose part of the end forces begins at `first`.
  static SectionForces section_forces(const Vector12d& ends, int first) {
    const Eigen::Matrix<double, 6, 1> f = (first == 0 ? -1.0 : 1.0) * ends.segment<6>(first);
    return {.n = f[0], .vy = f[1], .vz = f[2], .mfy = f[4], .mfz = f[5]};
  }

  /// From section forces at the points, those of the part beyond upon the part before.
  static Vector12d end_forces(const double* reported) {
    Vector12d force;
    force.head<6>() = -Eigen::Map<const Eigen::Matrix<double, 6, 1>>(reported);
    force.tail<6>() = Eigen::Map<const Eigen::Matrix<double, 6, 1>>(reported + 6 * (beam_point_count - 1));
    return force;
  }

  void add(int element, const Vector12d& force, ForceSum forces) const {
    std::array<int, 12> dofs;
    map_.dofs(element, dofs.data());
    for (int i = 0; i < 12; ++i) forces[static_cast<std::size_t>(dofs[static_cast<std::size_t>(i)])] += force[i];
  }

  const Mesh& mesh_;
  bool shear_;
  std::vector<int> cells_;
  ElementMap map_;
  std::vector<Member> members_;
  std::vector<BeamPast> past_;
};

}  // namespace

std::unique_ptr<ElementBlock> make_rotating_beam_block(const BlockInput& input, std::vector<int> cells) {
  return std::make_unique<RotatingBeam>(input, std::move(cells));
}

Eigen::Matrix3d rotated_axes(const Eigen::Vector3d& chord, std::span<const double> variables) {
  return level_axes(chord, variables[roll_variable]);
}

}  // namespace comma::solver
