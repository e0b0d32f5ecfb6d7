// Displacements imposed on nodes: in global axes, along normals, in the axes of a beam, in oblique axes.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>

#include "commands/loads/load_building.hpp"
#include "commands/model/angles.hpp"
#include "commands/selection.hpp"
#include "interpreter/diagnostic.hpp"
#include "solver/constraints/directions.hpp"
#include "solver/elements/slender/section.hpp"

namespace comma::commands {

using interpreter::DiagnosticError;
using interpreter::Keywords;
using solver::Component;
using solver::Motion;

namespace {

constexpr std::array<Component, 3> translations = {Component::dx, Component::dy, Component::dz};
constexpr std::array<Component, 3> rotations = {Component::drx, Component::dry, Component::drz};
constexpr std::array<NamedComponent, 2> mixed_keywords = {
    {{"PRES", Component::pressure}, {"GONF", Component::swelling}}};

void impose(int node, Component component, const Amount& amount, const solver::Origin& origin, solver::Load& load) {
  load.relations.push_back({{{node, component, 1.0}}, amount.value, amount.function, origin});
}

bool any_carries(const std::vector<int>& nodes, Component component, const LoadedModel& target) {
  return std::ranges::any_of(nodes, [&](int node) { return target.dofs.dof(node, component) >= 0; });
}

void impose_component(const Keywords& keywords, const NamedComponent& named, const std::vector<int>& nodes,
                      const LoadedModel& target, const solver::Origin& origin, solver::Load& load,
                      interpreter::Diagnostics* alarms) {
  if (!keywords.given(named.keyword)) return;
  const Amount amount = amount_of(keywords, named.keyword);
  const bool holds = !amount.function && amount.value == 0.0;
  if (alarms != nullptr && holds && !any_carries(nodes, named.component, target)) {
    alarms->alarm(
        "unknown-component",
        fmt::format("{}: none of these nodes carries {}: there is nothing to hold", named.keyword, named.keyword),
        keywords.at(named.keyword).name_span);
    return;
  }
  for (const int node : carriers(keywords, named, nodes, target.dofs))
    impose(node, named.component, amount, origin, load);
}

void impose_components(const Keywords& keywords, const std::vector<int>& nodes, const LoadedModel& target,
                       const solver::Origin& origin, solver::Load& load, interpreter::Diagnostics* alarms = nullptr) {
  for (const NamedComponent& named : displacement_keywords)
    impose_component(keywords, named, nodes, target, origin, load, alarms);
  for (const NamedComponent& named : mixed_keywords)
    impose_component(keywords, named, nodes, target, origin, load, alarms);
}

// Returns whether any of the nodes has one of the components.
bool hold(const std::vector<int>& nodes, std::span<const Component> components, const LoadedModel& target,
          const solver::Origin& origin, solver::Load& load) {
  bool any = false;
  for (const int node : nodes) {
    for (const Component component : components) {
      if (target.dofs.dof(node, component) < 0) continue;
      impose(node, component, {}, origin, load);
      any = true;
    }
  }
  return any;
}

// BLOCAGE holds what a node has of a kind of motion; LIAISON="ENCASTRE" all of it.
void impose_holds(const Keywords& keywords, const std::vector<int>& nodes, const LoadedModel& target,
                  const solver::Origin& origin, solver::Load& load) {
  const auto blocked = keywords.given("BLOCAGE") ? keywords.texts("BLOCAGE") : std::vector<std::string>{};
  const auto holds = [&](const char* word) {
    return keywords.given("LIAISON") || std::ranges::find(blocked, word) != blocked.end();
  };
  bool any = false;
  if (holds("DEPLACEMENT")) any |= hold(nodes, translations, target, origin, load);
  if (holds("ROTATION")) any |= hold(nodes, rotations, target, origin, load);
  if (any || nodes.empty() || blocked.empty()) return;
  throw DiagnosticError(
      "unknown-component", fmt::format("BLOCAGE: none of these nodes has what '{}' holds", fmt::join(blocked, "', '")),
      keywords.at("BLOCAGE").name_span, "the elements of the model around them have no such components");
}

// Imposes the motion that `keyword` names along a direction of each node. Nodes of no element are passed over, unless
// they all are.
template <class Direction>
void impose_along(const Keywords& keywords, const char* keyword, const std::vector<int>& nodes, Motion motion,
                  const solver::Origin& origin, solver::Load& load, const LoadedModel& target, Direction direction) {
  constexpr double rounding_of_direction = 1e-9;
  const Amount amount = amount_of(keywords, keyword);
  bool any = false;
  for (const int node : nodes) {
    auto relation = solver::along(node, motion, direction(node), amount.value, amount.function, origin);
    double missing = 0.0;
    std::erase_if(relation.terms, [&](const auto& term) {
      const bool lacks = target.dofs.dof(term.node, term.component) < 0;
      if (lacks) missing = std::max(missing, std::abs(term.coefficient));
      return lacks;
    });
    if (relation.terms.empty()) continue;
    if (missing > rounding_of_direction) {
      throw DiagnosticError("unknown-component",
                            fmt::format("{}: its direction at {} leads out of what the node can do", keyword,
                                        target.mesh.node_name(node)),
                            keywords.at(keyword).name_span, "give a direction in the plane of a plane model");
    }
    any = true;
    load.relations.push_back(std::move(relation));
  }
  if (any || nodes.empty()) return;
  throw DiagnosticError("unknown-component", fmt::format("{}: none of these nodes moves that way", keyword),
                        keywords.at(keyword).name_span, "the elements of the model around them have no such component");
}

// DX ... DRZ in the axes (rows) that each node has of its own.
template <class Axes>
void impose_in_axes(const Keywords& keywords, const std::vector<int>& nodes, const LoadedModel& target,
                    const solver::Origin& origin, solver::Load& load, Axes axes) {
  for (std::size_t i = 0; i < displacement_keywords.size(); ++i) {
    if (!keywords.given(displacement_keywords[i].keyword)) continue;
    const auto row = static_cast<Eigen::Index>(i % 3);
    impose_along(keywords, displacement_keywords[i].keyword, nodes, i < 3 ? Motion::translation : Motion::rotation,
                 origin, load, target, [&](int node) -> Eigen::Vector3d { return axes(node).row(row).transpose(); });
  }
}

// GROUP_MA_REPE and MAILLE_REPE: the cells among which a node's beam is looked for; empty: all.
std::vector<int> reference_cells(const Keywords& keywords, const solver::Mesh& mesh) {
  return selected_cells(keywords, mesh, {"", "", "", "GROUP_MA_REPE", "MAILLE_REPE"});
}

}  // namespace

void add_imposed_displacements(const Keywords& keywords, const std::string& name, const LoadedModel& target,
                               solver::Load& load, interpreter::Diagnostics* alarms) {
  const auto origin = origin_of(keywords, name);
  const auto nodes = remaining_nodes(keywords, target.mesh);
  impose_components(keywords, nodes, target, origin, load, alarms);
  impose_holds(keywords, nodes, target, origin, load);
}

namespace {

// One condition along the mean normal leaves the other directions free at a node where faces meet at an angle.
void warn_of_edges(const Keywords& keywords, const solver::Mesh& mesh, const std::map<int, Eigen::Vector3d>& means,
                   interpreter::Diagnostics& alarms) {
  constexpr double telling_angle = 10.0;  // degrees
  for (const int cell : selected_cells(keywords, mesh)) {
    const auto own = solver::mean_normals(mesh, std::span(&cell, 1));
    for (const auto& [node, normal] : own) {
      const double turned = std::acos(std::clamp(normal.dot(means.at(node)), -1.0, 1.0)) / degree;
      if (turned <= telling_angle) continue;
      alarms.alarm("faces-meet",
                   fmt::format("FACE_IMPO: at {} the mean normal is {:.0f} degrees off that of face {}: the node is "
                               "held along it alone and moves across it",
                               mesh.node_name(node), turned, mesh.cell_name(cell)),
                   keywords.span, "write one occurrence for each side, or hold the components");
      return;
    }
  }
}

}  // namespace

void add_face_displacements(const Keywords& keywords, const LoadedModel& target, solver::Load& load,
                            interpreter::Diagnostics& alarms) {
  const auto origin = origin_of(keywords, "FACE_IMPO");
  const auto nodes = needed(remaining_nodes(keywords, target.mesh), keywords, "node");
  impose_components(keywords, nodes, target, origin, load);
  impose_holds(keywords, nodes, target, origin, load);
  const bool along_normal = keywords.given("DNOR") || keywords.given("DRNOR") || keywords.given("DTAN");
  if (!along_normal) return;
  const auto normals = solver::mean_normals(target.mesh, selected_cells(keywords, target.mesh));
  const auto normal = [&](int node) { return normals.at(node); };
  warn_of_edges(keywords, target.mesh, normals, alarms);
  if (keywords.given("DNOR")) impose_along(keywords, "DNOR", nodes, Motion::translation, origin, load, target, normal);
  if (keywords.given("DRNOR")) impose_along(keywords, "DRNOR", nodes, Motion::rotation, origin, load, target, normal);
  if (!keywords.given("DTAN")) return;
  const bool is_plane = std::ranges::all_of(normals, [](const auto& entry) { return entry.second.z() == 0.0; });
  if (target.mesh.dimension != 2 || !is_plane) {
    throw DiagnosticError("unsupported", "FACE_IMPO/DTAN: a face in space has two tangents",
                          keywords.at("DTAN").name_span, "impose DX, DY, DZ, or LIAISON_OBLIQUE");
  }
  impose_along(keywords, "DTAN", nodes, Motion::translation, origin, load, target,
               [&](int node) { return solver::plane_tangent(normals.at(node)); });
}

void add_edge_displacements(const Keywords& keywords, const LoadedModel& target, solver::Load& load) {
  const auto origin = origin_of(keywords, "ARETE_IMPO");
  const auto nodes = needed(remaining_nodes(keywords, target.mesh), keywords, "node");
  impose_components(keywords, nodes, target, origin, load);
  if (!keywords.given("DTAN")) return;
  const auto tangents = solver::mean_tangents(target.mesh, selected_cells(keywords, target.mesh));
  impose_along(keywords, "DTAN", nodes, Motion::translation, origin, load, target,
               [&](int node) { return tangents.at(node); });
}

void add_displacements_of_field(const Keywords& keywords, const LoadedModel& target, solver::Load& load) {
  const auto origin = origin_of(keywords, "CHAMNO_IMPO");
  const double factor = keywords.real("COEF_IMPO");
  for (const auto& term : terms_of_field(keywords, target))
    load.relations.push_back({{{term.node, term.component, 1.0}}, factor * term.coefficient, {}, origin});
}

void add_beam_displacements(const Keywords& keywords, const LoadedModel& target, solver::Load& load) {
  const auto candidates = reference_cells(keywords, target.mesh);
  const auto nodes = needed(selected_nodes(keywords, target.mesh), keywords, "node");
  const double roll = keywords.has("ANGL_VRIL") ? keywords.real("ANGL_VRIL") * degree : 0.0;
  const auto axes = [&](int node) {
    const int cell = solver::beam_at_node(target.model, node, candidates);
    if (!keywords.given("VECT_Y")) return solver::own_axes(target.mesh, cell, roll);
    const auto y = keywords.reals("VECT_Y");
    return solver::beam_axes(target.mesh, cell, node, {y[0], y[1], y[2]});
  };
  impose_in_axes(keywords, nodes, target, origin_of(keywords, "DDL_POUTRE"), load, axes);
}

void add_oblique_displacements(const Keywords& keywords, const LoadedModel& target, solver::Load& load) {
  const Eigen::Matrix3d axes = axes_of_angles(keywords.reals("ANGL_NAUT"));
  impose_in_axes(keywords, needed(selected_nodes(keywords, target.mesh), keywords, "node"), target,
                 origin_of(keywords, "LIAISON_OBLIQUE"), load, [&](int) -> const Eigen::Matrix3d& { return axes; });
}

}  // namespace comma::commands
