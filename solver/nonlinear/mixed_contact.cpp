#include "solver/nonlinear/mixed_contact.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <unordered_set>

#include <fmt/format.h>

#include "solver/contact/box_tree.hpp"
#include "solver/contact/contact_field.hpp"
#include "solver/error.hpp"
#include "solver/nonlinear/failure.hpp"

namespace comma::solver {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

constexpr std::array<Component, 3> translations = {Component::dx, Component::dy, Component::dz};
/// A gap below this share of the face's size counts as closed at the start (CONTACT_INIT='INTERPENETRE').
constexpr double touching = 1e-6;
/// A reduced coefficient below this share of the row's largest is what rounding leaves of an eliminated one.
constexpr double empty_row_tolerance = 1e-12;
/// Imposed displacements may overlap by this share of the face's size.
constexpr double overlap_tolerance = 1e-9;
constexpr int most_condensed_iterations = 200;

double largest_entry(const RowMatrix& rows, int row) {
  double largest = 0.0;
  for (RowMatrix::InnerIterator it(rows, row); it; ++it) largest = std::max(largest, std::abs(it.value()));
  return largest;
}

double size_of(const Mesh& mesh, int cell) {
  Box box;
  for (const int node : mesh.cell(cell)) box.extend(Vector3d(mesh.nodes[node][0], mesh.nodes[node][1], mesh.nodes[node][2]));
  return box.diagonal().norm();
}

ContactLaw law_of(const ContactZone& zone) {
  ContactLaw law;
  law.augmentation = zone.mixed.augmentation;
  law.penalised = zone.mixed.penalised;
  return law;
}

}  // namespace

MixedContact::MixedContact(const ContactDefinition& definition, const Model& model, const DofMap& dofs,
                           const Elimination& elimination, TangentSystem& tangent, Counters& counters, std::vector<int> support)
    : definition_(definition),
      model_(model),
      mesh_(*model.mesh),
      dofs_(dofs),
      elimination_(elimination),
      tangent_(tangent),
      counters_(counters),
      support_(std::move(support)),
      reference_(Eigen::VectorXd::Zero(dofs.size())) {
  number_multipliers();
}

void MixedContact::number_multipliers() {
  for (std::size_t zone = 0; zone < definition_.zones.size(); ++zone) {
    const ContactZone& each = definition_.zones[zone];
    const std::unordered_set<int> excluded(each.excluded_slave_nodes.begin(), each.excluded_slave_nodes.end());
    for (const int node : mesh_.nodes_of_cells(each.slave_cells))
      if (!excluded.contains(node))
        multiplier_numbers_.emplace(Key(static_cast<int>(zone), node), static_cast<int>(multiplier_numbers_.size()));
  }
  problem_.node_count = static_cast<int>(multiplier_numbers_.size());
  problem_.components = 1;
  problem_.max_iterations = most_condensed_iterations;
  state_.multipliers = Eigen::VectorXd::Zero(problem_.node_count * problem_.components);
}

void MixedContact::pair(Positions positions, double time) {
  points_ = contact_points(definition_, model_, positions, time);
  ++counters_.pairings;
  build_rows();
  if (!started_) start_statuses(jumps(reference_));
  started_ = true;
  for (std::size_t p = 0; p < points_.size(); ++p)
    if (problem_.points[p].rows == 0) state_.statuses[p] = ContactStatus::open;
  forces_ = held_forces();
}

CondensedPoint MixedContact::condensed(const ContactPoint& point) const {
  const ContactZone& zone = definition_.zones[static_cast<std::size_t>(point.zone)];
  CondensedPoint result;
  result.weight = point.weight;
  result.law = law_of(zone);
  result.bilateral = zone.mixed.bilateral;
  const auto nodes = mesh_.cell(point.cell);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (point.node >= 0 && nodes[i] != point.node) continue;
    const auto number = multiplier_numbers_.find(Key(point.zone, nodes[i]));
    if (number == multiplier_numbers_.end()) continue;
    result.nodes[static_cast<std::size_t>(result.node_count)] = number->second;
    result.shape[static_cast<std::size_t>(result.node_count++)] = point.node >= 0 ? 1.0 : point.shape[i];
  }
  return result;
}

void MixedContact::add_row(int row, const ContactPoint& point, const Vector3d& direction,
                           std::vector<Eigen::Triplet<double>>& entries) const {
  const auto add = [&](int node, double share) {
    for (int axis = 0; axis < 3; ++axis) {
      if (direction[axis] == 0.0 || share == 0.0) continue;
      const int dof = dofs_.dof(node, translations[axis]);
      if (dof < 0)
        throw Error("unknown-dof",
                    fmt::format("node {} of a contact surface carries no {}", mesh_.node_name(node), name_of(translations[axis])),
                    "the model gives its cells no element: extend AFFE_MODELE, or take the cells out of the contact zone");
      entries.emplace_back(row, dof, share * direction[axis]);
    }
  };
  const auto slave = mesh_.cell(point.cell);
  for (std::size_t i = 0; i < slave.size(); ++i) add(slave[i], point.shape[i]);
  const auto master = mesh_.cell(point.facet);
  for (std::size_t i = 0; i < master.size(); ++i) add(master[i], -point.master_shape[i]);
}

