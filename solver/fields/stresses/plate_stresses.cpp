#include "solver/fields/stresses/plate_stresses.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include <Eigen/Dense>

#include "solver/fields/stresses/plate_forces.hpp"
#include "solver/model/stress_names.hpp"

namespace comma::solver {

namespace {

constexpr int places_a_layer = 3;

/// Where a place lies, as a share of half the thickness: -1 below, 1 above.
double share_of(int place, const PlateSection& section) {
  return (2.0 * (place / places_a_layer) + place % places_a_layer) / section.layers - 1.0;
}

/// At a share of half the thickness (-1 below, 1 above) over the middle of the plate.
std::array<double, 6> stress_at(double share, const PlateSection& section, const PlateForces& forces) {
  const double h = section.thickness;
  const Eigen::Vector3d normal = forces.head<3>(), moment = forces.segment<3>(3) - section.offset * normal;
  const Eigen::Vector3d plane = normal / h + share * 6.0 / (h * h) * moment;
  const Eigen::Vector2d shear = 1.5 * (1.0 - share * share) / h * forces.tail<2>();
  return {plane[0], plane[1], 0.0, plane[2], shear[0], shear[1]};
}

std::array<double, 6> strain_at(double share, const PlateSection& section, const PlateForces& strains) {
  const double height = section.offset + 0.5 * share * section.thickness;
  const Eigen::Vector3d plane = strains.head<3>() + height * strains.segment<3>(3);
  return {plane[0], plane[1], 0.0, plane[2], strains[6], strains[7]};
}

/// The tensor `value_at(share, section, values)` at each place in the thickness, `values` being the eight that
/// `read(cell, point)` gives.
template <class Read, class ValueAt>
ElementField in_layers(const Model& model, const ElementProperties& properties, const ElementField& source,
                       std::string quantity, std::span<const std::string_view, 6> names, Read&& read,
                       ValueAt&& value_at) {
  const int cells = model.mesh->cell_count();
  ElementField field{std::move(quantity),
                     source.support,
                     {names.begin(), names.end()},
                     {0},
                     {},
                     std::vector<int>(static_cast<std::size_t>(cells), 1)};
  for (int cell = 0; cell < cells; ++cell) {
    if (source.points(cell) == 0) {
      field.starts.push_back(field.starts.back());
      continue;
    }
    const PlateSection& section = plate_section(model, properties, cell);
    const int places = places_a_layer * section.layers;
    for (int point = 0; point < source.points(cell); ++point) {
      const PlateForces values = read(cell, point);
      for (int place = 0; place < places; ++place) {
        const auto tensor = value_at(share_of(place, section), section, values);
        field.values.insert(field.values.end(), tensor.begin(), tensor.end());
      }
    }
    field.sub_points[static_cast<std::size_t>(cell)] = places;
    field.starts.push_back(field.starts.back() + source.points(cell) * places);
  }
  return field;
}

}  // namespace

ElementField plate_stresses(const Model& model, const ElementProperties& properties, const ElementField& forces) {
  const PlateForceReader reader(forces);
  return in_layers(
      model, properties, forces, "SIEF_R", solid_stress_names,
      [&](int cell, int point) { return reader.at(cell, point); }, stress_at);
}

// Simpson's rule in each layer, exact for cubics.
std::optional<PlateForces> forces_of_plate_stresses(const PlateSection& section, std::span<const double> stresses) {
  using Stress = Eigen::Map<const Eigen::Matrix<double, 6, 1>>;
  constexpr double same = 1e-6;
  const auto at = [&](int place) { return Stress(stresses.data() + 6 * place); };
  const int places = places_a_layer * section.layers;
  PlateForces forces = PlateForces::Zero();
  double largest = 0.0;
  for (int place = 0; place < places; ++place) {
    const Stress stress = at(place);
    const double height = 0.5 * share_of(place, section) * section.thickness + section.offset;
    const double weight = (place % places_a_layer == 1 ? 4.0 : 1.0) / 6.0 * section.thickness / section.layers;
    const Eigen::Vector3d plane(stress[0], stress[1], stress[3]);
    forces.head<3>() += weight * plane;
    forces.segment<3>(3) += weight * height * plane;
    forces.tail<2>() += weight * stress.tail<2>();
    largest = std::max(largest, stress.lpNorm<Eigen::Infinity>());
  }
  for (int place = 0; place < places; ++place) {
    const auto made = stress_at(share_of(place, section), section, forces);
    // Written so that what is not a number is no stress.
    if (!((at(place) - Stress(made.data())).lpNorm<Eigen::Infinity>() <= same * largest)) return std::nullopt;
  }
  return forces;
}

ElementField plate_layer_strains(const Model& model, const ElementProperties& properties, const ElementField& strains) {
  static constexpr std::array<std::string_view, 6> names = {"EPXX", "EPYY", "EPZZ", "EPXY", "EPXZ", "EPYZ"};
  return in_layers(
      model, properties, strains, "EPSI_R", names,
      [&](int cell, int point) {
        PlateForces values;
        for (int c = 0; c < 8; ++c) values[c] = strains.at(cell, point, c);
        return values;
      },
      strain_at);
}

int most_layers(const ElementField& field) {
  return field.sub_points.empty() ? 0 : *std::ranges::max_element(field.sub_points) / places_a_layer;
}

ElementField values_in_layer(const ElementField& field, int layer, LayerSide side) {
  const int place = places_a_layer * (layer - 1) + static_cast<int>(side);
  ElementField result{field.quantity, field.support, field.components, {0}, {}};
  for (int cell = 0; cell + 1 < static_cast<int>(field.starts.size()); ++cell) {
    const int each = field.values_a_point(cell);
    const int points = each > 1 && place < each ? field.points(cell) / each : 0;
    for (int point = 0; point < points; ++point) {
      for (int c = 0; c < static_cast<int>(field.components.size()); ++c)
        result.values.push_back(field.at(cell, point * each + place, c));
    }
    result.starts.push_back(result.starts.back() + points);
  }
  return result;
}

}  // namespace comma::solver
