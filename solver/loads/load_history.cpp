#include "solver/loads/load_history.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "solver/functions/time_bracket.hpp"

namespace comma::solver {

void LoadHistory::add(double instant, Field field, int component) {
  instants_.push_back(instant);
  entries_.push_back({std::move(field), component});
}

/// Absent where the field has no such value.
double LoadHistory::Entry::value(int cell, int local, int node) const {
  if (const auto* nodal = std::get_if<NodalField>(&field)) return nodal->at(node, component);
  const auto& on_cells = std::get<ElementField>(field);
  if (cell < 0) return absent;
  const int point = on_cells.support == Support::cell ? 0 : local;
  return point < on_cells.points(cell) ? on_cells.at(cell, point, component) : absent;
}

bool LoadHistory::covers(int node) const {
  return std::ranges::none_of(entries_, [&](const Entry& entry) { return std::isnan(entry.value(-1, 0, node)); });
}

bool LoadHistory::covers(int cell, std::span<const int> nodes) const {
  return std::ranges::none_of(entries_, [&](const Entry& entry) {
    for (std::size_t a = 0; a < nodes.size(); ++a)
      if (std::isnan(entry.value(cell, static_cast<int>(a), nodes[a]))) return true;
    return false;
  });
}

double LoadHistory::at(int cell, int local, int node, double time) const {
  const auto [first, share] = time_bracket(instants_, time, Extension::excluded, Extension::excluded, "the load that a result holds");
  const double before = entries_[first].value(cell, local, node);
  return share == 0.0 ? before : before + share * (entries_[first + 1].value(cell, local, node) - before);
}

}  // namespace comma::solver
