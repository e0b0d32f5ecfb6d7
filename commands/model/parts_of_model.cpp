#include "commands/model/parts_of_model.hpp"

#include <fmt/format.h>

#include <set>

#include "commands/analysis/same_mesh.hpp"
#include "commands/concepts.hpp"
#include "commands/selection.hpp"
#include "interpreter/diagnostic.hpp"
#include "solver/fields/points/extrapolation.hpp"

namespace comma::commands {

using interpreter::Call;
using interpreter::DiagnosticError;
using interpreter::Keywords;

namespace {

// The whole model goes by the number of its mesh among the concepts, eight hexadecimal digits, as Code_Aster writes it.
std::string name_of_all(const Call& call) {
  std::vector<interpreter::ConceptPtr> open;
  for (const char* keyword : {"MODELE", "RESULTAT"})
    if (call.has(keyword)) open.push_back(call.concept_of(keyword));
  std::set<const interpreter::Concept*> seen;
  while (!open.empty()) {
    const interpreter::ConceptPtr known = open.back();
    open.pop_back();
    if (!seen.insert(known.get()).second) continue;
    if (known->type == "maillage_sdaster") return fmt::format("{:08X}", known->id + 1);
    open.insert(open.end(), known->reads_through.begin(), known->reads_through.end());
  }
  return "TOUT";
}

}  // namespace

std::vector<Part> parts_of(const Call& call, const Keywords& occurrence, const solver::Mesh& mesh) {
  std::vector<Part> parts;
  if (occurrence.has("TOUT")) {
    parts.push_back({name_of_all(call), "TOUT", selected_cells(occurrence, mesh, {"TOUT", "", "", "", ""})});
  }
  selected_cells(occurrence, mesh);  // says which names do not exist
  for (const std::string& name : occurrence.texts("GROUP_MA"))
    parts.push_back({name, "GROUP_MA", mesh.cell_group(name)});
  for (const std::string& name : occurrence.texts("MAILLE")) parts.push_back({name, "MAILLE", {mesh.find_cell(name)}});
  return parts;
}

std::vector<Part> parts_and_union(const Call& call, const Keywords& occurrence, const solver::Mesh& mesh) {
  std::vector<Part> parts = parts_of(call, occurrence, mesh);
  if (occurrence.texts("GROUP_MA").size() < 2) return parts;
  Part all{"UNION_GROUP_MA", "GROUP_MA", {}};
  std::set<int> seen;
  for (const Part& part : parts)
    for (const int cell : part.cells)
      if (part.kind == "GROUP_MA" && seen.insert(cell).second) all.cells.push_back(cell);
  parts.push_back(std::move(all));
  return parts;
}

Row named_place(const Part& part) { return {{part.kind, part.kind == "TOUT" ? "TOUT" : part.name}}; }

Row place_columns(const Part& part) { return {{"LIEU", part.name}, {"ENTITE", part.kind}}; }

void keep_dimension(Part& part, const solver::Mesh& mesh, const std::string& dimension) {
  std::erase_if(part.cells,
                [&](int cell) { return solver::dimension(mesh.cell_types[cell]) != dimension.front() - '0'; });
}

std::shared_ptr<const solver::Model> model_behind(const Call& call) {
  std::shared_ptr<const solver::Model> model;
  const solver::Mesh* own = nullptr;
  if (call.has("RESULTAT")) {
    const solver::Result& result = call.data<ResultConcept>("RESULTAT").result;
    model = result.model;
    own = &result.mesh();
  } else if (call.has("CHAM_GD")) {
    const auto& field = call.data<FieldConcept>("CHAM_GD");
    model = field.model;
    own = field.mesh.get();
  }
  if (call.has("MODELE")) {
    model = call.data<ModelConcept>("MODELE").model;
    if (own) require_mesh(call, "MODELE", model->mesh.get(), *own);
  }
  if (!model)
    throw DiagnosticError("missing-keyword", "POST_ELEM: the field lies on no model", call.span, "give MODELE");
  return model;
}

solver::ElementField on_elements(const FieldSource& source, const solver::Model& model) {
  if (const auto* nodal = std::get_if<solver::NodalField>(&source.field))
    return solver::to_element_nodes(model, *nodal);
  return std::get<solver::ElementField>(source.field);
}

Keywords with_field(const Call& call, const Keywords& occurrence) {
  Keywords merged = call;
  if (occurrence.has("NOM_CHAM")) merged.items.push_back(occurrence.at("NOM_CHAM"));
  return merged;
}

void warn_of_cells_left_out(const char* keyword, const Keywords& occurrence, const Part& part,
                            const solver::Model& model, interpreter::Diagnostics& diagnostics) {
  const auto is_left_out = [&](int cell) {
    return model.components_of(cell) != 0 && !model.is_skin(cell) &&
           solver::continuum_dimension(model.formulations[static_cast<std::size_t>(cell)]) == 0;
  };
  const auto count = std::ranges::count_if(part.cells, is_left_out);
  if (count == 0) return;
  diagnostics.alarm("cells-left-out",
                    fmt::format("POST_ELEM/{}: {} of the cells of {} are beams, plates or discrete elements, {} for "
                                "one, which are not integrated over",
                                keyword, count, part.kind == "TOUT" ? "the model" : part.name,
                                model.mesh->cell_name(*std::ranges::find_if(part.cells, is_left_out))),
                    occurrence.span, "name the other cells by GROUP_MA");
}

}  // namespace comma::commands
