#include "commands/load_building.hpp"

#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <utility>

#include "commands/functions.hpp"
#include "commands/selection.hpp"
#include "interpreter/diagnostic.hpp"

namespace comma::commands {

using interpreter::DiagnosticError;
using interpreter::Keywords;
using solver::Component;

namespace {

// What a keyword gives: a number, or the function that AFFE_CHAR_..._F takes in its place.
struct Amount {
  double value = 0.0;
  solver::FieldFunction function;
};

struct NamedComponent {
  const char* keyword;
  Component component;
};

constexpr std::array<NamedComponent, 6> displacement_keywords = {{{"DX", Component::dx},
                                                                   {"DY", Component::dy},
                                                                   {"DZ", Component::dz},
                                                                   {"DRX", Component::drx},
                                                                   {"DRY", Component::dry},
                                                                   {"DRZ", Component::drz}}};
constexpr std::array<NamedComponent, 6> force_keywords = {{{"FX", Component::dx},
                                                            {"FY", Component::dy},
                                                            {"FZ", Component::dz},
                                                            {"MX", Component::drx},
                                                            {"MY", Component::dry},
                                                            {"MZ", Component::drz}}};

// The nodes among `nodes` that carry a component. A plane and a beam may share one group: a component that only some of its
// nodes have is meant for those; one that none has is a mistake.
std::vector<int> carriers(const Keywords& keywords, const NamedComponent& named, const std::vector<int>& nodes,
                          const solver::DofMap& dofs) {
  std::vector<int> found;
  for (const int node : nodes) {
    if (dofs.dof(node, named.component) >= 0) found.push_back(node);
  }
  if (found.empty()) {
    throw DiagnosticError("unknown-component",
                          fmt::format("{}: none of these nodes carries {}", named.keyword, solver::name_of(named.component)),
                          keywords.at(named.keyword).name_span, "the elements of the model around them have no such component");
  }
  return found;
}

Amount amount_of(const Keywords& keywords, const std::string& name) {
  if (!keywords.has(name)) return {};
  if (!keywords.at(name).value.is_concept()) return {keywords.real(name), {}};
  return {0.0, field_function(keywords.concept_of(name), keywords.span_of(name))};
}

// Visits (node, component, amount) for each of the component keywords given.
template <class Visit>
void each_component(const Keywords& keywords, const std::array<NamedComponent, 6>& names, const LoadedModel& target, Visit visit) {
  const auto nodes = selected_nodes(keywords, *target.model.mesh);
  for (const NamedComponent& named : names) {
    if (!keywords.given(named.keyword)) continue;
    const Amount amount = amount_of(keywords, named.keyword);
    for (const int node : carriers(keywords, named, nodes, target.dofs)) visit(node, named.component, amount);
  }
}

}  // namespace

solver::Origin origin_of(const Keywords& keywords, const std::string& keyword) {
  if (!keywords.span) return std::make_shared<const std::string>(keyword);
  const auto& file = *keywords.span.file;
  return std::make_shared<const std::string>(fmt::format("{}:{}, {}", std::filesystem::path(file.path()).filename().string(),
                                                         file.position(keywords.span.begin).line, keyword));
}

void add_imposed_displacements(const Keywords& keywords, const std::string& name, const LoadedModel& target, solver::Load& load) {
  const auto origin = origin_of(keywords, name);
  const auto impose = [&](int node, Component component, const Amount& amount) {
    load.relations.push_back({{{node, component, 1.0}}, amount.value, amount.function, origin});
  };
  each_component(keywords, displacement_keywords, target, impose);
  if (!keywords.given("BLOCAGE")) return;
  // BLOCAGE="DEPLACEMENT": every translation that a node has.
  for (const int node : selected_nodes(keywords, *target.model.mesh)) {
    for (const Component component : {Component::dx, Component::dy, Component::dz}) {
      if (target.dofs.dof(node, component) >= 0) impose(node, component, {});
    }
  }
}

void add_nodal_forces(const Keywords& keywords, const LoadedModel& target, solver::Load& load) {
  each_component(keywords, force_keywords, target, [&](int node, Component component, const Amount& amount) {
    load.nodal_forces.push_back({node, component, amount.value, amount.function});
  });
}

void add_pressures(const Keywords& keywords, const LoadedModel& target, solver::Load& load) {
  const Amount pressure = amount_of(keywords, "PRES");
  const Amount shear = amount_of(keywords, "CISA_2D");
  int loaded = 0;
  for (const int cell : selected_cells(keywords, *target.model.mesh)) {
    if (!target.model.is_skin(cell)) continue;
    load.pressures.push_back({cell, pressure.value, shear.value, pressure.function, shear.function});
    ++loaded;
  }
  if (loaded == 0) {
    throw DiagnosticError("no-skin", "PRES_REP: none of these cells is on the skin of the model", keywords.span,
                          "a pressure acts on edges of a plane model or faces of a solid one, and AFFE_MODELE must cover them");
  }
}

}  // namespace comma::commands
