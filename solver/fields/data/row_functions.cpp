#include "solver/fields/data/row_functions.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "solver/error.hpp"
#include "solver/fields/stresses/equivalent.hpp"
#include "solver/fields/stresses/tensor_reader.hpp"

namespace comma::solver {

namespace {

int place_of(const std::vector<std::string>& components, std::string_view name) {
  const auto found = std::ranges::find(components, name);
  return found == components.end() ? -1 : static_cast<int>(found - components.begin());
}

/// The columns xx, yy, zz, xy, xz, yz; -1 where there is none.
std::array<int, 6> tensor_columns(const std::vector<std::string>& components) {
  const auto& names = place_of(components, stress_components[0]) >= 0 ? stress_components : strain_components;
  std::array<int, 6> columns;
  for (std::size_t i = 0; i < 6; ++i) columns[i] = place_of(components, names[i]);
  if (columns[0] < 0) throw Error("incompatible-field", "the field has neither stresses SIXX ... nor strains EPXX ...");
  return columns;
}

Eigen::Matrix3d tensor_in(std::span<const double> row, const std::array<int, 6>& columns) {
  std::array<double, 6> t;
  for (std::size_t i = 0; i < 6; ++i) {
    const double value = columns[i] < 0 ? 0.0 : row[static_cast<std::size_t>(columns[i])];
    t[i] = std::isnan(value) ? 0.0 : value;
  }
  return (Eigen::Matrix3d() << t[0], t[3], t[4], t[3], t[1], t[5], t[4], t[5], t[2]).finished();
}

double value_of(const Eigen::Matrix3d& tensor, TensorCriterion which) {
  switch (which) {
    case TensorCriterion::von_mises:
      return von_mises(tensor);
    case TensorCriterion::tresca:
      return tresca(tensor);
    case TensorCriterion::second_invariant:
      return 2.0 / 3.0 * von_mises(tensor);
    case TensorCriterion::trace:
      break;
  }
  return tensor.trace();
}

}  // namespace

RowFunction criterion(const std::vector<std::string>& components, TensorCriterion which) {
  const auto columns = tensor_columns(components);
  return [columns, which](std::span<const double> row) {
    return std::isnan(row[static_cast<std::size_t>(columns[0])])
               ? absent
               : made_number(value_of(tensor_in(row, columns), which));
  };
}

RowFunction sum_of_squares(std::vector<double> weights) {
  return [weights = std::move(weights)](std::span<const double> row) {
    double square = 0.0;
    bool carried = false;
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (std::isnan(row[i])) continue;
      carried = true;
      square += (weights.empty() ? 1.0 : weights[i]) * row[i] * row[i];
    }
    return carried ? square : absent;
  };
}

RowFunction euclidean_norm(std::vector<double> weights) {
  return
      [squares = sum_of_squares(std::move(weights))](std::span<const double> row) { return std::sqrt(squares(row)); };
}

std::vector<double> frobenius_weights(const std::vector<std::string>& components) {
  std::vector<double> weights;
  for (const std::string& name : components) {
    const bool off_diagonal =
        std::any_of(stress_components.begin() + 3, stress_components.end(), [&](auto each) { return each == name; }) ||
        std::any_of(strain_components.begin() + 3, strain_components.end(), [&](auto each) { return each == name; });
    weights.push_back(off_diagonal ? 2.0 : 1.0);
  }
  return weights;
}

RowFunction formula(const std::vector<std::string>& components, const ValueFunction& function) {
  std::vector<int> columns;
  for (const std::string& parameter : function.parameters) {
    columns.push_back(place_of(components, parameter));
    if (columns.back() < 0)
      throw Error("unknown-component", fmt::format("the formula depends on {}, which the field has not", parameter));
  }
  return [columns = std::move(columns), value = function.value](std::span<const double> row) {
    std::vector<double> at;
    for (const int column : columns) at.push_back(row[static_cast<std::size_t>(column)]);
    return std::ranges::any_of(at, [](double each) { return std::isnan(each); }) ? absent : made_number(value(at));
  };
}

Field made_of_rows(const Field& field, std::span<const RowFunction> functions) {
  const auto made = [&](const auto& source) {
    auto result = source;
    result.quantity = "NEUT_R";
    result.components.clear();
    for (std::size_t i = 0; i < functions.size(); ++i) result.components.push_back(fmt::format("X{}", i + 1));
    const std::size_t width = source.components.size();
    result.values.clear();
    for (std::size_t row = 0; row < source.values.size() / width; ++row) {
      for (const RowFunction& function : functions)
        result.values.push_back(function(std::span(source.values).subspan(row * width, width)));
    }
    return Field(std::move(result));
  };
  return std::visit(made, field);
}

}  // namespace comma::solver
