// Forces of AFFE_CHAR_MECA on skins, volumes, plates and beams.
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "commands/functions/functions.hpp"
#include "commands/loads/force_reading.hpp"
#include "commands/loads/load_building.hpp"
#include "commands/selection.hpp"
#include "interpreter/diagnostic.hpp"
#include "solver/elements/slender/slender_forces.hpp"
#include "solver/loads/end_effect.hpp"
#include "solver/loads/plate_moments.hpp"

namespace comma::commands {

using interpreter::DiagnosticError;
using interpreter::Keywords;

namespace {

/// Of a load that may follow the body.
std::optional<Amount> following_amount(const Keywords& keywords, const char* name) {
  if (!keywords.given(name)) return std::nullopt;
  if (!keywords.at(name).value.is_concept()) return amount_of(keywords, name);
  return Amount{0.0, following_function(keywords.concept_of(name), keywords.span_of(name))};
}

// A surface force acts on the skin of one dimension less than its body, a volume force on the body itself.
struct DistributedKeyword {
  const char* name;
  const char* what;
  int cell_dimension;    ///< 0: that of the body
  int foreign_body = 0;  ///< the dimension of continua on whose skin it does not act
};

constexpr DistributedKeyword distributed_keywords[] = {
    {"FORCE_FACE", "a face on the skin of a solid", 2},
    {"FORCE_ARETE", "an edge of a solid or of a plate", 1, 2},
    {"FORCE_CONTOUR", "an edge on the boundary of a plane body or of a plate", 1, 3},
    {"FORCE_INTERNE", "a cell of a solid or plane body", 0}};

bool bears(const LoadedModel& target, const DistributedKeyword& keyword, int cell) {
  const int body = solver::continuum_dimension(target.model.formulations[cell]);
  const int own = solver::dimension(target.mesh.cell_types[cell]);
  if (keyword.cell_dimension == 0) return body > 0 && own == body;
  return target.model.is_skin(cell) && own == keyword.cell_dimension && (body == 0 || body != keyword.foreign_body);
}

void append_moments(const LoadedModel& target, const ByCell<solver::PlateMoment>& moments, solver::Load& load) {
  for (const auto& [cell, moment] : moments) {
    for (solver::NodalForce& force : solver::plate_moment_forces(target.mesh, moment))
      load.nodal_forces.push_back(std::move(force));
  }
}

// Of an edge, which must have rotations to turn.
void take_moment(const Keywords& occurrence, const LoadedModel& target, const DistributedKeyword& keyword, int cell,
                 ByCell<solver::PlateMoment>& moments) {
  const auto turning = given_amounts<3>(occurrence, {"MX", "MY", "MZ"});
  if (keyword.cell_dimension != 1 || std::ranges::none_of(turning, [](const auto& each) { return each.has_value(); }))
    return;
  if (target.dofs.dof(target.mesh.cell(cell)[0], solver::Component::drx) < 0) {
    throw DiagnosticError("unknown-component",
                          fmt::format("{}: a moment acts on {}, whose nodes have no rotations", keyword.name,
                                      target.mesh.cell_name(cell)),
                          occurrence.span, "moments are for the edges of plates");
  }
  moments[cell].cell = cell;
  override_given(turning, moments[cell].moment, moments[cell].functions);
}

// A plane body lacks the third.
void require_components(const Keywords& occurrence, const LoadedModel& target, int cell, const Amounts<3>& amounts) {
  constexpr std::array<const char*, 3> names = {"FX", "FY", "FZ"};
  for (std::size_t axis = 0; axis < amounts.size(); ++axis) {
    const auto component = static_cast<solver::Component>(axis);
    const bool acts = amounts[axis] && (amounts[axis]->value != 0.0 || amounts[axis]->function);
    if (!acts || target.dofs.dof(target.mesh.cell(cell)[0], component) >= 0) continue;
    throw DiagnosticError("unknown-dof",
                          fmt::format("{} acts on cell {}, whose nodes have no {}", names[axis],
                                      target.mesh.cell_name(cell), solver::name_of(component)),
                          occurrence.at(names[axis]).name_span,
                          "a plane model bears forces along X and Y: give FX and FY alone");
  }
}

void add_distributed_forces(const Keywords& call, const LoadedModel& target, solver::Load& load) {
  for (const DistributedKeyword& keyword : distributed_keywords) {
    ByCell<solver::DistributedForce> forces;
    ByCell<solver::PlateMoment> moments;
    for (const Keywords& occurrence : call.factors(keyword.name)) {
      const auto amounts = given_amounts<3>(occurrence, {"FX", "FY", "FZ"});
      const auto can_bear = [&](int cell) { return bears(target, keyword, cell); };
      for (const int cell : loadable_cells(occurrence, target, keyword.name, keyword.what, can_bear)) {
        require_components(occurrence, target, cell, amounts);
        auto& force = forces[cell];
        force.cell = cell;
        override_given(amounts, force.force, force.functions);
        take_moment(occurrence, target, keyword, cell, moments);
      }
    }
    append(load.distributed_forces, std::move(forces));
    append_moments(target, moments, load);
  }
}

solver::PlateLevel level_of(const Keywords& occurrence) {
  const std::string plane = occurrence.text("PLAN");
  if (plane == "SUP") return solver::PlateLevel::upper;
  if (plane == "INF") return solver::PlateLevel::lower;
  return plane == "MOY" ? solver::PlateLevel::middle : solver::PlateLevel::mesh;
}

constexpr std::array<const char*, 6> global_plate_forces = {"FX", "FY", "FZ", "MX", "MY", "MZ"};
constexpr std::array<const char*, 6> own_plate_forces = {"F1", "F2", "F3", "MF1", "MF2", ""};

// Whether the section of the plate says what the force is: its axes, or its thickness.
bool asks_for_section(const Keywords& occurrence) {
  if (occurrence.given("PRES")) return false;
  const bool along = std::ranges::any_of(std::array{"F1", "F2", "MF1", "MF2"},
                                         [&](const char* name) { return occurrence.given(name); });
  return along || (level_of(occurrence) != solver::PlateLevel::mesh && !occurrence.given("F3"));
}

// Forces given in other axes or at another level than before replace those entirely.
void take_plate_force(const Keywords& occurrence, int cell, ByCell<solver::PlateForce>& forces) {
  const bool own =
      std::ranges::any_of(own_plate_forces, [&](const char* name) { return *name != '\0' && occurrence.given(name); });
  const solver::PlateLevel level = level_of(occurrence);
  solver::PlateForce& force = forces[cell];
  if (force.in_own_axes != own || force.level != level) force = {};
  force.cell = cell;
  force.in_own_axes = own;
  force.level = level;
  override_given(given_amounts(occurrence, own ? own_plate_forces : global_plate_forces), force.force, force.functions);
}

// FORCE_COQUE: tractions and moments along the axes of the mesh, those of the plate, or across it. PRES acts against
// the normal, F3 along it (U4.44.01).
void add_plate_forces(const Keywords& call, const LoadedModel& target, solver::Load& load) {
  ByCell<solver::DistributedForce> forces;
  ByCell<solver::PlateMoment> moments;
  ByCell<solver::PressureLoad> pressures;
  ByCell<solver::PlateForce> of_sections;
  for (const Keywords& occurrence : call.factors("FORCE_COQUE")) {
    const auto amounts = given_amounts<3>(occurrence, {"FX", "FY", "FZ"});
    const auto turning = given_amounts<3>(occurrence, {"MX", "MY", "MZ"});
    const bool pressed = occurrence.given("PRES"), pulled = occurrence.given("F3");
    const Amount across = pulled ? component_of_turned({amount_of(occurrence, "F3")}, -Eigen::Vector3d::UnitX())
                                 : amount_of(occurrence, "PRES");
    for (const int cell : loadable_cells(occurrence, target, "FORCE_COQUE", "a plate",
                                         [&](int each) { return is_plate(target, each); })) {
      if (asks_for_section(occurrence)) {
        take_plate_force(occurrence, cell, of_sections);
        const solver::PlateForce& taken = of_sections[cell];
        if (pulled || !taken.in_own_axes || taken.level != solver::PlateLevel::mesh) pressures.erase(cell);
        forces.erase(cell);
        moments.erase(cell);
        continue;
      }
      const auto section = of_sections.find(cell);
      const bool joins = section != of_sections.end() && (pressed || pulled) && section->second.in_own_axes &&
                         section->second.level == solver::PlateLevel::mesh;
      if (joins) {  // the same axes and level: F3 takes the place of F3
        const Amount along = component_of_turned({across}, -Eigen::Vector3d::UnitX());
        std::tie(section->second.force[2], section->second.functions[2]) = std::pair(along.value, along.function);
        continue;
      }
      if (section != of_sections.end()) of_sections.erase(section);
      if (pressed || pulled) {
        forces.erase(cell);
        moments.erase(cell);
        pressures[cell].cell = cell;
        std::tie(pressures[cell].pressure, pressures[cell].pressure_function) =
            std::pair(across.value, across.function);
        continue;
      }
      pressures.erase(cell);
      forces[cell].cell = cell;
      override_given(amounts, forces[cell].force, forces[cell].functions);
      moments[cell].cell = cell;
      override_given(turning, moments[cell].moment, moments[cell].functions);
    }
  }
  append(load.distributed_forces, std::move(forces));
  append(load.pressures, std::move(pressures));
  append(load.plate_forces, std::move(of_sections));
  append_moments(target, moments, load);
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
      if (amounts[0])
        std::tie(pressure.pressure, pressure.pressure_function) = std::pair(amounts[0]->value, amounts[0]->function);
      if (amounts[1])
        std::tie(pressure.shear, pressure.shear_function) = std::pair(amounts[1]->value, amounts[1]->function);
      ++loaded;
    }
    if (loaded == 0) {
      throw DiagnosticError("no-skin", "PRES_REP: none of these cells is on the skin of the model or a plate",
                            occurrence.span,
                            "a pressure acts on edges of a plane model, faces of a solid one, or plates, and "
                            "AFFE_MODELE must cover them");
    }
  }
  append(load.pressures, std::move(pressures));
}

