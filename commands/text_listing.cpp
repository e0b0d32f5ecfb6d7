#include "commands/text_listing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "solver/fields/data/field_rows.hpp"
#include "solver/fields/data/statistics.hpp"

namespace comma::commands {

namespace {

std::string row(const std::string& place, const std::vector<double>& values, const RealFormat& reals) {
  std::string text = fmt::format(" {:<10}", place);
  for (const double value : values)
    text += " " + (std::isnan(value) ? fmt::format("{:>{}}", "-", reals.width()) : reals(value));
  return text + "\n";
}

std::string header(const std::string& place, const std::vector<std::string>& columns, const RealFormat& reals) {
  std::string text = fmt::format(" {:<10}", place);
  for (const std::string& name : columns) text += fmt::format(" {:>{}}", name, reals.width());
  return text + "\n";
}

std::string place_name(const solver::Field& field, const solver::Mesh& mesh, int place, int point) {
  if (std::holds_alternative<solver::NodalField>(field)) return mesh.node_name(place);
  return fmt::format("{} {}", mesh.cell_name(place), point + 1);
}

double value_at(const solver::Field& field, int place, int point, int component) {
  if (const auto* nodal = std::get_if<solver::NodalField>(&field)) return nodal->at(place, component);
  return std::get<solver::ElementField>(field).at(place, point, component);
}

// The node whose values stand there, -1 at a point inside a cell.
int node_at(const solver::Field& field, const solver::Mesh& mesh, int place, int point) {
  const auto* element = std::get_if<solver::ElementField>(&field);
  if (element == nullptr) return place;
  return element->support == solver::Support::element_node ? mesh.cell(place)[static_cast<std::size_t>(point)] : -1;
}

// False for what is absent.
bool is_shown(double value, const ListingStyle& style) { return value >= style.least && value <= style.greatest; }

// Coordinates, where they are asked for, and then the values within the bounds; nothing when there is no value.
std::vector<double> entries(const solver::Field& field, const solver::Mesh& mesh, const ListingStyle& style, int place,
                            int point) {
  std::vector<double> values;
  bool any = false;
  if (style.coordinates) {
    const int node = node_at(field, mesh, place, point);
    for (std::size_t i = 0; i < 3; ++i)
      values.push_back(node < 0 ? solver::absent : mesh.nodes[static_cast<std::size_t>(node)][i]);
  }
  for (int c = 0; c < static_cast<int>(solver::components_of(field).size()); ++c) {
    const double value = value_at(field, place, point, c);
    const bool shown = is_shown(value, style);
    values.push_back(shown ? value : solver::absent);
    any |= shown;
  }
  return any ? values : std::vector<double>();
}

}  // namespace

std::string listing(const solver::Mesh& mesh, const ListingStyle& style) {
  std::string text = fmt::format(" {} nodes, {} cells\n", mesh.node_count(), mesh.cell_count()) +
                     header("NOEUD", {"X", "Y", "Z"}, style.reals);
  for (int node = 0; node < mesh.node_count(); ++node) {
    const solver::Point& at = mesh.nodes[node];
    text += row(mesh.node_name(node), {at[0], at[1], at[2]}, style.reals);
  }
  return text;
}

std::string listing(const solver::Field& field, const solver::Mesh& mesh, const ListingStyle& style) {
  const bool nodal = std::holds_alternative<solver::NodalField>(field);
  std::vector<std::string> columns;
  if (style.coordinates) columns = {"X", "Y", "Z"};
  columns.insert(columns.end(), solver::components_of(field).begin(), solver::components_of(field).end());
  std::string text = header(nodal ? "NOEUD" : "MAILLE", columns, style.reals);
  const int places = nodal ? mesh.node_count() : mesh.cell_count();
  for (int place = 0; place < places; ++place) {
    const int points = nodal ? 1 : std::get<solver::ElementField>(field).points(place);
    for (int point = 0; point < points; ++point) {
      const auto values = entries(field, mesh, style, place, point);
      if (!values.empty()) text += row(place_name(field, mesh, place, point), values, style.reals);
    }
  }
  return text;
}

std::string extreme_listing(const solver::Field& whole, const solver::Mesh& mesh, const ListingStyle& style,
                            std::span<const Extremum> wanted) {
  std::string text;
  solver::Field field = whole;
  for (double& value : solver::values_of(field))
    if (!is_shown(value, style)) value = solver::absent;
  for (std::size_t c = 0; c < solver::components_of(field).size(); ++c) {
    const auto found = solver::extremes(field, static_cast<int>(c));
    if (!found) continue;
    for (const Extremum which : wanted) {
      const solver::Extreme& extreme = which == Extremum::greatest ? found->greatest : found->least;
      text += fmt::format(" {:<10} {} {} at {}\n", solver::components_of(field)[c],
                          which == Extremum::greatest ? "largest " : "smallest", style.reals(extreme.value),
                          place_name(field, mesh, extreme.place, extreme.point));
    }
  }
  return text;
}

}  // namespace comma::commands
