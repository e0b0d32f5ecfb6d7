// Solids and plane or axisymmetric bodies in small strains: one template on dimension, number of nodes and axisymmetry.
// Only large_strain_block.hpp, which builds on it, and through that continuum_plane.cpp and continuum_solid.cpp include
// it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "solver/elements/element_batches.hpp"
#include "solver/elements/element_block.hpp"
#include "solver/elements/naming_cell.hpp"
#include "solver/elements/quadrature.hpp"
#include "solver/elements/translation.hpp"
#include "solver/error.hpp"
#include "solver/materials/elasticity.hpp"
#include "solver/mesh/reference_element.hpp"
#include "solver/model/stress_names.hpp"

namespace comma::solver {

template <int Dim, int Nodes, bool Axisymmetric>
class ContinuumBlock : public ElementBlock {
 protected:
  static constexpr int strains = Dim == 3 ? 6 : 4;
  static constexpr int size = Nodes * Dim;
  using Coordinates = Eigen::Matrix<double, Nodes, Dim>;  // one node a row; also displacements and gradients of N
  using Strain = Eigen::Matrix<double, strains, 1>;
  using Law = Eigen::Matrix<double, strains, strains>;
  using StrainRow = Eigen::Matrix<double, strains, Dim>;  // the strain that one node's displacement causes
  using Stiffness = Eigen::Matrix<double, size, size>;

  /// Shape functions and their derivatives at one integration point of the reference cell.
  struct Sample {
    double weight;
    Eigen::Matrix<double, Nodes, 1> values;
    Coordinates derivatives;
  };

  /// The same in the real cell.
  struct Point {
    double weight;  ///< volume that the point stands for (per radian, if axisymmetric)
    double radius;
    Coordinates gradients;
  };

 public:
  ContinuumBlock(const BlockInput& input, std::vector<int> cells)
      : mesh_(*input.model.mesh),
        formulation_(input.model.formulations[cells.front()]),
        cells_(std::move(cells)),
        map_(input.pattern, input.dofs, input.model.components_of(cells_.front()), Nodes, gather_nodes(mesh_, cells_)) {
    const CellType type = mesh_.cell_types[cells_.front()];
    for (const auto& point : quadrature(type, stiffness_family(type, formulation_))) {
      samples_.push_back({point.weight, shape_functions(type, point.at), shape_derivatives(type, point.at)});
    }
    collect_materials(input);
    for (int element = 0; element < map_.element_count(); ++element) check_geometry(element);
  }

  void add_stiffness(const Eigen::VectorXd&, const VariableState& state, std::span<const int> column_starts,
                     double* values) const override {
    for_each_in_batches<Stiffness>(
        map_.element_count(), evaluates_no_function(state),
        [&](int element, Stiffness& k) { element_stiffness(element, state, k); },
        [&](int element, const Stiffness& k) { map_.add(element, k.data(), column_starts, values); });
  }

  void add_internal_forces(const Eigen::VectorXd& u, const VariableState& state, ForceSum forces) const override {
    for_each_in_batches<Coordinates>(
        map_.element_count(), evaluates_no_function(state),
        [&](int element, Coordinates& force) {
          force = element_forces(element, relative_displacements(u, dofs_of(element)), state);
        },
        [&](int element, const Coordinates& force) { scatter_forces(force, dofs_of(element), forces); });
  }

  std::span<const int> cells() const override { return cells_; }
  int point_count() const override { return static_cast<int>(samples_.size()); }
  std::span<const std::string_view> stress_names() const override {
    if constexpr (Dim == 3) return solid_stress_names;
    return plane_stress_names;
  }
  bool is_linear() const override { return true; }
  bool is_constant() const override {
    return std::all_of(materials_.begin(), materials_.end(),
                       [](const MaterialInUse& material) { return material.constant; });
  }

  void stresses(const Eigen::VectorXd& u, const VariableState& state, std::span<double> out) const override {
    for_each_apart(map_.element_count(), evaluates_no_function(state), [&](int element) {
      const Displacements displacements = relative_displacements(u, dofs_of(element));
      const Coordinates x = coordinates(element);
      double* target = out.data() + static_cast<std::size_t>(element) * samples_.size() * strains;
      for (int g = 0; g < point_count(); ++g) {
        const Behaviour behaviour(*this, element, g, x, state);
        const Strain elastic = strain(displacements, samples_[g], locate(x, samples_[g])) - behaviour.inelastic;
        Eigen::Map<Strain>(target).noalias() = *behaviour.law * elastic;
        target += strains;
      }
    });
  }

