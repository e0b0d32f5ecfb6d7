#include "solver/fields/stresses/surface_stresses.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "solver/elements/cell_quadrature.hpp"
#include "solver/error.hpp"
#include "solver/fields/stresses/equivalent.hpp"
#include "solver/model/stress_names.hpp"

namespace comma::solver {

namespace {

using Corners = std::array<int, 4>;

/// The corners of a face or edge, sorted; -1 fills up to four.
Corners sorted_corners(std::span<const int> nodes, int count) {
  Corners corners = {-1, -1, -1, -1};
  std::copy_n(nodes.begin(), count, corners.begin());
  std::sort(corners.begin(), corners.end());
  return corners;
}

/// The mean normal of a face or edge, its curvature included.
Eigen::Vector3d normal_of(const Mesh& mesh, int face, CellSamples& samples) {
  const CellType type = mesh.cell_types[face];
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (const CellSample& sample : samples.of(type, CellRole::skin)) {
    normal += sample.weight * locate(mesh, face, sample).normal(dimension(type));
  }
  return normal.normalized();
}

/// The faces asked for, by their corners, with the body cells that they bound.
class BoundedCells {
 public:
  BoundedCells(const Mesh& mesh, const ElementField& stresses, std::span<const int> faces) : mesh_(mesh) {
    for (const int face : faces) {
      if (dimension(mesh.cell_types[face]) > 0) bounded_.emplace(key_of(face), std::vector<int>());
    }
    for (int cell = 0; cell < mesh.cell_count(); ++cell) {
      if (stresses.points(cell) > 0) add(cell);
    }
  }

  /// The cell whose outward normal the face has, else the one on its other side; -1 if there is none.
  int behind(int face) {
    const auto found = bounded_.find(key_of(face));
    if (found == bounded_.end() || found->second.empty()) return -1;
    const Eigen::Vector3d normal = normal_of(mesh_, face, samples_);
    const Eigen::Vector3d centre = centre_of(face);
    for (const int cell : found->second) {
      if (normal.dot(centre - centre_of(cell)) > 0.0) return cell;
    }
    return found->second.front();
  }

 private:
  Corners key_of(int face) const { return sorted_corners(mesh_.cell(face), corner_count(mesh_.cell_types[face])); }

  void add(int cell) {
    const auto nodes = mesh_.cell(cell);
    for (const BoundaryFacet& facet : boundary_facets(mesh_.cell_types[cell])) {
      const int count = corner_count(facet.type);
      std::array<int, 4> corners{};
      for (int i = 0; i < count; ++i) corners[i] = nodes[facet.nodes[i]];
      const auto found = bounded_.find(sorted_corners(corners, count));
      if (found != bounded_.end()) found->second.push_back(cell);
    }
  }

  Eigen::Vector3d centre_of(int cell) const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    const auto nodes = mesh_.cell(cell).first(static_cast<std::size_t>(corner_count(mesh_.cell_types[cell])));
    for (const int node : nodes) sum += Eigen::Vector3d(mesh_.nodes[node].data());
    return sum / static_cast<double>(nodes.size());
  }

  const Mesh& mesh_;
  CellSamples samples_;
  std::map<Corners, std::vector<int>> bounded_;
};

Eigen::Matrix3d mean_stress(const Mesh& mesh, const ElementField& stresses, const std::array<int, 6>& columns, int cell,
                            int face) {
  std::array<double, 6> sums{};
  const auto face_nodes = mesh.cell(face);
  const auto nodes = mesh.cell(cell);
  int count = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (std::find(face_nodes.begin(), face_nodes.end(), nodes[i]) == face_nodes.end()) continue;
    for (int c = 0; c < 6; ++c) {
      const double value = columns[c] < 0 ? 0.0 : stresses.at(cell, static_cast<int>(i), columns[c]);
      sums[c] += std::isnan(value) ? 0.0 : value;
    }
    ++count;
  }
  Eigen::Matrix3d tensor;
  tensor << sums[0], sums[3], sums[4], sums[3], sums[1], sums[5], sums[4], sums[5], sums[2];
  return tensor / count;
}

constexpr int component_count_of_result = 16;
using Values = std::array<double, component_count_of_result>;

Values resolve_on_edge(const Eigen::Matrix3d& stress, const Eigen::Vector3d& n) {
  const Eigen::Vector3d t = Eigen::Vector3d::UnitZ().cross(n);
  const Eigen::Vector3d across = stress * n;
  const Eigen::Vector3d along = stress * t;
  return {across[0], across[1], across[2],    n.dot(across), along[0], along[1],     along[2],     along[0],
          along[1],  along[2],  t.dot(along), 0.0,           0.0,      stress(2, 2), stress(2, 2), t.dot(across)};
}

