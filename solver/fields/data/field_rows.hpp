// Fields of both kinds seen alike: rows of values at points of places, a place being a node or a cell.
#pragma once

#include <numeric>
#include <string>
#include <string_view>
#include <vector>

#include "solver/fields/data/field.hpp"

namespace comma::solver {

/// The names of the components of a field of either kind.
inline const std::vector<std::string>& components_of(const Field& field) {
  return std::visit([](const auto& values) -> const std::vector<std::string>& { return values.components; }, field);
}
inline std::vector<std::string>& components_of(Field& field) {
  return std::visit([](auto& values) -> std::vector<std::string>& { return values.components; }, field);
}
/// Index of a component, -1 if there is none.
inline int component_of(const Field& field, std::string_view name) {
  return std::visit([&](const auto& values) { return values.component(name); }, field);
}

/// The rows of a field: place p has those from starts()[p] to starts()[p + 1].
class FieldRows {
 public:
  explicit FieldRows(const Field& field) {
    if (const auto* element = std::get_if<ElementField>(&field)) {
      starts_ = element->starts;
      return;
    }
    const auto& nodal = std::get<NodalField>(field);
    starts_.resize(nodal.values.size() / nodal.components.size() + 1);
    std::iota(starts_.begin(), starts_.end(), 0);
  }
  int place_count() const { return static_cast<int>(starts_.size()) - 1; }
  int begin(int place) const { return starts_[place]; }
  int end(int place) const { return starts_[place + 1]; }
  int count(int place) const { return end(place) - begin(place); }
  int total() const { return starts_.back(); }

 private:
  std::vector<int> starts_;
};

}  // namespace comma::solver
