// What acts in bodies: weight, rotation, initial strains and stresses.
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "commands/concepts.hpp"
#include "commands/loads/force_reading.hpp"
#include "commands/points.hpp"
#include "commands/selection.hpp"
#include "interpreter/diagnostic.hpp"
#include "solver/fields/data/field_parts.hpp"
#include "solver/fields/points/discretisation.hpp"

namespace comma::commands {

using interpreter::DiagnosticError;
using interpreter::Keywords;

namespace {

// The cells of each occurrence: of several that name a cell the last counts (U1.03.00, rule of overloading).
std::vector<std::vector<int>> own_cells(const std::vector<Keywords>& occurrences, const solver::Mesh& mesh) {
  std::vector<std::vector<int>> cells(occurrences.size());
  std::vector<char> taken(static_cast<std::size_t>(mesh.cell_count()), 0);
  for (std::size_t k = occurrences.size(); k-- > 0;)
    for (const int cell : cells_or_all(occurrences[k], mesh))
      if (std::exchange(taken[static_cast<std::size_t>(cell)], 1) == 0) cells[k].push_back(cell);
  return cells;
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

  /// A later occurrence says all of the strain of its cells, what it does not name being zero.
  void forget(int cell) {
    continuum.erase(cell);
    slender.erase(cell);
    plates.erase(cell);
  }
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
    strains.forget(cell);
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

}  // namespace

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

void add_initial_stresses(const Keywords& call, const LoadedModel& target, solver::Load& load) {
  for (const Keywords& occurrence : call.factors("PRE_SIGM")) {
    auto field = field_at_points(occurrence, "SIGM", target);
    require_taken(occurrence, initial_stress_field, *field, target);
    for (int cell = 0; cell < target.mesh.cell_count(); ++cell)
      if (is_plate(target, cell) && solver::has_other_than_zero(*field, cell))
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

}  // namespace comma::commands