/// Jumps are base + R u: the gap along the normal.
void MixedContact::build_rows() {
  problem_.points.clear();
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<double> base;
  const auto initial = [&](int node) { return Vector3d(mesh_.nodes[node][0], mesh_.nodes[node][1], mesh_.nodes[node][2]); };
  for (const ContactPoint& point : points_) {
    CondensedPoint each = condensed(point);
    if (point.status == PairingStatus::paired) {
      each.first_row = static_cast<int>(base.size());
      each.rows = 1;
      Vector3d apart = Vector3d::Zero();
      const auto slave = mesh_.cell(point.cell);
      for (std::size_t i = 0; i < slave.size(); ++i) apart += point.shape[i] * initial(slave[i]);
      const auto master = mesh_.cell(point.facet);
      for (std::size_t i = 0; i < master.size(); ++i) apart -= point.master_shape[i] * initial(master[i]);
      add_row(each.first_row, point, point.normal, entries);
      base.push_back(point.normal.dot(apart) - point.thickness);
    }
    problem_.points.push_back(each);
  }
  rows_.resize(static_cast<Index>(base.size()), dofs_.size());
  rows_.setFromTriplets(entries.begin(), entries.end());
  base_ = Eigen::Map<const Eigen::VectorXd>(base.data(), static_cast<Index>(base.size()));
  reduced_rows_ = rows_ * RowMatrix(elimination_.transformation());
  settle_blocked_points();
}

/// A point between nodes that are held is open or closed whatever the pressure, which then is anything: it gets none.
void MixedContact::settle_blocked_points() {
  blocked_.clear();
  for (std::size_t p = 0; p < problem_.points.size(); ++p) {
    CondensedPoint& point = problem_.points[p];
    if (point.rows == 0) continue;
    if (largest_entry(reduced_rows_, point.first_row) > empty_row_tolerance * largest_entry(rows_, point.first_row)) continue;
    point.rows = 0;
    blocked_.push_back(p);
  }
}

void MixedContact::check_blocked_points(const Eigen::VectorXd& jumps) const {
  for (const std::size_t p : blocked_) {
    const double gap = jumps[problem_.points[p].first_row];
    if (definition_.zones[static_cast<std::size_t>(points_[p].zone)].mixed.penalised) continue;
    if (gap >= -overlap_tolerance * size_of(mesh_, points_[p].cell)) continue;
    throw Error("contradictory-conditions",
                fmt::format("imposed displacements push slave face {} into facet {} by {:.6g}", mesh_.cell_name(points_[p].cell),
                            mesh_.cell_name(points_[p].facet), -gap),
                "free the nodes along the normal, or take them out of the contact (SANS_GROUP_NO)");
  }
}

void MixedContact::start_statuses(const Eigen::VectorXd& jumps) {
  state_.statuses.assign(points_.size(), ContactStatus::open);
  for (std::size_t p = 0; p < points_.size(); ++p) {
    const CondensedPoint& point = problem_.points[p];
    if (point.rows == 0) continue;
    const InitialContact initial = definition_.zones[static_cast<std::size_t>(points_[p].zone)].mixed.initial;
    const bool touches = jumps[point.first_row] <= touching * size_of(mesh_, points_[p].cell);
    if (initial == InitialContact::all || (initial == InitialContact::interpenetrating && touches))
      state_.statuses[p] = ContactStatus::sliding;
  }
}

/// A body that contact alone holds needs some to begin with.
void MixedContact::close_nearest(const Eigen::VectorXd& jumps) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t p = 0; p < points_.size(); ++p) {
    if (state_.statuses[p] != ContactStatus::open) return;
    if (problem_.points[p].rows > 0) nearest = std::min(nearest, jumps[problem_.points[p].first_row]);
  }
  for (std::size_t p = 0; p < points_.size(); ++p) {
    const CondensedPoint& point = problem_.points[p];
    if (point.rows > 0 && jumps[point.first_row] <= nearest + touching * size_of(mesh_, points_[p].cell))
      state_.statuses[p] = ContactStatus::sliding;
  }
}

/// Forces of the multipliers alone. Any would do for the next correction to start from.
Eigen::VectorXd MixedContact::held_forces() const {
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(rows_.rows());
  for (std::size_t p = 0; p < points_.size(); ++p) {
    const CondensedPoint& point = problem_.points[p];
    if (point.rows == 0 || state_.statuses[p] == ContactStatus::open) continue;
    for (int i = 0; i < point.node_count; ++i)
      forces[point.first_row] += point.weight * point.shape[i] * state_.multipliers[point.nodes[i] * problem_.components];
  }
  return forces;
}

Eigen::VectorXd MixedContact::forces() const { return reduced_rows_.transpose() * forces_; }

