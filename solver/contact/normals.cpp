#include "solver/contact/normals.hpp"

#include <array>
#include <cmath>

#include <fmt/format.h>

#include "solver/contact/facet.hpp"
#include "solver/error.hpp"

namespace comma::solver {
namespace {

using Eigen::Vector3d;

/// A component this small is what rounding leaves of zero. It is cleared because contact forces of 1e10 times a
/// rounding would push a body that only weak springs hold sideways.
constexpr double clean_normal_tolerance = 1e-14;

Vector3d cleaned_normal(Vector3d normal) {
  for (double& component : normal)
    if (std::abs(component) < clean_normal_tolerance) component = 0.0;
  return normal.normalized();
}

struct FacetPoints {
  std::array<Vector3d, max_facet_nodes> points;
  std::size_t count = 0;
  std::span<const Vector3d> span() const { return {points.data(), count}; }
};

FacetPoints gather(const Mesh& mesh, int cell, Positions positions) {
  FacetPoints result;
  for (const int node : mesh.cell(cell)) result.points[result.count++] = positions[node];
  return result;
}

bool is_line_in_space(const Mesh& mesh, int cell) {
  return mesh.dimension == 3 && dimension(mesh.cell_types[cell]) != 2;
}

void require_plane_or_surface(const Mesh& mesh, int cell) {
  if (!is_line_in_space(mesh, cell)) return;
  throw Error("unsupported",
              fmt::format("contact facet {} is a line in space: its normal is not defined", mesh.cell_name(cell)),
              "give its normal (VECT_MAIT='FIXE', VECT_ESCL='FIXE'), or its second direction (VECT_MAIT='VECT_Y', "
              "VECT_ESCL='VECT_Y')");
}

/// Across a given direction: of a line in space the cross product of its tangent and the direction, else the facet's
/// own normal less its part along the direction.
Vector3d normal_across(const Mesh& mesh, int facet, const Tangents& tangents, const Vector3d& direction) {
  Vector3d normal = Vector3d::Zero();
  if (is_line_in_space(mesh, facet)) {
    normal = Vector3d(tangents.col(0)).normalized().cross(direction.normalized());
  } else {
    const Vector3d own = facet_normal(mesh.cell_types[facet], tangents);
    normal = own - own.dot(direction.normalized()) * direction.normalized();
  }
  if (!(normal.norm() > clean_normal_tolerance))
    throw Error("degenerate-facet", fmt::format("the second direction that is given leaves contact facet {} no normal",
                                                mesh.cell_name(facet)));
  return cleaned_normal(normal.normalized());
}

}  // namespace

bool has_normal(const NormalChoice& choice, const Mesh& mesh, int facet) {
  return choice.rule != NormalRule::automatic || !is_line_in_space(mesh, facet);
}

std::unordered_map<int, Vector3d> nodal_normals(const Mesh& mesh, std::span<const int> cells, Positions positions,
                                                const NormalChoice& choice) {
  std::unordered_map<int, Vector3d> normals;
  for (const int cell : cells) {
    const CellType type = mesh.cell_types[cell];
    const auto nodes = mesh.cell(cell);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const Vector3d normal = surface_normal(choice, mesh, cell, facet_node(type, static_cast<int>(i)), positions);
      normals.try_emplace(nodes[i], Vector3d::Zero()).first->second += normal;
    }
  }
  for (auto& [node, normal] : normals) {
    if (!(normal.norm() > clean_normal_tolerance))
      throw Error("degenerate-facet",
                  fmt::format("the contact facets around node {} face opposite ways", mesh.node_name(node)),
                  "turn the skin cells outwards with MODI_MAILLAGE/ORIE_PEAU");
    normal = cleaned_normal(normal.normalized());
  }
  return normals;
}

Vector3d interpolated_normal(const Mesh& mesh, int facet, const Eigen::Vector2d& xi,
                             const std::unordered_map<int, Vector3d>& normals) {
  const FacetShape shape = facet_shape(mesh.cell_types[facet], xi);
  const auto nodes = mesh.cell(facet);
  Vector3d normal = Vector3d::Zero();
  for (std::size_t i = 0; i < nodes.size(); ++i) normal += shape.values[i] * normals.at(nodes[i]);
  if (!(normal.norm() > clean_normal_tolerance))
    throw Error("degenerate-facet",
                fmt::format("the normals at the nodes of contact facet {} cancel", mesh.cell_name(facet)),
                "refine the facet, or leave normals as they are (LISSAGE='NON')");
  return cleaned_normal(normal.normalized());
}

Vector3d surface_normal(const NormalChoice& choice, const Mesh& mesh, int facet, const Tangents& tangents) {
  const Vector3d given(choice.vector[0], choice.vector[1], choice.vector[2]);
  switch (choice.rule) {
    case NormalRule::fixed:
      if (!(given.norm() > 0.0)) throw Error("degenerate-facet", "the given normal of a contact surface is null");
      return cleaned_normal(given.normalized());
    case NormalRule::along_y:
      return normal_across(mesh, facet, tangents, given);
    case NormalRule::automatic:
      break;
  }
  require_plane_or_surface(mesh, facet);
  return cleaned_normal(facet_normal(mesh.cell_types[facet], tangents));
}

Vector3d surface_normal(const NormalChoice& choice, const Mesh& mesh, int facet, const Eigen::Vector2d& xi,
                        Positions positions) {
  if (choice.rule == NormalRule::fixed) return surface_normal(choice, mesh, facet, Tangents::Zero());
  const FacetPoints points = gather(mesh, facet, positions);
  return surface_normal(choice, mesh, facet, facet_tangents(mesh.cell_types[facet], points.span(), xi));
}

Vector3d contact_normal(NormalSide side, const Vector3d& master, const Vector3d& slave) {
  if (side == NormalSide::master) return master;
  if (side == NormalSide::slave) return -slave;
  const Vector3d mean = master - slave;
  if (!(mean.norm() > clean_normal_tolerance))
    throw Error("degenerate-facet", "the mean of a master and a slave normal vanishes: the surfaces face the same way",
                "turn the skin cells outwards with MODI_MAILLAGE/ORIE_PEAU");
  return cleaned_normal(mean.normalized());
}

}  // namespace comma::solver
