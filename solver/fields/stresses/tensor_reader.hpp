// Symmetric tensors out of the components of a field.
#pragma once

#include <array>
#include <cmath>
#include <string_view>

#include "solver/fields/data/field.hpp"
#include "solver/materials/elasticity.hpp"

namespace comma::solver {

inline constexpr std::array<std::string_view, 6> stress_components = {"SIXX", "SIYY", "SIZZ", "SIXY", "SIXZ", "SIYZ"};
inline constexpr std::array<std::string_view, 6> strain_components = {"EPXX", "EPYY", "EPZZ", "EPXY", "EPXZ", "EPYZ"};

/// Reads a tensor (xx, yy, zz, xy, xz, yz) at points of a field; components that it lacks are 0.
class TensorReader {
 public:
  TensorReader(const ElementField& field, const std::array<std::string_view, 6>& names) : field_(field) {
    for (std::size_t i = 0; i < 6; ++i) columns_[i] = field.component(names[i]);
  }
  bool has(int cell) const {
    return columns_[0] >= 0 && field_.points(cell) > 0 && !std::isnan(field_.at(cell, 0, columns_[0]));
  }
  Vector6d at(int cell, int point) const {
    Vector6d tensor;
    for (int i = 0; i < 6; ++i) {
      const int column = columns_[static_cast<std::size_t>(i)];
      const double value = column < 0 ? 0.0 : field_.at(cell, point, column);
      tensor[i] = std::isnan(value) ? 0.0 : value;
    }
    return tensor;
  }

 private:
  const ElementField& field_;
  std::array<int, 6> columns_;
};

}  // namespace comma::solver
