#include "solver/fields/stresses/beam_stresses.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "solver/elements/geometric_stiffness.hpp"
#include "solver/elements/slender/slender_member.hpp"
#include "solver/elements/slender/varying_section.hpp"
#include "solver/error.hpp"
#include "solver/model/stress_names.hpp"

namespace comma::solver {

namespace {

bool is_slender(Formulation formulation) { return is_beam(formulation) || is_bar(formulation); }

/// The section where a point of `count` lies: points go from the first node to the second, one alone is in the middle.
BeamSection section_of(const FieldInput& input, int cell, int point, int count) {
  const auto found = input.properties.sections.find(cell);
  if (found != input.properties.sections.end())
    return section_at(found->second, count == 1 ? 0.5 : static_cast<double>(point) / (count - 1));
  throw Error("missing-properties",
              fmt::format("the bar or beam on cell {} has no cross-section", input.model.mesh->cell_name(cell)));
}

/// A field with `names` on the bars and beams, on none where the forces have no N: `write(cell, section, forces,
/// target)` at each node.
template <class Write>
ElementField on_members(const FieldInput& input, const ElementField& forces, std::string quantity,
                        std::vector<std::string> names, Write&& write) {
  std::array<int, 6> columns;
  for (int i = 0; i < 6; ++i) columns[i] = forces.component(beam_force_names[i]);
  ElementField result{std::move(quantity), forces.support, std::move(names), {0}, {}};
  const std::size_t width = result.components.size();
  for (int cell = 0; cell < input.model.mesh->cell_count(); ++cell) {
    const int points = columns[0] >= 0 && is_slender(input.model.formulations[cell]) ? forces.points(cell) : 0;
    result.starts.push_back(result.starts.back() + points);
    for (int point = 0; point < points; ++point) {
      const auto force = [&](int i) {
        const double value = columns[i] < 0 ? 0.0 : forces.at(cell, point, columns[i]);
        return std::isnan(value) ? 0.0 : value;
      };
      const std::size_t start = result.values.size();
      result.values.resize(start + width, 0.0);
      write(cell, section_of(input, cell, point, points),
            SectionForces{force(0), force(1), force(2), force(3), force(4), force(5)}, result.values.data() + start);
    }
  }
  return result;
}

/// The largest stress that bending causes; `absent` where the section has no outline.
double bending_stress(const FieldInput& input, int cell, const BeamSection& section, const SectionForces& f) {
  if (!is_beam(input.model.formulations[cell])) return 0.0;
  const double about_y = std::abs(f.mfy) * section.reach_z / section.inertia_y;
  const double about_z = std::abs(f.mfz) * section.reach_y / section.inertia_z;
  switch (section.shape) {
    case SectionShape::rectangle:
      return about_y + about_z;
    case SectionShape::circle:
      return std::hypot(about_y, about_z);
    case SectionShape::general:
      break;
  }
  return absent;
}

const IsotropicElasticity& isotropic(const FieldInput& input, int cell) {
  const auto* material = std::get_if<IsotropicElasticity>(material_of(input, cell).elasticity);
  if (material != nullptr) return *material;
  throw Error("unsupported",
              fmt::format("the bar or beam on cell {} has an anisotropic material", input.model.mesh->cell_name(cell)));
}

/// Elongation and curvatures in the middle of a cell.
Eigen::Vector3d initial_strain(const FieldInput& input, const ImposedStrains* imposed, int cell) {
  if (imposed == nullptr || !imposed->acts_on(cell)) return Eigen::Vector3d::Zero();
  const Mesh& mesh = *input.model.mesh;
  const auto nodes = mesh.cell(cell);
  const Point &first = mesh.nodes[static_cast<std::size_t>(nodes[0])],
              &second = mesh.nodes[static_cast<std::size_t>(nodes[1])];
  return imposed->slender(
      cell, 0.5 * (Eigen::Map<const Eigen::Vector3d>(first.data()) + Eigen::Map<const Eigen::Vector3d>(second.data())));
}

}  // namespace

ElementField force_stresses(const FieldInput& input, const ElementField& forces) {
  return on_members(input, forces, "SIEF_R", {"SN", "SVY", "SVZ", "SMT", "SMFY", "SMFZ"},
                    [&](int cell, const BeamSection& section, const SectionForces& f, double* target) {
                      target[0] = f.n / section.area;
                      if (!is_beam(input.model.formulations[cell])) return;
                      // Of beams without shear Code_Aster gives means over the section.
                      const bool shears = input.model.formulations[cell] == Formulation::timoshenko_beam;
                      target[1] = f.vy * (shears ? section.shear_y : 1.0) / section.area;
                      target[2] = f.vz * (shears ? section.shear_z : 1.0) / section.area;
                      target[3] = f.mt * section.torsion_reach / section.torsion;
                      target[4] = f.mfy * section.reach_z / section.inertia_y;
                      target[5] = -f.mfz * section.reach_y / section.inertia_z;
                    });
}

ElementField extreme_stresses(const FieldInput& input, const ElementField& forces) {
  return on_members(input, forces, "SIEF_R", {"SIXXMIN", "SIXXMAX"},
                    [&](int cell, const BeamSection& section, const SectionForces& f, double* target) {
                      const double bending = bending_stress(input, cell, section, f);
                      target[0] = f.n / section.area - bending;
                      target[1] = f.n / section.area + bending;
                    });
}

ElementField generalised_strains(const FieldInput& input, const ElementField& forces, const ImposedStrains* imposed) {
  return on_members(input, forces, "EPSI_R", {"EPXX", "GAXY", "GAXZ", "GAT", "KY", "KZ"},
                    [&](int cell, const BeamSection& section, const SectionForces& f, double* target) {
                      const MaterialPoint at = middle_of(*input.model.mesh, cell, input.state);
                      const Eigen::Vector3d initial = initial_strain(input, imposed, cell);
                      const IsotropicElasticity& material = isotropic(input, cell);
                      const IsotropicModuli m = moduli(material, at);
                      const double shear = m.young / (2 * (1 + m.poisson));
                      target[0] = f.n / (m.young * section.area) + initial[0];
                      const Formulation formulation = input.model.formulations[cell];
                      if (!is_beam(formulation)) {
                        target[0] += inelastic_axial_strain(material, at);
                        return;
                      }
                      if (formulation == Formulation::timoshenko_beam) {
                        target[1] = f.vy * section.shear_y / (shear * section.area);
                        target[2] = f.vz * section.shear_z / (shear * section.area);
                      }
                      target[3] = f.mt / (shear * section.torsion);
                      target[4] = f.mfy / (m.young * section.inertia_y) + initial[1];
                      target[5] = f.mfz / (m.young * section.inertia_z) + initial[2];
                    });
}

}  // namespace comma::solver
