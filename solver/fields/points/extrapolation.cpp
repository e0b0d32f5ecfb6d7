#include "solver/fields/points/extrapolation.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "solver/elements/quadrature.hpp"
#include "solver/elements/slender/beam_points.hpp"
#include "solver/error.hpp"
#include "solver/mesh/reference_element.hpp"
#include "solver/model/stress_names.hpp"

namespace comma::solver {

namespace {

constexpr std::array<std::string_view, 14> structural_force_names = {"N",   "VY",  "VZ",  "MT",  "MFY", "MFZ", "NXX",
                                                                     "NYY", "NXY", "MXX", "MYY", "MXY", "QX",  "QY"};

CellType linear_type(CellType type) {
  switch (dimension(type) * 10 + corner_count(type)) {
    case 1:
      return CellType::poi1;
    case 12:
      return CellType::seg2;
    case 23:
      return CellType::tria3;
    case 24:
      return CellType::quad4;
    case 34:
      return CellType::tetra4;
    case 35:
      return CellType::pyram5;
    case 36:
      return CellType::penta6;
    default:
      return CellType::hexa8;
  }
}

/// Row per place, column per corner.
Eigen::MatrixXd linear_functions(CellType type, std::span<const ReferencePoint> places) {
  const CellType linear = linear_type(type);
  Eigen::MatrixXd values(static_cast<Eigen::Index>(places.size()), corner_count(type));
  for (std::size_t i = 0; i < places.size(); ++i) {
    values.row(static_cast<Eigen::Index>(i)) = shape_functions(linear, places[i]).transpose();
  }
  return values;
}

/// The smoothing matrices of the cell types, made when first asked for.
class Smoothing {
 public:
  explicit Smoothing(const Model& model) : model_(model) {}

  const Eigen::MatrixXd& of(int cell, int points) {
    const CellType type = model_.mesh->cell_types[cell];
    auto& known = matrices_[static_cast<std::size_t>(type)];
    const auto found =
        std::find_if(known.begin(), known.end(), [&](const auto& matrix) { return matrix.cols() == points; });
    if (found != known.end()) return *found;
    known.push_back(make(cell, points));
    return known.back();
  }

 private:
  Eigen::MatrixXd make(int cell, int points) const {
    const CellType type = model_.mesh->cell_types[cell];
    const int nodes = node_count(type);
    if (points == 1) return Eigen::MatrixXd::Ones(nodes, 1);
    if (model_.is_skin(cell)) {
      Eigen::MatrixXd matrix = gauss_to_nodes(type, boundary_family(type));
      if (matrix.cols() == points) return matrix;
    }
    const Formulation formulation = model_.formulations[cell];
    const bool is_surface = is_plate(formulation) && dimension(type) == 2;
    if (is_surface || continuum_dimension(formulation) == dimension(type)) {
      Eigen::MatrixXd matrix =
          gauss_to_nodes(type, is_surface ? plate_family(type) : stiffness_family(type, formulation));
      if (matrix.cols() == points) return matrix;
    } else if (is_beam(formulation) && points == beam_point_count) {
      Eigen::MatrixXd ends = Eigen::MatrixXd::Zero(nodes, points);
      ends(0, 0) = ends(1, points - 1) = 1.0;
      return ends;
    } else if (points == nodes) {
      return Eigen::MatrixXd::Identity(nodes, nodes);
    }
    throw Error("incompatible-field",
                fmt::format("the field has {} points on cell {}, whose element has another number", points,
                            model_.mesh->cell_name(cell)));
  }

