#include "solver/contact/patch_points.hpp"

#include <array>
#include <cmath>
#include <map>
#include <unordered_map>

#include <fmt/format.h>

#include "solver/contact/face_rule.hpp"
#include "solver/contact/facet_overlap.hpp"
#include "solver/contact/facet_search.hpp"
#include "solver/error.hpp"
#include "solver/mesh/slave_cut.hpp"

namespace comma::solver {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// A patch of which less than this share faces the master is open: what rounding leaves at an edge would not bear a pressure.
constexpr double covered_tolerance = 1e-9;

/// A facet's nodes, where they are.
struct Gathered {
  CellType type = CellType::seg2;
  std::array<Vector3d, max_facet_nodes> points;
  std::array<Vector3d, max_facet_nodes> normals;
  std::size_t count = 0;
  bool is_smooth = false;
  Vector3d centre = Vector3d::Zero();
  double radius = 0.0;

  FacetGeometry geometry() const { return {type, {points.data(), count}, {normals.data(), is_smooth ? count : 0}}; }
};

class PatchGaps {
 public:
  PatchGaps(const ContactDefinition& definition, int zone, const Model& model, Positions positions, double time)
      : zone_(definition.zones[static_cast<std::size_t>(zone)]), index_(zone), model_(model), mesh_(*model.mesh), positions_(positions), time_(time) {
    if (definition.smooth_normals) slave_normals_ = nodal_normals(mesh_, zone_.slave_cells, positions);
    for (const int cell : zone_.master_cells) masters_.push_back(gather(cell));
  }

  ContactPoint point_of(const std::vector<int>& patch) {
    point_ = ContactPoint();
    point_.zone = index_;
    point_.cell = patch.front();
    point_.node = inner_nodes(mesh_, patch).front();
    sums_.clear();
    for (const int face : patch) add_face(face);
    if (point_.weight <= covered_tolerance * point_.area) {
      point_.weight = 0.0;
      return point_;
    }
    point_.status = PairingStatus::paired;
    for (const auto& [node, sum] : sums_) point_.shares.push_back({node, sum / point_.weight});
    point_.thickness /= point_.weight;
    point_.normal.normalize();
    return point_;
  }

 private:
  Gathered gather(int cell) const {
    Gathered facet;
    facet.type = mesh_.cell_types[cell];
    facet.is_smooth = !slave_normals_.empty();
    for (const int node : mesh_.cell(cell)) {
      facet.points[facet.count] = positions_[node];
      if (const auto known = slave_normals_.find(node); known != slave_normals_.end()) facet.normals[facet.count] = known->second;
      facet.centre += positions_[node];
      ++facet.count;
    }
    facet.centre /= static_cast<double>(facet.count);
    for (std::size_t i = 0; i < facet.count; ++i) facet.radius = std::max(facet.radius, (facet.points[i] - facet.centre).norm());
    return facet;
  }

  void add_face(int face) {
    const Gathered slave = gather(face);
    for (const FacePoint& at : face_rule(slave.type, ContactRule::gauss, area_order)) point_.area += at.weight * stretch(face, at.xi);
    for (std::size_t m = 0; m < masters_.size(); ++m) {
      if (!may_overlap(slave, masters_[m])) continue;
      const auto common = facet_overlap(slave.geometry(), {masters_[m].type, {masters_[m].points.data(), masters_[m].count}, {}});
      for (const OverlapPoint& each : common) add(face, slave, zone_.master_cells[m], masters_[m], each);
    }
  }

  /// Normals of a slave face may lean: what lies within the facets' sizes of the line through the face's centre is looked at.
  static bool may_overlap(const Gathered& slave, const Gathered& master) {
    const Vector3d normal = normal_at(slave.geometry(), facet_centre(slave.type));
    const Vector3d apart = master.centre - slave.centre;
    const double along = normal.dot(apart);
    const double lean = slave.is_smooth ? std::abs(along) : 0.0;
    return (apart - along * normal).norm() <= 2.0 * (slave.radius + master.radius) + lean;
  }

