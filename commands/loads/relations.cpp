// LIAISON_...: relations between the displacements of nodes.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include "commands/analysis/result_reading.hpp"
#include "commands/fields/field_types.hpp"
#include "commands/functions/functions.hpp"
#include "commands/loads/load_building.hpp"
#include "commands/points.hpp"
#include "commands/selection.hpp"
#include "interpreter/diagnostic.hpp"
#include "solver/constraints/directions.hpp"
#include "solver/constraints/embedding.hpp"
#include "solver/constraints/facing_nodes.hpp"
#include "solver/constraints/rigid_link.hpp"
#include "solver/constraints/section_link.hpp"
#include "solver/constraints/weighted_average.hpp"
#include "solver/mesh/groups.hpp"

namespace comma::commands {

using interpreter::DiagnosticError;
using interpreter::Keywords;
using solver::Component;

namespace {

using Relations = std::vector<solver::LinearRelation>;

void append(Relations& to, Relations relations) { std::ranges::move(relations, std::back_inserter(to)); }

void require_same_count(const Keywords& keywords, const std::string& keyword, std::size_t count, std::size_t wanted,
                        const char* what) {
  if (count == wanted) return;
  throw DiagnosticError("wrong-count", fmt::format("{} has {} values for {} {}", keyword, count, wanted, what),
                        keywords.span_of(keyword), "each term of the relation takes one");
}

// COEF_MULT, or the functions COEF_MULT_FONC at the node of each term: relations do not change with time, so these may
// not either.
std::vector<double> factors_of_terms(const Keywords& keywords, const solver::Mesh& mesh,
                                     const std::vector<int>& nodes) {
  const char* name = keywords.given("COEF_MULT_FONC") ? "COEF_MULT_FONC" : "COEF_MULT";
  if (keywords.given("COEF_MULT")) {
    const auto factors = keywords.reals(name);
    require_same_count(keywords, name, factors.size(), nodes.size(), "nodes");
    return factors;
  }
  const auto& functions = keywords.concepts(name);
  require_same_count(keywords, name, functions.size(), nodes.size(), "nodes");
  std::vector<double> factors;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const auto& parameters = interpreter::data_of<FunctionConcept>(functions[i], name).parameters();
    if (std::ranges::find(parameters, "INST") != parameters.end()) {
      throw DiagnosticError(
          "unsupported",
          "COEF_MULT_FONC: " + functions[i]->name + " depends on INST, and relations do not change with time",
          keywords.span_of(name), "let it depend on X, Y, Z");
    }
    factors.push_back(
        field_function(functions[i], keywords.span_of(name))(mesh.nodes[static_cast<std::size_t>(nodes[i])], 0.0));
  }
  return factors;
}

// LIAISON_DDL: one relation, a term for each node listed.
Relations between_terms(const Keywords& keywords, const LoadedModel& target, const solver::Origin& origin) {
  const auto nodes = listed_nodes(keywords, target.mesh, "GROUP_NO", "NOEUD");
  const auto components = keywords.texts("DDL");
  const auto factors = factors_of_terms(keywords, target.mesh, nodes);
  require_same_count(keywords, "DDL", components.size(), nodes.size(), "nodes");
  const Amount amount = amount_of(keywords, "COEF_IMPO");
  solver::LinearRelation relation{{}, amount.value, amount.function, origin};
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Component component = component_named(keywords, "DDL", components[i]);
    if (target.dofs.dof(nodes[i], component) < 0) {
      throw DiagnosticError(
          "unknown-component",
          fmt::format("LIAISON_DDL: {} does not carry {}", target.mesh.node_name(nodes[i]), components[i]),
          keywords.span_of("DDL"));
    }
    relation.terms.push_back({nodes[i], component, factors[i]});
  }
  return {std::move(relation)};
}

