#include "commands/analysis/path_reading.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "commands/bounds.hpp"
#include "commands/selection.hpp"
#include "interpreter/diagnostic.hpp"

namespace comma::commands {

using interpreter::Call;
using interpreter::DiagnosticError;
using interpreter::Keywords;

namespace {

solver::PathMeasure measure_of(const std::string& word) {
  if (word == "LONG_ARC") return solver::PathMeasure::arc_length;
  if (word == "DEFORMATION") return solver::PathMeasure::strain;
  return word == "PRED_ELAS" ? solver::PathMeasure::elastic_prediction : solver::PathMeasure::displacement;
}

solver::PathChoice choice_of(const std::string& word) {
  if (word == "ANGL_INCR_DEPL") return solver::PathChoice::smallest_angle;
  if (word == "MIXTE") return solver::PathChoice::clear_residual;
  return word == "NORM_INCR_DEPL" ? solver::PathChoice::smallest_increment : solver::PathChoice::smallest_residual;
}

void take_bounds(const Keywords& keywords, solver::PathControl& control) {
  require_order(keywords, "ETA_PILO_MIN", "ETA_PILO_MAX");
  require_order(keywords, "ETA_PILO_R_MIN", "ETA_PILO_R_MAX");
  if (keywords.given("ETA_PILO_MIN")) control.least = keywords.real("ETA_PILO_MIN");
  if (keywords.given("ETA_PILO_MAX")) control.most = keywords.real("ETA_PILO_MAX");
  if (keywords.given("ETA_PILO_R_MIN")) control.least_sought = keywords.real("ETA_PILO_R_MIN");
  if (keywords.given("ETA_PILO_R_MAX")) control.most_sought = keywords.real("ETA_PILO_R_MAX");
  control.stops_at_bound = keywords.text("PROJ_BORNES") == "OUI";
  control.grows = keywords.text("EVOL_PARA") == "CROISSANT";
  control.falls = keywords.text("EVOL_PARA") == "DECROISSANT";
}

void take_displacements(const Keywords& keywords, const solver::Mesh& mesh, solver::PathControl& control) {
  if (!keywords.given("NOM_CMP"))
    throw DiagnosticError("missing-keyword",
                          "PILOTAGE: TYPE='" + keywords.text("TYPE") + "' controls components of displacement",
                          keywords.span, "give NOM_CMP");
  for (const std::string& name : keywords.texts("NOM_CMP")) {
    const auto component = solver::component_named(name);
    if (!component)
      throw DiagnosticError("unknown-component", "PILOTAGE: " + name + " is no displacement or rotation",
                            keywords.span_of("NOM_CMP"), "name DX, DY, DZ, DRX, DRY or DRZ");
    control.components.push_back(*component);
  }
  control.nodes = selected_nodes(keywords, mesh, {"", "GROUP_NO", "NOEUD", "", ""});
  if (control.measure == solver::PathMeasure::arc_length) return;
  if (control.nodes.size() == 1 && control.components.size() == 1) return;
  throw DiagnosticError("wrong-count", "PILOTAGE: TYPE='DDL_IMPO' controls one component at one node",
                        keywords.span_of(control.nodes.size() == 1 ? "NOM_CMP" : "GROUP_NO"),
                        "name one of each, or control several by TYPE='LONG_ARC'");
}

// Displacements are controlled at nodes, strains on cells.
void check_places(const Keywords& keywords, bool on_cells) {
  const std::vector<const char*> others =
      on_cells ? std::vector<const char*>{"GROUP_NO", "NOEUD"} : std::vector<const char*>{"GROUP_MA"};
  for (const char* keyword : others) {
    if (!keywords.given(keyword)) continue;
    throw DiagnosticError(
        "excluded-keyword",
        fmt::format("PILOTAGE: TYPE='{}' is measured {}", keywords.text("TYPE"), on_cells ? "on cells" : "at nodes"),
        keywords.span_of(keyword), on_cells ? "name cells by GROUP_MA" : "name nodes by GROUP_NO or NOEUD");
  }
}

}  // namespace

solver::PathControl path_control(const Call& call, const solver::Mesh& mesh) {
  const Keywords& keywords = call.factor("PILOTAGE");
  if (call.has("CONTACT"))
    throw DiagnosticError("unsupported", "comma does not support PILOTAGE beside CONTACT", keywords.span,
                          "leave out one of the two");
  solver::PathControl control;
  control.measure = measure_of(keywords.text("TYPE"));
  control.choice = choice_of(keywords.text("SELECTION"));
  control.scale = keywords.real("COEF_MULT");
  if (control.scale == 0.0)
    throw DiagnosticError("out-of-bounds", "PILOTAGE: COEF_MULT divides the length of the step",
                          keywords.span_of("COEF_MULT"), "give a value that is not 0");
  take_bounds(keywords, control);
  const bool on_cells =
      control.measure == solver::PathMeasure::elastic_prediction || control.measure == solver::PathMeasure::strain;
  check_places(keywords, on_cells);
  if (on_cells)
    control.cells = selected_cells(keywords, mesh, {"", "", "", "GROUP_MA", ""});
  else
    take_displacements(keywords, mesh, control);
  return control;
}

void settle_driven_loads(ResultConcept& result) {
  std::vector<std::pair<double, double>> intensities;  // instant, intensity
  for (const solver::ResultStep& step : result.result.steps)
    if (const auto known = step.parameters.find("ETA_PILOTAGE"); known != step.parameters.end())
      intensities.emplace_back(step.instant, known->second);
  const auto intensity = [intensities](double time) {
    const auto next = std::ranges::lower_bound(intensities, time, {}, &std::pair<double, double>::first);
    if (next == intensities.begin() || intensities.empty())
      return intensities.empty() ? 0.0 : intensities.front().second;
    if (next == intensities.end()) return intensities.back().second;
    const auto before = next - 1;
    const double share = (time - before->first) / (next->first - before->first);
    return before->second + share * (next->second - before->second);
  };
  for (solver::AppliedLoad& load : result.problem.driven) {
    load.multiplier = [intensity, own = load.multiplier](double time) {
      return intensity(time) * (own ? own(time) : 1.0);
    };
    result.problem.loads.push_back(std::move(load));
  }
  result.problem.driven.clear();
}

}  // namespace comma::commands
