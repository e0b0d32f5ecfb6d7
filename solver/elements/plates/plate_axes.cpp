#include "solver/elements/plates/plate_axes.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "solver/error.hpp"

namespace comma::solver {

namespace {

/// The reference direction must have at least this sine with the normal, or rounding would turn the axes.
constexpr double smallest_axis_sine = 1e-6;

Eigen::Vector3d corner(const Mesh& mesh, int cell, std::size_t number) {
  return Eigen::Map<const Eigen::Vector3d>(mesh.nodes[mesh.cell(cell)[number]].data());
}

/// Of any length; of a quadrangle across its diagonals.
Eigen::Vector3d plate_normal(const Mesh& mesh, int cell) {
  const auto place = [&](std::size_t number) { return corner(mesh, cell, number); };
  if (mesh.cell(cell).size() == 3) return (place(1) - place(0)).cross(place(2) - place(0));
  return (place(2) - place(0)).cross(place(3) - place(1));
}

}  // namespace

Eigen::Matrix3d plate_axes(const Mesh& mesh, int cell, const PlateSection& section) {
  const Eigen::Vector3d across = plate_normal(mesh, cell);
  if (!(across.norm() > 0.0)) throw Error("distorted-cell", fmt::format("plate {} has no area", mesh.cell_name(cell)));
  const Eigen::Vector3d z = across.normalized();
  const Eigen::Vector3d in_plane = section.direction - section.direction.dot(z) * z;
  if (!(in_plane.norm() > smallest_axis_sine * section.direction.norm())) {
    throw Error("zero-vector",
                fmt::format("the direction that gives plate {} its axes lies along its normal", mesh.cell_name(cell)),
                "give a direction in the plane of the plate");
  }
  const Eigen::Vector3d x = in_plane.normalized();
  Eigen::Matrix3d axes;
  axes << x.transpose(), z.cross(x).transpose(), z.transpose();
  return axes;
}

double warp_of_plate(const Mesh& mesh, int cell) {
  const Eigen::Vector3d normal = plate_normal(mesh, cell).normalized();
  double size = 0.0, off = 0.0;
  for (std::size_t number = 1; number < mesh.cell(cell).size(); ++number) {
    const Eigen::Vector3d side = corner(mesh, cell, number) - corner(mesh, cell, 0);
    size = std::max(size, side.norm());
    off = std::max(off, std::abs(normal.dot(side)));
  }
  return size > 0.0 ? off / size : 0.0;
}

}  // namespace comma::solver