  void energies(const Eigen::VectorXd& u, const VariableState& state, std::span<double> out) const override {
    std::array<int, size> dofs;
    for (int element = 0; element < map_.element_count(); ++element) {
      map_.dofs(element, dofs.data());
      const Displacements displacements = relative_displacements(u, dofs);
      const Coordinates x = coordinates(element);
      out[element] = 0.0;
      for (int g = 0; g < point_count(); ++g) {
        const Point point = locate(x, samples_[g]);
        const Behaviour behaviour(*this, element, g, x, state);
        Strain elastic = strain(displacements, samples_[g], point) - behaviour.inelastic;
        if (imposed_ != nullptr) elastic -= imposed_strain(*imposed_, element, g, x);
        out[element] += 0.5 * point.weight * elastic.dot(*behaviour.law * elastic);
      }
    }
  }

  /// Of an elastic material they count in the energies.
  void impose(const ImposedStrains* imposed) override { imposed_ = imposed; }
  void add_imposed_strain_forces(const ImposedStrains& imposed, const VariableState& state,
                                 ForceSum forces) const override {
    std::array<int, size> dofs;
    for (int element = 0; element < map_.element_count(); ++element) {
      if (!imposed.acts_on(cells_[element])) continue;
      map_.dofs(element, dofs.data());
      const Coordinates x = coordinates(element);
      Coordinates force = Coordinates::Zero();
      for (int g = 0; g < point_count(); ++g) {
        const Point point = locate(x, samples_[g]);
        const Strain stress = point.weight * imposed_stress(imposed, element, g, x, state);
        add_forces(stress, samples_[g], point, force);
      }
      scatter_forces(force, dofs, forces);
    }
  }

  void add_initial_stress_forces(std::span<const double> stresses, ForceSum forces) const override {
    for (int element = 0; element < map_.element_count(); ++element) {
      const double* given = stresses.data() + static_cast<std::size_t>(element * point_count() * strains);
      if (std::isnan(*given)) continue;
      const Coordinates x = coordinates(element);
      Coordinates force = Coordinates::Zero();
      for (int g = 0; g < point_count(); ++g) {
        const Point point = locate(x, samples_[g]);
        const Strain stress = point.weight * Eigen::Map<const Strain>(given + g * strains);
        add_forces(stress, samples_[g], point, force);
      }
      scatter_forces(force, dofs_of(element), forces);
    }
  }

  void subtract_imposed_stresses(const ImposedStrains& imposed, const VariableState& state,
                                 std::span<double> out) const override {
    double* target = out.data();
    for (int element = 0; element < map_.element_count(); ++element) {
      if (!imposed.acts_on(cells_[element])) {
        target += samples_.size() * strains;
        continue;
      }
      const Coordinates x = coordinates(element);
      for (int g = 0; g < point_count(); ++g) {
        Eigen::Map<Strain>(target) -= imposed_stress(imposed, element, g, x, state);
        target += strains;
      }
    }
  }

 protected:
  /// Displacements of the nodes relative to the last one, along the directions in which a translation strains nothing.
  /// The radial displacement is absolute as well, for the hoop strain.
  struct Displacements {
    Coordinates relative;
    Eigen::Matrix<double, Nodes, 1> radial;
  };

  /// A material with its axes, and Hooke's law where that is the same everywhere.
  struct MaterialInUse {
    CellMaterial material;
    bool constant;
    bool expands;
    Law law;

    bool strained(const VariableState& state) const { return !state.empty() && (expands || state.gives_strains()); }
  };

  std::array<int, size> dofs_of(int element) const {
    std::array<int, size> dofs;
    map_.dofs(element, dofs.data());
    return dofs;
  }

  /// Whether no property is a function of the user's, which may not be evaluated on several threads at once.
  bool evaluates_no_function(const VariableState& state) const {
    return std::ranges::all_of(
        materials_, [&](const MaterialInUse& material) { return material.constant && !material.strained(state); });
  }

  /// Hooke's law at one integration point, and the strain that command variables cause there.
  struct Behaviour {
    const Law* law;
    Strain inelastic = Strain::Zero();
    Law own;  ///< written when the law varies alone

