#include "commands/printed_part.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "commands/analysis/result_reading.hpp"
#include "commands/analysis/same_mesh.hpp"
#include "commands/fields/field_types.hpp"
#include "commands/selection.hpp"
#include "interpreter/diagnostic.hpp"
#include "solver/fields/data/field_parts.hpp"
#include "solver/fields/data/field_rows.hpp"
#include "solver/mesh/conversion.hpp"

namespace comma::commands {

namespace {

using interpreter::DiagnosticError;

// Only the components of NOM_CMP that the field has; false if it has none of them.
bool choose_components(const Keywords& print, solver::Field& field) {
  if (!print.given("NOM_CMP")) return true;
  const auto& known = solver::components_of(field);
  std::vector<int> chosen;
  for (const std::string& name : print.texts("NOM_CMP")) {
    const auto found = std::ranges::find(known, name);
    if (found != known.end()) chosen.push_back(static_cast<int>(found - known.begin()));
  }
  if (!chosen.empty()) field = solver::with_components(field, chosen);
  return !chosen.empty();
}

// The values of cells at other nodes than these become absent.
void keep_nodes_of_cells(solver::ElementField& field, const solver::Mesh& mesh, const std::vector<int>& nodes) {
  const std::size_t width = field.components.size();
  std::vector<bool> is_kept(static_cast<std::size_t>(mesh.node_count()), false);
  for (const int node : nodes) is_kept[static_cast<std::size_t>(node)] = true;
  for (int cell = 0; cell < mesh.cell_count(); ++cell) {
    for (int point = 0; point < field.points(cell); ++point) {
      if (is_kept[static_cast<std::size_t>(mesh.cell(cell)[static_cast<std::size_t>(point)])]) continue;
      std::fill_n(field.values.begin() +
                      static_cast<std::ptrdiff_t>(static_cast<std::size_t>(field.starts[cell] + point) * width),
                  width, solver::absent);
    }
  }
}

// Nodes choose values of cells at their nodes alone, in text.
bool is_out_of_reach(const Keywords& print, bool med, const solver::Field& field) {
  const auto* element = std::get_if<solver::ElementField>(&field);
  return element != nullptr && names_a_place(print, node_places) &&
         (med || element->support != solver::Support::element_node);
}

void choose_places(const Keywords& print, const solver::Mesh& mesh, bool med, solver::Field& field) {
  if (auto* nodal = std::get_if<solver::NodalField>(&field)) {
    if (names_a_place(print)) *nodal = solver::on_nodes(*nodal, selected_nodes(print, mesh));
    return;
  }
  auto& element = std::get<solver::ElementField>(field);
  if (names_a_place(print, cell_places)) element = solver::on_cells(element, selected_cells(print, mesh, cell_places));
  if (!names_a_place(print, node_places)) return;
  if (is_out_of_reach(print, med, field)) {
    throw DiagnosticError("unsupported", "IMPR_RESU: nodes choose nothing of a field on cells", print.span,
                          "name cells by GROUP_MA");
  }
  keep_nodes_of_cells(element, mesh, selected_nodes(print, mesh, node_places));
}

bool is_chosen(const Keywords& print, const std::string& field) {
  if (print.given("TOUT_CHAM") && print.text("TOUT_CHAM") == "NON") return false;
  if (!print.given("NOM_CHAM")) return true;
  const auto names = print.texts("NOM_CHAM");
  return std::ranges::find(names, field) != names.end();
}

// On the cells with one value a point, with the components that some of these have; nothing where there are none.
std::optional<solver::Field> beside_layers(const solver::ElementField& field) {
  std::vector<int> cells, present;
  for (int cell = 0; cell + 1 < static_cast<int>(field.starts.size()); ++cell)
    if (field.values_a_point(cell) == 1) cells.push_back(cell);
  const solver::ElementField rest = solver::on_cells(field, cells);
  const std::size_t width = rest.components.size();
  for (std::size_t c = 0; c < width; ++c)
    for (std::size_t i = c; i < rest.values.size(); i += width)
      if (!std::isnan(rest.values[i])) {
        present.push_back(static_cast<int>(c));
        break;
      }
  if (present.empty()) return std::nullopt;
  return solver::with_components(rest, present);
}

// Of the fields that have several values a point, in the thickness of plates, what other cells have.
void leave_out_layers(solver::ResultStep& step) {
  for (auto item = step.fields.begin(); item != step.fields.end();) {
    const auto* field = is_layered(item->second) ? &std::get<solver::ElementField>(item->second) : nullptr;
    const std::optional<solver::Field> rest = field != nullptr ? beside_layers(*field) : std::nullopt;
    if (rest) item->second = *rest;
    item = field != nullptr && !rest ? step.fields.erase(item) : std::next(item);
  }
}

solver::Result chosen_steps(const Keywords& print, const solver::Result& result) {
  solver::Result part;
  part.model = result.model;
  part.bare_mesh = result.bare_mesh;
  for (const solver::ResultStep* step : selected_steps(print, result)) {
    solver::ResultStep& copy = part.steps.emplace_back(*step);
    std::erase_if(copy.fields, [&](const auto& item) { return !is_chosen(print, item.first); });
    leave_out_layers(copy);
  }
  return part;
}

solver::Result result_of_field(const Keywords& print) {
  const FieldConcept& data = number_field(print.concept_of("CHAM_GD"), print, "CHAM_GD");
  solver::Result result;
  result.model = data.model;
  result.bare_mesh = data.mesh;
  result.steps.emplace_back().fields.emplace("", data.field);
  return result;
}

}  // namespace

// What the keywords name and nothing that is to be written has.
void warn_of_missing_names(const Keywords& print, interpreter::Diagnostics& diagnostics) {
  if (!print.has("RESULTAT") && !print.has("CHAM_GD")) return;
  const bool whole_result = print.has("RESULTAT");
  const auto& source = print.concept_of(whole_result ? "RESULTAT" : "CHAM_GD");
  std::set<std::string> fields, components;
  const auto add = [&](const std::string& name, const solver::Field& field) {
    fields.insert(name);
    const auto& own = solver::components_of(field);
    components.insert(own.begin(), own.end());
  };
  if (!whole_result) {
    add("", number_field(source, print, "CHAM_GD").field);
  } else {
    for (const solver::ResultStep* step :
         selected_steps(print, interpreter::data_of<ResultConcept>(source, "RESULTAT").result))
      for (const auto& [name, field] : step->fields)
        if (is_chosen(print, name)) add(name, field);
  }
  const auto missing = [&](const char* keyword, const std::set<std::string>& known) {
    std::vector<std::string> names;
    if (print.given(keyword))
      for (const std::string& name : print.texts(keyword))
        if (!known.contains(name)) names.push_back(name);
    return names;
  };
  if (const auto names = missing("NOM_CHAM", fields); whole_result && !names.empty())
    diagnostics.alarm(
        "unknown-field",
        fmt::format("IMPR_RESU: {} holds no {} in these steps: left out", source->name, fmt::join(names, ", ")),
        print.span_of("NOM_CHAM"), "CALC_CHAMP computes fields");
  if (const auto names = missing("NOM_CMP", components); !fields.empty() && !names.empty())
    diagnostics.alarm("unknown-component",
                      fmt::format("IMPR_RESU: no field that is written has {}: left out", fmt::join(names, ", ")),
                      print.span_of("NOM_CMP"), fmt::format("there is {}", fmt::join(components, ", ")));
}

void warn_of_layers(const Keywords& print, interpreter::Diagnostics& diagnostics) {
  if (!print.has("RESULTAT")) return;
  const auto& source = print.concept_of("RESULTAT");
  std::set<std::string> layered;
  for (const solver::ResultStep* step :
       selected_steps(print, interpreter::data_of<ResultConcept>(source, "RESULTAT").result))
    for (const auto& [name, field] : step->fields)
      if (is_chosen(print, name) && is_layered(field)) layered.insert(name);
  if (layered.empty()) return;
  diagnostics.alarm("field-left-out",
                    fmt::format("IMPR_RESU: fields with several values a point, in the thickness of plates, are not "
                                "written there: {} of {} left out",
                                fmt::join(layered, ", "), source->name),
                    print.span, "POST_CHAMP with EXTR_COQUE takes one of them");
}

// Of a result whose fields are not named those are written that nodes choose something of.
void warn_of_fields_out_of_reach(const Keywords& print, bool med, interpreter::Diagnostics& diagnostics) {
  if (!print.has("RESULTAT") || print.given("NOM_CHAM")) return;
  const auto& source = print.concept_of("RESULTAT");
  std::set<std::string> names;
  for (const solver::ResultStep* step :
       selected_steps(print, interpreter::data_of<ResultConcept>(source, "RESULTAT").result))
    for (const auto& [name, field] : step->fields)
      if (is_chosen(print, name) && is_out_of_reach(print, med, field)) names.insert(name);
  if (names.empty()) return;
  diagnostics.alarm("field-left-out",
                    fmt::format("IMPR_RESU: nodes choose nothing of {}, on cells: left out of {}",
                                fmt::join(names, ", "), source->name),
                    print.span, "name the fields that are meant by NOM_CHAM, or cells by GROUP_MA");
}

PrintedPart part_of(const Keywords& print, bool med) {
  if (!print.has("RESULTAT") && !print.has("CHAM_GD")) {
    const auto& handle = print.concept_of("MAILLAGE");
    return {interpreter::data_of<MeshConcept>(handle, "MAILLAGE").mesh, handle->name, {}, true};
  }
  const bool whole_result = print.has("RESULTAT");
  const auto& handle = print.concept_of(whole_result ? "RESULTAT" : "CHAM_GD");
  PrintedPart part{nullptr, handle->name,
                   whole_result ? chosen_steps(print, interpreter::data_of<ResultConcept>(handle, "RESULTAT").result)
                                : result_of_field(print)};
  part.shared_mesh = part.result.model ? part.result.model->mesh : part.result.bare_mesh;
  const solver::Mesh& mesh = part.mesh();
  if (print.has("MAILLAGE"))
    require_mesh(print, "MAILLAGE",
                 interpreter::data_of<MeshConcept>(print.concept_of("MAILLAGE"), "MAILLAGE").mesh.get(), mesh);
  for (solver::ResultStep& step : part.result.steps) {
    for (auto item = step.fields.begin(); item != step.fields.end();) {
      const bool is_asked_for = print.given("NOM_CHAM") || !whole_result || !is_out_of_reach(print, med, item->second);
      const bool kept = is_asked_for && choose_components(print, item->second);
      if (kept) choose_places(print, mesh, med, item->second);
      item = kept ? std::next(item) : step.fields.erase(item);
    }
  }
  return part;
}

}  // namespace comma::commands
