// What the tests of loads share: a cell with its skin, and the resultant and moment of forces.
#pragma once

#include <array>

#include "sample_meshes.hpp"
#include "solver/elements/quadrature.hpp"

namespace comma::solver::testing {

/// One cell with all its facets as skin cells, and all their edges after them if it is a solid.
inline std::shared_ptr<Mesh> with_skin(CellType type, double bend) {
  auto mesh = single_cell(type, bend);
  for (const BoundaryFacet& facet : boundary_facets(type)) {
    std::vector<int> nodes(facet.nodes.begin(), facet.nodes.begin() + node_count(facet.type));
    mesh->add_cell(facet.type, nodes);
  }
  if (dimension(type) < 3) return mesh;
  const int faces = mesh->cell_count();
  for (int face = 1; face < faces; ++face) {
    for (const BoundaryFacet& edge : boundary_facets(mesh->cell_types[face])) {
      std::vector<int> nodes;
      for (int a = 0; a < node_count(edge.type); ++a) nodes.push_back(mesh->cell(face)[edge.nodes[a]]);
      mesh->add_cell(edge.type, nodes);
    }
  }
  return mesh;
}

inline Formulation continuum_of(CellType type) {
  return dimension(type) == 3 ? Formulation::solid : Formulation::plane_strain;
}

inline std::shared_ptr<const Material> dense(double young, double poisson, double density) {
  Material material;
  material.elasticity = IsotropicElasticity{young, poisson, density};
  return std::make_shared<const Material>(material);
}

/// The work of forces on the translations `direction`, or on a rotation about the origin.
inline double work(const Body& body, const Eigen::VectorXd& forces, const Eigen::Vector3d& translation,
                   const Eigen::Vector3d& rotation = Eigen::Vector3d::Zero()) {
  double sum = 0.0;
  for (int dof = 0; dof < forces.size(); ++dof) {
    const Eigen::Map<const Eigen::Vector3d> x(body.model.mesh->nodes[body.dofs->node_of(dof)].data());
    const int c = static_cast<int>(body.dofs->component_of(dof));
    sum += forces[dof] * (c < 3 ? (translation + rotation.cross(x))[c] : rotation[c - 3]);
  }
  return sum;
}

/// Length, area or volume of a cell and its first moment, by the finest family it has: a reference apart from the
/// load's code.
struct Content {
  double measure = 0.0;
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
};
inline Content content(const Mesh& mesh, int cell) {
  const CellType type = mesh.cell_types[cell];
  const char* finest = dimension(type) == 1 ? "FPG4" : dimension(type) == 3 ? nullptr : "FPG9";
  std::string family = finest ? finest : "FPG27";
  if (type == CellType::tria3 || type == CellType::tria6 || type == CellType::tria7) family = "FPG7";
  if (type == CellType::tetra4 || type == CellType::tetra10) family = "FPG15";
  if (type == CellType::penta6 || type == CellType::penta15 || type == CellType::penta18) family = "FPG21";
  Content result;
  for (const auto& point : quadrature(type, family)) {
    const Eigen::VectorXd n = shape_functions(type, point.at);
    const Eigen::MatrixXd d = shape_derivatives(type, point.at);
    Eigen::MatrixXd x(node_count(type), 3);
    for (int a = 0; a < x.rows(); ++a)
      x.row(a) = Eigen::Map<const Eigen::RowVector3d>(mesh.nodes[mesh.cell(cell)[a]].data());
    const Eigen::MatrixXd t = x.transpose() * d;  // 3 x dimension
    const double weight = point.weight * std::sqrt((t.transpose() * t).determinant());
    result.measure += weight;
    result.moment += weight * (x.transpose() * n);
  }
  return result;
}

inline std::vector<AppliedLoad> applied(Load load, TimeFunction multiplier = {}) {
  return {{std::make_shared<const Load>(std::move(load)), std::move(multiplier)}};
}

}  // namespace comma::solver::testing
