#include "solver/nonlinear/steps/watched_increment.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "solver/error.hpp"

namespace comma::solver {
namespace {

std::vector<int> all_unless_given(const std::vector<int>& given, int count) {
  if (!given.empty()) return given;
  std::vector<int> all(static_cast<std::size_t>(count));
  std::iota(all.begin(), all.end(), 0);
  return all;
}

double present(double value) { return std::isnan(value) ? 0.0 : value; }

int column_of(int column, const WatchedIncrement& watched) {
  if (column >= 0) return column;
  throw Error("unknown-component",
              fmt::format("{}, whose change is watched, has no {}", watched.field, watched.component),
              "watch a component that it has");
}

}  // namespace

std::vector<double> watched_values(const WatchedIncrement& watched, const ResultStep& step, const Mesh& mesh) {
  const auto found = step.fields.find(watched.field);
  if (found == step.fields.end())
    throw Error("missing-field", fmt::format("{}, whose change is watched, is not computed", watched.field),
                "watch DEPL or SIEF_ELGA");
  std::vector<double> values;
  if (const auto* nodal = std::get_if<NodalField>(&found->second)) {
    const int column = column_of(nodal->component(watched.component), watched);
    for (const int node : all_unless_given(watched.nodes, mesh.node_count()))
      values.push_back(present(nodal->at(node, column)));
    return values;
  }
  const auto& field = std::get<ElementField>(found->second);
  const int column = column_of(field.component(watched.component), watched);
  for (const int cell : all_unless_given(watched.cells, mesh.cell_count()))
    for (int point = 0; point < field.points(cell); ++point) values.push_back(present(field.at(cell, point, column)));
  return values;
}

double largest_change(const std::vector<double>& before, const std::vector<double>& after) {
  double largest = 0.0;
  for (std::size_t i = 0; i < std::min(before.size(), after.size()); ++i)
    largest = std::max(largest, std::abs(after[i] - before[i]));
  return largest;
}

}  // namespace comma::solver
