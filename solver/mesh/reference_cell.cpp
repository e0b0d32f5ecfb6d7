#include "solver/mesh/reference_cell.hpp"

#include "solver/mesh/reference_element.hpp"

namespace comma::solver {

std::vector<std::array<int, 2>> middle_edges(CellType type) {
  using enum CellType;
  switch (type) {
    case seg3:
      return {{0, 1}};
    case tria6:
    case tria7:
      return {{0, 1}, {1, 2}, {2, 0}};
    case quad8:
    case quad9:
      return {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
    case tetra10:
      return {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}};
    case pyram13:
      return {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 4}, {2, 4}, {3, 4}};
    case penta15:
    case penta18:
      return {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 4}, {2, 5}, {3, 4}, {4, 5}, {5, 3}};
    case hexa20:
    case hexa27:
      return {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 5}, {2, 6}, {3, 7}, {4, 5}, {5, 6}, {6, 7}, {7, 4}};
    default:
      return {};
  }
}

std::vector<std::array<int, 4>> middle_faces(CellType type) {
  using enum CellType;
  if (type == quad9) return {{0, 1, 2, 3}};
  if (type == penta18) return {{0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}};
  if (type == hexa27) return {{0, 1, 2, 3}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}, {4, 5, 6, 7}};
  return {};
}

std::vector<Point> reference_points(CellType type) {
  const auto nodes = reference_nodes(type);
  return {nodes.begin(), nodes.end()};
}

}  // namespace comma::solver
