#include "solver/elements/cell_material.hpp"

#include <fmt/format.h>

#include "solver/error.hpp"

namespace comma::solver {
namespace {

AcrossPlane across_plane(Formulation formulation) {
  if (is_plane_stress(formulation)) return AcrossPlane::free;
  return continuum_dimension(formulation) == 2 ? AcrossPlane::held : AcrossPlane::solid;
}

}  // namespace

CellMaterial cell_material(const Model& model, const MaterialField& materials, const ElementProperties& properties,
                           int cell) {
  const Material* material =
      materials.by_cell.empty() ? nullptr : materials.by_cell[static_cast<std::size_t>(cell)].get();
  if (material == nullptr || !material->elasticity)
    throw Error("missing-material",
                fmt::format("cell {} carries an element but has no elastic material", model.mesh->cell_name(cell)));
  const auto axes = properties.material_axes.find(cell);
  return {&*material->elasticity, axes == properties.material_axes.end() ? nullptr : &axes->second,
          across_plane(model.formulations[static_cast<std::size_t>(cell)])};
}

}  // namespace comma::solver
