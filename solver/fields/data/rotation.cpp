#include "solver/fields/data/rotation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>

#include <fmt/format.h>

#include "solver/error.hpp"
#include "solver/fields/data/component_group.hpp"

namespace comma::solver {

namespace {

using VectorNames = std::array<const char*, 3>;
using TensorNames = std::array<const char*, 6>;  // xx yy zz xy xz yz

constexpr VectorNames vectors[] = {{"DX", "DY", "DZ"}, {"DRX", "DRY", "DRZ"}, {"FX", "FY", "FZ"}, {"MX", "MY", "MZ"}};
constexpr TensorNames tensors[] = {{"SIXX", "SIYY", "SIZZ", "SIXY", "SIXZ", "SIYZ"},
                                   {"EPXX", "EPYY", "EPZZ", "EPXY", "EPXZ", "EPYZ"}};

template <class Columns>
bool any_present(const Columns& columns) {
  return std::any_of(columns.begin(), columns.end(), [](int column) { return column >= 0; });
}

std::array<double, 3> turned(const std::array<double, 3>& v, const Eigen::Matrix3d& axes) {
  const Eigen::Vector3d own = axes * Eigen::Vector3d(v.data());
  return {own[0], own[1], own[2]};
}

std::array<double, 6> turned(const std::array<double, 6>& t, const Eigen::Matrix3d& axes) {
  const Eigen::Matrix3d own = axes * tensor_of(t) * axes.transpose();
  return {own(0, 0), own(1, 1), own(2, 2), own(0, 1), own(0, 2), own(1, 2)};
}

/// A field with all components of every group that the given one has a part of.
std::vector<std::string> completed(const NodalField& field) {
  std::vector<std::string> names = field.components;
  const auto complete = [&](const auto& group) {
    if (!any_present(columns_of(field, group))) return;
    for (const char* name : group) {
      if (std::find(names.begin(), names.end(), name) == names.end()) names.emplace_back(name);
    }
  };
  for (const auto& group : vectors) complete(group);
  for (const auto& group : tensors) complete(group);
  return names;
}

template <class Names>
void turn_group(const NodalField& field, std::span<const int> nodes, const NodeAxes& axes, const Names& names,
                NodalField& result) {
  const auto from = columns_of(field, names);
  if (!any_present(from)) return;
  const auto to = columns_of(result, names);
  std::array<double, std::tuple_size_v<Names>> values{};
  for (const int node : nodes) {
    if (!gather(field, node, from, values)) continue;
    const auto own = turned(values, axes(node));
    for (std::size_t i = 0; i < own.size(); ++i) {
      result.values[static_cast<std::size_t>(node) * result.components.size() + static_cast<std::size_t>(to[i])] =
          own[i];
    }
  }
}

}  // namespace

bool has_own_axes(const NodalField& field, std::string_view component) {
  constexpr std::string_view names[] = {
      "N",    "VX",   "VY",   "VZ",  "MT",   "MFY",  "MFZ", "NXX", "NYY", "NXY",  "MXX",  "MYY",  "MXY",  "QX",
      "QY",   "EXX",  "EYY",  "EXY", "KXX",  "KYY",  "KXY", "GAX", "GAY", "GAXY", "GAXZ", "GAT",  "KY",   "KZ",
      "SN",   "SVY",  "SVZ",  "SMT", "SMFY", "SMFZ", "RNX", "RNY", "RNZ", "GLIX", "GLIY", "RTAX", "RTAY", "RTAZ",
      "RTGX", "RTGY", "RTGZ", "RX",  "RY",   "RZ",   "IX",  "IY",  "IZ",  "X",    "Y",    "Z"};
  // The elongation of a beam has the name of a strain in space.
  if (component == "EPXX") return field.component("GAXY") >= 0;
  return std::ranges::find(names, component) != std::end(names);
}

NodalField in_axes(const NodalField& field, std::span<const int> nodes, const NodeAxes& axes) {
  NodalField result{field.quantity, completed(field), {}};
  const std::size_t width = result.components.size();
  result.values.assign(field.values.size() / field.components.size() * width, absent);
  for (const int node : nodes) {
    for (std::size_t c = 0; c < field.components.size(); ++c) {
      result.values[static_cast<std::size_t>(node) * width + c] = field.at(node, static_cast<int>(c));
    }
  }
  for (const auto& group : vectors) turn_group(field, nodes, axes, group, result);
  for (const auto& group : tensors) turn_group(field, nodes, axes, group, result);
  return result;
}

NodalField with_shear_of_plane(const NodalField& turned) {
  std::vector<int> kept;
  NodalField result{turned.quantity, {}, {}};
  for (std::size_t c = 0; c < turned.components.size(); ++c) {
    const std::string& name = turned.components[c];
    const bool is_shear = name.ends_with("XY") || name.ends_with("XZ") || name.ends_with("YZ");
    if (is_shear && name.size() == 4 && !name.ends_with("XZ")) continue;
    kept.push_back(static_cast<int>(c));
    result.components.push_back(is_shear && name.size() == 4 ? name.substr(0, 2) + "XY" : name);
  }
  const std::size_t rows = turned.values.size() / std::max<std::size_t>(turned.components.size(), 1);
  for (std::size_t row = 0; row < rows; ++row)
    for (const int c : kept) result.values.push_back(turned.at(static_cast<int>(row), c));
  return result;
}

NodeAxes revolution_axes(const Mesh& mesh, const Eigen::Vector3d& origin, const Eigen::Vector3d& axis) {
  if (!(axis.norm() > 0.0)) throw Error("zero-vector", "the axis of revolution has no length");
  const Eigen::Vector3d along = axis.normalized();
  return [&mesh, origin, along](int node) {
    const Eigen::Vector3d from_origin = Eigen::Vector3d(mesh.nodes[node].data()) - origin;
    const Eigen::Vector3d radial = from_origin - along.dot(from_origin) * along;
    // Nearer than this the direction is made up by rounding.
    constexpr double nearest = 1e-12;
    if (!(radial.norm() > nearest * from_origin.norm())) {
      throw Error("zero-vector",
                  fmt::format("node {} lies on the axis, where there is no radial direction", mesh.node_name(node)));
    }
    Eigen::Matrix3d axes;
    axes.row(0) = radial.normalized();
    axes.row(1) = along;
    axes.row(2) = along.cross(radial.normalized());
    return axes;
  };
}

bool has_axes(const NodeAxes& axes, int node) {
  try {
    axes(node);
    return true;
  } catch (const Error& error) {
    if (error.code() != "zero-vector") throw;
    return false;
  }
}

NodeAxes with_axes_of_neighbours(const Mesh& mesh, std::span<const int> nodes, NodeAxes axes) {
  std::vector<int> known;
  std::ranges::copy_if(nodes, std::back_inserter(known), [&](int node) { return has_axes(axes, node); });
  if (known.empty() || known.size() == nodes.size()) return axes;
  return [&mesh, known, axes](int node) {
    if (has_axes(axes, node)) return axes(node);
    const auto place = [&](int each) { return Eigen::Vector3d(mesh.nodes[static_cast<std::size_t>(each)].data()); };
    return axes(
        *std::ranges::min_element(known, {}, [&](int each) { return (place(each) - place(node)).squaredNorm(); }));
  };
}

NodeAxes polar_axes(const Mesh& mesh) {
  return [&mesh](int node) {
    const Eigen::Vector3d radial(mesh.nodes[node][0], mesh.nodes[node][1], 0.0);
    if (!(radial.norm() > 0.0)) {
      throw Error("zero-vector",
                  fmt::format("node {} lies on the axis, where there is no radial direction", mesh.node_name(node)));
    }
    Eigen::Matrix3d axes;
    axes.row(0) = radial.normalized();
    axes.row(2) = Eigen::Vector3d::UnitZ();
    axes.row(1) = axes.row(0).cross(axes.row(2));
    return axes;
  };
}

namespace {

/// The direction from each node of a line to the next.
std::vector<Eigen::Vector3d> segment_directions(const Mesh& mesh, std::span<const int> nodes) {
  if (nodes.size() < 2)
    throw Error("zero-vector", "a line of one node has no direction",
                "name several nodes, in their order along the line");
  std::vector<Eigen::Vector3d> directions;
  for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
    const Eigen::Vector3d a(mesh.nodes[nodes[i]].data()), b(mesh.nodes[nodes[i + 1]].data());
    if (a == b) {
      throw Error("zero-vector", fmt::format("nodes {} and {}, neighbours on the line, lie at one place",
                                             mesh.node_name(nodes[i]), mesh.node_name(nodes[i + 1])));
    }
    directions.push_back((b - a).normalized());
  }
  return directions;
}

Eigen::Vector3d across(const Mesh& mesh, const Eigen::Vector3d& tangent, const std::optional<Eigen::Vector3d>& y) {
  if (!y && mesh.dimension == 2) return Eigen::Vector3d::UnitZ().cross(tangent);
  if (!y)
    throw Error("missing-direction", "in space a line alone does not say where its second axis is",
                "give that direction");
  const Eigen::Vector3d part = *y - y->dot(tangent) * tangent;
  // Nearer than this the direction is made up by rounding.
  constexpr double nearest = 1e-12;
  if (!(part.norm() > nearest * y->norm())) throw Error("zero-vector", "the second direction lies along the line");
  return part.normalized();
}

/// Axes from tangents, one a node, and the directions of the segments between nodes; where a tangent vanishes (the line
/// turns back) it is that of the segment before.
NodeAxes axes_along(const Mesh& mesh, std::span<const int> nodes, std::span<const Eigen::Vector3d> directions,
                    std::span<const Eigen::Vector3d> tangents, const std::optional<Eigen::Vector3d>& y) {
  std::map<int, Eigen::Matrix3d> axes_of;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    Eigen::Matrix3d axes;
    axes.row(0) = tangents[i].isZero(0.0) ? directions[i == 0 ? 0 : i - 1] : Eigen::Vector3d(tangents[i].normalized());
    axes.row(1) = across(mesh, axes.row(0), y);
    axes.row(2) = axes.row(0).cross(axes.row(1));
    axes_of.emplace(nodes[i], axes);
  }
  return [axes_of = std::move(axes_of)](int node) { return axes_of.at(node); };
}

}  // namespace

