#include <algorithm>
#include <map>

#include <fmt/format.h>
#include <Eigen/Dense>

#include "commands/commands.hpp"
#include "commands/selection.hpp"
#include "solver/elements/plates/plate_axes.hpp"

namespace comma::commands {

namespace {

using solver::Formulation;

// MODELISATION (U4.41.01) in the solver's words.
const std::map<std::string, Formulation, std::less<>>& formulations() {
  static const std::map<std::string, Formulation, std::less<>> table = {
      {"3D", Formulation::solid},
      {"3D_SI", Formulation::solid_reduced},
      {"D_PLAN", Formulation::plane_strain},
      {"D_PLAN_SI", Formulation::plane_strain_reduced},
      {"C_PLAN", Formulation::plane_stress},
      {"C_PLAN_SI", Formulation::plane_stress_reduced},
      {"AXIS", Formulation::axisymmetric},
      {"AXIS_SI", Formulation::axisymmetric_reduced},
      {"3D_INCO_UP", Formulation::solid_pressure},
      {"D_PLAN_INCO_UP", Formulation::plane_strain_pressure},
      {"AXIS_INCO_UP", Formulation::axisymmetric_pressure},
      {"3D_INCO_UPG", Formulation::solid_swelling},
      {"D_PLAN_INCO_UPG", Formulation::plane_strain_swelling},
      {"AXIS_INCO_UPG", Formulation::axisymmetric_swelling},
      {"BARRE", Formulation::bar},
      {"2D_BARRE", Formulation::bar_2d},
      {"POU_D_E", Formulation::euler_beam},
      {"POU_D_T", Formulation::timoshenko_beam},
      {"DIS_T", Formulation::spring_3d},
      {"DIS_TR", Formulation::spring_rotation_3d},
      {"2D_DIS_T", Formulation::spring_2d},
      {"2D_DIS_TR", Formulation::spring_rotation_2d},
      {"DKT", Formulation::thin_plate},
      {"DST", Formulation::shear_plate},
  };
  return table;
}

// Of continua and plates; 0: of other elements.
int body_dimension(Formulation formulation) {
  return solver::is_plate(formulation) ? 2 : solver::continuum_dimension(formulation);
}

int cell_dimension(const solver::Mesh& mesh, int cell) {
  return solver::dimension(mesh.cell_types[static_cast<std::size_t>(cell)]);
}

int highest_dimension(const Keywords& assignment, const solver::Mesh& mesh) {
  int highest = 0;
  for (const int cell : selected_cells(assignment, mesh)) highest = std::max(highest, cell_dimension(mesh, cell));
  return highest;
}

std::string fitting_modelisations(const Keywords& assignment, const solver::Mesh& mesh) {
  switch (highest_dimension(assignment, mesh)) {
    case 3:
      return "volumes are bodies with 3D";
    case 2:
      return "surfaces are bodies with D_PLAN, C_PLAN or AXIS, TRIA3 and QUAD4 plates with DKT or DST";
    default:
      return "segments are bars and beams (BARRE, POU_D_T), points and segments springs (DIS_T, 2D_DIS_T)";
  }
}

// Plane elements, bars too, see X and Y alone, and loads on their edges the length in space.
void require_flat_cell(const solver::Mesh& mesh, int cell, const Keywords& assignment) {
  constexpr double largest_slope = 1e-3;  // the error in lengths is half of its square
  Eigen::AlignedBox3d box;
  for (const int node : mesh.cell(cell))
    box.extend(Eigen::Vector3d(Eigen::Map<const Eigen::Vector3d>(mesh.nodes[static_cast<std::size_t>(node)].data())));
  const Eigen::Vector3d size = box.sizes();
  if (!(size[2] > largest_slope * size.head<2>().norm())) return;
  throw interpreter::DiagnosticError(
      "out-of-plane",
      fmt::format(
          "AFFE_MODELE: cell {} of a plane model does not lie in a plane Z = constant: Z varies by {:.3g} over it",
          mesh.cell_name(cell), size[2]),
      assignment.span,
      highest_dimension(assignment, mesh) == 3
          ? "the mesh has volumes, which are bodies with 3D"
          : "turn the mesh into the plane of X and Y (MODI_MAILLAGE), or take plates or a solid");
}

// A plate is the projection of its cell: rigid rotations of a warped one are not quite free of strain.
void warn_of_warped_plates(const Call& call, const solver::Model& model, Context& context) {
  int count = 0, worst = -1;
  double largest = 0.0;
  for (int cell = 0; cell < model.mesh->cell_count(); ++cell) {
    const Formulation formulation = model.formulations[static_cast<std::size_t>(cell)];
    if (!solver::is_plate(formulation) ||
        model.mesh->cell_types[static_cast<std::size_t>(cell)] != solver::CellType::quad4)
      continue;
    const double warp = solver::warp_of_plate(*model.mesh, cell);
    if (warp <= solver::little_warp) continue;
    ++count;
    if (warp <= largest) continue;
    largest = warp;
    worst = cell;
  }
  if (worst < 0) return;
  context.diagnostics.alarm(
      "warped-plates",
      fmt::format("AFFE_MODELE: {} plate{} not flat, {} by the most: a corner lies off the plane of the others by "
                  "{:.2g} of the cell's size. Each is taken for its projection on its mean plane, and its membrane "
                  "resists bending: where a shell is thin it may be several times too stiff",
                  count, count == 1 ? " is" : "s are", model.mesh->cell_name(worst), largest),
      call.span, "take triangles, or smaller cells; VERI_PLAN='NON' says that they are meant so");
}

// Faces with 3D are the skin of solids, also where there are none.
void warn_of_skin_alone(const Keywords& assignment, const solver::Model& model, Context& context) {
  const int dimension = body_dimension(formulations().at(assignment.texts("MODELISATION").front()));
  if (dimension == 0) return;
  const auto is_body = [&](std::size_t cell) {
    return body_dimension(model.formulations[cell]) == dimension && !model.is_skin(static_cast<int>(cell));
  };
  for (std::size_t cell = 0; cell < model.formulations.size(); ++cell)
    if (is_body(cell)) return;
  std::vector<int> skin = selected_cells(assignment, *model.mesh);
  std::erase_if(skin, [&](int cell) { return !model.is_skin(cell); });
  if (skin.empty()) return;
  const int example = *std::ranges::max_element(skin, {}, [&](int cell) { return cell_dimension(*model.mesh, cell); });
  context.diagnostics.alarm(
      "skin-alone",
      fmt::format(
          "AFFE_MODELE: with {}, cells such as {} ({}) are the skin of bodies that the model does not have: they "
          "bring no stiffness",
          assignment.texts("MODELISATION").front(), model.mesh->cell_name(example),
          solver::name_of(model.mesh->cell_types[static_cast<std::size_t>(example)])),
      assignment.span_of("MODELISATION"), fitting_modelisations(assignment, *model.mesh));
}

// Cells that no AFFE has an element for stay out of the model.
void warn_of_cells_without_element(const Keywords& assignment, const solver::Model& model, Context& context) {
  const std::string modelisation = assignment.texts("MODELISATION").front();
  const int dimension = body_dimension(formulations().at(modelisation));
  std::vector<int> left = selected_cells(assignment, *model.mesh);
  std::erase_if(left, [&](int cell) {
    return cell_dimension(*model.mesh, cell) != dimension ||
           model.formulations[static_cast<std::size_t>(cell)] != Formulation::none;
  });
  if (left.empty()) return;
  context.diagnostics.alarm(
      "cells-without-element",
      fmt::format(
          "AFFE_MODELE: {} has no element on {} of these cells, such as {} ({}): they are not part of the model",
          modelisation, left.size(), model.mesh->cell_name(left.front()),
          solver::name_of(model.mesh->cell_types[static_cast<std::size_t>(left.front())])),
      assignment.span_of("MODELISATION"),
      "give all cells another modelisation in an occurrence of AFFE before this one, such as D_PLAN beside D_PLAN_SI");
}

}  // namespace

Product affe_modele(const Call& call, Context& context) {
  auto model = std::make_shared<solver::Model>();
  model->mesh = call.data<MeshConcept>("MAILLAGE").mesh;
  const solver::Mesh& mesh = *model->mesh;
  model->formulations.assign(static_cast<std::size_t>(mesh.cell_count()), Formulation::none);
  for (const Keywords& assignment : call.factors("AFFE")) {
    const Formulation formulation = formulations().at(assignment.texts("MODELISATION").front());
    int assigned = 0;
    for (const int cell : selected_cells(assignment, mesh)) {
      // A later AFFE wins; TOUT and groups alike reach cells that a formulation has no element for, which then stay as
      // they are.
      if (!solver::has_element(formulation, mesh.cell_types[cell])) continue;
      if (solver::continuum_dimension(formulation) == 2 || formulation == Formulation::bar_2d)
        require_flat_cell(mesh, cell, assignment);
      model->formulations[cell] = formulation;
      ++assigned;
    }
    if (assigned == 0) {
      throw interpreter::DiagnosticError(
          "no-element", "AFFE_MODELE: none of these cells can carry " + assignment.texts("MODELISATION").front(),
          assignment.span, fitting_modelisations(assignment, mesh));
    }
  }
  for (const Keywords& assignment : call.factors("AFFE")) {
    warn_of_skin_alone(assignment, *model, context);
    warn_of_cells_without_element(assignment, *model, context);
  }
  if (call.text("VERI_PLAN") == "OUI") warn_of_warped_plates(call, *model, context);
  auto product = std::make_shared<ModelConcept>();
  product->model = std::move(model);
  return product;
}

}  // namespace comma::commands
