#include "solver/mesh/mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <charconv>
#include <system_error>

#include "solver/error.hpp"
#include "solver/mesh/groups.hpp"
#include "solver/mesh/nearest_name.hpp"

namespace comma::solver {
namespace {

/// The index behind a default name such as "M12", or "12"; -1 for anything else.
int default_index(char prefix, std::string_view name, int count) {
  if (name.starts_with(prefix)) name.remove_prefix(1);
  if (name.starts_with('0')) return -1;
  int number = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
  if (error != std::errc{} || end != name.data() + name.size() || number < 1 || number > count) return -1;
  return number - 1;
}

std::string name_at(const std::vector<std::string>& names, char prefix, int index) {
  return names.empty() ? fmt::format("{}{}", prefix, index + 1) : names[index];
}

int find_name(const std::vector<std::string>& names, char prefix, std::string_view name, int count) {
  if (names.empty()) return default_index(prefix, name, count);
  const auto found = std::ranges::find(names, name);
  return found == names.end() ? -1 : static_cast<int>(found - names.begin());
}

[[noreturn]] void throw_unknown_group(std::string_view name, std::string_view kind, const Groups& groups,
                                      std::string_view other_kind, const Groups& others) {
  const std::string message = fmt::format("the mesh has no {} group {}", kind, name);
  if (others.contains(name)) {
    throw Error("unknown-group", message, fmt::format("{} is a {} group of this mesh", name, other_kind));
  }
  const std::vector<std::string> known = names_of(groups);
  const std::string nearest = nearest_name(name, known);
  if (!nearest.empty()) throw Error("unknown-group", message, fmt::format("did you mean {}?", nearest));
  if (known.empty()) throw Error("unknown-group", message, fmt::format("it has no {} group at all", kind));
  throw Error("unknown-group", message, fmt::format("its {} groups are {}", kind, fmt::join(known, ", ")));
}

}  // namespace

std::string Mesh::node_name(int index) const { return name_at(node_names, 'N', index); }
std::string Mesh::cell_name(int index) const { return name_at(cell_names, 'M', index); }
int Mesh::find_node(std::string_view name) const { return find_name(node_names, 'N', name, node_count()); }
int Mesh::find_cell(std::string_view name) const { return find_name(cell_names, 'M', name, cell_count()); }

int Mesh::add_cell(CellType type, std::span<const int> cell_nodes) {
  assert(static_cast<int>(cell_nodes.size()) == comma::solver::node_count(type));
  cell_types.push_back(type);
  connectivity.insert(connectivity.end(), cell_nodes.begin(), cell_nodes.end());
  cell_starts.push_back(static_cast<int>(connectivity.size()));
  return cell_count() - 1;
}

const std::vector<int>& Mesh::node_group(std::string_view name) const {
  const auto found = node_groups.find(name);
  if (found == node_groups.end()) throw_unknown_group(name, "node", node_groups, "cell", cell_groups);
  return found->second;
}

const std::vector<int>& Mesh::cell_group(std::string_view name) const {
  const auto found = cell_groups.find(name);
  if (found == cell_groups.end()) throw_unknown_group(name, "cell", cell_groups, "node", node_groups);
  return found->second;
}

std::vector<int> Mesh::nodes_of_cells(std::span<const int> cells) const {
  std::vector<int> result;
  for (const int index : cells) {
    const auto cell_nodes = cell(index);
    result.insert(result.end(), cell_nodes.begin(), cell_nodes.end());
  }
  std::ranges::sort(result);
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

}  // namespace comma::solver
