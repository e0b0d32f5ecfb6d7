#include "solver/elements/cell_quadrature.hpp"

#include <cmath>

#include "solver/elements/quadrature.hpp"

namespace comma::solver {

double CellPoint::measure(int dimension) const {
  if (dimension == 1) return tangents.col(0).norm();
  if (dimension == 2) return tangents.col(0).cross(tangents.col(1)).norm();
  return std::abs(tangents.determinant());
}

Eigen::Vector3d CellPoint::normal(int dimension) const {
  if (dimension == 2) return tangents.col(0).cross(tangents.col(1));
  return {tangents(1, 0), -tangents(0, 0), 0.0};
}

NodeColumns node_places(const Mesh& mesh, int cell) {
  const auto nodes = mesh.cell(cell);
  NodeColumns places(3, static_cast<Eigen::Index>(nodes.size()));
  for (std::size_t a = 0; a < nodes.size(); ++a) {
    places.col(static_cast<Eigen::Index>(a)) = Eigen::Map<const Eigen::Vector3d>(mesh.nodes[nodes[a]].data());
  }
  return places;
}

CellPoint locate(const NodeColumns& places, const CellSample& sample) {
  CellPoint point;
  point.at = places.lazyProduct(sample.values);
  const auto directions = sample.derivatives.cols();
  point.tangents.leftCols(directions) = places.lazyProduct(sample.derivatives);
  return point;
}

CellPoint locate(const Mesh& mesh, int cell, const CellSample& sample) {
  return locate(node_places(mesh, cell), sample);
}

const std::vector<CellSample>& CellSamples::of(CellType type, CellRole role) {
  switch (role) {
    case CellRole::body:
      return of_family(type, mass_family(type));
    case CellRole::skin:
      return of_family(type, boundary_family(type));
    case CellRole::edge:
      return of_family(type, edge_family(type));
  }
  return of_family(type, mass_family(type));
}

const std::vector<CellSample>& CellSamples::of_stiffness(CellType type, Formulation formulation) {
  return of_family(type, stiffness_family(type, formulation));
}

const std::vector<CellSample>& CellSamples::of_family(CellType type, std::string_view family) {
  auto& samples = known_[static_cast<std::size_t>(type)][family];
  if (samples.empty()) {
    for (const auto& point : quadrature(type, family)) {
      samples.push_back({point.weight, shape_functions(type, point.at), shape_derivatives(type, point.at)});
    }
  }
  return samples;
}

}  // namespace comma::solver
