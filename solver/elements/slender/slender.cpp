// Bars and straight beams on two nodes (R3.08.01): see slender_member.hpp for the stiffness of one.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "solver/elements/energy_parts.hpp"
#include "solver/elements/naming_cell.hpp"
#include "solver/elements/slender/beam_points.hpp"
#include "solver/elements/slender/slender_member.hpp"
#include "solver/elements/slender/varying_section.hpp"
#include "solver/error.hpp"
#include "solver/model/stress_names.hpp"

namespace comma::solver {

namespace {

constexpr std::array<std::string_view, 1> bar_forces = {"N"};

/// Elements on two nodes with a stiffness of their own. Command variables count by their mean over the two nodes.
template <int Components>
class SlenderBlock final : public ElementBlock {
  static constexpr int size = 2 * Components;
  using Matrix = Eigen::Matrix<double, size, size>;
  static constexpr bool is_beam = Components == 6;

 public:
  SlenderBlock(const BlockInput& input, std::vector<int> cells)
      : mesh_(*input.model.mesh),
        shear_(input.model.formulations[cells.front()] == Formulation::timoshenko_beam),
        cells_(std::move(cells)),
        map_(input.pattern, input.dofs, input.model.components_of(cells_.front()), 2,
             gather_nodes(*input.model.mesh, cells_)) {
    for (const int cell : cells_) {
      members_.push_back(slender_member(input, cell));
      const bool constant = is_constant_material(*members_.back().material);
      constant_ = constant_ && constant;
      matrices_.push_back(constant ? matrix(members_.back(), MaterialPoint()) : Matrix::Zero().eval());
    }
  }

  void add_stiffness(const Eigen::VectorXd&, const VariableState& state, std::span<const int> column_starts,
                     double* values) const override {
    Matrix own;
    for (int element = 0; element < map_.element_count(); ++element) {
      map_.add(element, matrix_at(element, state, own).data(), column_starts, values);
    }
  }

  void add_geometric_stiffness(std::span<const double> forces, const VariableState&, std::span<const int> column_starts,
                               double* values) const override {
    for (int element = 0; element < map_.element_count(); ++element) {
      const double* own = forces.data() + static_cast<std::size_t>(element * point_count()) * stress_names().size();
      const Matrix k = named(element, [&] { return geometric_matrix(element, own); });
      map_.add(element, k.data(), column_starts, values);
    }
  }

  void add_internal_forces(const Eigen::VectorXd& u, const VariableState& state, ForceSum forces) const override {
    std::array<int, size> dofs;
    for (int element = 0; element < map_.element_count(); ++element) {
      map_.dofs(element, dofs.data());
      const auto force = end_forces(element, u, dofs, state);
      for (int i = 0; i < size; ++i) forces[dofs[i]] += force[i];
    }
  }

  bool takes_initial_stresses() const override { return true; }
  bool scales_initial_stresses() const override { return !constant_; }
  void write_moduli(const VariableState& state, std::span<double> out) const override {
    for (int element = 0; element < map_.element_count(); ++element)
      out[static_cast<std::size_t>(element)] =
          named(element, [&] { return members_[element].material->young(material_point(element, state)); });
  }
  /// Forces at the ends: see stresses().
  void add_forces_of_stresses(const Eigen::VectorXd& u, const VariableState& state, std::span<const double> stresses,
                              ForceSum forces) const override {
    if (stresses.empty()) return add_internal_forces(u, state, forces);
    const std::size_t each = static_cast<std::size_t>(point_count()) * stress_names().size();
    std::array<int, size> dofs;
    for (int element = 0; element < map_.element_count(); ++element) {
      map_.dofs(element, dofs.data());
      const double* own = stresses.data() + static_cast<std::size_t>(element) * each;
      if constexpr (is_beam) {
        for (int part = 0; part < 4; ++part) {  // force and moment at the first end, then at the second
          const auto at = at_end({own, each}, stress_names().size(), part / 2);
          const Eigen::Vector3d global =
              axes(element).transpose() * Eigen::Map<const Eigen::Vector3d>(at.data() + 3 * (part % 2));
          for (int i = 0; i < 3; ++i) forces[dofs[3 * part + i]] += part < 2 ? -global[i] : global[i];
        }
      } else {
        for (int i = 0; i < Components; ++i) {
          forces[dofs[i]] -= own[0] * axes(element)(0, i);
          forces[dofs[Components + i]] += own[0] * axes(element)(0, i);
        }
      }
    }
  }

