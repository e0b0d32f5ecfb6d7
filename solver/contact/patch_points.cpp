#include "solver/contact/patch_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <span>
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

/// A patch of which less than this share faces the master is open: what rounding leaves at an edge would not bear a
/// pressure.
constexpr double covered_tolerance = 1e-9;

/// A facet's nodes where they are and, where normals are smoothed, the outward normals of the cells around them.
struct Gathered {
  CellType type = CellType::seg2;
  std::array<Vector3d, max_facet_nodes> points;
  std::array<Vector3d, max_facet_nodes> normals;
  std::size_t count = 0;
  bool is_smooth = false;
  Vector3d centre = Vector3d::Zero();
  double radius = 0.0;

  FacetGeometry geometry() const { return {type, span()}; }
  std::span<const Vector3d> span() const { return {points.data(), count}; }
};

/// The facets of a surface at one moment.
class Surface {
 public:
  Surface(const Mesh& mesh, std::span<const int> cells, Positions positions, bool is_smooth)
      : mesh_(mesh), positions_(positions), is_smooth_(is_smooth) {
    if (is_smooth) normals_ = nodal_normals(mesh, cells, positions);
  }

  Gathered gather(int cell) const {
    Gathered facet;
    facet.type = mesh_.cell_types[cell];
    facet.is_smooth = is_smooth_;
    for (const int node : mesh_.cell(cell)) {
      facet.points[facet.count++] = positions_[node];
      facet.centre += positions_[node];
    }
    facet.centre /= static_cast<double>(facet.count);
    const auto nodes = mesh_.cell(cell);
    for (std::size_t i = 0; i < facet.count; ++i) {
      facet.radius = std::max(facet.radius, (facet.points[i] - facet.centre).norm());
      if (is_smooth_) facet.normals[i] = normals_.at(nodes[i]);
    }
    return facet;
  }

 private:
  const Mesh& mesh_;
  Positions positions_;
  bool is_smooth_;
  std::unordered_map<int, Vector3d> normals_;
};

/// What a slave face may face. Where it is curved its normals lean: what lies within the facets' sizes of the line
/// through the face's centre is looked at.
class Reach {
 public:
  explicit Reach(const Gathered& slave)
      : slave_(slave), normal_(facet_normal(slave.type, slave.span(), facet_centre(slave.type))) {}

  bool has(const Gathered& master) const {
    const Vector3d apart = master.centre - slave_.centre;
    const double along = normal_.dot(apart);
    const double lean = node_count(slave_.type) > corner_count(slave_.type) ? std::abs(along) : 0.0;
    return (apart - along * normal_).norm() <= 2.0 * (slave_.radius + master.radius) + lean;
  }

 private:
  const Gathered& slave_;
  const Vector3d normal_;
};

class PatchGaps {
 public:
  PatchGaps(const ContactDefinition& definition, int zone, const Model& model, Positions positions, double time)
      : zone_(definition.zones[static_cast<std::size_t>(zone)]),
        index_(zone),
        mesh_(*model.mesh),
        positions_(positions),
        time_(time),
        is_axisymmetric_(is_axisymmetric(model.formulations[zone_.slave_cells.front()])),
        slaves_(mesh_, zone_.slave_cells, positions, definition.smooth_normals) {
    const Surface masters(mesh_, zone_.master_cells, positions, definition.smooth_normals);
    for (const int cell : zone_.master_cells) masters_.push_back(masters.gather(cell));
    if (zone_.pairing_distance >= 0.0) search_.emplace(zone_, false, mesh_, positions);
  }

  ContactPoint point_of(const std::vector<int>& patch) {
    point_ = ContactPoint();
    point_.zone = index_;
    point_.cell = patch.front();
    point_.node = inner_nodes(mesh_, patch).front();
    sums_.clear();
    gaps_ = area_ = faced_area_ = 0.0;
    const bool is_far = search_ && search_->too_far(positions_[point_.node]);
    for (const int face : patch) add_face(face, is_far);
    // Beyond the axis nothing has an area.
    if (point_.weight <= covered_tolerance * point_.area || !(area_ > 0.0)) {
      point_.weight = 0.0;
      if (is_far) point_.status = PairingStatus::too_far;
      return point_;
    }
    point_.status = PairingStatus::paired;
    point_.area = faced_area_;
    for (const auto& [node, sum] : sums_) point_.shares.push_back({node, sum / point_.weight});
    for (const GapShare& share : point_.shares) point_.offset += share.coefficient.dot(positions_[share.node]);
    point_.offset -= gaps_ / area_;
    point_.normal.normalize();
    return point_;
  }

