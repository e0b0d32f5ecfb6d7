// AFFE_CHAR_MECA/EVOL_CHAR: pressures and forces that a result holds in time; AFFE_CHAR_CINE/EVOL_IMPO: displacements.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "commands/concepts.hpp"
#include "commands/loads/load_building.hpp"
#include "interpreter/diagnostic.hpp"
#include "solver/fields/data/field_parts.hpp"
#include "solver/fields/data/field_rows.hpp"
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
constexpr ForceField force_fields[] = {
    {"FSUR_2D", 2, false}, {"FSUR_3D", 3, false}, {"FVOL_2D", 2, true}, {"FVOL_3D", 3, true}};
constexpr const char* pressure_field = "PRES";
constexpr const char* nodal_field = "FORC_NODA";
constexpr std::array<const char*, 3> force_names = {"FX", "FY", "FZ"};

bool is_known(const std::string& name) {
  return name == pressure_field || name == nodal_field ||
         std::ranges::any_of(force_fields, [&](const ForceField& each) { return name == each.name; });
}

bool fits(const solver::Field& field) {
  const auto* on_cells = std::get_if<solver::ElementField>(&field);
  return on_cells == nullptr || on_cells->support != solver::Support::gauss_point;
}

// The components that the loads of a field have.
std::vector<std::string_view> components_of(std::string_view name) {
  if (name == pressure_field) return {pressure_field};
  std::vector<std::string_view> names;
  if (name == nodal_field)
    for (const NamedComponent& named : displacement_keywords) names.emplace_back(named.keyword);
  else
    names.assign(force_names.begin(), force_names.end());
  return names;
}

// A component that is no load would be left out.
void check_components(const Keywords& call, const std::string& name, const solver::Field& field) {
  const std::vector<std::string_view> known = components_of(name);
  const std::vector<std::string>& given = solver::components_of(field);
  const std::vector<double>& values = solver::values_of(field);
  for (std::size_t k = 0; k < values.size(); ++k) {
    const std::string& component = given[k % given.size()];
    if (!(std::abs(values[k]) > 0.0) || std::ranges::find(known, component) != known.end()) continue;
    throw DiagnosticError(
        "unsupported",
        fmt::format("EVOL_CHAR: the field {} of the result has {}, which comma does not know as a load", name,
                    component),
        call.span_of("EVOL_CHAR"),
        name == nodal_field ? "forces on nodes have the names of the displacements that they work on: DX, DY ..."
                            : fmt::format("give {} alone", fmt::join(known, ", ")));
  }
}

