#include <algorithm>
#include <array>
#include <set>

#include <fmt/format.h>

#include "commands/alarms/contact_alarms.hpp"
#include "commands/analysis/same_mesh.hpp"
#include "commands/commands.hpp"
#include "commands/points.hpp"
#include "commands/selection.hpp"
#include "interpreter/diagnostic.hpp"
#include "solver/contact/half_thickness.hpp"
#include "solver/contact/patch_points.hpp"
#include "solver/mesh/orientation.hpp"

namespace comma::commands {

namespace {

using interpreter::DiagnosticError;
using solver::Component;

Component component(const Keywords& zone, const std::string& name, const std::vector<int>& nodes,
                    const solver::DofMap& dofs) {
  const auto known = solver::component_named(name);
  if (known) {
    for (const int node : nodes) {
      if (dofs.dof(node, *known) >= 0) return *known;
    }
  }
  throw DiagnosticError("unknown-component", "NOM_CMP: none of these nodes carries " + name, zone.span_of("NOM_CMP"));
}

// COEF_MULT . u <= COEF_IMPO at each node (U4.44.11).
solver::UnilateralCondition unilateral(const Keywords& zone, const solver::Model& model) {
  const solver::DofMap dofs(model);
  solver::UnilateralCondition condition;
  condition.nodes = remaining_nodes(zone, *model.mesh);
  if (condition.nodes.empty())
    throw DiagnosticError("nothing-left", "DEFI_CONTACT: all nodes of the zone are left out of it", zone.span,
                          "leave out fewer (SANS_GROUP_NO), or the zone");
  for (const std::string& name : zone.texts("NOM_CMP")) {
    condition.components.push_back(component(zone, name, condition.nodes, dofs));
  }
  for (const auto& handle : zone.concepts("COEF_MULT"))
    condition.coefficients.push_back(field_function(handle, zone.span_of("COEF_MULT")));
  if (condition.coefficients.size() != condition.components.size()) {
    throw DiagnosticError("wrong-count",
                          "DEFI_CONTACT: each of the " + std::to_string(condition.components.size()) +
                              " components of NOM_CMP needs its coefficient",
                          zone.span_of("COEF_MULT"), "give as many functions to COEF_MULT as names to NOM_CMP");
  }
  condition.bound = field_function(zone.concept_of("COEF_IMPO"), zone.span_of("COEF_IMPO"));
  if (zone.text("ALGO_CONT") == "PENALISATION") condition.penalty = zone.real("COEF_PENA");
  return condition;
}

solver::NormalSide normal_side(const std::string& word) {
  if (word == "ESCL") return solver::NormalSide::slave;
  return word == "MAIT_ESCL" ? solver::NormalSide::average : solver::NormalSide::master;
}

std::array<double, 3> direction_of(const Keywords& zone, const std::string& keyword) {
  const solver::Point vector = point_of(zone, keyword);
  if (std::ranges::any_of(vector, [](double each) { return each != 0.0; })) return vector;
  throw DiagnosticError("zero-vector", keyword + " is no direction: all its components are 0", zone.span_of(keyword),
                        "give a vector that is not null");
}

// VECT_MAIT and VECT_ESCL, with what they need.
void take_normal(const Keywords& zone, const std::string& side, solver::NormalRule& rule,
                 std::array<double, 3>& vector) {
  const std::string keyword = "VECT_" + side;
  if (!zone.has(keyword) || zone.text(keyword) == "AUTO") return;
  const bool fixed = zone.text(keyword) == "FIXE";
  rule = fixed ? solver::NormalRule::fixed : solver::NormalRule::along_y;
  vector = direction_of(zone, side + (fixed ? "_FIXE" : "_VECT_Y"));
}

// DIST_POUTRE and DIST_COQUE: the slave surface lies off its cells by what their elements take up, the master surface
// on its cells (Code_Aster 17.3).
void take_half_thickness(const Keywords& keywords, const solver::Model& model, solver::ContactZone& zone) {
  const bool beams = keywords.text("DIST_POUTRE") == "OUI";
  const bool plates = keywords.text("DIST_COQUE") == "OUI";
  if (!beams && !plates) return;
  const char* keyword = beams ? "DIST_POUTRE" : "DIST_COQUE";
  if (!keywords.given("CARA_ELEM")) {
    throw DiagnosticError("missing-keyword", std::string("DEFI_CONTACT: ") + keyword + " needs to know the sections",
                          keywords.span_of(keyword), "give CARA_ELEM");
  }
  const auto& given = keywords.data<PropertiesConcept>("CARA_ELEM");
  if (given.model) require_mesh(keywords, "CARA_ELEM", given.model->mesh.get(), *model.mesh);
  const auto& properties = *given.properties;
  if (beams) zone.half_thickness = solver::beam_radii(model, properties, zone.slave_cells);
  if (plates) zone.half_thickness.merge(solver::plate_half_thicknesses(model, properties, zone.slave_cells));
  if (zone.half_thickness.empty()) {
    throw DiagnosticError(
        "missing-cells", std::string("DEFI_CONTACT: no slave cell of this zone is ") + (beams ? "a beam" : "a plate"),
        keywords.span_of(keyword),
        std::string("leave out ") + keyword + "; the thickness on the master side is given by DIST_MAIT");
  }
}

// A gap has a sign only if the normals point out of the bodies (U4.44.11, VERI_NORM).
void check_normals(const Keywords& zone, const std::string& keyword, const std::vector<int>& cells,
                   const solver::Mesh& mesh) {
  const auto inward = solver::inward_skin(mesh, cells);
  if (inward.empty()) return;
  throw DiagnosticError(
      "inward-normals",
      "DEFI_CONTACT: the normals of " + std::to_string(inward.size()) + " of these " + std::to_string(cells.size()) +
          " cells point into the body, that of " + mesh.cell_name(inward.front()) + " for one",
      zone.span_of(keyword), "turn them by MODI_MAILLAGE(ORIE_PEAU=_F(GROUP_MA_PEAU=...)) before the model is made");
}

// Of surfaces that bound no body (plates, beams, rigid faces) neighbours must agree on a side.
void check_sides_of_sheets(const Keywords& zone, const std::string& keyword, const std::vector<int>& cells,
                           const solver::Mesh& mesh) {
  const auto unlike = solver::unlike_neighbours(mesh, solver::loose_skin(mesh, cells));
  if (!unlike) return;
  const bool lines = solver::dimension(mesh.cell_types[static_cast<std::size_t>(unlike->first)]) == 1;
  throw DiagnosticError(
      "unlike-normals",
      fmt::format("DEFI_CONTACT: the normals of the neighbours {} and {} of this surface point to different sides",
                  mesh.cell_name(unlike->first), mesh.cell_name(unlike->second)),
      zone.span_of(keyword),
      fmt::format("turn them by MODI_MAILLAGE({}=_F(GROUP_MA=...)) before the model is made",
                  lines ? "ORIE_LIGNE" : "ORIE_NORM_COQUE"));
}

// Surfaces are edges of plane bodies, faces of solids, plates or beams, and no cell faces itself.
void check_surface(const Keywords& zone, const char* keyword, const std::vector<int>& cells,
                   const solver::Model& model) {
  for (const int cell : cells) {
    const auto type = model.mesh->cell_types[static_cast<std::size_t>(cell)];
    const int body = solver::continuum_dimension(model.formulations[static_cast<std::size_t>(cell)]);
    if (body == 0 || body != solver::dimension(type)) continue;
    const bool solid = solver::dimension(type) == 3;
    throw DiagnosticError("wrong-surface",
                          fmt::format("DEFI_CONTACT: {} holds {}, a cell of the body itself ({}), not of its surface",
                                      keyword, model.mesh->cell_name(cell), solver::name_of(type)),
                          zone.span_of(keyword), fmt::format("name a group of its {}", solid ? "faces" : "edges"));
  }
}

void check_sides(const Keywords& zone, const solver::ContactZone& surfaces, const solver::Mesh& mesh) {
  for (const auto& [cells, keyword] :
       {std::pair(&surfaces.master_cells, "GROUP_MA_MAIT"), std::pair(&surfaces.slave_cells, "GROUP_MA_ESCL")})
    if (cells->empty())
      throw DiagnosticError("empty-group", fmt::format("DEFI_CONTACT: {} holds no cell", keyword),
                            zone.span_of(keyword), "name a group that has cells");
  const std::set<int> masters(surfaces.master_cells.begin(), surfaces.master_cells.end());
  const auto shared = std::ranges::find_if(surfaces.slave_cells, [&](int cell) { return masters.contains(cell); });
  if (shared != surfaces.slave_cells.end()) {
    throw DiagnosticError(
        "wrong-surface",
        fmt::format("DEFI_CONTACT: the cell {} is on both sides of the zone: a surface does not face itself",
                    mesh.cell_name(*shared)),
        zone.span_of("GROUP_MA_ESCL"), "give each side a group of its own");
  }
  if (!std::ranges::includes(mesh.nodes_of_cells(surfaces.master_cells), mesh.nodes_of_cells(surfaces.slave_cells)))
    return;
  throw DiagnosticError("wrong-surface",
                        "DEFI_CONTACT: all nodes of the slave surface are nodes of the master surface: the bodies hang "
                        "together, and there is nothing to close or open",
                        zone.span_of("GROUP_MA_ESCL"), "mesh the bodies apart, with nodes of their own on either side");
}

void take_thickness(const Keywords& keywords, const char* keyword, solver::FieldFunction& thickness,
                    solver::ContactZone& zone) {
  if (!keywords.has(keyword)) return;
  const auto handle = keywords.concept_of(keyword);
  thickness = field_function(handle, keywords.span_of(keyword));
  const auto& parameters = interpreter::data_of<FunctionConcept>(handle, keyword).parameters();
  if (std::ranges::find(parameters, "INST") != parameters.end()) zone.thickness_changes = true;
}

// Nodes and patches have no facet to be sought along a line.
void check_direction_of_search(const Keywords& zone, const char* keyword) {
  const bool by_patches = zone.text("ALGO_CONT") == "LAC";
  if (!by_patches && zone.text("APPARIEMENT") != "NODAL") return;
  throw DiagnosticError("unsupported",
                        fmt::format("comma does not support {}='FIXE' with {}", keyword,
                                    by_patches ? "ALGO_CONT='LAC'" : "APPARIEMENT='NODAL'"),
                        zone.span_of(keyword),
                        "leave it out, or take APPARIEMENT='MAIT_ESCL' and ALGO_CONT='STANDARD'");
}

solver::ContactZone contact_zone(const Keywords& keywords, const solver::Mesh& mesh) {
  solver::ContactZone zone;
  zone.master_cells = selected_cells(keywords, mesh, {"", "", "", "GROUP_MA_MAIT", "MAILLE_MAIT"});
  zone.slave_cells = selected_cells(keywords, mesh, {"", "", "", "GROUP_MA_ESCL", "MAILLE_ESCL"});
  if (keywords.has("NORMALE")) zone.normal_side = normal_side(keywords.text("NORMALE"));
  take_normal(keywords, "MAIT", zone.master_normal, zone.master_vector);
  take_normal(keywords, "ESCL", zone.slave_normal, zone.slave_vector);
  for (const char* keyword : {"TYPE_APPA", "TYPE_PROJECTION"}) {
    if (keywords.text(keyword) != "FIXE") continue;
    check_direction_of_search(keywords, keyword);
    zone.pairing_direction = direction_of(keywords, "DIRE_APPA");
    if (mesh.dimension == 2 && (*zone.pairing_direction)[2] != 0.0)
      throw DiagnosticError("out-of-plane", "DEFI_CONTACT: DIRE_APPA points out of the plane of the model",
                            keywords.span_of("DIRE_APPA"), "give a direction whose third component is 0");
  }
  zone.excluded_slave_nodes =
      selected_nodes(keywords, mesh, {"", "SANS_GROUP_NO", "SANS_NOEUD", "SANS_GROUP_MA", "SANS_MAILLE"});
  if (keywords.has("TOLE_PROJ_EXT")) zone.projection_tolerance = keywords.real("TOLE_PROJ_EXT");
  if (keywords.has("RESOLUTION")) zone.resolved = keywords.text("RESOLUTION") == "OUI";
  if (keywords.has("TOLE_INTERP")) zone.interpenetration_tolerance = keywords.real("TOLE_INTERP");
  if (keywords.text("APPARIEMENT") == "NODAL") zone.pairing = solver::PairingRule::node;
  take_thickness(keywords, "DIST_ESCL", zone.slave_thickness, zone);
  take_thickness(keywords, "DIST_MAIT", zone.master_thickness, zone);
  if (keywords.has("DIST_APPA")) zone.pairing_distance = keywords.real("DIST_APPA");
  return zone;
}

solver::GeometryUpdate geometry_update(const std::string& word) {
  if (word == "SANS") return solver::GeometryUpdate::none;
  return word == "CONTROLE" ? solver::GeometryUpdate::controlled : solver::GeometryUpdate::automatic;
}

solver::ContactRule contact_rule(const std::string& word) {
  if (word == "GAUSS") return solver::ContactRule::gauss;
  if (word == "SIMPSON") return solver::ContactRule::simpson;
  return word == "NCOTES" ? solver::ContactRule::newton_cotes : solver::ContactRule::automatic;
}

solver::InitialContact initial_contact(const std::string& word) {
  if (word == "OUI") return solver::InitialContact::all;
  return word == "NON" ? solver::InitialContact::none : solver::InitialContact::interpenetrating;
}

// The gap is measured along the slave's own normals, over patches that lie wholly on one side: what says otherwise has
// no meaning.
void check_local_average(const Keywords& zone) {
  if (zone.given("APPARIEMENT") && zone.text("APPARIEMENT") != "MORTAR") {
    throw DiagnosticError("contradictory-keywords", "DEFI_CONTACT: ALGO_CONT='LAC' pairs segments of intersection",
                          zone.span_of("APPARIEMENT"), "write APPARIEMENT='MORTAR'");
  }
  for (const char* keyword :
       {"COULOMB", "NORMALE", "VECT_MAIT", "VECT_ESCL", "RESOLUTION", "DIST_POUTRE", "DIST_COQUE", "TOLE_PROJ_EXT",
        "INTEGRATION", "SANS_GROUP_NO", "SANS_NOEUD", "SANS_GROUP_MA", "SANS_MAILLE"}) {
    if (!zone.given(keyword) || (keyword == std::string_view("INTEGRATION") && zone.text(keyword) == "AUTO")) continue;
    throw DiagnosticError("unsupported", std::string("comma does not support ") + keyword + " with ALGO_CONT='LAC'",
                          zone.span_of(keyword), "leave it out, or take ALGO_CONT='STANDARD'");
  }
}

// Segments of intersection are those of local average contact alone.
void check_pairing(const Keywords& zone) {
  if (zone.text("APPARIEMENT") != "MORTAR") return;
  throw DiagnosticError("unsupported", "comma supports APPARIEMENT='MORTAR' with ALGO_CONT='LAC' only",
                        zone.span_of("APPARIEMENT"), "write ALGO_CONT='LAC', or APPARIEMENT='MAIT_ESCL'");
}

bool adapts_penalties(const Keywords& keywords) {
  const std::string adaptation = keywords.text("ADAPTATION");
  return adaptation == "ADAPT_COEF" || adaptation == "TOUT";
}

void take_friction(const Keywords& keywords, solver::MixedZone& zone) {
  zone.friction_penalised = keywords.text("ALGO_FROT") == "PENALISATION";
  if (!zone.friction_penalised) {
    zone.friction_augmentation = keywords.real("COEF_FROT");
    return;
  }
  zone.friction_penalty = keywords.real("COEF_PENA_FROT");
  if (keywords.has("GLIS_MAXI") && adapts_penalties(keywords)) zone.largest_slip = keywords.real("GLIS_MAXI");
}

solver::MixedZone mixed_zone(const Keywords& keywords, const solver::Mesh& mesh) {
  solver::MixedZone zone;
  zone.local_average = keywords.text("ALGO_CONT") == "LAC";
  zone.local_average ? check_local_average(keywords) : check_pairing(keywords);
  zone.rule = contact_rule(keywords.text("INTEGRATION"));
  if (keywords.has("ORDRE_INT")) zone.rule_order = static_cast<int>(keywords.integer("ORDRE_INT"));
  if (zone.local_average) zone.present_areas = keywords.text("TYPE_JACOBIEN") == "ACTUALISE";
  zone.penalised = keywords.text("ALGO_CONT") == "PENALISATION";
  zone.adapts_penalty = zone.penalised && adapts_penalties(keywords);
  if (zone.adapts_penalty && keywords.has("PENE_MAXI")) zone.largest_depth = keywords.real("PENE_MAXI");
  zone.augmentation = keywords.real(zone.penalised ? "COEF_PENA_CONT" : "COEF_CONT");
  zone.keeps_augmentation = keywords.text("ADAPTATION") == "NON";
  zone.initial = initial_contact(keywords.text("CONTACT_INIT"));
  zone.bilateral = keywords.text("GLISSIERE") == "OUI";
  if (!keywords.has("COULOMB")) return zone;
  zone.friction = keywords.real("COULOMB");
  take_friction(keywords, zone);
  zone.frictionless_nodes = selected_nodes(keywords, mesh, {"", "SANS_GROUP_NO_FR", "SANS_NOEUD_FR", "", ""});
  if (!keywords.has("DIRE_EXCL_FROT")) return zone;
  zone.frictionless_direction = direction_of(keywords, "DIRE_EXCL_FROT");
  if (zone.frictionless_nodes.empty())
    throw DiagnosticError(
        "missing-keyword",
        "DEFI_CONTACT: DIRE_EXCL_FROT is where the nodes of SANS_GROUP_NO_FR have no friction, and there is none",
        keywords.span_of("DIRE_EXCL_FROT"), "name them; or give COULOMB=0.0 where there is none along any direction");
  return zone;
}

// A discrete zone: what makes it more than inequalities (a penalty, friction, contact that never opens again).
solver::MixedZone discrete_zone(const Keywords& keywords) {
  solver::MixedZone zone;
  if (keywords.has("COULOMB") && keywords.text("ALGO_CONT") == "GCP")
    throw DiagnosticError("contradictory-keywords", "DEFI_CONTACT: projected conjugate gradients know no friction",
                          keywords.span_of("COULOMB"),
                          "write ALGO_CONT='CONTRAINTE' or 'PENALISATION', or take FORMULATION='CONTINUE'");
  zone.penalised = keywords.text("ALGO_CONT") == "PENALISATION";
  if (zone.penalised) zone.augmentation = keywords.real("E_N");
  zone.bilateral = keywords.text("GLISSIERE") == "OUI";
  if (zone.bilateral) zone.unnoticed_gap = keywords.real("ALARME_JEU");
  if (!keywords.has("COULOMB")) return zone;
  zone.friction = keywords.real("COULOMB");
  zone.friction_penalised = true;
  zone.friction_penalty = keywords.real("E_T");
  zone.secant_relief = keywords.real("COEF_MATR_FROT");
  return zone;
}

void take_algorithm(const Call& call, solver::ContactDefinition& definition) {
  if (call.factors("ZONE").front().text("ALGO_CONT") != "GCP") return;
  definition.algorithm = solver::ContactAlgorithm::projected_gradient;
  if (!call.has("RESI_ABSO"))
    throw DiagnosticError("missing-keyword",
                          "DEFI_CONTACT: ALGO_CONT='GCP' needs RESI_ABSO, the largest interpenetration left", call.span,
                          "give RESI_ABSO, 1e-6 of the size of a cell for instance");
  definition.gradient_tolerance = call.real("RESI_ABSO");
  definition.active_set_factor = static_cast<int>(call.integer("ITER_CONT_MULT"));
  definition.gradient_iterations = static_cast<int>(call.integer("ITER_GCP_MAXI"));
  definition.gradient_scaled = call.text("PRE_COND") == "DIRICHLET";
  definition.gradient_stays_admissible = call.text("RECH_LINEAIRE") == "ADMISSIBLE";
}

// The discrete formulation solves all zones together, by one algorithm (U4.44.11).
void check_one_algorithm(const Call& call) {
  const auto& zones = call.factors("ZONE");
  for (const Keywords& zone : zones) {
    if (zone.text("ALGO_CONT") == zones.front().text("ALGO_CONT")) continue;
    throw DiagnosticError("mixed-algorithms", "DEFI_CONTACT: all zones of the discrete formulation take one ALGO_CONT",
                          zone.span_of("ALGO_CONT"), "write " + zones.front().text("ALGO_CONT") + " here too");
  }
}

// One generalised Newton loop updates the geometry with everything else: the same as updates until it is at rest.
// Newton's method that stops at a change r leaves r^2; updates one after the other converge linearly and go on until
// they change as little.
void set_geometry_update(const Call& call, solver::ContactDefinition& definition) {
  constexpr int most_updates_by_newton = 100;
  constexpr double rounding = 1e-11;
  constexpr double tolerable = 0.01;  // what fixed points are content with
  definition.max_geometry_updates = most_updates_by_newton;
  definition.geometry_update =
      call.has("REAC_GEOM") ? geometry_update(call.text("REAC_GEOM")) : solver::GeometryUpdate::automatic;
  if (!call.has("RESI_GEOM")) return;
  const double change = call.real("RESI_GEOM");
  const bool by_newton = call.text("ALGO_RESO_GEOM") == "NEWTON";
  definition.geometry_tolerance = by_newton ? std::max(rounding, change * change) : change;
  if (!by_newton) return;
  definition.joint_geometry_tolerance = change;
  definition.restless_tolerance = std::max(tolerable, change);
}

// A normal that is given leaves nothing to be smoothed.
void check_smoothing(const Call& call) {
  if (call.text("LISSAGE") != "OUI") return;
  for (const Keywords& zone : call.factors("ZONE"))
    if (zone.has("VECT_MAIT") && zone.text("VECT_MAIT") != "AUTO")
      throw DiagnosticError("contradictory-keywords",
                            "DEFI_CONTACT: LISSAGE='OUI' smooths normals, and VECT_MAIT gives them",
                            zone.span_of("VECT_MAIT"), "leave out one of the two");
}

solver::ContactDefinition contact(const Call& call, const solver::Model& model) {
  check_smoothing(call);
  const solver::Mesh& mesh = *model.mesh;
  solver::ContactDefinition definition;
  const bool is_mixed = call.text("FORMULATION") == "CONTINUE";
  if (is_mixed) definition.formulation = solver::ContactFormulation::mixed;
  definition.smooth_normals = call.text("LISSAGE") == "OUI";
  set_geometry_update(call, definition);
  definition.has_friction = is_mixed && call.text("FROTTEMENT") == "COULOMB";
  definition.contact_by_newton = is_mixed && call.text("ALGO_RESO_CONT") == "NEWTON";
  const bool is_geometry_by_newton = call.text("ALGO_RESO_GEOM") == "NEWTON";
  definition.joint_iterations = definition.contact_by_newton && is_geometry_by_newton;
  if (definition.has_friction && !definition.contact_by_newton && !is_geometry_by_newton &&
      call.text("ALGO_RESO_FROT") == "NEWTON")
    definition.friction_tolerance = call.real("RESI_FROT");
  if (call.has("NB_ITER_GEOM")) definition.controlled_updates = static_cast<int>(call.integer("NB_ITER_GEOM"));
  if (call.has("ITER_GEOM_MAXI")) definition.max_geometry_updates = static_cast<int>(call.integer("ITER_GEOM_MAXI"));
  if (call.has("STOP_INTERP")) definition.stop_on_interpenetration = call.text("STOP_INTERP") == "OUI";
  if (!is_mixed) {
    check_one_algorithm(call);
    take_algorithm(call, definition);
  }
  for (const Keywords& keywords : call.factors("ZONE")) {
    solver::ContactZone& zone = definition.zones.emplace_back(contact_zone(keywords, mesh));
    check_surface(keywords, "GROUP_MA_MAIT", zone.master_cells, model);
    check_surface(keywords, "GROUP_MA_ESCL", zone.slave_cells, model);
    check_sides(keywords, zone, mesh);
    take_half_thickness(keywords, model, zone);
    zone.mixed = is_mixed ? mixed_zone(keywords, mesh) : discrete_zone(keywords);
    if (call.text("VERI_NORM") != "OUI") continue;
    check_normals(keywords, "GROUP_MA_MAIT", zone.master_cells, mesh);
    check_normals(keywords, "GROUP_MA_ESCL", zone.slave_cells, mesh);
    if (zone.master_normal != solver::NormalRule::fixed)
      check_sides_of_sheets(keywords, "GROUP_MA_MAIT", zone.master_cells, mesh);
    if (zone.normal_side != solver::NormalSide::master && zone.slave_normal != solver::NormalRule::fixed)
      check_sides_of_sheets(keywords, "GROUP_MA_ESCL", zone.slave_cells, mesh);
  }
  for (const solver::ContactZone& zone : definition.zones)
    if (zone.mixed.local_average) solver::patches_of(zone, mesh);  // tells slave faces that were not cut
  return definition;
}

}  // namespace

Product defi_contact(const Call& call, Context& context) {
  auto product = std::make_shared<ContactConcept>();
  product->model = call.data<ModelConcept>("MODELE").model;
  const solver::Model& model = *product->model;
  if (call.text("FORMULATION") == "LIAISON_UNIL") {
    if (call.text("FROTTEMENT") == "COULOMB") {
      throw DiagnosticError("excluded-keyword", "DEFI_CONTACT: unilateral conditions know no friction",
                            call.span_of("FROTTEMENT"), "take FORMULATION='DISCRETE' or 'CONTINUE'");
    }
    std::vector<solver::UnilateralCondition> conditions;
    for (const Keywords& zone : call.factors("ZONE")) conditions.push_back(unilateral(zone, model));
    product->conditions = std::move(conditions);
  } else {
    solver::ContactDefinition definition = contact(call, model);
    warn_of_contact(call, definition, model, context.diagnostics);
    product->conditions = std::move(definition);
  }
  return product;
}

}  // namespace comma::commands
