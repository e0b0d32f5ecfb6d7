#include "solver/constraints/section_link.hpp"

#include <map>

#include <fmt/format.h>

#include "solver/elements/cell_quadrature.hpp"
#include "solver/error.hpp"

namespace comma::solver {

namespace {

/// Coefficients this small, of about one, are rounding.
constexpr double negligible_in_section = 1e-14;

/// For each node: the integrals over the section of its shape function N and of N GM, where the section has unit
/// measure.
struct NodeIntegrals {
  double share = 0.0;
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
};

struct SectionIntegrals {
  std::map<int, NodeIntegrals> nodes;
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< rotation -> integral of GM x (rotation x GM)
};

/// Calls visit(cell, sample, point, measure) at each integration point.
template <class F>
void for_each_point(const Mesh& mesh, std::span<const int> section, F&& visit) {
  CellSamples samples;
  const int expected = mesh.dimension - 1;
  for (const int cell : section) {
    if (dimension(mesh.cell_types[cell]) != expected) {
      throw Error("not-a-skin", fmt::format("cell {}, a {}, is no {} of a section", mesh.cell_name(cell),
                                            name_of(mesh.cell_types[cell]), expected == 2 ? "face" : "edge"));
    }
    for (const CellSample& sample : samples.of(mesh.cell_types[cell], CellRole::skin)) {
      const CellPoint point = locate(mesh, cell, sample);
      visit(cell, sample, point.at, sample.weight * point.measure(expected));
    }
  }
}

SectionIntegrals integrate(const Mesh& mesh, std::span<const int> section) {
  SectionIntegrals result;
  double measure = 0.0;
  for_each_point(mesh, section, [&](int, const CellSample&, const Eigen::Vector3d& at, double weight) {
    measure += weight;
    result.centroid += weight * at;
  });
  result.centroid /= measure;
  for_each_point(mesh, section, [&](int cell, const CellSample& sample, const Eigen::Vector3d& at, double weight) {
    const Eigen::Vector3d lever = at - result.centroid;
    result.inertia +=
        weight / measure * (lever.squaredNorm() * Eigen::Matrix3d::Identity() - lever * lever.transpose());
    const auto nodes = mesh.cell(cell);
    for (std::size_t a = 0; a < nodes.size(); ++a) {
      NodeIntegrals& node = result.nodes[nodes[a]];
      const double share = weight / measure * sample.values[static_cast<Eigen::Index>(a)];
      node.share += share;
      node.moment += share * lever;
    }
  });
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
  }
  return relation;
}

}  // namespace

SectionLink section_link(const Mesh& mesh, std::span<const int> section, int beam_node, const Origin& origin) {
  const SectionIntegrals integrals = integrate(mesh, section);
  SectionLink link;
  link.centroid = integrals.centroid;
  link.offset = (Eigen::Vector3d(mesh.nodes[beam_node].data()) - integrals.centroid).norm();
  link.size = std::sqrt(0.5 * integrals.inertia.trace());
  const int first_turn = mesh.dimension == 3 ? 0 : 2;
  for (int axis = 0; axis < mesh.dimension; ++axis)
    link.relations.push_back(mean_translation(integrals, beam_node, axis, origin));
  for (int axis = first_turn; axis < 3; ++axis) {
    link.relations.push_back(mean_rotation(integrals, beam_node, axis, first_turn, link.size, origin));
  }
  return link;
}

}  // namespace comma::solver
