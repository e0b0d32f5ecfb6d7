#include "commands/loads/framed_forces.hpp"

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include "commands/loads/force_reading.hpp"
#include "solver/elements/slender/slender_forces.hpp"
#include "solver/loads/plate_moments.hpp"

namespace comma::commands {

using interpreter::Keywords;
using solver::PlateLevel;

namespace {

using Names = std::array<const char*, 6>;
constexpr Names in_global_axes = {"FX", "FY", "FZ", "MX", "MY", "MZ"};
constexpr std::size_t across = 2;  ///< the place of a plate's F3 and PRES

struct FramedKeyword {
  const char* name;
  const char* what;
  Names in_own_axes;
  bool (*can_bear)(const LoadedModel& target, int cell);
};

constexpr FramedKeyword of_beams = {
    "FORCE_POUTRE", "a beam or bar", {"N", "VY", "VZ", "MT", "MFY", "MFZ"}, [](const LoadedModel& target, int cell) {
      const auto formulation = target.model.formulations[cell];
      return solver::is_beam(formulation) || solver::is_bar(formulation);
    }};
constexpr FramedKeyword of_plates = {"FORCE_COQUE", "a plate", {"F1", "F2", "F3", "MF1", "MF2", ""}, is_plate};

const FramedKeyword& framed_keyword(const std::string& name) { return name == of_beams.name ? of_beams : of_plates; }

PlateLevel level_of(const Keywords& occurrence) {
  const std::string plane = occurrence.has("PLAN") ? occurrence.text("PLAN") : "MAIL";
  if (plane == "SUP") return PlateLevel::upper;
  if (plane == "INF") return PlateLevel::lower;
  return plane == "MOY" ? PlateLevel::middle : PlateLevel::mesh;
}

ForceFrame frame_of(const FramedKeyword& keyword, const Keywords& occurrence) {
  if (occurrence.given("PRES")) return ForceFrame::pressure;
  const auto is_given = [&](const char* name) { return *name != '\0' && occurrence.given(name); };
  return std::ranges::any_of(keyword.in_own_axes, is_given) ? ForceFrame::own : ForceFrame::global;
}

Amounts<6> amounts_of(const FramedKeyword& keyword, const Keywords& occurrence, ForceFrame frame) {
  if (frame == ForceFrame::global) return given_amounts(occurrence, in_global_axes);
  if (frame == ForceFrame::own) return given_amounts(occurrence, keyword.in_own_axes);
  Amounts<6> amounts;
  amounts[across] = amount_of(occurrence, "PRES");
  return amounts;
}

Amount amount_at(const FramedForce& force, std::size_t place) {
  return force.amounts[place] ? force.amounts[place]->amount : Amount();
}

bool has_any(const FramedForce& force, std::initializer_list<std::size_t> places) {
  return std::ranges::any_of(places, [&](std::size_t place) { return force.amounts[place].has_value(); });
}

void set(double& value, solver::FieldFunction& function, Amount amount) {
  value = amount.value;
  function = std::move(amount.function);
}

// PRES acts against the normal, F3 along it (U4.44.01).
solver::PressureLoad pressure_on(int cell, const FramedForce& force) {
  solver::PressureLoad load;
  load.cell = cell;
  const Amount given = amount_at(force, across);
  set(load.pressure, load.pressure_function,
      force.frame == ForceFrame::pressure ? given : component_of_turned({given}, -Eigen::Vector3d::UnitX()));
  return load;
}

// Where the section of the plate says what the force is: its axes, or its thickness. Axes that have no third moment do
// not count what stands there.
solver::PlateForce plate_force_on(int cell, const FramedForce& force) {
  solver::PlateForce load;
  load.cell = cell;
  load.in_own_axes = force.frame == ForceFrame::own;
  load.level = force.level;
  for (std::size_t place = 0; place < (load.in_own_axes ? 5 : 6); ++place)
    set(load.force[place], load.functions[place], amount_at(force, place));
  return load;
}

void add_in_global_axes(int cell, const FramedForce& force, const LoadedModel& target, solver::Load& load) {
  solver::DistributedForce along;
  solver::PlateMoment about;
  along.cell = about.cell = cell;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    set(along.force[axis], along.functions[axis], amount_at(force, axis));
    set(about.moment[axis], about.functions[axis], amount_at(force, axis + 3));
  }
  if (has_any(force, {0, 1, 2})) load.distributed_forces.push_back(std::move(along));
  if (has_any(force, {3, 4, 5}))
    std::ranges::move(solver::plate_moment_forces(target.mesh, about), std::back_inserter(load.nodal_forces));
}

void add_to_plate(int cell, const FramedForce& force, const LoadedModel& target, solver::Load& load) {
  const bool acts_across_alone = force.frame == ForceFrame::own && !has_any(force, {0, 1, 3, 4});
  if (force.frame == ForceFrame::pressure || acts_across_alone) {
    load.pressures.push_back(pressure_on(cell, force));
  } else if (force.frame == ForceFrame::own || force.level != PlateLevel::mesh) {
    load.plate_forces.push_back(plate_force_on(cell, force));
  } else {
    add_in_global_axes(cell, force, target, load);
  }
}

}  // namespace

bool FramedForce::is_mixed() const {
  return std::ranges::any_of(amounts, [&](const auto& given) { return given && given->frame != frame; });
}

std::map<int, FramedForce> framed_forces(const Keywords& call, const std::string& name, const LoadedModel& target) {
  const FramedKeyword& keyword = framed_keyword(name);
  std::map<int, FramedForce> forces;
  for (const Keywords& occurrence : call.factors(name)) {
    const ForceFrame frame = frame_of(keyword, occurrence);
    const Amounts<6> amounts = amounts_of(keyword, occurrence, frame);
    const auto can_bear = [&](int cell) { return keyword.can_bear(target, cell); };
    for (const int cell : loadable_cells(occurrence, target, name, keyword.what, can_bear)) {
      FramedForce& force = forces[cell];
      if (frame != ForceFrame::global) force.frame = frame;
      force.level = level_of(occurrence);
      for (std::size_t place = 0; place < amounts.size(); ++place)
        if (amounts[place]) force.amounts[place] = FramedAmount{*amounts[place], frame};
    }
  }
  return forces;
}

std::string place_of_force(const std::string& name, const std::string& component) {
  if (name != of_beams.name && name != of_plates.name) return component;
  if (component == "PRES") return in_global_axes[across];
  const Names& own = framed_keyword(name).in_own_axes;
  const auto found = std::ranges::find(own, component);
  return found == own.end() ? component : in_global_axes[static_cast<std::size_t>(found - own.begin())];
}

void add_plate_forces(const Keywords& call, const LoadedModel& target, solver::Load& load) {
  for (const auto& [cell, force] : framed_forces(call, of_plates.name, target)) add_to_plate(cell, force, target, load);
}

void add_beam_forces(const Keywords& call, const LoadedModel& target, solver::Load& load) {
  for (const auto& [cell, force] : framed_forces(call, of_beams.name, target)) {
    solver::BeamForce added;
    added.cell = cell;
    added.axes = force.frame == ForceFrame::own ? solver::BeamAxes::own : solver::BeamAxes::global;
    for (std::size_t place = 0; place < 6; ++place)
      set(added.force[place], added.functions[place], amount_at(force, place));
    load.beam_forces.push_back(std::move(added));
  }
}

}  // namespace comma::commands