  /// What a section of a beam bears between its ends does not follow from forces at both.
  void add_initial_stress_forces(std::span<const double> stresses, ForceSum forces) const override {
    if constexpr (is_beam) return ElementBlock::add_initial_stress_forces(stresses, forces);
    std::vector<double> given(stresses.begin(), stresses.end());
    std::ranges::replace_if(
        given, [](double each) { return std::isnan(each); }, 0.0);
    add_forces_of_stresses({}, {}, given, forces);
  }

  std::span<const int> cells() const override { return cells_; }
  int point_count() const override { return is_beam ? beam_point_count : 1; }
  std::span<const std::string_view> stress_names() const override {
    if constexpr (is_beam) return beam_force_names;
    return bar_forces;
  }

  /// Section forces, in the element's own axes, of the part with greater x upon the part with smaller x: N > 0 in
  /// tension. Beams have them at both ends and in the middle, bars once.
  void stresses(const Eigen::VectorXd& u, const VariableState& state, std::span<double> out) const override {
    std::array<int, size> dofs;
    double* target = out.data();
    for (int element = 0; element < map_.element_count(); ++element) {
      map_.dofs(element, dofs.data());
      const auto force = end_forces(element, u, dofs, state);
      if constexpr (is_beam) {
        std::array<double, 12> ends;
        double* own = ends.data();
        for (const int end : {0, 1}) {
          for (const int part : {0, 3})
            own = write_local(element, force.data() + 6 * end + part, end == 0 ? -1.0 : 1.0, own);
        }
        write_at_points(ends, {target, 6 * beam_point_count});
        target += 6 * beam_point_count;
      } else {
        double axial = 0.0;
        for (int i = 0; i < Components; ++i) axial += axes(element)(0, i) * static_cast<double>(force[Components + i]);
        *target++ = axial;
      }
    }
  }

  /// 1/2 u K u - u f + 1/2 E A strain^2 L with the forces f and the axial strain of the command variables; of initial
  /// strains the work of the section forces on them is taken off besides.
  void energies(const Eigen::VectorXd& u, const VariableState& state, std::span<double> out) const override {
    std::array<int, size> dofs;
    for (int element = 0; element < map_.element_count(); ++element) {
      map_.dofs(element, dofs.data());
      const auto force = end_forces(element, u, dofs, state);
      const Expansion expansion = expansion_of(element, state);
      double work = 0.0;
      for (int i = 0; i < size; ++i) work += u[dofs[i]] * static_cast<double>(force[i]);
      double elongation = 0.0;
      for (int i = 0; i < 3 && i < Components; ++i)
        elongation += axes(element)(0, i) * (u[dofs[Components + i]] - u[dofs[i]]);
      // `force` lacks f, so that u . force = u K u - u f: half of u f is missing still.
      const double length = members_[element].length;
      out[element] = 0.5 * (work - expansion.force * (elongation - expansion.strain * length));
      if (imposed_ != nullptr && imposed_->acts_on(cells_[element]))
        out[element] -= works_on_imposed(*imposed_, element, mean_forces(element, force), state).sum();
    }
  }

  std::span<const std::string_view> energy_names() const override {
    if constexpr (is_beam) return beam_energy_names;
    return {};
  }

  /// What command variables and initial strains change goes with the parts that they strain: see energies().
  void energy_parts(const Eigen::VectorXd& u, const VariableState& state, std::span<double> out) const override {
    if constexpr (is_beam) {
      std::array<int, size> dofs;
      for (int element = 0; element < map_.element_count(); ++element) {
        map_.dofs(element, dofs.data());
        const auto force = end_forces(element, u, dofs, state);
        Eigen::Matrix<double, size, 1> moved, ends;
        for (int i = 0; i < size; ++i) {
          moved[i] = i % 6 < 3 ? u[dofs[i]] - u[dofs[i % 6]] : u[dofs[i]];
          ends[i] = static_cast<double>(force[i]);
        }
        Eigen::Vector4d parts = beam_energy_parts(*members_[element].section, axes(element), moved, ends);
        const Expansion expansion = expansion_of(element, state);
        const double elongation = axes(element).row(0).dot(moved.template segment<3>(6));
        parts[0] -= 0.5 * expansion.force * (elongation - expansion.strain * members_[element].length);
        if (imposed_ != nullptr && imposed_->acts_on(cells_[element])) {
          const Eigen::Vector3d work = works_on_imposed(*imposed_, element, mean_forces(element, force), state);
          parts -= Eigen::Vector4d(work[0], 0.0, work[1], work[2]);
        }
        std::ranges::copy(parts, out.begin() + 4 * element);
      }
    }
  }

