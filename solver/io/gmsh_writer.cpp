#include "solver/io/gmsh_writer.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "solver/error.hpp"
#include "solver/io/gmsh_cells.hpp"

namespace comma::solver {

namespace {

const GmshType& gmsh_type(const Mesh& mesh, int cell) {
  const auto& types = gmsh_types();
  const auto found = std::find_if(types.begin(), types.end(),
                                  [&](const GmshType& known) { return known.type == mesh.cell_types[cell]; });
  if (found != types.end()) return *found;
  throw Error("unsupported",
              fmt::format("Gmsh has no cell such as {} ({})", mesh.cell_name(cell), name_of(mesh.cell_types[cell])));
}

/// Which of a cell's nodes (in Code_Aster's order) stands at each of Gmsh's places.
std::vector<int> places_of(const Mesh& mesh, int cell) {
  const GmshType& type = gmsh_type(mesh, cell);
  std::vector<int> places(mesh.cell(cell).size());
  for (std::size_t i = 0; i < places.size(); ++i)
    places[type.order.empty() ? i : static_cast<std::size_t>(type.order[i])] = static_cast<int>(i);
  return places;
}

std::string mesh_sections(const Mesh& mesh, std::span<const int> cells) {
  std::string text = fmt::format("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{}\n", mesh.node_count());
  for (int node = 0; node < mesh.node_count(); ++node) {
    text += fmt::format("{} {:.17g} {:.17g} {:.17g}\n", node + 1, mesh.nodes[node][0], mesh.nodes[node][1],
                        mesh.nodes[node][2]);
  }
  text += fmt::format("$EndNodes\n$Elements\n{}\n", cells.size());
  for (const int cell : cells) {
    text += fmt::format("{} {} 2 0 0", cell + 1, gmsh_type(mesh, cell).number);
    for (const int place : places_of(mesh, cell))
      text += fmt::format(" {}", mesh.cell(cell)[static_cast<std::size_t>(place)] + 1);
    text += "\n";
  }
  return text + "$EndElements\n";
}

/// " v1 v2 ..." of a place; empty where it carries none of the columns.
template <class ValueAt>
std::string values_of(const GmshView& view, ValueAt&& value_at) {
  std::string text;
  bool carried = false;
  for (const int column : view.columns) {
    const double value = column < 0 ? absent : value_at(column);
    carried |= !std::isnan(value);
    text += fmt::format(" {:.17g}", std::isnan(value) ? 0.0 : value);
  }
  return carried ? text : "";
}

std::vector<std::string> rows_of(const GmshView& view, const NodalField& field, const Mesh& mesh) {
  std::vector<std::string> rows;
  for (int node = 0; node < mesh.node_count(); ++node) {
    const std::string values = values_of(view, [&](int column) { return field.at(node, column); });
    if (!values.empty()) rows.push_back(fmt::format("{}{}\n", node + 1, values));
  }
  return rows;
}

std::vector<std::string> rows_of(const GmshView& view, const ElementField& field, const Mesh& mesh,
                                 std::span<const int> cells) {
  std::vector<std::string> rows;
  for (const int cell : cells) {
    const int points = field.points(cell);
    if (points == 0) continue;
    const bool at_nodes = field.support == Support::element_node;
    const std::vector<int> places = at_nodes ? places_of(mesh, cell) : std::vector<int>{0};
    std::string row = fmt::format("{}{}", cell + 1, at_nodes ? fmt::format(" {}", points) : "");
    bool carried = true;
    for (const int place : places) {
      const std::string values = values_of(view, [&](int column) { return field.at(cell, place, column); });
      carried = carried && !values.empty();
      row += values;
    }
    if (carried) rows.push_back(row + "\n");
  }
  return rows;
}

std::string view_section(const GmshView& view, const Mesh& mesh, std::span<const int> cells) {
  const auto* element = std::get_if<ElementField>(view.field);
  if (element != nullptr && element->support == Support::gauss_point) {
    throw Error("unsupported", fmt::format("Gmsh has no place for {}, a field at Gauss points", view.name),
                "write it at the nodes of cells");
  }
  const char* section = element == nullptr                          ? "NodeData"
                        : element->support == Support::element_node ? "ElementNodeData"
                                                                    : "ElementData";
  const auto rows = element == nullptr ? rows_of(view, std::get<NodalField>(*view.field), mesh)
                                       : rows_of(view, *element, mesh, cells);
  std::string text = fmt::format("${}\n1\n\"{}\"\n1\n{:.16g}\n3\n{}\n{}\n{}\n", section, view.name, view.instant,
                                 view.step, view.columns.size(), rows.size());
  for (const std::string& row : rows) text += row;
  return text + fmt::format("$End{}\n", section);
}

}  // namespace

std::string format_gmsh(const Mesh& mesh, std::span<const int> cells, std::span<const GmshView> views) {
  std::string text = mesh_sections(mesh, cells);
  for (const GmshView& view : views) text += view_section(view, mesh, cells);
  return text;
}

}  // namespace comma::solver
