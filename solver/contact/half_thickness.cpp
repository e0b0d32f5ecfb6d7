#include "solver/contact/half_thickness.hpp"

#include <utility>

#include <fmt/format.h>

#include "solver/error.hpp"

namespace comma::solver {
namespace {

template <class Sections>
const auto& section_of(const Sections& sections, const Mesh& mesh, int cell) {
  const auto found = sections.find(cell);
  if (found != sections.end()) return found->second;
  throw Error("missing-section",
              fmt::format("the element on cell {} has no section, which contact is to add to its surface",
                          mesh.cell_name(cell)),
              "give it one in AFFE_CARA_ELEM");
}

double radius_of(const BeamSection& section, const Mesh& mesh, int cell) {
  if (section.shape == SectionShape::circle) return section.reach_y;
  throw Error(
      "unsupported",
      fmt::format(
          "the section of the beam on cell {} is no circle: how far its surface lies from its axis depends on the side",
          mesh.cell_name(cell)),
      "give the distance itself (DIST_MAIT, DIST_ESCL)");
}

}  // namespace

std::unordered_map<int, double> beam_radii(const Model& model, const ElementProperties& properties,
                                           std::span<const int> cells) {
  std::unordered_map<int, double> radii;
  const Mesh& mesh = *model.mesh;
  for (const int cell : cells) {
    if (!is_beam(model.formulations[static_cast<std::size_t>(cell)])) continue;
    const BeamSection& section = section_of(properties.sections, mesh, cell);
    const double first = radius_of(section, mesh, cell);
    radii[cell] = section.end ? 0.5 * (first + radius_of(*section.end, mesh, cell)) : first;
  }
  return radii;
}

std::unordered_map<int, double> plate_half_thicknesses(const Model& model, const ElementProperties& properties,
                                                       std::span<const int> cells) {
  std::unordered_map<int, double> halves;
  for (const int cell : cells) {
    if (!is_plate(model.formulations[static_cast<std::size_t>(cell)])) continue;
    const auto& section = section_of(properties.plates, *model.mesh, cell);
    if (section.offset != 0.0)
      throw Error("unsupported",
                  fmt::format("plate {} is eccentric by {:.6g} (EXCENTREMENT), and DIST_COQUE takes its faces for half "
                              "of its thickness off the cell",
                              model.mesh->cell_name(cell), section.offset),
                  "give the distance of the face from the cell by DIST_ESCL or DIST_MAIT");
    halves[cell] = 0.5 * section.thickness;
  }
  return halves;
}

double half_thickness(const ContactZone& zone, int cell) {
  const auto found = zone.half_thickness.find(cell);
  return found == zone.half_thickness.end() ? 0.0 : found->second;
}

std::unordered_map<int, double> nodal_half_thickness(const ContactZone& zone, const Mesh& mesh) {
  std::unordered_map<int, std::pair<double, int>> sums;
  for (const int cell : zone.slave_cells) {
    if (!zone.half_thickness.contains(cell)) continue;
    for (const int node : mesh.cell(cell)) {
      auto& [sum, count] = sums[node];
      sum += half_thickness(zone, cell);
      ++count;
    }
  }
  std::unordered_map<int, double> means;
  for (const auto& [node, sum] : sums) means.emplace(node, sum.first / sum.second);
  return means;
}

}  // namespace comma::solver
