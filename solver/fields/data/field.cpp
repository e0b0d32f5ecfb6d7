#include "solver/fields/data/field.hpp"

#include <algorithm>

namespace comma::solver {

namespace {

int position(const std::vector<std::string>& names, std::string_view name) {
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? -1 : static_cast<int>(found - names.begin());
}

}  // namespace

int NodalField::component(std::string_view name) const { return position(components, name); }

int ElementField::component(std::string_view name) const { return position(components, name); }

}  // namespace comma::solver