// One side of LIAISON_GROUP, whose keywords end in its number.
struct Side {
  std::vector<int> nodes;
  std::vector<int> cells;  ///< of GROUP_MA and MAILLE: they give the normals
  std::vector<solver::FacingTerm> terms;
  std::map<int, Eigen::Vector3d> normals;
};

Side side_of(const Keywords& keywords, const LoadedModel& target, const std::string& number) {
  const PlaceKeywords names = {"", "GROUP_NO_" + number, "NOEUD_" + number, "GROUP_MA_" + number, "MAILLE_" + number};
  Side side;
  side.nodes = needed(selected_nodes(keywords, target.mesh, names), keywords, "node on one of its sides");
  side.cells = selected_cells(keywords, target.mesh, names);
  if (keywords.given("SOMMET")) {
    // Of nodes that are named themselves those are corners that are corners of any cell.
    std::vector<int> cells = side.cells;
    for (int cell = 0; side.cells.empty() && cell < target.mesh.cell_count(); ++cell) cells.push_back(cell);
    const auto corners = solver::nodes_of_cells(target.mesh, cells, solver::NodeRole::corner);
    std::erase_if(side.nodes, [&](int node) { return !std::ranges::binary_search(corners, node); });
  }
  const auto components = keywords.texts("DDL_" + number);
  const auto factors = keywords.reals("COEF_MULT_" + number);
  require_same_count(keywords, "COEF_MULT_" + number, factors.size(), components.size(), "components");
  for (std::size_t i = 0; i < components.size(); ++i) {
    const bool normal = components[i] == "DNOR";
    side.terms.push_back(
        {normal ? std::nullopt : std::optional(component_named(keywords, "DDL_" + number, components[i])), factors[i]});
    if (normal && side.normals.empty()) side.normals = solver::mean_normals(target.mesh, side.cells);
  }
  return side;
}

solver::Placement placement(const Keywords& keywords) {
  solver::Placement placement;
  const auto vector = [&](const char* name) -> Eigen::Vector3d {
    Eigen::Vector3d value = Eigen::Vector3d::Zero();
    const auto values = keywords.reals(name);
    for (std::size_t i = 0; i < values.size(); ++i) value[static_cast<Eigen::Index>(i)] = values[i];
    return value;
  };
  // Angles turn the body from the global axes to the turned ones: the rows of the axes are its columns.
  placement.rotation = axes_of_angles(keywords.reals("ANGL_NAUT")).transpose();
  placement.centre = vector("CENTRE");
  placement.translation = vector("TRAN");
  return placement;
}

// What is left out (SANS_GROUP_NO ...) takes whole pairs with it (U4.44.01). Where it alone makes the sides match, it
// is left out before nodes are paired.
std::vector<solver::NodePair> pairs_left(const Keywords& keywords, const solver::Mesh& mesh, std::vector<int> first,
                                         std::vector<int> second) {
  const double farthest =
      keywords.has("DIST_MAX") ? keywords.real("DIST_MAX") : std::numeric_limits<double>::infinity();
  const auto is_left_out = [left_out = excluded_nodes(keywords, mesh)](int node) { return left_out.contains(node); };
  if (first.size() != second.size()) {
    std::erase_if(first, is_left_out);
    std::erase_if(second, is_left_out);
  }
  auto pairs = solver::facing_nodes(mesh, first, second, placement(keywords), farthest);
  std::erase_if(pairs,
                [&](const solver::NodePair& pair) { return is_left_out(pair.first) || is_left_out(pair.second); });
  return pairs;
}

Relations between_facing_nodes(const Keywords& keywords, const LoadedModel& target, const solver::Origin& origin) {
  const Side first = side_of(keywords, target, "1"), second = side_of(keywords, target, "2");
  const auto pairs = pairs_left(keywords, target.mesh, first.nodes, second.nodes);
  const Amount amount = amount_of(keywords, "COEF_IMPO");
  return solver::facing_relations(target.mesh, pairs, first.terms, second.terms, first.normals, second.normals,
                                  amount.value, amount.function, origin);
}

