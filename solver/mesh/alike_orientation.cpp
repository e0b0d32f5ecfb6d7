// Turning faces and lines so that neighbours run alike.
#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <map>

#include "solver/error.hpp"
#include "solver/mesh/boundary.hpp"
#include "solver/mesh/orientation.hpp"
#include "solver/mesh/place.hpp"

namespace comma::solver {
namespace {

using Vector = Eigen::Vector3d;
enum class Measure { normal, tangent };

/// A direction this near to lying in a cell (the sine of the angle) gives it no sense.
constexpr double smallest_sine = 1e-6;

Vector measured(const Mesh& mesh, int cell, Measure measure) {
  const auto nodes = mesh.cell(cell);
  const Vector along = place(mesh, nodes[1]) - place(mesh, nodes[0]);
  if (dimension(mesh.cell_types[cell]) == 1) return measure == Measure::tangent ? along : along.cross(Vector::UnitZ());
  const int corners = corner_count(mesh.cell_types[cell]);
  Vector sum = Vector::Zero();
  for (int i = 1; i + 1 < corners; ++i) {
    sum += (place(mesh, nodes[i]) - place(mesh, nodes[0])).cross(place(mesh, nodes[i + 1]) - place(mesh, nodes[0]));
  }
  return sum;
}

/// The cells of a sheet or line with the sense that each must be given.
class Sheet {
 public:
  Sheet(const Mesh& mesh, std::span<const int> cells, Measure measure) : mesh_(mesh), cells_(cells), measure_(measure) {
    for (const int cell : cells_) {
      const int wanted = dimension(mesh_.cell_types[cell]);
      if (wanted != 1 && (wanted != 2 || measure == Measure::tangent)) {
        throw Error("wrong-cell",
                    fmt::format("{} {} has no {} to turn", name_of(mesh_.cell_types[cell]), mesh_.cell_name(cell),
                                measure == Measure::tangent ? "tangent" : "normal"));
      }
      for_facets(cell, [&](Facet facet, bool) { neighbours_[facet].push_back(cell); });
    }
  }

  /// Those that do not run as the seed wants it or, without one, as the first cell does.
  std::vector<int> to_turn(const std::optional<OrientationSeed>& seed) {
    if (cells_.empty()) return {};
    const int first = seed ? cell_at(*seed) : cells_.front();
    turned_[first] = seed && must_turn(first, *seed);
    std::deque<int> open = {first};
    while (!open.empty()) {
      const int cell = open.front();
      open.pop_front();
      for_facets(cell, [&](Facet facet, bool) { reach(cell, facet, open); });
    }
    return unlike(first);
  }

  /// Where more than two cells meet none of them is the neighbour of another.
  std::optional<std::pair<int, int>> unlike_neighbours() const {
    for (const auto& [facet, cells] : neighbours_)
      if (cells.size() == 2 && !alike(cells[0], cells[1], facet)) return std::pair(cells[0], cells[1]);
    return std::nullopt;
  }

 private:
  using Facet = std::array<int, 2>;

  /// Visits the edges of a face (or the ends of a line) and whether the cell passes them from the lower to the higher
  /// node (or begins there).
  template <class Visit>
  void for_facets(int cell, Visit visit) const {
    const auto nodes = mesh_.cell(cell);
    if (dimension(mesh_.cell_types[cell]) == 1) {
      visit(Facet{nodes[0], -1}, true);
      visit(Facet{nodes[1], -1}, false);
      return;
    }
    const int corners = corner_count(mesh_.cell_types[cell]);
    for (int i = 0; i < corners; ++i) {
      const int a = nodes[i];
      const int b = nodes[(i + 1) % corners];
      visit(Facet{std::min(a, b), std::max(a, b)}, a < b);
    }
  }

  bool passes(int cell, Facet wanted) const {
    bool result = false;
    for_facets(cell, [&](Facet facet, bool forward) {
      if (facet == wanted) result = forward;
    });
    return result;
  }

  /// Whether two cells that share a facet run alike as they stand. Twins on the same corners pass it in the same sense,
  /// neighbours in opposite ones.
  bool alike(int cell, int other, Facet facet) const {
    const bool twins = facet_key(mesh_, cell) == facet_key(mesh_, other);
    return (passes(cell, facet) == passes(other, facet)) == twins;
  }

  void reach(int cell, Facet facet, std::deque<int>& open) {
    for (const int other : neighbours_.at(facet)) {
      if (other == cell) continue;
      const bool sense = turned_.at(cell) != !alike(cell, other, facet);
      const auto [known, is_new] = turned_.try_emplace(other, sense);
      if (is_new) {
        open.push_back(other);
      } else if (known->second != sense) {
        throw Error("not-orientable",
                    fmt::format("the cells {} and {} cannot run alike", mesh_.cell_name(cell), mesh_.cell_name(other)),
                    "the sheet is one-sided, or more than two cells meet in an edge: name parts of it one by one");
      }
    }
  }

  int cell_at(const OrientationSeed& seed) const {
    for (const int cell : cells_) {
      if (std::ranges::find(mesh_.cell(cell), seed.node) != mesh_.cell(cell).end()) return cell;
    }
    throw Error("unknown-node", fmt::format("none of the cells to turn is at node {}", mesh_.node_name(seed.node)));
  }

  bool must_turn(int cell, const OrientationSeed& seed) const {
    const Vector wanted(seed.direction.data());
    const Vector own = measured(mesh_, cell, measure_);
    const double along = own.dot(wanted);
    if (std::abs(along) > smallest_sine * own.norm() * wanted.norm()) return along < 0.0;
    throw Error("ambiguous-direction",
                fmt::format("the direction gives cell {} no sense: it is square to its {}", mesh_.cell_name(cell),
                            measure_ == Measure::tangent ? "tangent" : "normal"));
  }

  std::vector<int> unlike(int first) const {
    std::vector<int> found;
    for (const int cell : cells_) {
      const auto sense = turned_.find(cell);
      if (sense == turned_.end()) {
        throw Error("several-pieces",
                    fmt::format("cell {} is not connected with {}", mesh_.cell_name(cell), mesh_.cell_name(first)),
                    "turn the pieces one by one");
      }
      if (sense->second) found.push_back(cell);
    }
    return found;
  }

  const Mesh& mesh_;
  std::span<const int> cells_;
  Measure measure_;
  std::map<Facet, std::vector<int>> neighbours_;
  std::map<int, bool> turned_;  ///< whether a cell that has been reached must be turned
};

int orient(Mesh& mesh, std::span<const int> cells, Measure measure, const std::optional<OrientationSeed>& seed) {
  const std::vector<int> wrong = Sheet(mesh, cells, measure).to_turn(seed);
  for (const int cell : wrong) turn_sheet_cell(mesh, cell);
  return static_cast<int>(wrong.size());
}

}  // namespace

int orient_normals(Mesh& mesh, std::span<const int> cells, const std::optional<OrientationSeed>& seed) {
  return orient(mesh, cells, Measure::normal, seed);
}

int orient_lines(Mesh& mesh, std::span<const int> cells, const std::optional<OrientationSeed>& seed) {
  return orient(mesh, cells, Measure::tangent, seed);
}

std::optional<std::pair<int, int>> unlike_neighbours(const Mesh& mesh, std::span<const int> cells) {
  return Sheet(mesh, cells, Measure::normal).unlike_neighbours();
}

}  // namespace comma::solver
