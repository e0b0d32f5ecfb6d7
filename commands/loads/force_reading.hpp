// What the factor keywords of forces share: amounts by cell, of which a later occurrence overrides those that it gives.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "commands/loads/load_building.hpp"
#include "commands/selection.hpp"

namespace comma::commands {

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
Amounts<N> given_amounts(const interpreter::Keywords& keywords, const std::array<const char*, N>& names) {
  Amounts<N> amounts;
  for (std::size_t i = 0; i < N; ++i) {
    if (*names[i] != '\0' && keywords.given(names[i])) amounts[i] = amount_of(keywords, names[i]);
  }
  return amounts;
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
std::vector<int> loadable_cells(const interpreter::Keywords& keywords, const LoadedModel& target,
                                const std::string& name, const std::string& what, Predicate can_bear) {
  auto cells = selected_cells(keywords, target.mesh);
  std::erase_if(cells, [&](int cell) { return !can_bear(cell); });
  if (cells.empty()) {
    throw interpreter::DiagnosticError("no-element", fmt::format("{}: none of these cells is {}", name, what),
                                       keywords.span, "AFFE_MODELE must cover the cells that a load acts on");
  }
  return cells;
}

/// Of a force that is given in turned axes: the component along a direction, a sum of those given.
Amount component_of_turned(const std::array<Amount, 3>& given, const Eigen::Vector3d& direction);

/// FORCE_COQUE.
void add_plate_forces(const interpreter::Keywords& call, const LoadedModel& target, solver::Load& load);
/// FORCE_POUTRE.
void add_beam_forces(const interpreter::Keywords& call, const LoadedModel& target, solver::Load& load);
/// FORCE_NODALE.
void add_nodal_forces(const interpreter::Keywords& call, const LoadedModel& target, solver::Load& load);
/// VECT_ASSE: a vector of forces that a field on nodes holds.
void add_force_vector(const interpreter::Keywords& call, const LoadedModel& target, solver::Load& load);
/// PESANTEUR and ROTATION.
void add_inertia_loads(const interpreter::Keywords& call, const LoadedModel& target, solver::Load& load);
/// PRE_EPSI and PRE_SIGM.
void add_initial_strains(const interpreter::Keywords& call, const LoadedModel& target, solver::Load& load);
void add_initial_stresses(const interpreter::Keywords& call, const LoadedModel& target, solver::Load& load);

}  // namespace comma::commands
