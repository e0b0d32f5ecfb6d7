#include "solver/materials/command_variables.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "solver/error.hpp"
#include "solver/functions/time_bracket.hpp"

namespace comma::solver {

namespace {

std::size_t width_of(const Field& field) {
  return std::visit([](const auto& f) { return f.components.size(); }, field);
}

[[noreturn]] void throw_incompatible(Parameter variable, std::string_view why) {
  throw Error("incompatible-field", fmt::format("the field of the command variable {} {}", name_of(variable), why));
}

void check(const Mesh& mesh, const CommandVariable& variable) {
  if (static_cast<int>(variable.variable) >= command_variable_count) {
    throw Error("incompatible-field", fmt::format("{} is no command variable", name_of(variable.variable)));
  }
  if (variable.snapshots.empty()) throw_incompatible(variable.variable, "has no instant at all");
  for (const VariableSnapshot& snapshot : variable.snapshots) {
    const std::size_t width = snapshot.field ? width_of(*snapshot.field) : 0;
    if (width == 0) throw_incompatible(variable.variable, "has no values");
    const auto* nodal = std::get_if<NodalField>(snapshot.field.get());
    const bool fits = nodal != nullptr
                          ? nodal->values.size() == mesh.nodes.size() * width
                          : std::get<ElementField>(*snapshot.field).starts.size() == mesh.cell_types.size() + 1;
    if (!fits) throw_incompatible(variable.variable, "is given on another mesh");
  }
}

/// (1 - share) a + share b.
Field blend(const Field& a, const Field& b, double share, Parameter variable) {
  if (a.index() != b.index() || values_of(a).size() != values_of(b).size()) {
    throw_incompatible(variable, "changes its place (nodes, elements, points) from one instant to the next");
  }
  Field result = a;
  std::vector<double>& values = values_of(result);
  const std::vector<double>& other = values_of(b);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] += share * (other[i] - values[i]);
  return result;
}

Field at_time(const CommandVariable& variable, double time) {
  std::vector<double> instants;
  for (const VariableSnapshot& snapshot : variable.snapshots) instants.push_back(snapshot.instant);
  const auto [first, share] = time_bracket(instants, time, variable.left, variable.right,
                                           fmt::format("the command variable {}", name_of(variable.variable)));
  const Field& before = *variable.snapshots[first].field;
  return share == 0.0 ? before : blend(before, *variable.snapshots[first + 1].field, share, variable.variable);
}

/// From the first value, so that one that is the same everywhere stays it to the last bit: strains are made from
/// differences to a reference.
double interpolate(std::span<const double> shape, auto&& value_at) {
  const double first = value_at(0);
  double sum = 0.0;
  for (std::size_t a = 1; a < shape.size(); ++a) sum += shape[a] * (value_at(a) - first);
  return first + sum;
}

}  // namespace

VariableState::VariableState(const Mesh& mesh, std::span<const CommandVariable> variables, double time) : time_(time) {
  for (const CommandVariable& variable : variables) {
    check(mesh, variable);
    gives_strains_ =
        gives_strains_ || std::ranges::find(strain_parameters, variable.variable) != strain_parameters.end();
    const int index = static_cast<int>(entries_.size());
    entries_.push_back(
        {variable.variable, variable.reference, at_time(variable, variable.instant ? variable.instant(time) : time)});
    std::vector<int>& entry_of_cell = entry_of_cell_[static_cast<std::size_t>(variable.variable)];
    entry_of_cell.resize(mesh.cell_types.size(), -1);
    if (variable.cells.empty()) std::fill(entry_of_cell.begin(), entry_of_cell.end(), index);
    for (const int cell : variable.cells) entry_of_cell[cell] = index;
  }
}

void VariableState::sample(int cell, std::span<const int> nodes, std::span<const double> shape, int point,
                           MaterialPoint& out) const {
  out[Parameter::time] = time_;
  for (const std::vector<int>& entry_of_cell : entry_of_cell_) {
    if (entry_of_cell.empty() || entry_of_cell[cell] < 0) continue;
    const Entry& entry = entries_[entry_of_cell[cell]];
    out[entry.variable] = value(entry, cell, nodes, shape, point);
    out.reference(entry.variable) = entry.reference;
  }
}

double VariableState::value(const Entry& entry, int cell, std::span<const int> nodes, std::span<const double> shape,
                            int point) const {
  if (const auto* nodal = std::get_if<NodalField>(&entry.field)) {
    return interpolate(shape, [&](std::size_t a) { return nodal->at(nodes[a], 0); });
  }
  const auto& field = std::get<ElementField>(entry.field);
  const int points = field.points(cell);
  if (points == 0) return absent;
  switch (field.support) {
    case Support::cell:
      return field.at(cell, 0, 0);
    case Support::element_node:
      if (points != static_cast<int>(nodes.size()))
        throw_incompatible(entry.variable, "has not one value for each node of an element");
      return interpolate(shape, [&](std::size_t a) { return field.at(cell, static_cast<int>(a), 0); });
    case Support::gauss_point:
      if (point == all_points) {
        const std::vector<double> even(static_cast<std::size_t>(points), 1.0 / points);
        return interpolate(even, [&](std::size_t g) { return field.at(cell, static_cast<int>(g), 0); });
      }
      if (point >= points) throw_incompatible(entry.variable, "has other Gauss points than the elements of the model");
      return field.at(cell, point, 0);
  }
  return absent;
}

}  // namespace comma::solver
