#include "solver/elements/slender/slender_member.hpp"

#include <fmt/format.h>

#include "solver/elements/slender/varying_section.hpp"
#include "solver/error.hpp"

namespace comma::solver {

namespace {

bool is_complete(const BeamSection& section, bool bends) {
  return section.area > 0.0 && (!bends || (section.inertia_y > 0.0 && section.inertia_z > 0.0 &&
                                           section.torsion > 0.0 && section.shear_y >= 0.0 && section.shear_z >= 0.0));
}

/// Bending in the planes (x, y) and (x, z) of a beam whose section varies.
std::array<Eigen::Matrix4d, 2> bending_planes(const BeamSection& section, const IsotropicModuli& material,
                                              double shear_modulus, double length, bool shear) {
  const BeamSection& end = *section.end;
  const auto plane = [&](double inertia, double end_inertia, int power, double factor, double end_factor) {
    const bool softens = shear && factor > 0.0 && end_factor > 0.0;
    const BendingPlane given{
        inertia, end_inertia,        softens ? section.area / factor : 0.0, softens ? end.area / end_factor : 0.0,
        power,   section.powers.area};
    return bending_stiffness(given, length, material.young, softens ? shear_modulus : 0.0);
  };
  return {plane(section.inertia_z, end.inertia_z, section.powers.inertia_z, section.shear_y, end.shear_y),
          plane(section.inertia_y, end.inertia_y, section.powers.inertia_y, section.shear_z, end.shear_z)};
}

/// In the axes of the member.
BeamMatrix own_stiffness(const BeamSection& section, const IsotropicModuli& material, double length, bool shear) {
  if (!varies(section)) return uniform_beam<double>(section, material, length, shear);
  const double shear_modulus = material.young / (2 * (1 + material.poisson));
  BeamMatrix k = BeamMatrix::Zero();
  add_beam_spring<double>(k, material.young * axial_area(section) / length, 0, 6);
  add_beam_spring<double>(k, shear_modulus * torsion_constant(section) / length, 3, 9);
  const auto planes = bending_planes(section, material, shear_modulus, length, shear);
  add_bending<double>(k, planes[0], {1, 5, 7, 11}, 1.0);
  add_bending<double>(k, planes[1], {2, 4, 8, 10}, -1.0);
  if (!is_eccentric(section)) return k;
  const BeamMatrix shift = centre_from_centroid(section);
  return shift.transpose() * k * shift;
}

/// What a matrix in the axes of a member, their rows, is in global axes.
BeamMatrix in_global_axes(const BeamMatrix& own, const Eigen::Matrix3d& axes) {
  BeamMatrix turn = BeamMatrix::Zero();
  for (int i = 0; i < 12; i += 3) turn.block<3, 3>(i, i) = axes;
  return turn.transpose() * own * turn;
}

}  // namespace

MaterialPoint middle_of(const Mesh& mesh, int cell, const VariableState& state) {
  constexpr std::array<double, 2> halves = {0.5, 0.5};
  const auto nodes = mesh.cell(cell);
  MaterialPoint at;
  state.sample(cell, nodes, halves, VariableState::all_points, at);
  std::array<double, 3> place{};
  for (std::size_t j = 0; j < 3; ++j)
    place[j] =
        0.5 * (mesh.nodes[static_cast<std::size_t>(nodes[0])][j] + mesh.nodes[static_cast<std::size_t>(nodes[1])][j]);
  at.place(place);
  return at;
}

const BeamSection& slender_section(const BlockInput& input, int cell) {
  const std::string name = input.model.mesh->cell_name(cell);
  const auto found = input.properties.sections.find(cell);
  if (found == input.properties.sections.end()) {
    throw Error("missing-properties", fmt::format("the bar or beam on cell {} has no cross-section", name));
  }
  const BeamSection& section = found->second;
  const bool bends = is_beam(input.model.formulations[cell]);
  if (!is_complete(section, bends) || (varies(section) && !is_complete(*section.end, bends))) {
    throw Error("invalid-properties", fmt::format("the cross-section of cell {} needs a positive area{}", name,
                                                  bends ? ", second moments of area and torsion constant" : ""));
  }
  return section;
}

SlenderMember slender_member(const BlockInput& input, int cell) {
  const Mesh& mesh = *input.model.mesh;
  const BeamSection& section = slender_section(input, cell);
  const auto nodes = mesh.cell(cell);
  const Eigen::Map<const Eigen::Vector3d> first(mesh.nodes[nodes[0]].data());
  const Eigen::Map<const Eigen::Vector3d> second(mesh.nodes[nodes[1]].data());
  const double roll = is_beam(input.model.formulations[cell]) ? section.roll : 0.0;
  return {(second - first).norm(), own_axes(mesh, cell, roll), &section, &isotropic_material(input, cell)};
}

BeamMatrix beam_stiffness(const SlenderMember& member, const IsotropicModuli& material, bool shears) {
  BeamMatrix k = in_global_axes(own_stiffness(*member.section, material, member.length, shears), member.axes);
  k = (0.5 * (k + k.transpose())).eval();
  // A translation strains nothing, to the last bit: see translation.hpp.
  k.middleCols<3>(6) = -k.leftCols<3>();
  k.middleRows<3>(6) = -k.topRows<3>();
  return k;
}

BeamMatrix beam_geometric_stiffness(const SlenderMember& member, const std::array<SectionForces, 2>& ends) {
  if (varies(*member.section) || is_eccentric(*member.section))
    throw Error("unsupported",
                "the stiffness that stresses add is known of beams with a constant section alone whose centre of "
                "torsion is the centroid");
  return in_global_axes(beam_geometric_stiffness(*member.section, member.length, ends), member.axes);
}

}  // namespace comma::solver
