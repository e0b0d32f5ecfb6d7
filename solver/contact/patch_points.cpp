#include "solver/contact/patch_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>
#include <unordered_map>

#include <fmt/format.h>

#include "solver/contact/extent.hpp"
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

/// A facet's nodes where they are and, where normals are smoothed, the outward normals of the cells around them.
struct Gathered {
  CellType type = CellType::seg2;
  std::array<Vector3d, max_facet_nodes> points;
  std::array<Vector3d, max_facet_nodes> normals;
  std::size_t count = 0;
  bool is_smooth = false;
  Vector3d centre = Vector3d::Zero();
  double radius = 0.0;

  FacetGeometry geometry() const { return {type, {points.data(), count}, {normals.data(), is_smooth ? count : 0}}; }
  /// The same with normals of its own.
  FacetGeometry bare() const { return {type, {points.data(), count}, {}}; }
};

/// The facets of a surface at one moment.
class Surface {
 public:
  Surface(const Mesh& mesh, std::span<const int> cells, Positions positions, bool is_smooth) : mesh_(mesh), positions_(positions), is_smooth_(is_smooth) {
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

/// What a slave face may face. Its normals may lean: what lies within the facets' sizes of the line through the face's centre is looked at.
class Reach {
 public:
  explicit Reach(const Gathered& slave) : slave_(slave), normal_(normal_at(slave.geometry(), facet_centre(slave.type))) {}

  bool has(const Gathered& master) const {
    const Vector3d apart = master.centre - slave_.centre;
    const double along = normal_.dot(apart);
    const double lean = slave_.is_smooth ? std::abs(along) : 0.0;
    return (apart - along * normal_).norm() <= 2.0 * (slave_.radius + master.radius) + lean;
  }

 private:
  const Gathered& slave_;
  const Vector3d normal_;
};

bool is_line(const Mesh& mesh, const ContactZone& zone) { return dimension(mesh.cell_types[zone.slave_cells.front()]) == 1; }

/// How far places of two surfaces have slid along each other.
class Slides {
 public:
  Slides(const ContactDefinition& definition, const ContactZone& zone, const Mesh& mesh, Positions positions, Positions start)
      : zone_(zone), mesh_(mesh), positions_(positions), start_(start), smooth_(definition.smooth_normals) {}

  /// Of places that face each other at `where`, no farther apart than the smaller facet is long, as a share of its size.
  double largest(Positions where) const {
    const Surface slaves(mesh_, zone_.slave_cells, where, smooth_);
    const Surface masters(mesh_, zone_.master_cells, where, false);
    std::vector<Gathered> facets;
    for (const int cell : zone_.master_cells) facets.push_back(masters.gather(cell));
    double result = 0.0;
    for (const int face : zone_.slave_cells) {
      const Gathered slave = slaves.gather(face);
      const Reach reach(slave);
      for (std::size_t m = 0; m < facets.size(); ++m) {
        if (!reach.has(facets[m])) continue;
        const double size = std::min(extent(mesh_, face), extent(mesh_, zone_.master_cells[m]));
        for (const OverlapPoint& at : facet_overlap(slave.geometry(), facets[m].geometry())) {
          const Vector3d normal = normal_at(slave.geometry(), at.slave);
          if (normal.dot(point_at(facets[m].geometry(), at.master) - point_at(slave.geometry(), at.slave)) > size) continue;
          const Vector3d slide = way(face, at.slave) - way(zone_.master_cells[m], at.master);
          result = std::max(result, (slide - normal.dot(slide) * normal).norm() / size);
        }
      }
    }
    return result;
  }

 private:
  /// Of a place of a cell, from the start.
  Vector3d way(int cell, const Vector2d& xi) const {
    const FacetShape shape = facet_shape(mesh_.cell_types[cell], xi);
    const auto nodes = mesh_.cell(cell);
    Vector3d sum = Vector3d::Zero();
    for (std::size_t i = 0; i < nodes.size(); ++i) sum += shape.values[i] * (positions_[nodes[i]] - start_[nodes[i]]);
    return sum;
  }

  const ContactZone& zone_;
  const Mesh& mesh_;
  Positions positions_, start_;
  bool smooth_;
};

class PatchGaps {
 public:
  PatchGaps(const ContactDefinition& definition, int zone, const Model& model, Positions positions, Positions start, double time)
      : zone_(definition.zones[static_cast<std::size_t>(zone)]),
        index_(zone),
        model_(model),
        mesh_(*model.mesh),
        time_(time),
        slaves_(mesh_, zone_.slave_cells, positions, definition.smooth_normals),
        facing_slaves_(mesh_, zone_.slave_cells, facing(positions, start), definition.smooth_normals) {
    const Surface masters(mesh_, zone_.master_cells, positions, definition.smooth_normals);
    const Surface facing_masters(mesh_, zone_.master_cells, facing(positions, start), false);
    for (const int cell : zone_.master_cells) {
      masters_.push_back(masters.gather(cell));
      facing_masters_.push_back(facing_masters.gather(cell));
    }
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
    point_.offset /= point_.weight;
    point_.normal.normalize();
    return point_;
  }

 private:
  /// Where the bodies are when it is settled which places face each other: surfaces now, lines when the step began.
  Positions facing(Positions positions, Positions start) const { return is_line(mesh_, zone_) ? start : positions; }

  void add_face(int face) {
    const Gathered slave = slaves_.gather(face);
    const Gathered facing = facing_slaves_.gather(face);
    const Reach reach(facing);
    for (const FacePoint& at : face_rule(slave.type, ContactRule::gauss, area_order)) point_.area += at.weight * stretch(face, at.xi);
    for (std::size_t m = 0; m < masters_.size(); ++m) {
      const Gathered& master = facing_masters_[m];
      if (!reach.has(master)) continue;
      for (const OverlapPoint& each : facet_overlap(facing.geometry(), master.geometry())) add(face, slave, zone_.master_cells[m], masters_[m], each);
    }
  }

  void add(int face, const Gathered& slave, int facet, const Gathered& master, const OverlapPoint& at) {
    const Vector3d here = point_at(slave.geometry(), at.slave);
    const Vector3d foot = point_at(master.geometry(), at.master);
    const Vector3d normal = -normal_at(slave.geometry(), at.slave);
    const double gap = normal.dot(here - foot);
    if (zone_.pairing_distance >= 0.0 && std::abs(gap) > zone_.pairing_distance) return;
    const double area = at.weight * stretch(face, at.slave);
    const double shared = add_shares(face, slave, at.slave, -area) + add_shares(facet, master, at.master, -area);
    point_.offset += shared - area * (gap - thickness_at(zone_, here, foot, time_));
    point_.weight += area;
    point_.normal += area * normal;
    point_.facet = facet;
  }

  /// Adds what a point's gap takes of a facet's nodes, along outward normals; returns what it makes of their places now.
  double add_shares(int cell, const Gathered& facet, const Vector2d& xi, double factor) {
    const auto nodes = mesh_.cell(cell);
    const FacetShape shape = facet_shape(facet.type, xi);
    const Vector3d own = facet.is_smooth ? Vector3d(Vector3d::Zero()) : normal_at(facet.bare(), xi);
    double sum = 0.0;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const Vector3d coefficient = factor * shape.values[i] * (facet.is_smooth ? facet.normals[i] : own);
      sums_.try_emplace(nodes[i], Vector3d::Zero()).first->second += coefficient;
      sum += coefficient.dot(facet.points[i]);
    }
    return sum;
  }

  /// Initial area a unit of the reference cell's, times the radius where axisymmetric: pressures are forces over the area before
  /// deformation.
  double stretch(int face, const Vector2d& xi) const { return initial_stretch(model_, face, xi); }

  static constexpr int area_order = 4;
  const ContactZone& zone_;
  int index_;
  const Model& model_;
  const Mesh& mesh_;
  double time_;
  Surface slaves_, facing_slaves_;
  std::vector<Gathered> masters_, facing_masters_;
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

void append_patch_points(const ContactDefinition& definition, int zone, const Model& model, Positions positions, Positions start, double time,
                         std::vector<ContactPoint>& points) {
  PatchGaps gaps(definition, zone, model, positions, start, time);
  for (const int patch : patches_of(definition.zones[static_cast<std::size_t>(zone)], *model.mesh))
    points.push_back(gaps.point_of(model.mesh->slave_patches[static_cast<std::size_t>(patch)]));
}

bool faces_as_at_start(const ContactZone& zone, const Mesh& mesh) { return zone.mixed.local_average && is_line(mesh, zone); }

double largest_slide(const ContactDefinition& definition, const Mesh& mesh, Positions positions, Positions start) {
  double result = 0.0;
  for (const ContactZone& zone : definition.zones) {
    if (!faces_as_at_start(zone, mesh)) continue;
    const Slides slides(definition, zone, mesh, positions, start);
    result = std::max({result, slides.largest(positions), slides.largest(start)});
  }
  return result;
}

}  // namespace comma::solver
