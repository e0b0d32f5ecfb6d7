// Fields on nodes and on elements, and the results that hold them.
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "solver/model/model.hpp"

namespace comma::solver {

inline constexpr double absent = std::numeric_limits<double>::quiet_NaN();

/// values[node * components.size() + component]; NaN where the node does not carry the component.
struct NodalField {
  std::string quantity;                 ///< "DEPL_R", "SIEF_R", ...
  std::vector<std::string> components;  ///< "DX", "DY" ...
  std::vector<double> values;

  double at(int node, int component) const {
    return values[static_cast<std::size_t>(node) * components.size() + component];
  }
  /// Index of a component, -1 if there is none.
  int component(std::string_view name) const;
};

enum class Support : std::uint8_t { cell, element_node, gauss_point };

/// values[(starts[cell] + point) * components.size() + component]; starts has cell_count()+1 entries, and a cell that
/// does not carry the field has no points; NaN where the cell does not carry the component. Where plates have several
/// values a point, one for each place in their thickness, the values of a point follow each other, `starts` counts them
/// all, and sub_points says how many they are.
struct ElementField {
  std::string quantity;
  Support support = Support::cell;
  std::vector<std::string> components;
  std::vector<int> starts;
  std::vector<double> values;
  std::vector<int> sub_points = {};  ///< values a point, by cell; empty: one everywhere

  /// Values of the cell: its points, times the values of each.
  int points(int cell) const { return starts[cell + 1] - starts[cell]; }
  int values_a_point(int cell) const { return sub_points.empty() ? 1 : sub_points[cell]; }
  double at(int cell, int point, int component) const {
    return values[static_cast<std::size_t>(starts[cell] + point) * components.size() + component];
  }
  int component(std::string_view name) const;
};

using Field = std::variant<NodalField, ElementField>;

inline const std::vector<double>& values_of(const Field& field) {
  return std::visit([](const auto& any) -> const std::vector<double>& { return any.values; }, field);
}
inline std::vector<double>& values_of(Field& field) {
  return std::visit([](auto& any) -> std::vector<double>& { return any.values; }, field);
}

/// At how many instants, of fields in time, a place has a value.
enum class Coverage : std::uint8_t { none, partial, whole };

struct ContactMemory;

/// One archived step.
struct ResultStep {
  int order = 0;
  double instant = 0.0;
  std::map<std::string, Field, std::less<>> fields;       ///< "DEPL", "SIEF_ELGA", "FORC_NODA" ...
  std::set<std::string, std::less<>> limited = {};        ///< those that were computed on some cells only
  std::map<std::string, double, std::less<>> parameters;  ///< "ITER_GLOB" ...
  std::shared_ptr<const ContactMemory> contact = {};      ///< null: none, or one that remembers nothing
};

/// Steps in rising order and instant, on a model or on a mesh alone (temperatures in time).
struct Result {
  std::shared_ptr<const Model> model;  ///< null: the fields lie on `bare_mesh`
  std::vector<ResultStep> steps;
  std::shared_ptr<const Mesh> bare_mesh = {};

  const Mesh& mesh() const { return model ? *model->mesh : *bare_mesh; }
};

}  // namespace comma::solver
