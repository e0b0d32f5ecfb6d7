// What a command file may ask a field for (U1.03.02, and the Python interface of recent versions).
#include <algorithm>
#include <cmath>
#include <numeric>

#include "commands/concepts.hpp"
#include "commands/diagnosed.hpp"
#include "commands/methods/method_arguments.hpp"
#include "commands/ordered_set.hpp"
#include "interpreter/diagnostic.hpp"
#include "interpreter/values/array.hpp"
#include "interpreter/values/exception.hpp"
#include "interpreter/values/host_object.hpp"
#include "solver/fields/data/field_algebra.hpp"
#include "solver/fields/data/field_rows.hpp"

namespace comma::commands {

namespace {

using interpreter::DiagnosticError;
using interpreter::HostObject;
using interpreter::Object;
using interpreter::Operator;

/// Values of a field with the places where they lie.
struct Extract {
  std::vector<double> values;
  std::vector<std::string> components;
  std::vector<int> nodes;  ///< of a field at nodes
  std::vector<int> cells;  ///< of a field on cells, with points from 0
  std::vector<int> points;
};

/// Their columns in the field; all components without names.
std::vector<int> field_columns(const std::vector<std::string>& known, const std::vector<std::string>& wanted) {
  std::vector<int> columns;
  if (wanted.empty()) {
    columns.resize(known.size());
    std::iota(columns.begin(), columns.end(), 0);
  }
  for (const std::string& name : wanted) {
    const auto found = std::ranges::find(known, name);
    if (found == known.end())
      throw DiagnosticError("unknown-component", "the field has no component " + name, {},
                            "take one of its own: " + Value::list({known.begin(), known.end()}).repr());
    columns.push_back(static_cast<int>(found - known.begin()));
  }
  return columns;
}

std::vector<int> every_place(int count) {
  std::vector<int> places(static_cast<std::size_t>(count));
  std::iota(places.begin(), places.end(), 0);
  return places;
}

/// Nodes of groups of nodes, or of cells.
std::vector<int> nodes_of(const solver::Mesh& mesh, const std::vector<std::string>& groups) {
  if (groups.empty()) return every_place(mesh.node_count());
  OrderedSet nodes(mesh.node_count());
  for (const std::string& group : groups)
    nodes.add_all(mesh.node_groups.contains(group) || !mesh.cell_groups.contains(group)
                      ? mesh.node_group(group)
                      : mesh.nodes_of_cells(mesh.cell_group(group)));
  return nodes.take();
}

std::vector<int> cells_of(const solver::Mesh& mesh, const std::vector<std::string>& groups) {
  if (groups.empty()) return every_place(mesh.cell_count());
  OrderedSet cells(mesh.cell_count());
  for (const std::string& group : groups) cells.add_all(mesh.cell_group(group));
  return cells.take();
}

std::vector<int> rising(std::vector<int> places) {
  std::ranges::sort(places);
  return places;
}

/// Nodes or cells of groups come by rising numbers (Code_Aster 17.3).
Extract extract_of(const FieldConcept& data, const std::vector<std::string>& components,
                   const std::vector<std::string>& groups) {
  if (!data.functions.empty()) throw DiagnosticError("wrong-type", "the field holds functions, not numbers");
  const std::vector<std::string>& known = solver::components_of(data.field);
  const std::vector<int> columns = field_columns(known, components);
  Extract result;
  const auto take = [&](double value, int column) {
    if (std::isnan(value)) return false;
    result.values.push_back(value);
    result.components.push_back(known[static_cast<std::size_t>(column)]);
    return true;
  };
  if (const auto* nodal = std::get_if<solver::NodalField>(&data.field)) {
    for (const int node : rising(nodes_of(*data.mesh, groups)))
      for (const int column : columns)
        if (take(nodal->at(node, column), column)) result.nodes.push_back(node);
    return result;
  }
  const auto& element = std::get<solver::ElementField>(data.field);
  for (const int cell : rising(cells_of(*data.mesh, groups)))
    for (int point = 0; point < element.points(cell); ++point)
      for (const int column : columns)
        if (take(element.at(cell, point, column), column)) {
          result.cells.push_back(cell);
          result.points.push_back(point);
        }
  return result;
}

Value numbers_from(const std::vector<int>& values, int first) {
  std::vector<Value> items;
  for (const int value : values) items.emplace_back(static_cast<std::int64_t>(value + first));
  return Value::list(std::move(items));
}

/// EXTR_COMP(): valeurs, and where they lie if the file asks for it, by numbers from 1.
struct ExtractObject : HostObject {
  ExtractObject(Extract of, bool with_places, bool at_nodes)
      : extract(std::move(of)), places(with_places), nodal(at_nodes) {}
  Extract extract;
  bool places;
  bool nodal;