    Behaviour(const ContinuumBlock& block, int element, int g, const Coordinates& x, const VariableState& state) {
      const MaterialInUse& used = block.materials_[block.material_of_element_[element]];
      law = &used.law;
      const bool strained = used.strained(state);
      if (used.constant && !strained) return;
      const MaterialPoint at = block.material_point(element, g, x, state);
      naming_cell(block.mesh_, block.cells_[element], [&] {
        if (strained) inelastic = inelastic_strain(used.material, at).template head<strains>();
        if (!used.constant) own = make_law(used.material, block.formulation_, at);
      });
      if (!used.constant) law = &own;
    }
    Behaviour(const Behaviour&) = delete;
    Behaviour& operator=(const Behaviour&) = delete;
  };

  MaterialPoint material_point(int element, int g, const Coordinates& x, const VariableState& state) const {
    const Sample& sample = samples_[g];
    MaterialPoint at;
    state.sample(cells_[element], map_.nodes(element), {sample.values.data(), static_cast<std::size_t>(Nodes)}, g, at);
    std::array<double, 3> place{};
    for (int j = 0; j < Dim; ++j) place[j] = sample.values.dot(x.col(j));
    at.place(place);
    return at;
  }

  /// Hooke's law once for each distinct material and axes.
  void collect_materials(const BlockInput& input) {
    std::map<std::pair<const Elasticity*, const Eigen::Matrix3d*>, int> known;
    for (const int cell : cells_) {
      CellMaterial material = elastic_material(input, cell);
      if (std::holds_alternative<IsotropicElasticity>(*material.elasticity)) material.axes = nullptr;
      const auto [entry, is_new] =
          known.try_emplace({material.elasticity, material.axes}, static_cast<int>(materials_.size()));
      if (is_new) {
        const bool constant = solver::is_constant(*material.elasticity);
        materials_.push_back({material, constant, solver::expands(*material.elasticity),
                              constant ? make_law(material, formulation_, MaterialPoint()) : Law::Zero().eval()});
      }
      material_of_element_.push_back(entry->second);
    }
  }

  static Law make_law(const CellMaterial& material, Formulation formulation, const MaterialPoint& at) {
    if constexpr (Dim == 3)
      return solid_stiffness(material, at);
    else if (formulation == Formulation::plane_stress || formulation == Formulation::plane_stress_reduced)
      return plane_stress_stiffness(material, at);
    else
      return plane_strain_stiffness(material, at);
  }

  Coordinates coordinates(int element) const {
    Coordinates x;
    const auto nodes = map_.nodes(element);
    for (int a = 0; a < Nodes; ++a) {
      for (int j = 0; j < Dim; ++j) x(a, j) = mesh_.nodes[nodes[a]][j];
    }
    return x;
  }

  /// A cell may be numbered either way round, but its orientation must not change from point to point.
  void check_geometry(int element) const {
    const Coordinates x = coordinates(element);
    double sign = 0.0;
    for (const Sample& sample : samples_) {
      const double jacobian = (sample.derivatives.transpose() * x).eval().determinant();
      if (!(jacobian * sign > 0.0 || (sign == 0.0 && jacobian != 0.0))) {
        throw Error("distorted-cell",
                    fmt::format("cell {} is flat or folded: its Jacobian is {} at an integration point",
                                mesh_.cell_name(cells_[element]), jacobian));
      }
      sign = jacobian;
      if (Axisymmetric && !(sample.values.dot(x.col(0)) > 0.0)) {
        throw Error("distorted-cell", fmt::format("axisymmetric cell {} reaches the side of negative radii (X < 0)",
                                                  mesh_.cell_name(cells_[element])));
      }
    }
  }

  static Point locate(const Coordinates& x, const Sample& sample) {
    Point point;
    const Eigen::Matrix<double, Dim, Dim> jacobian = sample.derivatives.transpose() * x;
    point.gradients.noalias() = sample.derivatives * jacobian.inverse().transpose();
    point.radius = Axisymmetric ? sample.values.dot(x.col(0)) : 1.0;
    point.weight = sample.weight * std::abs(jacobian.determinant()) * point.radius;
    return point;
  }

  static StrainRow strain_row(const Sample& sample, const Point& point, int a) {
    StrainRow row = StrainRow::Zero();
    const auto g = point.gradients.row(a);
    row(0, 0) = g(0);
    row(1, 1) = g(1);
    row(3, 0) = g(1);
    row(3, 1) = g(0);
    if constexpr (Axisymmetric) row(2, 0) = sample.values(a) / point.radius;
    if constexpr (Dim == 3) {
      row(2, 2) = g(2);
      row(4, 0) = g(2);
      row(4, 2) = g(0);
      row(5, 1) = g(2);
      row(5, 2) = g(1);
    }
    return row;
  }

