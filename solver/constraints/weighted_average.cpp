#include "solver/constraints/weighted_average.hpp"

#include <cmath>

#include <fmt/format.h>

#include "solver/constraints/rigid_body_rows.hpp"
#include "solver/error.hpp"

namespace comma::solver {

namespace {

/// Of the scaled normal matrix, whose entries are of order one: eigenvalues below are those of motions that the leaders
/// do not see.
constexpr double unseen_motion = 1e-10;
/// Coefficients this small, of about one in all, are rounding.
constexpr double negligible_in_average = 1e-14;

/// One component of a leader: rotation columns and rows scaled by the mean distance.
struct Sight {
  LinearRelation::Term term;  ///< coefficient: the scale of the component
  double weight;
  Eigen::Matrix<double, 1, 6> row;
};

struct Leaders {
  double distance = 0.0;  ///< mean distance from the follower
  bool in_space = false;
  std::vector<Sight> sights;
};

Eigen::Vector3d lever(const Mesh& mesh, int follower, int node) {
  return Eigen::Vector3d(mesh.nodes[node].data()) - Eigen::Vector3d(mesh.nodes[follower].data());
}

Leaders look_at(const Mesh& mesh, const DofMap& dofs, int follower, std::span<const AverageNode> nodes) {
  Leaders leaders;
  leaders.in_space = contains(dofs.components(follower), Component::dz);
  for (const AverageNode& leader : nodes) {
    if (!(leader.weight > 0.0)) {
      throw Error("invalid-weight", fmt::format("the weight of node {} in an average is {}, but it must be positive",
                                                mesh.node_name(leader.node), leader.weight));
    }
    leaders.distance += lever(mesh, follower, leader.node).norm() / static_cast<double>(nodes.size());
    leaders.in_space = leaders.in_space || contains(dofs.components(leader.node), Component::dz);
  }
  if (!(leaders.distance > 0.0)) leaders.distance = 1.0;
  double total = 0.0;
  for (const AverageNode& leader : nodes) total += leader.weight;
  for (const AverageNode& leader : nodes) {
    for (int c = 0; c < motion_count; ++c) {
      const auto component = static_cast<Component>(c);
      if (!contains(leader.components & dofs.components(leader.node), component)) continue;
      const double scale = c < 3 ? 1.0 : leaders.distance;
      leaders.sights.push_back({{leader.node, component, scale},
                                leader.weight / total,
                                rigid_body_row(component, lever(mesh, follower, leader.node) / leaders.distance)});
    }
  }
  return leaders;
}

/// The motions that count, as rows of the six.
std::vector<int> motions(bool in_space) { return in_space ? std::vector{0, 1, 2, 3, 4, 5} : std::vector{0, 1, 5}; }

/// Inverse of the normal matrix on the motions that the leaders see.
struct NormalMatrix {
  Eigen::MatrixXd inverse;
  Eigen::MatrixXd unseen;  ///< orthonormal columns
};

NormalMatrix normal_matrix(const Leaders& leaders, const std::vector<int>& kept) {
  Eigen::Matrix<double, 6, 6> sum = Eigen::Matrix<double, 6, 6>::Zero();
  for (const Sight& sight : leaders.sights) sum += sight.weight * sight.row.transpose() * sight.row;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(Eigen::MatrixXd(sum(kept, kept)));
  const auto size = static_cast<Eigen::Index>(kept.size());
  Eigen::Index unseen = 0;
  while (unseen < size && eigen.eigenvalues()[unseen] < unseen_motion) ++unseen;
  const Eigen::MatrixXd seen = eigen.eigenvectors().rightCols(size - unseen);
  return {seen * eigen.eigenvalues().tail(size - unseen).cwiseInverse().asDiagonal() * seen.transpose(),
          eigen.eigenvectors().leftCols(unseen)};
}

}  // namespace

std::vector<LinearRelation> weighted_average(const Mesh& mesh, const DofMap& dofs, int follower,
                                             ComponentMask following, std::span<const AverageNode> nodes,
                                             const Origin& origin) {
  const Leaders leaders = look_at(mesh, dofs, follower, nodes);
  const std::vector<int> kept = motions(leaders.in_space);
  const NormalMatrix normal = normal_matrix(leaders, kept);
  std::vector<LinearRelation> relations;
  for (int c = 0; c < motion_count; ++c) {
    const auto component = static_cast<Component>(c);
    if (!contains(following, component)) continue;
    const auto at = std::find(kept.begin(), kept.end(), c);
    const auto row = at - kept.begin();
    if (at == kept.end() || normal.unseen.row(row).norm() > std::sqrt(unseen_motion)) {
      throw Error(
          "undetermined-average",
          fmt::format("{} of node {} does not follow from the motions of the {} nodes that it is to follow",
                      name_of(component), mesh.node_name(follower), nodes.size()),
          "let more nodes or components count, nodes that do not lie on one line, or leave that component free");
    }
    const double scale = c < 3 ? 1.0 : leaders.distance;
    LinearRelation relation{{{follower, component, 1.0}}, 0.0, {}, origin};
    for (const Sight& sight : leaders.sights) {
      const double share = sight.weight * sight.row(kept).dot(normal.inverse.row(row));
      if (std::abs(share) < negligible_in_average) continue;
      relation.terms.push_back({sight.term.node, sight.term.component, -share * sight.term.coefficient / scale});
    }
    relations.push_back(std::move(relation));
  }
  return relations;
}

}  // namespace comma::solver