/// The rows of the points and those of the springs.
void MixedContact::update_schur() {
  const auto& springs = tangent_.springs();
  std::vector<Eigen::Triplet<double>> entries;
  for (int row = 0; row < reduced_rows_.outerSize(); ++row)
    for (RowMatrix::InnerIterator it(reduced_rows_, row); it; ++it) entries.emplace_back(row, static_cast<int>(it.col()), it.value());
  int next = static_cast<int>(reduced_rows_.rows());
  problem_.springs.clear();
  for (const auto& [unknown, stiffness] : springs) {
    entries.emplace_back(next, unknown, 1.0);
    problem_.springs.push_back({next++, stiffness});
  }
  RowMatrix rows(next, elimination_.reduced_size());
  rows.setFromTriplets(entries.begin(), entries.end());
  if (!schur_ || spring_count_ != springs.size()) {
    std::set<int> support(support_.begin(), support_.end());
    for (const auto& spring : springs) support.insert(spring.first);
    schur_ = std::make_unique<SchurComplement>(
        std::move(rows), [this](Eigen::Ref<Eigen::MatrixXd> columns) { tangent_.solve(columns); },
        std::vector<int>(support.begin(), support.end()));
    spring_count_ = springs.size();
  } else {
    schur_->replace_rows(std::move(rows));
  }
}

void MixedContact::forget() {
  if (schur_) schur_->forget();
}

int MixedContact::correct(const Eigen::VectorXd& before, const Eigen::VectorXd& offset, Eigen::VectorXd& corrected) {
  update_schur();
  const Eigen::VectorXd free = jumps(elimination_.transformation() * corrected + offset);
  check_blocked_points(free);
  const Index point_rows = rows_.rows();
  problem_.free.resize(schur_->size());
  problem_.held = Eigen::VectorXd::Zero(schur_->size());
  problem_.free.head(point_rows) = free;
  problem_.held.head(point_rows) = forces_;
  for (std::size_t k = 0; k < tangent_.springs().size(); ++k) {
    const int unknown = tangent_.springs()[k].first;
    problem_.free[point_rows + static_cast<Index>(k)] = corrected[unknown] - before[unknown];
  }
  if (!problem_.springs.empty()) close_nearest(free);

  const CondensedSolution solution = solve_condensed(*schur_, problem_, state_);
  counters_.contact_iterations += solution.iterations;
  if (solution.verdict == CondensedVerdict::too_many_iterations) throw_condensed_limit(problem_.max_iterations);
  const Eigen::VectorXd change = solution.forces - problem_.held;
  if (change.size() && change.cwiseAbs().maxCoeff() > 0.0) {
    Eigen::MatrixXd push = schur_->rows().transpose() * change;
    tangent_.solve(push);
    corrected += push;
  }
  forces_ = solution.forces.head(point_rows);
  return solution.changes;
}

int MixedContact::closed_count() const {
  return static_cast<int>(std::ranges::count_if(state_.statuses, [](ContactStatus each) { return each != ContactStatus::open; }));
}

void MixedContact::add_multipliers(NodalField& displacements) const {
  const std::size_t before = displacements.components.size();
  const std::size_t nodes = before > 0 ? displacements.values.size() / before : 0;
  std::vector<double> values;
  values.reserve(displacements.values.size() + nodes);
  for (std::size_t node = 0; node < nodes; ++node) {
    const auto first = displacements.values.begin() + static_cast<std::ptrdiff_t>(node * before);
    values.insert(values.end(), first, first + static_cast<std::ptrdiff_t>(before));
    values.push_back(absent);
  }
  displacements.components.emplace_back("LAGS_C");
  displacements.values = std::move(values);
  const auto place = [&](int node) -> double& { return displacements.values[static_cast<std::size_t>(node) * (before + 1) + before]; };
  for (const ContactZone& zone : definition_.zones)
    for (const int node : mesh_.nodes_of_cells(zone.slave_cells)) place(node) = 0.0;
  for (const auto& [key, number] : multiplier_numbers_) place(key.second) -= state_.multipliers[number * problem_.components];
}

NodalField MixedContact::contact_state(const Eigen::VectorXd& u, Positions positions) const {
  const Eigen::VectorXd gaps = jumps(u);
  std::vector<ContactPair> pairs;
  std::vector<double> pair_gaps;
  std::vector<double> pair_forces;
  for (std::size_t p = 0; p < points_.size(); ++p) {
    const ContactPoint& point = points_[p];
    if (point.node < 0) continue;
    ContactPair pair;
    pair.zone = point.zone;
    pair.slave = point.node;
    pair.status = point.status;
    pair.facet = point.facet;
    pair.normal = point.normal;
    pair.foot = point.foot;
    const int row = problem_.points[p].first_row;
    pairs.push_back(pair);
    pair_gaps.push_back(row >= 0 ? gaps[row] : absent);
    pair_forces.push_back(row >= 0 ? forces_[row] : 0.0);
  }
  const Eigen::VectorXd forces = Eigen::Map<const Eigen::VectorXd>(pair_forces.data(), static_cast<Index>(pair_forces.size()));
  return contact_field(pairs, pair_gaps, forces, mesh_.node_count(), positions);
}

}  // namespace comma::solver
