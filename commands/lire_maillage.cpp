#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <optional>

#include "commands/commands.hpp"
#include "interpreter/diagnostic.hpp"
#include "solver/error.hpp"
#include "solver/io/aster_mesh_file.hpp"
#include "solver/io/gibi_mesh_file.hpp"
#include "solver/io/gmsh_mesh_file.hpp"
#include "solver/io/ideas_mesh_file.hpp"
#include "solver/io/med_file.hpp"
#include "solver/mesh/repeated_cells.hpp"

namespace comma::commands {

namespace {

// How the files of a format are called where no .export names them.
const std::map<std::string, std::vector<std::string>, std::less<>>& extensions() {
  static const std::map<std::string, std::vector<std::string>, std::less<>> table = {{"MED", {"mmed", "med"}},
                                                                                     {"ASTER", {"mail", "aster"}},
                                                                                     {"GMSH", {"msh"}},
                                                                                     {"GIBI", {"mgib"}},
                                                                                     {"IDEAS", {"unv", "msup"}}};
  return table;
}

// Where names are wanted the file's own are likely to be meant.
solver::Mesh read_names_aside(const Call& call, const std::string& path, Context& context) {
  std::optional<solver::MisleadingName> misleading;
  solver::Mesh mesh = solver::read_aster_mesh(path, &misleading);
  if (!misleading) return mesh;
  context.diagnostics.alarm("other-names",
                            fmt::format("LIRE_MAILLAGE: nodes and cells are numbered in the order of the file and keep "
                                        "no names: what the file calls {} is {} from here on",
                                        misleading->in_file, misleading->afterwards),
                            call.span, "name nodes and cells by groups");
  return mesh;
}

// Which text format a file begins as; none for another one.
std::string text_format_of(const std::string& path) {
  static constexpr std::pair<const char*, const char*> marks[] = {{"COOR_2D", "ASTER"},
                                                                  {"COOR_3D", "ASTER"},
                                                                  {"$MeshFormat", "GMSH"},
                                                                  {"$NOD", "GMSH"},
                                                                  {"ENREGISTREMENT DE TYPE", "GIBI"},
                                                                  {"    -1\n", "IDEAS"}};
  std::ifstream file(path, std::ios::binary);
  std::string beginning(4096, '\0');
  file.read(beginning.data(), static_cast<std::streamsize>(beginning.size()));
  const auto found =
      std::ranges::find_if(marks, [&](const auto& mark) { return beginning.find(mark.first) != std::string::npos; });
  return found == std::end(marks) ? "" : found->second;
}

// A file that is there, but is called as those of another format are; where one of its own is there, something else is
// missing.
[[noreturn]] void tell_missing(const interpreter::DiagnosticError& missing, const Call& call, Context& context) {
  if (context.files.candidate(extensions().at(call.text("FORMAT")))) throw missing;
  for (const auto& [format, names] : extensions()) {
    const auto path = context.files.candidate(names);
    if (path)
      throw interpreter::DiagnosticError("missing-file", missing.what(), call.span,
                                         fmt::format("FORMAT='{}' would read {}", format, path->filename().string()));
  }
  throw missing;
}

std::string input_path(const Call& call, Context& context) {
  try {
    return context.files.input(static_cast<int>(call.integer("UNITE")), extensions().at(call.text("FORMAT"))).string();
  } catch (const interpreter::DiagnosticError& missing) {
    tell_missing(missing, call, context);
  }
}

solver::Mesh read(const Call& call, Context& context) {
  const std::string& format = call.text("FORMAT");
  const std::string path = input_path(call, context);
  context.console.progress("  reads " + path);
  if (format == "ASTER") return read_names_aside(call, path, context);
  if (format == "GMSH") return solver::read_gmsh_mesh(path);
  if (format == "IDEAS") return solver::read_ideas_mesh(path);
  if (format == "GIBI") return solver::read_gibi_mesh(path);
  try {
    return solver::read_med_mesh(path, call.has("NOM_MED") ? call.text("NOM_MED") : "");
  } catch (const solver::Error& error) {
    const std::string likely = text_format_of(path);
    if (likely.empty()) throw;
    throw interpreter::DiagnosticError(error.code(), std::string("LIRE_MAILLAGE: ") + error.what(),
                                       call.span_of("FORMAT"), fmt::format("it looks like FORMAT='{}'", likely));
  }
}

void warn_of_double_cells(const Call& call, const solver::Mesh& mesh, Context& context) {
  const std::vector<solver::RepeatedCell> doubles = solver::repeated_cells(mesh);
  if (doubles.empty()) return;
  const auto [first, again] = doubles.front();
  const std::string others =
      doubles.size() > 1 ? fmt::format(", the first of {} cells that repeat others", doubles.size()) : "";
  context.diagnostics.alarm(
      "double-cells",
      fmt::format("LIRE_MAILLAGE: {} {} has the nodes of {}{}: where both are in a model or under a load, both count",
                  solver::name_of(mesh.cell_types[again]), mesh.cell_name(again), mesh.cell_name(first), others),
      call.span, "leave doubles out of the mesh file; VERI_MAIL=_F(VERIF='NON') where they are meant");
}

// A quadrangle with two corners at one node is a triangle, and a segment nothing.
void warn_of_collapsed_cells(const Call& call, const solver::Mesh& mesh, Context& context) {
  const std::vector<int> collapsed = solver::collapsed_cells(mesh);
  if (collapsed.empty()) return;
  const std::string others = collapsed.size() > 1 ? fmt::format(", the first of {} such cells", collapsed.size()) : "";
  context.diagnostics.alarm(
      "collapsed-cells",
      fmt::format("LIRE_MAILLAGE: {} {} has a node more than once{}: its element is a collapsed one",
                  solver::name_of(mesh.cell_types[collapsed.front()]), mesh.cell_name(collapsed.front()), others),
      call.span, "look for a misprint among its nodes; VERI_MAIL=_F(VERIF='NON') where it is meant");
}

void verify(const Call& call, const solver::Mesh& mesh, Context& context) {
  if (call.factors("VERI_MAIL").front().text("VERIF") != "OUI") return;
  warn_of_double_cells(call, mesh, context);
  warn_of_collapsed_cells(call, mesh, context);
}

}  // namespace

Product lire_maillage(const Call& call, Context& context) {
  auto product = std::make_shared<MeshConcept>();
  product->mesh = std::make_shared<solver::Mesh>(read(call, context));
  const solver::Mesh& mesh = *product->mesh;
  verify(call, mesh, context);
  context.console.detail("  " + std::to_string(mesh.node_count()) + " nodes, " + std::to_string(mesh.cell_count()) +
                         " cells, " + std::to_string(mesh.cell_groups.size()) + " cell groups, " +
                         std::to_string(mesh.node_groups.size()) + " node groups");
  return product;
}

}  // namespace comma::commands
