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
using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Entries = std::vector<Eigen::Triplet<double>>;
using SparseColumns = Eigen::SparseMatrix<double>;

/// A dense system of so many unknowns takes half a second.
constexpr Index most_unknowns = 2000;
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

/// What is not negative, rounded off by e (Chen, Harker, Kanzow, Smale): max(0, x) where e vanishes. `beyond`: by how
/// much it exceeds x, `flatness`: one less the slope, neither of which rounding takes away however small it is;
/// `curvature`: the derivative of the slope.
struct PositivePart {
  double value = 0.0, slope = 1.0, beyond = 0.0, flatness = 0.0, curvature = 0.0;
  static PositivePart of(double x, double e) {
    const double root = std::sqrt(x * x + 4.0 * e * e);
    const double large = 0.5 * (std::abs(x) + root), small = e * e / large;
    PositivePart part;
    part.value = x >= 0.0 ? large : small;
    part.beyond = x >= 0.0 ? small : large;
    part.slope = part.value / root;
    part.flatness = part.beyond / root;
    part.curvature = 2.0 * part.slope * part.flatness / root;
    return part;
  }
};

/// a^(1 - share) b^share.
double blend(double a, double b, double share) { return share > 0.0 ? a * std::pow(b / a, share) : a; }

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
    if (size() == 0 || size() > most_unknowns) return false;
    take_compliance();
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
  int multiplier_index(int node, int component) const { return node * problem_.components + component; }
  bool is_smooth(int node) const { return !problem_.smooth.empty() && problem_.smooth[static_cast<std::size_t>(node)]; }
  int row_of(const CondensedPoint& point, int component) const {
    return numbers_[static_cast<std::size_t>(point.first_row + component)];
  }
  int unknown_of(int node, int component) const {
    return multiplier_unknowns_[static_cast<std::size_t>(multiplier_index(node, component))];
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
      for (int i = 0; i < point.node_count && point.rows > 0; ++i) {
        node_weights_[point.nodes[i]] += point.weight * std::abs(point.shape[i]);
        for (int c = 0; c < (is_smooth(point.nodes[i]) ? 1 : point.components); ++c)
          multiplier_unknowns_[static_cast<std::size_t>(multiplier_index(point.nodes[i], c))] = 0;
      }
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
    compliance_.resize(rows(), rows());
    for (Index k = 0; k < rows(); ++k) compliance_.col(k) = chosen(schur_.column(rows_[static_cast<std::size_t>(k)]));
    free_ = chosen(problem_.free - schur_.times(problem_.held));
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
      for (int c = 0; c < point.rows; ++c) (c == 0 ? normal : along) += compliance_(row_of(point, c), row_of(point, c));
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

  /// A penalty is a law with a multiplier all the same, by which a gap is closed but for what the penalty gives way:
  /// however stiff, it does no harm.
  static double share_of_multiplier(bool penalised, double stiffness, double penalty) {
    return penalised ? 1.0 - stiffness / penalty : 1.0;
  }

  double normal_stiffness(std::size_t p) const {
    const ContactLaw& law = problem_.points[p].law;
    return law.penalised ? bodies_[p].normal : blend(bodies_[p].normal, law.augmentation, law_share_);
  }

  double stiffness_along(std::size_t p) const {
    const ContactLaw& law = problem_.points[p].law;
    return law.friction_penalised ? bodies_[p].along
                                  : blend(bodies_[p].along, law.friction_augmentation, law_share_along_);
  }

  double rounding() const { return largest_ * std::pow(10.0, -decade_); }

  double trial_pressure(std::size_t p, const Vector3d& multiplier, const Vector3d& jump) const {
    const double stiffness = normal_stiffness(p);
    return share_of_multiplier(problem_.points[p].law.penalised, stiffness, problem_.points[p].law.augmentation) *
               multiplier[0] -
           stiffness * jump[0];
  }

  Vector2d trial_shear(std::size_t p, const Vector3d& multiplier, const Vector3d& jump) const {
    const double stiffness = stiffness_along(p);
    return share_of_multiplier(problem_.points[p].law.friction_penalised, stiffness,
                               problem_.points[p].law.friction_augmentation) *
               multiplier.tail<2>() +
           stiffness * jump.tail<2>();
  }

  bool stays_closed(std::size_t p) const {
    return problem_.points[p].bilateral && state_.statuses[p] != ContactStatus::open;
  }

  /// The law at a point, and by how much what is left of it counts as a length: gaps and slips by themselves, tractions
  /// by what the bodies give way under them.
  struct SmoothLaw : ContactLawValue {
    double counts = 1.0, counts_along = 1.0;
  };

  static double count_of(double closed, double stiffness, double of_bodies) {
    return closed + (1.0 - closed) * std::min(1.0, stiffness / of_bodies);
  }

  /// contact_law() without statuses.
  SmoothLaw law(std::size_t p, const Vector3d& multiplier, const Vector3d& jump) const {
    ContactLaw law = problem_.points[p].law;
    SmoothLaw value = live_law(p, live_part(law, multiplier), live_part(law, jump));
    law.friction_augmentation = bodies_[p].along;
    leave_out_dead(law, multiplier, value);
    return value;
  }

  SmoothLaw live_law(std::size_t p, const Vector3d& multiplier, const Vector3d& jump) const {
    const CondensedPoint& point = problem_.points[p];
    const double stiffness = normal_stiffness(p),
                 by_multiplier = share_of_multiplier(point.law.penalised, stiffness, point.law.augmentation);
    const double trial = trial_pressure(p, multiplier, jump);
    // That a pressure times a gap is the square of the rounding over the stiffness does not depend on the augmentation.
    const PositivePart pressure = stays_closed(p)
                                      ? PositivePart{.value = trial}
                                      : PositivePart::of(trial, rounding() * std::sqrt(stiffness / bodies_[p].normal));
    const double softness = point.law.penalised ? 1.0 / point.law.augmentation : 0.0;
    SmoothLaw result;
    result.traction[0] = pressure.value;
    result.traction_by_multiplier(0, 0) = by_multiplier * pressure.slope;
    result.traction_by_jump(0, 0) = -stiffness * pressure.slope;
    result.residual[0] = trial >= 0.0 ? pressure.beyond / stiffness - jump[0] - softness * multiplier[0]
                                      : (pressure.value - multiplier[0]) / stiffness;
    result.residual_by_multiplier(0, 0) = -pressure.flatness / stiffness - softness * pressure.slope;
    result.residual_by_jump(0, 0) = -pressure.slope;
    result.counts = count_of(pressure.slope, stiffness, bodies_[p].normal);
    if (point.rows > 1) add_shear(p, pressure, multiplier, jump, result);
    return result;
  }

  struct Shear {
    Vector2d value = Vector2d::Zero(), by_limit = Vector2d::Zero();
    Matrix2d by_trial = Matrix2d::Zero(), by_trial_missing = Matrix2d::Identity();  ///< and what is missing from one
    double missing = 1.0;  ///< share of the trial that is cut off
    double sticks = 0.0;
  };

  /// limit / max(|trial|, limit) of the trial, rounded off by e.
  static Shear shear_of(const Vector2d& trial, double limit, double e) {
    Shear shear;
    if (!(limit > 0.0)) return shear;
    const double size = trial.norm();
    const PositivePart beyond = PositivePart::of(size - limit, e);
    const double most = limit + beyond.value, share = limit / most;
    Matrix2d along = Matrix2d::Zero();
    if (size > 0.0) along = share / most * beyond.slope / size * trial * trial.transpose();
    shear.value = share * trial;
    shear.missing = beyond.value / most;
    shear.sticks = beyond.flatness;
    shear.by_trial = share * Matrix2d::Identity() - along;
    shear.by_trial_missing = shear.missing * Matrix2d::Identity() + along;
    shear.by_limit = (1.0 / most - limit / (most * most) * beyond.flatness) * trial;
    return shear;
  }

  void add_shear(std::size_t p, const PositivePart& pressure, const Vector3d& multiplier, const Vector3d& jump,
                 SmoothLaw& result) const {
    const ContactLaw& law = problem_.points[p].law;
    const double stiffness = stiffness_along(p),
                 softness = law.friction_penalised ? 1.0 / law.friction_augmentation : 0.0;
    const PositivePart limiting = PositivePart::of(multiplier[0], rounding());
    const bool by_shares = law.share_pressure > 0.0;
    const double limit = law.friction * (by_shares ? law.share_pressure : limiting.value);
    const Shear shear = shear_of(trial_shear(p, multiplier, jump), limit,
                                 law.friction * rounding() * std::sqrt(stiffness / bodies_[p].along));
    // By shares the shear is that of a pressure that is given, times the present one over it.
    const double present = by_shares ? limiting.value / law.share_pressure : 1.0;
    const Vector2d by_pressure = by_shares ? Vector2d(limiting.slope / law.share_pressure * shear.value)
                                           : Vector2d(law.friction * limiting.slope * shear.by_limit);
    result.traction.tail<2>() = -present * shear.value;
    result.traction_by_multiplier.bottomRightCorner<2, 2>() =
        -present * share_of_multiplier(law.friction_penalised, stiffness, law.friction_augmentation) * shear.by_trial;
    result.traction_by_multiplier.bottomLeftCorner<2, 1>() = -by_pressure;
    result.traction_by_jump.bottomRightCorner<2, 2>() = -present * stiffness * shear.by_trial;
    result.counts_along = count_of(shear.sticks, stiffness, bodies_[p].along);

    const double weight = law.friction_penalised ? 1.0 : present;
    const Vector2d left = (1.0 - shear.missing) * (jump.tail<2>() - softness * multiplier.tail<2>()) -
                          shear.missing / stiffness * multiplier.tail<2>();
    result.residual.tail<2>() = weight * left;
    result.residual_by_multiplier.bottomRightCorner<2, 2>() =
        -weight * (shear.by_trial_missing / stiffness + softness * shear.by_trial);
    result.residual_by_jump.bottomRightCorner<2, 2>() = weight * shear.by_trial;
    if (!by_shares)
      result.residual_by_multiplier.bottomLeftCorner<2, 1>() = by_pressure / stiffness;
    else if (!law.friction_penalised)
      result.residual_by_multiplier.bottomLeftCorner<2, 1>() = limiting.slope / law.share_pressure * left;
    if (!on_nodes_) let_open_shears_vanish(p, pressure, multiplier, result);
  }

  /// Between nodes a point may be open where the pressure of its nodes is not zero: it bears no shear all the same.
  void let_open_shears_vanish(std::size_t p, const PositivePart& pressure, const Vector3d& multiplier,
                              SmoothLaw& result) const {
    const ContactLaw& law = problem_.points[p].law;
    const double stiffness = normal_stiffness(p),
                 by_multiplier = share_of_multiplier(law.penalised, stiffness, law.augmentation);
    const Vector2d vanishing = -multiplier.tail<2>() / stiffness_along(p);
    const Vector2d residual_by_trial = pressure.curvature * (result.residual.tail<2>() - vanishing),
                   traction_by_trial = pressure.curvature * result.traction.tail<2>();
    result.traction.tail<2>() *= pressure.slope;
    result.residual.tail<2>() = pressure.slope * result.residual.tail<2>() + pressure.flatness * vanishing;
    for (Eigen::Matrix3d* derivative : {&result.traction_by_multiplier, &result.traction_by_jump,
                                        &result.residual_by_multiplier, &result.residual_by_jump})
      derivative->bottomRows<2>() *= pressure.slope;
    result.residual_by_multiplier.bottomRightCorner<2, 2>() -=
        pressure.flatness / stiffness_along(p) * Matrix2d::Identity();
    result.traction_by_multiplier.bottomLeftCorner<2, 1>() += by_multiplier * traction_by_trial;
    result.traction_by_jump.bottomLeftCorner<2, 1>() -= stiffness * traction_by_trial;
    result.residual_by_multiplier.bottomLeftCorner<2, 1>() += by_multiplier * residual_by_trial;
    result.residual_by_jump.bottomLeftCorner<2, 1>() -= stiffness * residual_by_trial;
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
    const Eigen::VectorXd by_forces = compliance_.topRows(unknown_rows_) * now.forces;
    now.counts.head(unknown_rows_).setOnes();
    now.left.head(unknown_rows_) = unknowns_.head(unknown_rows_) - free_.head(unknown_rows_) - by_forces;
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
    now.jumps = free_ + compliance_ * now.forces;
    now.jumps.head(unknown_rows_) = unknowns_.head(unknown_rows_);
  }

  void add_point(std::size_t p, Equations& now) const {
    const CondensedPoint& point = problem_.points[p];
    const SmoothLaw value = law(p, multiplier(point), jump(point, now.jumps));
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

  Eigen::MatrixXd derivative(const Equations& now) const {
    const SparseColumns forces_by = sparse(rows(), size(), now.forces_by),
                        laws_by_jump = sparse(size(), rows(), now.laws_by_jump);
    const Eigen::MatrixXd jumps_by = compliance_ * forces_by;
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(size(), size());
    result.topRows(unknown_rows_) = -jumps_by.topRows(unknown_rows_);
    for (Index k = 0; k < unknown_rows_; ++k) result(k, k) += 1.0;
    result += sparse(size(), size(), now.laws_by_unknown);
    if (on_nodes_)
      result += laws_by_jump * jumps_by;
    else
      result.leftCols(rows()) += laws_by_jump;
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
      const Eigen::VectorXd step = solve_dense(derivative(now), now.left), before = unknowns_;
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
        state_.statuses[p] = status(p, multiplier(problem_.points[p]), jump(problem_.points[p], jumps));
  }

  ContactStatus status(std::size_t p, const Vector3d& multiplier, const Vector3d& jump) const {
    if (!stays_closed(p) && trial_pressure(p, multiplier, jump) <= 0.0) return ContactStatus::open;
    const ContactLaw& law = problem_.points[p].law;
    const double pressure = law.share_pressure > 0.0 ? law.share_pressure : multiplier[0];
    const bool sticks =
        problem_.points[p].rows > 1 && law.friction > 0.0 &&
        trial_shear(p, live_part(law, multiplier), live_part(law, jump)).norm() <= law.friction * pressure;
    return sticks ? ContactStatus::sticking : ContactStatus::sliding;
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
  Eigen::MatrixXd compliance_;
  Eigen::VectorXd free_, unknowns_;
  double largest_ = 0.0, scale_ = 0.0;              ///< of pressures and of jumps
  double decade_ = 0.0;                             ///< of the rounding pressure, beneath the largest one
  double law_share_ = 0.0, law_share_along_ = 0.0;  ///< of the augmentations, beside those of the bodies
  int used_ = 0, total_ = 0;
};

}  // namespace

bool smooth_condensed(SchurComplement& schur, const CondensedProblem& problem, CondensedState& state,
                      Eigen::VectorXd& jumps, std::vector<PointStiffness>& stiffness, Augmentations augmentations) {
  return Smoothing(schur, problem, state, jumps, stiffness, augmentations).run();
}

}  // namespace comma::solver