void add_end_effects(const Keywords& call, const LoadedModel& target, solver::Load& load) {
  ByCell<solver::PressureLoad> pressures;
  for (const Keywords& occurrence : call.factors("EFFE_FOND")) {
    const auto rim = needed(selected_cells(occurrence, target.mesh, {"", "", "", "GROUP_MA_INT", ""}), occurrence,
                            "cell of the rim");
    const Amount amount = amount_of(occurrence, "PRES");
    for (auto& pressure :
         solver::end_effect(target.mesh, selected_cells(occurrence, target.mesh), rim, amount.value, amount.function)) {
      pressures[pressure.cell] = std::move(pressure);
    }
  }
  append(load.pressures, std::move(pressures));
}

constexpr std::array<const char*, 6> global_beam_forces = {"FX", "FY", "FZ", "MX", "MY", "MZ"};
constexpr std::array<const char*, 6> own_beam_forces = {"N", "VY", "VZ", "MT", "MFY", "MFZ"};

void add_beam_forces(const Keywords& call, const LoadedModel& target, solver::Load& load) {
  ByCell<solver::BeamForce> forces;
  for (const Keywords& occurrence : call.factors("FORCE_POUTRE")) {
    const bool own = is_in_own_axes(occurrence);
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

}  // namespace

bool is_in_own_axes(const Keywords& occurrence) {
  const auto is_given = [&](const char* name) { return *name != '\0' && occurrence.given(name); };
  return std::ranges::any_of(own_beam_forces, is_given) || std::ranges::any_of(own_plate_forces, is_given) ||
         occurrence.given("PRES");
}

void add_forces_of_fields(const Keywords& call, const LoadedModel& target, solver::Load& load) {
  add_force_vector(call, target, load);
  add_evolving_loads(call, target, load);
}

void add_forces(const Keywords& call, const LoadedModel& target, solver::Load& load) {
  add_nodal_forces(call, target, load);
  add_pressures(call, target, load);
  add_plate_forces(call, target, load);
  add_end_effects(call, target, load);
  add_distributed_forces(call, target, load);
  add_beam_forces(call, target, load);
  add_inertia_loads(call, target, load);
  add_initial_strains(call, target, load);
  add_initial_stresses(call, target, load);
}

}  // namespace comma::commands
