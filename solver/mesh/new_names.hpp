// Names for nodes and cells that are added to a mesh.
#pragma once

#include <string>
#include <unordered_set>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace comma::solver {

/// Names in use, and new ones that are not among them. Keeps a reference to the list.
class NewNames {
 public:
  NewNames(std::vector<std::string>& names, std::string prefix)
      : names_(names), prefix_(std::move(prefix)), used_(names.begin(), names.end()) {}

  /// Gives the next member a name, in a mesh whose members have names.
  void add() {
    if (used_.empty()) return;
    std::string name;
    do {
      name = fmt::format("{}{}", prefix_, ++count_);
    } while (!used_.insert(name).second);
    names_.push_back(std::move(name));
  }

 private:
  std::vector<std::string>& names_;
  std::string prefix_;
  std::unordered_set<std::string> used_;
  int count_ = 0;
};

}  // namespace comma::solver
