#include "solver/elements/slender/rotating_beam.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <unsupported/Eigen/AutoDiff>

#include "solver/elements/geometric_stiffness.hpp"
#include "solver/elements/naming_cell.hpp"
#include "solver/elements/slender/beam_points.hpp"
#include "solver/elements/slender/beam_stiffness.hpp"
#include "solver/elements/slender/slender_member.hpp"
#include "solver/error.hpp"
#include "solver/model/stress_names.hpp"

namespace comma::solver {

namespace {

constexpr int reported_count = 6 * beam_point_count;

constexpr int roll_variable = 1;
using Vector12d = Eigen::Matrix<double, 12, 1>;
/// What the axes follow: the displacement of the second node relative to the first in the step, and the mean of the
/// whole rotations of both.
using Motion = Eigen::Matrix<double, 6, 1>;
using Derivative = Eigen::AutoDiffScalar<Motion>;

template <class Scalar>
using Vector3 = Eigen::Matrix<Scalar, 3, 1>;
template <class Scalar>
using Axes = Eigen::Matrix<Scalar, 3, 3>;

/// The first direction along the chord, the second what is left of the old one across it, turned about the chord by
/// `rotation`.
template <class Scalar>
Axes<Scalar> carried_axes(const Eigen::Matrix3d& before, const Vector3<Scalar>& along, const Scalar& length,
                          const Vector3<Scalar>& rotation) {
  using std::cos, std::sin, std::sqrt;
  const Vector3<Scalar> x = along / length;
  const Vector3<Scalar> old = before.row(1).transpose().template cast<Scalar>();
  const Vector3<Scalar> across = old - old.dot(x) * x;
  const Vector3<Scalar> y = across / sqrt(across.dot(across)), z = x.cross(y);
  const Scalar twist = rotation.dot(x);
  const Scalar c = cos(twist), s = sin(twist);
  Axes<Scalar> axes;
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
  IsotropicModuli moduli{1.0, 0.0};     ///< set when there are forces, and ...
  double expansion = 0.0;               ///< ... the axial strain of the command variables
};

template <class Scalar>
struct BeamGeometry {
  Axes<Scalar> axes;
  Scalar length;
};

template <class Scalar>
BeamGeometry<Scalar> geometry(const BeamPast& past, const Eigen::Matrix<Scalar, 6, 1>& motion) {
  using std::sqrt;
  const Vector3<Scalar> along = past.along.template cast<Scalar>() + motion.template head<3>();
  const Vector3<Scalar> rotation = motion.template tail<3>();
  const Scalar length = sqrt(along.dot(along));
  return {carried_axes<Scalar>(level_axes(past.along, past.roll), along, length, rotation), length};
}

/// By how much axes are rolled against level_axes().
double roll_of(const Eigen::Matrix3d& axes) {
  const Eigen::Matrix3d level = level_axes(axes.row(0).transpose());
  return std::atan2(axes.row(1).dot(level.row(2)), axes.row(1).dot(level.row(1)));
}

template <class Scalar, class Vector>
Eigen::Matrix<Scalar, 12, 1> turned(const Axes<Scalar>& axes, const Vector& parts) {
  Eigen::Matrix<Scalar, 12, 1> result;
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
    for (const int cell : cells_) members_.push_back(member(input, cell));
    constant_ = std::ranges::all_of(members_, [](const Member& each) {
      return each.material->young.is_constant() && each.material->poisson.is_constant();
    });
    for (int element = 0; element < static_cast<int>(cells_.size()); ++element) past_.push_back(first_past(element));
  }

  void add_stiffness(const Eigen::VectorXd& u, const VariableState& state, std::span<const int> column_starts,
                     double* values) const override {
    for (int element = 0; element < map_.element_count(); ++element) {
      const BeamMatrix k = tangent(element, u, state);
      const BeamMatrix symmetric = 0.5 * (k + k.transpose());
      map_.add(element, symmetric.data(), column_starts, values);
    }
  }
  bool is_symmetric() const override { return false; }
  void add_symmetric_stiffness(const Eigen::VectorXd& u, const VariableState& state, std::span<const int> column_starts,
                               double* values) const override {
    for (int element = 0; element < map_.element_count(); ++element)
      map_.add(element, plain_tangent(element, u, state).data(), column_starts, values);
  }
  void add_initial_stiffness(const Eigen::VectorXd&, const VariableState& state, std::span<const int> column_starts,
                             double* values) const override {
    for (int element = 0; element < map_.element_count(); ++element)
      map_.add(element, initial_stiffness(element, state).data(), column_starts, values);
  }
  bool is_initially_symmetric() const override { return true; }
  bool is_initially_linear() const override { return true; }
  void add_starting_stiffness(const Eigen::VectorXd& u, const VariableState& state, std::span<const int> column_starts,
                              double* values) const override {
    add_symmetric_stiffness(u, state, column_starts, values);
  }
  void add_skew_stiffness(const Eigen::VectorXd& u, const VariableState& state,
                          std::vector<Eigen::Triplet<double>>& entries) const override {
    for (int element = 0; element < map_.element_count(); ++element)
      map_.append_skew_half(element, tangent(element, u, state), entries);
  }

