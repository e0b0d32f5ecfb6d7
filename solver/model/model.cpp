#include "solver/model/model.hpp"

#include <algorithm>
#include <initializer_list>

namespace comma::solver {

namespace {

constexpr ComponentMask plane_translations = mask_of(Component::dx) | mask_of(Component::dy);
constexpr ComponentMask space_translations = plane_translations | mask_of(Component::dz);
constexpr ComponentMask space_rotations = mask_of(Component::drx) | mask_of(Component::dry) | mask_of(Component::drz);

ComponentMask components_of_formulation(Formulation formulation) {
  switch (formulation) {
    case Formulation::none:
      return 0;
    case Formulation::plane_strain:
    case Formulation::plane_strain_reduced:
    case Formulation::plane_stress:
    case Formulation::plane_stress_reduced:
    case Formulation::axisymmetric:
    case Formulation::axisymmetric_reduced:
    case Formulation::plane_strain_pressure:
    case Formulation::axisymmetric_pressure:
    case Formulation::plane_strain_swelling:
    case Formulation::axisymmetric_swelling:
    case Formulation::bar_2d:
    case Formulation::spring_2d:
      return plane_translations;
    case Formulation::spring_rotation_2d:
      return plane_translations | mask_of(Component::drz);
    case Formulation::solid:
    case Formulation::solid_reduced:
    case Formulation::solid_pressure:
    case Formulation::solid_swelling:
    case Formulation::bar:
    case Formulation::spring_3d:
      return space_translations;
    case Formulation::euler_beam:
    case Formulation::timoshenko_beam:
    case Formulation::spring_rotation_3d:
    case Formulation::thin_plate:
    case Formulation::shear_plate:
      return space_translations | space_rotations;
  }
  return 0;
}

/// Of a body, as Code_Aster 17.3 has them.
bool has_body(Formulation formulation, CellType type) {
  const auto is_among = [&](std::initializer_list<CellType> types) {
    return std::ranges::find(types, type) != types.end();
  };
  using enum CellType;
  switch (formulation) {
    case Formulation::solid_reduced:
      return is_among({hexa8, hexa20, tetra10});
    case Formulation::plane_strain_reduced:
    case Formulation::plane_stress_reduced:
      return is_among({quad4, quad8});
    case Formulation::axisymmetric_reduced:
      return type == quad8;
    case Formulation::solid_pressure:
      return is_among({tetra4, tetra10, penta15, hexa20});
    case Formulation::plane_strain_pressure:
    case Formulation::axisymmetric_pressure:
      return is_among({tria3, tria6, quad8});
    case Formulation::solid_swelling:
      return is_among({tetra10, penta15, hexa20});
    case Formulation::plane_strain_swelling:
    case Formulation::axisymmetric_swelling:
      return is_among({tria6, quad8});
    default:
      return true;
  }
}

}  // namespace

bool is_discrete(Formulation formulation) {
  return formulation == Formulation::spring_2d || formulation == Formulation::spring_rotation_2d ||
         formulation == Formulation::spring_3d || formulation == Formulation::spring_rotation_3d;
}

int continuum_dimension(Formulation formulation) {
  switch (formulation) {
    case Formulation::solid:
    case Formulation::solid_reduced:
    case Formulation::solid_pressure:
    case Formulation::solid_swelling:
      return 3;
    case Formulation::plane_strain:
    case Formulation::plane_strain_reduced:
    case Formulation::plane_stress:
    case Formulation::plane_stress_reduced:
    case Formulation::axisymmetric:
    case Formulation::axisymmetric_reduced:
    case Formulation::plane_strain_pressure:
    case Formulation::axisymmetric_pressure:
    case Formulation::plane_strain_swelling:
    case Formulation::axisymmetric_swelling:
      return 2;
    default:
      return 0;
  }
}

bool has_element(Formulation formulation, CellType type) {
  const int continuum = continuum_dimension(formulation);
  if (continuum > 0 && dimension(type) == continuum) return has_body(formulation, type);
  if (continuum > 0) return dimension(type) > 0 && dimension(type) < continuum;
  if (is_plate(formulation)) return type == CellType::tria3 || type == CellType::quad4 || type == CellType::seg2;
  if (is_discrete(formulation)) return type == CellType::poi1 || type == CellType::seg2;
  return formulation != Formulation::none && type == CellType::seg2;
}

bool is_axisymmetric(Formulation formulation) {
  return formulation == Formulation::axisymmetric || formulation == Formulation::axisymmetric_reduced ||
         formulation == Formulation::axisymmetric_pressure || formulation == Formulation::axisymmetric_swelling;
}

int mixed_field_count(Formulation formulation) {
  switch (formulation) {
    case Formulation::solid_pressure:
    case Formulation::plane_strain_pressure:
    case Formulation::axisymmetric_pressure:
      return 1;
    case Formulation::solid_swelling:
    case Formulation::plane_strain_swelling:
    case Formulation::axisymmetric_swelling:
      return 2;
    default:
      return 0;
  }
}

bool is_plate(Formulation formulation) {
  return formulation == Formulation::thin_plate || formulation == Formulation::shear_plate;
}

bool is_bar(Formulation formulation) { return formulation == Formulation::bar || formulation == Formulation::bar_2d; }

bool is_beam(Formulation formulation) {
  return formulation == Formulation::euler_beam || formulation == Formulation::timoshenko_beam;
}

bool is_plane_stress(Formulation formulation) {
  return formulation == Formulation::plane_stress || formulation == Formulation::plane_stress_reduced;
}

bool is_reduced(Formulation formulation) {
  return formulation == Formulation::solid_reduced || formulation == Formulation::plane_strain_reduced ||
         formulation == Formulation::plane_stress_reduced || formulation == Formulation::axisymmetric_reduced;
}

bool is_stabilised(Formulation formulation, CellType type) {
  return formulation == Formulation::solid_reduced && type == CellType::hexa8;
}

bool Model::is_skin(int cell) const {
  const int type_dimension = dimension(mesh->cell_types[cell]);
  const int body = is_plate(formulations[cell]) ? 2 : continuum_dimension(formulations[cell]);
  return type_dimension > 0 && type_dimension < body;
}

ComponentMask Model::components_of(int cell) const {
  const Formulation formulation = formulations[cell];
  return has_element(formulation, mesh->cell_types[cell]) ? components_of_formulation(formulation) : ComponentMask{0};
}

ComponentMask Model::corner_components_of(int cell) const {
  const int fields = components_of(cell) == 0 || is_skin(cell) ? 0 : mixed_field_count(formulations[cell]);
  ComponentMask mask = 0;
  if (fields > 0) mask |= mask_of(Component::pressure);
  if (fields > 1) mask |= mask_of(Component::swelling);
  return mask;
}

bool Model::is_mixed() const {
  return std::ranges::any_of(formulations, [](Formulation formulation) { return mixed_field_count(formulation) > 0; });
}

}  // namespace comma::solver
