// Forces of AFFE_CHAR_MECA on skins and volumes.
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "commands/functions/functions.hpp"
#include "commands/loads/force_reading.hpp"
#include "commands/loads/load_building.hpp"
#include "commands/selection.hpp"
#include "interpreter/diagnostic.hpp"
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

}  // namespace

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