  bool is_linear() const override { return true; }
  bool is_constant() const override { return constant_; }

  void impose(const ImposedStrains* strains) override { imposed_ = strains; }
  void add_imposed_strain_forces(const ImposedStrains& imposed, const VariableState& state,
                                 ForceSum forces) const override {
    std::array<int, size> dofs;
    for (int element = 0; element < map_.element_count(); ++element) {
      if (!imposed.acts_on(cells_[element])) continue;
      map_.dofs(element, dofs.data());
      const Eigen::Vector3d resultants = imposed_resultants(imposed, element, state);
      const Eigen::Matrix3d& own = axes(element);
      const Eigen::Vector3d force = own.row(0).transpose() * resultants[0];
      const Eigen::Vector3d moment = own.row(1).transpose() * resultants[1] + own.row(2).transpose() * resultants[2];
      for (int i = 0; i < Components; ++i) {
        const double end = i < 3 ? force[i] : moment[i - 3];
        forces[dofs[i]] -= end;
        forces[dofs[Components + i]] += end;
      }
    }
  }

  void subtract_imposed_stresses(const ImposedStrains& imposed, const VariableState& state,
                                 std::span<double> out) const override {
    const auto names = stress_names().size();
    double* target = out.data();
    for (int element = 0; element < map_.element_count(); ++element) {
      const Eigen::Vector3d resultants = imposed_resultants(imposed, element, state);
      for (int point = 0; point < point_count(); ++point, target += names) {
        target[0] -= resultants[0];
        if constexpr (is_beam) {
          target[4] -= resultants[1];
          target[5] -= resultants[2];
        }
      }
    }
  }

 private:
  /// N, MFY and MFZ of the imposed strain at the middle of an element.
  Eigen::Vector3d imposed_resultants(const ImposedStrains& imposed, int element, const VariableState& state) const {
    const SlenderMember& member = members_[element];
    if (varies(*member.section) && imposed.acts_on(cells_[element])) {
      throw Error("unsupported",
                  fmt::format("an initial strain acts on the beam of cell {}, whose section varies",
                              mesh_.cell_name(cells_[element])),
                  "give it a constant section, cut into several beams");
    }
    const double young = named(element, [&] { return member.material->young(material_point(element, state)); });
    const Eigen::Vector3d section(member.section->area, is_beam ? member.section->inertia_y : 0.0,
                                  is_beam ? member.section->inertia_z : 0.0);
    return young * section.cwiseProduct(imposed_strain(imposed, element));
  }
  Eigen::Vector3d imposed_strain(const ImposedStrains& imposed, int element) const {
    const auto nodes = map_.nodes(element);
    return imposed.slender(cells_[element], 0.5 * (Eigen::Map<const Eigen::Vector3d>(mesh_.nodes[nodes[0]].data()) +
                                                   Eigen::Map<const Eigen::Vector3d>(mesh_.nodes[nodes[1]].data())));
  }

  using Forces = std::array<long double, size>;

  /// N, MFY and MFZ of the displacements, by their mean over the element.
  Eigen::Vector3d mean_forces(int element, const Forces& force) const {
    Eigen::Vector3d pull = Eigen::Vector3d::Zero(), moment = Eigen::Vector3d::Zero();
    for (int i = 0; i < 3 && i < Components; ++i) pull[i] = static_cast<double>(force[Components + i]);
    for (int i = 3; i < Components; ++i) moment[i - 3] = 0.5 * static_cast<double>(force[Components + i] - force[i]);
    return {axes(element).row(0).dot(pull), axes(element).row(1).dot(moment), axes(element).row(2).dot(moment)};
  }
  /// By what initial strains lessen the elastic energy of an element with these forces, by N, MFY and MFZ: 1/2 r e^2 is
  /// left of them alone.
  Eigen::Vector3d works_on_imposed(const ImposedStrains& imposed, int element, const Eigen::Vector3d& forces,
                                   const VariableState& state) const {
    return members_[element].length *
           imposed_strain(imposed, element).cwiseProduct(forces - 0.5 * imposed_resultants(imposed, element, state));
  }

