#include "solver/mesh/transform.hpp"

#include <Eigen/Dense>
#include <array>
#include <cmath>

#include "solver/error.hpp"
#include "solver/mesh/place.hpp"

namespace comma::solver {
namespace {

using Vector = Eigen::Vector3d;

/// Directions (in radians) closer than this are the same but for rounding.
constexpr double smallest_angle = 1e-12;

template <class Move>
void move_nodes(Mesh& mesh, Move move) {
  for (Point& node : mesh.nodes) {
    const Vector moved = move(to_vector(node));
    node = {moved[0], moved[1], moved[2]};
  }
  leave_plane(mesh);
}

}  // namespace

void scale(Mesh& mesh, double factor) {
  move_nodes(mesh, [&](const Vector& at) -> Vector { return factor * at; });
}

void translate(Mesh& mesh, const Point& shift) {
  move_nodes(mesh, [&](const Vector& at) -> Vector { return at + to_vector(shift); });
}

void rotate(Mesh& mesh, const Point& point, const Point& axis, double angle) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(angle, unit(to_vector(axis))).toRotationMatrix();
  move_nodes(mesh, [&](const Vector& at) -> Vector { return to_vector(point) + turn * (at - to_vector(point)); });
}

void mirror(Mesh& mesh, const Point& point, const Point& normal) {
  const Vector across = unit(to_vector(normal));
  move_nodes(mesh, [&](const Vector& at) -> Vector { return at - 2.0 * across.dot(at - to_vector(point)) * across; });
}

void change_axes(Mesh& mesh, const Point& x, const Point& y) {
  const Vector first = unit(to_vector(x));
  const Vector third = first.cross(unit(to_vector(y)));
  if (!(third.norm() > smallest_angle)) {
    throw Error("zero-vector", "the two directions of the new axes lie along each other",
                "give two different directions");
  }
  Eigen::Matrix3d axes;
  axes << first.transpose(), third.normalized().cross(first).transpose(), third.normalized().transpose();
  move_nodes(mesh, [&](const Vector& at) -> Vector { return axes * at; });
}

void displace(Mesh& mesh, const NodalField& displacements) {
  const std::array columns = {displacements.component("DX"), displacements.component("DY"),
                              displacements.component("DZ")};
  const std::size_t expected = mesh.nodes.size() * displacements.components.size();
  if (columns[0] < 0 || displacements.values.size() != expected) {
    throw Error("incompatible-field", "the field is not one of displacements on the nodes of this mesh",
                "give a field with DX, DY and, in space, DZ, made on the same mesh");
  }
  for (int node = 0; node < mesh.node_count(); ++node) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (columns[axis] < 0) continue;
      const double shift = displacements.at(node, columns[axis]);
      if (!std::isnan(shift)) mesh.nodes[static_cast<std::size_t>(node)][axis] += shift;
    }
  }
  leave_plane(mesh);
}

}  // namespace comma::solver