Relations uniform_displacement(const Keywords& keywords, const LoadedModel& target, const solver::Origin& origin) {
  const auto nodes = needed(remaining_nodes(keywords, target.mesh), keywords, "node");
  Relations relations;
  for (const std::string& name : keywords.texts("DDL"))
    append(relations, solver::uniform(nodes, component_named(keywords, "DDL", name), origin));
  return relations;
}

// LIAISON_SOLIDE with a given motion: u = TRAN + (R - 1) (x - CENTRE).
Relations moved_body(const Keywords& keywords, const LoadedModel& target, const solver::Origin& origin) {
  constexpr double rounding = 1e-14;
  const solver::Placement motion = placement(keywords);
  Relations relations;
  for (const int node : needed(remaining_nodes(keywords, target.mesh), keywords, "node")) {
    const Eigen::Vector3d arm =
        Eigen::Vector3d(target.mesh.nodes[static_cast<std::size_t>(node)].data()) - motion.centre;
    const Eigen::Vector3d moved = motion.translation + motion.rotation * arm - arm;
    if (target.dofs.dof(node, Component::drz) >= 0) {
      throw DiagnosticError(
          "unsupported",
          fmt::format("LIAISON_SOLIDE: {} has rotations, and a given motion is known of nodes without them",
                      target.mesh.node_name(node)),
          keywords.span, "impose DX ... DRZ by DDL_IMPO");
    }
    for (int c = 0; c < 3; ++c) {
      const auto component = static_cast<Component>(c);
      if (target.dofs.dof(node, component) >= 0) {
        relations.push_back({{{node, component, 1.0}}, moved[c], {}, origin});
      } else if (target.dofs.dof(node, Component::dx) >= 0 &&
                 std::abs(moved[c]) > rounding * (motion.translation.norm() + arm.norm())) {
        throw DiagnosticError(
            "unknown-component",
            fmt::format("LIAISON_SOLIDE: the motion takes {} by {:.6g} along {}, which it does not carry",
                        target.mesh.node_name(node), moved[c], solver::name_of(component)),
            keywords.span_of(keywords.given("ANGL_NAUT") ? "ANGL_NAUT" : "TRAN"),
            "keep the motion in the plane of the model: the first angle of ANGL_NAUT alone turns about Z");
      }
    }
  }
  return relations;
}

void add_rigid_body(const Keywords& keywords, const LoadedModel& target, solver::Load& load) {
  const solver::Origin origin = origin_of(keywords, "LIAISON_SOLIDE");
  if (keywords.given("TRAN") || keywords.given("ANGL_NAUT"))
    return append(load.relations, moved_body(keywords, target, origin));
  const double coincidence =
      keywords.has("DIST_MIN") ? keywords.real("DIST_MIN") : solver::default_coincidence(target.mesh);
  const solver::RigidLink& link = load.rigid_links.emplace_back(
      needed(remaining_nodes(keywords, target.mesh), keywords, "node"), coincidence, origin);
  Relations relations = solver::rigid_link(target.mesh, target.dofs, link.nodes, coincidence, origin);
  for (solver::LinearRelation& relation : relations)
    relation.rigid_link = static_cast<int>(load.rigid_links.size()) - 1;
  append(load.relations, std::move(relations));
}

