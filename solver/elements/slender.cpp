// Bars and straight beams on two nodes, by their exact stiffness (R3.08.01).
#include <array>
#include <utility>

#include <fmt/format.h>

#include "solver/elements/element_block.hpp"
#include "solver/elements/translation.hpp"
#include "solver/error.hpp"

namespace comma::solver {

namespace {

constexpr std::array<std::string_view, 1> bar_forces = {"N"};
constexpr std::array<std::string_view, 6> beam_forces = {"N", "VY", "VZ", "MT", "MFY", "MFZ"};

using BeamMatrix = Eigen::Matrix<double, 12, 12>;

struct Segment {
  double length;
  Eigen::Matrix3d axes;
};

Segment segment_of(const Mesh& mesh, int cell, double roll) {
  const auto nodes = mesh.cell(cell);
  const Eigen::Map<const Eigen::Vector3d> first(mesh.nodes[nodes[0]].data());
  const Eigen::Map<const Eigen::Vector3d> second(mesh.nodes[nodes[1]].data());
  return {(second - first).norm(), own_axes(mesh, cell, roll)};
}

/// The section of a cell, with the values that the element needs positive.
const BeamSection& section_of(const BlockInput& input, int cell) {
  const std::string name = input.model.mesh->cell_name(cell);
  const auto found = input.properties.sections.find(cell);
  if (found == input.properties.sections.end()) {
    throw Error("missing-properties", fmt::format("the bar or beam on cell {} has no cross-section", name));
  }
  const BeamSection& section = found->second;
  const bool bends = input.model.formulations[cell] == Formulation::euler_beam || input.model.formulations[cell] == Formulation::timoshenko_beam;
  const bool complete = section.area > 0.0 && (!bends || (section.inertia_y > 0.0 && section.inertia_z > 0.0 && section.torsion > 0.0 &&
                                                          section.shear_y >= 0.0 && section.shear_z >= 0.0));
  if (!complete) {
    throw Error("invalid-properties", fmt::format("the cross-section of cell {} needs a positive area{}", name,
                                                  bends ? ", second moments of area and torsion constant" : ""));
  }
  return section;
}

/// Adds bending in one plane: deflections at rows v1, v2 and rotations at r1, r2, with rotation = sign * slope. `softening` is the
/// ratio of shear to bending flexibility, 12 E I / (G A_reduced L^2); 0 for Euler's beam.
void add_bending(BeamMatrix& k, double rigidity, double length, double softening, const std::array<int, 4>& rows, double sign) {
  const double c = rigidity / (length * length * length * (1 + softening));
  const double l = sign * length;
  Eigen::Matrix4d plane;
  plane << 12, 6 * l, -12, 6 * l,                                            //
      6 * l, (4 + softening) * l * l, -6 * l, (2 - softening) * l * l,       //
      -12, -6 * l, 12, -6 * l,                                               //
      6 * l, (2 - softening) * l * l, -6 * l, (4 + softening) * l * l;
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) k(rows[i], rows[j]) += c * plane(i, j);
  }
}

void add_spring(BeamMatrix& k, double stiffness, int first, int second) {
  k(first, first) += stiffness;
  k(second, second) += stiffness;
  k(first, second) -= stiffness;
  k(second, first) -= stiffness;
}

BeamMatrix local_beam(const BeamSection& section, const IsotropicElasticity& material, double length, bool shear) {
  const double shear_modulus = material.young / (2 * (1 + material.poisson));
  const double shear_scale = shear ? 12 * material.young / (shear_modulus * section.area * length * length) : 0.0;
  BeamMatrix k = BeamMatrix::Zero();
  add_spring(k, material.young * section.area / length, 0, 6);
  add_spring(k, shear_modulus * section.torsion / length, 3, 9);
  add_bending(k, material.young * section.inertia_z, length, shear_scale * section.inertia_z * section.shear_y, {1, 5, 7, 11}, 1.0);
  add_bending(k, material.young * section.inertia_y, length, shear_scale * section.inertia_y * section.shear_z, {2, 4, 8, 10}, -1.0);
  return k;
}

