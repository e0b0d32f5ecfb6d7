#include "commands/fields/field_reading.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>

#include "commands/fields/field_types.hpp"
#include "solver/fields/points/extrapolation.hpp"

namespace comma::commands {

using interpreter::DiagnosticError;
using interpreter::Keywords;

std::vector<FieldSource> field_sources(const Keywords& keywords, ValuesAPoint wanted) {
  if (keywords.has("CHAM_GD")) {
    const auto& handle = keywords.concept_of("CHAM_GD");
    const FieldConcept& data = number_field(handle, keywords, "CHAM_GD");
    return {{data.field, *data.mesh, data.model.get(), {{"CHAM_GD", handle->name}}}};
  }
  const auto& handle = keywords.concept_of("RESULTAT");
  const auto& data = interpreter::data_of<ResultConcept>(handle, "RESULTAT");
  const solver::Result& result = data.result;
  std::vector<FieldSource> sources;
  const bool by_name = keywords.given("NOM_VARI");
  for (const solver::ResultStep* step : steps_with_field(keywords, result)) {
    const solver::Field& held = wanted == ValuesAPoint::any
                                    ? layered_field_of(keywords, *step, keywords.text("NOM_CHAM"))
                                    : field_of(keywords, *step);
    auto made = by_name ? std::make_shared<const solver::Field>(
                              by_variable_names(keywords, held, data.problem_of(*step).behaviours.get()))
                        : nullptr;
    sources.push_back({made ? *made : held,
                       result.mesh(),
                       result.model.get(),
                       {{"RESU", handle->name},
                        {"NOM_CHAM", keywords.text("NOM_CHAM")},
                        {"NUME_ORDRE", static_cast<std::int64_t>(step->order)},
                        {"INST", step->instant}},
                       made});
  }
  return sources;
}

solver::NodalField at_nodes(const Keywords& keywords, const FieldSource& source, const std::vector<int>* cells) {
  if (const auto* nodal = std::get_if<solver::NodalField>(&source.field)) return *nodal;
  const auto& element = std::get<solver::ElementField>(source.field);
  if (element.support == solver::Support::element_node) {
    if (cells != nullptr) return solver::nodal_means(source.mesh, element, std::span<const int>(*cells));
    return solver::nodal_means(source.mesh, element);
  }
  const char* keyword = keywords.has("CHAM_GD") ? "CHAM_GD" : "NOM_CHAM";
  throw DiagnosticError("unsupported",
                        fmt::format("{}: the field has its values {}, and values at nodes are needed", keyword,
                                    describe(place_of(source.field))),
                        keywords.span_of(keyword),
                        "give a field at nodes (..._NOEU, DEPL, FORC_NODA ...) or at the nodes of cells (..._ELNO)");
}

std::string table_node(const solver::Mesh& mesh, int node) {
  return mesh.node_names.empty() ? std::to_string(node + 1) : mesh.node_name(node);
}

std::string table_cell(const solver::Mesh& mesh, int cell) {
  return mesh.cell_names.empty() ? std::to_string(cell + 1) : mesh.cell_name(cell);
}

std::vector<int> chosen_components(const Keywords& keywords, const std::vector<std::string>& components) {
  std::vector<int> chosen;
  for (const char* keyword : {"NOM_CMP", "NOM_VARI"}) {
    for (const std::string& name : keywords.texts(keyword))
      chosen.push_back(component_of(keywords, components, name, keyword));
  }
  if (!chosen.empty()) return chosen;
  chosen.resize(components.size());
  std::iota(chosen.begin(), chosen.end(), 0);
  return chosen;
}

namespace {

bool is_variable(const std::string& name) {
  return name.size() > 1 && name[0] == 'V' &&
         std::ranges::all_of(name.substr(1), [](char c) { return c >= '0' && c <= '9'; });
}

}  // namespace

bool is_out_of_plane(const std::string& name) {
  constexpr std::array motions = {"DZ", "DRX", "DRY", "DRZ"};
  return std::ranges::count(motions, name) != 0 ||
         (name.size() == 4 && (name.starts_with("SI") || name.starts_with("EP")) &&
          (name.ends_with("XZ") || name.ends_with("YZ")));
}

std::vector<std::string> known_components(const Keywords& keywords, const std::vector<std::string>& components,
                                          interpreter::Diagnostics& diagnostics) {
  const bool of_variables = std::ranges::all_of(components, is_variable);
  std::vector<std::string> known, missing;
  for (const std::string& name : keywords.texts("NOM_CMP"))
    (std::ranges::count(components, name) != 0 ? known : missing).push_back(name);
  for (const std::string& name : missing)
    if (known.empty() || !(of_variables ? is_variable(name) : is_out_of_plane(name)))
      component_of(keywords, components, name);
  if (!missing.empty())
    diagnostics.alarm(
        "unknown-component",
        fmt::format("no {} there has {}: left out", of_variables ? "law" : "element", fmt::join(missing, ", ")),
        keywords.span_of("NOM_CMP"), fmt::format("the field has {}", fmt::join(components, ", ")));
  return known;
}

}  // namespace comma::commands
