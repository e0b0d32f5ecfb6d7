// Forces of AFFE_CHAR_MECA: on nodes, skins, volumes and beams, weight, rotation, initial strains.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "commands/concepts.hpp"
#include "commands/load_building.hpp"
#include "commands/selection.hpp"
#include "interpreter/diagnostic.hpp"
#include "solver/elements/slender_forces.hpp"
#include "solver/fields/field_algebra.hpp"
#include "solver/loads/end_effect.hpp"
#include "solver/loads/nodal_history.hpp"
#include "solver/loads/plate_moments.hpp"

namespace comma::commands {

using interpreter::DiagnosticError;
using interpreter::Keywords;

namespace {

/// The loads of one factor keyword by the cell they act on: a later occurrence overrides the components that it gives.
template <class CellLoad>
using ByCell = std::map<int, CellLoad>;

template <class CellLoad>
void append(std::vector<CellLoad>& to, ByCell<CellLoad> loads) {
  for (auto& [cell, load] : loads) to.push_back(std::move(load));
}

template <std::size_t N>
using Amounts = std::array<std::optional<Amount>, N>;

/// Those of the keywords that are given.
template <std::size_t N>
Amounts<N> given_amounts(const Keywords& keywords, const std::array<const char*, N>& names) {
  Amounts<N> amounts;
  for (std::size_t i = 0; i < N; ++i) {
    if (keywords.given(names[i])) amounts[i] = amount_of(keywords, names[i]);
  }
  return amounts;
}

/// Of a load that may follow the body.
std::optional<Amount> following_amount(const Keywords& keywords, const char* name) {
  if (!keywords.given(name)) return std::nullopt;
  if (!keywords.at(name).value.is_concept()) return amount_of(keywords, name);
  return Amount{0.0, following_function(keywords.concept_of(name), keywords.span_of(name))};
}

template <std::size_t N>
void override_given(const Amounts<N>& amounts, std::array<double, N>& values, std::array<solver::FieldFunction, N>& functions) {
  for (std::size_t i = 0; i < N; ++i) {
    if (!amounts[i]) continue;
    values[i] = amounts[i]->value;
    functions[i] = amounts[i]->function;
  }
}

/// The cells named that a load can act on. Throws DiagnosticError `no-element` when there is none.
template <class Predicate>
std::vector<int> loadable_cells(const Keywords& keywords, const LoadedModel& target, const std::string& name, const std::string& what,
                                Predicate can_bear) {
  auto cells = selected_cells(keywords, target.mesh);
  std::erase_if(cells, [&](int cell) { return !can_bear(cell); });
  if (cells.empty()) {
    throw DiagnosticError("no-element", fmt::format("{}: none of these cells is {}", name, what), keywords.span,
                          "AFFE_MODELE must cover the cells that a load acts on");
  }
  return cells;
}

// A surface force acts on the skin of one dimension less than its body, a volume force on the body itself.
struct DistributedKeyword {
  const char* name;
  const char* what;
  int cell_dimension;  ///< 0: that of the body
};

constexpr DistributedKeyword distributed_keywords[] = {{"FORCE_FACE", "a face on the skin of a solid", 2},
                                                       {"FORCE_ARETE", "an edge of a solid", 1},
                                                       {"FORCE_CONTOUR", "an edge on the boundary of a plane body", 1},
                                                       {"FORCE_INTERNE", "a cell of a solid or plane body", 0}};

bool bears(const LoadedModel& target, const DistributedKeyword& keyword, int cell) {
  const int body = solver::continuum_dimension(target.model.formulations[cell]);
  const int own = solver::dimension(target.mesh.cell_types[cell]);
  if (keyword.cell_dimension == 0) return body > 0 && own == body;
  return target.model.is_skin(cell) && own == keyword.cell_dimension;
}

void add_distributed_forces(const Keywords& call, const LoadedModel& target, solver::Load& load) {
  for (const DistributedKeyword& keyword : distributed_keywords) {
    ByCell<solver::DistributedForce> forces;
    for (const Keywords& occurrence : call.factors(keyword.name)) {
      const auto amounts = given_amounts<3>(occurrence, {"FX", "FY", "FZ"});
      const auto can_bear = [&](int cell) { return bears(target, keyword, cell); };
      for (const int cell : loadable_cells(occurrence, target, keyword.name, keyword.what, can_bear)) {
        auto& force = forces[cell];
        force.cell = cell;
        override_given(amounts, force.force, force.functions);
      }
    }
    append(load.distributed_forces, std::move(forces));
  }
}

// A force in turned axes: each global component is a sum of the ones given.
Amount component_of_turned(const std::array<Amount, 3>& given, const Eigen::Vector3d& direction) {
  Amount sum;
  bool varies = false;
  for (Eigen::Index i = 0; i < 3; ++i) {
    sum.value += direction[i] * given[static_cast<std::size_t>(i)].value;
    varies |= static_cast<bool>(given[static_cast<std::size_t>(i)].function);
  }
  if (!varies) return sum;
  sum.function = [given, direction](const solver::Point& at, double time) {
    double total = 0.0;
    for (Eigen::Index i = 0; i < 3; ++i) total += direction[i] * given[static_cast<std::size_t>(i)].at(at, time);
    return total;
  };
  return sum;
}

bool is_plate(const LoadedModel& target, int cell) {
  return solver::is_plate(target.model.formulations[cell]) && !target.model.is_skin(cell);
}

// What a pressure acts on.
bool is_surface(const LoadedModel& target, int cell) {
  if (solver::is_plate(target.model.formulations[cell])) return is_plate(target, cell);
  return target.model.is_skin(cell);
}

// FORCE_COQUE: tractions and moments along the axes of the mesh, or across the plate. PRES acts against the normal, F3 along it (U4.44.01).
void add_plate_forces(const Keywords& call, const LoadedModel& target, solver::Load& load) {
  ByCell<solver::DistributedForce> forces;
  ByCell<solver::PlateMoment> moments;
  ByCell<solver::PressureLoad> pressures;
  for (const Keywords& occurrence : call.factors("FORCE_COQUE")) {
    const auto amounts = given_amounts<3>(occurrence, {"FX", "FY", "FZ"});
    const auto turning = given_amounts<3>(occurrence, {"MX", "MY", "MZ"});
    const bool pressed = occurrence.given("PRES"), pulled = occurrence.given("F3");
    const Amount across = pulled ? component_of_turned({amount_of(occurrence, "F3")}, -Eigen::Vector3d::UnitX()) : amount_of(occurrence, "PRES");
    for (const int cell : loadable_cells(occurrence, target, "FORCE_COQUE", "a plate", [&](int each) { return is_plate(target, each); })) {
      if (pressed || pulled) {
        pressures[cell].cell = cell;
        std::tie(pressures[cell].pressure, pressures[cell].pressure_function) = std::pair(across.value, across.function);
        continue;
      }
      forces[cell].cell = cell;
      override_given(amounts, forces[cell].force, forces[cell].functions);
      moments[cell].cell = cell;
      override_given(turning, moments[cell].moment, moments[cell].functions);
    }
  }
  append(load.distributed_forces, std::move(forces));
  append(load.pressures, std::move(pressures));
  for (const auto& [cell, moment] : moments) {
    for (solver::NodalForce& force : solver::plate_moment_forces(target.mesh, moment)) load.nodal_forces.push_back(std::move(force));
  }
}

void add_pressures(const Keywords& call, const LoadedModel& target, solver::Load& load) {
  ByCell<solver::PressureLoad> pressures;
  for (const Keywords& occurrence : call.factors("PRES_REP")) {
    const Amounts<2> amounts = {following_amount(occurrence, "PRES"), following_amount(occurrence, "CISA_2D")};
    int loaded = 0;
    for (const int cell : selected_cells(occurrence, target.mesh)) {
      if (!is_surface(target, cell)) continue;
      auto& pressure = pressures[cell];
      pressure.cell = cell;
      if (amounts[0]) std::tie(pressure.pressure, pressure.pressure_function) = std::pair(amounts[0]->value, amounts[0]->function);
      if (amounts[1]) std::tie(pressure.shear, pressure.shear_function) = std::pair(amounts[1]->value, amounts[1]->function);
      ++loaded;
    }
    if (loaded == 0) {
      throw DiagnosticError("no-skin", "PRES_REP: none of these cells is on the skin of the model or a plate", occurrence.span,
                            "a pressure acts on edges of a plane model, faces of a solid one, or plates, and AFFE_MODELE must cover them");
    }
  }
  append(load.pressures, std::move(pressures));
}

std::shared_ptr<const solver::NodalHistory> pressure_history(const Keywords& call, const solver::Mesh& mesh) {
  constexpr const char* pressure = "PRES";
  const solver::Result& result = call.data<ResultConcept>("EVOL_CHAR").result;
  if (&result.mesh() != &mesh) throw DiagnosticError("incompatible-field", "EVOL_CHAR: the result lies on another mesh than the model", call.span_of("EVOL_CHAR"));
  auto history = std::make_shared<solver::NodalHistory>();
  for (const solver::ResultStep& step : result.steps) {
    for (const auto& [name, field] : step.fields) {
      const auto* nodal = std::get_if<solver::NodalField>(&field);
      if (name != pressure || nodal == nullptr || nodal->component(pressure) < 0) {
        throw DiagnosticError("unsupported", fmt::format("EVOL_CHAR: the result holds {}, but of such loads comma knows pressures at nodes (PRES) alone", name),
                              call.span_of("EVOL_CHAR"), "make the others by the keywords of AFFE_CHAR_MECA_F");
      }
      const int component = nodal->component(pressure);
      history->add(step.instant, std::get<solver::NodalField>(solver::with_components(*nodal, {&component, 1})));
    }
  }
  if (history->empty()) throw DiagnosticError("unknown-field", "EVOL_CHAR: the result holds no PRES", call.span_of("EVOL_CHAR"), "CREA_RESU puts it there");
  return history;
}

// They act on all of the boundary of the model where every node of a cell has one.
void add_evolving_pressures(const Keywords& call, const LoadedModel& target, solver::Load& load) {
  if (!call.has("EVOL_CHAR")) return;
  const auto history = pressure_history(call, target.mesh);
  const std::size_t before = load.pressures.size();
  for (int cell = 0; cell < target.mesh.cell_count(); ++cell) {
    if (!is_surface(target, cell) || !std::ranges::all_of(target.mesh.cell(cell), [&](int node) { return history->covers(node); })) continue;
    solver::PressureLoad pressure{};
    pressure.cell = cell;
    pressure.pressure_at_nodes = [history](int node, double time) { return history->at(node, time); };
    load.pressures.push_back(std::move(pressure));
  }
  if (load.pressures.size() == before) {
    throw DiagnosticError("no-skin", "EVOL_CHAR: no cell on the boundary of the model has a pressure at all of its nodes", call.span_of("EVOL_CHAR"));
  }
}

void add_end_effects(const Keywords& call, const LoadedModel& target, solver::Load& load) {
  ByCell<solver::PressureLoad> pressures;
  for (const Keywords& occurrence : call.factors("EFFE_FOND")) {
    const auto rim = selected_cells(occurrence, target.mesh, {"", "", "", "GROUP_MA_INT", ""});
    const Amount amount = amount_of(occurrence, "PRES");
    for (auto& pressure : solver::end_effect(target.mesh, selected_cells(occurrence, target.mesh), rim, amount.value, amount.function)) {
      pressures[pressure.cell] = std::move(pressure);
    }
  }
  append(load.pressures, std::move(pressures));
}

using NodeForces = std::map<std::pair<int, solver::Component>, Amount>;

void add_turned_forces(const Keywords& force, const std::vector<int>& nodes, const LoadedModel& target, NodeForces& forces) {
  const Eigen::Matrix3d axes = axes_of_angles(force.reals("ANGL_NAUT"));
  for (const std::size_t first : {std::size_t{0}, std::size_t{3}}) {
    std::array<Amount, 3> given;
    bool any = false;
    for (std::size_t i = 0; i < 3; ++i) {
      given[i] = amount_of(force, force_keywords[first + i].keyword);
      any |= force.given(force_keywords[first + i].keyword);
    }
    if (!any) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto component = force_keywords[first + i].component;
      const Amount amount = component_of_turned(given, axes.col(static_cast<Eigen::Index>(i)));
      for (const int node : nodes) {
        if (target.dofs.dof(node, component) >= 0) forces[{node, component}] = amount;
      }
    }
  }
}

void add_nodal_forces(const Keywords& call, const LoadedModel& target, solver::Load& load) {
  NodeForces forces;
  for (const Keywords& force : call.factors("FORCE_NODALE")) {
    const auto nodes = selected_nodes(force, target.mesh);
    if (force.given("ANGL_NAUT")) {
      add_turned_forces(force, nodes, target, forces);
      continue;
    }
    for (const NamedComponent& named : force_keywords) {
      if (!force.given(named.keyword)) continue;
      const Amount amount = amount_of(force, named.keyword);
      for (const int node : carriers(force, named, nodes, target.dofs)) forces[{node, named.component}] = amount;
    }
  }
  for (const auto& [place, amount] : forces) load.nodal_forces.push_back({place.first, place.second, amount.value, amount.function});
}

// VECT_ASSE: a vector of forces that a field on nodes holds.
void add_force_vector(const Keywords& call, const LoadedModel& target, solver::Load& load) {
  if (!call.has("VECT_ASSE")) return;
  const auto* field = std::get_if<solver::NodalField>(&call.data<FieldConcept>("VECT_ASSE").field);
  if (field == nullptr) {
    throw DiagnosticError("wrong-concept-type", "VECT_ASSE wants a field on nodes", call.span_of("VECT_ASSE"));
  }
  for (std::size_t c = 0; c < field->components.size(); ++c) {
    const auto component = component_named(call, "VECT_ASSE", field->components[c]);
    for (int node = 0; node < target.mesh.node_count(); ++node) {
      const double value = field->at(node, static_cast<int>(c));
      if (std::isnan(value) || value == 0.0) continue;
      if (target.dofs.dof(node, component) < 0) {
        throw DiagnosticError("unknown-component",
                              fmt::format("VECT_ASSE: {} does not carry {} in the model", target.mesh.node_name(node), field->components[c]),
                              call.span_of("VECT_ASSE"));
      }
      load.nodal_forces.push_back({node, component, value, {}});
    }
  }
}

constexpr std::array<const char*, 6> global_beam_forces = {"FX", "FY", "FZ", "MX", "MY", "MZ"};
constexpr std::array<const char*, 6> own_beam_forces = {"N", "VY", "VZ", "MT", "MFY", "MFZ"};

void add_beam_forces(const Keywords& call, const LoadedModel& target, solver::Load& load) {
  ByCell<solver::BeamForce> forces;
  for (const Keywords& occurrence : call.factors("FORCE_POUTRE")) {
    const bool own = std::ranges::any_of(own_beam_forces, [&](const char* name) { return occurrence.given(name); });
    const auto amounts = given_amounts(occurrence, own ? own_beam_forces : global_beam_forces);
    const auto axes = own ? solver::BeamAxes::own : solver::BeamAxes::global;
    const auto can_bear = [&](int cell) {
      return solver::is_beam(target.model.formulations[cell]) || solver::is_bar(target.model.formulations[cell]);
    };
    for (const int cell : loadable_cells(occurrence, target, "FORCE_POUTRE", "a beam or bar", can_bear)) {
      auto& force = forces[cell];
      // Forces given in other axes than before replace those entirely.
      if (force.axes != axes) force = {};
      force.cell = cell;
      force.axes = axes;
      override_given(amounts, force.force, force.functions);
    }
  }
  append(load.beam_forces, std::move(forces));
}

std::vector<int> cells_or_all(const Keywords& keywords, const solver::Mesh& mesh) {
  if (names_a_place(keywords)) return selected_cells(keywords, mesh);
  std::vector<int> all(static_cast<std::size_t>(mesh.cell_count()));
  for (int cell = 0; cell < mesh.cell_count(); ++cell) all[static_cast<std::size_t>(cell)] = cell;
  return all;
}

std::array<double, 3> vector_of(const Keywords& keywords, const std::string& name) {
  std::array<double, 3> vector{};
  const auto values = keywords.reals(name);
  std::copy(values.begin(), values.end(), vector.begin());
  return vector;
}

void add_inertia_loads(const Keywords& call, const LoadedModel& target, solver::Load& load) {
  for (const Keywords& weight : call.factors("PESANTEUR")) {
    auto acceleration = vector_of(weight, "DIRECTION");
    const double length = std::hypot(acceleration[0], acceleration[1], acceleration[2]);
    if (length == 0.0) throw DiagnosticError("zero-vector", "PESANTEUR/DIRECTION has no length", weight.span_of("DIRECTION"));
    for (double& component : acceleration) component *= weight.real("GRAVITE") / length;
    load.gravities.push_back({cells_or_all(weight, target.mesh), acceleration});
  }
  for (const Keywords& rotation : call.factors("ROTATION")) {
    load.rotations.push_back({cells_or_all(rotation, target.mesh), rotation.real("VITESSE"), vector_of(rotation, "AXE"),
                              vector_of(rotation, "CENTRE")});
  }
}

void add_initial_strains(const Keywords& call, const LoadedModel& target, solver::Load& load) {
  ByCell<solver::InitialStrain> strains;
  ByCell<solver::InitialSlenderStrain> slender_strains;
  for (const Keywords& occurrence : call.factors("PRE_EPSI")) {
    const auto amounts = given_amounts<6>(occurrence, {"EPXX", "EPYY", "EPZZ", "EPXY", "EPXZ", "EPYZ"});
    const auto slender = given_amounts<3>(occurrence, {"EPX", "KY", "KZ"});
    const auto is_given = [](const auto& amount) { return amount.has_value(); };
    for (const int cell : selected_cells(occurrence, target.mesh)) {
      const auto formulation = target.model.formulations[cell];
      if (solver::is_plate(formulation) && !target.model.is_skin(cell)) {
        throw DiagnosticError("unsupported", fmt::format("PRE_EPSI: comma does not support it on plates such as {}", target.mesh.cell_name(cell)),
                              occurrence.span, "name the cells without plates");
      }
      if (std::ranges::any_of(amounts, is_given) && solver::continuum_dimension(formulation) > 0 && !target.model.is_skin(cell)) {
        strains[cell].cell = cell;
        override_given(amounts, strains[cell].strain, strains[cell].functions);
      }
      if (std::ranges::any_of(slender, is_given) && (solver::is_beam(formulation) || solver::is_bar(formulation))) {
        slender_strains[cell].cell = cell;
        override_given(slender, slender_strains[cell].strain, slender_strains[cell].functions);
      }
      // A bar has its elongation under the name that solids have (U4.44.01, PRE_EPSI).
      if (amounts[0] && solver::is_bar(formulation)) {
        slender_strains[cell].cell = cell;
        override_given<3>({amounts[0], std::nullopt, std::nullopt}, slender_strains[cell].strain, slender_strains[cell].functions);
      }
    }
    if (strains.empty() && slender_strains.empty()) {
      throw DiagnosticError("no-element", "PRE_EPSI: none of these cells can have such a strain", occurrence.span,
                            "EPXX ... are for solids and plane bodies, EPXX for bars, EPX, KY, KZ for beams");
    }
  }
  append(load.initial_strains, std::move(strains));
  append(load.initial_slender_strains, std::move(slender_strains));
}

}  // namespace

void add_forces(const Keywords& call, const LoadedModel& target, solver::Load& load) {
  add_nodal_forces(call, target, load);
  add_force_vector(call, target, load);
  add_pressures(call, target, load);
  add_plate_forces(call, target, load);
  add_evolving_pressures(call, target, load);
  add_end_effects(call, target, load);
  add_distributed_forces(call, target, load);
  add_beam_forces(call, target, load);
  add_inertia_loads(call, target, load);
  add_initial_strains(call, target, load);
}

}  // namespace comma::commands
