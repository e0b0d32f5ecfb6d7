#include "commands/fields/field_integrals.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "commands/analysis/result_reading.hpp"
#include "commands/analysis/same_mesh.hpp"
#include "commands/fields/field_reading.hpp"
#include "commands/model/parts_of_model.hpp"
#include "interpreter/diagnostic.hpp"
#include "solver/fields/data/field_rows.hpp"
#include "solver/fields/data/statistics.hpp"
#include "solver/fields/integrals/energies.hpp"
#include "solver/fields/points/discretisation.hpp"

namespace comma::commands {

using interpreter::Call;
using interpreter::DiagnosticError;
using interpreter::Keywords;

namespace {

/// Of each cell.
struct Integrals {
  solver::ElementField of_field;
  solver::ElementField of_one;
};

bool is_integrated(const Keywords& occurrence) {
  return occurrence.has("DEJA_INTEGRE") && occurrence.text("DEJA_INTEGRE") == "OUI";
}

Integrals integrals_of(const Keywords& occurrence, const FieldSource& source, const solver::Model& model) {
  const solver::ElementField field = on_elements(source, model);
  const bool summed = is_integrated(occurrence);
  const auto* on_cells = std::get_if<solver::ElementField>(&source.field);
  if (summed && (on_cells == nullptr || on_cells->support != solver::Support::cell)) {
    throw DiagnosticError("wrong-type",
                          "POST_ELEM: what is integrated already has one value a cell, and this field has others",
                          occurrence.span_of("DEJA_INTEGRE"), "leave out DEJA_INTEGRE");
  }
  const solver::ElementField volumes = solver::cell_volumes(model);
  // What has its values at the nodes of cells counts there as its mean.
  const bool as_mean = on_cells != nullptr && on_cells->support == solver::Support::element_node;
  if (summed) return {field, volumes};
  return {solver::integrate_cells(
              model, as_mean ? solver::brought_to(model, source.field, solver::Support::cell, false) : field),
          volumes};
}

// What lies at nodes is known on the skin of the model too.
Integrals integrals_over_skin(const FieldSource& source, const solver::Model& model, std::span<const int> cells) {
  solver::NodalField one{"NEUT_R", {"VOL"}, std::vector<double>(source.mesh.nodes.size(), 1.0)};
  return {solver::integrate_skin(model, std::get<solver::NodalField>(source.field), cells),
          solver::integrate_skin(model, one, cells)};
}

constexpr std::array<std::string_view, 6> beam_forces = {"N", "VY", "VZ", "MT", "MFY", "MFZ"};

// The forces in the section, along beams.
Integrals integrals_along_beams(const Keywords& occurrence, const FieldSource& source, const solver::Model& model,
                                std::span<const int> beams) {
  for (const std::string& name : occurrence.texts("NOM_CMP")) {
    if (std::ranges::find(beam_forces, name) != beam_forces.end()) continue;
    throw DiagnosticError(
        "unknown-component",
        fmt::format("POST_ELEM: INTEGRALE along beams is that of forces in the section, not of {}", name),
        occurrence.span_of("NOM_CMP"),
        fmt::format("name {}, of EFGE_ELNO, EFGE_NOEU or SIEF_ELGA", fmt::join(beam_forces, ", ")));
  }
  return {solver::integrate_lines(*model.mesh, on_elements(source, model), beams), solver::line_lengths(*model.mesh)};
}

// Takes out of the part the beams that are integrated along, where lines are asked for.
std::vector<int> take_beams(Part& part, const Keywords& occurrence, const solver::Model& model) {
  if (occurrence.text("TYPE_MAILLE") != "1D") return {};
  const auto first = std::ranges::stable_partition(part.cells, [&](int cell) {
                       return !solver::is_beam(model.formulations[static_cast<std::size_t>(cell)]);
                     }).begin();
  std::vector<int> beams(first, part.cells.end());
  part.cells.erase(first, part.cells.end());
  return beams;
}

// Whether the field has the component at all nodes or points of a cell.
bool carries(const FieldSource& source, int cell, int component) {
  if (const auto* nodal = std::get_if<solver::NodalField>(&source.field))
    return std::ranges::none_of(source.mesh.cell(cell),
                                [&](int node) { return std::isnan(nodal->at(node, component)); });
  const auto& field = std::get<solver::ElementField>(source.field);
  for (int point = 0; point < field.points(cell); ++point)
    if (std::isnan(field.at(cell, point, component))) return false;
  return field.points(cell) > 0;
}

void require_component(const Keywords& occurrence, const FieldSource& source, const Part& part,
                       const std::string& name) {
  const int component = component_of(occurrence, solver::components_of(source.field), name);
  const auto lacks = [&](int cell) { return !carries(source, cell, component); };
  const auto found = std::ranges::find_if(part.cells, lacks);
  if (found == part.cells.end()) return;
  throw DiagnosticError("unknown-component",
                        fmt::format("POST_ELEM: {} of the {} cells of {} that are integrated over lack {}, {} for one",
                                    std::ranges::count_if(part.cells, lacks), part.cells.size(), part.name, name,
                                    source.mesh.cell_name(*found)),
                        occurrence.span_of("NOM_CMP"), "name the cells that have it by GROUP_MA");
}

// Keeps the cells that carry the field.
void keep_carriers(Part& part, const Keywords& occurrence, const solver::ElementField& integrals,
                   const solver::Model& model, interpreter::Diagnostics& diagnostics) {
  const auto lost = std::ranges::count_if(part.cells, [&](int cell) {
    return integrals.points(cell) == 0 && !model.is_skin(cell) && model.components_of(cell) != 0;
  });
  std::erase_if(part.cells, [&](int cell) { return integrals.points(cell) == 0; });
  if (lost > 0 && !part.cells.empty())
    diagnostics.alarm(
        "limited-field",
        fmt::format(
            "POST_ELEM: {} of the cells that are named carry no value of the field, and INTEGRALE leaves them out",
            lost),
        occurrence.span, "compute the field on all of them, or name those that have it by GROUP_MA");
}

// The integrals that count for the part, whose cells become those integrated over: bodies, else skin, else beams.
Integrals take_integrals(Part& part, const Integrals& inside, const Keywords& occurrence, const FieldSource& source,
                         const solver::Model& model, interpreter::Diagnostics& diagnostics) {
  const bool summed = is_integrated(occurrence);
  keep_dimension(part, source.mesh, occurrence.text("TYPE_MAILLE"));
  std::vector<int> skin;
  std::ranges::copy_if(part.cells, std::back_inserter(skin), [&](int cell) { return model.is_skin(cell); });
  const std::vector<int> beams = summed || !skin.empty() ? std::vector<int>() : take_beams(part, occurrence, model);
  if (!summed && part.name != "UNION_GROUP_MA")
    warn_of_cells_left_out("INTEGRALE", occurrence, part, model, diagnostics);
  if (!beams.empty()) {
    Integrals along = integrals_along_beams(occurrence, source, model, beams);
    part.cells = beams;
    keep_carriers(part, occurrence, along.of_field, model, diagnostics);
    return along;
  }
  keep_carriers(part, occurrence, inside.of_field, model, diagnostics);
  if (!part.cells.empty() || skin.empty() || !std::holds_alternative<solver::NodalField>(source.field)) return inside;
  part.cells = skin;
  return integrals_over_skin(source, model, skin);
}

void add_integrals(Table& table, const Call& call, const Keywords& occurrence, const FieldSource& source,
                   const solver::Model& model, interpreter::Diagnostics& diagnostics) {
  const Integrals inside = integrals_of(occurrence, source, model);
  for (Part& part : parts_and_union(call, occurrence, source.mesh)) {
    const Integrals integrals = take_integrals(part, inside, occurrence, source, model, diagnostics);
    if (part.cells.empty()) {
      throw DiagnosticError("no-element",
                            fmt::format("POST_ELEM: no cell of dimension {} in {} carries the field",
                                        occurrence.text("TYPE_MAILLE"), part.name),
                            occurrence.span, "see that TYPE_MAILLE is the dimension of the model's cells");
    }
    Row row = source.columns;
    if (row.front().first == "RESU") row.erase(row.begin());
    const double volume = solver::sum_over_cells(integrals.of_one, 0, std::span<const int>(part.cells));
    row.emplace_back("VOL", volume);
    const Row place = named_place(part);
    row.insert(row.end(), place.begin(), place.end());
    for (const std::string& name : occurrence.texts("NOM_CMP")) {
      require_component(occurrence, source, part, name);
      const double total =
          solver::sum_over_cells(integrals.of_field, component_of(occurrence, integrals.of_field.components, name),
                                 std::span<const int>(part.cells));
      row.emplace_back("INTE_" + name, total);
      row.emplace_back("MOYE_" + name, total / volume);
    }
    table.add_row(row);
  }
}

}  // namespace

void list_integrals(Table& table, const Call& call, interpreter::Diagnostics& diagnostics) {
  const auto model = model_behind(call);
  for (const Keywords& occurrence : call.factors("INTEGRALE")) {
    for (const FieldSource& source : field_sources(with_field(call, occurrence)))
      add_integrals(table, call, occurrence, source, *model, diagnostics);
  }
}

}  // namespace comma::commands