// The thickness of the plate at an edge: what COQUE gives to the edge itself, else to the plates that it bounds.
double thickness_at(int edge, const PropertiesConcept& properties, const Keywords& keywords, const solver::Mesh& mesh) {
  if (const auto own = properties.named_plates.find(edge); own != properties.named_plates.end())
    return own->second.thickness;
  const auto nodes = mesh.cell(edge);
  std::optional<double> found;
  for (const auto& [cell, plate] : properties.properties->plates) {
    const auto around = mesh.cell(cell);
    const bool bounds = std::ranges::all_of(
        nodes, [&](int node) { return std::find(around.begin(), around.end(), node) != around.end(); });
    if (!bounds) continue;
    if (found && *found != plate.thickness)
      throw DiagnosticError(
          "ambiguous-thickness",
          fmt::format("LIAISON_ELEM: edge {} bounds plates of different thickness", mesh.cell_name(edge)),
          keywords.span, "name the edge in AFFE_CARA_ELEM/COQUE too");
    found = plate.thickness;
  }
  if (found) return *found;
  throw DiagnosticError("missing-properties",
                        fmt::format("LIAISON_ELEM: edge {} bounds no plate that CARA_ELEM knows", mesh.cell_name(edge)),
                        keywords.span_of("CARA_ELEM"), "COQUE of AFFE_CARA_ELEM gives its thickness");
}

solver::SectionLink plate_link(const Keywords& keywords, const LoadedModel& target, const std::vector<int>& section,
                               int node, const solver::Origin& origin) {
  const auto& properties = keywords.data<PropertiesConcept>("CARA_ELEM");
  std::vector<solver::PlateEdge> edges;
  for (const int cell : section) edges.push_back({cell, thickness_at(cell, properties, keywords, target.mesh)});
  return solver::plate_section_link(target.mesh, edges, vector_of(keywords, "AXE_POUTRE"), node, origin);
}

// LIAISON_ELEM: 3D_POU, 2D_POU and COQ_POU.
Relations beam_on_section(const Keywords& keywords, const LoadedModel& target, const solver::Origin& origin) {
  const auto section = needed(selected_cells(keywords, target.mesh, {"", "", "", "GROUP_MA_1", "MAILLE_1"}), keywords,
                              "cell of the section");
  const int node = single_node(keywords, "NOEUD_2", "GROUP_NO_2", target.mesh);
  solver::SectionLink link = keywords.text("OPTION") == "COQ_POU"
                                 ? plate_link(keywords, target, section, node, origin)
                                 : solver::section_link(target.mesh, section, node, origin);
  // U4.44.01, LIAISON_ELEM: the beam must end at the centroid of the section.
  constexpr double allowed_offset = 0.05;
  if (keywords.text("VERIF_EXCENT") == "OUI" && link.offset > allowed_offset * link.size) {
    throw DiagnosticError("offset-beam",
                          fmt::format("LIAISON_ELEM: {} lies {:.4g} from the centroid ({:.6g}, {:.6g}, {:.6g}) of the "
                                      "section, whose size is {:.4g}",
                                      target.mesh.node_name(node), link.offset, link.centroid[0], link.centroid[1],
                                      link.centroid[2], link.size),
                          keywords.span, "end the beam at the centroid, or write VERIF_EXCENT=\"NON\"");
  }
  return std::move(link.relations);
}

// "DX-DY-DZ" of DDL_ESCL.
solver::ComponentMask component_mask(const Keywords& keywords, const std::string& joined) {
  solver::ComponentMask mask = 0;
  for (std::size_t begin = 0; begin <= joined.size();) {
    const std::size_t end = std::min(joined.find('-', begin), joined.size());
    mask |= solver::mask_of(component_named(keywords, "DDL_ESCL", joined.substr(begin, end - begin)));
    begin = end + 1;
  }
  return mask;
}

