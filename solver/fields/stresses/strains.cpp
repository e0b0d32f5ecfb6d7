#include "solver/fields/stresses/strains.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <Eigen/Eigenvalues>

#include "solver/elements/slender/slender_member.hpp"
#include "solver/error.hpp"
#include "solver/fields/stresses/beam_stresses.hpp"
#include "solver/model/stress_names.hpp"

namespace comma::solver {

namespace {

bool is_green(StrainKind kind) { return kind == StrainKind::green || kind == StrainKind::mechanical_green; }
bool is_mechanical(StrainKind kind) { return kind == StrainKind::mechanical || kind == StrainKind::mechanical_green; }

/// dU_i / dX_j at a point; the hoop term of an axisymmetric body stands at (2, 2).
class DisplacementGradients {
 public:
  DisplacementGradients(const Model& model, const NodalField& displacement)
      : model_(model),
        displacement_(displacement),
        columns_{displacement.component("DX"), displacement.component("DY"), displacement.component("DZ")} {}

  /// The strain along a bar.
  double elongation(int cell, StrainKind kind) const {
    const auto nodes = model_.mesh->cell(cell);
    const int dim = model_.formulations[cell] == Formulation::bar_2d ? 2 : 3;
    const Eigen::Vector3d along =
        Eigen::Vector3d(model_.mesh->nodes[nodes[1]].data()) - Eigen::Vector3d(model_.mesh->nodes[nodes[0]].data());
    const Eigen::Vector3d change = value(nodes[1], dim, cell) - value(nodes[0], dim, cell);
    const double green = is_green(kind) ? 0.5 * change.squaredNorm() : 0.0;
    if (kind == StrainKind::logarithmic) return std::log((along + change).norm() / along.norm());
    return (along.dot(change) + green) / along.squaredNorm();
  }

  Eigen::Matrix3d at(int cell, const ContinuumSample& sample, const ContinuumPoint& point) const {
    const auto nodes = model_.mesh->cell(cell);
    const int dim = continuum_dimension(model_.formulations[cell]);
    Eigen::Matrix3d gradient = Eigen::Matrix3d::Zero();
    double radial = 0.0;
    // Relative to the last node: a large translation must not cost digits.
    const Eigen::Vector3d base = value(nodes.back(), dim, cell);
    for (std::size_t a = 0; a < nodes.size(); ++a) {
      const Eigen::Vector3d u = value(nodes[a], dim, cell);
      gradient += (u - base) * point.gradients.row(static_cast<Eigen::Index>(a));
      radial += sample.values[static_cast<Eigen::Index>(a)] * u[0];
    }
    if (is_axisymmetric(model_.formulations[cell])) gradient(2, 2) = radial / point.at[0];
    return gradient;
  }

 private:
  Eigen::Vector3d value(int node, int dim, int cell) const {
    Eigen::Vector3d u = Eigen::Vector3d::Zero();
    for (int i = 0; i < dim; ++i) {
      u[i] = columns_[i] < 0 ? absent : displacement_.at(node, columns_[i]);
      if (std::isnan(u[i])) {
        throw Error("incompatible-field", fmt::format("the displacement field has no value at node {} of cell {}",
                                                      model_.mesh->node_name(node), model_.mesh->cell_name(cell)));
      }
    }
    return u;
  }

