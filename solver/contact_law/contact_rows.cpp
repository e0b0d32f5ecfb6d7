#include "solver/contact_law/contact_rows.hpp"

#include <algorithm>
#include <unordered_set>

#include "solver/contact/patch_points.hpp"
#include "solver/contact_law/dead_directions.hpp"
#include "solver/error.hpp"
#include "solver/mesh/place.hpp"
#include "solver/mesh/slave_cut.hpp"
#include "solver/unilateral/conditions.hpp"

namespace comma::solver {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

/// Components of normals below it are rounding.
constexpr double least_component = 1e-12;

ContactLaw law_of(const ContactZone& zone) {
  ContactLaw law;
  law.augmentation = zone.mixed.augmentation;
  law.penalised = zone.mixed.penalised;
  law.friction = zone.mixed.friction;
  law.friction_penalised = zone.mixed.friction_penalised;
  law.friction_augmentation = law.friction_penalised ? zone.mixed.friction_penalty : zone.mixed.augmentation;
  return law;
}

/// At nodes SANS_GROUP_NO_FR takes the multiplier away and leaves the augmentation, which is a penalty then (Code_Aster
/// 17.3, which takes it with INTEGRATION='AUTO' alone); elsewhere there is no friction.
void leave_out_friction(const MixedZone& zone, ContactLaw& law) {
  if (zone.rule != ContactRule::automatic) {
    law.friction = 0.0;
  } else if (!zone.friction_penalised) {
    law.friction_penalised = true;
    law.friction_augmentation = zone.friction_augmentation;
  }
}

}  // namespace

ContactRows::ContactRows(const ContactDefinition& definition, const Model& model, const DofMap& dofs,
                         const Elimination& elimination)
    : definition_(definition), model_(model), mesh_(*model.mesh), dofs_(dofs), elimination_(elimination) {
  number_multipliers();
}

void ContactRows::number_multipliers() {
  bool is_solid = false;
  for (const ContactZone& each : definition_.zones)
    for (const int node : mesh_.nodes_of_cells(each.slave_cells)) is_solid |= dofs_.dof(node, Component::dz) >= 0;
  dimension_ = is_solid ? 3 : 2;
  for (std::size_t zone = 0; zone < definition_.zones.size(); ++zone) {
    const ContactZone& each = definition_.zones[zone];
    if (each.mixed.local_average) {
      number_patches(static_cast<int>(zone));
      continue;
    }
    std::unordered_set<int> excluded;
    if (definition_.formulation == ContactFormulation::discrete || !keeps_excluded_pressures(each))
      excluded.insert(each.excluded_slave_nodes.begin(), each.excluded_slave_nodes.end());
    const std::unordered_set<int> frictionless(each.mixed.frictionless_nodes.begin(),
                                               each.mixed.frictionless_nodes.end());
    for (const int node : mesh_.nodes_of_cells(each.slave_cells))
      if (!excluded.contains(node) &&
          multiplier_numbers_.emplace(Key(static_cast<int>(zone), node), static_cast<int>(smooth_.size())).second)
        smooth_.push_back(!(each.mixed.friction > 0.0) ||
                          (frictionless.contains(node) && leaves_out_all_directions(each.mixed)));
  }
}

Eigen::VectorXd ContactRows::with_shares(Eigen::VectorXd multipliers, int components) const {
  visit_shears(components, [&](Eigen::Index pressure, Eigen::Index shear, double friction) {
    const double limit = friction * multipliers[pressure];
    multipliers[shear] = limit != 0.0 ? multipliers[shear] / limit : 0.0;
  });
  return multipliers;
}

bool ContactRows::leaves_out_all_directions(const MixedZone& zone) const {
  if (!zone.frictionless_direction) return true;
  const Eigen::Map<const Vector3d> direction(zone.frictionless_direction->data());
  return dimension_ == 2 && direction.head<2>().norm() > empty_row_tolerance * direction.norm();
}

/// One a patch, at all nodes inside it.
void ContactRows::number_patches(int zone) {
  for (const int patch : patches_of(definition_.zones[static_cast<std::size_t>(zone)], mesh_)) {
    for (const int node : inner_nodes(mesh_, mesh_.slave_patches[static_cast<std::size_t>(patch)]))
      multiplier_numbers_.emplace(Key(zone, node), static_cast<int>(smooth_.size()));
    smooth_.push_back(1);
  }
}

