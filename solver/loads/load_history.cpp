#include "solver/loads/load_history.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
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

Coverage LoadHistory::coverage(int cell, std::span<const int> nodes) const {
  const auto is_covered = [&](const Entry& entry) {
    for (std::size_t a = 0; a < nodes.size(); ++a)
      if (std::isnan(entry.value(cell, static_cast<int>(a), nodes[a]))) return false;
    return true;
  };
  const auto count = std::ranges::count_if(entries_, is_covered);
  if (count == 0) return Coverage::none;
  return count == std::ssize(entries_) ? Coverage::whole : Coverage::partial;
}

double LoadHistory::at(int cell, int local, int node, double time) const {
  const Extension beyond = instants_.size() == 1 ? Extension::constant : Extension::excluded;
  const auto [first, share] = time_bracket(instants_, time, beyond, beyond, "the load that a result holds");
  const double before = entries_[first].value(cell, local, node);
  return share == 0.0 ? before : before + share * (entries_[first + 1].value(cell, local, node) - before);
}

}  // namespace comma::solver
