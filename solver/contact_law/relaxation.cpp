#include "solver/contact_law/relaxation.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "solver/linear/largest_component.hpp"

namespace comma::solver {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr int most_sweeps = 2000;
/// Entries of the compliance that all of them may take together (about a minute).
constexpr double most_entries = 5e10;
/// Sweeps end when forces change by less than this share of the largest: statuses then are those of the solution.
constexpr double force_tolerance = 1e-7;
/// At one point.
constexpr int most_relaxation_turns = 100;
constexpr double turn_tolerance = 1e-10;
/// A point that gives way less than this share of what the softest one does is held by conditions on displacements.
constexpr double held_compliance = 1e-9;

class Relaxation {
 public:
  Relaxation(SchurComplement& schur, const CondensedProblem& problem, CondensedState& state)
      : schur_(schur),
        problem_(problem),
        state_(state),
        forces_(Eigen::VectorXd::Zero(problem.free.size())),
        jumps_(problem.free) {}

  Eigen::VectorXd run() {
    start();
    const double rows = static_cast<double>(forces_.size());
    const int sweeps = static_cast<int>(std::min<double>(most_sweeps, most_entries / std::max(1.0, rows * rows)));
    for (int sweep = 0; sweep < sweeps; ++sweep) {
      double change = 0.0;
      for (std::size_t p = 0; p < problem_.points.size(); ++p) change = std::max(change, visit(p));
      for (const CondensedSpring& spring : problem_.springs) visit(spring);
      if (change <= force_tolerance * largest_component(forces_)) break;
    }
    take_multipliers();
    for (std::size_t p = 0; p < problem_.points.size(); ++p) clean_jumps(p);
    return jumps_;
  }

 private:
  void start() {
    std::vector<int> rows;
    for (const CondensedPoint& point : problem_.points)
      for (int c = 0; c < point.rows; ++c) rows.push_back(point.first_row + c);
    for (const CondensedSpring& spring : problem_.springs) rows.push_back(spring.row);
    for (Index row = 0; row < problem_.held.size(); ++row)
      if (problem_.held[row] != 0.0) rows.push_back(static_cast<int>(row));
    schur_.require(rows);
    for (const CondensedPoint& point : problem_.points)
      if (point.rows > 0)
        largest_compliance_ = std::max(largest_compliance_, schur_.column(point.first_row)[point.first_row]);
    for (Index row = 0; row < problem_.held.size(); ++row)
      if (problem_.held[row] != 0.0) jumps_ -= problem_.held[row] * schur_.column(static_cast<int>(row));
    for (const CondensedPoint& point : problem_.points)
      for (int c = 0; c < point.rows; ++c) add_force(point.first_row + c, problem_.held[point.first_row + c]);
  }

  void add_force(int row, double change) {
    if (change == 0.0) return;
    forces_[row] += change;
    jumps_ += change * schur_.column(row);
  }

  /// The compliance of a point's own rows, penalties apart.
  Matrix3d own_compliance(const CondensedPoint& point) const {
    Matrix3d own = Matrix3d::Zero();
    for (int a = 0; a < point.rows; ++a)
      for (int b = 0; b < point.rows; ++b) own(a, b) = schur_.column(point.first_row + b)[point.first_row + a];
    return own;
  }

  /// As if the point could not move along its dead direction, where no force is sought.
  Matrix3d live_compliance(const CondensedPoint& point) const {
    Matrix3d live = Matrix3d::Identity();
    live.bottomRightCorner<2, 2>() = live_directions(point.law);
    return live * own_compliance(point) * live;
  }

  double visit(std::size_t p) {
    const CondensedPoint& point = problem_.points[p];
    if (point.rows == 0) return 0.0;
    const Matrix3d own = live_compliance(point);
    if (!(own(0, 0) > held_compliance * largest_compliance_)) return 0.0;
    Vector3d present = Vector3d::Zero();
    Vector3d others = Vector3d::Zero();
    for (int c = 0; c < point.rows; ++c) {
      present[c] = forces_[point.first_row + c];
      others[c] = jumps_[point.first_row + c];
    }
    present = live_part(point.law, present);
    others = live_part(point.law, others) - own * present;
    const bool stays_closed = point.bilateral && state_.statuses[p] != ContactStatus::open;
    const Vector3d wanted = local_force(point, own, others, present, stays_closed, state_.statuses[p]);
    double change = 0.0;
    for (int c = 0; c < point.rows; ++c) {
      change = std::max(change, std::abs(wanted[c] - forces_[point.first_row + c]));
      add_force(point.first_row + c, wanted[c] - forces_[point.first_row + c]);
    }
    return change;
  }

  /// As it stands now: solved for, the force would have no bound where contact has not yet taken the body's weight.
  void visit(const CondensedSpring& spring) {
    add_force(spring.row, spring.stiffness * jumps_[spring.row] - forces_[spring.row]);
  }

