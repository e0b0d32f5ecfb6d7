#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <optional>

#include "commands/analysis/result_reading.hpp"
#include "commands/commands.hpp"
#include "commands/fields/field_types.hpp"
#include "commands/selection.hpp"
#include "interpreter/diagnostic.hpp"
#include "solver/fields/data/field_parts.hpp"
#include "solver/fields/data/field_room.hpp"
#include "solver/fields/points/projection.hpp"
#include "solver/mesh/groups.hpp"
#include "solver/mesh/place.hpp"

namespace comma::commands {

namespace {

using interpreter::DiagnosticError;

// One side of a projection: a mesh, and the elements on it where a model is given.
struct ProjectedSide {
  std::shared_ptr<const solver::Mesh> mesh;
  std::shared_ptr<const solver::Model> model;
};

ProjectedSide side_of(const Call& call, const std::string& number) {
  if (call.has("MAILLAGE_" + number)) return {call.data<MeshConcept>("MAILLAGE_" + number).mesh, nullptr};
  const auto& model = call.data<ModelConcept>("MODELE_" + number).model;
  return {model->mesh, model};
}

// Cells of the dimension that CAS_FIGURE names; of the highest one by default.
std::vector<int> hosts_of(const Call& call, const ProjectedSide& from) {
  std::vector<int> bulk = from.model ? solver::bulk_cells(*from.model) : solver::bulk_cells(*from.mesh);
  if (!call.has("CAS_FIGURE")) return bulk;
  static const std::map<std::string, int> dimensions = {{"2D", 2}, {"3D", 3}, {"2.5D", 2}, {"1.5D", 1}};
  const int wanted = dimensions.at(call.text("CAS_FIGURE"));
  std::vector<int> cells;
  for (int cell = 0; cell < from.mesh->cell_count(); ++cell) {
    const bool carries = !from.model || from.model->formulations[cell] != solver::Formulation::none;
    if (carries && solver::dimension(from.mesh->cell_types[cell]) == wanted) cells.push_back(cell);
  }
  if (cells.empty())
    throw DiagnosticError("empty-group", "PROJ_CHAMP: no cell there has the dimension that CAS_FIGURE names",
                          call.span_of("CAS_FIGURE"));
  return cells;
}

std::vector<int> targets_of(const ProjectedSide& to) {
  std::vector<int> nodes;
  if (!to.model) {
    for (int node = 0; node < to.mesh->node_count(); ++node) nodes.push_back(node);
    return nodes;
  }
  std::vector<int> cells;
  for (int cell = 0; cell < to.mesh->cell_count(); ++cell)
    if (to.model->formulations[cell] != solver::Formulation::none) cells.push_back(cell);
  return to.mesh->nodes_of_cells(cells);
}

// TRANSF_GEOM_1, TRANSF_GEOM_2: where nodes are taken to be, functions of X, Y and Z.
std::vector<Eigen::Vector3d> moved_places(const Call& call, const std::string& keyword, const solver::Mesh& mesh) {
  std::vector<Eigen::Vector3d> at = solver::places(mesh);
  if (!call.has(keyword)) return at;
  std::vector<solver::FieldFunction> coordinates;
  for (const auto& handle : call.concepts(keyword))
    coordinates.push_back(field_function(handle, call.span_of(keyword)));
  for (std::size_t node = 0; node < at.size(); ++node)
    for (std::size_t i = 0; i < coordinates.size(); ++i)
      at[node][static_cast<Eigen::Index>(i)] = coordinates[i](mesh.nodes[node], 0.0);
  return at;
}

// Where each node of the second mesh lies in the first; cell -1 where it has no place.
struct Meeting {
  ProjectedSide from, to;
  std::vector<solver::Embedding> hosts;
};

void place_nodes(Meeting& meeting, const solver::Mesh& moved, const std::vector<Eigen::Vector3d>& at,
                 const std::vector<int>& cells, const std::vector<int>& nodes, double farthest) {
  std::vector<Eigen::Vector3d> wanted;
  for (const int node : nodes) wanted.push_back(at[static_cast<std::size_t>(node)]);
  for (solver::Embedding& host : solver::embed_places(moved, wanted, cells, farthest)) {
    host.node = nodes[static_cast<std::size_t>(host.node)];
    solver::Embedding& known = meeting.hosts[static_cast<std::size_t>(host.node)];
    if (host.cell >= 0 && (known.cell < 0 || host.distance < known.distance)) known = std::move(host);
  }
}

Meeting meet(const Call& call) {
  Meeting meeting{side_of(call, "1"), side_of(call, "2"), {}};
  const solver::Mesh& mesh = *meeting.from.mesh;
  for (int node = 0; node < meeting.to.mesh->node_count(); ++node) meeting.hosts.push_back({node, -1, {}, 0.0});
  const double farthest =
      call.given("DISTANCE_MAX") ? call.real("DISTANCE_MAX") : std::numeric_limits<double>::infinity();
  solver::Mesh moved = mesh;
  const auto moved_nodes = moved_places(call, "TRANSF_GEOM_1", mesh);
  std::ranges::transform(moved_nodes, moved.nodes.begin(), solver::to_point);
  const auto at = moved_places(call, "TRANSF_GEOM_2", *meeting.to.mesh);
  const auto bulk = hosts_of(call, meeting.from);
  const auto targets = targets_of(meeting.to);
  if (!call.has("VIS_A_VIS")) {
    place_nodes(meeting, moved, at, bulk, targets, farthest);
    return meeting;
  }
  for (const Keywords& facing : call.factors("VIS_A_VIS")) {
    const auto cells = selected_cells(facing, mesh, {"TOUT_1", "", "", "GROUP_MA_1", "MAILLE_1"});
    const auto nodes =
        selected_nodes(facing, *meeting.to.mesh, {"TOUT_2", "GROUP_NO_2", "NOEUD_2", "GROUP_MA_2", "MAILLE_2"});
    // Groups of skins alone are hosts themselves (Code_Aster 17.3).
    auto hosts = solver::intersection_of(std::vector<std::vector<int>>{bulk, cells});
    if (hosts.empty() && !call.has("CAS_FIGURE")) hosts = solver::highest_cells(mesh, cells);
    place_nodes(meeting, moved, at, hosts, solver::intersection_of(std::vector<std::vector<int>>{nodes, targets}),
                farthest);
  }
  return meeting;
}

// Each element of the second model has what its nodes have.
solver::ElementField at_nodes_of_elements(const solver::NodalField& at_nodes, const solver::Model& model) {
  solver::ElementField made =
      solver::empty_element_field(model, at_nodes.quantity, solver::Support::element_node, at_nodes.components, false);
  const std::size_t width = made.components.size();
  for (int cell = 0; cell < model.mesh->cell_count(); ++cell)
    for (int point = 0; point < made.points(cell); ++point)
      for (std::size_t c = 0; c < width; ++c)
        made.values[static_cast<std::size_t>(made.starts[cell] + point) * width + c] =
            at_nodes.at(model.mesh->cell(cell)[point], static_cast<int>(c));
  solver::drop_empty_cells(made);
  return made;
}

bool is_projectable(const solver::Field& field) {
  const FieldPlace place = place_of(field);
  return (place == FieldPlace::node || place == FieldPlace::element_node) && !is_layered(field);
}

solver::Field projected(const Call& call, const Meeting& meeting, const solver::Field& field) {
  const auto* nodal = std::get_if<solver::NodalField>(&field);
  solver::NodalField made = nodal != nullptr ? solver::at_places(*meeting.from.mesh, *nodal, meeting.hosts)
                                             : solver::at_places(std::get<solver::ElementField>(field), meeting.hosts);
  solver::Field result = std::move(made);
  if (call.text("PROL_ZERO") == "OUI") solver::fill_absent(result, 0.0);
  if (nodal == nullptr && meeting.to.model && !call.has("TYPE_CHAM"))
    result = at_nodes_of_elements(std::get<solver::NodalField>(result), *meeting.to.model);
  return result;
}

[[noreturn]] void tell_unprojectable(const Call& call, const char* keyword, const std::string& name) {
  throw DiagnosticError("unsupported",
                        fmt::format("PROJ_CHAMP: {} has no values at nodes, from which the others come", name),
                        call.span_of(keyword), "give a field at nodes (..._NOEU) or at the nodes of cells (..._ELNO)");
}

void require_source_mesh(const Call& call, const char* keyword, const solver::Mesh& own, const Meeting& meeting) {
  if (&own == meeting.from.mesh.get()) return;
  throw DiagnosticError("incompatible-field", "PROJ_CHAMP: what is projected lies on another mesh than the first",
                        call.span_of(keyword), "give the mesh or model on which it was computed first");
}

std::shared_ptr<FieldConcept> projected_field(const Call& call, const Meeting& meeting) {
  const FieldConcept& data = number_field(call.concept_of("CHAM_GD"), call, "CHAM_GD");
  require_source_mesh(call, "CHAM_GD", *data.mesh, meeting);
  if (!is_projectable(data.field)) tell_unprojectable(call, "CHAM_GD", call.concept_of("CHAM_GD")->name);
  auto product = std::make_shared<FieldConcept>();
  product->field = projected(call, meeting, data.field);
  product->mesh = meeting.to.mesh;
  product->model = meeting.to.model;
  return product;
}

// The fields of a step that NOM_CHAM names, or all that have values at nodes.
void project_step(const Call& call, const Meeting& meeting, const solver::ResultStep& step,
                  solver::ResultStep& target) {
  const auto names = call.texts("NOM_CHAM");
  for (const std::string& name : names) {
    const auto found = step.fields.find(name);
    if (found == step.fields.end()) continue;
    if (!is_projectable(found->second)) tell_unprojectable(call, "NOM_CHAM", name);
    target.fields.insert_or_assign(name, projected(call, meeting, found->second));
  }
  if (!names.empty()) return;
  for (const auto& [name, field] : step.fields)
    if (is_projectable(field)) target.fields.insert_or_assign(name, projected(call, meeting, field));
}

std::shared_ptr<ResultConcept> projected_result(const Call& call, const Meeting& meeting) {
  const auto& source = call.data<ResultConcept>("RESULTAT");
  require_source_mesh(call, "RESULTAT", source.result.mesh(), meeting);
  auto product = std::make_shared<ResultConcept>();
  product->result.model = meeting.to.model;
  product->result.bare_mesh = meeting.to.mesh;
  product->problem.model = meeting.to.model;
  product->problem.properties = std::make_shared<const solver::ElementProperties>();
  for (const solver::ResultStep* step : selected_steps(call, source.result)) {
    solver::ResultStep target = solver::without_fields(*step);
    project_step(call, meeting, *step, target);
    if (!target.fields.empty()) product->result.steps.push_back(std::move(target));
  }
  if (product->result.steps.empty())
    throw DiagnosticError("unknown-field", "PROJ_CHAMP: no step has a field that can be projected", call.span,
                          "name fields of the result by NOM_CHAM, or compute some at nodes");
  return product;
}

}  // namespace

Product proj_champ(const Call& call, Context& context) {
  warn_of_missing_instants("PROJ_CHAMP", call, context.diagnostics);
  const Meeting meeting = meet(call);
  const auto lost = std::ranges::count_if(meeting.hosts, [](const auto& host) { return host.cell < 0; });
  if (lost == std::ssize(meeting.hosts))
    throw DiagnosticError("no-host", "PROJ_CHAMP: no node of the second mesh has a place in the first", call.span,
                          "look at where they lie, at VIS_A_VIS and at DISTANCE_MAX");
  if (call.has("CHAM_GD")) return projected_field(call, meeting);
  return projected_result(call, meeting);
}

}  // namespace comma::commands
