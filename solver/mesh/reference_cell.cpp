#include "solver/mesh/reference_cell.hpp"

#include <array>
#include <span>

namespace comma::solver {
namespace {

using enum CellType;

std::vector<Point> corners_of(CellType type) {
  switch (type) {
    case poi1:
      return {{0, 0, 0}};
    case seg2:
    case seg3:
    case seg4:
      return {{-1, 0, 0}, {1, 0, 0}};
    case tria3:
    case tria6:
    case tria7:
      return {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    case quad4:
    case quad8:
    case quad9:
      return {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    case tetra4:
    case tetra10:
      return {{0, 1, 0}, {0, 0, 1}, {0, 0, 0}, {1, 0, 0}};
    case pyram5:
    case pyram13:
      return {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}};
    case penta6:
    case penta15:
    case penta18:
      return {{-1, 1, 0}, {-1, 0, 1}, {-1, 0, 0}, {1, 1, 0}, {1, 0, 1}, {1, 0, 0}};
    default:
      return {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}};
  }
}

Point mean(const std::vector<Point>& points, std::span<const int> chosen) {
  Point sum{};
  for (const int i : chosen) {
    for (int axis = 0; axis < 3; ++axis) sum[axis] += points[i][axis] / static_cast<double>(chosen.size());
  }
  return sum;
}

}  // namespace

std::vector<std::array<int, 2>> middle_edges(CellType type) {
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
  if (type == quad9) return {{0, 1, 2, 3}};
  if (type == penta18) return {{0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}};
  if (type == hexa27) return {{0, 1, 2, 3}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}, {4, 5, 6, 7}};
  return {};
}

std::vector<Point> reference_points(CellType type) {
  std::vector<Point> points = corners_of(type);
  if (type == seg4) {
    points.insert(points.end(), {Point{-1.0 / 3.0, 0, 0}, Point{1.0 / 3.0, 0, 0}});
    return points;
  }
  for (const auto& edge : middle_edges(type)) points.push_back(mean(points, edge));
  for (const auto& face : middle_faces(type)) points.push_back(mean(points, face));
  static constexpr std::array<int, 8> corners = {0, 1, 2, 3, 4, 5, 6, 7};
  const bool has_centre = type == tria7 || type == hexa27;
  if (has_centre)
    points.push_back(mean(points, std::span(corners).first(static_cast<std::size_t>(corner_count(type)))));
  return points;
}

}  // namespace comma::solver
