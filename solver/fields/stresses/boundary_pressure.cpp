#include "solver/fields/stresses/boundary_pressure.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "solver/contact/normals.hpp"
#include "solver/error.hpp"
#include "solver/fields/data/field_room.hpp"
#include "solver/model/stress_names.hpp"

namespace comma::solver {

namespace {

Eigen::Matrix3d stress_at(const NodalField& field, const std::array<int, 6>& columns, int node) {
  const auto value = [&](int i) {
    const double given = columns[i] < 0 ? 0.0 : field.at(node, columns[i]);
    return i > 3 && std::isnan(given) ? 0.0 : given;  // a plane body has no stresses across its plane
  };
  Eigen::Matrix3d stress;
  stress << value(0), value(3), value(4), value(3), value(1), value(5), value(4), value(5), value(2);
  return stress;
}

}  // namespace

NodalField boundary_pressure(const Mesh& mesh, const NodalField& stresses, std::span<const int> cells,
                             std::span<const Eigen::Vector3d> positions) {
  std::array<int, 6> columns;
  for (int i = 0; i < 6; ++i) columns[i] = stresses.component(solid_stress_names[i]);
  if (columns[0] < 0 || columns[1] < 0)
    throw Error("incompatible-field", "the field at the nodes has no stresses SIXX and SIYY");
  for (const int cell : cells)
    if (const CellType type = mesh.cell_types[static_cast<std::size_t>(cell)]; dimension(type) == mesh.dimension)
      throw Error(
          "wrong-surface",
          fmt::format("{} is a cell of the body itself ({}), not of its boundary", mesh.cell_name(cell), name_of(type)),
          "name a group of boundary cells");
  NodalField pressure = mesh.dimension == 2 ? empty_nodal_field(mesh, "PRES_R", {"PRES", "CISA", "VX", "VY"})
                                            : empty_nodal_field(mesh, "PRES_R", {"PRES"});
  const std::size_t width = pressure.components.size();
  for (const auto& [node, normal] : nodal_normals(mesh, cells, positions)) {
    const Eigen::Vector3d traction = stress_at(stresses, columns, node) * normal;
    const double across = normal.dot(traction);
    const Eigen::Vector3d along = traction - across * normal;
    const std::array<double, 4> values = {across, along.norm(), along[0], along[1]};
    std::copy_n(values.begin(), width,
                pressure.values.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(node) * width));
  }
  return pressure;
}

}  // namespace comma::solver
