#include "commands/fields/field_distribution.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "commands/analysis/result_reading.hpp"
#include "commands/analysis/same_mesh.hpp"
#include "commands/model/parts_of_model.hpp"
#include "interpreter/diagnostic.hpp"
#include "solver/fields/data/row_functions.hpp"
#include "solver/fields/integrals/energies.hpp"
#include "solver/fields/integrals/volume_distribution.hpp"
#include "solver/fields/points/discretisation.hpp"

namespace comma::commands {

using interpreter::Call;
using interpreter::DiagnosticError;
using interpreter::Keywords;

namespace {

solver::ElementField at_gauss_points(const FieldSource& source, const solver::Model& model) {
  const auto* field = std::get_if<solver::ElementField>(&source.field);
  if (field != nullptr && field->support != solver::Support::element_node) return *field;
  return solver::brought_to(model, source.field, solver::Support::gauss_point, false);
}

Row row_of(const FieldSource& source) {
  Row row = source.columns;
  if (row.front().first == "RESU") row.front().first = "RESULTAT";
  return row;
}

// What a column that does not apply shows.
constexpr const char* nothing = "-";

Cell group_of(const Part& part) { return part.kind == "TOUT" ? nothing : part.name; }

Cell dimension_of(const Keywords& occurrence) {
  return occurrence.has("TYPE_MAILLE") ? occurrence.text("TYPE_MAILLE") : nothing;
}

// Several groups count together, under the name of the first.
std::vector<Part> joined_parts(const Call& call, const Keywords& occurrence, const solver::Mesh& mesh) {
  std::vector<Part> parts = parts_and_union(call, occurrence, mesh);
  if (parts.back().name != "UNION_GROUP_MA") return parts;
  return {{parts.front().name, "GROUP_MA", std::move(parts.back().cells)}};
}

[[noreturn]] void carries_nothing(const Keywords& occurrence, const Part& part) {
  throw DiagnosticError(
      "no-element",
      fmt::format("POST_ELEM: no solid, plane or axisymmetric element in {} carries the field", part.name),
      occurrence.span);
}

// --- norms

// The weights of the squares: those of the norm, times COEF_MULT; without a coefficient a component does not count. In
// Code_Aster it is L2 that counts xy, xz and yz twice here, and FROBENIUS that counts them once.
std::vector<double> weights_of(const Keywords& occurrence, const std::vector<std::string>& components) {
  auto weights = occurrence.text("TYPE_NORM") == "L2" ? solver::frobenius_weights(components)
                                                      : std::vector<double>(components.size(), 1.0);
  if (!occurrence.has("COEF_MULT")) return weights;
  const Keywords& factors = occurrence.factor("COEF_MULT");
  const auto names = factors.texts("NOM_CMP");
  const auto values = factors.reals("COEF");
  if (names.size() != values.size()) {
    throw DiagnosticError(
        "wrong-count",
        fmt::format("POST_ELEM: {} components stand against {} coefficients", names.size(), values.size()),
        factors.span_of("COEF"));
  }
  std::vector<double> chosen(components.size(), 0.0);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto component = static_cast<std::size_t>(component_of(factors, components, names[i]));
    chosen[component] = values[i] * weights[component];
  }
  return chosen;
}

void add_norms(Table& table, const Call& call, const Keywords& occurrence, const FieldSource& source,
               const solver::Model& model, interpreter::Diagnostics& diagnostics) {
  const solver::ElementField field = at_gauss_points(source, model);
  const auto squares = std::get<solver::ElementField>(
      solver::made_of_rows(field, std::array{solver::sum_of_squares(weights_of(occurrence, field.components))}));
  const solver::ElementField integrals = solver::integrate_cells(model, squares);
  for (Part& part : joined_parts(call, occurrence, source.mesh)) {
    if (occurrence.has("TYPE_MAILLE")) keep_dimension(part, source.mesh, occurrence.text("TYPE_MAILLE"));
    if (std::ranges::none_of(part.cells, [&](int cell) { return integrals.points(cell) > 0; }))
      carries_nothing(occurrence, part);
    warn_of_cells_left_out("NORME", occurrence, part, model, diagnostics);
    Row row = row_of(source);
    // Names of norms have eight characters.
    row.insert(row.end(), {{"GROUP_MA", group_of(part)},
                           {"TYPE_MAIL", dimension_of(occurrence)},
                           {"TYPE_NORM", occurrence.text("TYPE_NORM").substr(0, 8)}});
    row.emplace_back("VALE_NORM", std::sqrt(solver::sum_over_cells(integrals, 0, std::span<const int>(part.cells))));
    table.add_row(row);
  }
}

// --- distributions

// The ends of the intervals: as many alike as NB_INTERV between BORNES (the extremes without it), or below and above
// SEUIL.
std::vector<double> bounds_of(const Keywords& occurrence, std::pair<double, double> extremes) {
  if (occurrence.has("SEUIL"))
    return {std::min(extremes.first, occurrence.real("SEUIL")), occurrence.real("SEUIL"),
            std::max(extremes.second, occurrence.real("SEUIL"))};
  if (occurrence.has("BORNES")) extremes = {occurrence.reals("BORNES").front(), occurrence.reals("BORNES").back()};
  const auto count = occurrence.integer("NB_INTERV");
  std::vector<double> bounds;
  for (int i = 0; i <= count; ++i)
    bounds.push_back(extremes.first +
                     (extremes.second - extremes.first) * static_cast<double>(i) / static_cast<double>(count));
  bounds.back() = extremes.second;  // to all digits, so that the largest value lies within
  return bounds;
}

void add_distribution(Table& table, const Call& call, const Keywords& occurrence, const FieldSource& source,
                      const solver::Model& model, interpreter::Diagnostics& diagnostics) {
  const auto* on_cells = std::get_if<solver::ElementField>(&source.field);
  const solver::ElementField field = on_cells != nullptr ? *on_cells : at_gauss_points(source, model);
  const std::string& name = occurrence.text("NOM_CMP");
  const int component = component_of(occurrence, field.components, name);
  for (Part& part : parts_of(call, occurrence, source.mesh)) {
    if (occurrence.has("TYPE_MAILLE")) keep_dimension(part, source.mesh, occurrence.text("TYPE_MAILLE"));
    const auto pieces = solver::value_volumes(model, field, component, part.cells);
    if (pieces.empty()) carries_nothing(occurrence, part);
    warn_of_cells_left_out("VOLUMOGRAMME", occurrence, part, model, diagnostics);
    const auto bounds = bounds_of(occurrence, solver::value_range(pieces));
    const auto volumes = solver::volumes_between(pieces, bounds);
    const bool is_share = occurrence.text("NORME") == "RELATIF";
    const double whole = std::accumulate(volumes.begin(), volumes.end(), 0.0);
    for (std::size_t i = 0; i < volumes.size(); ++i) {
      Row row = row_of(source);
      row.insert(row.end(), {{"NOM_CMP", name},
                             {"GROUP_MA", group_of(part)},
                             {"RESTRICTION", dimension_of(occurrence)},
                             {"INTERVALLE", static_cast<std::int64_t>(i + 1)},
                             {"BORNE_INF", bounds[i]},
                             {"BORNE_SUP", bounds[i + 1]},
                             {"DISTRIBUTION", is_share ? 100.0 * volumes[i] / whole : volumes[i]}});
      table.add_row(row);
    }
  }
}

}  // namespace

