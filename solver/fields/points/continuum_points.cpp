#include "solver/fields/points/continuum_points.hpp"

#include <cmath>

#include <fmt/format.h>

#include "solver/elements/cell_material.hpp"
#include "solver/error.hpp"
#include "solver/mesh/reference_element.hpp"

namespace comma::solver {

CellMaterial material_of(const FieldInput& input, int cell) {
  return cell_material(input.model, input.materials, input.properties, cell);
}

bool ContinuumPoints::covers(int cell) const {
  const int body = continuum_dimension(model_.formulations[cell]);
  return body > 0 && dimension(model_.mesh->cell_types[cell]) == body;
}

const std::vector<ContinuumSample>& ContinuumPoints::samples(int cell) {
  const CellType type = model_.mesh->cell_types[cell];
  const Formulation formulation = model_.formulations[cell];
  auto& samples =
      known_[static_cast<std::size_t>(type)][is_reduced(formulation)              ? 1
                                             : mixed_field_count(formulation) > 0 ? 1 + mixed_field_count(formulation)
                                                                                  : 0];
  if (samples.empty()) {
    const auto family = family_ == PointFamily::mass ? mass_family(type) : stiffness_family(type, formulation);
    for (const QuadraturePoint& point : quadrature(type, family)) {
      samples.push_back({point.weight, shape_functions(type, point.at), shape_derivatives(type, point.at)});
    }
  }
  return samples;
}

ContinuumPoint ContinuumPoints::locate(int cell, const ContinuumSample& sample) const {
  const Mesh& mesh = *model_.mesh;
  const auto nodes = mesh.cell(cell);
  const auto dim = static_cast<int>(sample.derivatives.cols());
  ContinuumPoint point;
  Eigen::Matrix3d jacobian = Eigen::Matrix3d::Zero();  // d x_i / d xi_j
  if (dim == 2) jacobian(2, 2) = 1.0;
  for (std::size_t a = 0; a < nodes.size(); ++a) {
    const Eigen::Map<const Eigen::Vector3d> x(mesh.nodes[nodes[a]].data());
    point.at += sample.values[static_cast<Eigen::Index>(a)] * x;
    for (int i = 0; i < dim; ++i) {
      for (int j = 0; j < dim; ++j) jacobian(i, j) += sample.derivatives(static_cast<Eigen::Index>(a), j) * x[i];
    }
  }
  const Eigen::Matrix3d inverse = jacobian.inverse();
  point.gradients.setZero(static_cast<Eigen::Index>(nodes.size()), 3);
  for (Eigen::Index a = 0; a < sample.derivatives.rows(); ++a) {
    for (int i = 0; i < dim; ++i) {
      for (int j = 0; j < dim; ++j) point.gradients(a, i) += sample.derivatives(a, j) * inverse(j, i);
    }
  }
  const double radius = is_axisymmetric(model_.formulations[cell]) ? point.at[0] : 1.0;
  point.weight = sample.weight * std::abs(jacobian.determinant()) * radius;
  return point;
}

MaterialPoint ContinuumPoints::material_point(int cell, const VariableState& state, const ContinuumSample& sample,
                                              const Eigen::Vector3d& at, int point) const {
  MaterialPoint result;
  const auto values = std::span(sample.values.data(), static_cast<std::size_t>(sample.values.size()));
  state.sample(cell, model_.mesh->cell(cell), values, point, result);
  result.place({at[0], at[1], at[2]});
  return result;
}

MaterialPoint ContinuumPoints::material_point(int cell, const VariableState& state, int point) {
  const ContinuumSample& sample = samples(cell)[static_cast<std::size_t>(point)];
  return material_point(cell, state, sample, locate(cell, sample).at, point);
}

}  // namespace comma::solver