  void add_internal_forces(const Eigen::VectorXd& u, const VariableState& state, ForceSum forces) const override {
    for (int element = 0; element < map_.element_count(); ++element) {
      const Trial now = trial(element, u, state);
      add(element, turned<double>(now.axes.transpose(), now.force), forces);
    }
  }
  void add_forces_of_stresses(const Eigen::VectorXd& u, const VariableState&, std::span<const double> reported,
                              ForceSum forces) const override {
    for (int element = 0; element < map_.element_count(); ++element)
      add(element,
          turned<double>(geometry_of(element, u).axes.transpose(),
                         end_forces(reported.data() + reported_count * element)),
          forces);
  }

  std::span<const int> cells() const override { return cells_; }
  int point_count() const override { return beam_point_count; }
  std::span<const std::string_view> stress_names() const override { return beam_force_names; }
  bool is_linear() const override { return false; }
  bool is_constant() const override { return constant_; }
  bool has_memory() const override { return true; }

  void stresses(const Eigen::VectorXd& u, const VariableState& state, std::span<double> out) const override {
    for (int element = 0; element < map_.element_count(); ++element) {
      const Vector12d force = trial(element, u, state).force;
      std::array<double, 12> ends;
      for (int i = 0; i < 12; ++i) ends[static_cast<std::size_t>(i)] = i < 6 ? -force[i] : force[i];
      write_at_points(ends, out.subspan(static_cast<std::size_t>(reported_count * element), reported_count));
    }
  }

