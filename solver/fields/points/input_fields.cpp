#include "solver/fields/points/input_fields.hpp"

#include <cmath>
#include <numbers>

#include "solver/error.hpp"
#include "solver/fields/data/field_room.hpp"

namespace comma::solver {

namespace {

constexpr double degree = std::numbers::pi / 180.0;

void put(ElementField& field, int cell, std::span<const double> values) {
  std::copy(values.begin(), values.end(),
            field.values.begin() + field.starts[cell] * static_cast<std::ptrdiff_t>(values.size()));
}

void add(ElementField& field, int cell, std::span<const double> values) {
  auto slot = field.values.begin() + field.starts[cell] * static_cast<std::ptrdiff_t>(values.size());
  for (const double value : values) {
    *slot = (std::isnan(*slot) ? 0.0 : *slot) + value;
    ++slot;
  }
}

void require_number(bool is_function, const char* what) {
  if (!is_function) return;
  throw Error("unsupported",
              std::string("the load has ") + what + " given by functions, which have no one value a cell",
              "take the fields of a load that is given by numbers");
}

}  // namespace

ElementField plate_data(const Mesh& mesh, const PlateSections& plates) {
  ElementField field = empty_cell_field(mesh, "CACOQU_R", {"EP", "ALPHA", "BETA", "CTOR", "EXCENT", "KAPPA"});
  for (const auto& [cell, plate] : plates) {
    const Eigen::Vector3d& first = plate.direction;
    const double alpha = std::atan2(first.y(), first.x()) / degree;
    const double beta = -std::atan2(first.z(), std::hypot(first.x(), first.y())) / degree;
    put(field, cell, std::array{plate.thickness, alpha, beta, plate.drilling, plate.offset, plate.shear_factor});
  }
  drop_empty_cells(field);
  return field;
}

ElementField layer_counts(const Mesh& mesh, const PlateSections& plates) {
  ElementField field = empty_cell_field(mesh, "NBSP_R", {"COQ_NCOU"});
  for (const auto& [cell, plate] : plates) put(field, cell, std::array{static_cast<double>(plate.layers)});
  drop_empty_cells(field);
  return field;
}

ElementField force_data(const Mesh& mesh, const Load& load, int cell_dimension) {
  ElementField field = empty_cell_field(mesh, "FORC_R", {"FX", "FY", "FZ"});
  for (const DistributedForce& force : load.distributed_forces) {
    if (dimension(mesh.cell_types[force.cell]) != cell_dimension) continue;
    for (const FieldFunction& function : force.functions)
      require_number(static_cast<bool>(function), "distributed forces");
    for (const NodalFunction& function : force.functions_at_nodes)
      require_number(static_cast<bool>(function), "distributed forces");
    add(field, force.cell, force.force);
  }
  drop_empty_cells(field);
  return field;
}

ElementField pressure_data(const Mesh& mesh, const Load& load) {
  ElementField field = empty_cell_field(mesh, "PRES_R", {"PRES", "CISA"});
  for (const PressureLoad& pressure : load.pressures) {
    require_number(pressure.pressure_function || pressure.pressure_at_nodes, "pressures");
    require_number(static_cast<bool>(pressure.shear_function), "shear tractions");
    add(field, pressure.cell, std::array{pressure.pressure, pressure.shear});
  }
  drop_empty_cells(field);
  return field;
}

}  // namespace comma::solver
