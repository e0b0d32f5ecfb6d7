#include "solver/contact_law/smoothed_contact.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Sparse>

#include "solver/contact_law/nodal_step.hpp"
#include "solver/linear/dense_solve.hpp"
#include "solver/linear/largest_component.hpp"

namespace comma::solver {
namespace {

using Eigen::Index;
using Eigen::Vector3d;
using Entries = std::vector<Eigen::Triplet<double>>;
using SparseColumns = Eigen::SparseMatrix<double>;

/// A dense system of so many unknowns takes half a second; one on what the rows of many points between nodes touch a
/// tenth.
constexpr Index most_unknowns = 2000, most_unknowns_between = 1000;
/// Of Newton's method: for one rounding, for all, and so few that the next step may be larger.
constexpr int most_iterations_once = 20;
constexpr int most_iterations = 300;
constexpr int few_iterations = 5;
/// Decades by which the rounding pressure lies below the largest pressure: at last on nodes, at last between them,
/// where small augmentations tell pressures from gaps less well, and while augmentations change.
constexpr double last_decade = 9.0, last_decade_between = 13.0, decade_of_change = 3.0;
/// Steps in decades, and in the share of the law in the augmentations; each may become twice as long, or shorter by so
/// much.
constexpr double decade_step = 1.0, share_step = 0.1;
constexpr double least_step_share = 1e-2;
/// What may be left of the equations, as a share of what the rounding pressure moves, and of the jumps.
constexpr double left_share = 1e-2;
constexpr double least_left = 1e-13;
/// Or this share of the jumps, where no correction brings it down.
constexpr double stagnant_left = 1e-7;
/// The scale of jumps is at least this share of the largest displacement.
constexpr double rounding_scale = 1e-6;
/// A share of a correction has to bring what is left down by this much of itself; the least one.
constexpr double least_decrease = 1e-4;
constexpr double least_share = 1.0 / 256.0;

class Smoothing {
 public:
  Smoothing(SchurComplement& schur, const CondensedProblem& problem, CondensedState& state, Eigen::VectorXd& jumps,
            std::vector<PointStiffness>& stiffness, Augmentations augmentations)
      : schur_(schur),
        problem_(problem),
        state_(state),
        found_jumps_(jumps),
        bodies_(stiffness),
        augmentations_(augmentations),
        on_nodes_(has_points_on_nodes(problem)) {}

  bool run() {
    number_unknowns();
    if (size() == 0) return false;
    take_compliance();
    if (is_too_large()) return false;
    take_stiffness();
    largest_ = largest_pressure();
    scale_ = std::max(largest_component(free_), rounding_scale * problem_.displacement);
    if (!(largest_ > 0.0) || !(scale_ > 0.0)) return false;
    start();
    if (!solve()) return false;
    if (!on_nodes_ && !take_augmentations()) return false;
    if (!advance(decade_, on_nodes_ ? last_decade : last_decade_between, decade_step)) return false;
    finish();
    return true;
  }

 private:
  bool take_augmentations() {
    return advance(decade_, decade_of_change, decade_step) && advance(law_share_, 1.0, share_step) &&
           (augmentations_ == Augmentations::of_pressures || advance(law_share_along_, 1.0, share_step));
  }

  Index rows() const { return static_cast<Index>(rows_.size()); }
  Index size() const { return unknown_rows_ + multipliers_; }
  int row_of(const CondensedPoint& point, int component) const {
    return numbers_[static_cast<std::size_t>(point.first_row + component)];
  }
  int unknown_of(int node, int component) const {
    return multiplier_unknowns_[static_cast<std::size_t>(problem_.multiplier_index(node, component))];
  }

  void add_row(int row) {
    numbers_[static_cast<std::size_t>(row)] = static_cast<int>(rows_.size());
    rows_.push_back(row);
  }

  /// Springs come first. Between nodes all jumps are unknowns, on nodes those of springs alone: the others follow from
  /// the multipliers.
  void number_unknowns() {
    node_weights_ = Eigen::VectorXd::Zero(problem_.node_count);
    numbers_.assign(static_cast<std::size_t>(schur_.size()), -1);
    multiplier_unknowns_.assign(static_cast<std::size_t>(problem_.node_count * problem_.components), -1);
    for (const CondensedSpring& spring : problem_.springs) add_row(spring.row);
    const Index springs = rows();
    for (const CondensedPoint& point : problem_.points) {
      for (int c = 0; c < point.rows; ++c) add_row(point.first_row + c);
      if (point.rows == 0) continue;
      for (int i = 0; i < point.node_count; ++i)
        node_weights_[point.nodes[i]] += point.weight * std::abs(point.shape[i]);
      problem_.visit_multipliers(
          point, [this](int multiplier) { multiplier_unknowns_[static_cast<std::size_t>(multiplier)] = 0; });
    }
    unknown_rows_ = on_nodes_ ? springs : rows();
    for (int& unknown : multiplier_unknowns_)
      if (unknown == 0) unknown = static_cast<int>(unknown_rows_ + multipliers_++);
  }