  int variable_count() const override { return rotating_beam_variables; }
  void variables(const Eigen::VectorXd& u, const VariableState& state, std::span<double> out) const override {
    for (int element = 0; element < map_.element_count(); ++element) {
      const Trial now = trial(element, u, state);
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

  void accept(const Eigen::VectorXd& u, const VariableState& state) override {
    for (int element = 0; element < map_.element_count(); ++element) {
      const Trial now = trial(element, u, state);
      begin(element, u, roll_of(now.axes), now.force, state);
      past_[static_cast<std::size_t>(element)].elongation = now.elongation;
    }
  }

  /// Without variables the axes are those of the first geometry, carried along as if by one step.
  void resume(const Eigen::VectorXd& u, const VariableState& state, std::span<const double> reported,
              std::span<const double> variables) override {
    for (int element = 0; element < map_.element_count(); ++element) {
      const double* own =
          variables.empty() ? nullptr : variables.data() + point_count() * rotating_beam_variables * element;
      const double roll = own == nullptr ? carried_roll(element, u) : own[roll_variable];
      begin(element, u, roll,
            reported.empty() ? Vector12d::Zero().eval() : end_forces(reported.data() + reported_count * element),
            state);
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
    const IsotropicElasticity* material;
  };
  /// What a material is at an instant.
  struct Now {
    IsotropicModuli moduli;
    double expansion;
  };
  struct Trial {
    Eigen::Matrix3d axes;
    Vector12d force;
    double elongation;
  };

  Member member(const BlockInput& input, int cell) const {
    const BeamSection& section = slender_section(input, cell);
    const IsotropicElasticity& elasticity = isotropic_material(input, cell);
    if (section.end)
      throw Error(
          "unsupported",
          fmt::format("cell {}: beams in large rotations have a section that does not vary", mesh_.cell_name(cell)),
          "give DEFORMATION='PETIT', or a constant section");
    return {&section, &elasticity};
  }

  Now material(int element, const VariableState& state) const {
    const int cell = cells_[static_cast<std::size_t>(element)];
    const IsotropicElasticity& elasticity = *members_[static_cast<std::size_t>(element)].material;
    return naming_cell(mesh_, cell, [&]() -> Now {
      const MaterialPoint at = middle_of(mesh_, cell, state);
      return {moduli(elasticity, at), state.empty() ? 0.0 : inelastic_axial_strain(elasticity, at)};
    });
  }

  Eigen::Vector3d initial_chord(int cell) const {
    const auto nodes = mesh_.cell(cell);
    return Eigen::Map<const Eigen::Vector3d>(mesh_.nodes[static_cast<std::size_t>(nodes[1])].data()) -
           Eigen::Map<const Eigen::Vector3d>(mesh_.nodes[static_cast<std::size_t>(nodes[0])].data());
  }

  /// What a beam begins with.
  BeamPast first_past(int element) const {
    BeamPast first;
    first.along = initial_chord(cells_[static_cast<std::size_t>(element)]);
    first.roll = members_[static_cast<std::size_t>(element)].section->roll;
    return first;
  }

  /// The direction from which rolls count changes its place at the vertical: a beam near it keeps none by its number.
  double carried_roll(int element, const Eigen::VectorXd& u) const {
    const BeamPast first = first_past(element);
    Vector12d step = unknowns(element, u);
    step.segment<3>(6) -= step.head<3>();
    return roll_of(geometry<double>(first, motion_of(first, step)).axes);
  }

  /// `roll`: of the axes as the forces have them.
  void begin(int element, const Eigen::VectorXd& u, double roll, const Vector12d& force, const VariableState& state) {
    BeamPast& past = past_[static_cast<std::size_t>(element)];
    past.displacement = unknowns(element, u);
    past.along = initial_chord(cells_[static_cast<std::size_t>(element)]) + past.displacement.segment<3>(6) -
                 past.displacement.head<3>();
    past.roll = roll - mean_rotation(past.displacement).dot(past.along.normalized());
    past.force = force;
    const Now now = material(element, state);
    past.moduli = now.moduli;
    past.expansion = now.expansion;
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

  static Motion motion_of(const BeamPast& past, const Vector12d& step) {
    Motion motion;
    motion << step.segment<3>(6), mean_rotation(past.displacement + step);
    return motion;
  }

  BeamGeometry<double> geometry_of(int element, const Eigen::VectorXd& u) const {
    const BeamPast& past = past_[static_cast<std::size_t>(element)];
    return geometry<double>(past, motion_of(past, increment(element, u)));
  }

  /// Of the step's beginning: they follow Young's modulus, and the expansion since then presses on both ends.
  Vector12d held_force(int element, const Now& material) const {
    const BeamPast& past = past_[static_cast<std::size_t>(element)];
    if (!past.force.isZero(0.0) && material.moduli.poisson != past.moduli.poisson)
      throw Error("unsupported",
                  fmt::format("cell {}: Poisson's ratio of beams in large rotations does not change with time",
                              mesh_.cell_name(cells_[static_cast<std::size_t>(element)])),
                  "give DEFORMATION='PETIT', or a constant NU");
    Vector12d force = past.force * (material.moduli.young / past.moduli.young);
    const double pressed = material.moduli.young * members_[static_cast<std::size_t>(element)].section->area *
                           (material.expansion - past.expansion);
    force[0] += pressed;
    force[6] -= pressed;
    return force;
  }

  Trial trial(int element, const Eigen::VectorXd& u, const VariableState& state) const {
    const BeamPast& past = past_[static_cast<std::size_t>(element)];
    const Member& own = members_[static_cast<std::size_t>(element)];
    const Now material = this->material(element, state);
    const auto now = geometry_of(element, u);
    const Vector12d force =
        held_force(element, material) + uniform_beam<double>(*own.section, material.moduli, now.length, shear_) *
                                            turned<double>(now.axes, increment(element, u));
    const double turn = now.axes.row(0).dot(past.along.normalized());
    return {now.axes, force, past.elongation + 1.0 - turn};
  }

  /// Axes and stiffness in them, with their derivatives by the motion.
  struct Turning {
    Axes<Derivative> axes;
    BeamMatrixOf<Derivative> stiffness;
  };

  Turning turning(int element, const Eigen::VectorXd& u, const IsotropicModuli& moduli) const {
    const Member& own = members_[static_cast<std::size_t>(element)];
    const BeamPast& past = past_[static_cast<std::size_t>(element)];
    const Motion motion = motion_of(past, increment(element, u));
    Eigen::Matrix<Derivative, 6, 1> moving;
    for (int i = 0; i < 6; ++i) moving[i] = Derivative(motion[i], 6, i);
    const auto now = geometry<Derivative>(past, moving);
    return {now.axes, uniform_beam<Derivative>(*own.section, moduli, now.length, shear_)};
  }

  /// By the increments at hand, and by what they do to the axes and the length.
  BeamMatrix tangent(int element, const Eigen::VectorXd& u, const VariableState& state) const {
    const Now material = this->material(element, state);
    const Turning now = turning(element, u, material.moduli);
    const Eigen::Matrix<Derivative, 12, 1> local =
        held_force(element, material).cast<Derivative>() +
        now.stiffness * turned<Derivative>(now.axes, increment(element, u).cast<Derivative>().eval());
    const Eigen::Matrix<Derivative, 12, 1> global = turned<Derivative>(now.axes.transpose(), local);
    return of_increments(now.stiffness, now.axes) + of_motion(global);
  }

  static BeamMatrix of_increments(const BeamMatrixOf<Derivative>& local, const Axes<Derivative>& axes) {
    Eigen::Matrix3d turn;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) turn(i, j) = axes(i, j).value();
    BeamMatrix k;
    for (int i = 0; i < 12; ++i)
      for (int j = 0; j < 12; ++j) k(i, j) = local(i, j).value();
    return turned_back(k, turn);
  }

  /// From own axes to those of the mesh.
  static BeamMatrix turned_back(BeamMatrix k, const Eigen::Matrix3d& axes) {
    for (int i = 0; i < 12; i += 3)
      for (int j = 0; j < 12; j += 3) k.block<3, 3>(i, j) = (axes.transpose() * k.block<3, 3>(i, j) * axes).eval();
    return k;
  }

  /// The linear stiffness at the present length and what the present end forces add, in the present axes: that of
  /// Code_Aster 17.3. Torsion counts for nothing in it, nor does how axes and length change under the increments of the
  /// step, so that iterations converge linearly.
  BeamMatrix plain_tangent(int element, const Eigen::VectorXd& u, const VariableState& state) const {
    const Member& own = members_[static_cast<std::size_t>(element)];
    const BeamPast& past = past_[static_cast<std::size_t>(element)];
    const Trial now = trial(element, u, state);
    const double length = (past.along + increment(element, u).segment<3>(6)).norm();
    return turned_back(uniform_beam<double>(*own.section, material(element, state).moduli, length, shear_) +
                           beam_geometric_stiffness(*own.section, length,
                                                    {section_forces(now.force, 0), section_forces(now.force, 6)}),
                       now.axes);
  }

  /// Of small displacements from where the beam was at first.
  BeamMatrix initial_stiffness(int element, const VariableState& state) const {
    const Member& own = members_[static_cast<std::size_t>(element)];
    const BeamPast first = first_past(element);
    const auto now = geometry<double>(first, motion_of(first, Vector12d::Zero()));
    return turned_back(uniform_beam<double>(*own.section, material(element, state).moduli, first.along.norm(), shear_),
                       now.axes);
  }

  /// At the end whose part of the end forces begins at `first`.
  static SectionForces section_forces(const Vector12d& ends, int first) {
    const Eigen::Matrix<double, 6, 1> f = (first == 0 ? -1.0 : 1.0) * ends.segment<6>(first);
    return {.n = f[0], .vy = f[1], .vz = f[2], .mfy = f[4], .mfz = f[5]};
  }

  static BeamMatrix of_motion(const Eigen::Matrix<Derivative, 12, 1>& force) {
    BeamMatrix k = BeamMatrix::Zero();
    for (int i = 0; i < 12; ++i) {
      const Motion by = force[i].derivatives();
      k.block<1, 3>(i, 6) = by.head<3>().transpose();
      k.block<1, 3>(i, 0) = -by.head<3>().transpose();
      k.block<1, 3>(i, 3) = k.block<1, 3>(i, 9) = 0.5 * by.tail<3>().transpose();
    }
    return k;
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
  bool constant_ = true;
  std::vector<int> cells_;
  ElementMap map_;
  std::vector<Member> members_;
  std::vector<BeamPast> past_;
};

}  // namespace

bool is_rotating_beam(Formulation formulation, Kinematics kinematics) {
  return kinematics == Kinematics::large_rotations && is_beam(formulation);
}

bool has_rotating_beams(const Model& model, const BehaviourOfCells* behaviours) {
  for (std::size_t cell = 0; behaviours != nullptr && cell < behaviours->size(); ++cell)
    if (is_rotating_beam(model.formulations[cell], (*behaviours)[cell].kinematics)) return true;
  return false;
}

std::unique_ptr<ElementBlock> make_rotating_beam_block(const BlockInput& input, std::vector<int> cells) {
  return std::make_unique<RotatingBeam>(input, std::move(cells));
}

Eigen::Matrix3d rotated_axes(const Eigen::Vector3d& chord, std::span<const double> variables) {
  return level_axes(chord, variables[roll_variable]);
}

}  // namespace comma::solver
