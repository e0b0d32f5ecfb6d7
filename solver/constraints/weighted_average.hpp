// A node that follows the mean rigid motion of others, and gives them its forces (RBE3, R3.03.08).
#pragma once

#include <span>
#include <vector>

#include "solver/loads/load.hpp"
#include "solver/model/model.hpp"

namespace comma::solver {

/// A node whose motion counts in the mean, with the components that count and their weight (> 0). Components that it
/// does not carry do not count.
struct AverageNode {
  int node;
  ComponentMask components;
  double weight = 1.0;
};

/// One relation for each component of `following`: the node `follower` moves as the rigid motion that is nearest to
/// those of `leaders` in the sense of weighted least squares; rotations weigh as displacements at the mean distance of
/// the leaders from the follower. The motion is plane if neither follower nor leaders have DZ. Throws Error
/// `undetermined-average` naming a component that the leaders' motions do not determine (all on one point or line),
/// `invalid-weight` for a weight that is not positive.
std::vector<LinearRelation> weighted_average(const Mesh& mesh, const DofMap& dofs, int follower,
                                             ComponentMask following, std::span<const AverageNode> leaders,
                                             const Origin& origin);

}  // namespace comma::solver
