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
#include "commands/printed_part.hpp"
#include "commands/selection.hpp"
#include "commands/text_listing.hpp"
#include "interpreter/diagnostic.hpp"
#include "solver/fields/data/field_parts.hpp"
#include "solver/fields/data/field_rows.hpp"
#include "solver/io/aster_mesh_file.hpp"
#include "solver/io/gmsh_writer.hpp"
#include "solver/io/med_file.hpp"
#include "solver/mesh/conversion.hpp"

namespace comma::commands {

namespace {

using interpreter::DiagnosticError;

constexpr int med_unit = 80;
constexpr int mesh_unit = 30;

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

// TOUT_PARA, NOM_PARA: a line of the parameters of a step.
std::string parameters_of(const Keywords& print, const PrintedPart& part, const solver::ResultStep& step) {
  const bool all = print.has("TOUT_PARA") && print.text("TOUT_PARA") == "OUI";
  if (!all && !print.given("NOM_PARA")) return {};
  const auto names = print.texts("NOM_PARA");
  std::string text = fmt::format("\n {}, NUME_ORDRE={}", part.name, step.order);
  const auto add = [&](const std::string& name, double value) {
    if (all || std::ranges::find(names, name) != names.end()) text += fmt::format(", {}={:.10g}", name, value);
  };
  add("INST", step.instant);
  for (const auto& [name, value] : step.parameters) add(name, value);
  return text + "\n";
}

std::string text_of(const Keywords& print) {
  const PrintedPart part = part_of(print, false);
  const ListingStyle style = style_of(print);
  if (part.mesh_alone) return listing(part.mesh(), style);
  const auto extremes = wanted_extremes(print);
  std::string text;
  for (const std::string& line : print.texts("SOUS_TITRE")) text += "\n " + line + "\n";
  for (const solver::ResultStep& step : part.result.steps) {
    text += parameters_of(print, part, step);
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
  context.begin_anew_if_renewed(unit, path);
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