  const Model& model_;
  std::array<std::vector<Eigen::MatrixXd>, cell_type_count> matrices_;
};

}  // namespace

Eigen::MatrixXd gauss_to_nodes(CellType type, std::string_view family) {
  std::vector<ReferencePoint> points;
  for (const QuadraturePoint& point : quadrature(type, family)) points.push_back(point.at);
  const auto nodes = reference_nodes(type);
  if (points.size() == 1) return Eigen::MatrixXd::Ones(static_cast<Eigen::Index>(nodes.size()), 1);
  const Eigen::MatrixXd at_points = linear_functions(type, points);
  const Eigen::MatrixXd at_nodes = linear_functions(type, nodes);
  const Eigen::MatrixXd normal = at_points.transpose() * at_points;
  return at_nodes * normal.ldlt().solve(at_points.transpose());
}

namespace {

/// `matrix_of(cell, points)`: nodes x points.
template <typename MatrixOf>
ElementField smoothed(const Mesh& mesh, const ElementField& field, MatrixOf&& matrix_of) {
  const auto width = static_cast<Eigen::Index>(field.components.size());
  ElementField result{field.quantity, Support::element_node, field.components, {0}, {}};
  result.starts.reserve(field.starts.size());
  for (int cell = 0; cell < mesh.cell_count(); ++cell) {
    const int nodes = field.points(cell) > 0 ? static_cast<int>(mesh.cell(cell).size()) : 0;
    result.starts.push_back(result.starts.back() + nodes);
  }
  result.values.resize(static_cast<std::size_t>(result.starts.back()) * field.components.size());
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  for (int cell = 0; cell < mesh.cell_count(); ++cell) {
    const int points = field.points(cell);
    if (points == 0) continue;
    const Eigen::MatrixXd& matrix = matrix_of(cell, points);
    const Eigen::Map<const Rows> given(field.values.data() + field.starts[cell] * width, points, width);
    Eigen::Map<Rows> target(result.values.data() + result.starts[cell] * width, matrix.rows(), width);
    // Without the lazy product a temporary would be allocated for each cell.
    target = matrix.lazyProduct(given);
  }
  return result;
}

}  // namespace

ElementField to_element_nodes(const Model& model, const ElementField& field) {
  Smoothing smoothing(model);
  return smoothed(*model.mesh, field,
                  [&](int cell, int points) -> const Eigen::MatrixXd& { return smoothing.of(cell, points); });
}

ElementField to_element_nodes(const Model& model, const NodalField& field) {
  const Mesh& mesh = *model.mesh;
  const auto width = static_cast<int>(field.components.size());
  const auto carries = [&](int node) {
    for (int c = 0; c < width; ++c) {
      if (!std::isnan(field.at(node, c))) return true;
    }
    return false;
  };
  ElementField result{field.quantity, Support::element_node, field.components, {0}, {}};
  for (int cell = 0; cell < mesh.cell_count(); ++cell) {
    const auto nodes = mesh.cell(cell);
    const bool element = model.formulations[cell] != Formulation::none && !model.is_skin(cell);
    const bool carried = element && std::all_of(nodes.begin(), nodes.end(), carries);
    for (std::size_t a = 0; carried && a < nodes.size(); ++a) {
      for (int c = 0; c < width; ++c) result.values.push_back(field.at(nodes[a], c));
    }
    result.starts.push_back(result.starts.back() + (carried ? static_cast<int>(nodes.size()) : 0));
  }
  return result;
}

namespace {

/// visit(cell) for those of the cells, or for all where none are given.
template <class Visit>
void each_cell(const ElementField& field, const std::optional<std::span<const int>>& cells, Visit&& visit) {
  if (cells) {
    for (const int cell : *cells) visit(cell);
    return;
  }
  for (int cell = 0; cell + 1 < static_cast<int>(field.starts.size()); ++cell) visit(cell);
}

}  // namespace

std::vector<int> layered_cells(const ElementField& field, std::optional<std::span<const int>> cells) {
  std::vector<int> found;
  if (field.sub_points.empty()) return found;
  each_cell(field, cells, [&](int cell) {
    if (field.points(cell) > 0 && field.values_a_point(cell) > 1) found.push_back(cell);
  });
  return found;
}

void require_one_value_a_point(const Mesh& mesh, const ElementField& field, std::optional<std::span<const int>> cells) {
  const std::vector<int> layered = layered_cells(field, cells);
  if (layered.empty()) return;
  throw Error(
      "layered-field",
      fmt::format("the field has {} values a point on cell {}, one for each place in the thickness of the plate",
                  field.values_a_point(layered.front()), mesh.cell_name(layered.front())),
      "take one layer: POST_CHAMP with EXTR_COQUE");
}

NodalField nodal_means(const Mesh& mesh, const ElementField& field, std::optional<std::span<const int>> cells) {
  require_one_value_a_point(mesh, field, cells);
  const std::size_t width = field.components.size();
  NodalField result{field.quantity, field.components, std::vector<double>(mesh.nodes.size() * width, 0.0)};
  std::vector<int> counts(result.values.size(), 0);
  each_cell(field, cells, [&](int cell) {
    const auto nodes = mesh.cell(cell);
    for (int point = 0; point < field.points(cell); ++point) {
      for (std::size_t c = 0; c < width; ++c) {
        const double value = field.at(cell, point, static_cast<int>(c));
        if (std::isnan(value)) continue;
        const std::size_t slot = static_cast<std::size_t>(nodes[point]) * width + c;
        result.values[slot] += value;
        ++counts[slot];
      }
    }
  });
  for (std::size_t slot = 0; slot < counts.size(); ++slot) {
    result.values[slot] = counts[slot] > 0 ? result.values[slot] / counts[slot] : absent;
  }
  return result;
}

NodalField single_valued_means(const Mesh& mesh, const ElementField& field, std::optional<std::span<const int>> cells) {
  const std::vector<int> layered = layered_cells(field, cells);
  if (layered.empty()) return nodal_means(mesh, field, cells);
  std::vector<int> others;
  each_cell(field, cells, [&](int cell) {
    if (field.points(cell) > 0 && field.values_a_point(cell) == 1) others.push_back(cell);
  });
  if (others.empty()) require_one_value_a_point(mesh, field, cells);
  NodalField means = nodal_means(mesh, field, others);
  const std::size_t width = means.components.size();
  for (const int cell : layered)
    for (const int node : mesh.cell(cell))
      std::fill_n(means.values.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(node) * width), width,
                  absent);
  return means;
}

ElementField select_components(const ElementField& field, std::span<const std::string_view> names) {
  ElementField result{field.quantity, field.support, {}, {0}, {}};
  std::vector<int> columns;
  for (const std::string_view name : names) {
    const int column = field.component(name);
    if (column < 0) continue;
    columns.push_back(column);
    result.components.emplace_back(name);
  }
  const auto cell_count = static_cast<int>(field.starts.size()) - 1;
  for (int cell = 0; cell < cell_count; ++cell) {
    const bool carries = field.points(cell) > 0 && std::any_of(columns.begin(), columns.end(), [&](int column) {
                           return !std::isnan(field.at(cell, 0, column));
                         });
    for (int point = 0; carries && point < field.points(cell); ++point) {
      for (const int column : columns) result.values.push_back(field.at(cell, point, column));
    }
    result.starts.push_back(result.starts.back() + (carries ? field.points(cell) : 0));
  }
  return result;
}

ElementField continuum_stresses(const ElementField& field) { return select_components(field, solid_stress_names); }

ElementField section_forces(const ElementField& field) { return select_components(field, structural_force_names); }

}  // namespace comma::solver