  void take_compliance() {
    std::vector<int> needed = rows_;
    for (Index row = 0; row < problem_.held.size(); ++row)
      if (problem_.held[row] != 0.0) needed.push_back(static_cast<int>(row));
    schur_.require(needed);
    free_ = chosen(problem_.free - schur_.times(problem_.held));
  }

  bool is_too_large() const {
    if (size() <= most_unknowns) return false;
    const Eigen::MatrixXd* compliance = on_nodes_ ? nullptr : schur_.kept_compliance();
    return compliance == nullptr || compliance->rows() + multipliers_ > most_unknowns_between;
  }

  /// S f on the rows.
  Eigen::VectorXd moved_by(const Eigen::VectorXd& forces) const {
    Eigen::VectorXd all = Eigen::VectorXd::Zero(schur_.size());
    all(rows_) = forces;
    return chosen(schur_.times(all));
  }

  template <typename Vector>
  Eigen::VectorXd chosen(const Vector& all) const {
    Eigen::VectorXd result(rows());
    for (Index k = 0; k < rows(); ++k) result[k] = all[rows_[static_cast<std::size_t>(k)]];
    return result;
  }

  void take_stiffness() {
    bodies_.assign(problem_.points.size(), {});
    for (std::size_t p = 0; p < bodies_.size(); ++p) {
      const CondensedPoint& point = problem_.points[p];
      double normal = point.law.penalised ? 1.0 / (point.weight * point.law.augmentation) : 0.0;
      double along = point.law.friction_penalised ? 1.0 / (point.weight * point.law.friction_augmentation) : 0.0;
      for (int c = 0; c < point.rows; ++c) (c == 0 ? normal : along) += schur_.own(point.first_row + c);
      bodies_[p].normal = normal > 0.0 ? 1.0 / (point.weight * normal) : point.law.augmentation;
      bodies_[p].along = along > 0.0 ? 1.0 / (point.weight * along) : point.law.friction_augmentation;
    }
  }

  double largest_pressure() const {
    double largest = 0.0;
    for (std::size_t p = 0; p < bodies_.size(); ++p) {
      const CondensedPoint& point = problem_.points[p];
      if (point.rows == 0) continue;
      largest =
          std::max({largest, -bodies_[p].normal * free_[row_of(point, 0)], multiplier_at(problem_, state_, point)[0],
                    std::abs(problem_.held[point.first_row]) / point.weight});
    }
    return largest;
  }

  void start() {
    unknowns_ = Eigen::VectorXd::Zero(size());
    unknowns_.head(unknown_rows_) = free_.head(unknown_rows_);
    for (std::size_t i = 0; i < multiplier_unknowns_.size(); ++i)
      if (multiplier_unknowns_[i] >= 0) unknowns_[multiplier_unknowns_[i]] = state_.multipliers[static_cast<Index>(i)];
  }

  Vector3d multiplier(const CondensedPoint& point) const {
    Vector3d value = Vector3d::Zero();
    for (int i = 0; i < point.node_count; ++i)
      for (int c = 0; c < problem_.components; ++c)
        if (const int unknown = unknown_of(point.nodes[i], c); unknown >= 0)
          value[c] += point.shape[i] * unknowns_[unknown];
    return value;
  }

  Vector3d jump(const CondensedPoint& point, const Eigen::VectorXd& jumps) const {
    Vector3d value = Vector3d::Zero();
    for (int c = 0; c < point.rows; ++c) value[c] = jumps[row_of(point, c)];
    return value;
  }

  double rounding() const { return largest_ * std::pow(10.0, -decade_); }

  SmoothedLaw law(std::size_t p) const {
    const CondensedPoint& point = problem_.points[p];
    return {point.law,
            bodies_[p],
            {.pressure = rounding(),
             .law_share = law_share_,
             .law_share_along = law_share_along_,
             .stays_closed = stays_closed(p),
             .rubs = point.rows > 1 && point.law_components() > 1,
             .on_node = on_nodes_}};
  }

  bool stays_closed(std::size_t p) const {
    return problem_.points[p].bilateral && state_.statuses[p] != ContactStatus::open;
  }