NodeAxes line_axes(const Mesh& mesh, std::span<const int> nodes, const std::optional<Eigen::Vector3d>& y) {
  const auto directions = segment_directions(mesh, nodes);
  std::vector<Eigen::Vector3d> tangents;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    tangents.push_back(directions[i == 0 ? 0 : i - 1] + directions[std::min(i, directions.size() - 1)]);
  return axes_along(mesh, nodes, directions, tangents, y);
}

NodeAxes chord_axes(const Mesh& mesh, std::span<const int> nodes, const std::optional<Eigen::Vector3d>& y) {
  std::vector<Eigen::Vector3d> tangents;
  const auto at = [&](std::size_t i) { return Eigen::Vector3d(mesh.nodes[nodes[i]].data()); };
  for (std::size_t i = 0; i < nodes.size(); ++i)
    tangents.push_back(at(std::min(i + 1, nodes.size() - 1)) - at(i == 0 ? 0 : i - 1));
  return axes_along(mesh, nodes, segment_directions(mesh, nodes), tangents, y);
}

std::function<Eigen::Vector3d(int)> line_normals(const Mesh& mesh, std::span<const int> nodes,
                                                 const std::optional<Eigen::Vector3d>& y) {
  std::vector<Eigen::Vector3d> normals;
  for (const Eigen::Vector3d& tangent : segment_directions(mesh, nodes)) normals.push_back(across(mesh, tangent, y));
  std::map<int, Eigen::Vector3d> normal_of;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    normal_of.emplace(nodes[i], 0.5 * (normals[i == 0 ? 0 : i - 1] + normals[std::min(i, normals.size() - 1)]));
  return [normal_of = std::move(normal_of)](int node) { return normal_of.at(node); };
}

Resultant resultant(const Mesh& mesh, const NodalField& forces, std::span<const int> nodes,
                    const Eigen::Vector3d& point, const std::array<std::string, 3>& components) {
  const auto force_columns = columns_of(forces, components);
  const auto moment_columns = columns_of(forces, vectors[1]);
  Resultant sum;
  for (const int node : nodes) {
    std::array<double, 3> force{}, moment{};
    gather(forces, node, force_columns, force);
    gather(forces, node, moment_columns, moment);
    const Eigen::Vector3d f(force.data());
    sum.force += f;
    sum.moment += Eigen::Vector3d(moment.data()) + (Eigen::Vector3d(mesh.nodes[node].data()) - point).cross(f);
  }
  return sum;
}

}  // namespace comma::solver
