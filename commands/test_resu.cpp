#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <set>

#include "commands/analysis/result_reading.hpp"
#include "commands/commands.hpp"
#include "commands/fields/field_types.hpp"
#include "commands/selection.hpp"
#include "commands/tables/reductions.hpp"
#include "interpreter/diagnostic.hpp"

namespace comma::commands {

namespace {

using interpreter::DiagnosticError;
using solver::ElementField;
using solver::NodalField;

// The values that a test ranges over, gathered before TYPE_TEST reduces them.
using Values = std::vector<double>;

double reduced(const Keywords& test, const Values& values) {
  const std::string& type = test.text("TYPE_TEST");
  if (type == "MAX") return greatest(values);
  if (type == "MIN") return least(values);
  return type == "SOMM" ? sum_of(values) : sum_of_sizes(values);
}

[[noreturn]] void not_carried(const Keywords& test, const std::string& place) {
  const char* keyword = test.given("NOM_VARI") ? "NOM_VARI" : "NOM_CMP";
  throw DiagnosticError("unknown-component",
                        fmt::format("{} does not carry {} there", place, fmt::join(test.texts(keyword), ", ")),
                        test.span_of(keyword));
}

int single(const Keywords& test, const std::vector<int>& found, const std::string& keyword, const char* what) {
  if (found.size() == 1) return found.front();
  if (keyword.empty()) {
    throw DiagnosticError(
        "missing-keyword",
        fmt::format("TEST_RESU: the field has its values on {}s, and no keyword names the one to test", what),
        test.span,
        fmt::format("give {}, a group of one {}", std::string(what) == "cell" ? "GROUP_MA" : "GROUP_NO", what));
  }
  throw DiagnosticError("wrong-count",
                        fmt::format("{} names {} {}s; a value is tested at one", keyword, found.size(), what),
                        test.span_of(keyword), "name a group of one, or use TYPE_TEST over several");
}

std::string place_keyword(const Keywords& test, const PlaceKeywords& names) {
  for (const std::string* name : {&names.node_groups, &names.nodes, &names.cell_groups, &names.cells}) {
    if (!name->empty() && test.given(*name)) return *name;
  }
  return names.all;
}

std::vector<int> all_of(int count) {
  std::vector<int> all(static_cast<std::size_t>(count));
  std::iota(all.begin(), all.end(), 0);
  return all;
}

std::vector<int> components_tested(const Keywords& test, const std::vector<std::string>& components) {
  if (test.given("NOM_VARI")) return {component_of(test, components, test.text("NOM_VARI"), "NOM_VARI")};
  if (test.given("NOM_CMP")) {
    const auto names = test.texts("NOM_CMP");
    if (names.size() > 1 && !test.given("TYPE_TEST")) {
      throw DiagnosticError("wrong-count",
                            fmt::format("NOM_CMP names {} components; a value is tested of one", names.size()),
                            test.span_of("NOM_CMP"), "name one, or use TYPE_TEST over several");
    }
    std::vector<int> chosen;
    for (const std::string& name : names) chosen.push_back(component_of(test, components, name));
    return chosen;
  }
  return all_of(static_cast<int>(components.size()));
}

// What stands beside the values at nodes: see takes_multipliers_in.
double nodal_value(const Keywords& test, const NodalField& field, const solver::Mesh& mesh, const Values& others) {
  const auto components = components_tested(test, field.components);
  if (test.given("TYPE_TEST")) {
    const auto nodes =
        names_a_place(test) ? needed(selected_nodes(test, mesh), test, "node") : all_of(mesh.node_count());
    Values values;
    for (const int node : nodes) {
      for (const int component : components) {
        if (const double value = field.at(node, component); !std::isnan(value)) values.push_back(value);
      }
    }
    if (values.empty()) not_carried(test, "the field");
    values.insert(values.end(), others.begin(), others.end());
    return reduced(test, values);
  }
  const std::string keyword = place_keyword(test, node_places);
  const int node = single(test, selected_nodes(test, mesh, node_places), keyword, "node");
  const double value = field.at(node, components.front());
  if (std::isnan(value)) not_carried(test, "node " + mesh.node_name(node));
  return value;
}

int local_point(const Keywords& test, const ElementField& field, int cell, const solver::Mesh& mesh) {
  if (test.given("POINT")) {
    const auto point = test.integer("POINT");
    const int points = field.points(cell) / field.values_a_point(cell);
    if (point >= 1 && point <= points) return static_cast<int>(point) - 1;
    throw DiagnosticError("out-of-bounds", fmt::format("cell {} has {} points", mesh.cell_name(cell), points),
                          test.span_of("POINT"), "points count from 1");
  }
  if (field.support == solver::Support::cell) return 0;
  const int node = single(test, selected_nodes(test, mesh, node_places), place_keyword(test, node_places), "node");
  const auto nodes = mesh.cell(cell);
  const auto found = std::find(nodes.begin(), nodes.end(), node);
  if (found == nodes.end() || field.support != solver::Support::element_node) {
    throw DiagnosticError("unknown-node",
                          fmt::format("cell {} has no value at node {}", mesh.cell_name(cell), mesh.node_name(node)),
                          test.span, "name a node of the cell and a field at its nodes (..._ELNO), or a POINT");
  }
  return static_cast<int>(found - nodes.begin());
}

// Which points of cells a test over values (TYPE_TEST) takes in: all, or those of POINT, or at the nodes that it names.
std::function<bool(int cell, int point)> points_tested(const Keywords& test, const ElementField& field,
                                                       const solver::Mesh& mesh) {
  if (test.given("POINT")) return [wanted = test.integer("POINT")](int, int point) { return point + 1 == wanted; };
  const std::string keyword = place_keyword(test, node_places);
  if (!test.given(keyword)) return [](int, int) { return true; };
  if (field.support != solver::Support::element_node) {
    throw DiagnosticError("unknown-node", "the field has no values at nodes", test.span_of(keyword),
                          "name cells, or a field at the nodes of elements (..._ELNO)");
  }
  const auto nodes = selected_nodes(test, mesh, node_places);
  const std::set<int> wanted(nodes.begin(), nodes.end());
  return [wanted, &mesh](int cell, int point) {
    return wanted.contains(mesh.cell(cell)[static_cast<std::size_t>(point)]);
  };
}

double element_value(const Keywords& test, const ElementField& field, const solver::Mesh& mesh) {
  const auto components = components_tested(test, field.components);
  const auto named = selected_cells(test, mesh, cell_places);
  if (test.given("TYPE_TEST")) {
    const auto cells = names_a_place(test, cell_places) ? needed(named, test, "cell") : all_of(mesh.cell_count());
    Values values;
    const auto is_tested = points_tested(test, field, mesh);
    for (const int cell : cells) {
      const int each = field.values_a_point(cell),
                only = test.given("SOUS_POINT") ? sub_point(test, field, cell, mesh) : -1;
      for (int place = 0; place < field.points(cell); ++place) {
        if (!is_tested(cell, place / each) || (only >= 0 && place % each != only)) continue;
        for (const int component : components) {
          if (const double value = field.at(cell, place, component); !std::isnan(value)) values.push_back(value);
        }
      }
    }
    if (values.empty()) not_carried(test, "the field");
    return reduced(test, values);
  }
  const int cell = single(test, named, place_keyword(test, cell_places), "cell");
  if (field.points(cell) == 0) not_carried(test, "cell " + mesh.cell_name(cell));
  const int place =
      local_point(test, field, cell, mesh) * field.values_a_point(cell) + sub_point(test, field, cell, mesh);
  const double value = field.at(cell, place, components.front());
  if (std::isnan(value)) not_carried(test, "cell " + mesh.cell_name(cell));
  return value;
}

double field_value(const Keywords& test, const solver::Field& field, const solver::Mesh& mesh,
                   const Values& others = {}) {
  if (const auto* nodal = std::get_if<NodalField>(&field)) return nodal_value(test, *nodal, mesh, others);
  return element_value(test, std::get<ElementField>(field), mesh);
}

// Fields and parameters hold reals; one that is tested as an integer is one, unless it is none.
TestedValue as_reference(const Keywords& test, double value) {
  constexpr double rounding = 1e-9;
  const bool is_integer = std::abs(value - std::round(value)) <= rounding * std::max(1.0, std::abs(value));
  if (is_integer && (test.given("VALE_CALC_I") || test.given("VALE_REFE_I")))
    return static_cast<std::int64_t>(std::llround(value));
  return value;
}

TestedValue parameter_value(const Keywords& test, const solver::ResultStep& step) {
  const std::string& name = test.text("PARA");
  if (name == "INST") return step.instant;
  if (name == "NUME_ORDRE") return static_cast<std::int64_t>(step.order);
  const auto found = step.parameters.find(name);
  if (found == step.parameters.end()) {
    throw DiagnosticError("unknown-parameter", "the result has no parameter " + name, test.span_of("PARA"));
  }
  return as_reference(test, found->second);
}

// "DEPL DY at A": what a reader of the verdict needs to find the value again.
std::string label_of(const Keywords& test, const std::string& what) {
  std::string label = what;
  for (const char* keyword : {"NOM_CMP", "NOM_VARI"})
    if (test.given(keyword)) label += " " + test.texts(keyword).front();
  if (test.given("TYPE_TEST")) label += " " + test.text("TYPE_TEST");
  const char* lead = " at ";
  for (const char* keyword : {"GROUP_NO", "NOEUD", "GROUP_MA", "MAILLE"}) {
    if (!test.given(keyword)) continue;
    label += lead + fmt::format("{}", fmt::join(test.texts(keyword), " "));
    lead = " of ";
  }
  if (test.given("POINT")) label += fmt::format(" point {}", test.integer("POINT"));
  if (test.given("SOUS_POINT")) label += fmt::format(" sub-point {}", test.integer("SOUS_POINT"));
  return label;
}

void report(const Keywords& test, const std::string& label, const TestedValue& value, Context& context) {
  const std::string full = test.given("LEGENDE") ? test.text("LEGENDE") + ": " + label : label;
  for (Verdict& verdict : judge(test, "TEST_RESU", full, value)) context.report(std::move(verdict));
}

// The multipliers of AFFE_CHAR_MECA stand among the values of DEPL: a test of all of them at once takes them in
// (ssnp140a).
bool takes_multipliers_in(const Keywords& test) {
  return test.given("TYPE_TEST") && !test.given("NOM_CMP") && !names_a_place(test);
}

TestedValue result_value(const Keywords& test, const ResultConcept& data, const solver::ResultStep& step) {
  if (test.given("PARA")) return parameter_value(test, step);
  const solver::Field& held = layered_field_of(test, step, test.text("NOM_CHAM"));
  const solver::Mesh& mesh = data.result.mesh();
  if (test.given("NOM_VARI"))
    return as_reference(test,
                        field_value(test, by_variable_names(test, held, data.problem_of(step).behaviours.get()), mesh));
  const bool all = takes_multipliers_in(test) && test.text("NOM_CHAM") == "DEPL";
  return as_reference(test, field_value(test, held, mesh, all ? multipliers_of(data, step) : Values()));
}

// Cells count beside nodes where values are reduced (TYPE_TEST), and a field at nodes has no points.
void warn_of_idle_places_of(const Keywords& test, const solver::Field& field, Context& context) {
  if (!std::holds_alternative<NodalField>(field)) return;
  constexpr std::array idle = {"POINT", "SOUS_POINT", "GROUP_MA", "MAILLE"};
  commands::warn_of_idle_places("TEST_RESU", test, std::span(idle).first(test.given("TYPE_TEST") ? 2 : 4),
                                context.diagnostics);
}

void test_result(const Keywords& test, Context& context) {
  const auto& data = interpreter::data_of<ResultConcept>(test.concept_of("RESULTAT"), "RESULTAT");
  const solver::ResultStep& step = only_step(test, data.result, "a value is tested at one");
  const TestedValue value = result_value(test, data, step);
  if (!test.given("PARA")) warn_of_idle_places_of(test, layered_field_of(test, step, test.text("NOM_CHAM")), context);
  const std::string& what = test.given("PARA") ? test.text("PARA") : test.text("NOM_CHAM");
  report(test, label_of(test, what) + fmt::format(", INST={:g}", step.instant), value, context);
}

void test_field(const Keywords& test, Context& context) {
  const FieldConcept& data = number_field(test.concept_of("CHAM_GD"), test, "CHAM_GD");
  const std::string label = label_of(test, test.concept_of("CHAM_GD")->name);
  warn_of_idle_places_of(test, data.field, context);
  if (test.given("NOM_VARI")) {
    report(
        test, label,
        as_reference(test, field_value(test, by_variable_names(test, data.field, data.behaviours.get()), *data.mesh)),
        context);
    return;
  }
  const Values others = data.multipliers && takes_multipliers_in(test) ? data.multipliers->values() : Values();
  report(test, label, as_reference(test, field_value(test, data.field, *data.mesh, others)), context);
}

std::size_t count_of(const Keywords& test, const solver::Mesh& mesh) {
  const std::string& kind = test.text("CARA");
  if (kind == "NB_MAILLE") return mesh.cell_types.size();
  if (kind == "NB_NOEUD") return mesh.nodes.size();
  if (kind == "NB_GROUP_MA") return mesh.cell_groups.size();
  if (kind == "NB_GROUP_NO") return mesh.node_groups.size();
  if (kind == "NB_MA_GROUP_MA") return named_cell_groups(test, "NOM_GROUP_MA", mesh).front().size();
  return named_node_groups(test, "NOM_GROUP_NO", mesh).front().size();
}

void test_mesh(const Keywords& test, Context& context) {
  const auto& mesh = *test.data<MeshConcept>("MAILLAGE").mesh;
  std::string label = test.concept_of("MAILLAGE")->name + " " + test.text("CARA");
  for (const char* keyword : {"NOM_GROUP_MA", "NOM_GROUP_NO"})
    if (test.given(keyword)) label += " " + test.text(keyword);
  report(test, label, static_cast<std::int64_t>(count_of(test, mesh)), context);
}

}  // namespace

Product test_resu(const Call& call, Context& context) {
  for (const Keywords& test : call.factors("RESU")) test_result(test, context);
  for (const char* kind : {"CHAM_NO", "CHAM_ELEM", "CARTE"}) {
    for (const Keywords& test : call.factors(kind)) test_field(test, context);
  }
  for (const Keywords& test : call.factors("MAILLAGE")) test_mesh(test, context);
  return nullptr;
}

}  // namespace comma::commands