 private:
  void add_face(int face, bool is_far) {
    const Gathered slave = slaves_.gather(face);
    double own = 0.0;
    for (const FacePoint& at :
         face_rule(slave.type, ContactRule::gauss, corner_count(slave.type) == 3 ? triangle_order : line_order))
      own += at.weight * stretch(face, slave, at.xi);
    point_.area += own;
    if (is_far) return;
    const Reach reach(slave);
    bool faces_any = false;
    for (std::size_t m = 0; m < masters_.size(); ++m)
      faces_any |= reach.has(masters_[m]) && add_overlap(face, slave, zone_.master_cells[m], masters_[m]);
    if (faces_any) faced_area_ += own;
  }

  /// Whether there is any.
  bool add_overlap(int face, const Gathered& slave, int facet, const Gathered& master) {
    const FacetOverlap overlap = facet_overlap(slave.geometry(), master.geometry());
    for (const OverlapPoint& at : overlap.points) {
      const Vector3d here = point_at(slave.geometry(), at.slave);
      const Vector3d foot = point_at(master.geometry(), at.master);
      const Vector3d normal = -normal_at(slave.geometry(), at.slave);
      const double area = at.weight * facet_stretch(slave.type, slave.span(), at.slave, is_axisymmetric_);
      gaps_ += area * (normal.dot(here - foot) - thickness_at(zone_, here, time_));
      area_ += area;
      point_.normal += area * normal;
      point_.facet = facet;
      const double pressed = at.weight * stretch(face, slave, at.slave);
      point_.weight += pressed;
      add_shares(face, slave, at.slave, -pressed);
    }
    for (const FacePoint& at : overlap.master)
      add_shares(facet, master, at.xi, -at.weight * stretch(facet, master, at.xi));
    return !overlap.points.empty();
  }

  /// Of the area over which the pressure acts.
  double stretch(int cell, const Gathered& facet, const Vector2d& xi) const {
    return zone_.mixed.present_areas ? facet_stretch(facet.type, facet.span(), xi, is_axisymmetric_)
                                     : initial_stretch(mesh_, cell, xi, is_axisymmetric_);
  }

  /// Adds what the gap takes of a facet's nodes where they move along outward normals.
  void add_shares(int cell, const Gathered& facet, const Vector2d& xi, double factor) {
    const auto nodes = mesh_.cell(cell);
    const FacetShape shape = facet_shape(facet.type, xi);
    const Vector3d own = facet.is_smooth ? Vector3d(Vector3d::Zero()) : normal_at(facet.geometry(), xi);
    for (std::size_t i = 0; i < nodes.size(); ++i)
      sums_.try_emplace(nodes[i], Vector3d::Zero()).first->second +=
          factor * shape.values[i] * (facet.is_smooth ? facet.normals[i] : own);
  }

  /// Of the rules that areas of faces come by, as Code_Aster's figures have them.
  static constexpr int line_order = 3, triangle_order = 4;
  const ContactZone& zone_;
  int index_;
  const Mesh& mesh_;
  Positions positions_;
  double time_;
  bool is_axisymmetric_;
  Surface slaves_;
  std::vector<Gathered> masters_;
  std::optional<FacetSearch> search_;  ///< for the pairing distance
  ContactPoint point_;
  std::map<int, Vector3d> sums_;
  double gaps_ = 0.0, area_ = 0.0;  ///< of the patch's part that faces the master, as it is now
  double faced_area_ = 0.0;         ///< of its faces that face the master somewhere, before
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
      throw Error("no-patch",
                  fmt::format("not all pieces of the patch of slave face {} belong to the zone",
                              mesh.cell_name(mesh.slave_patches[static_cast<std::size_t>(patch)].front())),
                  "take the group of slave faces that was cut");
  return patches;
}

void append_patch_points(const ContactDefinition& definition, int zone, const Model& model, Positions positions,
                         double time, std::vector<ContactPoint>& points) {
  PatchGaps gaps(definition, zone, model, positions, time);
  for (const int patch : patches_of(definition.zones[static_cast<std::size_t>(zone)], *model.mesh))
    points.push_back(gaps.point_of(model.mesh->slave_patches[static_cast<std::size_t>(patch)]));
}

double mean_gap(const ContactPoint& point, Positions positions) {
  double gap = -point.offset;
  for (const GapShare& share : point.shares) gap += share.coefficient.dot(positions[share.node]);
  return gap;
}

}  // namespace comma::solver
