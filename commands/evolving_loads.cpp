// AFFE_CHAR_MECA/EVOL_CHAR: pressures and forces that a result holds in time.
#include <fmt/format.h>

#include <algorithm>

#include "commands/concepts.hpp"
#include "commands/load_building.hpp"
#include "interpreter/diagnostic.hpp"
#include "solver/loads/load_history.hpp"

namespace comma::commands {

using interpreter::DiagnosticError;
using interpreter::Keywords;

namespace {

using History = std::shared_ptr<const solver::LoadHistory>;

// Forces per area or volume, by what they act on: cells of a body of this dimension, or of its boundary.
struct ForceField {
  const char* name;
  int body;
  bool inside;
};
constexpr ForceField force_fields[] = {{"FSUR_2D", 2, false}, {"FSUR_3D", 3, false}, {"FVOL_2D", 2, true}, {"FVOL_3D", 3, true}};
constexpr const char* pressure_field = "PRES";
constexpr const char* nodal_field = "FORC_NODA";
constexpr std::array<const char*, 3> force_names = {"FX", "FY", "FZ"};

bool is_known(const std::string& name) {
  return name == pressure_field || name == nodal_field || std::ranges::any_of(force_fields, [&](const ForceField& each) { return name == each.name; });
}

bool fits(const solver::Field& field) {
  const auto* on_cells = std::get_if<solver::ElementField>(&field);
  return on_cells == nullptr || on_cells->support != solver::Support::gauss_point;
}

void check(const Keywords& call, const solver::Result& result) {
  for (const solver::ResultStep& step : result.steps) {
    for (const auto& [name, field] : step.fields) {
      if (is_known(name) && fits(field) && (name != nodal_field || std::holds_alternative<solver::NodalField>(field))) continue;
      throw DiagnosticError("unsupported", fmt::format("EVOL_CHAR: the result holds {}{}", name, is_known(name) ? " where comma does not know such loads" : ", which comma does not know as a load"),
                            call.span_of("EVOL_CHAR"), "comma knows PRES, FSUR_2D, FSUR_3D, FVOL_2D and FVOL_3D at nodes and on cells, FORC_NODA at nodes");
    }
  }
}

/// Null where the result holds no such component.
History history_of(const solver::Result& result, const char* name, std::string_view component) {
  auto history = std::make_shared<solver::LoadHistory>();
  for (const solver::ResultStep& step : result.steps) {
    const auto found = step.fields.find(name);
    if (found == step.fields.end()) continue;
    const int column = std::visit([&](const auto& field) { return field.component(component); }, found->second);
    if (column >= 0) history->add(step.instant, found->second, column);
  }
  return history->empty() ? nullptr : history;
}

/// The history at the nodes of one cell.
solver::NodalFunction at_nodes(const History& history, int cell, std::span<const int> nodes) {
  return [history, cell, nodes = std::vector<int>(nodes.begin(), nodes.end())](int node, double time) {
    return history->at(cell, static_cast<int>(std::ranges::find(nodes, node) - nodes.begin()), node, time);
  };
}

bool bears(const LoadedModel& target, const ForceField& kind, int cell) {
  const int body = solver::continuum_dimension(target.model.formulations[cell]);
  const int own = solver::dimension(target.mesh.cell_types[cell]);
  return body == kind.body && (kind.inside ? own == body : is_surface(target, cell));
}

int add_pressures(const solver::Result& result, const LoadedModel& target, solver::Load& load) {
  const History history = history_of(result, pressure_field, pressure_field);
  if (!history) return 0;
  int loaded = 0;
  for (int cell = 0; cell < target.mesh.cell_count(); ++cell) {
    if (!is_surface(target, cell) || !history->covers(cell, target.mesh.cell(cell))) continue;
    solver::PressureLoad pressure{};
    pressure.cell = cell;
    pressure.pressure_at_nodes = at_nodes(history, cell, target.mesh.cell(cell));
    load.pressures.push_back(std::move(pressure));
    ++loaded;
  }
  return loaded;
}

int add_distributed_forces(const solver::Result& result, const LoadedModel& target, const ForceField& kind, solver::Load& load) {
  std::array<History, 3> histories;
  for (std::size_t c = 0; c < 3; ++c) histories[c] = history_of(result, kind.name, force_names[c]);
  int loaded = 0;
  for (int cell = 0; cell < target.mesh.cell_count(); ++cell) {
    if (!bears(target, kind, cell)) continue;
    solver::DistributedForce force{};
    force.cell = cell;
    bool acts = false;
    for (std::size_t c = 0; c < 3; ++c) {
      if (!histories[c] || !histories[c]->covers(cell, target.mesh.cell(cell))) continue;
      force.functions_at_nodes[c] = at_nodes(histories[c], cell, target.mesh.cell(cell));
      acts = true;
    }
    if (!acts) continue;
    load.distributed_forces.push_back(std::move(force));
    ++loaded;
  }
  return loaded;
}

// A force has the name of the displacement that it works on.
int add_forces_at_nodes(const solver::Result& result, const LoadedModel& target, solver::Load& load) {
  int loaded = 0;
  for (const NamedComponent& named : displacement_keywords) {
    const History history = history_of(result, nodal_field, named.keyword);
    if (!history) continue;
    for (int node = 0; node < target.mesh.node_count(); ++node) {
      if (!history->covers(node)) continue;
      load.nodal_forces.push_back({node, named.component, 0.0, [history, node](const solver::Point&, double time) { return history->at(node, time); }});
      ++loaded;
    }
  }
  return loaded;
}

}  // namespace

void add_evolving_loads(const Keywords& call, const LoadedModel& target, solver::Load& load) {
  if (!call.has("EVOL_CHAR")) return;
  const solver::Result& result = call.data<ResultConcept>("EVOL_CHAR").result;
  if (&result.mesh() != &target.mesh) throw DiagnosticError("incompatible-field", "EVOL_CHAR: the result lies on another mesh than the model", call.span_of("EVOL_CHAR"));
  check(call, result);
  int loaded = add_pressures(result, target, load) + add_forces_at_nodes(result, target, load);
  for (const ForceField& kind : force_fields) loaded += add_distributed_forces(result, target, kind, load);
  if (loaded > 0) return;
  throw DiagnosticError("no-skin", "EVOL_CHAR: no cell or node of the model has a load that the result holds", call.span_of("EVOL_CHAR"),
                        "PRES and FSUR act on cells of the boundary, FVOL inside, wherever all nodes of a cell, or the cell, have a value");
}

}  // namespace comma::commands