Relations mean_motion(const Keywords& keywords, const LoadedModel& target, const solver::Origin& origin) {
  const int follower = single_node(keywords, "NOEUD_MAIT", "GROUP_NO_MAIT", target.mesh);
  solver::ComponentMask following = 0;
  for (const std::string& name : keywords.texts("DDL_MAIT"))
    following |= solver::mask_of(component_named(keywords, "DDL_MAIT", name));
  const auto nodes = needed(listed_nodes(keywords, target.mesh, "GROUP_NO_ESCL", "NOEUD_ESCL"), keywords, "slave node");
  const auto components = keywords.texts("DDL_ESCL");
  const auto weights = keywords.given("COEF_ESCL") ? keywords.reals("COEF_ESCL") : std::vector<double>{1.0};
  // One value stands for all nodes.
  if (components.size() != 1) require_same_count(keywords, "DDL_ESCL", components.size(), nodes.size(), "nodes");
  if (weights.size() != 1) require_same_count(keywords, "COEF_ESCL", weights.size(), nodes.size(), "nodes");
  std::vector<solver::AverageNode> leaders;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    leaders.push_back({nodes[i], component_mask(keywords, components[components.size() == 1 ? 0 : i]),
                       weights[weights.size() == 1 ? 0 : i]});
  }
  return solver::weighted_average(target.mesh, target.dofs, follower, following, leaders, origin);
}

// LIAISON_COQUE: nodes that face each other move as one rigid body.
Relations joined_shells(const Keywords& keywords, const LoadedModel& target, const solver::Origin& origin) {
  const auto nodes_of = [&](const std::string& number) {
    return needed(
        remaining_nodes(keywords, target.mesh,
                        {"", "GROUP_NO_" + number, "NOEUD_" + number, "GROUP_MA_" + number, "MAILLE_" + number},
                        "_" + number),
        keywords, "node on one of its sides");
  };
  Relations relations;
  for (const solver::NodePair& pair : solver::facing_nodes(target.mesh, nodes_of("1"), nodes_of("2"))) {
    const std::array<int, 2> ends = {pair.first, pair.second};
    append(relations, solver::rigid_link(target.mesh, target.dofs, ends, 0.0, origin));
  }
  return relations;
}

// LIAISON_CHAMNO: the work of a field of forces is given.
Relations weighted_by_field(const Keywords& keywords, const LoadedModel& target, const solver::Origin& origin) {
  solver::LinearRelation relation{terms_of_field(keywords, target), keywords.real("COEF_IMPO"), {}, origin};
  std::erase_if(relation.terms, [](const auto& term) { return term.coefficient == 0.0; });
  return {std::move(relation)};
}

// Rotations of shells are neither turned nor along a normal.
void require_solids(const Keywords& keywords) {
  for (const char* keyword : {"DDL_ESCL", "TRAN", "ANGL_NAUT"}) {
    if (!keywords.given(keyword)) continue;
    throw DiagnosticError("unsupported", fmt::format("LIAISON_MAIL: {} goes with TYPE_RACCORD='MASSIF' alone", keyword),
                          keywords.span_of(keyword), "tie nodes that face each other by LIAISON_GROUP");
  }
}

// The field of normals, by node.
std::map<int, Eigen::Vector3d> normals_of_field(const Keywords& keywords, const LoadedModel& target) {
  const FieldConcept& data = number_field(keywords.concept_of("CHAM_NORMALE"), keywords, "CHAM_NORMALE");
  const auto* field = std::get_if<solver::NodalField>(&data.field);
  if (field == nullptr || data.mesh.get() != &target.mesh)
    throw DiagnosticError("incompatible-field", "LIAISON_MAIL: CHAM_NORMALE is no field at nodes of this mesh",
                          keywords.span_of("CHAM_NORMALE"), "make it by CREA_CHAMP, OPERATION='NORMALE'");
  const std::array<int, 3> columns = {component_of(keywords, field->components, "X", "CHAM_NORMALE"),
                                      component_of(keywords, field->components, "Y", "CHAM_NORMALE"),
                                      component_of(keywords, field->components, "Z", "CHAM_NORMALE")};
  std::map<int, Eigen::Vector3d> normals;
  for (int node = 0; node < target.mesh.node_count(); ++node) {
    const Eigen::Vector3d normal(field->at(node, columns[0]), field->at(node, columns[1]), field->at(node, columns[2]));
    if (normal.allFinite()) normals.emplace(node, normal);
  }
  return normals;
}

