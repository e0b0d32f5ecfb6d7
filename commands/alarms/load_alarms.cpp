#include "commands/alarms/load_alarms.hpp"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "commands/loads/framed_forces.hpp"
#include "commands/selection.hpp"
#include "solver/mesh/orientation.hpp"
#include "solver/model/component.hpp"

namespace comma::commands {

namespace {

// Where the sign of a load is that of the normals. Faces between two bodies have no outer side.
void warn_of_inward_normals(const Keywords& occurrence, const char* keyword, const LoadedModel& target,
                            Context& context) {
  std::vector<int> skin = selected_cells(occurrence, target.mesh);
  std::erase_if(skin, [&](int cell) { return !target.model.is_skin(cell); });
  const std::vector<int> inward = solver::inward_skin(target.mesh, skin);
  if (inward.empty()) return;
  const std::string groups =
      occurrence.given("GROUP_MA") ? fmt::format(" of {}", fmt::join(occurrence.texts("GROUP_MA"), ", ")) : "";
  context.diagnostics.alarm(
      "inward-surface",
      fmt::format("{}: the normals of {} of the {} cells{} point into the body, that of {} for one: what acts along "
                  "them has the other sign there",
                  keyword, inward.size(), skin.size(), groups, target.mesh.cell_name(inward.front())),
      occurrence.span, "turn them by MODI_MAILLAGE(ORIE_PEAU=_F(GROUP_MA_PEAU=...)) before the model is made");
}

void check_normals(const Call& call, const LoadedModel& target, Context& context) {
  if (call.text("VERI_NORM") == "NON") return;
  for (const Keywords& pressure : call.factors("PRES_REP"))
    warn_of_inward_normals(pressure, "PRES_REP", target, context);
  for (const Keywords& imposed : call.factors("FACE_IMPO")) {
    if (!imposed.given("DNOR")) continue;
    const Amount amount = amount_of(imposed, "DNOR");
    if (amount.value != 0.0 || amount.function) warn_of_inward_normals(imposed, "FACE_IMPO/DNOR", target, context);
  }
}

// A plane body does not move out of its plane.
void warn_of_weight_out_of_plane(const Call& call, const LoadedModel& target, Context& context) {
  if (!call.has("PESANTEUR")) return;
  const int cells = target.mesh.cell_count();
  bool has_plane = false, in_space = false;
  for (int cell = 0; cell < cells; ++cell) {
    has_plane =
        has_plane || solver::continuum_dimension(target.model.formulations[static_cast<std::size_t>(cell)]) == 2;
    in_space = in_space || solver::contains(target.model.components_of(cell), solver::Component::dz);
  }
  if (!has_plane || in_space) return;
  for (const Keywords& weight : call.factors("PESANTEUR")) {
    const auto direction = weight.reals("DIRECTION");
    if (direction.size() < 3 || direction[2] == 0.0) continue;
    context.diagnostics.alarm("lost-force", "PESANTEUR: what acts along Z, out of the plane of the model, is lost",
                              weight.span_of("DIRECTION"),
                              "in a plane model weight acts along X and Y (Y alone with AXIS)");
  }
}

// Faces and edges have no volume.
void warn_of_weightless_cells(const Call& call, const LoadedModel& target, Context& context) {
  for (const char* keyword : {"PESANTEUR", "ROTATION"})
    for (const Keywords& load : call.factors(keyword)) {
      if (!names_a_place(load, cell_places)) continue;
      const std::vector<int> cells = selected_cells(load, target.mesh);
      const auto bears = [&](int cell) {
        return target.model.formulations[static_cast<std::size_t>(cell)] != solver::Formulation::none &&
               !target.model.is_skin(cell);
      };
      if (std::ranges::any_of(cells, bears)) continue;
      context.diagnostics.alarm(
          "lost-force",
          fmt::format("{}: none of the {} cells that it names has a mass: they bound others, or carry no element",
                      keyword, cells.size()),
          load.span, "name the cells of the bodies, or leave out where it acts: the whole model");
    }
}

// Nodes that do not carry a component are passed over, unless they all are.
void warn_of_lost_forces(const Call& call, const LoadedModel& target, Context& context) {
  for (const Keywords& force : call.factors("FORCE_NODALE")) {
    const std::vector<int> nodes = selected_nodes(force, target.mesh);
    const auto is_loose = [&](int node) {
      return std::ranges::none_of(displacement_keywords, [&](const NamedComponent& named) {
        return target.dofs.dof(node, named.component) >= 0;
      });
    };
    if (const auto lost = std::ranges::count_if(nodes, is_loose); lost > 0) {
      context.diagnostics.alarm(
          "lost-force",
          fmt::format("FORCE_NODALE: {} of the {} nodes belong to no element of the model, {} the first: what acts on "
                      "them is lost",
                      lost, nodes.size(), target.mesh.node_name(*std::ranges::find_if(nodes, is_loose))),
          force.span, "leave them out of the group, or put them into the cells that bear the force");
    }
    for (const NamedComponent& named : force_keywords) {
      if (!force.given(named.keyword)) continue;
      const auto lacks = [&](int node) { return !is_loose(node) && target.dofs.dof(node, named.component) < 0; };
      const auto lost = std::ranges::count_if(nodes, lacks);
      if (lost == 0) continue;
      context.diagnostics.alarm(
          "lost-force",
          fmt::format("FORCE_NODALE: {} of the {} nodes have no {}, {} the first: {} is lost there", lost, nodes.size(),
                      solver::name_of(named.component), target.mesh.node_name(*std::ranges::find_if(nodes, lacks)),
                      named.keyword),
          force.at(named.keyword).name_span, "name the nodes that have it by a group of their own");
    }
  }
}

bool is_same_amount(const interpreter::Keyword& one, const interpreter::Keyword& other) {
  if (one.value.is_concept() || other.value.is_concept())
    return one.value.is_concept() && other.value.is_concept() && one.value.as_concept() == other.value.as_concept();
  return one.value.as_real() == other.value.as_real();
}

enum class Overloading : std::uint8_t { by_component, whole };

struct ForceKeyword {
  const char* name;
  bool (*bears)(const LoadedModel& target, int cell);  ///< none: acts on nodes
  Overloading overloading = Overloading::by_component;
};

bool is_loaded(const LoadedModel& target, int cell) {
  return target.model.formulations[static_cast<std::size_t>(cell)] != solver::Formulation::none;
}

bool is_loaded_skin(const LoadedModel& target, int cell) { return target.model.is_skin(cell); }

constexpr ForceKeyword overloaded_forces[] = {{"FORCE_NODALE", nullptr},
                                              {"PRES_REP", is_surface},
                                              {"FORCE_FACE", is_loaded_skin},
                                              {"FORCE_ARETE", is_loaded_skin},
                                              {"FORCE_CONTOUR", is_loaded_skin},
                                              {"FORCE_INTERNE", is_loaded},
                                              {"FORCE_POUTRE", is_loaded},
                                              {"FORCE_COQUE", is_loaded},
                                              {"PRE_EPSI", is_loaded},
                                              {"PESANTEUR", is_loaded, Overloading::whole},
                                              {"ROTATION", is_loaded, Overloading::whole}};

std::string place_name(const ForceKeyword& keyword, const LoadedModel& target, int place) {
  return keyword.bears == nullptr ? target.mesh.node_name(place) : target.mesh.cell_name(place);
}

std::vector<int> places_of(const ForceKeyword& keyword, const Keywords& force, const LoadedModel& target) {
  if (keyword.bears == nullptr) return selected_nodes(force, target.mesh);
  std::vector<int> cells = cells_or_all(force, target.mesh);
  std::erase_if(cells, [&](int cell) { return !keyword.bears(target, cell); });
  return cells;
}

// What replaces what other occurrences give: the number or function of a component; of keywords that count whole,
// anything.
std::vector<std::pair<std::string, const interpreter::Keyword*>> overloading_parts(const ForceKeyword& keyword,
                                                                                   const Keywords& force) {
  if (keyword.overloading == Overloading::whole) return {{keyword.name, nullptr}};
  std::vector<std::pair<std::string, const interpreter::Keyword*>> parts;
  for (const interpreter::Keyword& item : force.items)
    if (item.given && (item.value.is_concept() || item.value.is_number()))
      parts.emplace_back(place_of_force(keyword.name, item.name), &item);
  return parts;
}

void warn_of_overridden_forces(const Call& call, const ForceKeyword& keyword, const LoadedModel& target,
                               Context& context) {
  if (call.factors(keyword.name).size() < 2) return;
  std::map<std::pair<int, std::string>, const interpreter::Keyword*> last;
  Overriding found{keyword.name};
  for (const Keywords& force : call.factors(keyword.name)) {
    const auto parts = overloading_parts(keyword, force);
    for (const int place : places_of(keyword, force, target)) {
      for (const auto& [name, item] : parts) {
        const auto [known, is_first] = last.try_emplace({place, name}, item);
        if (is_first) continue;
        const interpreter::Keyword* before = std::exchange(known->second, item);
        if (before != nullptr && before->name == item->name && is_same_amount(*before, *item)) continue;
        ++found.count;
        if (found.example.empty())
          found.example = fmt::format("{} at {}", before ? before->name : name, place_name(keyword, target, place));
      }
    }
  }
  warn_of(found, call.factors(keyword.name).back().span, "where they are meant to add up, put them into two loads",
          context);
}

// What reads a number as another one than it was written as.
void warn_of_mixed_axes(const Call& call, const char* keyword, const LoadedModel& target, Context& context) {
  if (call.factors(keyword).size() < 2) return;
  std::ptrdiff_t count = 0;
  std::pair<int, FramedForce> first;
  for (const auto& [cell, force] : framed_forces(call, keyword, target))
    if (force.is_mixed() && count++ == 0) first = {cell, force};
  if (count == 0) return;
  const bool presses = first.second.frame == ForceFrame::pressure,
             is_beam = std::string_view(keyword) == "FORCE_POUTRE";
  const std::string reading = presses   ? "PRES alone counts there, F3 and FZ as PRES"
                              : is_beam ? "all of them count in own axes there, FX as N, FY as VY, MX as MT"
                                        : "all of them count in own axes there, FX as F1, FY as F2, FZ and PRES as F3";
  context.diagnostics.alarm(
      "mixed-axes",
      fmt::format("{}: forces on {} of the cells are given in several axes, on {} for one: {} (as in Code_Aster 17.3)",
                  keyword, count, target.mesh.cell_name(first.first), reading),
      call.factors(keyword).back().span, "put forces in other axes into a load of their own");
}

// The level of the last occurrence is that of all forces on the plate.
void warn_of_other_levels(const Call& call, const LoadedModel& target, Context& context) {
  std::map<int, std::string> levels;
  Overriding found{"FORCE_COQUE"};
  for (const Keywords& force : call.factors("FORCE_COQUE"))
    for (const int cell : selected_cells(force, target.mesh)) {
      if (!is_plate(target, cell)) continue;
      const auto [known, is_first] = levels.try_emplace(cell, force.text("PLAN"));
      const std::string before = std::exchange(known->second, force.text("PLAN"));
      if (before == known->second) continue;
      ++found.count;
      if (found.example.empty()) found.example = fmt::format("PLAN='{}' at {}", before, target.mesh.cell_name(cell));
    }
  warn_of(found, call.factors("FORCE_COQUE").empty() ? call.span : call.factors("FORCE_COQUE").back().span,
          "where they are meant to add up, put them into two loads", context);
}

}  // namespace

void warn_of(const Overriding& found, const interpreter::Span& at, const char* hint, Context& context) {
  if (found.count == 0) return;
  context.diagnostics.alarm(
      "overridden-value",
      fmt::format("{}: {} of its values give way to later ones of the same keyword, that of {} for one", found.keyword,
                  found.count, found.example),
      at, hint);
}

void warn_of_loads(const Call& call, const LoadedModel& target, Context& context) {
  for (const ForceKeyword& keyword : overloaded_forces) warn_of_overridden_forces(call, keyword, target, context);
  for (const char* keyword : {"FORCE_POUTRE", "FORCE_COQUE"}) warn_of_mixed_axes(call, keyword, target, context);
  warn_of_other_levels(call, target, context);
  check_normals(call, target, context);
  warn_of_lost_forces(call, target, context);
  warn_of_weight_out_of_plane(call, target, context);
  warn_of_weightless_cells(call, target, context);
}

}  // namespace comma::commands