Eigen::Vector3d first_edge(const Mesh& mesh, int face) {
  const auto nodes = mesh.cell(face);
  return Eigen::Vector3d(mesh.nodes[nodes[0]].data()) - Eigen::Vector3d(mesh.nodes[nodes[1]].data());
}

/// Of stresses, in their own units, as Code_Aster 17.3 has it.
constexpr double least_difference = 1e-10;

/// Both principal directions of a plane tensor [a, b; b, c], of the smaller value first: (b, value - a), as the first
/// of the equations (a - value) v1 + b v2 = 0 has them. A direction has no sign of its own; these are those of
/// Code_Aster 17.3 (docs/conformance/fields.md). Where the value is a but for `least_difference`, it is the other one
/// turned by -90 degrees.
std::array<Eigen::Vector2d, 2> principal_directions(double a, double b, double c) {
  const double half = 0.5 * (a - c);
  const double root = std::hypot(half, b);
  const double farther = std::abs(half) + root;  // of both values from a; the nearer one is b^2 / farther away
  const bool is_near = b == 0.0 || b * b / farther < least_difference;
  if (half < 0.0) {
    const Eigen::Vector2d second = Eigen::Vector2d(b, farther).normalized();
    return {(is_near || b > 0.0 ? 1.0 : -1.0) * Eigen::Vector2d(second[1], -second[0]), second};
  }
  const Eigen::Vector2d first =
      farther > 0.0 ? Eigen::Vector2d(b, -farther).normalized() : Eigen::Vector2d(-Eigen::Vector2d::UnitY());
  return {first, (is_near || b < 0.0 ? 1.0 : -1.0) * Eigen::Vector2d(first[1], -first[0])};
}

/// `edge`: the first edge of the face, from its second node to its first.
Values resolve_on_face(const Eigen::Matrix3d& stress, const Eigen::Vector3d& normal, const Eigen::Vector3d& edge) {
  const Eigen::Vector3d traction = stress * normal;
  const double across = normal.dot(traction);
  const Eigen::Vector3d tangential = traction - across * normal;
  const Eigen::Vector3d s = (edge - normal.dot(edge) * normal).normalized();
  const Eigen::Vector3d t = normal.cross(s);
  const auto directions = principal_directions(s.dot(stress * s), s.dot(stress * t), t.dot(stress * t));
  const Eigen::Vector3d first = directions[0][0] * s + directions[0][1] * t;
  const Eigen::Vector3d second = directions[1][0] * s + directions[1][1] * t;
  const double smaller = first.dot(stress * first);
  const double larger = second.dot(stress * second);
  const Eigen::Vector3d n = across * normal;
  const Eigen::Vector3d one = smaller * first;
  const Eigen::Vector3d two = larger * second;
  return {n[0],   n[1],   n[2],    across, tangential[0], tangential[1], tangential[2], one[0],
          one[1], one[2], smaller, two[0], two[1],        two[2],        larger,        0.0};
}

}  // namespace

ElementField surface_stresses(const Mesh& mesh, const ElementField& stresses, std::span<const int> faces) {
  std::array<int, 6> columns;
  for (int c = 0; c < 6; ++c) columns[c] = stresses.component(solid_stress_names[c]);
  if (*std::min_element(columns.begin(), columns.begin() + 4) < 0) {
    throw Error("incompatible-field", "stresses on a skin need SIXX SIYY SIZZ SIXY of the body behind it");
  }
  ElementField result{"SIEF_R",
                      Support::cell,
                      {"SIG_NX", "SIG_NY", "SIG_NZ", "SIG_N", "SIG_TX", "SIG_TY", "SIG_TZ", "SIG_T1X", "SIG_T1Y",
                       "SIG_T1Z", "SIG_T1", "SIG_T2X", "SIG_T2Y", "SIG_T2Z", "SIG_T2", "SIG_TN"},
                      std::vector<int>(mesh.cell_types.size() + 1, 0),
                      {}};
  BoundedCells bounded(mesh, stresses, faces);
  CellSamples samples;
  std::vector<int> sorted(faces.begin(), faces.end());
  std::sort(sorted.begin(), sorted.end());
  sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
  for (const int face : sorted) {
    const int cell = dimension(mesh.cell_types[face]) > 0 ? bounded.behind(face) : -1;
    if (cell < 0) continue;
    const Eigen::Vector3d normal = normal_of(mesh, face, samples);
    const Eigen::Matrix3d stress = mean_stress(mesh, stresses, columns, cell, face);
    const Values values = dimension(mesh.cell_types[face]) == 1
                              ? resolve_on_edge(stress, normal)
                              : resolve_on_face(stress, normal, first_edge(mesh, face));
    result.values.insert(result.values.end(), values.begin(), values.end());
    result.starts[face + 1] = 1;
  }
  for (std::size_t cell = 1; cell < result.starts.size(); ++cell) result.starts[cell] += result.starts[cell - 1];
  return result;
}

}  // namespace comma::solver