  const Model& model_;
  const NodalField& displacement_;
  std::array<int, 3> columns_;
};

/// ln(F^T F) / 2 with F = I + h.
Eigen::Matrix3d logarithmic_strain(const Eigen::Matrix3d& h) {
  const Eigen::Matrix3d f = Eigen::Matrix3d::Identity() + h;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> stretches(f.transpose() * f);
  return stretches.eigenvectors() * (0.5 * stretches.eigenvalues().array().log()).matrix().asDiagonal() *
         stretches.eigenvectors().transpose();
}

Vector6d engineering(const Eigen::Matrix3d& strain) {
  Vector6d result;
  result << strain(0, 0), strain(1, 1), strain(2, 2), 2 * strain(0, 1), 2 * strain(0, 2), 2 * strain(1, 2);
  return result;
}

/// The strain across a plane body that carries no stress there.
double transverse_strain(const CellMaterial& material, const MaterialPoint& at, const Vector6d& strain,
                         const Vector6d& inelastic) {
  const Vector6d elastic = strain - inelastic;
  if (const auto* isotropic = std::get_if<IsotropicElasticity>(material.elasticity)) {
    const double poisson = moduli(*isotropic, at).poisson;
    return inelastic[2] - poisson / (1.0 - poisson) * (elastic[0] + elastic[1]);
  }
  const Matrix6d stiffness = solid_stiffness(material, at);
  const double driven = stiffness(2, 0) * elastic[0] + stiffness(2, 1) * elastic[1] + stiffness(2, 3) * elastic[3];
  return inelastic[2] - driven / stiffness(2, 2);
}

Vector6d strain_at(const FieldInput& input, int cell, const Eigen::Matrix3d& h, StrainKind kind,
                   const MaterialPoint& at) {
  Eigen::Matrix3d tensor = 0.5 * (h + h.transpose());
  if (is_green(kind)) tensor += 0.5 * h.transpose() * h;
  if (kind == StrainKind::logarithmic) tensor = logarithmic_strain(h);
  Vector6d strain = engineering(tensor);
  const bool plane_stress = is_plane_stress(input.model.formulations[cell]);
  if (!plane_stress && !is_mechanical(kind)) return strain;
  const CellMaterial material = material_of(input, cell);
  const Vector6d inelastic = inelastic_strain(material, at);
  if (plane_stress) strain[2] = transverse_strain(material, at, strain, inelastic);
  return is_mechanical(kind) ? Vector6d(strain - inelastic) : strain;
}

}  // namespace

namespace {

double bar_strain(const FieldInput& input, int cell, const DisplacementGradients& gradients, StrainKind kind) {
  const double strain = gradients.elongation(cell, kind);
  if (!is_mechanical(kind)) return strain;
  const auto* material = std::get_if<IsotropicElasticity>(material_of(input, cell).elasticity);
  if (material == nullptr) {
    throw Error("unsupported",
                fmt::format("the bar on cell {} has an anisotropic material", input.model.mesh->cell_name(cell)));
  }
  return strain - inelastic_axial_strain(*material, middle_of(*input.model.mesh, cell, input.state));
}

}  // namespace

ElementField strains(const FieldInput& input, const NodalField& displacement, StrainKind kind) {
  const Mesh& mesh = *input.model.mesh;
  ContinuumPoints points(input.model);
  bool solid = false, has_bars = false, has_continua = false;
  ElementField field{"EPSI_R", Support::gauss_point, {"EPXX", "EPYY", "EPZZ", "EPXY"}, {0}, {}};
  for (int cell = 0; cell < mesh.cell_count(); ++cell) {
    const int own = is_bar(input.model.formulations[cell]) ? 1 : 0;
    const int count = points.covers(cell) ? static_cast<int>(points.samples(cell).size()) : own;
    solid = solid || (count > 0 && dimension(mesh.cell_types[cell]) == 3);
    has_bars = has_bars || own > 0;
    has_continua = has_continua || (own == 0 && count > 0);
    field.starts.push_back(field.starts.back() + count);
  }
  if (has_bars && !has_continua) field.components.resize(1);
  if (solid) field.components.insert(field.components.end(), {"EPXZ", "EPYZ"});
  const std::size_t width = field.components.size();
  field.values.assign(static_cast<std::size_t>(field.starts.back()) * width, absent);
  const DisplacementGradients gradients(input.model, displacement);
  for (int cell = 0; cell < mesh.cell_count(); ++cell) {
    if (field.points(cell) == 0) continue;
    if (is_bar(input.model.formulations[cell])) {
      field.values[static_cast<std::size_t>(field.starts[cell]) * width] = bar_strain(input, cell, gradients, kind);
      continue;
    }
    const auto& samples = points.samples(cell);
    for (std::size_t g = 0; g < samples.size(); ++g) {
      const ContinuumPoint point = points.locate(cell, samples[g]);
      const MaterialPoint at = points.material_point(cell, input.state, samples[g], point.at, static_cast<int>(g));
      const Vector6d strain = strain_at(input, cell, gradients.at(cell, samples[g], point), kind, at);
      double* target = field.values.data() + (static_cast<std::size_t>(field.starts[cell]) + g) * width;
      const int own = dimension(mesh.cell_types[cell]) == 3 ? 6 : 4;
      for (int i = 0; i < own; ++i) target[i] = i < 3 ? strain[i] : 0.5 * strain[i];
    }
  }
  return field;
}

std::optional<int> inverted_cell(const Model& model, const BehaviourOfCells& behaviours,
                                 const NodalField& displacement) {
  ContinuumPoints points(model);
  const DisplacementGradients gradients(model, displacement);
  for (int cell = 0; cell < static_cast<int>(behaviours.size()); ++cell) {
    const CellBehaviour& behaviour = behaviours[static_cast<std::size_t>(cell)];
    if (behaviour.kinematics != Kinematics::green_lagrange || behaviour.relation != Relation::elastic ||
        !points.covers(cell))
      continue;
    for (const ContinuumSample& sample : points.samples(cell)) {
      const Eigen::Matrix3d h = gradients.at(cell, sample, points.locate(cell, sample));
      if (!((Eigen::Matrix3d::Identity() + h).determinant() > 0.0)) return cell;
    }
  }
  return std::nullopt;
}

namespace {

/// Takes N / (E A) away from the mechanical strains of bars.
void take_elongations_by_forces(const FieldInput& input, const ElementField& stresses, ElementField& field) {
  const auto& formulations = input.model.formulations;
  if (std::ranges::none_of(formulations, [](Formulation each) { return is_bar(each); })) return;
  const ElementField by_forces = generalised_strains(input, stresses);
  for (int cell = 0; cell < input.model.mesh->cell_count(); ++cell) {
    if (!is_bar(formulations[static_cast<std::size_t>(cell)]) || field.points(cell) == 0) continue;
    const auto& material = std::get<IsotropicElasticity>(*material_of(input, cell).elasticity);
    double& strain = field.values[static_cast<std::size_t>(field.starts[cell]) * field.components.size()];
    // What forces elongate has the strain of the command variables in it.
    const double of_variables = inelastic_axial_strain(material, middle_of(*input.model.mesh, cell, input.state));
    strain -= by_forces.points(cell) > 0 ? by_forces.at(cell, 0, 0) - of_variables : absent;
  }
}

}  // namespace

ElementField plastic_strains(const FieldInput& input, const NodalField& displacement, const ElementField& stresses) {
  ElementField field = strains(input, displacement, StrainKind::mechanical);
  take_elongations_by_forces(input, stresses, field);
  ContinuumPoints points(input.model);
  std::array<int, 6> columns;
  for (int i = 0; i < 6; ++i) columns[i] = stresses.component(solid_stress_names[i]);
  const std::size_t width = field.components.size();
  for (int cell = 0; cell < input.model.mesh->cell_count(); ++cell) {
    if (!points.covers(cell)) continue;
    const auto& samples = points.samples(cell);
    for (std::size_t g = 0; g < samples.size(); ++g) {
      const int point = static_cast<int>(g);
      const MaterialPoint at = points.material_point(cell, input.state, point);
      const int own = dimension(input.model.mesh->cell_types[cell]) == 3 ? 6 : 4;
      Vector6d stress = Vector6d::Zero();
      for (int i = 0; i < own; ++i) stress[i] = columns[i] < 0 ? absent : stresses.at(cell, point, columns[i]);
      const Vector6d elastic = solid_compliance(material_of(input, cell), at) * stress;
      double* target = field.values.data() + (static_cast<std::size_t>(field.starts[cell]) + g) * width;
      for (int i = 0; i < own; ++i) target[i] -= i < 3 ? elastic[i] : 0.5 * elastic[i];
      if (is_plane_stress(input.model.formulations[cell])) target[2] = -target[0] - target[1];
    }
  }
  return field;
}

ElementField creep_strains(const FieldInput& input, const NodalField& displacement) {
  ElementField field = strains(input, displacement, StrainKind::total);
  const std::size_t width = field.components.size();
  for (int cell = 0; cell < input.model.mesh->cell_count(); ++cell) {
    const bool creeps = !is_bar(input.model.formulations[static_cast<std::size_t>(cell)]);
    for (auto k = static_cast<std::size_t>(field.starts[cell]) * width;
         k < static_cast<std::size_t>(field.starts[cell + 1]) * width; ++k)
      field.values[k] = creeps && !std::isnan(field.values[k]) ? 0.0 : absent;
  }
  return field;
}

}  // namespace comma::solver