/// Stiffness in global axes of a bar (Dim translations a node).
template <int Dim>
Eigen::Matrix<double, 2 * Dim, 2 * Dim> bar_matrix(const BlockInput& input, int cell) {
  const BeamSection& section = section_of(input, cell);
  const Segment segment = segment_of(*input.model.mesh, cell, 0.0);
  const Eigen::Matrix<double, Dim, 1> along = segment.axes.row(0).template head<Dim>();
  const Eigen::Matrix<double, Dim, Dim> block =
      elasticity_of(input, cell).young * section.area / segment.length * (along * along.transpose());
  Eigen::Matrix<double, 2 * Dim, 2 * Dim> k;
  k << block, -block, -block, block;
  std::array<bool, Dim> invariant;
  invariant.fill(true);
  make_translation_exact<2, Dim>(k, invariant);
  return k;
}

BeamMatrix beam_matrix(const BlockInput& input, int cell) {
  const BeamSection& section = section_of(input, cell);
  const Segment segment = segment_of(*input.model.mesh, cell, section.roll);
  BeamMatrix k = local_beam(section, elasticity_of(input, cell), segment.length,
                            input.model.formulations[cell] == Formulation::timoshenko_beam);
  BeamMatrix turn = BeamMatrix::Zero();
  for (int i = 0; i < 12; i += 3) turn.block<3, 3>(i, i) = segment.axes;
  k = (turn.transpose() * k * turn).eval();
  k = (0.5 * (k + k.transpose())).eval();
  // A translation strains nothing, to the last bit: see translation.hpp.
  k.middleCols<3>(6) = -k.leftCols<3>();
  k.middleRows<3>(6) = -k.topRows<3>();
  return k;
}

/// Elements on two nodes with a constant stiffness of their own.
template <int Components>
class SlenderBlock final : public ElementBlock {
  static constexpr int size = 2 * Components;
  using Matrix = Eigen::Matrix<double, size, size>;
  static constexpr bool is_beam = Components == 6;

 public:
  SlenderBlock(const BlockInput& input, std::vector<int> cells)
      : mesh_(*input.model.mesh),
        cells_(std::move(cells)),
        map_(input.pattern, input.dofs, input.model.components_of(cells_.front()), 2, gather_nodes(*input.model.mesh, cells_)) {
    for (const int cell : cells_) {
      if constexpr (is_beam) {
        matrices_.push_back(beam_matrix(input, cell));
        const BeamSection& section = section_of(input, cell);
        rigidities_.push_back(elasticity_of(input, cell).young * Eigen::Vector3d(section.area, section.inertia_y, section.inertia_z));
        axes_.push_back(own_axes(*input.model.mesh, cell, section_of(input, cell).roll));
      } else {
        matrices_.push_back(bar_matrix<Components>(input, cell));
        rigidities_.push_back(Eigen::Vector3d(elasticity_of(input, cell).young * section_of(input, cell).area, 0.0, 0.0));
        axes_.push_back(own_axes(*input.model.mesh, cell));
      }
    }
  }

  void add_stiffness(const Eigen::VectorXd&, std::span<const int> column_starts, double* values) const override {
    for (int element = 0; element < map_.element_count(); ++element) {
      map_.add(element, matrices_[element].data(), column_starts, values);
    }
  }

  void add_internal_forces(const Eigen::VectorXd& u, ForceSum forces) const override {
    std::array<int, size> dofs;
    for (int element = 0; element < map_.element_count(); ++element) {
      map_.dofs(element, dofs.data());
      const auto force = end_forces(element, u, dofs);
      for (int i = 0; i < size; ++i) forces[dofs[i]] += force[i];
    }
  }

  std::span<const int> cells() const override { return cells_; }
  int point_count() const override { return is_beam ? 2 : 1; }
  std::span<const std::string_view> stress_names() const override {
    if constexpr (is_beam) return beam_forces;
    return bar_forces;
  }

