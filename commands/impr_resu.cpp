#include <fmt/format.h>

#include <cmath>

#include "commands/commands.hpp"
#include "commands/result_reading.hpp"
#include "commands/selection.hpp"
#include "interpreter/diagnostic.hpp"
#include "solver/io/med_file.hpp"

namespace comma::commands {

namespace {

using interpreter::DiagnosticError;

constexpr int med_unit = 80;
constexpr int text_unit = 8;

// The part of a result that NOM_CHAM and the step keywords choose.
solver::Result chosen_part(const Keywords& print, const solver::Result& result) {
  solver::Result part;
  part.model = result.model;
  part.bare_mesh = result.bare_mesh;
  for (const solver::ResultStep* step : selected_steps(print, result)) {
    solver::ResultStep& copy = part.steps.emplace_back(*step);
    if (!print.given("NOM_CHAM")) continue;
    const auto names = print.texts("NOM_CHAM");
    std::erase_if(copy.fields, [&](const auto& item) { return std::find(names.begin(), names.end(), item.first) == names.end(); });
  }
  return part;
}

void write_med(const Keywords& print, const std::string& path) {
  if (print.has("RESULTAT")) {
    const auto& handle = print.concept_of("RESULTAT");
    const auto& data = interpreter::data_of<ResultConcept>(handle, "RESULTAT");
    solver::write_med_result(path, data.result.mesh(), "MAIL", chosen_part(print, data.result), handle->name);
    return;
  }
  const auto& handle = print.concept_of("MAILLAGE");
  solver::write_med_mesh(path, *interpreter::data_of<MeshConcept>(handle, "MAILLAGE").mesh, handle->name);
}

std::string row(const std::string& place, const std::vector<double>& values) {
  std::string text = fmt::format(" {:<10}", place);
  for (const double value : values) text += std::isnan(value) ? fmt::format(" {:>14}", "-") : fmt::format(" {:14.6E}", value);
  return text + "\n";
}

std::string header(const std::string& place, const std::vector<std::string>& components) {
  std::string text = fmt::format(" {:<10}", place);
  for (const std::string& name : components) text += fmt::format(" {:>14}", name);
  return text + "\n";
}

bool all_absent(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double value) { return std::isnan(value); });
}

std::string listing(const solver::NodalField& field, const solver::Mesh& mesh) {
  std::string text = header("NOEUD", field.components);
  const std::size_t width = field.components.size();
  for (int node = 0; node < mesh.node_count(); ++node) {
    const auto begin = field.values.begin() + static_cast<std::ptrdiff_t>(node * width);
    const std::vector<double> values(begin, begin + static_cast<std::ptrdiff_t>(width));
    if (!all_absent(values)) text += row(mesh.node_name(node), values);
  }
  return text;
}

std::string listing(const solver::ElementField& field, const solver::Mesh& mesh) {
  std::string text = header("MAILLE", field.components);
  const std::size_t width = field.components.size();
  for (int cell = 0; cell < mesh.cell_count(); ++cell) {
    for (int point = 0; point < field.points(cell); ++point) {
      const auto begin = field.values.begin() + static_cast<std::ptrdiff_t>((field.starts[cell] + point) * width);
      text += row(fmt::format("{} {}", mesh.cell_name(cell), point + 1), {begin, begin + static_cast<std::ptrdiff_t>(width)});
    }
  }
  return text;
}

std::string listing(const solver::Mesh& mesh) {
  std::string text = fmt::format(" {} nodes, {} cells\n", mesh.node_count(), mesh.cell_count()) + header("NOEUD", {"X", "Y", "Z"});
  for (int node = 0; node < mesh.node_count(); ++node) {
    const solver::Point& at = mesh.nodes[node];
    text += row(mesh.node_name(node), {at[0], at[1], at[2]});
  }
  return text;
}

std::string text_of(const Keywords& print) {
  if (!print.has("RESULTAT")) return listing(*interpreter::data_of<MeshConcept>(print.concept_of("MAILLAGE"), "MAILLAGE").mesh);
  const auto& handle = print.concept_of("RESULTAT");
  const auto& data = interpreter::data_of<ResultConcept>(handle, "RESULTAT");
  const solver::Mesh& mesh = data.result.mesh();
  std::string text;
  for (const solver::ResultStep& step : chosen_part(print, data.result).steps) {
    for (const auto& [name, field] : step.fields) {
      text += fmt::format("\n {} {}, NUME_ORDRE={}, INST={:.10g}\n", handle->name, name, step.order, step.instant);
      text += std::visit([&](const auto& values) { return listing(values, mesh); }, field);
    }
  }
  return text;
}

}  // namespace

Product impr_resu(const Call& call, Context& context) {
  const bool med = call.text("FORMAT") == "MED";
  const int default_unit = med ? med_unit : text_unit;
  const int unit = call.has("UNITE") ? static_cast<int>(call.integer("UNITE")) : default_unit;
  const auto path = context.files.output(unit, med ? "rmed" : "resu", default_unit);
  for (const Keywords& print : call.factors("RESU")) {
    if (!print.has("RESULTAT") && !print.has("MAILLAGE")) {
      throw DiagnosticError("missing-one-of", "IMPR_RESU: RESU names neither a RESULTAT nor a MAILLAGE", print.span);
    }
    if (med) {
      write_med(print, path.string());
      context.console.progress("  writes " + path.string());
    } else {
      context.write(path, text_of(print));
    }
  }
  return nullptr;
}

}  // namespace comma::commands
