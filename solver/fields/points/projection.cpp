#include "solver/fields/points/projection.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "solver/error.hpp"

namespace comma::solver {

namespace {

/// A shape function this small is rounding: the node has no part in the place.
constexpr double no_part = 1e-12;

template <class IsThere>
std::vector<int> cells_of_highest_dimension(const Mesh& mesh, IsThere&& is_there) {
  std::vector<int> cells;
  int highest = 0;
  for (int cell = 0; cell < mesh.cell_count(); ++cell) {
    const int own = dimension(mesh.cell_types[cell]);
    if (own < highest || !is_there(cell)) continue;
    if (own > highest) cells.clear();
    highest = own;
    cells.push_back(cell);
  }
  return cells;
}

/// Rows of sums of weight * value(host, a, component) over the nodes a of the host.
template <class ValueOf>
NodalField interpolated(const std::string& quantity, const std::vector<std::string>& components,
                        std::span<const Embedding> hosts, ValueOf&& value_of) {
  NodalField result{quantity, components, std::vector<double>(hosts.size() * components.size(), absent)};
  for (std::size_t i = 0; i < hosts.size(); ++i) {
    if (hosts[i].cell < 0) continue;
    for (std::size_t c = 0; c < components.size(); ++c) {
      double sum = 0.0;
      for (std::size_t a = 0; a < hosts[i].weights.size(); ++a) {
        const double weight = hosts[i].weights[a];
        if (std::abs(weight) > no_part)
          sum += weight * value_of(hosts[i].cell, static_cast<int>(a), static_cast<int>(c));
      }
      result.values[i * components.size() + c] = sum;
    }
  }
  return result;
}

}  // namespace

std::vector<int> bulk_cells(const Model& model) {
  return cells_of_highest_dimension(
      *model.mesh, [&](int cell) { return model.formulations[cell] != Formulation::none && !model.is_skin(cell); });
}

std::vector<int> bulk_cells(const Mesh& mesh) {
  return cells_of_highest_dimension(mesh, [](int) { return true; });
}

std::vector<int> highest_cells(const Mesh& mesh, std::span<const int> cells) {
  const std::set<int> named(cells.begin(), cells.end());
  return cells_of_highest_dimension(mesh, [&](int cell) { return named.contains(cell); });
}

NodalField at_places(const Mesh& mesh, const NodalField& field, std::span<const Embedding> hosts) {
  return interpolated(field.quantity, field.components, hosts,
                      [&](int cell, int a, int c) { return field.at(mesh.cell(cell)[a], c); });
}

NodalField at_places(const ElementField& field, std::span<const Embedding> hosts) {
  if (field.support != Support::element_node)
    throw Error("incompatible-field", "the field has no values at nodes, from which the others come",
                "compute the field at nodes of cells (..._ELNO) or at nodes (..._NOEU)");
  return interpolated(field.quantity, field.components, hosts,
                      [&](int cell, int a, int c) { return a < field.points(cell) ? field.at(cell, a, c) : absent; });
}

}  // namespace comma::solver
