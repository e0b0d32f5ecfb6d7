#include "solver/nonlinear/iterations/known_displacements.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "solver/error.hpp"

namespace comma::solver {

void take_displacements(const NodalField& field, const DofMap& dofs, Eigen::VectorXd& u) {
  for (int dof = 0; dof < dofs.size(); ++dof) {
    const int column = field.component(name_of(dofs.component_of(dof)));
    if (column < 0) continue;
    const double value = field.at(dofs.node_of(dof), column);
    if (!std::isnan(value)) u[dof] = value;
  }
}

Eigen::VectorXd displacements_at(double time, const Result& result, const DofMap& dofs, const Eigen::VectorXd& rest) {
  std::vector<std::pair<double, const NodalField*>> known;
  for (const ResultStep& step : result.steps)
    if (const auto found = step.fields.find("DEPL"); found != step.fields.end())
      known.emplace_back(step.instant, &std::get<NodalField>(found->second));
  if (known.empty()) throw Error("missing-field", "the result that steps should start from has no displacement (DEPL)");
  const auto next = std::ranges::find_if(known, [&](const auto& each) { return each.first >= time; });
  const auto& to = next == known.end() ? known.back() : *next;
  const auto& from = next == known.begin() || next == known.end() ? to : *(next - 1);
  Eigen::VectorXd u = rest;
  take_displacements(*to.second, dofs, u);
  if (from.first == to.first) return u;
  Eigen::VectorXd before = rest;
  take_displacements(*from.second, dofs, before);
  const double share = (time - from.first) / (to.first - from.first);
  return (1.0 - share) * before + share * u;
}

}  // namespace comma::solver