Relations glued_nodes(const Keywords& keywords, const LoadedModel& target, const std::set<int>& glued,
                      const solver::Origin& origin) {
  const auto hosts =
      needed(selected_cells(keywords, target.mesh, {"", "", "", "GROUP_MA_MAIT", ""}), keywords, "master cell");
  auto nodes = needed(selected_nodes(keywords, target.mesh, {"", "GROUP_NO_ESCL", "", "GROUP_MA_ESCL", ""}), keywords,
                      "slave node");
  std::erase_if(nodes, [&](int node) { return glued.contains(node); });
  const double farthest =
      keywords.has("DISTANCE_MAX") ? keywords.real("DISTANCE_MAX") : std::numeric_limits<double>::infinity();
  const bool is_moved = keywords.given("TRAN") || keywords.given("ANGL_NAUT");
  if (keywords.text("TYPE_RACCORD") != "MASSIF") {
    require_solids(keywords);
    if (keywords.text("TYPE_RACCORD") == "COQUE_MASSIF")
      return solver::fibre_relations(target.mesh, target.dofs, nodes, hosts, normals_of_field(keywords, target),
                                     keywords.real("EPAIS"), farthest, origin);
    const auto relations_to =
        keywords.text("TYPE_RACCORD") == "COQUE" ? solver::shell_joint_relations : solver::shell_embedding_relations;
    return relations_to(target.mesh, target.dofs, solver::embed(target.mesh, nodes, hosts, farthest), origin);
  }
  const solver::Placement movement = placement(keywords);
  const auto embeddings = is_moved ? solver::embed_moved(target.mesh, nodes, hosts, movement, farthest)
                                   : solver::embed(target.mesh, nodes, hosts, farthest);
  if (!keywords.given("DDL_ESCL"))
    return solver::embedding_relations(target.mesh, target.dofs, embeddings, origin, movement.rotation);
  const auto normals =
      solver::mean_normals(target.mesh, selected_cells(keywords, target.mesh, {"", "", "", "GROUP_MA_ESCL", ""}));
  return solver::normal_embedding_relations(target.mesh, target.dofs, embeddings, normals, origin, movement.rotation);
}

// A node that an earlier occurrence has glued stays as it is, unless ELIM_MULT='OUI' lets it be eliminated several
// times.
void add_glued_nodes(const Keywords& call, const LoadedModel& target, Relations& relations) {
  std::set<int> glued;
  for (const Keywords& occurrence : call.factors("LIAISON_MAIL")) {
    const Relations found =
        glued_nodes(occurrence, target, occurrence.text("ELIM_MULT") == "OUI" ? std::set<int>() : glued,
                    origin_of(occurrence, "LIAISON_MAIL"));
    for (const auto& relation : found) glued.insert(relation.terms.front().node);
    append(relations, found);
  }
}

struct RelationKeyword {
  const char* name;
  Relations (*relations)(const Keywords&, const LoadedModel&, const solver::Origin&);
};

constexpr RelationKeyword relation_keywords[] = {
    {"LIAISON_DDL", between_terms},         {"LIAISON_GROUP", between_facing_nodes},
    {"LIAISON_UNIF", uniform_displacement}, {"LIAISON_ELEM", beam_on_section},
    {"LIAISON_RBE3", mean_motion},          {"LIAISON_COQUE", joined_shells},
    {"LIAISON_CHAMNO", weighted_by_field}};

}  // namespace

void add_relations(const Keywords& call, const LoadedModel& target, solver::Load& load) {
  for (const RelationKeyword& keyword : relation_keywords) {
    for (const Keywords& occurrence : call.factors(keyword.name)) {
      append(load.relations, keyword.relations(occurrence, target, origin_of(occurrence, keyword.name)));
    }
  }
  for (const Keywords& occurrence : call.factors("LIAISON_SOLIDE")) add_rigid_body(occurrence, target, load);
  add_glued_nodes(call, target, load.relations);
}

}  // namespace comma::commands
