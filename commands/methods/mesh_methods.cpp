// What a command file may ask a mesh for (U1.03.02, and the Python interface of recent versions).
#include <algorithm>
#include <ranges>

#include "commands/concepts.hpp"
#include "commands/diagnosed.hpp"
#include "commands/methods/method_arguments.hpp"
#include "commands/ordered_set.hpp"
#include "interpreter/values/array.hpp"
#include "interpreter/values/host_object.hpp"

namespace comma::commands {

namespace {

using interpreter::HostFunction;
using interpreter::HostObject;
using interpreter::Object;
using solver::Groups;
using solver::Mesh;

Value index_list(const std::vector<int>& values) {
  std::vector<Value> items;
  for (const int value : values) items.emplace_back(static_cast<std::int64_t>(value));
  return Value::list(std::move(items));
}

Value group_names(const Groups& groups) {
  std::vector<Value> items;
  for (const auto& group : groups) items.emplace_back(group.first);
  return Value::list(std::move(items));
}

/// (name, number of members) of each group.
Value described_groups(const Groups& groups) {
  std::vector<Value> items;
  for (const auto& [name, members] : groups)
    items.push_back(Value::tuple({Value(name), Value(static_cast<std::int64_t>(members.size()))}));
  return Value::list(std::move(items));
}

/// The members of the groups named, each once, or all of `count` without names.
std::vector<int> members_of_groups(const std::vector<std::string>& groups, int count,
                                   const std::vector<int>& (Mesh::*group)(std::string_view) const, const Mesh& mesh) {
  OrderedSet chosen(count);
  if (groups.empty()) chosen.add_all(std::views::iota(0, count));
  for (const std::string& name : groups) chosen.add_all((mesh.*group)(name));
  return chosen.take();
}

/// The places of the nodes: getValues() as one list, toNumpy() with a row a node.
struct CoordinatesObject : HostObject {
  explicit CoordinatesObject(std::vector<double> values) : flat(std::move(values)) {}
  std::vector<double> flat;

  std::string type_name() const override { return "MeshCoordinatesField"; }
  std::optional<Value> attribute(std::string_view name) const override {
    if (name == "getValues") return method("getValues", [values = flat] { return list_of(values); });
    if (name == "toNumpy")
      return method("toNumpy", [values = flat] {
        return interpreter::make_value({values, {values.size() / 3, 3}, interpreter::NumberType::real});
      });
    return std::nullopt;
  }
  std::vector<std::string> attribute_names() const override { return {"getValues", "toNumpy"}; }

 private:
  template <class Code>
  static Value method(const char* name, Code&& code) {
    std::shared_ptr<Object> made =
        std::make_shared<HostFunction>(name, [name, code](const std::vector<Value>& arguments) {
          MethodArguments(name, arguments, {}, {});
          return code();
        });
    return Value(std::move(made));
  }
};

Value coordinates_of(const Mesh& mesh) {
  std::vector<double> flat;
  for (const solver::Point& node : mesh.nodes) flat.insert(flat.end(), node.begin(), node.end());
  std::shared_ptr<Object> field = std::make_shared<CoordinatesObject>(std::move(flat));
  return Value(std::move(field));
}

struct MeshMethod {
  std::vector<std::string> parameters;
  Value (*code)(const Mesh&, const MethodArguments&);
};

const std::map<std::string, MeshMethod, std::less<>>& mesh_methods() {
  using Arguments = MethodArguments;
  static const std::map<std::string, MeshMethod, std::less<>> table = {
      {"LIST_GROUP_NO", {{}, [](const Mesh& mesh, const Arguments&) { return described_groups(mesh.node_groups); }}},
      {"LIST_GROUP_MA", {{}, [](const Mesh& mesh, const Arguments&) { return described_groups(mesh.cell_groups); }}},
      {"getGroupsOfNodes", {{}, [](const Mesh& mesh, const Arguments&) { return group_names(mesh.node_groups); }}},
      {"getGroupsOfCells", {{}, [](const Mesh& mesh, const Arguments&) { return group_names(mesh.cell_groups); }}},
      {"hasGroupOfNodes",
       {{"group_name"},
        [](const Mesh& mesh, const Arguments& given) {
          return Value(mesh.node_groups.contains(given.needed_text("group_name")));
        }}},
      {"hasGroupOfCells",
       {{"group_name"},
        [](const Mesh& mesh, const Arguments& given) {
          return Value(mesh.cell_groups.contains(given.needed_text("group_name")));
        }}},
      {"getNodes",
       {{"group_name"},
        [](const Mesh& mesh, const Arguments& given) {
          return index_list(members_of_groups(given.texts("group_name"), mesh.node_count(), &Mesh::node_group, mesh));
        }}},
      {"getCells",
       {{"group_name"},
        [](const Mesh& mesh, const Arguments& given) {
          auto cells = members_of_groups(given.texts("group_name"), mesh.cell_count(), &Mesh::cell_group, mesh);
          std::ranges::sort(cells);  // nodes come in the order of their group (Code_Aster 17.3)
          return index_list(cells);
        }}},
      {"getNumberOfNodes", {{}, [](const Mesh& mesh, const Arguments&) { return Value(mesh.node_count()); }}},
      {"getNumberOfCells", {{}, [](const Mesh& mesh, const Arguments&) { return Value(mesh.cell_count()); }}},
      {"getDimension", {{}, [](const Mesh& mesh, const Arguments&) { return Value(mesh.dimension); }}},
      {"getConnectivity",
       {{},
        [](const Mesh& mesh, const Arguments&) {
          std::vector<Value> cells;
          for (int cell = 0; cell < mesh.cell_count(); ++cell) {
            const auto nodes = mesh.cell(cell);
            cells.push_back(index_list({nodes.begin(), nodes.end()}));
          }
          return Value::list(std::move(cells));
        }}},
      {"getCoordinates", {{}, [](const Mesh& mesh, const Arguments&) { return coordinates_of(mesh); }}},
  };
  return table;
}

}  // namespace

std::vector<std::string> MeshConcept::method_names() const { return names_of_methods(mesh_methods()); }

Value MeshConcept::method(std::string_view name, const std::vector<Value>& arguments,
                          const std::map<std::string, Value>& keywords) const {
  const auto found = mesh_methods().find(name);
  if (found == mesh_methods().end()) return ConceptData::method(name, arguments, keywords);
  return diagnosed(
      [&] { return found->second.code(*mesh, MethodArguments(name, arguments, keywords, found->second.parameters)); });
}

}  // namespace comma::commands
