#include "solver/constraints/section_link.hpp"

#include <map>

#include <fmt/format.h>

#include "solver/elements/cell_quadrature.hpp"
#include "solver/error.hpp"

namespace comma::solver {

namespace {

/// Coefficients this small, of about one, are rounding.
constexpr double negligible_in_section = 1e-14;
/// An edge that is nearer to the axis of the beam than this (the sine of the angle) lies along it.
constexpr double least_angle = 1e-6;

/// For each node: the integrals over the section of its shape function N, of N GM, and of N z^2 (1 - n n^T) through the
/// thickness of a plate, where the section has unit measure.
struct NodeIntegrals {
  double share = 0.0;
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  Eigen::Matrix3d turn = Eigen::Matrix3d::Zero();
};

struct SectionIntegrals {
  std::map<int, NodeIntegrals> nodes;
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< rotation -> integral of GM x (rotation x GM)
};

/// An integration point: what part of the section it stands for, and a plate's mean of z^2 (1 - n n^T) there.
struct SectionPoint {
  int cell = -1;
  Eigen::VectorXd shape;
  Eigen::Vector3d at = Eigen::Vector3d::Zero();
  double measure = 0.0;
  Eigen::Matrix3d turn = Eigen::Matrix3d::Zero();
};

void require_dimension(const Mesh& mesh, int cell, int expected) {
  if (dimension(mesh.cell_types[cell]) == expected) return;
  throw Error("not-a-skin", fmt::format("cell {}, a {}, is no {} of a section", mesh.cell_name(cell),
                                        name_of(mesh.cell_types[cell]), expected == 2 ? "face" : "edge"));
}

std::vector<SectionPoint> points_of(const Mesh& mesh, std::span<const int> section) {
  std::vector<SectionPoint> points;
  CellSamples samples;
  const int expected = mesh.dimension - 1;
  for (const int cell : section) {
    require_dimension(mesh, cell, expected);
    for (const CellSample& sample : samples.of(mesh.cell_types[cell], CellRole::skin)) {
      const CellPoint point = locate(mesh, cell, sample);
      points.push_back({cell, sample.values, point.at, sample.weight * point.measure(expected)});
    }
  }
  return points;
}

std::vector<SectionPoint> points_of(const Mesh& mesh, std::span<const PlateEdge> section, const Eigen::Vector3d& axis) {
  std::vector<SectionPoint> points;
  CellSamples samples;
  for (const auto& [cell, thickness] : section) {
    require_dimension(mesh, cell, 1);
    for (const CellSample& sample : samples.of(mesh.cell_types[cell], CellRole::skin)) {
      const CellPoint point = locate(mesh, cell, sample);
      const Eigen::Vector3d tangent = point.tangents.col(0);
      const Eigen::Vector3d normal = tangent.cross(axis);
      if (!(normal.norm() > least_angle * tangent.norm() * axis.norm()))
        throw Error("parallel-directions",
                    fmt::format("edge {} of the plate lies along the axis of the beam", mesh.cell_name(cell)),
                    "give the axis of the beam, which the edge crosses");
      const Eigen::Vector3d n = normal.normalized();
      points.push_back({cell, sample.values, point.at, thickness * sample.weight * point.measure(1),
                        thickness * thickness / 12.0 * (Eigen::Matrix3d::Identity() - n * n.transpose())});
    }
  }
  return points;
}

SectionIntegrals integrate(const Mesh& mesh, const std::vector<SectionPoint>& points) {
  SectionIntegrals result;
  double measure = 0.0;
  for (const SectionPoint& point : points) {
    measure += point.measure;
    result.centroid += point.measure * point.at;
  }
  result.centroid /= measure;
  for (const SectionPoint& point : points) {
    const double weight = point.measure / measure;
    const Eigen::Vector3d lever = point.at - result.centroid;
    result.inertia +=
        weight * (lever.squaredNorm() * Eigen::Matrix3d::Identity() - lever * lever.transpose() + point.turn);
    const auto nodes = mesh.cell(point.cell);
    for (std::size_t a = 0; a < nodes.size(); ++a) {
      NodeIntegrals& node = result.nodes[nodes[a]];
      const double share = weight * point.shape[static_cast<Eigen::Index>(a)];
      node.share += share;
      node.moment += share * lever;
      node.turn += share * point.turn;
    }
  }
  return result;
}

void add_term(LinearRelation& relation, int node, int component, double coefficient) {
  if (std::abs(coefficient) < negligible_in_section) return;
  relation.terms.push_back({node, static_cast<Component>(component), coefficient});
}

/// Mean displacement along an axis.
LinearRelation mean_translation(const SectionIntegrals& section, int beam_node, int axis, const Origin& origin) {
  LinearRelation relation{{{beam_node, static_cast<Component>(axis), 1.0}}, 0.0, {}, origin};
  for (const auto& [node, integrals] : section.nodes) add_term(relation, node, axis, -integrals.share);
  return relation;
}

/// Moment of the displacements about an axis, divided by `scale`, a moment of inertia, and multiplied by its root to be
/// of order one.
LinearRelation mean_rotation(const SectionIntegrals& section, int beam_node, int axis, int first_turn, double size,
                             const Origin& origin) {
  LinearRelation relation{{}, 0.0, {}, origin};
  for (int k = first_turn; k < 3; ++k) add_term(relation, beam_node, 3 + k, section.inertia(axis, k) / (size * size));
  const int j = (axis + 1) % 3, k = (axis + 2) % 3;
  for (const auto& [node, integrals] : section.nodes) {
    add_term(relation, node, k, -integrals.moment[j] / (size * size));
    add_term(relation, node, j, integrals.moment[k] / (size * size));
    for (int c = 0; c < 3; ++c) add_term(relation, node, 3 + c, -integrals.turn(axis, c) / (size * size));
  }
  return relation;
}

/// `space`: of how many dimensions the bodies move in.
SectionLink link_of(const SectionIntegrals& integrals, int space, const Mesh& mesh, int beam_node,
                    const Origin& origin) {
  SectionLink link;
  link.centroid = integrals.centroid;
  link.offset = (Eigen::Vector3d(mesh.nodes[beam_node].data()) - integrals.centroid).norm();
  link.size = std::sqrt(0.5 * integrals.inertia.trace());
  const int first_turn = space == 3 ? 0 : 2;
  for (int axis = 0; axis < space; ++axis)
    link.relations.push_back(mean_translation(integrals, beam_node, axis, origin));
  for (int axis = first_turn; axis < 3; ++axis) {
    link.relations.push_back(mean_rotation(integrals, beam_node, axis, first_turn, link.size, origin));
  }
  return link;
}

}  // namespace

SectionLink section_link(const Mesh& mesh, std::span<const int> section, int beam_node, const Origin& origin) {
  return link_of(integrate(mesh, points_of(mesh, section)), mesh.dimension, mesh, beam_node, origin);
}

SectionLink plate_section_link(const Mesh& mesh, std::span<const PlateEdge> section, const Eigen::Vector3d& axis,
                               int beam_node, const Origin& origin) {
  // Plates move in space, though their mesh may be flat.
  return link_of(integrate(mesh, points_of(mesh, section, axis)), 3, mesh, beam_node, origin);
}

}  // namespace comma::solver