  /// The axial strain of the command variables, and the compression that holding it back takes.
  struct Expansion {
    double strain = 0.0;
    double force = 0.0;
  };

  static bool is_constant_material(const IsotropicElasticity& material) {
    return material.young.is_constant() && material.poisson.is_constant();
  }

  Matrix matrix(const SlenderMember& member, const MaterialPoint& at) const {
    if constexpr (is_beam)
      return beam_stiffness(member, moduli(*member.material, at), shear_);
    else
      return bar_stiffness<Components>(member, moduli(*member.material, at));
  }

  /// What the section forces add: `forces` as stresses() gives them of the element.
  Matrix geometric_matrix(int element, const double* forces) const {
    if constexpr (is_beam) {
      const auto section_forces = [](const double* f) { return SectionForces{f[0], f[1], f[2], f[3], f[4], f[5]}; };
      return beam_geometric_stiffness(members_[element],
                                      {section_forces(forces), section_forces(forces + 6 * (beam_point_count - 1))});
    } else {
      return bar_geometric_stiffness<Components>(members_[element], forces[0]);
    }
  }

  const Matrix& matrix_at(int element, const VariableState& state, Matrix& own) const {
    if (is_constant_material(*members_[element].material)) return matrices_[element];
    own = named(element, [&] { return matrix(members_[element], material_point(element, state)); });
    return own;
  }

  MaterialPoint material_point(int element, const VariableState& state) const {
    return middle_of(mesh_, cells_[element], state);
  }

  Expansion expansion_of(int element, const VariableState& state) const {
    const SlenderMember& member = members_[element];
    if (state.empty()) return {};
    return named(element, [&] {
      const MaterialPoint at = material_point(element, state);
      Expansion expansion;
      expansion.strain = inelastic_axial_strain(*member.material, at);
      if (expansion.strain != 0.0)
        expansion.force = member.material->young(at) * axial_area(*member.section) * expansion.strain;
      return expansion;
    });
  }

  template <class Compute>
  auto named(int element, Compute&& compute) const {
    return naming_cell(mesh_, cells_[element], compute);
  }

  const Eigen::Matrix3d& axes(int element) const { return members_[element].axes; }

  /// Forces on both ends, from the translation of the second end relative to the first.
  Forces end_forces(int element, const Eigen::VectorXd& u, const std::array<int, size>& dofs,
                    const VariableState& state) const {
    Matrix own;
    const Matrix& k = matrix_at(element, state, own);
    std::array<long double, size> moved;
    for (int j = 0; j < size; ++j) moved[j] = u[dofs[j]];
    constexpr int translations = is_beam ? 3 : Components;
    for (int j = 0; j < translations; ++j) {
      moved[Components + j] -= moved[j];
      moved[j] = 0.0L;
    }
    Forces force{};
    for (int j = 0; j < size; ++j) {
      for (int i = 0; i < size; ++i) force[i] += k(i, j) * moved[j];
    }
    const double held = expansion_of(element, state).force;
    for (int i = 0; held != 0.0 && i < translations; ++i) {
      force[i] += held * axes(element)(0, i);
      force[Components + i] -= held * axes(element)(0, i);
    }
    return force;
  }

  double* write_local(int element, const long double* global, double sign, double* target) const {
    for (int i = 0; i < 3; ++i) {
      double sum = 0.0;
      for (int j = 0; j < 3; ++j) sum += axes(element)(i, j) * static_cast<double>(global[j]);
      *target++ = sign * sum;
    }
    return target;
  }

  const Mesh& mesh_;
  bool shear_;
  bool constant_ = true;
  std::vector<int> cells_;
  ElementMap map_;
  const ImposedStrains* imposed_ = nullptr;
  std::vector<SlenderMember> members_;
  std::vector<Matrix> matrices_;  ///< where the material is constant
};

}  // namespace

std::unique_ptr<ElementBlock> make_slender_block(const BlockInput& input, std::vector<int> cells) {
  switch (input.model.formulations[cells.front()]) {
    case Formulation::bar:
      return std::make_unique<SlenderBlock<3>>(input, std::move(cells));
    case Formulation::bar_2d:
      return std::make_unique<SlenderBlock<2>>(input, std::move(cells));
    case Formulation::euler_beam:
    case Formulation::timoshenko_beam:
      return std::make_unique<SlenderBlock<6>>(input, std::move(cells));
    default:
      throw_unsupported_element(input.model, cells.front());
  }
}

}  // namespace comma::solver