  /// H of displacements at a point.
  static Eigen::Matrix3d gradient_of_displacement(const Displacements& u, const Sample& sample, const Point& point) {
    Eigen::Matrix3d h = Eigen::Matrix3d::Zero();
    h.template topLeftCorner<Dim, Dim>() = u.relative.transpose() * point.gradients;
    if constexpr (Axisymmetric) h(2, 2) = sample.values.dot(u.radial) / point.radius;
    return h;
  }

  /// The variation of Green and Lagrange's strain at F that a displacement of node a causes.
  static StrainRow green_lagrange_row(const Eigen::Matrix3d& f, const Sample& sample, const Point& point, int a) {
    StrainRow row = StrainRow::Zero();
    const auto g = point.gradients.row(a);
    for (int i = 0; i < Dim; ++i) {
      row(0, i) = f(i, 0) * g(0);
      row(1, i) = f(i, 1) * g(1);
      row(3, i) = f(i, 0) * g(1) + f(i, 1) * g(0);
      if constexpr (Dim == 3) {
        row(2, i) = f(i, 2) * g(2);
        row(4, i) = f(i, 0) * g(2) + f(i, 2) * g(0);
        row(5, i) = f(i, 1) * g(2) + f(i, 2) * g(1);
      }
    }
    if constexpr (Axisymmetric) row(2, 0) = f(2, 2) * sample.values(a) / point.radius;
    return row;
  }

  /// B^T stress, a node a row.
  static void add_forces(const Strain& stress, const Sample& sample, const Point& point, Coordinates& force) {
    force.noalias() += point.gradients * tensor_in_space(stress);
    if constexpr (Axisymmetric) force.col(0) += sample.values * (stress(2) / point.radius);
  }

  /// What the law adds to the tangent by the strain rows of the nodes (lower triangle).
  static void add_material(const Law& law, double weight, const std::array<StrainRow, Nodes>& rows, Stiffness& k) {
    for (int b = 0; b < Nodes; ++b) {
      const StrainRow image = weight * (law * rows[b]);
      for (int a = b; a < Nodes; ++a)
        k.template block<Dim, Dim>(a * Dim, b * Dim).noalias() += rows[a].transpose() * image;
    }
  }

  /// What the stress adds to the tangent in large strains when the strain's own variation turns (lower triangle), but
  /// for the hoops round an axis.
  static void add_geometric(const Point& point, const Strain& stress, Stiffness& k) {
    const Eigen::Matrix<double, Dim, Dim> pulling = point.weight * tensor_in_space(stress);
    for (int b = 0; b < Nodes; ++b) {
      const Eigen::Matrix<double, Dim, 1> pull = pulling * point.gradients.row(b).transpose();
      for (int a = b; a < Nodes; ++a)
        k.template block<Dim, Dim>(a * Dim, b * Dim).diagonal().array() += point.gradients.row(a).dot(pull);
    }
  }

  /// That of the hoops, which Code_Aster 17.3 leaves out with GREEN_LAGRANGE and GDEF_LOG of displacements alone: with
  /// the same tangent iterations that a loose criterion ends end where they do there.
  static void add_hoops(const Sample& sample, const Point& point, const Strain& stress, Stiffness& k) {
    if constexpr (!Axisymmetric) return;
    const double pulling = point.weight * stress(2) / (point.radius * point.radius);
    for (int b = 0; b < Nodes; ++b)
      for (int a = b; a < Nodes; ++a) k(a * Dim, b * Dim) += pulling * sample.values(a) * sample.values(b);
  }

  /// The stresses along the directions of the displacements.
  static Eigen::Matrix<double, Dim, Dim> tensor_in_space(const Strain& stress) {
    Eigen::Matrix<double, Dim, Dim> tensor;
    if constexpr (Dim == 3)
      tensor << stress(0), stress(3), stress(4), stress(3), stress(1), stress(5), stress(4), stress(5), stress(2);
    else
      tensor << stress(0), stress(3), stress(3), stress(1);
    return tensor;
  }