  /// The equations at the present unknowns: forces on rows with their derivative by the unknowns, jumps, and what is
  /// left of the laws with its derivatives by multipliers and jumps.
  struct Equations {
    Eigen::VectorXd forces, jumps, left, counts;
    Entries forces_by{}, laws_by_unknown{}, laws_by_jump{};
  };

  Equations equations() const {
    Equations now{.forces = Eigen::VectorXd::Zero(rows()),
                  .jumps = free_,
                  .left = Eigen::VectorXd::Zero(size()),
                  .counts = Eigen::VectorXd::Zero(size())};
    for (std::size_t s = 0; s < problem_.springs.size(); ++s) {
      const auto row = static_cast<int>(s);
      now.forces[row] = problem_.springs[s].stiffness * unknowns_[row];
      now.forces_by.emplace_back(row, row, problem_.springs[s].stiffness);
    }
    if (on_nodes_)
      add_nodal_forces(now);
    else
      now.jumps = unknowns_.head(rows());
    for (std::size_t p = 0; p < bodies_.size(); ++p)
      if (problem_.points[p].rows > 0) add_point(p, now);
    now.counts.head(unknown_rows_).setOnes();
    now.left.head(unknown_rows_) = unknowns_.head(unknown_rows_) - free_.head(unknown_rows_);
    if (unknown_rows_ > 0) now.left.head(unknown_rows_) -= moved_by(now.forces).head(unknown_rows_);
    return now;
  }

  /// There the multipliers are the tractions.
  void add_nodal_forces(Equations& now) const {
    for (const CondensedPoint& point : problem_.points)
      for (int c = 0; c < point.rows; ++c) {
        const int unknown = unknown_of(point.nodes[0], c);
        if (unknown < 0) continue;
        const double weight = (c == 0 ? 1.0 : -1.0) * point.weight * point.shape[0];
        now.forces[row_of(point, c)] += weight * unknowns_[unknown];
        now.forces_by.emplace_back(row_of(point, c), unknown, weight);
      }
    now.jumps = free_ + moved_by(now.forces);
    now.jumps.head(unknown_rows_) = unknowns_.head(unknown_rows_);
  }

  void add_point(std::size_t p, Equations& now) const {
    const CondensedPoint& point = problem_.points[p];
    const SmoothedLawValue value = law(p).at(multiplier(point), jump(point, now.jumps));
    for (int a = 0; a < point.rows && !on_nodes_; ++a) {
      const int row = row_of(point, a);
      now.forces[row] += point.weight * value.traction[a];
      for (int b = 0; b < point.rows; ++b)
        now.forces_by.emplace_back(row, row_of(point, b), point.weight * value.traction_by_jump(a, b));
      add_by_multipliers(point, row, point.weight * value.traction_by_multiplier.row(a), now.forces_by);
    }
    for (int i = 0; i < point.node_count; ++i)
      for (int a = 0; a < point.rows; ++a) {
        const int equation = unknown_of(point.nodes[i], a);
        if (equation < 0) continue;
        const double weight = point.weight * point.shape[i] / node_weights_[point.nodes[i]];
        now.left[equation] += weight * value.residual[a];
        now.counts[equation] += std::abs(weight) * (a == 0 ? value.counts : value.counts_along);
        for (int b = 0; b < point.rows; ++b)
          now.laws_by_jump.emplace_back(equation, row_of(point, b), weight * value.residual_by_jump(a, b));
        add_by_multipliers(point, equation, weight * value.residual_by_multiplier.row(a), now.laws_by_unknown);
      }
  }

  void add_by_multipliers(const CondensedPoint& point, int equation, const Eigen::RowVector3d& derivative,
                          Entries& entries) const {
    for (int i = 0; i < point.node_count; ++i)
      for (int b = 0; b < point.rows; ++b)
        if (const int unknown = unknown_of(point.nodes[i], b); unknown >= 0)
          entries.emplace_back(equation, unknown, point.shape[i] * derivative[b]);
  }

  static SparseColumns sparse(Index height, Index width, const Entries& entries) {
    SparseColumns result(height, width);
    result.setFromTriplets(entries.begin(), entries.end());
    return result;
  }

  Eigen::VectorXd correction(const Equations& now) {
    if (on_nodes_) return solve_dense(derivative(now), now.left);
    InterpolatedStep step(rows_, static_cast<int>(size()));
    for (const auto& each : now.forces_by) step.add_force_derivative(each.row(), each.col(), each.value());
    for (const Entries* laws : {&now.laws_by_unknown, &now.laws_by_jump})
      for (const auto& each : *laws) step.add_law_derivative(each.row(), each.col(), each.value());
    for (Index law = unknown_rows_; law < size(); ++law) step.add_law_weight(static_cast<int>(law), 1.0);
    return solver_.solve(step, schur_, now.left);
  }