void list_norms(Table& table, const Call& call, interpreter::Diagnostics& diagnostics) {
  for (const Keywords& occurrence : call.factors("NORME")) {
    warn_of_missing_instants("POST_ELEM", occurrence, diagnostics);
    for (const FieldSource& source : field_sources(occurrence)) {
      if (source.model == nullptr && !call.has("MODELE"))
        throw DiagnosticError("missing-keyword", "POST_ELEM: the field lies on no model", call.span, "give MODELE");
      if (call.has("MODELE"))
        require_mesh(call, "MODELE", call.data<ModelConcept>("MODELE").model->mesh.get(), source.mesh);
      add_norms(table, call, occurrence, source,
                call.has("MODELE") ? *call.data<ModelConcept>("MODELE").model : *source.model, diagnostics);
    }
  }
}

void list_distributions(Table& table, const Call& call, interpreter::Diagnostics& diagnostics) {
  const auto model = model_behind(call);
  for (const Keywords& occurrence : call.factors("VOLUMOGRAMME")) {
    warn_of_missing_instants("POST_ELEM", occurrence, diagnostics);
    for (const FieldSource& source : field_sources(with_field(call, occurrence)))
      add_distribution(table, call, occurrence, source, *model, diagnostics);
  }
}

}  // namespace comma::commands
