#include "solver/constraints/turning_links.hpp"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "solver/constraints/rigid_link.hpp"
#include "solver/error.hpp"
#include "solver/model/deformed_places.hpp"

namespace comma::solver {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Vector3d mean(std::span<const Vector3d> places) {
  Vector3d sum = Vector3d::Zero();
  for (const Vector3d& place : places) sum += place;
  return sum / static_cast<double>(std::max<std::size_t>(places.size(), 1));
}

/// The rotation that takes the one set of arms nearest to the other.
Matrix3d nearest_rotation(std::span<const Vector3d> from, const Vector3d& from_mean, std::span<const Vector3d> to,
                          const Vector3d& to_mean) {
  Matrix3d products = Matrix3d::Zero();
  for (std::size_t i = 0; i < from.size(); ++i) products += (from[i] - from_mean) * (to[i] - to_mean).transpose();
  const Eigen::JacobiSVD<Matrix3d> svd(products, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Matrix3d turn = svd.matrixV() * svd.matrixU().transpose();
  const Matrix3d proper = Vector3d(1.0, 1.0, turn.determinant() < 0.0 ? -1.0 : 1.0).asDiagonal();
  return svd.matrixV() * proper * svd.matrixU().transpose();
}

}  // namespace

TurningLinks::TurningLinks(const Mesh& mesh, const DofMap& dofs, std::span<const RigidLink> links)
    : mesh_(mesh), dofs_(dofs), links_(links) {
  for (const RigidLink& link : links)
    for (const int node : link.nodes)
      if (dofs.dof(node, Component::drx) >= 0 || dofs.dof(node, Component::drz) >= 0)
        throw Error(
            "unsupported",
            fmt::format("node {} of a rigid body in large rotations has rotations of its own", mesh.node_name(node)),
            "leave out TYPE_CHARGE='SUIV' where rotations are small, or join nodes of solids alone");
}

std::vector<Vector3d> TurningLinks::initial_places(const RigidLink& link) const {
  std::vector<Vector3d> places;
  for (const int node : link.nodes) places.emplace_back(mesh_.nodes[static_cast<std::size_t>(node)].data());
  return places;
}

std::vector<Vector3d> TurningLinks::nearest_places(const RigidLink& link, std::span<const Vector3d> initial,
                                                   const Eigen::VectorXd& u) const {
  std::vector<Vector3d> moved(initial.begin(), initial.end());
  for (std::size_t i = 0; i < moved.size(); ++i) moved[i] += displacement_of(link.nodes[i], u, dofs_);
  const Vector3d from = mean(initial), to = mean(moved);
  const Matrix3d turn = nearest_rotation(initial, from, moved, to);
  for (std::size_t i = 0; i < moved.size(); ++i) moved[i] = to + turn * (initial[i] - from);
  return moved;
}

std::vector<LinearRelation> TurningLinks::at(const Eigen::VectorXd& u) const {
  std::vector<LinearRelation> relations;
  for (const RigidLink& link : links_) {
    const std::vector<Vector3d> initial = initial_places(link), places = nearest_places(link, initial, u);
    std::map<int, Vector3d> rigid;
    for (std::size_t i = 0; i < places.size(); ++i) rigid[link.nodes[i]] = places[i] - initial[i];
    for (LinearRelation& relation : rigid_link(mesh_, dofs_, link.nodes, places, link.coincidence, link.origin)) {
      for (const auto& term : relation.terms)
        relation.value += term.coefficient * rigid.at(term.node)[static_cast<int>(term.component)];
      relations.push_back(std::move(relation));
    }
  }
  return relations;
}

double TurningLinks::violation(const Eigen::VectorXd& u) const {
  double largest = 0.0;
  for (const RigidLink& link : links_) {
    const std::vector<Vector3d> initial = initial_places(link), places = nearest_places(link, initial, u);
    const Vector3d centre = mean(initial);
    double size = 0.0, missed = 0.0;
    for (std::size_t i = 0; i < places.size(); ++i) {
      size = std::max(size, (initial[i] - centre).norm());
      missed = std::max(missed, (initial[i] + displacement_of(link.nodes[i], u, dofs_) - places[i]).norm());
    }
    if (size > 0.0) largest = std::max(largest, missed / size);
  }
  return largest;
}

}  // namespace comma::solver