CondensedPoint ContactRows::condensed(const ContactPoint& point) const {
  const ContactZone& zone = definition_.zones[static_cast<std::size_t>(point.zone)];
  CondensedPoint result;
  result.weight = point.weight;
  result.law = law_of(zone);
  result.bilateral = zone.mixed.bilateral;
  const auto excluded = excluded_direction(zone.mixed, point, mesh_);
  if (excluded && leaves_out_all_directions(zone.mixed)) leave_out_friction(zone.mixed, result.law);
  if (result.law.friction > 0.0) result.components = dimension_;
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

void ContactRows::face(Positions positions, double time, double margin) {
  FacedFacets before{{}, margin};
  if (margin > 0.0)
    for (const ContactPoint& point : points_) before.facets.push_back(point.facet);
  points_ = contact_points(definition_, model_, positions, time, before);
}

void ContactRows::add_row(int row, const ContactPoint& point, const Vector3d& direction, RowEntries& entries) const {
  if (!point.shares.empty()) {
    for (const GapShare& share : point.shares) entries.add(row, share.node, share.coefficient);
    return;
  }
  const auto slave = mesh_.cell(point.cell);
  for (std::size_t i = 0; i < slave.size(); ++i) entries.add(row, slave[i], point.shape[i] * direction);
  const auto master = mesh_.cell(point.facet);
  for (std::size_t i = 0; i < master.size(); ++i) entries.add(row, master[i], -point.master_shape[i] * direction);
}

/// As Code_Aster 17.3 has the tangents (multipliers of friction are components along them): from the normal of the
/// point alone, the first across the z axis, along y where the normal is along z.
ContactRows::Directions ContactRows::directions(const ContactPoint& point) const {
  const Vector3d& normal = point.normal;
  if (dimension_ == 2) return {normal, Vector3d(-normal[1], normal[0], 0.0), Vector3d::UnitZ()};
  Vector3d along = Vector3d::UnitY();
  if (std::abs(normal[0]) > least_component)
    along = Vector3d(-normal[1] / normal[0], 1.0, 0.0);
  else if (std::abs(normal[1]) > least_component)
    along = Vector3d(1.0, -normal[0] / normal[1], 0.0);
  along = (along - normal.dot(along) * normal).normalized();
  return {normal, along, normal.cross(along)};
}

/// Along the direction that the user excludes (DIRE_EXCL_FROT), where friction is left along another.
void ContactRows::let_slide(const ContactPoint& point, const Directions& along, CondensedPoint& condensed) const {
  if (dimension_ == 2 || !(condensed.law.friction > 0.0)) return;
  const auto excluded = excluded_direction(definition_.zones[static_cast<std::size_t>(point.zone)].mixed, point, mesh_);
  if (excluded && !excluded->isZero())
    condensed.law.dead = along_tangents(*excluded, along[1], along[2], mesh_.cell_name(point.cell));
}

/// The gap between the initial places of the nodes.
double ContactRows::initial_gap(const ContactPoint& point) const {
  if (!point.shares.empty()) {
    double gap = -point.offset;
    for (const GapShare& share : point.shares) gap += share.coefficient.dot(place(mesh_, share.node));
    return gap;
  }
  Vector3d apart = Vector3d::Zero();
  const auto slave = mesh_.cell(point.cell);
  for (std::size_t i = 0; i < slave.size(); ++i) apart += point.shape[i] * place(mesh_, slave[i]);
  const auto master = mesh_.cell(point.facet);
  for (std::size_t i = 0; i < master.size(); ++i) apart -= point.master_shape[i] * place(mesh_, master[i]);
  return point.normal.dot(apart) - point.thickness;
}

Eigen::VectorXd ContactRows::jumps(const Eigen::VectorXd& u) const {
  if (full_.rows() == 0) return {};
  return base_ + full_ * u;
}

void ContactRows::count_slips(const std::vector<CondensedPoint>& points, const Eigen::VectorXd& reference) {
  if (full_.rows() == 0) return;
  const Eigen::VectorXd before = full_ * reference;
  for (const CondensedPoint& point : points)
    for (int c = 1; c < point.components && point.first_row >= 0; ++c)
      base_[point.first_row + c] = -before[point.first_row + c];
}

std::vector<CondensedPoint> ContactRows::build(const Eigen::VectorXd& reference) {
  std::vector<CondensedPoint> points;
  RowEntries entries(mesh_, dofs_);
  std::vector<double> base;
  for (const ContactPoint& point : points_) {
    CondensedPoint each = condensed(point);
    if (point.status == PairingStatus::paired) {
      each.first_row = static_cast<int>(base.size());
      each.rows = each.components;
      const Directions along = directions(point);
      let_slide(point, along, each);
      for (int c = 0; c < each.rows; ++c)
        add_row(each.first_row + c, point, along[static_cast<std::size_t>(c)], entries);
      base.push_back(initial_gap(point));
      base.resize(base.size() + static_cast<std::size_t>(each.rows - 1), 0.0);
    }
    points.push_back(each);
  }
  full_ = entries.matrix(static_cast<Index>(base.size()));
  base_ = Eigen::Map<const Eigen::VectorXd>(base.data(), static_cast<Index>(base.size()));
  count_slips(points, reference);
  reduced_ = full_ * RowMatrix(elimination_.transformation());
  settle_blocked(points);
  find_dead_directions(reduced_, points);
  return points;
}

/// A point between nodes that are held is open or closed whatever the pressure, which then is anything: it gets none.
void ContactRows::settle_blocked(std::vector<CondensedPoint>& points) {
  blocked_.clear();
  for (std::size_t p = 0; p < points.size(); ++p) {
    CondensedPoint& point = points[p];
    if (point.rows == 0) continue;
    if (largest_entry(reduced_, point.first_row) > empty_row_tolerance * largest_entry(full_, point.first_row))
      continue;
    point.rows = 0;
    blocked_.push_back(p);
  }
}

}  // namespace comma::solver