  std::string type_name() const override { return nodal ? "post_comp_cham_no" : "post_comp_cham_el"; }
  std::optional<Value> attribute(std::string_view name) const override {
    if (name == "valeurs")
      return interpreter::make_value({extract.values, {extract.values.size()}, interpreter::NumberType::real});
    const auto known = attribute_names();
    if (std::ranges::find(known, name) == known.end()) return std::nullopt;
    if (!places) return Value();
    if (name == "comp") return Value::list({extract.components.begin(), extract.components.end()});
    if (name == "noeud") return numbers_from(extract.nodes, 1);
    if (name == "maille") return numbers_from(extract.cells, 1);
    return numbers_from(name == "point" ? extract.points : std::vector<int>(extract.points.size(), 0), 1);
  }
  std::vector<std::string> attribute_names() const override {
    if (nodal) return {"valeurs", "comp", "noeud"};
    return {"valeurs", "comp", "maille", "point", "sous_point"};
  }
};

Value extracted_components(const FieldConcept& data, const MethodArguments& given) {
  std::vector<std::string> components = given.texts("comp");
  std::erase_if(components, [](const std::string& name) { return name.find_first_not_of(' ') == std::string::npos; });
  std::shared_ptr<Object> object =
      std::make_shared<ExtractObject>(extract_of(data, components, given.texts("lgma")), given.integer("topo") > 0,
                                      std::holds_alternative<solver::NodalField>(data.field));
  return Value(std::move(object));
}

/// The values, and where they lie by numbers from 0: nodes and components, or cells, components, points and points of
/// the thickness.
Value values_with_description(const FieldConcept& data, const MethodArguments& given) {
  const Extract found = extract_of(data, given.texts("components"), given.texts("groups"));
  const Value components = Value::list({found.components.begin(), found.components.end()});
  const Value description = std::holds_alternative<solver::NodalField>(data.field)
                                ? Value::tuple({numbers_from(found.nodes, 0), components})
                                : Value::tuple({numbers_from(found.cells, 0), components, numbers_from(found.points, 0),
                                                numbers_from(std::vector<int>(found.points.size(), 0), 0)});
  return Value::tuple({list_of(found.values), description});
}

Value all_values(const FieldConcept& data, const MethodArguments&) { return list_of(extract_of(data, {}, {}).values); }

Value own_components(const FieldConcept& data, const MethodArguments&) {
  const auto& names = solver::components_of(data.field);
  return Value::list({names.begin(), names.end()});
}

Value norm(const FieldConcept& data, const MethodArguments& given) {
  const std::vector<double> values = extract_of(data, given.texts("list_cmp"), {}).values;
  const std::string kind = given.needed_text("normType");
  double sum = 0.0, squares = 0.0, largest = 0.0;
  for (const double value : values) {
    sum += std::abs(value);
    squares += value * value;
    largest = std::max(largest, std::abs(value));
  }
  if (kind == "NORM_1") return Value(sum);
  if (kind == "NORM_2") return Value(std::sqrt(squares));
  if (kind == "NORM_INFINITY") return Value(largest);
  throw DiagnosticError("value-error", "norm() takes NORM_1, NORM_2 or NORM_INFINITY, not " + kind);
}

Value copied(const FieldConcept& data, const MethodArguments&) {
  auto handle = std::make_shared<interpreter::Concept>();
  handle->name = "_copy";
  handle->type = std::holds_alternative<solver::NodalField>(data.field) ? "cham_no_sdaster" : "cham_elem";
  handle->id = interpreter::detached_concept;
  handle->data = std::make_shared<FieldConcept>(data);
  return Value(std::move(handle));
}

struct FieldMethod {
  std::vector<std::string> parameters;
  Value (*code)(const FieldConcept&, const MethodArguments&);
};

const std::map<std::string, FieldMethod, std::less<>>& field_methods() {
  static const std::map<std::string, FieldMethod, std::less<>> table = {
      {"EXTR_COMP", {{"comp", "lgma", "topo"}, extracted_components}},
      {"norm", {{"normType", "list_cmp"}, norm}},
      {"copy", {{}, copied}},
      {"getValues", {{}, all_values}},
      {"getValuesWithDescription", {{"components", "groups"}, values_with_description}},
      {"getComponents", {{}, own_components}}};
  return table;
}

}  // namespace

std::shared_ptr<ConceptData> FieldConcept::combined(Operator op, const Value& other, bool reversed) const {
  std::vector<solver::FieldTerm> terms;
  if (other.is_number()) {
    const double number = other.as_real();
    if (op != Operator::multiply && (op != Operator::divide || reversed)) return nullptr;
    if (op == Operator::divide && number == 0.0)
      interpreter::raise(interpreter::ErrorKind::zero_division, "a field is divided by zero");
    terms = {{&field, op == Operator::divide ? 1.0 / number : number}};
  } else {
    const auto* right = dynamic_cast<const FieldConcept*>(other.as_concept()->data.get());
    if (right == nullptr || !right->functions.empty() || (op != Operator::add && op != Operator::subtract))
      return nullptr;
    if (right->mesh != mesh) throw DiagnosticError("incompatible-field", "the two fields lie on different meshes");
    terms = {{&field, 1.0}, {&right->field, op == Operator::add ? 1.0 : -1.0}};
  }
  if (!functions.empty()) return nullptr;
  auto made = std::make_shared<FieldConcept>();
  made->field = diagnosed([&] { return solver::linear_combination(terms); });
  made->mesh = mesh;
  made->model = model;
  made->behaviours = behaviours;
  return made;
}

std::vector<std::string> FieldConcept::method_names() const { return names_of_methods(field_methods()); }

Value FieldConcept::method(std::string_view name, const std::vector<Value>& arguments,
                           const std::map<std::string, Value>& keywords) const {
  const auto found = field_methods().find(name);
  if (found == field_methods().end()) return ConceptData::method(name, arguments, keywords);
  return diagnosed(
      [&] { return found->second.code(*this, MethodArguments(name, arguments, keywords, found->second.parameters)); });
}

}  // namespace comma::commands
