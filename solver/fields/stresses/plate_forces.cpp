#include "solver/fields/stresses/plate_forces.hpp"

#include <array>
#include <string_view>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <Eigen/Dense>

#include "solver/error.hpp"
#include "solver/fields/data/field_parts.hpp"
#include "solver/model/stress_names.hpp"

namespace comma::solver {

namespace {

constexpr std::array<std::array<std::string_view, 2>, 3> pairs = {{{"NXX", "MXX"}, {"NYY", "MYY"}, {"NXY", "MXY"}}};

int column_of(const ElementField& field, std::string_view name) {
  const int column = field.component(name);
  if (column < 0)
    throw Error("unknown-component", fmt::format("the field has no component {}, as forces of plates have", name));
  return column;
}

// Command variables count by their mean over the corners.
MaterialPoint middle_of_plate(const FieldInput& input, int cell) {
  const auto nodes = input.model.mesh->cell(cell);
  const std::vector<double> shares(nodes.size(), 1.0 / static_cast<double>(nodes.size()));
  MaterialPoint at;
  input.state.sample(cell, nodes, shares, VariableState::all_points, at);
  std::array<double, 3> place{};
  for (const int node : nodes)
    for (std::size_t c = 0; c < 3; ++c)
      place[c] += input.model.mesh->nodes[static_cast<std::size_t>(node)][c] / static_cast<double>(nodes.size());
  at.place(place);
  return at;
}

/// An elastic plate of unit width at one place.
struct PlateInUse {
  PlateSection section;
  IsotropicModuli material;
  double expansion;
};

PlateInUse plate_in_use(const FieldInput& input, int cell) {
  const PlateSection& section = plate_section(input.model, input.properties, cell);
  const auto* material = std::get_if<IsotropicElasticity>(material_of(input, cell).elasticity);
  if (material == nullptr)
    throw Error("unsupported",
                fmt::format("the plate on cell {} has an anisotropic material", input.model.mesh->cell_name(cell)));
  const MaterialPoint at = middle_of_plate(input, cell);
  return {section, moduli(*material, at), inelastic_axial_strain(*material, at)};
}

/// xx, yy and half the angle xy that plane forces, or moments, of a resistance 1 / compliance cause.
Eigen::Vector3d plane_strain_of(const Eigen::Vector3d& forces, double compliance, double poisson) {
  return compliance *
         Eigen::Vector3d(forces[0] - poisson * forces[1], forces[1] - poisson * forces[0], (1.0 + poisson) * forces[2]);
}

/// GAX and GAY are halves of angles as EXY is, and those of the shear force in thin plates too, which have no such
/// strain: so Code_Aster has them.
PlateForces strains_of(const PlateInUse& plate, const PlateForces& forces) {
  const double h = plate.section.thickness, offset = plate.section.offset;
  const Eigen::Vector3d normal = forces.head<3>();
  const Eigen::Vector3d curvature = plane_strain_of(forces.segment<3>(3) - offset * normal,
                                                    12.0 / (plate.material.young * h * h * h), plate.material.poisson);
  PlateForces strains = PlateForces::Zero();
  strains.head<3>() =
      plane_strain_of(normal, 1.0 / (plate.material.young * h), plate.material.poisson) - offset * curvature;
  strains.head<2>().array() += plate.expansion;
  strains.segment<3>(3) = curvature;
  const double shear_modulus = 0.5 * plate.material.young / (1.0 + plate.material.poisson);
  strains.tail<2>() = 0.5 * forces.tail<2>() / (plate.section.shear_factor * shear_modulus * h);
  return strains;
}

}  // namespace

PlateForceReader::PlateForceReader(const ElementField& field) : field_(field) {
  for (std::size_t c = 0; c < columns_.size(); ++c) columns_[c] = column_of(field, plate_force_names[c]);
}

PlateForces PlateForceReader::at(int cell, int point) const {
  PlateForces forces;
  for (std::size_t c = 0; c < columns_.size(); ++c)
    forces[static_cast<Eigen::Index>(c)] = field_.at(cell, point, columns_[c]);
  return forces;
}

const PlateSection& plate_section(const Model& model, const ElementProperties& properties, int cell) {
  const auto found = properties.plates.find(cell);
  if (found != properties.plates.end()) return found->second;
  throw Error("missing-properties", fmt::format("the plate on cell {} has no thickness", model.mesh->cell_name(cell)));
}

ElementField plate_strains(const FieldInput& input, const ElementField& forces) {
  const PlateForceReader reader(forces);
  ElementField result{"EPSI_R", forces.support, {"EXX", "EYY", "EXY", "KXX", "KYY", "KXY", "GAX", "GAY"}, {0}, {}};
  for (int cell = 0; cell < input.model.mesh->cell_count(); ++cell) {
    const bool is_one =
        is_plate(input.model.formulations[static_cast<std::size_t>(cell)]) && !input.model.is_skin(cell);
    const int points = is_one ? forces.points(cell) : 0;
    result.starts.push_back(result.starts.back() + points);
    if (points == 0) continue;
    const PlateInUse plate = plate_in_use(input, cell);
    for (int point = 0; point < points; ++point) {
      const PlateForces strains = strains_of(plate, reader.at(cell, point));
      result.values.insert(result.values.end(), strains.begin(), strains.end());
    }
  }
  return result;
}

ElementField forces_about_middle(const Model& model, const ElementProperties& properties, const ElementField& forces,
                                 std::span<const int> cells) {
  std::vector<int> plates;
  for (const int cell : cells) {
    if (is_plate(model.formulations[cell]) && !model.is_skin(cell)) plates.push_back(cell);
  }
  if (plates.empty()) throw Error("not-a-plate", "none of these cells is a plate");
  ElementField result = on_cells(forces, plates);
  const std::size_t width = result.components.size();
  for (const auto& [force_name, moment_name] : pairs) {
    const auto force = static_cast<std::size_t>(column_of(result, force_name));
    const auto moment = static_cast<std::size_t>(column_of(result, moment_name));
    for (const int cell : plates) {
      const double offset = plate_section(model, properties, cell).offset;
      for (int point = result.starts[cell]; point < result.starts[cell + 1]; ++point) {
        double* row = result.values.data() + static_cast<std::size_t>(point) * width;
        row[moment] -= offset * row[force];
      }
    }
  }
  return result;
}

}  // namespace comma::solver
