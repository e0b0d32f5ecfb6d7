#include "commands/alarms/contact_alarms.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <span>

#include <fmt/format.h>

#include "commands/selection.hpp"
#include "solver/contact/extent.hpp"
#include "solver/contact/face_rule.hpp"
#include "solver/contact/normals.hpp"
#include "solver/contact/pairing.hpp"
#include "solver/error.hpp"
#include "solver/mesh/orientation.hpp"
#include "solver/mesh/place.hpp"

namespace comma::commands {

namespace {

using interpreter::Call;
using interpreter::Keywords;

// A node of two zones has the multipliers, or penalties, of both.
void warn_of_shared_nodes(const Call& call, const solver::ContactDefinition& definition, const solver::Mesh& mesh,
                          interpreter::Diagnostics& diagnostics) {
  const bool is_mixed = definition.formulation == solver::ContactFormulation::mixed;
  std::map<int, std::size_t> zones;
  for (std::size_t k = 0; k < definition.zones.size(); ++k) {
    const solver::ContactZone& zone = definition.zones[k];
    if (zone.mixed.local_average || !zone.resolved || !(is_mixed || zone.mixed.penalised || zone.mixed.friction > 0.0))
      continue;
    const std::set<int> excluded(zone.excluded_slave_nodes.begin(), zone.excluded_slave_nodes.end());
    for (const int node : mesh.nodes_of_cells(zone.slave_cells)) {
      if (excluded.contains(node)) continue;
      const auto [earlier, is_first] = zones.emplace(node, k);
      if (is_first) continue;
      diagnostics.alarm("shared-slave-nodes",
                        fmt::format("DEFI_CONTACT: node {} is a slave of zones {} and {}: {}", mesh.node_name(node),
                                    earlier->second + 1, k + 1,
                                    !is_mixed ? "it has the penalties of both"
                                    : zone.mixed.penalised
                                        ? "it has the penalties of both, and LAGS_C there is the sum of two pressures"
                                        : "LAGS_C there is the sum of two pressures, and with points between nodes the "
                                          "pressures around it depend on where the zones are parted"),
                        call.factors("ZONE")[k].span,
                        "where the surface is one, make it one zone; or leave the node to one of them (SANS_GROUP_NO)");
      return;
    }
  }
}

// Nodes that are left out of contact, or of friction, are slaves: others change nothing.
void warn_of_idle_exclusions(const Call& call, const solver::ContactDefinition& definition, const solver::Mesh& mesh,
                             interpreter::Diagnostics& diagnostics) {
  struct Exclusion {
    const char* keyword;
    PlaceKeywords names;
  };
  static const Exclusion exclusions[] = {
      {"SANS_GROUP_NO", {"", "SANS_GROUP_NO", "", "", ""}},       {"SANS_NOEUD", {"", "", "SANS_NOEUD", "", ""}},
      {"SANS_GROUP_MA", {"", "", "", "SANS_GROUP_MA", ""}},       {"SANS_MAILLE", {"", "", "", "", "SANS_MAILLE"}},
      {"SANS_GROUP_NO_FR", {"", "SANS_GROUP_NO_FR", "", "", ""}}, {"SANS_NOEUD_FR", {"", "", "SANS_NOEUD_FR", "", ""}}};
  const std::vector<Keywords> zones = call.factors("ZONE");
  for (std::size_t k = 0; k < zones.size(); ++k) {
    const std::vector<int> slaves = mesh.nodes_of_cells(definition.zones[k].slave_cells);
    const std::set<int> known(slaves.begin(), slaves.end());
    for (const auto& [keyword, names] : exclusions) {
      if (!zones[k].given(keyword)) continue;
      const std::vector<int> nodes = selected_nodes(zones[k], mesh, names);
      if (std::ranges::any_of(nodes, [&](int node) { return known.contains(node); })) continue;
      diagnostics.alarm(
          "idle-exclusion",
          fmt::format("DEFI_CONTACT: {} names no node of the slave surface, and leaves out nothing", keyword),
          zones[k].span_of(keyword), "name nodes of GROUP_MA_ESCL, or leave it out");
    }
  }
}

// With fewer points than nodes a face leaves its multipliers undetermined.
void warn_of_few_points(const Call& call, const solver::ContactDefinition& definition, const solver::Mesh& mesh,
                        interpreter::Diagnostics& diagnostics) {
  if (definition.formulation != solver::ContactFormulation::mixed) return;
  for (std::size_t k = 0; k < definition.zones.size(); ++k) {
    const solver::ContactZone& zone = definition.zones[k];
    if (zone.mixed.local_average) continue;
    for (const int cell : zone.slave_cells) {
      const auto points = solver::face_rule(mesh.cell_types[cell], zone.mixed.rule, zone.mixed.rule_order).size();
      if (points >= mesh.cell(cell).size()) continue;
      diagnostics.alarm("few-points",
                        fmt::format("DEFI_CONTACT: {} points on slave face {} do not determine the multipliers of its "
                                    "{} nodes: pressures at nodes (LAGS_C) may be arbitrary, forces "
                                    "and stresses are not",
                                    points, mesh.cell_name(cell), mesh.cell(cell).size()),
                        call.factors("ZONE")[k].span, "take a higher ORDRE_INT, or INTEGRATION='AUTO'");
      return;
    }
  }
}

/// A reference point that lies within every face.
Eigen::Vector2d inside_of_face() { return {0.25, 0.25}; }

bool lies_in_plane(const solver::Mesh& mesh) {
  return std::ranges::all_of(mesh.nodes, [](const auto& place) { return place[2] == 0.0; });
}

/// Whether all these cells bound bodies, so that what lies behind them is inside. Plates, beams and
/// rigid faces have no inside.
bool bound_bodies(const solver::Mesh& mesh, const std::vector<int>& cells) {
  const int with_normals = lies_in_plane(mesh) ? 1 : 2;
  return solver::loose_skin(mesh, cells).empty() && std::ranges::all_of(cells, [&](int cell) {
           return solver::dimension(mesh.cell_types[static_cast<std::size_t>(cell)]) == with_normals;
         });
}

/// Whether a direction that stands for the outward normal of all these cells points into the bodies behind them
/// everywhere.
bool points_inward(const std::array<double, 3>& direction, std::span<const int> cells, const solver::Mesh& mesh) {
  const std::vector<Eigen::Vector3d> places = solver::places(mesh);
  const auto is_against = [&](int cell) {
    return solver::surface_normal({}, mesh, cell, inside_of_face(), places).dot(Eigen::Vector3d(direction.data())) <
           0.0;
  };
  return std::ranges::all_of(cells, is_against);
}

// A fixed direction stands for the outward normal: along one that points into the body bodies go through each other.
void warn_of_inward_directions(const Call& call, const solver::ContactDefinition& definition, const solver::Mesh& mesh,
                               interpreter::Diagnostics& diagnostics) {
  const std::vector<Keywords> zones = call.factors("ZONE");
  for (std::size_t k = 0; k < zones.size(); ++k) {
    const solver::ContactZone& zone = definition.zones[k];
    const auto look = [&](const char* keyword, solver::NormalRule rule, solver::NormalSide other,
                          const std::array<double, 3>& direction, const std::vector<int>& cells) {
      if (rule != solver::NormalRule::fixed || zone.normal_side == other) return;
      if (!bound_bodies(mesh, cells) || !points_inward(direction, cells, mesh)) return;
      diagnostics.alarm("inward-normals",
                        fmt::format("DEFI_CONTACT: {} points into the body, where it stands for the normal that points "
                                    "out of it: the bodies may go through each other",
                                    keyword),
                        zones[k].span_of(keyword), "turn the vector round");
    };
    look("MAIT_FIXE", zone.master_normal, solver::NormalSide::slave, zone.master_vector, zone.master_cells);
    look("ESCL_FIXE", zone.slave_normal, solver::NormalSide::master, zone.slave_vector, zone.slave_cells);
  }
}

// What VERI_NORM='NON' lets pass.
void warn_of_inward_normals(const Call& call, const solver::ContactDefinition& definition, const solver::Mesh& mesh,
                            interpreter::Diagnostics& diagnostics) {
  if (call.text("VERI_NORM") == "OUI") return;
  const std::vector<Keywords> zones = call.factors("ZONE");
  for (std::size_t k = 0; k < zones.size(); ++k) {
    for (const auto& [keyword, cells] : {std::pair("GROUP_MA_MAIT", &definition.zones[k].master_cells),
                                         std::pair("GROUP_MA_ESCL", &definition.zones[k].slave_cells)}) {
      const std::size_t inward = solver::inward_skin(mesh, *cells).size();
      if (inward == 0) continue;
      diagnostics.alarm("inward-normals",
                        fmt::format("DEFI_CONTACT: the normals of {} of these {} cells point into the body, and "
                                    "VERI_NORM='NON' lets that pass: the bodies may go through each other",
                                    inward, cells->size()),
                        zones[k].span_of(keyword),
                        "turn them by MODI_MAILLAGE(ORIE_PEAU=_F(GROUP_MA_PEAU=...)) before the model is made");
    }
  }
}

/// How many slave nodes of a zone face the master, and how many of these from behind: looking the same way as it does.
std::pair<int, int> facing_nodes(const solver::ContactZone& zone, const solver::Mesh& mesh) {
  solver::ContactDefinition alone;
  alone.zones.push_back(zone);
  const std::vector<Eigen::Vector3d> places = solver::places(mesh);
  const auto normals = solver::nodal_normals(mesh, zone.slave_cells, places);
  constexpr double same_way = 0.5, rounding = 1e-6;
  std::pair<int, int> count{0, 0};
  for (const solver::ContactPair& pair : solver::pair_surfaces(alone, mesh, places, 0.0)) {
    if (pair.status != solver::PairingStatus::paired) continue;
    ++count.first;
    const Eigen::Vector3d out = solver::surface_normal({}, mesh, pair.facet, inside_of_face(), places);
    const double height = out.dot(places[static_cast<std::size_t>(pair.slave)] - pair.foot);
    count.second += normals.at(pair.slave).dot(out) > same_way && height < -rounding * solver::extent(mesh, pair.facet);
  }
  return count;
}

void warn_of_surfaces_turned_away(const Call& call, const solver::ContactDefinition& definition,
                                  const solver::Mesh& mesh, interpreter::Diagnostics& diagnostics) {
  const std::vector<Keywords> zones = call.factors("ZONE");
  for (std::size_t k = 0; k < zones.size(); ++k) {
    const solver::ContactZone& zone = definition.zones[k];
    if (!zone.resolved || !bound_bodies(mesh, zone.master_cells) || !bound_bodies(mesh, zone.slave_cells)) continue;
    try {
      const auto [facing, from_behind] = facing_nodes(zone, mesh);
      if (2 * from_behind <= facing) continue;
      diagnostics.alarm("surfaces-turned-away",
                        fmt::format("DEFI_CONTACT: of zone {} the slave side looks the same way as the master and lies "
                                    "behind it, which counts as deep in it ({} of {} nodes)",
                                    k + 1, from_behind, facing),
                        zones[k].span, "name the sides that look at each other");
    } catch (const solver::Error&) {
      // Surfaces that cannot be paired are told of where they must be.
    }
  }
}

// Lines of solids are integrated along their length, faces over their area: where both meet, pressures are shared
// between them.
void warn_of_mixed_faces(const Call& call, const solver::ContactDefinition& definition, const solver::Model& model,
                         interpreter::Diagnostics& diagnostics) {
  if (definition.formulation != solver::ContactFormulation::mixed) return;
  const std::vector<Keywords> zones = call.factors("ZONE");
  for (std::size_t k = 0; k < zones.size(); ++k) {
    const std::vector<int>& cells = definition.zones[k].slave_cells;
    const auto has_dimension = [&](int wanted) {
      return [&, wanted](int cell) {
        return solver::dimension(model.mesh->cell_types[static_cast<std::size_t>(cell)]) == wanted;
      };
    };
    const auto line = std::ranges::find_if(cells, [&](int cell) {
      return has_dimension(1)(cell) &&
             solver::continuum_dimension(model.formulations[static_cast<std::size_t>(cell)]) == 3;
    });
    if (line == cells.end() || std::ranges::none_of(cells, has_dimension(2))) continue;
    diagnostics.alarm(
        "mixed-faces",
        fmt::format(
            "DEFI_CONTACT: the slave surface holds lines beside faces, {} the first: each presses over its length as "
            "faces do over their areas, and LAGS_C at its nodes is neither a pressure nor a force per length",
            model.mesh->cell_name(*line)),
        zones[k].span_of("GROUP_MA_ESCL"),
        "name a group of the faces alone (DEFI_GROUP, CREA_GROUP_MA with TYPE_MAILLE='2D')");
  }
}

// What belongs to projected gradients, or to zones that are watched alone, where there are none.
void warn_of_idle_options(const Call& call, interpreter::Diagnostics& diagnostics) {
  const std::vector<Keywords> zones = call.factors("ZONE");
  const auto any_has = [&](const char* keyword, const char* word) {
    return std::ranges::any_of(zones,
                               [&](const Keywords& zone) { return zone.has(keyword) && zone.text(keyword) == word; });
  };
  const auto warn = [&](const char* keyword, const char* lacking) {
    if (call.given(keyword))
      diagnostics.alarm("idle-coefficient",
                        fmt::format("DEFI_CONTACT: {} is given and nothing takes it: no zone has {}", keyword, lacking),
                        call.span_of(keyword), fmt::format("give a zone {}, or leave {} out", lacking, keyword));
  };
  if (!any_has("ALGO_CONT", "GCP"))
    for (const char* keyword : {"RESI_ABSO", "ITER_GCP_MAXI", "PRE_COND"}) warn(keyword, "ALGO_CONT='GCP'");
  if (call.has("STOP_INTERP") && call.text("STOP_INTERP") == "OUI" && !any_has("RESOLUTION", "NON"))
    warn("STOP_INTERP", "RESOLUTION='NON'");
}

// Coefficients of a weak formulation that the zone does not take are in no equation.
void warn_of_idle_coefficients(const Call& call, const solver::ContactDefinition& definition,
                               interpreter::Diagnostics& diagnostics) {
  if (definition.formulation != solver::ContactFormulation::mixed) return;
  const std::vector<Keywords> zones = call.factors("ZONE");
  for (std::size_t k = 0; k < zones.size(); ++k) {
    const solver::MixedZone& mixed = definition.zones[k].mixed;
    const auto warn = [&](const char* keyword, bool is_taken, const std::string& what, const std::string& taken_with) {
      if (is_taken || !zones[k].given(keyword)) return;
      diagnostics.alarm("idle-coefficient",
                        fmt::format("DEFI_CONTACT: {} is given and nothing takes it: {}", keyword, what),
                        zones[k].span_of(keyword), fmt::format("write {}, or leave {} out", taken_with, keyword));
    };
    const std::string contact = "ALGO_CONT is '" + zones[k].text("ALGO_CONT") + "'";
    warn("COEF_CONT", !mixed.penalised && !mixed.local_average, contact, "ALGO_CONT='STANDARD'");
    warn("COEF_PENA_CONT", mixed.penalised && !mixed.adapts_penalty,
         mixed.adapts_penalty ? "each point has a penalty that its depth adapts" : contact,
         mixed.adapts_penalty ? "ADAPTATION='NON'" : "ALGO_CONT='PENALISATION'");
    warn("PENE_MAXI", mixed.adapts_penalty, "no penalty of contact is adapted",
         "ALGO_CONT='PENALISATION' and ADAPTATION='ADAPT_COEF'");
    if (!zones[k].has("COULOMB")) continue;
    const std::string friction = "ALGO_FROT is '" + zones[k].text("ALGO_FROT") + "'";
    warn("COEF_FROT", !mixed.friction_penalised, friction, "ALGO_FROT='STANDARD'");
    warn("COEF_PENA_FROT", mixed.friction_penalised, friction, "ALGO_FROT='PENALISATION'");
    warn("GLIS_MAXI", mixed.friction_penalised && mixed.largest_slip.has_value(), "no penalty of friction is adapted",
         "ALGO_FROT='PENALISATION' and ADAPTATION='ADAPT_COEF'");
  }
}

}  // namespace

void warn_of_contact(const Call& call, const solver::ContactDefinition& definition, const solver::Model& model,
                     interpreter::Diagnostics& diagnostics) {
  const solver::Mesh& mesh = *model.mesh;
  warn_of_mixed_faces(call, definition, model, diagnostics);
  warn_of_few_points(call, definition, mesh, diagnostics);
  warn_of_shared_nodes(call, definition, mesh, diagnostics);
  warn_of_idle_exclusions(call, definition, mesh, diagnostics);
  warn_of_idle_coefficients(call, definition, diagnostics);
  warn_of_idle_options(call, diagnostics);
  warn_of_inward_directions(call, definition, mesh, diagnostics);
  warn_of_inward_normals(call, definition, mesh, diagnostics);
  warn_of_surfaces_turned_away(call, definition, mesh, diagnostics);
}

}  // namespace comma::commands