  void add(int face, const Gathered& slave, int facet, const Gathered& master, const OverlapPoint& at) {
    const FacetGeometry geometry = slave.geometry();
    const Vector3d here = point_at(geometry, at.slave);
    const Vector3d foot = point_at({master.type, {master.points.data(), master.count}, {}}, at.master);
    const Vector3d normal = -normal_at(geometry, at.slave);
    if (zone_.pairing_distance >= 0.0 && std::abs(normal.dot(here - foot)) > zone_.pairing_distance) return;
    const double area = at.weight * stretch(face, at.slave);
    const FacetShape ours = facet_shape(slave.type, at.slave);
    const FacetShape theirs = facet_shape(master.type, at.master);
    const auto slave_nodes = mesh_.cell(face);
    const auto master_nodes = mesh_.cell(facet);
    for (std::size_t i = 0; i < slave_nodes.size(); ++i) sum_at(slave_nodes[i]) += area * ours.values[i] * normal;
    for (std::size_t i = 0; i < master_nodes.size(); ++i) sum_at(master_nodes[i]) -= area * theirs.values[i] * normal;
    point_.weight += area;
    point_.thickness += area * thickness_at(zone_, here, foot, time_);
    point_.normal += area * normal;
    point_.facet = facet;
  }

  Vector3d& sum_at(int node) { return sums_.try_emplace(node, Vector3d::Zero()).first->second; }

  /// Initial area a unit of the reference cell's, times the radius where axisymmetric: pressures are forces over the area before
  /// deformation.
  double stretch(int face, const Vector2d& xi) const { return initial_stretch(model_, face, xi); }

  static constexpr int area_order = 4;
  const ContactZone& zone_;
  int index_;
  const Model& model_;
  const Mesh& mesh_;
  Positions positions_;
  double time_;
  std::unordered_map<int, Vector3d> slave_normals_;
  std::vector<Gathered> masters_;
  ContactPoint point_;
  std::map<int, Vector3d> sums_;
};

}  // namespace

std::vector<int> patches_of(const ContactZone& zone, const Mesh& mesh) {
  std::unordered_map<int, int> patch_of;
  for (std::size_t p = 0; p < mesh.slave_patches.size(); ++p)
    for (const int face : mesh.slave_patches[p]) patch_of.emplace(face, static_cast<int>(p));
  std::vector<int> patches;
  std::map<int, std::size_t> found;  // patch: how many of its faces are slave
  for (const int face : zone.slave_cells) {
    const auto known = patch_of.find(face);
    if (known == patch_of.end())
      throw Error("no-patch", fmt::format("the slave face {} belongs to no patch", mesh.cell_name(face)),
                  "cut the slave faces with CREA_MAILLAGE(DECOUPE_LAC=_F(GROUP_MA_ESCL=...)) before the model is made");
    if (found[known->second]++ == 0) patches.push_back(known->second);
  }
  for (const auto& [patch, count] : found)
    if (count != mesh.slave_patches[static_cast<std::size_t>(patch)].size())
      throw Error("no-patch", fmt::format("not all pieces of the patch of slave face {} belong to the zone",
                                          mesh.cell_name(mesh.slave_patches[static_cast<std::size_t>(patch)].front())),
                  "take the group of slave faces that was cut");
  return patches;
}

void append_patch_points(const ContactDefinition& definition, int zone, const Model& model, Positions positions, double time,
                         std::vector<ContactPoint>& points) {
  PatchGaps gaps(definition, zone, model, positions, time);
  for (const int patch : patches_of(definition.zones[static_cast<std::size_t>(zone)], *model.mesh))
    points.push_back(gaps.point_of(model.mesh->slave_patches[static_cast<std::size_t>(patch)]));
}

}  // namespace comma::solver
