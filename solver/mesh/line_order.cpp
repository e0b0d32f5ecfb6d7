// The nodes of a line of segments in the order of a walk along it.
#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <map>
#include <vector>

#include "solver/error.hpp"
#include "solver/mesh/groups.hpp"
#include "solver/mesh/place.hpp"

namespace comma::solver {
namespace {

class Line {
 public:
  Line(const Mesh& mesh, std::span<const int> cells) : mesh_(mesh), cells_(cells) { connect(); }

  std::vector<int> walk(std::optional<int> start, std::optional<int> end, std::optional<Point> direction) const;

 private:
  [[noreturn]] static void fail(const std::string& what) { throw Error("not-a-line", what); }

  void connect();
  /// Of the cells in the order of the mesh: the end that one begins with, or else that one ends with (Code_Aster 17.3).
  int first_open_end() const;
  int choose_start(std::optional<int> start, std::optional<int> end) const;
  int first_cell(int start, std::optional<Point> direction) const;
  bool is_end(int node) const { return cells_at_.at(node).size() == 1; }

  const Mesh& mesh_;
  std::span<const int> cells_;
  std::map<int, std::vector<int>> cells_at_;  ///< the cells that end at a node
  bool closed_ = false;
};

void Line::connect() {
  if (cells_.empty()) fail("there are no cells to make a line of");
  for (const int cell : cells_) {
    if (dimension(mesh_.cell_types[cell]) != 1) {
      fail(fmt::format("{} {} is not a line cell", name_of(mesh_.cell_types[cell]), mesh_.cell_name(cell)));
    }
    for (const int node : mesh_.cell(cell).first(2)) {
      auto& cells = cells_at_[node];
      cells.push_back(cell);
      if (cells.size() > 2) fail(fmt::format("the line forks at node {}", mesh_.node_name(node)));
    }
  }
  const auto ends = std::ranges::count_if(cells_at_, [](const auto& entry) { return entry.second.size() == 1; });
  if (ends > 2) fail(fmt::format("the line has several pieces: {} of its nodes are ends", ends));
  closed_ = ends == 0;
}

int Line::first_open_end() const {
  std::vector<int> as_in_mesh(cells_.begin(), cells_.end());
  std::ranges::sort(as_in_mesh);
  for (const std::size_t side : {0U, 1U})
    for (const int cell : as_in_mesh)
      if (const int node = mesh_.cell(cell)[side]; is_end(node)) return node;
  return -1;
}

int Line::choose_start(std::optional<int> start, std::optional<int> end) const {
  for (const auto& node : {start, end}) {
    if (node && !cells_at_.contains(*node)) fail(fmt::format("node {} is not on the line", mesh_.node_name(*node)));
    if (node && !closed_ && !is_end(*node))
      fail(fmt::format("node {} is not an end of the line", mesh_.node_name(*node)));
  }
  if (closed_) {
    if (start && end && *start != *end) fail("the line is closed: it ends where it starts");
    return start ? *start : end ? *end : mesh_.cell(cells_.front())[0];
  }
  if (start && end && *start == *end) fail("the line is open, so it cannot end where it starts");
  if (start) return *start;
  const int first = first_open_end();
  if (!end || first != *end) return first;
  for (const auto& [node, cells] : cells_at_) {
    if (cells.size() == 1 && node != *end) return node;
  }
  return first;
}

int Line::first_cell(int start, std::optional<Point> direction) const {
  const auto& cells = cells_at_.at(start);
  if (cells.size() == 1 || !direction) {
    const bool leads_off = mesh_.cell(cells.front())[0] == start;
    return leads_off || cells.size() == 1 ? cells.front() : cells.back();
  }
  const auto along = [&](int cell) {
    const auto nodes = mesh_.cell(cell);
    const int other = nodes[0] == start ? nodes[1] : nodes[0];
    const Eigen::Vector3d step =
        Eigen::Vector3d(mesh_.nodes[other].data()) - Eigen::Vector3d(mesh_.nodes[start].data());
    return step.normalized().dot(Eigen::Vector3d(direction->data()));
  };
  return along(cells[0]) >= along(cells[1]) ? cells[0] : cells[1];
}

std::vector<int> Line::walk(std::optional<int> start, std::optional<int> end, std::optional<Point> direction) const {
  const int origin = choose_start(start, end);
  std::vector<int> path = {origin};
  int cell = first_cell(origin, direction);
  int node = origin;
  std::size_t passed = 0;
  while (true) {
    const auto nodes = mesh_.cell(cell);
    ++passed;
    std::vector<int> middle(nodes.begin() + 2, nodes.end());
    if (nodes[0] != node) std::ranges::reverse(middle);
    path.insert(path.end(), middle.begin(), middle.end());
    node = nodes[0] == node ? nodes[1] : nodes[0];
    if (node == origin) break;
    path.push_back(node);
    const auto& here = cells_at_.at(node);
    if (here.size() == 1) break;
    cell = here[0] == cell ? here[1] : here[0];
  }
  if (passed != cells_.size())
    fail(fmt::format("the line has several pieces: {} of its {} cells are reached from node {}", passed, cells_.size(),
                     mesh_.node_name(origin)));
  return path;
}

bool contains(std::span<const int> nodes, int node) { return std::ranges::find(nodes, node) != nodes.end(); }

/// Whether an edge of a cell of the type on `nodes` holds both nodes, and no node of the line lies between them on it.
bool has_edge(CellType type, std::span<const int> nodes, std::span<const int> line, int a, int b) {
  if (!contains(nodes, a) || !contains(nodes, b)) return false;
  if (dimension(type) == 1) {
    const auto inner = nodes.subspan(2);
    return contains(inner, a) || contains(inner, b) ||
           std::ranges::none_of(inner, [&](int node) { return contains(line, node); });
  }
  return std::ranges::any_of(boundary_facets(type), [&](const BoundaryFacet& facet) {
    std::vector<int> own;
    for (int i = 0; i < node_count(facet.type); ++i)
      own.push_back(nodes[static_cast<std::size_t>(facet.nodes[static_cast<std::size_t>(i)])]);
    return has_edge(facet.type, own, line, a, b);
  });
}

bool joined_by_edge(const Mesh& mesh, std::span<const int> line, int a, int b) {
  for (int cell = 0; cell < mesh.cell_count(); ++cell) {
    if (has_edge(mesh.cell_types[cell], mesh.cell(cell), line, a, b)) return true;
  }
  return false;
}

bool turns_back(const Mesh& mesh, int before, int node, int after) {
  const auto at = [&](int index) {
    return Eigen::Map<const Eigen::Vector3d>(mesh.nodes[static_cast<std::size_t>(index)].data());
  };
  return (at(node) - at(before)).dot(at(after) - at(node)) < 0.0;
}

}  // namespace

std::vector<int> nodes_along_line(const Mesh& mesh, std::span<const int> cells, std::optional<int> start,
                                  std::optional<int> end, std::optional<Point> direction) {
  return Line(mesh, cells).walk(start, end, direction);
}

bool lie_on_a_line(const Mesh& mesh, std::span<const int> nodes) {
  constexpr double rounding = 1e-6;
  if (nodes.size() < 3) return false;
  const Eigen::Vector3d first = place(mesh, nodes.front());
  const int far = *std::ranges::max_element(nodes, {}, [&](int node) { return (place(mesh, node) - first).norm(); });
  const double length = (place(mesh, far) - first).norm();
  if (length == 0.0) return false;
  const Eigen::Vector3d along = (place(mesh, far) - first) / length;
  return std::ranges::all_of(
      nodes, [&](int node) { return (place(mesh, node) - first).cross(along).norm() <= rounding * length; });
}

std::optional<int> node_out_of_order(const Mesh& mesh, std::span<const int> nodes) {
  for (std::size_t i = 1; i + 1 < nodes.size(); ++i) {
    if (!turns_back(mesh, nodes[i - 1], nodes[i], nodes[i + 1])) continue;
    if (!joined_by_edge(mesh, nodes, nodes[i - 1], nodes[i]) || !joined_by_edge(mesh, nodes, nodes[i], nodes[i + 1]))
      return nodes[i];
  }
  return std::nullopt;
}

}  // namespace comma::solver
