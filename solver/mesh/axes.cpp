#include "solver/mesh/axes.hpp"

#include <cmath>

#include "solver/error.hpp"

namespace comma::solver {

Eigen::Matrix3d nautical_axes(double yaw, double pitch, double roll) {
  using Eigen::AngleAxisd;
  using Eigen::Vector3d;
  const Eigen::Matrix3d turn =
      (AngleAxisd(yaw, Vector3d::UnitZ()) * AngleAxisd(pitch, Vector3d::UnitY()) * AngleAxisd(roll, Vector3d::UnitX()))
          .toRotationMatrix();
  return turn.transpose();
}

Eigen::Vector3d nautical_angles(const Eigen::Matrix3d& axes) {
  // Yaw and roll of an axis this near that of Z are one turn, and rounding would part it.
  constexpr double upright = 1e-9;
  const Eigen::Vector3d along = axes.row(0);
  const double level = std::hypot(along[0], along[1]);
  const double yaw = level < upright ? 0.0 : std::atan2(along[1], along[0]);
  const double pitch = std::atan2(0.0 - along[2], level);
  const Eigen::Matrix3d unrolled = nautical_axes(yaw, pitch, 0.0);
  const double roll = std::atan2(axes.row(1).dot(unrolled.row(2)), axes.row(1).dot(unrolled.row(1)));
  return {yaw, pitch, roll};
}

Eigen::Matrix3d euler_axes(double precession, double nutation, double rotation) {
  using Eigen::AngleAxisd;
  using Eigen::Vector3d;
  const Eigen::Matrix3d turn = (AngleAxisd(precession, Vector3d::UnitZ()) * AngleAxisd(nutation, Vector3d::UnitX()) *
                                AngleAxisd(rotation, Vector3d::UnitZ()))
                                   .toRotationMatrix();
  return turn.transpose();
}

Eigen::Vector3d centre_of(const Mesh& mesh, int cell) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  const auto nodes = mesh.cell(cell);
  for (const int node : nodes) sum += Eigen::Map<const Eigen::Vector3d>(mesh.nodes[node].data());
  return sum / static_cast<double>(nodes.size());
}

Eigen::Matrix3d cylindrical_axes(double yaw, double pitch, const Eigen::Vector3d& origin, const Eigen::Vector3d& at) {
  const Eigen::Vector3d along = nautical_axes(yaw, pitch, 0.0).row(0);
  const Eigen::Vector3d from_origin = at - origin;
  const Eigen::Vector3d radial = from_origin - along.dot(from_origin) * along;
  // A centre this near the axis has no radial direction that rounding has not made up.
  constexpr double nearest = 1e-12;
  if (!(radial.norm() > nearest * from_origin.norm())) {
    throw Error("distorted-cell",
                "a cell with cylindrical material axes has its centre on the axis, where they are not defined");
  }
  Eigen::Matrix3d axes;
  axes.row(0) = radial.normalized();
  axes.row(2) = along;
  axes.row(1) = along.cross(axes.row(0).transpose());
  return axes;
}

Eigen::Matrix3d material_axes_round(const Eigen::Matrix3d& cylindrical, bool in_space) {
  if (!in_space) return cylindrical;
  Eigen::Matrix3d axes;
  axes << cylindrical.row(2), cylindrical.row(1), -cylindrical.row(0);
  return axes;
}

}  // namespace comma::solver
