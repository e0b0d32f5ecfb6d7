#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>
#include <span>

#include "commands/analysis/result_reading.hpp"
#include "commands/analysis/same_mesh.hpp"
#include "commands/commands.hpp"
#include "commands/fields/field_types.hpp"
#include "commands/selection.hpp"
#include "commands/text_listing.hpp"
#include "interpreter/diagnostic.hpp"
#include "solver/fields/field_algebra.hpp"
#include "solver/io/aster_mesh_file.hpp"
#include "solver/io/gmsh_writer.hpp"
#include "solver/io/med_file.hpp"
#include "solver/mesh/conversion.hpp"

namespace comma::commands {

namespace {

using interpreter::DiagnosticError;

constexpr int med_unit = 80;
constexpr int mesh_unit = 30;

// What one occurrence of RESU writes: the chosen part of a result, or of a field as a result of one step whose field
// has no name of its own. Without a result, the mesh alone.
struct PrintedPart {
  std::shared_ptr<const solver::Mesh> shared_mesh;
  std::string name;
  solver::Result result;
  bool mesh_alone = false;

  const solver::Mesh& mesh() const { return *shared_mesh; }
};

// --- the part that the keywords choose

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

void check_same_mesh(const std::vector<PrintedPart>& parts, std::size_t i, const Call& call) {
  if (parts[i].shared_mesh == parts.front().shared_mesh) return;
  throw DiagnosticError("unsupported",
                        "IMPR_RESU: these results lie on several meshes, and comma writes one into a file",
                        call.factors("RESU")[i].span, "write them by several IMPR_RESU, each to a UNITE of its own");
}

// --- MED

// The names that the file gives to the fields: those of NOM_CHAM_MED, or the one of the result with that of the field.
void add_med_results(const Keywords& print, PrintedPart& part, std::vector<solver::NamedResult>& results) {
  if (!print.given("NOM_CHAM_MED")) {
    results.push_back({std::move(part.result), print.given("NOM_RESU_MED") ? print.text("NOM_RESU_MED") : part.name});
    return;
  }
  if (print.has("RESULTAT") && !print.given("NOM_CHAM"))
    throw DiagnosticError("missing-keyword", "IMPR_RESU: NOM_CHAM_MED names the fields of NOM_CHAM, and there are none",
                          print.at("NOM_CHAM_MED").name_span,
                          "give NOM_CHAM, or NOM_RESU_MED for a beginning of all names");
  const auto names = print.texts("NOM_CHAM_MED");
  const auto fields = print.given("NOM_CHAM") ? print.texts("NOM_CHAM") : std::vector<std::string>{""};
  if (names.size() != fields.size()) {
    throw DiagnosticError("wrong-count",
                          fmt::format("IMPR_RESU: {} names stand against {} fields", names.size(), fields.size()),
                          print.span_of("NOM_CHAM_MED"), "give one name a field of NOM_CHAM");
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    solver::NamedResult& named =
        results.emplace_back(solver::NamedResult{{part.result.model, {}, part.result.bare_mesh}, names[i]});
    for (const solver::ResultStep& step : part.result.steps) {
      const auto field = step.fields.find(fields[i]);
      if (field == step.fields.end()) continue;
      solver::ResultStep& copy = named.result.steps.emplace_back();
      copy.order = step.order;
      copy.instant = step.instant;
      copy.fields.emplace("", field->second);
    }
  }
}

// A name for a mesh that stands among others.
std::string free_name(const std::vector<WrittenMesh>& others, const std::string& name) {
  const auto taken = [&](const std::string& word) {
    return std::ranges::any_of(others, [&](const WrittenMesh& other) { return other.name == word; });
  };
  std::string free = name;
  for (int number = 2; taken(free); ++number) free = fmt::format("{}_{}", name, number);
  return free;
}

// A loop that writes its results by one name writes over those before.
void note_steps(const Keywords& print, std::span<const solver::NamedResult> results, WrittenMedFile& file,
                interpreter::Diagnostics& diagnostics) {
  const int source = print.concept_of(print.has("RESULTAT") ? "RESULTAT" : "CHAM_GD")->id;
  std::set<std::string> replaced;
  for (const solver::NamedResult& each : results)
    for (const solver::ResultStep& step : each.result.steps)
      for (const auto& [field, values] : step.fields) {
        const std::string name = field.empty() ? each.name : field + " of " + each.name;
        const auto [known, is_new] = file.steps[name].try_emplace(step.order, source);
        if (!is_new && std::exchange(known->second, source) != source) replaced.insert(name);
      }
  if (replaced.empty()) return;
  diagnostics.alarm("replaced-step",
                    fmt::format("IMPR_RESU: the file holds steps of {} from an earlier result, which these replace",
                                fmt::join(replaced, ", ")),
                    print.span, "give each result a name there (NOM_RESU_MED, NOM_CHAM_MED), or a UNITE of its own");
}

// The first time in a run the file is made anew, as those of text are.
void write_med(const Call& call, const std::string& path, WrittenMedFile& file, interpreter::Diagnostics& diagnostics) {
  std::vector<PrintedPart> parts;
  for (const Keywords& print : call.factors("RESU")) parts.push_back(part_of(print, true));
  std::vector<solver::NamedResult> results;
  std::string mesh_name = "MAIL";
  for (std::size_t i = 0; i < parts.size(); ++i) {
    check_same_mesh(parts, i, call);
    if (parts[i].mesh_alone) {
      mesh_name = parts[i].name;
    } else {
      const std::size_t first = results.size();
      add_med_results(call.factors("RESU")[i], parts[i], results);
      note_steps(call.factors("RESU")[i], std::span(results).subspan(first), file, diagnostics);
    }
  }
  std::vector<WrittenMesh>& known = file.meshes;
  const auto& mesh = parts.front().shared_mesh;
  const auto found = std::ranges::find(known, mesh, &WrittenMesh::mesh);
  mesh_name = found == known.end() ? free_name(known, mesh_name) : found->name;
  if (known.empty())
    solver::write_med_results(path, *mesh, mesh_name, results);
  else
    solver::add_med_results(path, *mesh, mesh_name, found != known.end(), results);
  if (found == known.end()) known.push_back({mesh, mesh_name});
}

// --- text

ListingStyle style_of(const Keywords& print) {
  ListingStyle style{RealFormat(print.text("FORMAT_R"))};
  style.coordinates = print.text("IMPR_COOR") == "OUI";
  if (print.given("BORNE_INF")) style.least = print.real("BORNE_INF");
  if (print.given("BORNE_SUP")) style.greatest = print.real("BORNE_SUP");
  return style;
}

std::vector<Extremum> wanted_extremes(const Keywords& print) {
  std::vector<Extremum> wanted;
  if (print.has("VALE_MAX")) wanted.push_back(Extremum::greatest);
  if (print.has("VALE_MIN")) wanted.push_back(Extremum::least);
  return wanted;
}

std::string text_of(const Keywords& print) {
  const PrintedPart part = part_of(print, false);
  const ListingStyle style = style_of(print);
  if (part.mesh_alone) return listing(part.mesh(), style);
  const auto extremes = wanted_extremes(print);
  std::string text;
  for (const std::string& line : print.texts("SOUS_TITRE")) text += "\n " + line + "\n";
  for (const solver::ResultStep& step : part.result.steps) {
    for (const auto& [name, field] : step.fields) {
      text += name.empty()
                  ? fmt::format("\n {}\n", part.name)
                  : fmt::format("\n {} {}, NUME_ORDRE={}, INST={:.10g}\n", part.name, name, step.order, step.instant);
      text +=
          extremes.empty() ? listing(field, part.mesh(), style) : extreme_listing(field, part.mesh(), style, extremes);
    }
  }
  return text;
}

// The cells that MODELE gives an element, all without it.
std::vector<int> written_cells(const Call& call, const solver::Mesh& mesh) {
  std::vector<int> cells;
  const solver::Model* model = call.has("MODELE") ? call.data<ModelConcept>("MODELE").model.get() : nullptr;
  if (model != nullptr && model->mesh.get() != &mesh) {
    throw DiagnosticError("different-mesh", "IMPR_RESU: MODELE lies on another mesh than what is written",
                          call.span_of("MODELE"));
  }
  for (int cell = 0; cell < mesh.cell_count(); ++cell) {
    if (model == nullptr || model->components_of(cell) != 0) cells.push_back(cell);
  }
  return cells;
}

// FORMAT="ASTER" holds meshes, no fields: of a result, its mesh.
std::string mesh_text(const Call& call, const Keywords& print) {
  const PrintedPart part = part_of(print, false);
  const auto cells = written_cells(call, part.mesh());
  if (static_cast<int>(cells.size()) == part.mesh().cell_count()) return solver::format_aster_mesh(part.mesh());
  return solver::format_aster_mesh(solver::restricted(part.mesh(), cells));
}

// --- Gmsh

// For each of Gmsh's values, which of the components of NOM_CMP it is; -1: none, it is 0.
std::vector<int> gmsh_layout(const Keywords& print, std::size_t components) {
  static const std::map<std::string, std::vector<int>> layouts = {{"VECT_2D", {0, 1, -1}},
                                                                  {"VECT_3D", {0, 1, 2}},
                                                                  {"TENS_2D", {0, 3, -1, 3, 1, -1, -1, -1, 2}},
                                                                  {"TENS_3D", {0, 3, 4, 3, 1, 5, 4, 5, 2}}};
  const std::vector<int>& layout = layouts.at(print.text("TYPE_CHAM"));
  const auto needed = static_cast<std::size_t>(*std::ranges::max_element(layout)) + 1;
  if (components == needed) return layout;
  throw DiagnosticError(
      "wrong-count",
      fmt::format("IMPR_RESU: TYPE_CHAM=\"{}\" needs {} components, and the field has {} of those of NOM_CMP",
                  print.text("TYPE_CHAM"), needed, components),
      print.span_of("TYPE_CHAM"), "name them in NOM_CMP: X, Y, Z, or XX, YY, ZZ, XY, XZ, YZ");
}

void add_views(const Keywords& print, const PrintedPart& part, std::vector<solver::GmshView>& views) {
  for (const solver::ResultStep& step : part.result.steps) {
    for (const auto& [name, field] : step.fields) {
      const auto& components = solver::components_of(field);
      const std::string label = name.empty() ? part.name : part.name + " " + name;
      if (print.text("TYPE_CHAM") != "SCALAIRE") {
        views.push_back({label, step.instant, step.order, &field, gmsh_layout(print, components.size())});
        continue;
      }
      for (std::size_t c = 0; c < components.size(); ++c)
        views.push_back({label + " " + components[c], step.instant, step.order, &field, {static_cast<int>(c)}});
    }
  }
}

// Of a whole result what the format cannot hold, fields at Gauss points, is left out; one that NOM_CHAM asks for is
// not.
void leave_out_points(const Keywords& print, PrintedPart& part, interpreter::Diagnostics& diagnostics) {
  if (!print.has("RESULTAT") || print.given("NOM_CHAM")) return;
  std::set<std::string> left_out;
  for (solver::ResultStep& step : part.result.steps) {
    std::erase_if(step.fields, [&](const auto& item) {
      const auto* on_cells = std::get_if<solver::ElementField>(&item.second);
      const bool at_points = on_cells != nullptr && on_cells->support == solver::Support::gauss_point;
      if (at_points) left_out.insert(item.first);
      return at_points;
    });
  }
  if (left_out.empty()) return;
  diagnostics.alarm("field-left-out",
                    fmt::format("IMPR_RESU: Gmsh has no place for fields at Gauss points: {} of {} left out",
                                fmt::join(left_out, ", "), part.name),
                    print.span,
                    "CALC_CHAMP brings them to the nodes of cells; NOM_CHAM names those that are to be written");
}

std::string gmsh_text(const Call& call, interpreter::Diagnostics& diagnostics) {
  std::vector<PrintedPart> parts;
  std::vector<solver::GmshView> views;
  for (const Keywords& print : call.factors("RESU")) {
    parts.push_back(part_of(print, false));
    leave_out_points(print, parts.back(), diagnostics);
  }
  for (std::size_t i = 0; i < parts.size(); ++i) {
    check_same_mesh(parts, i, call);
    add_views(call.factors("RESU")[i], parts[i], views);
  }
  const solver::Mesh& mesh = parts.front().mesh();
  return solver::format_gmsh(mesh, written_cells(call, mesh), views);
}

// MED and text hold whole meshes here.
void check_model(const Call& call, const std::string& format) {
  if (!call.has("MODELE") || format == "GMSH" || format == "ASTER") return;
  const solver::Mesh& mesh = *call.data<ModelConcept>("MODELE").model->mesh;
  if (static_cast<int>(written_cells(call, mesh).size()) == mesh.cell_count()) return;
  throw DiagnosticError(
      "unsupported",
      fmt::format("IMPR_RESU: FORMAT=\"{}\" writes all cells of a mesh, and MODELE has not all of them", format),
      call.span_of("MODELE"), "leave out MODELE, or name cells by GROUP_MA");
}

struct Format {
  int unit;
  const char* extension;
};

Format format_named(const std::string& word) {
  if (word == "MED") return {med_unit, "rmed"};
  if (word == "ASTER") return {mesh_unit, "mail"};
  if (word == "GMSH") return {mesh_unit, "msh"};
  return {text_unit, "resu"};
}

}  // namespace

Product impr_resu(const Call& call, Context& context) {
  const std::string& word = call.text("FORMAT");
  const Format format = format_named(word);
  const int unit = call.has("UNITE") ? static_cast<int>(call.integer("UNITE")) : format.unit;
  const bool is_shown = word == "RESULTAT" && context.files.is_terminal(unit);
  const auto path = is_shown ? std::filesystem::path() : context.files.output(unit, format.extension, format.unit);
  context.begin_anew_if_released(unit, path);
  check_model(call, word);
  for (const Keywords& print : call.factors("RESU")) {
    warn_of_missing_instants("IMPR_RESU", print, context.diagnostics);
    warn_of_missing_names(print, context.diagnostics);
    warn_of_layers(print, context.diagnostics);
    warn_of_fields_out_of_reach(print, call.text("FORMAT") == "MED", context.diagnostics);
  }
  if (word == "MED") {
    WrittenMedFile& file = context.med_files[path.string()];
    const bool is_new = file.meshes.empty();
    write_med(call, path.string(), file, context.diagnostics);
    if (is_new) context.console.progress("  writes " + path.string());
    return nullptr;
  }
  if (word == "GMSH") {
    context.write(path, gmsh_text(call, context.diagnostics));
    return nullptr;
  }
  for (const Keywords& print : call.factors("RESU")) {
    if (is_shown)
      context.console.print(text_of(print));
    else
      context.write(path, word == "ASTER" ? mesh_text(call, print) : text_of(print));
  }
  return nullptr;
}

}  // namespace comma::commands
