// Many nodes or cells of a mesh by their names, without a look at all names for each.
#pragma once

#include <string_view>
#include <unordered_map>

#include "solver/mesh/mesh.hpp"

namespace comma::solver {

/// Finds what Mesh::find_node or Mesh::find_cell finds. The mesh must outlive it.
class NameFinder {
 public:
  enum class Kind { nodes, cells };
  NameFinder(const Mesh& mesh, Kind kind) : mesh_(mesh), kind_(kind) {}

  int find(std::string_view name) {
    const std::vector<std::string>& names = kind_ == Kind::nodes ? mesh_.node_names : mesh_.cell_names;
    if (names.empty() || ++asked_ <= few) return kind_ == Kind::nodes ? mesh_.find_node(name) : mesh_.find_cell(name);
    if (known_.empty())
      for (std::size_t i = 0; i < names.size(); ++i) known_.try_emplace(names[i], static_cast<int>(i));
    const auto found = known_.find(name);
    return found == known_.end() ? -1 : found->second;
  }

 private:
  static constexpr int few = 8;  ///< for which a map does not pay

  const Mesh& mesh_;
  Kind kind_;
  int asked_ = 0;
  std::unordered_map<std::string_view, int> known_;
};

}  // namespace comma::solver