void check(const Keywords& call, const solver::Result& result) {
  for (const solver::ResultStep& step : result.steps) {
    for (const auto& [name, field] : step.fields) {
      if (is_known(name) && fits(field) && (name != nodal_field || std::holds_alternative<solver::NodalField>(field))) {
        check_components(call, name, field);
        continue;
      }
      throw DiagnosticError(
          "unsupported",
          fmt::format(
              "EVOL_CHAR: the result holds {}{}", name,
              is_known(name) ? " where comma does not know such loads" : ", which comma does not know as a load"),
          call.span_of("EVOL_CHAR"),
          "comma knows PRES, FSUR_2D, FSUR_3D, FVOL_2D and FVOL_3D at nodes and on cells, FORC_NODA at nodes");
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

// The keyword, the result that it names and what its loads act on.
struct Reading {
  const Keywords& call;
  const solver::Result& result;
  const LoadedModel& target;

  /// Whether a place bears the load at all instants. Where it has a value at some of them alone nothing says what is
  /// there at the others.
  bool is_borne(solver::Coverage coverage, std::string_view field, const std::string& place) const {
    if (coverage != solver::Coverage::partial) return coverage == solver::Coverage::whole;
    const char* keyword = call.has("EVOL_CHAR") ? "EVOL_CHAR" : "EVOL_IMPO";
    throw DiagnosticError(
        "incomplete-load",
        fmt::format("{}: {} has values on {} at some instants and none at others", keyword, field, place),
        call.span_of(keyword), "give them at all instants, 0 where nothing acts");
  }
  bool is_borne(const solver::LoadHistory& history, std::string_view field, int cell) const {
    return is_borne(history.coverage(cell, target.mesh.cell(cell)), field, target.mesh.cell_name(cell));
  }
};

int add_pressures(const Reading& reading, solver::Load& load) {
  const History history = history_of(reading.result, pressure_field, pressure_field);
  const solver::Mesh& mesh = reading.target.mesh;
  int loaded = 0;
  for (int cell = 0; history && cell < mesh.cell_count(); ++cell) {
    if (!is_surface(reading.target, cell) || !reading.is_borne(*history, pressure_field, cell)) continue;
    solver::PressureLoad pressure{};
    pressure.cell = cell;
    pressure.pressure_at_nodes = at_nodes(history, cell, mesh.cell(cell));
    load.pressures.push_back(std::move(pressure));
    ++loaded;
  }
  return loaded;
}

int add_distributed_forces(const Reading& reading, const ForceField& kind, solver::Load& load) {
  std::array<History, 3> histories;
  for (std::size_t c = 0; c < 3; ++c) histories[c] = history_of(reading.result, kind.name, force_names[c]);
  const solver::Mesh& mesh = reading.target.mesh;
  int loaded = 0;
  for (int cell = 0; cell < mesh.cell_count(); ++cell) {
    if (!bears(reading.target, kind, cell)) continue;
    solver::DistributedForce force{};
    force.cell = cell;
    bool acts = false;
    for (std::size_t c = 0; c < 3; ++c) {
      if (!histories[c] || !reading.is_borne(*histories[c], kind.name, cell)) continue;
      force.functions_at_nodes[c] = at_nodes(histories[c], cell, mesh.cell(cell));
      acts = true;
    }
    if (!acts) continue;
    load.distributed_forces.push_back(std::move(force));
    ++loaded;
  }
  return loaded;
}

// A force has the name of the displacement that it works on.
int add_forces_at_nodes(const Reading& reading, solver::Load& load) {
  int loaded = 0;
  for (const NamedComponent& named : displacement_keywords) {
    const History history = history_of(reading.result, nodal_field, named.keyword);
    for (int node = 0; history && node < reading.target.mesh.node_count(); ++node) {
      if (!reading.is_borne(history->coverage(node), nodal_field, reading.target.mesh.node_name(node))) continue;
      load.nodal_forces.push_back({node, named.component, 0.0, [history, node](const solver::Point&, double time) {
                                     return history->at(node, time);
                                   }});
      ++loaded;
    }
  }
  return loaded;
}

}  // namespace

void add_evolving_loads(const Keywords& call, const LoadedModel& target, solver::Load& load) {
  if (!call.has("EVOL_CHAR")) return;
  const solver::Result& result = call.data<ResultConcept>("EVOL_CHAR").result;
  if (&result.mesh() != &target.mesh)
    throw DiagnosticError("incompatible-field", "EVOL_CHAR: the result lies on another mesh than the model",
                          call.span_of("EVOL_CHAR"));
  check(call, result);
  const Reading reading{call, result, target};
  const auto require_reached = [&](const char* name, int loaded) {
    const auto holds = [&](const solver::ResultStep& step) { return step.fields.contains(name); };
    if (loaded > 0 || std::ranges::none_of(result.steps, holds)) return;
    throw DiagnosticError(
        "no-skin", fmt::format("EVOL_CHAR: no cell or node of the model has the load {} that the result holds", name),
        call.span_of("EVOL_CHAR"),
        "PRES and FSUR act on cells of the boundary, FVOL inside, wherever all nodes of a cell, or the cell, have a "
        "value");
  };
  require_reached(pressure_field, add_pressures(reading, load));
  require_reached(nodal_field, add_forces_at_nodes(reading, load));
  for (const ForceField& kind : force_fields) require_reached(kind.name, add_distributed_forces(reading, kind, load));
}

void add_evolving_displacements(const Keywords& call, const LoadedModel& target, solver::Load& load) {
  if (!call.has("EVOL_IMPO")) return;
  const solver::Result& result = call.data<ResultConcept>("EVOL_IMPO").result;
  if (&result.mesh() != &target.mesh)
    throw DiagnosticError("incompatible-field", "EVOL_IMPO: the result lies on another mesh than the model",
                          call.span_of("EVOL_IMPO"), "bring it there by PROJ_CHAMP");
  std::vector<std::string> wanted = call.texts("NOM_CMP");
  for (const std::string& name : wanted) component_named(call, "NOM_CMP", name);
  const Reading reading{call, result, target};
  const solver::Origin origin = origin_of(call, "EVOL_IMPO");
  const std::size_t before = load.relations.size();
  for (const NamedComponent& named : displacement_keywords) {
    if (!wanted.empty() && std::ranges::find(wanted, named.keyword) == wanted.end()) continue;
    const History history = history_of(result, "DEPL", named.keyword);
    for (int node = 0; history && node < target.mesh.node_count(); ++node) {
      if (target.dofs.dof(node, named.component) < 0) continue;
      if (!reading.is_borne(history->coverage(node), "DEPL", target.mesh.node_name(node))) continue;
      load.relations.push_back({{{node, named.component, 1.0}},
                                0.0,
                                [history, node](const solver::Point&, double time) { return history->at(node, time); },
                                origin});
    }
  }
  if (load.relations.size() == before)
    throw DiagnosticError("unknown-field", "EVOL_IMPO: the result has no displacements at nodes of the model",
                          call.span_of("EVOL_IMPO"));
}

}  // namespace comma::commands
