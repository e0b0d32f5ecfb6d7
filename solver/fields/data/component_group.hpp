// Components of a nodal field that make a vector or a tensor together.
#pragma once

#include <array>
#include <cmath>
#include <tuple>

#include <Eigen/Core>

#include "solver/fields/data/field.hpp"

namespace comma::solver {

/// The columns of a group of components; the group is not there at all if all are -1.
template <class Names>
auto columns_of(const NodalField& field, const Names& names) {
  std::array<int, std::tuple_size_v<Names>> columns{};
  for (std::size_t i = 0; i < names.size(); ++i) columns[i] = field.component(names[i]);
  return columns;
}

/// The values of a group in a row of the field, 0 where absent; whether any is there.
template <std::size_t Size>
bool gather(const NodalField& field, int row, const std::array<int, Size>& columns, std::array<double, Size>& values) {
  bool carried = false;
  for (std::size_t i = 0; i < Size; ++i) {
    const double value = columns[i] < 0 ? absent : field.at(row, columns[i]);
    carried |= !std::isnan(value);
    values[i] = std::isnan(value) ? 0.0 : value;
  }
  return carried;
}

/// Of the components xx, yy, zz, xy, xz, yz.
inline Eigen::Matrix3d tensor_of(const std::array<double, 6>& t) {
  Eigen::Matrix3d tensor;
  tensor << t[0], t[3], t[4], t[3], t[1], t[5], t[4], t[5], t[2];
  return tensor;
}

}  // namespace comma::solver
