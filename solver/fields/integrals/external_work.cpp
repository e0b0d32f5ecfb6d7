#include "solver/fields/integrals/external_work.hpp"

#include <cmath>

#include <fmt/format.h>

#include "solver/error.hpp"
#include "solver/model/component.hpp"

namespace comma::solver {

namespace {

const NodalField& nodal_field(const ResultStep& step, std::string_view name) {
  const auto found = step.fields.find(name);
  if (found != step.fields.end()) return std::get<NodalField>(found->second);
  throw Error("unknown-field", fmt::format("step {} has no field {}, which the work needs", step.order, name),
              fmt::format("compute {} first", name));
}

/// Whether a component is a displacement or a rotation, on which forces do work; pressures and changes of volume are
/// not.
bool is_motion(std::string_view name) {
  const std::optional<Component> component = component_named(name);
  return component && static_cast<int>(*component) < motion_count;
}

/// Displacements and forces of a step, paired by node and component, 0 where either is absent.
struct Pairs {
  std::vector<double> displacements, forces;
};

Pairs pairs_of(const ResultStep& step) {
  const NodalField& displacement = nodal_field(step, "DEPL");
  const NodalField& force = nodal_field(step, "FORC_NODA");
  const std::size_t nodes = displacement.values.size() / displacement.components.size();
  Pairs pairs;
  for (std::size_t c = 0; c < displacement.components.size(); ++c) {
    const int column = is_motion(displacement.components[c]) ? force.component(displacement.components[c]) : -1;
    for (std::size_t node = 0; column >= 0 && node < nodes; ++node) {
      const double u = displacement.at(static_cast<int>(node), static_cast<int>(c));
      const double f = force.at(static_cast<int>(node), column);
      const bool present = !std::isnan(u) && !std::isnan(f);
      pairs.displacements.push_back(present ? u : 0.0);
      pairs.forces.push_back(present ? f : 0.0);
    }
  }
  return pairs;
}

}  // namespace

std::vector<ExternalWork> external_work(const Result& result) {
  std::vector<ExternalWork> works;
  Pairs before;
  for (const ResultStep& step : result.steps) {
    Pairs now = pairs_of(step);
    if (works.empty()) before = now;
    ExternalWork work{0.0, works.empty() ? 0.0 : works.back().real};
    for (std::size_t i = 0; i < now.forces.size(); ++i) {
      work.elastic += 0.5 * now.forces[i] * now.displacements[i];
      work.real += 0.5 * (now.forces[i] + before.forces[i]) * (now.displacements[i] - before.displacements[i]);
    }
    works.push_back(work);
    before = std::move(now);
  }
  return works;
}

}  // namespace comma::solver
