#include "solver/loads/nodal_history.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "solver/functions/time_bracket.hpp"

namespace comma::solver {

void NodalHistory::add(double instant, NodalField field) {
  instants_.push_back(instant);
  fields_.push_back(std::move(field));
}

bool NodalHistory::covers(int node) const {
  return std::ranges::none_of(fields_, [&](const NodalField& field) { return std::isnan(field.at(node, 0)); });
}

double NodalHistory::at(int node, double time) const {
  const auto [first, share] = time_bracket(instants_, time, Extension::excluded, Extension::excluded, "the load that a result holds");
  const double before = fields_[first].at(node, 0);
  return share == 0.0 ? before : before + share * (fields_[first + 1].at(node, 0) - before);
}

}  // namespace comma::solver
