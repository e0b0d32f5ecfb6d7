#include "solver/loads/end_effect.hpp"

#include <map>
#include <set>

#include <fmt/format.h>

#include "solver/elements/cell_quadrature.hpp"
#include "solver/error.hpp"

namespace comma::solver {

namespace {

/// The edges at each end node.
using EdgesAt = std::map<int, std::vector<int>>;

EdgesAt edges_at_nodes(const Mesh& mesh, std::span<const int> rim) {
  EdgesAt result;
  for (const int cell : rim) {
    if (dimension(mesh.cell_types[cell]) != 1) {
      throw Error("not-a-line", fmt::format("cell {}, a {}, is no edge of a hole", mesh.cell_name(cell),
                                            name_of(mesh.cell_types[cell])));
    }
    for (const int end : {0, 1}) result[mesh.cell(cell)[end]].push_back(cell);
  }
  for (const auto& [node, edges] : result) {
    if (edges.size() == 2) continue;
    throw Error(
        "not-a-line",
        fmt::format("the rim of the hole {} at node {}", edges.size() == 1 ? "ends" : "forks", mesh.node_name(node)),
        "give all edges round the hole, each once");
  }
  return result;
}

/// The places of an edge's nodes from one end to the other.
std::vector<Eigen::Vector3d> path_along(const Mesh& mesh, int cell) {
  const auto nodes = mesh.cell(cell);
  std::vector<Eigen::Vector3d> path = {Eigen::Vector3d(mesh.nodes[nodes[0]].data())};
  for (const int node : nodes.subspan(2)) path.emplace_back(mesh.nodes[node].data());
  path.emplace_back(mesh.nodes[nodes[1]].data());
  return path;
}

/// Twice the vector area that an edge sweeps from `origin`, in the sense of its own nodes.
Eigen::Vector3d swept(const Mesh& mesh, int cell, const Eigen::Vector3d& origin) {
  const std::vector<Eigen::Vector3d> path = path_along(mesh, cell);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t k = 1; k < path.size(); ++k) sum += (path[k - 1] - origin).cross(path[k] - origin);
  return sum;
}

}  // namespace

double length_along_nodes(const Mesh& mesh, std::span<const int> rim) {
  double length = 0.0;
  for (const int cell : rim) {
    const std::vector<Eigen::Vector3d> path = path_along(mesh, cell);
    for (std::size_t k = 1; k < path.size(); ++k) length += (path[k] - path[k - 1]).norm();
  }
  return length;
}

double enclosed_area(const Mesh& mesh, std::span<const int> rim) {
  const EdgesAt edges = edges_at_nodes(mesh, rim);
  std::set<int> left(rim.begin(), rim.end());
  double area = 0.0;
  while (!left.empty()) {
    int cell = *left.begin();
    int from = mesh.cell(cell)[0];
    const Eigen::Vector3d origin(mesh.nodes[from].data());
    Eigen::Vector3d twice = Eigen::Vector3d::Zero();
    while (left.erase(cell) > 0) {
      const bool forward = mesh.cell(cell)[0] == from;
      twice += (forward ? 1.0 : -1.0) * swept(mesh, cell, origin);
      from = mesh.cell(cell)[forward ? 1 : 0];
      const auto& here = edges.at(from);
      cell = here[0] == cell ? here[1] : here[0];
    }
    area += 0.5 * twice.norm();
  }
  return area;
}

double surface_area(const Mesh& mesh, std::span<const int> faces) {
  CellSamples samples;
  double area = 0.0;
  for (const int cell : faces) {
    if (dimension(mesh.cell_types[cell]) != 2) {
      throw Error("not-a-face",
                  fmt::format("cell {}, a {}, is no face", mesh.cell_name(cell), name_of(mesh.cell_types[cell])));
    }
    for (const CellSample& sample : samples.of(mesh.cell_types[cell], CellRole::skin)) {
      area += sample.weight * locate(mesh, cell, sample).measure(2);
    }
  }
  return area;
}

std::vector<PressureLoad> end_effect(const Mesh& mesh, std::span<const int> faces, std::span<const int> rim,
                                     double pressure, const FieldFunction& function) {
  const double ratio = -enclosed_area(mesh, rim) / surface_area(mesh, faces);
  FieldFunction scaled;
  if (function) scaled = [function, ratio](const Point& at, double time) { return ratio * function(at, time); };
  std::vector<PressureLoad> result;
  for (const int cell : faces) result.push_back({cell, ratio * pressure, 0.0, scaled, {}});
  return result;
}

}  // namespace comma::solver