  /// Of springs and multipliers on nodes, from which jumps follow.
  Eigen::MatrixXd derivative(const Equations& now) const {
    const SparseColumns forces_by = sparse(rows(), size(), now.forces_by),
                        laws_by_jump = sparse(size(), rows(), now.laws_by_jump);
    const Eigen::MatrixXd jumps_by = schur_.responses(rows_, forces_by).whole();
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(size(), size());
    result.topRows(unknown_rows_) = -jumps_by.topRows(unknown_rows_);
    for (Index k = 0; k < unknown_rows_; ++k) result(k, k) += 1.0;
    result += sparse(size(), size(), now.laws_by_unknown);
    result += laws_by_jump * jumps_by;
    return result;
  }

  /// Newton's method for one rounding; each correction is halved until less is left. Counts its iterations.
  bool solve() {
    const double enough = scale_ * std::max(left_share * rounding() / largest_, least_left);
    used_ = 0;
    Equations now = equations();
    for (; used_ < most_iterations_once && total_ < most_iterations; ++used_, ++total_) {
      const Eigen::VectorXd counts = now.counts, counted = counts.cwiseProduct(now.left);
      if (!counted.allFinite()) return false;
      if (largest_component(counted) <= enough) return true;
      const Eigen::VectorXd step = correction(now), before = unknowns_;
      const double left = counted.norm();
      for (double share = 1.0;; share *= 0.5) {
        if (share < least_share) {
          unknowns_ = before;
          return left <= stagnant_left * scale_;
        }
        unknowns_ = before - share * step;
        now = equations();
        if (now.left.cwiseProduct(counts).norm() < (1.0 - least_decrease * share) * left) break;
      }
    }
    return false;
  }

  /// Brings a parameter to a value in steps as long as solutions lead to each other.
  bool advance(double& parameter, double target, double usual_step) {
    for (double step = usual_step; parameter < target;) {
      const Eigen::VectorXd before = unknowns_;
      const double reached = parameter;
      parameter = std::min(target, reached + step);
      if (solve()) {
        if (used_ <= few_iterations) step = std::min(2.0 * step, 2.0 * usual_step);
        continue;
      }
      unknowns_ = before;
      parameter = reached;
      step *= 0.5;
      if (step < least_step_share * usual_step || total_ >= most_iterations) return false;
    }
    return true;
  }

  void finish() {
    const Eigen::VectorXd jumps = equations().jumps;
    for (Index k = 0; k < rows(); ++k) found_jumps_[rows_[static_cast<std::size_t>(k)]] = jumps[k];
    for (std::size_t i = 0; i < multiplier_unknowns_.size(); ++i)
      state_.multipliers[static_cast<Index>(i)] =
          multiplier_unknowns_[i] >= 0 ? unknowns_[multiplier_unknowns_[i]] : 0.0;
    for (std::size_t p = 0; p < bodies_.size(); ++p)
      if (problem_.points[p].rows > 0)
        state_.statuses[p] = law(p).status(multiplier(problem_.points[p]), jump(problem_.points[p], jumps));
  }

  SchurComplement& schur_;
  const CondensedProblem& problem_;
  CondensedState& state_;
  Eigen::VectorXd& found_jumps_;
  std::vector<PointStiffness>& bodies_;
  const Augmentations augmentations_;
  const bool on_nodes_;
  std::vector<int> rows_, numbers_;  ///< rows of the Schur complement that count, and their numbers among these, or -1
  std::vector<int> multiplier_unknowns_;
  Eigen::VectorXd node_weights_;  ///< by which laws at a node are divided, to be lengths
  Index unknown_rows_ = 0, multipliers_ = 0;
  Eigen::VectorXd free_, unknowns_;
  double largest_ = 0.0, scale_ = 0.0;              ///< of pressures and of jumps
  double decade_ = 0.0;                             ///< of the rounding pressure, beneath the largest one
  double law_share_ = 0.0, law_share_along_ = 0.0;  ///< of the augmentations, beside those of the bodies
  int used_ = 0, total_ = 0;
  InterpolatedSolver solver_;
};

}  // namespace

bool smooth_condensed(SchurComplement& schur, const CondensedProblem& problem, CondensedState& state,
                      Eigen::VectorXd& jumps, std::vector<PointStiffness>& stiffness, Augmentations augmentations) {
  return Smoothing(schur, problem, state, jumps, stiffness, augmentations).run();
}

}  // namespace comma::solver
