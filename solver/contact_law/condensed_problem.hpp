// The mixed problem of contact on its own rows: what is left when the bodies are condensed.
#pragma once

#include <array>
#include <limits>
#include <vector>

#include <Eigen/Dense>

#include "solver/contact/facet.hpp"
#include "solver/contact_law/contact_law.hpp"
#include "solver/contact_law/interpolated_step.hpp"
#include "solver/contact_law/near_inverse.hpp"
#include "solver/unilateral/active_set.hpp"

namespace comma::solver {

/// A point of the condensed system. Its jumps (gap, slips) are `rows` consecutive rows of the Schur complement.
struct CondensedPoint {
  int first_row = -1;
  int rows = 0;                              ///< as many as components; 0: nothing can touch it
  int components = 1;                        ///< of its traction: 1 without friction, 2 or 3 with it
  std::array<int, max_facet_nodes> nodes{};  ///< of the multipliers
  std::array<double, max_facet_nodes> shape{};
  int node_count = 0;
  double weight = 0.0;
  ContactLaw law;
  double stiffness = 0.0;  ///< of the bodies at a point on a node (a pressure a length): what penalties are stiffer by,
                           ///< multipliers bring; 0: not known, and penalties bring all
  /// Positive: shears are shares of the limit of friction, and this one's augmentation or penalty, a unit of length
  /// (see shared_friction.hpp).
  double share_augmentation = 0.0;
  bool bilateral = false;      ///< once closed it stays closed
  double idle_friction = 0.0;  ///< Coulomb's coefficient where conditions hold both bodies along the surface: such
                               ///< friction moves nothing, and the law has none

  /// How many components of multipliers its law says something of: without friction the pressure alone, and shears of
  /// its nodes are what other points have there.
  int law_components() const { return law.friction > 0.0 ? components : 1; }
};

/// A row whose force is `stiffness` times its own jump: springs that were added to the bodies come off again with it.
struct CondensedSpring {
  int row = -1;
  double stiffness = 0.0;
};

/// What earlier searches for shares of friction say about the next (see shared_friction.hpp): the search from nowhere
/// in particular, which is long, comes first where it was what found the last solution, and is left out the longer, the
/// oftener it has failed in a row.
struct ShareSearch {
  bool found_last = false;
  int failures = 0, left_out = 0;
};

/// A body that contact alone is to hold is lost when it has moved by so many sizes of the mesh.
inline constexpr double farthest_motion = 1e3;

/// Find multipliers and jumps d with
///     d = free + S (w t(multiplier, d) - held),     sum over points of w N_i r(multiplier, d) = 0 for each node i,
/// t and r being traction and residual of the law at the points, S the compliance of the rows.
struct CondensedProblem {
  std::vector<CondensedPoint> points;
  std::vector<CondensedSpring> springs;
  Eigen::VectorXd free;   ///< jumps that go with the forces `held` (a length a row)
  Eigen::VectorXd held;   ///< forces on the rows
  Eigen::VectorXd begin;  ///< jumps that Newton's method begins with, near those of the solution: the free ones may be
                          ///< far away, since a body that contact alone holds hardly resists; empty: the free ones
  double displacement = 0.0;  ///< the largest (a length): what its rounding makes of jumps is nothing
  /// Jumps beyond are those of bodies that nothing holds (a length).
  double farthest = std::numeric_limits<double>::infinity();
  int node_count = 0;
  int components = 1;        ///< of a multiplier: 1, 2 or 3
  std::vector<char> smooth;  ///< one a node: whether its shear vanishes; empty: nowhere by itself
  int max_iterations = 200;  ///< of each attempt
  int direct_rows = 900;  ///< more unknown rows are solved for by products with S, where points lie on nodes and jumps
                          ///< alone bring no force of a penalty (solver/contact_law/nodal_step.hpp)
  /// The same where points lie between nodes: a direct system has all jumps and multipliers there, one by products the
  /// multipliers alone (solver/contact_law/interpolated_step.hpp).
  int direct_rows_between = 200;
  int most_products = 150;  ///< a system
  /// Where products lead nowhere, no more rows than these are solved for directly (a few seconds, 900 MB).
  int most_direct_rows = 6000;
  bool indefinite = false;  ///< S may be: no active-set method on it
  bool one_step = false;    ///< the law is solved as it is with the statuses given, which stay
  /// Multipliers to begin with where there is friction, besides those of the state; empty: none.
  Eigen::VectorXd expected;
  NearInverse* near_inverse = nullptr;  ///< of systems solved by products, if they are to begin from each other
  /// Of those whose points lie between nodes, if one is to serve them all.
  InterpolatedSolver* interpolated_solver = nullptr;
  ShareSearch* share_search = nullptr;  ///< of shares of friction, if searches are to learn from each other
  ActiveSetMemory* memory = nullptr;    ///< of solutions without friction, if they are to begin from each other

  bool is_smooth(int node) const { return !smooth.empty() && smooth[static_cast<std::size_t>(node)] != 0; }
  int multiplier_index(int node, int component) const { return node * components + component; }
  /// Calls visit(index of the multiplier) for all that the law of a point says something of.
  template <typename Visit>
  void visit_multipliers(const CondensedPoint& point, const Visit& visit) const {
    for (int i = 0; i < point.node_count; ++i)
      for (int c = 0; c < (is_smooth(point.nodes[static_cast<std::size_t>(i)]) ? 1 : point.law_components()); ++c)
        visit(multiplier_index(point.nodes[static_cast<std::size_t>(i)], c));
  }
};

struct CondensedState {
  Eigen::VectorXd multipliers;          ///< node_count * components: pressure, then shear
  std::vector<ContactStatus> statuses;  ///< one a point: the start, then the solution
};

/// Jumps that Newton's method begins with.
const Eigen::VectorXd& first_jumps(const CondensedProblem& problem);

bool has_penalty(const CondensedProblem& problem);

/// At a point, from the multipliers of its nodes; zero beyond the components of the problem.
Eigen::Vector3d multiplier_at(const CondensedProblem& problem, const CondensedState& state,
                              const CondensedPoint& point);

/// What rows have, jumps or forces, at a point; zero beyond its own rows.
Eigen::Vector3d at_point(const CondensedPoint& point, const Eigen::VectorXd& on_rows);

/// The rows along which the law of a point resists, as combinations of its own: the normal, and where there is friction
/// its tangents, or the one across its dead direction. One a row, on `point.rows`.
Eigen::MatrixXd resisting_rows(const CondensedPoint& point);

/// How far a point slips where the rows have these jumps, along its dead direction aside (that is a part of the gap
/// along a surface that lies askew); 0 without friction.
double slip_of(const CondensedPoint& point, const Eigen::VectorXd& jumps);

/// Multipliers that points between nodes take part of, or several points of a node, whose normals differ: there the law
/// holds in the mean alone, and the augmentation is in the solution. One a multiplier.
std::vector<char> shared_multipliers(const CondensedProblem& problem);

/// What the multipliers alone put on the rows (`rows` of them) of closed points.
Eigen::VectorXd multiplier_forces(const CondensedProblem& problem, const CondensedState& state, Eigen::Index rows);

}  // namespace comma::solver