  /// Direction by direction, over all nodes at once.
  void element_stiffness(int element, const VariableState& state, Stiffness& k) const {
    using ByNode = Eigen::Matrix<double, Nodes, strains>;
    const Coordinates x = coordinates(element);
    std::array<std::array<Eigen::Matrix<double, Nodes, Nodes>, Dim>, Dim> blocks;  // of two directions, i >= j
    for (auto& row : blocks)
      for (auto& block : row) block.setZero();
    for (int g = 0; g < point_count(); ++g) {
      const Behaviour behaviour(*this, element, g, x, state);
      const Point point = locate(x, samples_[g]);
      const Law law = point.weight * *behaviour.law;
      std::array<ByNode, Dim> caused;  // the strains that displacements along a direction cause
      for (int a = 0; a < Nodes; ++a) {
        const StrainRow row = strain_row(samples_[g], point, a);
        for (int i = 0; i < Dim; ++i) caused[i].row(a) = row.col(i).transpose();
      }
      for (int i = 0; i < Dim; ++i) {
        const ByNode stresses = caused[i].lazyProduct(law);
        for (int j = 0; j <= i; ++j) blocks[i][j] += stresses.lazyProduct(caused[j].transpose());
      }
    }
    for (int i = 0; i < Dim; ++i)
      for (int j = 0; j <= i; ++j)
        for (int a = 0; a < Nodes; ++a)
          for (int b = 0; b < Nodes; ++b)
            k(a * Dim + i, b * Dim + j) = k(b * Dim + j, a * Dim + i) = blocks[i][j](a, b);
    make_translation_exact<Nodes, Dim>(k, invariant_directions());
  }

  static constexpr std::array<bool, Dim> invariant_directions() {
    std::array<bool, Dim> invariant{};
    for (int d = 0; d < Dim; ++d) invariant[d] = !(Axisymmetric && d == 0);
    return invariant;
  }

  static Displacements relative_displacements(const Eigen::VectorXd& u, const std::array<int, size>& dofs) {
    Displacements result;
    for (int a = 0; a < Nodes; ++a) {
      for (int j = 0; j < Dim; ++j) result.relative(a, j) = u[dofs[a * Dim + j]] - u[dofs[(Nodes - 1) * Dim + j]];
      result.radial(a) = u[dofs[a * Dim]];
    }
    return result;
  }

  static Strain strain(const Displacements& u, const Sample& sample, const Point& point) {
    const Eigen::Matrix<double, Dim, Dim> h = u.relative.transpose() * point.gradients;  // h(i, j) = du_i / dx_j
    Strain e = Strain::Zero();
    e(0) = h(0, 0);
    e(1) = h(1, 1);
    e(3) = h(0, 1) + h(1, 0);
    if constexpr (Axisymmetric) e(2) = sample.values.dot(u.radial) / point.radius;
    if constexpr (Dim == 3) {
      e(2) = h(2, 2);
      e(4) = h(0, 2) + h(2, 0);
      e(5) = h(1, 2) + h(2, 1);
    }
    return e;
  }

  Strain imposed_stress(const ImposedStrains& imposed, int element, int g, const Coordinates& x,
                        const VariableState& state) const {
    const Behaviour behaviour(*this, element, g, x, state);
    return *behaviour.law * imposed_strain(imposed, element, g, x);
  }

  Strain imposed_strain(const ImposedStrains& imposed, int element, int g, const Coordinates& x) const {
    Eigen::Vector3d at = Eigen::Vector3d::Zero();
    at.head<Dim>() = x.transpose() * samples_[g].values;
    return imposed.continuum(cells_[element], g, at).template head<strains>();
  }

  Coordinates element_forces(int element, const Displacements& u, const VariableState& state) const {
    const Coordinates x = coordinates(element);
    Coordinates force = Coordinates::Zero();
    for (int g = 0; g < point_count(); ++g) {
      const Sample& sample = samples_[g];
      const Point point = locate(x, sample);
      const Behaviour behaviour(*this, element, g, x, state);
      const Strain stress = point.weight * (*behaviour.law * (strain(u, sample, point) - behaviour.inelastic));
      add_forces(stress, sample, point, force);
    }
    return force;
  }

  /// The force on the last node balances the others exactly (see translation.hpp).
  static void scatter_forces(const Coordinates& force, const std::array<int, size>& dofs, ForceSum forces) {
    for (int j = 0; j < Dim; ++j) {
      long double sum = 0.0L;
      for (int a = 0; a < Nodes - 1; ++a) {
        forces[dofs[a * Dim + j]] += force(a, j);
        sum += force(a, j);
      }
      forces[dofs[(Nodes - 1) * Dim + j]] +=
          invariant_directions()[j] ? -sum : static_cast<long double>(force(Nodes - 1, j));
    }
  }

  const Mesh& mesh_;
  Formulation formulation_;
  std::vector<int> cells_;
  ElementMap map_;
  std::vector<Sample> samples_;
  std::vector<MaterialInUse> materials_;
  std::vector<int> material_of_element_;
  const ImposedStrains* imposed_ = nullptr;
};

}  // namespace comma::solver
