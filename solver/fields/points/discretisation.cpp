#include "solver/fields/points/discretisation.hpp"

#include "solver/elements/quadrature.hpp"
#include "solver/elements/slender/beam_points.hpp"
#include "solver/error.hpp"
#include "solver/fields/data/field_room.hpp"
#include "solver/fields/data/field_rows.hpp"
#include "solver/fields/points/continuum_points.hpp"
#include "solver/fields/points/extrapolation.hpp"
#include "solver/mesh/reference_element.hpp"

namespace comma::solver {

namespace {

const std::string& quantity_of(const Field& field) {
  return std::visit([](const auto& values) -> const std::string& { return values.quantity; }, field);
}

/// What a field says at the nodes of a cell.
class NodeValues {
 public:
  NodeValues(const Mesh& mesh, const Field& field) : mesh_(mesh), field_(field) {}

  double at(int cell, int node, int component) const {
    if (const auto* nodal = std::get_if<NodalField>(&field_))
      return nodal->at(mesh_.cell(cell)[static_cast<std::size_t>(node)], component);
    const auto& element = std::get<ElementField>(field_);
    if (element.points(cell) == 0) return absent;
    return element.at(cell, element.support == Support::cell ? 0 : node, component);
  }

 private:
  const Mesh& mesh_;
  const Field& field_;
};

/// The weight of each node of a cell at each Gauss point of its element.
class PointWeights {
 public:
  explicit PointWeights(const Model& model) : model_(model), continua_(model) {}

  double operator()(int cell, int points, int point, int node) {
    const CellType type = model_.mesh->cell_types[cell];
    if (continua_.covers(cell)) return continua_.samples(cell)[static_cast<std::size_t>(point)].values[node];
    if (model_.is_skin(cell))
      return at_points(type, boundary_family(type), skins_)[static_cast<std::size_t>(point)][node];
    if (is_plate(model_.formulations[cell]))
      return at_points(type, plate_family(type), plates_)[static_cast<std::size_t>(point)][node];
    // Section forces are linear between the ends, and results say that they lie here (Code_Aster 17.3).
    if (is_beam(model_.formulations[cell]) && points == beam_point_count)
      return at_points(type, "FPG3", beams_)[static_cast<std::size_t>(point)][node];
    if (points == 1) return 1.0 / node_count(type);
    return point == node ? 1.0 : 0.0;  // one point a node
  }

 private:
  using ByType = std::array<std::vector<Eigen::VectorXd>, cell_type_count>;

  static const std::vector<Eigen::VectorXd>& at_points(CellType type, std::string_view family, ByType& known) {
    auto& values = known[static_cast<std::size_t>(type)];
    if (values.empty()) {
      for (const QuadraturePoint& point : quadrature(type, family)) values.push_back(shape_functions(type, point.at));
    }
    return values;
  }

  const Model& model_;
  ContinuumPoints continua_;
  ByType skins_, plates_, beams_;
};

bool is_at_points(const Field& field) {
  const auto* element = std::get_if<ElementField>(&field);
  return element != nullptr && element->support == Support::gauss_point;
}

bool is_one_a_cell(const Field& field) {
  const auto* element = std::get_if<ElementField>(&field);
  return element != nullptr && element->support == Support::cell;
}

double interpolated(const NodeValues& values, PointWeights& weights, int cell, int nodes, int points, int point,
                    int component) {
  double sum = 0.0;
  for (int node = 0; node < nodes; ++node) sum += weights(cell, points, point, node) * values.at(cell, node, component);
  return sum;
}

double mean_at_nodes(const NodalField& field, std::span<const int> nodes, int component) {
  double sum = 0.0;
  for (const int node : nodes) sum += field.at(node, component);
  return sum / static_cast<double>(nodes.size());
}

double mean_over_points(const ElementField& field, int cell, int component) {
  const int points = field.points(cell);
  if (points == 0) return absent;
  double sum = 0.0;
  for (int point = 0; point < points; ++point) sum += field.at(cell, point, component);
  return sum / points;
}

ElementField mean_over_cells(const Model& model, const Field& field, bool skin) {
  const Mesh& mesh = *model.mesh;
  const auto* nodal = std::get_if<NodalField>(&field);
  if (nodal == nullptr) require_one_value_a_point(mesh, std::get<ElementField>(field));
  ElementField result = empty_element_field(model, quantity_of(field), Support::cell, components_of(field), skin);
  const auto width = static_cast<int>(result.components.size());
  auto slot = result.values.begin();
  for (int cell = 0; cell < mesh.cell_count(); ++cell) {
    if (result.points(cell) == 0) continue;
    for (int component = 0; component < width; ++component)
      *slot++ = nodal != nullptr ? mean_at_nodes(*nodal, mesh.cell(cell), component)
                                 : mean_over_points(std::get<ElementField>(field), cell, component);
  }
  return result;
}

}  // namespace

ElementField brought_to(const Model& model, const Field& field, Support support, bool skin) {
  if (support == Support::cell && !is_one_a_cell(field)) return mean_over_cells(model, field, skin);
  if (is_at_points(field) && support != Support::gauss_point) {
    return brought_to(model, to_element_nodes(model, std::get<ElementField>(field)), support, skin);
  }
  if (is_at_points(field)) return std::get<ElementField>(field);
  const Mesh& mesh = *model.mesh;
  const NodeValues values(mesh, field);
  PointWeights weights(model);
  ElementField result = empty_element_field(model, quantity_of(field), support, components_of(field), skin);
  const auto width = static_cast<int>(result.components.size());
  auto slot = result.values.begin();
  for (int cell = 0; cell < mesh.cell_count(); ++cell) {
    const int points = result.points(cell), nodes = node_count(mesh.cell_types[cell]);
    for (int point = 0; point < points; ++point) {
      for (int component = 0; component < width; ++component) {
        const bool direct = support != Support::gauss_point || is_one_a_cell(field);
        *slot++ = direct ? values.at(cell, support == Support::element_node ? point : 0, component)
                         : interpolated(values, weights, cell, nodes, points, point, component);
      }
    }
  }
  return result;
}

NodalField brought_to_nodes(const Mesh& mesh, const Model* model, const Field& field) {
  if (const auto* nodal = std::get_if<NodalField>(&field)) return *nodal;
  const auto& element = std::get<ElementField>(field);
  if (element.support == Support::element_node) return nodal_means(mesh, element);
  if (element.support == Support::gauss_point) {
    if (model == nullptr)
      throw Error("missing-model", "a field at Gauss points is brought to nodes by the elements of a model");
    return nodal_means(mesh, to_element_nodes(*model, element));
  }
  ElementField spread{element.quantity, Support::element_node, element.components, {0}, {}};
  const auto width = static_cast<std::ptrdiff_t>(element.components.size());
  for (int cell = 0; cell < mesh.cell_count(); ++cell) {
    const int nodes = element.points(cell) > 0 ? node_count(mesh.cell_types[cell]) : 0;
    for (int node = 0; node < nodes; ++node) {
      const auto begin = element.values.begin() + element.starts[cell] * width;
      spread.values.insert(spread.values.end(), begin, begin + width);
    }
    spread.starts.push_back(spread.starts.back() + nodes);
  }
  return nodal_means(mesh, spread);
}

}  // namespace comma::solver
