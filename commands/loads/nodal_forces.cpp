// Forces on nodes: FORCE_NODALE, VECT_ASSE.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "commands/analysis/same_mesh.hpp"
#include "commands/concepts.hpp"
#include "commands/functions/functions.hpp"
#include "commands/loads/force_reading.hpp"
#include "commands/selection.hpp"
#include "interpreter/diagnostic.hpp"
#include "solver/error.hpp"

namespace comma::commands {

using interpreter::DiagnosticError;
using interpreter::Keywords;

Amount component_of_turned(const std::array<Amount, 3>& given, const Eigen::Vector3d& direction) {
  Amount sum;
  bool varies = false;
  for (Eigen::Index i = 0; i < 3; ++i) {
    sum.value += direction[i] * given[static_cast<std::size_t>(i)].value;
    varies |= static_cast<bool>(given[static_cast<std::size_t>(i)].function);
  }
  if (!varies) return sum;
  sum.function = [given, direction](const solver::Point& at, double time) {
    double total = 0.0;
    for (Eigen::Index i = 0; i < 3; ++i) total += direction[i] * given[static_cast<std::size_t>(i)].at(at, time);
    return total;
  };
  return sum;
}

namespace {

using NodeForces = std::map<std::pair<int, solver::Component>, Amount>;

// ANGL_NAUT by numbers or, in AFFE_CHAR_MECA_F, by functions.
std::vector<Amount> angles_of(const Keywords& force) {
  std::vector<Amount> angles;
  const interpreter::Value& given = force.at("ANGL_NAUT").value;
  if (given.is_sequence() && !given.items().empty() && given.items().front().is_concept())
    for (const auto& handle : force.concepts("ANGL_NAUT"))
      angles.push_back({0.0, field_function(handle, force.span_of("ANGL_NAUT"))});
  else
    for (const double angle : force.reals("ANGL_NAUT")) angles.push_back({angle, {}});
  return angles;
}

Eigen::Matrix3d axes_at(const std::vector<Amount>& angles, const solver::Point& place, double time) {
  std::vector<double> degrees;
  for (const Amount& angle : angles) degrees.push_back(angle.at(place, time));
  return axes_of_angles(degrees);
}

// A component of a force that is given in axes that turn from place to place.
Amount component_of_turning(const std::array<Amount, 3>& given, const std::vector<Amount>& angles,
                            Eigen::Index component) {
  if (std::ranges::none_of(angles, [](const Amount& angle) { return static_cast<bool>(angle.function); }))
    return component_of_turned(given, axes_at(angles, {}, 0.0).col(component));
  return {0.0, [given, angles, component](const solver::Point& at, double time) {
            return component_of_turned(given, axes_at(angles, at, time).col(component)).at(at, time);
          }};
}

/// Cosines of angles are known to this.
constexpr double rounding_of_axes = 1e-12;

constexpr const char* lacking = "the elements of the model around them have no such component";

std::string lost_force(double value, solver::Component component) {
  return fmt::format(
      "FORCE_NODALE: turned by ANGL_NAUT the force has {:.3g} along {}, which none of these nodes carries", value,
      solver::name_of(component));
}

bool is_lost(double value, double largest) { return std::abs(value) > rounding_of_axes * largest; }

using LostAmounts = std::vector<std::pair<solver::Component, Amount>>;

// What functions make of the components that no node carries is known where they are evaluated.
Amount unless_lost(const Amount& amount, const std::array<Amount, 3>& given, const LostAmounts& others) {
  return {0.0, [=](const solver::Point& at, double time) {
            double largest = 0.0;
            for (const Amount& each : given) largest = std::max(largest, std::abs(each.at(at, time)));
            for (const auto& [component, other] : others)
              if (const double value = other.at(at, time); is_lost(value, largest))
                throw solver::Error("unknown-component", lost_force(value, component), lacking);
            return amount.at(at, time);
          }};
}

// Of forces or moments in turned axes.
void add_turned(const Keywords& force, const std::array<Amount, 3>& given, std::size_t first,
                const std::vector<int>& nodes, const LoadedModel& target, NodeForces& forces) {
  const std::vector<Amount> angles = angles_of(force);
  const double largest = std::max({std::abs(given[0].value), std::abs(given[1].value), std::abs(given[2].value)});
  std::vector<std::pair<solver::Component, Amount>> carried;
  LostAmounts lost;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto component = force_keywords[first + i].component;
    const Amount amount = component_of_turning(given, angles, static_cast<Eigen::Index>(i));
    const bool carries = std::ranges::any_of(nodes, [&](int node) { return target.dofs.dof(node, component) >= 0; });
    if (!carries && is_lost(amount.value, largest))
      throw DiagnosticError("unknown-component", lost_force(amount.value, component), force.span, lacking);
    if (carries || amount.function) (carries ? carried : lost).emplace_back(component, amount);
  }
  if (carried.empty() && !lost.empty())
    throw DiagnosticError("unknown-component",
                          fmt::format("FORCE_NODALE: none of these nodes carries {}", solver::name_of(lost[0].first)),
                          force.span, lacking);
  for (const auto& [component, amount] : carried)
    for (const int node : nodes)
      if (target.dofs.dof(node, component) >= 0)
        forces[{node, component}] = lost.empty() ? amount : unless_lost(amount, given, lost);
}

void add_turned_forces(const Keywords& force, const std::vector<int>& nodes, const LoadedModel& target,
                       NodeForces& forces) {
  for (const std::size_t first : {std::size_t{0}, std::size_t{3}}) {
    std::array<Amount, 3> given;
    bool any = false;
    for (std::size_t i = 0; i < 3; ++i) {
      given[i] = amount_of(force, force_keywords[first + i].keyword);
      any |= force.given(force_keywords[first + i].keyword);
    }
    if (any) add_turned(force, given, first, nodes, target, forces);
  }
}

}  // namespace

