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

}  // namespace

RunningWork::Pairs RunningWork::pairs_of(const NodalField& displacement, const NodalField& force) {
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

RunningWork::RunningWork(const NodalField& displacement, const NodalField& force, double real)
    : before_(pairs_of(displacement, force)), work_{0.0, real} {}

ExternalWork RunningWork::add(const NodalField& displacement, const NodalField& force) {
  Pairs now = pairs_of(displacement, force);
  if (before_.forces.empty()) before_ = now;
  work_.elastic = 0.0;
  for (std::size_t i = 0; i < now.forces.size(); ++i) {
    work_.elastic += 0.5 * now.forces[i] * now.displacements[i];
    work_.real += 0.5 * (now.forces[i] + before_.forces[i]) * (now.displacements[i] - before_.displacements[i]);
  }
  before_ = std::move(now);
  return work_;
}

std::vector<ExternalWork> external_work(const Result& result) {
  std::vector<ExternalWork> works;
  RunningWork work;
  for (const ResultStep& step : result.steps)
    works.push_back(work.add(nodal_field(step, "DEPL"), nodal_field(step, "FORC_NODA")));
  return works;
}

}  // namespace comma::solver
