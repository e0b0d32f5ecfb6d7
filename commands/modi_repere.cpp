#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "commands/analysis/result_reading.hpp"
#include "commands/commands.hpp"
#include "commands/fields/field_types.hpp"
#include "commands/model/angles.hpp"
#include "commands/points.hpp"
#include "commands/selection.hpp"
#include "interpreter/diagnostic.hpp"
#include "solver/error.hpp"
#include "solver/fields/data/field_parts.hpp"
#include "solver/fields/data/field_room.hpp"
#include "solver/fields/data/field_rows.hpp"
#include "solver/fields/data/rotation.hpp"
#include "solver/fields/data/turned_field.hpp"
#include "solver/fields/points/discretisation.hpp"
#include "solver/mesh/axes.hpp"
#include "solver/mesh/place.hpp"

namespace comma::commands {

namespace {

using interpreter::DiagnosticError;

// Axes that are the same everywhere. In the plane only the first angle counts.
Eigen::Matrix3d fixed_axes(const Keywords& part, int dimension) {
  if (part.has("ANGL_NAUT")) {
    const Eigen::Vector3d angles = vector_of(part, "ANGL_NAUT") * degree;
    return dimension == 2 ? solver::nautical_axes(angles[0], 0.0, 0.0)
                          : solver::nautical_axes(angles[0], angles[1], angles[2]);
  }
  const Eigen::Vector3d x = solver::unit(vector_of(part, "VECT_X")), y = vector_of(part, "VECT_Y");
  constexpr double square = 1e-6;
  if (std::abs(x.dot(y)) > square * y.norm())
    throw DiagnosticError("wrong-direction", "MODI_REPERE: VECT_X and VECT_Y are not at right angles",
                          part.span_of("VECT_Y"));
  Eigen::Matrix3d axes;
  axes.row(0) = x;
  axes.row(1) = solver::unit(y);
  axes.row(2) = axes.row(0).cross(axes.row(1));
  return axes;
}

// A field, where its rows lie, and which of them a part names.
struct Turning {
  const solver::Mesh& mesh;
  const solver::Model* model;
  const solver::Field& field;
  bool& meets_axis;  // set where a row has no axes of its own
};

// The places of the rows as nodes of a mesh.
solver::Mesh places_of_rows(const Turning& turning) {
  if (std::holds_alternative<solver::NodalField>(turning.field)) return turning.mesh;
  const auto& field = std::get<solver::ElementField>(turning.field);
  solver::Mesh made;
  made.dimension = turning.mesh.dimension;
  if (field.support == solver::Support::element_node) {
    for (int cell = 0; cell < turning.mesh.cell_count(); ++cell)
      for (int point = 0; point < field.points(cell); ++point)
        made.nodes.push_back(turning.mesh.nodes[turning.mesh.cell(cell)[point]]);
    return made;
  }
  if (turning.model == nullptr) return made;
  const auto at = solver::brought_to(*turning.model, solver::node_coordinates(turning.mesh), field.support, true);
  for (int cell = 0; cell < turning.mesh.cell_count(); ++cell)
    for (int point = 0; point < field.points(cell); ++point)
      made.nodes.push_back(point < at.points(cell)
                               ? solver::Point{at.at(cell, point, 0), at.at(cell, point, 1), at.at(cell, point, 2)}
                               : solver::Point{});
  return made;
}

std::vector<int> named_rows(const Keywords& part, const Turning& turning) {
  if (const auto* field = std::get_if<solver::ElementField>(&turning.field)) {
    if (names_a_place(part, node_places))
      throw DiagnosticError("wrong-place", "MODI_REPERE: nodes are named, and the field lies on cells", part.span,
                            "name cells by TOUT, GROUP_MA or MAILLE");
    return solver::rows_of_cells(*field, selected_cells(part, turning.mesh));
  }
  return selected_nodes(part, turning.mesh);
}

template <class AnyField>
solver::Field turned_round_axis(const Keywords& part, const AnyField& field, const Turning& turning,
                                const std::vector<int>& rows) {
  const int dimension = turning.mesh.dimension;
  const solver::Mesh at = places_of_rows(turning);
  if (at.nodes.empty())
    throw DiagnosticError("missing-model", "MODI_REPERE: where the values lie is known with a model alone", part.span);
  if (dimension == 3 && !part.has("AXE_Z"))
    throw DiagnosticError("missing-keyword", "MODI_REPERE: the direction of the axis is missing", part.span,
                          "give AXE_Z");
  const Eigen::Vector3d axis = part.has("AXE_Z") ? vector_of(part, "AXE_Z") : Eigen::Vector3d::UnitZ();
  const solver::NodeAxes own = solver::revolution_axes(at, vector_of(part, "ORIGINE"), axis);
  turning.meets_axis |= std::ranges::any_of(rows, [&](int row) { return !solver::has_axes(own, row); });
  const auto axes = solver::with_axes_of_neighbours(at, rows, own);
  return solver::turned(field, rows, axes,
                        dimension == 2 ? solver::TurnedBody::plane_round_axis : solver::TurnedBody::in_space);
}

solver::Field turned_part(const Keywords& part, bool is_round, const Turning& turning) {
  const std::vector<int> rows = named_rows(part, turning);
  return std::visit(
      [&](const auto& field) -> solver::Field {
        if (is_round) return turned_round_axis(part, field, turning, rows);
        const Eigen::Matrix3d axes = fixed_axes(part, turning.mesh.dimension);
        return solver::turned(
            field, rows, [&](int) { return axes; },
            turning.mesh.dimension == 2 ? solver::TurnedBody::plane : solver::TurnedBody::in_space);
      },
      turning.field);
}

// TYPE_CHAM says of what kind the field is.
void require_kind(const Keywords& named, const solver::Field& field) {
  const auto& names = solver::components_of(field);
  const auto has = [&](const char* name) { return std::ranges::find(names, name) != names.end(); };
  const bool is_vector = named.text("TYPE_CHAM").starts_with("VECT");
  if (is_vector ? has("DX") || has("FX") : has("SIXX") || has("EPXX")) return;
  throw DiagnosticError("incompatible-field",
                        fmt::format("MODI_REPERE: the field has no components of a {}",
                                    is_vector ? "vector (DX or FX)" : "tensor (SIXX or EPXX)"),
                        named.span_of("TYPE_CHAM"));
}

// Parts are turned one after the other, what is named twice twice.
solver::Field turned_field(const Call& call, const Turning& turning) {
  solver::Field field = turning.field;
  const bool is_round = call.text("REPERE") == "CYLINDRIQUE";
  for (const Keywords& part : call.factors("AFFE"))
    field = turned_part(part, is_round, {turning.mesh, turning.model, field, turning.meets_axis});
  return field;
}

std::shared_ptr<FieldConcept> field_in_axes(const Call& call, bool& meets_axis) {
  const FieldConcept& data = number_field(call.concept_of("CHAM_GD"), call, "CHAM_GD");
  auto product = std::make_shared<FieldConcept>(data);
  product->multipliers = nullptr;
  product->field = turned_field(call, {*data.mesh, data.model.get(), data.field, meets_axis});
  return product;
}

void turn_step(const Call& call, const solver::Result& result, const solver::ResultStep& step,
               solver::ResultStep& target, bool& meets_axis) {
  for (const Keywords& named : call.factors("MODI_CHAM")) {
    const solver::Field& field = layered_field_of(named, step, named.text("NOM_CHAM"));
    require_one_value_a_point(named.text("NOM_CHAM"), field, named.span_of("NOM_CHAM"));
    require_kind(named, field);
    target.fields.insert_or_assign(named.text("NOM_CHAM"),
                                   turned_field(call, {result.mesh(), result.model.get(), field, meets_axis}));
  }
}

// A new result has the turned fields alone.
std::shared_ptr<ResultConcept> result_in_axes(const Call& call, bool& meets_axis) {
  const auto& source = call.data<ResultConcept>("RESULTAT");
  auto product = std::make_shared<ResultConcept>(source);
  product->result.steps.clear();
  for (const solver::ResultStep* step : selected_steps(call, source.result)) {
    solver::ResultStep target = solver::without_fields(*step);
    turn_step(call, source.result, *step, target, meets_axis);
    product->result.steps.push_back(std::move(target));
  }
  return product;
}

void turn_in_place(const Call& call, bool& meets_axis) {
  auto& source = call.data<ResultConcept>("RESULTAT");
  for (const solver::ResultStep* step : selected_steps(call, source.result)) {
    const auto own = std::ranges::find(source.result.steps, step->order, &solver::ResultStep::order);
    turn_step(call, source.result, *step, *own, meets_axis);
  }
}

}  // namespace

Product modi_repere(const Call& call, Context& context) {
  warn_of_missing_instants("MODI_REPERE", call, context.diagnostics);
  bool meets_axis = false;
  Product product;
  if (call.has("CHAM_GD"))
    product = field_in_axes(call, meets_axis);
  else if (call.reuse)
    turn_in_place(call, meets_axis);
  else
    product = result_in_axes(call, meets_axis);
  if (meets_axis)
    context.diagnostics.alarm("node-on-axis",
                              "MODI_REPERE: some values lie on the axis, where there is no radial direction: they take "
                              "the axes of the nearest ones off it",
                              call.span, "leave them out of AFFE");
  return product;
}

}  // namespace comma::commands
