#include "solver/constraints/rigid_link.hpp"

#include <algorithm>
#include <limits>
#include <set>

#include <fmt/format.h>

#include "solver/constraints/rigid_body_rows.hpp"
#include "solver/error.hpp"
#include "solver/mesh/boundary.hpp"

namespace comma::solver {

namespace {

using MotionRows = Eigen::Matrix<double, 6, Eigen::Dynamic>;

constexpr ComponentMask rotation_mask = mask_of(Component::drx) | mask_of(Component::dry) | mask_of(Component::drz);
constexpr ComponentMask space_mask = mask_of(Component::dz) | mask_of(Component::drx) | mask_of(Component::dry);
/// Coefficients are of order one after scaling; what rounding leaves of a zero is far below this.
constexpr double negligible_in_link = 1e-13;

/// The nodes as a body, lengths scaled by its radius.
struct RigidBody {
  std::vector<int> nodes;
  std::vector<Eigen::Vector3d> levers;  ///< from the mean position, of length 1 at most
  double radius = 0.0;
  ComponentMask components = 0;  ///< of all nodes together

  bool turns() const { return (components & rotation_mask) != 0; }
  bool in_space() const { return (components & space_mask) != 0; }
};

RigidBody make_body(const Mesh& mesh, const DofMap& dofs, std::span<const int> nodes,
                    std::span<const Eigen::Vector3d> places) {
  RigidBody body;
  std::set<int> known;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const int node = nodes[k];
    if (!known.insert(node).second) continue;
    if (dofs.components(node) == 0) {
      throw Error("unknown-dof", fmt::format("node {} of a rigid link belongs to no finite element of the model",
                                             mesh.node_name(node)));
    }
    body.nodes.push_back(node);
    body.components |= dofs.components(node);
    body.levers.push_back(places[k]);
    mean += places[k];
  }
  mean /= static_cast<double>(std::max<std::size_t>(body.nodes.size(), 1));
  for (Eigen::Vector3d& lever : body.levers) {
    lever -= mean;
    body.radius = std::max(body.radius, lever.norm());
  }
  if (!(body.radius > 0.0)) body.radius = 1.0;
  for (Eigen::Vector3d& lever : body.levers) lever /= body.radius;
  return body;
}

/// Moves nodes that nearly coincide, or nearly lie on a line, onto it. Returns the directions about which they can
/// turn.
std::vector<Eigen::Vector3d> settle(RigidBody& body, double coincidence) {
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& lever : body.levers) spread += lever * lever.transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(spread);
  const Eigen::Vector3d along = axes.eigenvectors().col(2);
  const double limit = coincidence / body.radius;
  double size = 0.0, width = 0.0;
  for (const Eigen::Vector3d& lever : body.levers) {
    size = std::max(size, lever.norm());
    width = std::max(width, (lever - along * along.dot(lever)).norm());
  }
  // Twice the largest distance from the mean bounds the distance between two nodes; rounding is no width.
  const auto within = [&](double extent) { return 2.0 * extent <= limit || extent < negligible_in_link; };
  if (within(size)) {
    for (Eigen::Vector3d& lever : body.levers) lever.setZero();
    return {};
  }
  if (!body.in_space()) return {Eigen::Vector3d::UnitZ()};
  if (!within(width)) return {Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ()};
  for (Eigen::Vector3d& lever : body.levers) lever = (along * along.dot(lever)).eval();
  return {axes.eigenvectors().col(0), axes.eigenvectors().col(1)};
}

/// The motions of the body, one a column, as coefficients of rigid_body_row().
MotionRows motions_of(RigidBody& body, double coincidence) {
  std::vector<Eigen::Vector3d> turns;
  if (!body.turns())
    turns = settle(body, coincidence);
  else if (body.in_space())
    turns = {Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ()};
  else
    turns = {Eigen::Vector3d::UnitZ()};
  const int translations = body.in_space() ? 3 : 2;
  MotionRows motions = MotionRows::Zero(6, translations + static_cast<int>(turns.size()));
  motions.topLeftCorner(translations, translations).setIdentity();
  for (std::size_t k = 0; k < turns.size(); ++k) motions.col(translations + static_cast<int>(k)).tail<3>() = turns[k];
  return motions;
}

/// The degrees of freedom of the body and what its motions do to them (one row each); rotations are scaled by the
/// radius.
struct BodyRows {
  std::vector<LinearRelation::Term> terms;  ///< coefficient: 1, or the radius for a rotation
  Eigen::MatrixXd values;
};