void add_nodal_forces(const Keywords& call, const LoadedModel& target, solver::Load& load) {
  NodeForces forces;
  for (const Keywords& force : call.factors("FORCE_NODALE")) {
    const auto nodes = selected_nodes(force, target.mesh);
    if (force.given("ANGL_NAUT")) {
      add_turned_forces(force, nodes, target, forces);
      continue;
    }
    for (const NamedComponent& named : force_keywords) {
      if (!force.given(named.keyword)) continue;
      const Amount amount = amount_of(force, named.keyword);
      for (const int node : carriers(force, named, nodes, target.dofs)) forces[{node, named.component}] = amount;
    }
  }
  for (const auto& [place, amount] : forces)
    load.nodal_forces.push_back({place.first, place.second, amount.value, amount.function});
}

void add_force_vector(const Keywords& call, const LoadedModel& target, solver::Load& load) {
  if (!call.has("VECT_ASSE")) return;
  const auto* field = std::get_if<solver::NodalField>(&call.data<FieldConcept>("VECT_ASSE").field);
  if (field == nullptr) {
    throw DiagnosticError("wrong-concept-type", "VECT_ASSE wants a field on nodes", call.span_of("VECT_ASSE"));
  }
  require_mesh(call, "VECT_ASSE", call.data<FieldConcept>("VECT_ASSE").mesh.get(), target.mesh);
  for (std::size_t c = 0; c < field->components.size(); ++c) {
    const auto component = component_named(call, "VECT_ASSE", field->components[c]);
    for (int node = 0; node < target.mesh.node_count(); ++node) {
      const double value = field->at(node, static_cast<int>(c));
      if (std::isnan(value) || value == 0.0) continue;
      if (target.dofs.dof(node, component) < 0) {
        throw DiagnosticError("unknown-component",
                              fmt::format("VECT_ASSE: {} does not carry {} in the model", target.mesh.node_name(node),
                                          field->components[c]),
                              call.span_of("VECT_ASSE"));
      }
      load.nodal_forces.push_back({node, component, value, {}});
    }
  }
}

}  // namespace comma::commands