  static Vector3d local_force(const CondensedPoint& point, const Matrix3d& own, const Vector3d& others,
                              const Vector3d& present, bool stays_closed, ContactStatus& status) {
    const ContactLaw& law = point.law;
    const double normal = own(0, 0) + (law.penalised ? 1.0 / (point.weight * law.augmentation) : 0.0);
    status = ContactStatus::open;
    if (!(normal > 0.0) || (others[0] >= 0.0 && !stays_closed)) return Vector3d::Zero();
    if (point.rows == 1) {
      status = ContactStatus::sliding;
      return {-others[0] / normal, 0.0, 0.0};
    }
    const Vector3d stuck = sticking_force(point, own, normal, others);
    status = ContactStatus::sticking;
    if (stuck[0] > 0.0 && stuck.tail<2>().norm() <= law.friction * stuck[0]) return stuck;
    status = ContactStatus::sliding;
    return sliding_force(point, own, normal, others, present);
  }

  static Vector3d sticking_force(const CondensedPoint& point, const Matrix3d& own, double normal,
                                 const Vector3d& others) {
    Matrix3d matrix = own;
    matrix(0, 0) = normal;
    matrix.bottomRightCorner<2, 2>() += own.trace() * point.law.dead * point.law.dead.transpose();
    if (point.law.friction_penalised)
      for (int c = 1; c < point.rows; ++c) matrix(c, c) += 1.0 / (point.weight * point.law.friction_augmentation);
    Vector3d force = Vector3d::Zero();
    force.head(point.rows) = -matrix.topLeftCorner(point.rows, point.rows).fullPivLu().solve(others.head(point.rows));
    return force;
  }

  /// Projections on the cone of friction of what would undo the jump (De Saxce and Feng, Mathematical and Computer
  /// Modelling 28, 1998), which come to rest at the law of Coulomb.
  static Vector3d sliding_force(const CondensedPoint& point, Matrix3d own, double normal, const Vector3d& others,
                                Vector3d force) {
    own(0, 0) = normal;
    if (point.law.friction_penalised)
      for (int c = 1; c < point.rows; ++c) own(c, c) += 1.0 / (point.weight * point.law.friction_augmentation);
    const double friction = point.law.friction;
    const double stiffness = 1.0 / own.trace();
    for (int turn = 0; turn < most_relaxation_turns; ++turn) {
      Vector3d jump = others + own * force;
      jump[0] += friction * jump.tail<2>().norm();
      const Vector3d next = on_cone(force - stiffness * jump, friction);
      const double change = (next - force).norm();
      force = next;
      if (change <= turn_tolerance * force.norm()) break;
    }
    return force;
  }

  static Vector3d on_cone(const Vector3d& force, double friction) {
    const double shear = force.tail<2>().norm();
    if (shear <= friction * force[0]) return force;
    if (friction * shear <= -force[0]) return Vector3d::Zero();
    Vector3d result;
    result[0] = (force[0] + friction * shear) / (1.0 + friction * friction);
    result.tail<2>() = friction * result[0] / shear * force.tail<2>();
    return result;
  }

  /// Jumps that the law gives at once are differences of far larger ones: the law knows them better.
  void clean_jumps(std::size_t p) {
    const CondensedPoint& point = problem_.points[p];
    if (state_.statuses[p] == ContactStatus::open || point.rows == 0) return;
    const auto by_penalty = [&](int row, double augmentation) { return -forces_[row] / (point.weight * augmentation); };
    jumps_[point.first_row] = point.law.penalised ? by_penalty(point.first_row, point.law.augmentation) : 0.0;
    if (state_.statuses[p] != ContactStatus::sticking) return;
    Vector3d jump = Vector3d::Zero();
    jump.head(point.rows) = jumps_.segment(point.first_row, point.rows);
    const Vector3d dead = jump - live_part(point.law, jump);
    for (int c = 1; c < point.rows; ++c) {
      const int row = point.first_row + c;
      jumps_[row] = dead[c] + (point.law.friction_penalised ? by_penalty(row, point.law.friction_augmentation) : 0.0);
    }
  }

  void take_multipliers() {
    state_.multipliers.setZero();
    for (const CondensedPoint& point : problem_.points) {
      if (point.node_count == 0) continue;
      const int first = point.nodes[0] * problem_.components;
      for (int c = 0; c < point.rows; ++c)
        state_.multipliers[first + c] = (c == 0 ? 1.0 : -1.0) * forces_[point.first_row + c] / point.weight;
    }
  }

  SchurComplement& schur_;
  const CondensedProblem& problem_;
  CondensedState& state_;
  double largest_compliance_ = 0.0;
  Eigen::VectorXd forces_;
  Eigen::VectorXd jumps_;
};

}  // namespace

bool relax_condensed(SchurComplement& schur, const CondensedProblem& problem, CondensedState& state,
                     Eigen::VectorXd& jumps) {
  const bool on_nodes = std::ranges::all_of(
      problem.points, [](const CondensedPoint& point) { return point.rows == 0 || point.node_count == 1; });
  if (!on_nodes) return false;
  jumps = Relaxation(schur, problem, state).run();
  return true;
}

}  // namespace comma::solver
