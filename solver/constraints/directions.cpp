#include "solver/constraints/directions.hpp"

#include <cmath>

#include <fmt/format.h>

#include "solver/elements/cell_quadrature.hpp"
#include "solver/elements/slender/section.hpp"
#include "solver/elements/slender/slender_forces.hpp"
#include "solver/error.hpp"

namespace comma::solver {

namespace {

/// A component of a unit vector this small is what rounding leaves of zero.
constexpr double negligible_component = 1e-14;

Eigen::Vector3d cleaned(Eigen::Vector3d direction) {
  for (double& component : direction) {
    if (std::abs(component) < negligible_component) component = 0.0;
  }
  return direction.normalized();
}

CellPoint point_at(const Mesh& mesh, int cell, int local_node) {
  const CellType type = mesh.cell_types[cell];
  const ReferencePoint& at = reference_nodes(type)[local_node];
  return locate(mesh, cell, {1.0, shape_functions(type, at), shape_derivatives(type, at)});
}

Eigen::Vector3d normal_at_node(const Mesh& mesh, int cell, int local_node) {
  return point_at(mesh, cell, local_node).normal(dimension(mesh.cell_types[cell]));
}

}  // namespace

LinearRelation along(int node, Motion motion, const Eigen::Vector3d& direction, double value,
                     const FieldFunction& function, const Origin& origin) {
  if (!(direction.norm() > 0.0)) throw Error("zero-vector", "the direction of an imposed displacement has no length");
  const Eigen::Vector3d unit = cleaned(direction.normalized());
  LinearRelation relation{{}, value, function, origin};
  for (int c = 0; c < 3; ++c) {
    if (unit[c] == 0.0) continue;
    relation.terms.push_back({node, static_cast<Component>(motion == Motion::translation ? c : c + 3), unit[c]});
  }
  return relation;
}

Eigen::Matrix3d beam_axes(const Mesh& mesh, int cell, int node, const Eigen::Vector3d& y_direction) {
  const double sense = mesh.cell(cell)[0] == node ? -1.0 : 1.0;
  const Eigen::Vector3d x = sense * own_axes(mesh, cell).row(0);
  const Eigen::Vector3d across = y_direction - x * x.dot(y_direction);
  if (!(across.norm() > negligible_component * y_direction.norm())) {
    throw Error("zero-vector",
                fmt::format("the direction given for the y axis runs along the beam on cell {}", mesh.cell_name(cell)));
  }
  const Eigen::Vector3d y = across.normalized();
  Eigen::Matrix3d axes;
  axes << x.transpose(), y.transpose(), x.cross(y).transpose();
  return axes;
}

int beam_at_node(const Model& model, int node, std::span<const int> candidates) {
  const Mesh& mesh = *model.mesh;
  int found = -1, count = 0;
  const auto look_at = [&](int cell) {
    const Formulation formulation = model.formulations[cell];
    if (model.components_of(cell) == 0 || !(is_beam(formulation) || is_bar(formulation))) return;
    const auto nodes = mesh.cell(cell);
    if (nodes[0] != node && nodes[1] != node) return;
    found = cell;
    ++count;
  };
  if (candidates.empty()) {
    for (int cell = 0; cell < mesh.cell_count(); ++cell) look_at(cell);
  } else {
    for (const int cell : candidates) look_at(cell);
  }
  if (count == 1) return found;
  throw Error("ambiguous-axes",
              fmt::format("{} beams end at node {}, so that its axes are not defined", count == 0 ? "no" : "several",
                          mesh.node_name(node)),
              "name the one cell whose axes are meant");
}

std::map<int, Eigen::Vector3d> mean_normals(const Mesh& mesh, std::span<const int> cells) {
  std::map<int, Eigen::Vector3d> normals;
  for (const int cell : cells) {
    const int cell_dimension = dimension(mesh.cell_types[cell]);
    if (cell_dimension != 2 && cell_dimension != mesh.dimension - 1) {
      throw Error("not-a-skin", fmt::format("cell {}, a {}, has no normal in {} dimensions", mesh.cell_name(cell),
                                            name_of(mesh.cell_types[cell]), mesh.dimension));
    }
    const auto nodes = mesh.cell(cell);
    for (std::size_t a = 0; a < nodes.size(); ++a) {
      const Eigen::Vector3d normal = normal_at_node(mesh, cell, static_cast<int>(a));
      if (!(normal.norm() > 0.0))
        throw Error("degenerate-facet", fmt::format("cell {} is flat at a node", mesh.cell_name(cell)));
      normals.try_emplace(nodes[a], Eigen::Vector3d::Zero()).first->second += normal.normalized();
    }
  }
  for (auto& [node, normal] : normals) {
    if (!(normal.norm() > negligible_component)) {
      throw Error("degenerate-facet",
                  fmt::format("the skin cells around node {} face opposite ways", mesh.node_name(node)),
                  "turn the skin cells outwards with MODI_MAILLAGE/ORIE_PEAU");
    }
    normal = cleaned(normal.normalized());
  }
  return normals;
}

std::map<int, Eigen::Vector3d> mean_tangents(const Mesh& mesh, std::span<const int> cells) {
  std::map<int, Eigen::Vector3d> tangents;
  for (const int cell : cells) {
    if (dimension(mesh.cell_types[cell]) != 1)
      throw Error("not-an-edge",
                  fmt::format("cell {}, a {}, has no tangent", mesh.cell_name(cell), name_of(mesh.cell_types[cell])));
    const auto nodes = mesh.cell(cell);
    for (std::size_t a = 0; a < nodes.size(); ++a)
      tangents.try_emplace(nodes[a], Eigen::Vector3d::Zero()).first->second +=
          point_at(mesh, cell, static_cast<int>(a)).tangents.col(0).normalized();
  }
  for (auto& [node, tangent] : tangents) {
    if (!(tangent.norm() > negligible_component))
      throw Error("degenerate-facet", fmt::format("the edges at node {} run opposite ways", mesh.node_name(node)),
                  "give them one direction");
    tangent = cleaned(tangent.normalized());
  }
  return tangents;
}

Eigen::Vector3d plane_tangent(const Eigen::Vector3d& normal) { return {-normal[1], normal[0], 0.0}; }

}  // namespace comma::solver