  /// Section forces, in the element's own axes, of the part with greater x upon the part with smaller x: N > 0 in tension. Beams
  /// have them at both ends, bars once.
  void stresses(const Eigen::VectorXd& u, std::span<double> out) const override {
    std::array<int, size> dofs;
    double* target = out.data();
    for (int element = 0; element < map_.element_count(); ++element) {
      map_.dofs(element, dofs.data());
      const auto force = end_forces(element, u, dofs);
      if constexpr (is_beam) {
        for (const int end : {0, 1}) {
          for (const int part : {0, 3}) target = write_local(element, force.data() + 6 * end + part, end == 0 ? -1.0 : 1.0, target);
        }
      } else {
        double axial = 0.0;
        for (int i = 0; i < Components; ++i) axial += axes_[element](0, i) * static_cast<double>(force[Components + i]);
        *target++ = axial;
      }
    }
  }

  bool is_linear() const override { return true; }

  void add_imposed_strain_forces(const ImposedStrains& imposed, ForceSum forces) const override {
    std::array<int, size> dofs;
    for (int element = 0; element < map_.element_count(); ++element) {
      if (!imposed.acts_on(cells_[element])) continue;
      map_.dofs(element, dofs.data());
      const Eigen::Vector3d resultants = imposed_resultants(imposed, element);
      const Eigen::Matrix3d& axes = axes_[element];
      const Eigen::Vector3d force = axes.row(0).transpose() * resultants[0];
      const Eigen::Vector3d moment = axes.row(1).transpose() * resultants[1] + axes.row(2).transpose() * resultants[2];
      for (int i = 0; i < Components; ++i) {
        const double end = i < 3 ? force[i] : moment[i - 3];
        forces[dofs[i]] -= end;
        forces[dofs[Components + i]] += end;
      }
    }
  }

  void subtract_imposed_stresses(const ImposedStrains& imposed, std::span<double> out) const override {
    const auto names = stress_names().size();
    double* target = out.data();
    for (int element = 0; element < map_.element_count(); ++element) {
      const Eigen::Vector3d resultants = imposed_resultants(imposed, element);
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
  Eigen::Vector3d imposed_resultants(const ImposedStrains& imposed, int element) const {
    const auto nodes = map_.nodes(element);
    const Eigen::Vector3d middle = 0.5 * (Eigen::Map<const Eigen::Vector3d>(mesh_.nodes[nodes[0]].data()) +
                                          Eigen::Map<const Eigen::Vector3d>(mesh_.nodes[nodes[1]].data()));
    return rigidities_[element].cwiseProduct(imposed.slender(cells_[element], middle));
  }

  using Forces = std::array<long double, size>;

  /// Forces on both ends, from the translation of the second end relative to the first.
  Forces end_forces(int element, const Eigen::VectorXd& u, const std::array<int, size>& dofs) const {
    std::array<long double, size> moved;
    for (int j = 0; j < size; ++j) moved[j] = u[dofs[j]];
    constexpr int translations = is_beam ? 3 : Components;
    for (int j = 0; j < translations; ++j) {
      moved[Components + j] -= moved[j];
      moved[j] = 0.0L;
    }
    Forces force{};
    for (int j = 0; j < size; ++j) {
      for (int i = 0; i < size; ++i) force[i] += matrices_[element](i, j) * moved[j];
    }
    return force;
  }

  double* write_local(int element, const long double* global, double sign, double* target) const {
    for (int i = 0; i < 3; ++i) {
      double sum = 0.0;
      for (int j = 0; j < 3; ++j) sum += axes_[element](i, j) * static_cast<double>(global[j]);
      *target++ = sign * sum;
    }
    return target;
  }

  const Mesh& mesh_;
  std::vector<int> cells_;
  ElementMap map_;
  std::vector<Matrix> matrices_;
  std::vector<Eigen::Vector3d> rigidities_;  ///< E A, E I_y, E I_z
  std::vector<Eigen::Matrix3d> axes_;
};

}  // namespace

std::unique_ptr<ElementBlock> make_slender_block(const BlockInput& input, std::vector<int> cells) {
  switch (input.model.formulations[cells.front()]) {
    case Formulation::bar: return std::make_unique<SlenderBlock<3>>(input, std::move(cells));
    case Formulation::bar_2d: return std::make_unique<SlenderBlock<2>>(input, std::move(cells));
    case Formulation::euler_beam:
    case Formulation::timoshenko_beam: return std::make_unique<SlenderBlock<6>>(input, std::move(cells));
    default: throw_unsupported_element(input.model, cells.front());
  }
}

}  // namespace comma::solver