BodyRows rows_of(const DofMap& dofs, const RigidBody& body, const MotionRows& motions) {
  BodyRows rows;
  std::vector<Eigen::RowVectorXd> values;
  for (std::size_t i = 0; i < body.nodes.size(); ++i) {
    for (int c = 0; c < motion_count; ++c) {
      const auto component = static_cast<Component>(c);
      if (!contains(dofs.components(body.nodes[i]), component)) continue;
      rows.terms.push_back({body.nodes[i], component, c < 3 ? 1.0 : body.radius});
      values.push_back(rigid_body_row(component, body.levers[i]) * motions);
    }
  }
  rows.values.resize(static_cast<Eigen::Index>(values.size()), motions.cols());
  for (std::size_t i = 0; i < values.size(); ++i) rows.values.row(static_cast<Eigen::Index>(i)) = values[i];
  return rows;
}

/// Rows from which all others follow: those of one node if it has them all, which keeps relations short, else a
/// well-conditioned choice.
std::vector<int> leading_rows(const BodyRows& rows) {
  const int wanted = static_cast<int>(rows.values.cols());
  const int count = static_cast<int>(rows.terms.size());
  for (int first = 0, last = 0; first < count; first = last) {
    while (last < count && rows.terms[last].node == rows.terms[first].node) ++last;
    if (last - first != wanted) continue;
    std::vector<int> result(wanted);
    for (int k = 0; k < wanted; ++k) result[k] = first + k;
    return result;
  }
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(rows.values.transpose());
  std::vector<int> result;
  for (Eigen::Index k = 0; k < qr.rank(); ++k) result.push_back(qr.colsPermutation().indices()[k]);
  std::sort(result.begin(), result.end());
  return result;
}

}  // namespace

std::vector<LinearRelation> rigid_link(const Mesh& mesh, const DofMap& dofs, std::span<const int> nodes,
                                       double coincidence, const Origin& origin) {
  std::vector<Eigen::Vector3d> places;
  for (const int node : nodes) places.emplace_back(mesh.nodes[node].data());
  return rigid_link(mesh, dofs, nodes, places, coincidence, origin);
}

std::vector<LinearRelation> rigid_link(const Mesh& mesh, const DofMap& dofs, std::span<const int> nodes,
                                       std::span<const Eigen::Vector3d> places, double coincidence,
                                       const Origin& origin) {
  RigidBody body = make_body(mesh, dofs, nodes, places);
  const BodyRows rows = rows_of(dofs, body, motions_of(body, coincidence));
  if (body.nodes.size() < 2) return {};
  const std::vector<int> leading = leading_rows(rows);
  const Eigen::MatrixXd lead = rows.values(leading, Eigen::all);
  // Rows that follow: row = factors * lead. One node alone may lead with more rows than the body has motions.
  const Eigen::MatrixXd factors = lead.transpose().colPivHouseholderQr().solve(rows.values.transpose()).transpose();
  std::vector<LinearRelation> relations;
  for (int i = 0; i < static_cast<int>(rows.terms.size()); ++i) {
    if (std::binary_search(leading.begin(), leading.end(), i)) continue;
    LinearRelation relation{{rows.terms[i]}, 0.0, {}, origin};
    relation.terms[0].coefficient = 1.0;
    for (std::size_t k = 0; k < leading.size(); ++k) {
      const double factor = factors(i, static_cast<Eigen::Index>(k));
      if (std::abs(factor) < negligible_in_link) continue;
      const auto& leader = rows.terms[leading[k]];
      relation.terms.push_back(
          {leader.node, leader.component, -factor * leader.coefficient / rows.terms[i].coefficient});
    }
    relations.push_back(std::move(relation));
  }
  return relations;
}

double default_coincidence(const Mesh& mesh) {
  double shortest = std::numeric_limits<double>::infinity();
  const auto measure = [&](int a, int b) {
    const double length = (Eigen::Vector3d(mesh.nodes[a].data()) - Eigen::Vector3d(mesh.nodes[b].data())).norm();
    if (length > 0.0) shortest = std::min(shortest, length);
  };
  for (int cell = 0; cell < mesh.cell_count(); ++cell) {
    const CellType type = mesh.cell_types[cell];
    const auto nodes = mesh.cell(cell);
    if (dimension(type) == 1) measure(nodes[0], nodes[1]);
    for (const BoundaryFacet& facet : boundary_facets(type)) {
      const int corners = corner_count(facet.type);
      for (int k = 0; k < corners; ++k) measure(nodes[facet.nodes[k]], nodes[facet.nodes[(k + 1) % corners]]);
    }
  }
  return std::isfinite(shortest) ? 1e-3 * shortest : 0.0;
}

std::vector<LinearRelation> uniform(std::span<const int> nodes, Component component, const Origin& origin) {
  std::vector<LinearRelation> relations;
  std::set<int> known;
  for (const int node : nodes) {
    if (!known.insert(node).second || node == nodes.front()) continue;
    relations.push_back({{{node, component, 1.0}, {nodes.front(), component, -1.0}}, 0.0, {}, origin});
  }
  return relations;
}

}  // namespace comma::solver
