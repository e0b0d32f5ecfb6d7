// Forces of AFFE_CHAR_MECA: on nodes, skins, volumes and beams, weight, rotation, initial strains.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "commands/analysis/same_mesh.hpp"
#include "commands/concepts.hpp"
#include "commands/functions/functions.hpp"
#include "commands/loads/load_building.hpp"
#include "commands/points.hpp"
#include "commands/selection.hpp"
#include "interpreter/diagnostic.hpp"
#include "solver/elements/slender_forces.hpp"
#include "solver/error.hpp"
#include "solver/fields/discretisation.hpp"
#include "solver/fields/field_algebra.hpp"
#include "solver/loads/end_effect.hpp"
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
    if (*names[i] != '\0' && keywords.given(names[i])) amounts[i] = amount_of(keywords, names[i]);
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
void override_given(const Amounts<N>& amounts, std::array<double, N>& values,
                    std::array<solver::FieldFunction, N>& functions) {
  for (std::size_t i = 0; i < N; ++i) {
    if (!amounts[i]) continue;
    values[i] = amounts[i]->value;
    functions[i] = amounts[i]->function;
  }
}

/// The cells named that a load can act on. Throws DiagnosticError `no-element` when there is none.
template <class Predicate>
std::vector<int> loadable_cells(const Keywords& keywords, const LoadedModel& target, const std::string& name,
                                const std::string& what, Predicate can_bear) {
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

void add_distributed_forces(const Keywords& call, const LoadedModel& target, solver::Load& load) {
  for (const DistributedKeyword& keyword : distributed_keywords) {
    ByCell<solver::DistributedForce> forces;
    ByCell<solver::PlateMoment> moments;
    for (const Keywords& occurrence : call.factors(keyword.name)) {
      const auto amounts = given_amounts<3>(occurrence, {"FX", "FY", "FZ"});
      const auto can_bear = [&](int cell) { return bears(target, keyword, cell); };
      for (const int cell : loadable_cells(occurrence, target, keyword.name, keyword.what, can_bear)) {
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

using NodeForces = std::map<std::pair<int, solver::Component>, Amount>;

// ANGL_NAUT by numbers or, in AFFE_CHAR_MECA_F, by functions.
std::vector<Amount> angles_of(const Keywords& force) {
  std::vector<Amount> angles;
  const interpreter::Value& given = force.at("ANGL_NAUT").value;
  if (given.is_sequence() && !given.items().empty() && given.items().front().is_concept())
    for (const auto& handle : force.concepts("ANGL_NAUT"))
      angles.push_back({0.0, field_function(handle, force.span_of("ANGL_NAUT"))});
  else
    for (const double angle : force.reals("ANGL_NAUT")) angles.push_back({angle, {}});
  return angles;
}

Eigen::Matrix3d axes_at(const std::vector<Amount>& angles, const solver::Point& place, double time) {
  std::vector<double> degrees;
  for (const Amount& angle : angles) degrees.push_back(angle.at(place, time));
  return axes_of_angles(degrees);
}

// A component of a force that is given in axes that turn from place to place.
Amount component_of_turning(const std::array<Amount, 3>& given, const std::vector<Amount>& angles,
                            Eigen::Index component) {
  if (std::ranges::none_of(angles, [](const Amount& angle) { return static_cast<bool>(angle.function); }))
    return component_of_turned(given, axes_at(angles, {}, 0.0).col(component));
  return {0.0, [given, angles, component](const solver::Point& at, double time) {
            return component_of_turned(given, axes_at(angles, at, time).col(component)).at(at, time);
          }};
}

/// Cosines of angles are known to this.
constexpr double rounding_of_axes = 1e-12;

constexpr const char* lacking = "the elements of the model around them have no such component";

std::string lost_force(double value, solver::Component component) {
  return fmt::format(
      "FORCE_NODALE: turned by ANGL_NAUT the force has {:.3g} along {}, which none of these nodes carries", value,
      solver::name_of(component));
}

bool is_lost(double value, double largest) { return std::abs(value) > rounding_of_axes * largest; }

using LostAmounts = std::vector<std::pair<solver::Component, Amount>>;

// What functions make of the components that no node carries is known where they are evaluated.
Amount unless_lost(const Amount& amount, const std::array<Amount, 3>& given, const LostAmounts& others) {
  return {0.0, [=](const solver::Point& at, double time) {
            double largest = 0.0;
            for (const Amount& each : given) largest = std::max(largest, std::abs(each.at(at, time)));
            for (const auto& [component, other] : others)
              if (const double value = other.at(at, time); is_lost(value, largest))
                throw solver::Error("unknown-component", lost_force(value, component), lacking);
            return amount.at(at, time);
          }};
}

// Of forces or moments in turned axes.
void add_turned(const Keywords& force, const std::array<Amount, 3>& given, std::size_t first,
                const std::vector<int>& nodes, const LoadedModel& target, NodeForces& forces) {
  const std::vector<Amount> angles = angles_of(force);
  const double largest = std::max({std::abs(given[0].value), std::abs(given[1].value), std::abs(given[2].value)});
  std::vector<std::pair<solver::Component, Amount>> carried;
  LostAmounts lost;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto component = force_keywords[first + i].component;
    const Amount amount = component_of_turning(given, angles, static_cast<Eigen::Index>(i));
    const bool carries = std::ranges::any_of(nodes, [&](int node) { return target.dofs.dof(node, component) >= 0; });
    if (!carries && is_lost(amount.value, largest))
      throw DiagnosticError("unknown-component", lost_force(amount.value, component), force.span, lacking);
    if (carries || amount.function) (carries ? carried : lost).emplace_back(component, amount);
  }
  if (carried.empty() && !lost.empty())
    throw DiagnosticError("unknown-component",
                          fmt::format("FORCE_NODALE: none of these nodes carries {}", solver::name_of(lost[0].first)),
                          force.span, lacking);
  for (const auto& [component, amount] : carried)
    for (const int node : nodes)
      if (target.dofs.dof(node, component) >= 0)
        forces[{node, component}] = lost.empty() ? amount : unless_lost(amount, given, lost);
}

void add_turned_forces(const Keywords& force, const std::vector<int>& nodes, const LoadedModel& target,
                       NodeForces& forces) {
  for (const std::size_t first : {std::size_t{0}, std::size_t{3}}) {
    std::array<Amount, 3> given;
    bool any = false;
    for (std::size_t i = 0; i < 3; ++i) {
      given[i] = amount_of(force, force_keywords[first + i].keyword);
      any |= force.given(force_keywords[first + i].keyword);
    }
    if (any) add_turned(force, given, first, nodes, target, forces);
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
  for (const auto& [place, amount] : forces)
    load.nodal_forces.push_back({place.first, place.second, amount.value, amount.function});
}

// VECT_ASSE: a vector of forces that a field on nodes holds.
void add_force_vector(const Keywords& call, const LoadedModel& target, solver::Load& load) {
  if (!call.has("VECT_ASSE")) return;
  const auto* field = std::get_if<solver::NodalField>(&call.data<FieldConcept>("VECT_ASSE").field);
  if (field == nullptr) {
    throw DiagnosticError("wrong-concept-type", "VECT_ASSE wants a field on nodes", call.span_of("VECT_ASSE"));
  }
  require_mesh(call, "VECT_ASSE", call.data<FieldConcept>("VECT_ASSE").mesh.get(), target.mesh);
  for (std::size_t c = 0; c < field->components.size(); ++c) {
    const auto component = component_named(call, "VECT_ASSE", field->components[c]);
    for (int node = 0; node < target.mesh.node_count(); ++node) {
      const double value = field->at(node, static_cast<int>(c));
      if (std::isnan(value) || value == 0.0) continue;
      if (target.dofs.dof(node, component) < 0) {
        throw DiagnosticError("unknown-component",
                              fmt::format("VECT_ASSE: {} does not carry {} in the model", target.mesh.node_name(node),
                                          field->components[c]),
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

// The cells of each occurrence: of several that name a cell the last counts (U1.03.00, rule of overloading).
std::vector<std::vector<int>> own_cells(const std::vector<Keywords>& occurrences, const solver::Mesh& mesh) {
  std::vector<std::vector<int>> cells(occurrences.size());
  std::vector<char> taken(static_cast<std::size_t>(mesh.cell_count()), 0);
  for (std::size_t k = occurrences.size(); k-- > 0;)
    for (const int cell : cells_or_all(occurrences[k], mesh))
      if (std::exchange(taken[static_cast<std::size_t>(cell)], 1) == 0) cells[k].push_back(cell);
  return cells;
}

void add_inertia_loads(const Keywords& call, const LoadedModel& target, solver::Load& load) {
  const auto& weights = call.factors("PESANTEUR");
  const auto weighed = own_cells(weights, target.mesh);
  for (std::size_t k = 0; k < weights.size(); ++k) {
    const Keywords& weight = weights[k];
    auto acceleration = point_of(weight, "DIRECTION");
    const double length = std::hypot(acceleration[0], acceleration[1], acceleration[2]);
    if (length == 0.0)
      throw DiagnosticError("zero-vector", "PESANTEUR/DIRECTION has no length", weight.span_of("DIRECTION"));
    for (double& component : acceleration) component *= weight.real("GRAVITE") / length;
    load.gravities.push_back({weighed[k], acceleration});
  }
  const auto& rotations = call.factors("ROTATION");
  const auto turned = own_cells(rotations, target.mesh);
  for (std::size_t k = 0; k < rotations.size(); ++k) {
    const Keywords& rotation = rotations[k];
    load.rotations.push_back(
        {turned[k], rotation.real("VITESSE"), point_of(rotation, "AXE"), point_of(rotation, "CENTRE")});
  }
}

// A field at the integration points of the model, of the chosen cells where some are named.
std::shared_ptr<const solver::ElementField> field_at_points(const Keywords& occurrence, const char* keyword,
                                                            const LoadedModel& target) {
  const auto& given = occurrence.data<FieldConcept>(keyword);
  if (given.mesh.get() != &target.mesh)
    throw DiagnosticError("incompatible-field",
                          std::string(keyword) + ": the field lies on another mesh than the model",
                          occurrence.span_of(keyword));
  auto field = std::make_shared<solver::ElementField>(
      solver::brought_to(target.model, given.field, solver::Support::gauss_point, false));
  if (!names_a_place(occurrence)) return field;
  std::vector<bool> chosen(target.mesh.cell_types.size(), false);
  for (const int cell : selected_cells(occurrence, target.mesh)) chosen[static_cast<std::size_t>(cell)] = true;
  for (int cell = 0; cell < target.mesh.cell_count(); ++cell) {
    if (chosen[static_cast<std::size_t>(cell)]) continue;
    const std::size_t first = static_cast<std::size_t>(field->starts[cell]) * field->components.size();
    const std::size_t last = static_cast<std::size_t>(field->starts[cell + 1]) * field->components.size();
    std::fill(field->values.begin() + static_cast<std::ptrdiff_t>(first),
              field->values.begin() + static_cast<std::ptrdiff_t>(last), solver::absent);
  }
  return field;
}

// The initial strains of an occurrence, by the kind of cell that has such ones.
struct InitialStrains {
  ByCell<solver::InitialStrain> continuum;
  ByCell<solver::InitialSlenderStrain> slender;
  ByCell<solver::InitialPlateStrain> plates;
};

template <std::size_t N, class Strain>
void take_strain(const Amounts<N>& amounts, int cell, ByCell<Strain>& strains) {
  if (std::ranges::none_of(amounts, [](const auto& amount) { return amount.has_value(); })) return;
  strains[cell].cell = cell;
  override_given(amounts, strains[cell].strain, strains[cell].functions);
}

void take_strains(const Keywords& occurrence, const LoadedModel& target, InitialStrains& strains) {
  bool solids = false, plates = false, beams = false, bars = false;
  const auto amounts = given_amounts<6>(occurrence, {"EPXX", "EPYY", "EPZZ", "EPXY", "EPXZ", "EPYZ"});
  const auto slender = given_amounts<3>(occurrence, {"EPX", "KY", "KZ"});
  const auto plate = given_amounts<6>(occurrence, {"EXX", "EYY", "EXY", "KXX", "KYY", "KXY"});
  for (const int cell : selected_cells(occurrence, target.mesh)) {
    const auto formulation = target.model.formulations[cell];
    const bool is_solid = solver::continuum_dimension(formulation) > 0 && !target.model.is_skin(cell);
    solids |= is_solid;
    plates |= is_plate(target, cell);
    beams |= solver::is_beam(formulation);
    bars |= solver::is_bar(formulation);
    if (is_plate(target, cell)) take_strain(plate, cell, strains.plates);
    if (is_solid) take_strain(amounts, cell, strains.continuum);
    if (solver::is_beam(formulation) || solver::is_bar(formulation)) take_strain(slender, cell, strains.slender);
    // A bar has its elongation under the name that solids have (U4.44.01, PRE_EPSI).
    if (amounts[0] && solver::is_bar(formulation))
      take_strain<3>({amounts[0], std::nullopt, std::nullopt}, cell, strains.slender);
  }
  const auto require = [&](bool can_have, std::initializer_list<const char*> names) {
    for (const char* name : names)
      if (!can_have && occurrence.given(name))
        throw DiagnosticError(
            "no-element", fmt::format("PRE_EPSI: none of these cells can have the strain {}", name),
            occurrence.at(name).name_span,
            "EPXX ... are for solids and plane bodies, EPXX for bars, EPX, KY, KZ for beams, EXX ... KXY for plates");
  };
  require(solids || bars, {"EPXX"});
  require(solids, {"EPYY", "EPZZ", "EPXY", "EPXZ", "EPYZ"});
  require(beams || bars, {"EPX"});
  require(beams, {"KY", "KZ"});
  require(plates, {"EXX", "EYY", "EXY", "KXX", "KYY", "KXY"});
}

/// The components of a field of initial strains that a cell has.
std::span<const std::string_view> strains_of(const LoadedModel& target, int cell) {
  static constexpr std::array<std::string_view, 6> of_continua = {"EPXX", "EPYY", "EPZZ", "EPXY", "EPXZ", "EPYZ"},
                                                   of_plates = {"EXX", "EYY", "EXY", "KXX", "KYY", "KXY"};
  static constexpr std::array<std::string_view, 3> of_beams = {"EPXX", "KY", "KZ"};
  const auto formulation = target.model.formulations[cell];
  if (is_plate(target, cell)) return of_plates;
  if (solver::is_bar(formulation)) return std::span(of_beams).first(1);
  if (solver::is_beam(formulation)) return of_beams;
  if (solver::continuum_dimension(formulation) > 0 && !target.model.is_skin(cell)) return of_continua;
  return {};
}

bool is_stressed(const solver::ElementField& field, int cell) {
  const std::size_t width = field.components.size();
  const auto begin = field.values.begin() + static_cast<std::ptrdiff_t>(field.starts[cell] * width);
  const auto end = field.values.begin() + static_cast<std::ptrdiff_t>(field.starts[cell + 1] * width);
  return std::any_of(begin, end, [](double value) { return std::abs(value) > 0.0; });
}

bool has_strain(const LoadedModel& target, int cell, const std::string& component) {
  return std::ranges::count(strains_of(target, cell), component) > 0;
}

// Solids have those of their stabilisation and of the pressure beside SIXX ..., which do not push.
bool has_stress(const LoadedModel& target, int cell, const std::string& component) {
  const auto formulation = target.model.formulations[cell];
  if (solver::is_bar(formulation)) return component == "N";
  return solver::continuum_dimension(formulation) > 0 && !target.model.is_skin(cell) && component.starts_with('S');
}

/// Fields that loads take.
struct FieldKeyword {
  const char* factor;
  const char* keyword;
  const char* noun;
  bool (*has)(const LoadedModel& target, int cell, const std::string& component);
  const char* hint;
};
constexpr FieldKeyword initial_strain_field = {
    "PRE_EPSI", "EPSI", "strain", has_strain,
    "EPXX ... are for solids and plane bodies, EPXX for bars and beams, KY and KZ for beams, EXX ... KXY for plates"};
constexpr FieldKeyword initial_stress_field = {
    "PRE_SIGM", "SIGM", "stress", has_stress,
    "SIXX ... are for solids and plane bodies, N for bars; beams and plates have none"};

// A component that none of the cells has would be left out.
void require_taken(const Keywords& occurrence, const FieldKeyword& kind, const solver::ElementField& field,
                   const LoadedModel& target) {
  for (std::size_t c = 0; c < field.components.size(); ++c) {
    bool is_given = false, is_taken = false;
    for (int cell = 0; cell < target.mesh.cell_count() && !is_taken; ++cell) {
      for (int point = 0; point < field.points(cell); ++point) {
        if (!(std::abs(field.at(cell, point, static_cast<int>(c))) > 0.0)) continue;
        is_given = true;
        is_taken = kind.has(target, cell, field.components[c]);
        break;
      }
    }
    if (!is_given || is_taken) continue;
    throw DiagnosticError("no-element",
                          fmt::format("{}: none of these cells can have the {} {} of the field", kind.factor, kind.noun,
                                      field.components[c]),
                          occurrence.span_of(kind.keyword), kind.hint);
  }
}

void add_initial_stresses(const Keywords& call, const LoadedModel& target, solver::Load& load) {
  for (const Keywords& occurrence : call.factors("PRE_SIGM")) {
    auto field = field_at_points(occurrence, "SIGM", target);
    require_taken(occurrence, initial_stress_field, *field, target);
    for (int cell = 0; cell < target.mesh.cell_count(); ++cell)
      if (is_plate(target, cell) && is_stressed(*field, cell))
        throw DiagnosticError("unsupported",
                              fmt::format("PRE_SIGM: the field has stresses on plate {}, where comma knows none as a "
                                          "load",
                                          target.mesh.cell_name(cell)),
                              occurrence.span_of("SIGM"),
                              "make a field of the solids, plane bodies and bars alone (CREA_CHAMP, GROUP_MA)");
    load.initial_stress_fields.push_back(std::move(field));
  }
}

void add_initial_strains(const Keywords& call, const LoadedModel& target, solver::Load& load) {
  InitialStrains strains;
  for (const Keywords& occurrence : call.factors("PRE_EPSI")) {
    if (!occurrence.given("EPSI")) {
      take_strains(occurrence, target, strains);
      continue;
    }
    load.initial_strain_fields.push_back(field_at_points(occurrence, "EPSI", target));
    require_taken(occurrence, initial_strain_field, *load.initial_strain_fields.back(), target);
  }
  append(load.initial_strains, std::move(strains.continuum));
  append(load.initial_slender_strains, std::move(strains.slender));
  append(load.initial_plate_strains, std::move(strains.plates));
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
