// Local average contact: the patch test on meshes that do not match, in the plane and in space.
#include <cmath>
#include <functional>
#include <map>
#include <numbers>

#include <catch2/catch.hpp>

#include "solver/error.hpp"
#include "solver/mesh/conversion.hpp"
#include "solver/mesh/slave_cut.hpp"
#include "solver/tests/nonlinear/scene.hpp"

using namespace comma::solver;

namespace local_average_test {

constexpr double young = 2000.0;
constexpr double poisson = 0.3;
constexpr double load = 25.0;

/// Two blocks, one on the other, of `lower` and `upper` cells a side; contact at the height 1. Nodes are moved along
/// the contact so that its facets are no rectangles; outlines stay.
class Stack {
 public:
  Stack(int dimension, int lower, int upper, bool is_simplex) : dimension_(dimension), is_simplex_(is_simplex) {
    mesh_.dimension = dimension;
    block("LOWER", 0.0, lower, 0.11);
    block("UPPER", 1.0, upper, -0.08);
  }

  /// Before the cut.
  void convert(Conversion conversion) { mesh_ = converted(mesh_, all_cells(), conversion); }

  const Result& solve(bool upper_is_slave, HexaCut cut = HexaCut::pyramids) {
    const std::string slave = upper_is_slave ? "UPPER_BOTTOM" : "LOWER_TOP";
    const std::string master = upper_is_slave ? "LOWER_TOP" : "UPPER_BOTTOM";
    const auto mesh = std::make_shared<Mesh>(with_cut_slave_faces(mesh_, mesh_.cell_group(slave), cut));
    auto model = std::make_shared<Model>();
    auto materials = std::make_shared<MaterialField>();
    model->mesh = mesh;
    Material steel;
    steel.elasticity = IsotropicElasticity{.young = young, .poisson = poisson};
    const auto shared = std::make_shared<const Material>(steel);
    for (int cell = 0; cell < mesh->cell_count(); ++cell) {
      model->formulations.push_back(dimension_ == 2 ? Formulation::plane_strain : Formulation::solid);
      materials->by_cell.push_back(dimension(mesh->cell_types[cell]) == dimension_ ? shared : nullptr);
    }
    StaticProblem problem;
    problem.model = model;
    problem.materials = materials;
    problem.properties = std::make_shared<ElementProperties>();
    problem.loads = {{loads(*mesh), {}}};
    ContactDefinition contact;
    contact.formulation = ContactFormulation::mixed;
    contact.max_geometry_updates = 50;
    ContactZone& zone = contact.zones.emplace_back();
    zone.master_cells = mesh->cell_group(master);
    zone.slave_cells = mesh->cell_group(slave);
    zone.mixed.local_average = true;
    // A patch and what it faces of a distorted master differ a little: surfaces are paired until they are at rest.
    contact.geometry_tolerance = 1e-9;
    problem.contact = contact;
    Counters counters;
    result_ = {};
    solve_static(problem, std::vector<double>{0.0, 1.0}, {}, result_, counters);
    return result_;
  }

 private:
  std::vector<int> all_cells() const {
    std::vector<int> cells;
    for (int cell = 0; cell < mesh_.cell_count(); ++cell) cells.push_back(cell);
    return cells;
  }

  int vertical() const { return dimension_ - 1; }

  void block(const std::string& name, double height, int n, double skew) {
    const int rows = dimension_ == 3 ? n : 0;
    std::map<std::array<int, 3>, int> at;
    for (int k = 0; k <= n; ++k)
      for (int j = 0; j <= rows; ++j)
        for (int i = 0; i <= n; ++i) {
          const double x = 1.0 * i / n;
          const double y = dimension_ == 3 ? 1.0 * j / n : 0.5;
          const double bump = skew * std::sin(std::numbers::pi * x) * std::sin(std::numbers::pi * y);
          Point place{};
          place[0] = x + bump;
          if (dimension_ == 3) place[1] = y - 0.7 * bump;
          place[static_cast<std::size_t>(vertical())] = height + 1.0 * k / n;
          at[{i, j, k}] = mesh_.node_count();
          mesh_.nodes.push_back(place);
        }
    for (int k = 0; k < n; ++k)
      for (int j = 0; j < std::max(1, rows); ++j)
        for (int i = 0; i < n; ++i) {
          const auto corner = [&](int a, int b, int c) { return at.at({i + a, j + b, k + c}); };
          if (dimension_ == 2) {
            face_cells(name, {corner(0, 0, 0), corner(1, 0, 0), corner(1, 0, 1), corner(0, 0, 1)});
            if (k == 0) add(name + "_BOTTOM", CellType::seg2, {corner(0, 0, 0), corner(1, 0, 0)});
            if (k == n - 1) add(name + "_TOP", CellType::seg2, {corner(1, 0, 1), corner(0, 0, 1)});
            continue;
          }
          solid_cells(name, {corner(0, 0, 0), corner(1, 0, 0), corner(1, 1, 0), corner(0, 1, 0), corner(0, 0, 1),
                             corner(1, 0, 1), corner(1, 1, 1), corner(0, 1, 1)});
          if (k == 0)
            face_cells(name + "_BOTTOM", {corner(0, 0, 0), corner(0, 1, 0), corner(1, 1, 0), corner(1, 0, 0)});
          if (k == n - 1)
            face_cells(name + "_TOP", {corner(0, 0, 1), corner(1, 0, 1), corner(1, 1, 1), corner(0, 1, 1)});
        }
  }

  void add(const std::string& group, CellType type, const std::vector<int>& nodes) {
    mesh_.cell_groups[group].push_back(mesh_.add_cell(type, nodes));
  }

  /// The diagonal of a quadrangle from its first corner to its third: that of the tetrahedra.
  void face_cells(const std::string& group, const std::array<int, 4>& n) {
    if (!is_simplex_) return add(group, CellType::quad4, {n[0], n[1], n[2], n[3]});
    add(group, CellType::tria3, {n[0], n[1], n[2]});
    add(group, CellType::tria3, {n[0], n[2], n[3]});
  }

  /// Six tetrahedra around the diagonal of the cube (Kuhn).
  void solid_cells(const std::string& group, const std::array<int, 8>& n) {
    if (!is_simplex_) return add(group, CellType::hexa8, {n.begin(), n.end()});
    for (const auto& [a, b] :
         {std::pair(1, 2), std::pair(2, 3), std::pair(3, 7), std::pair(7, 4), std::pair(4, 5), std::pair(5, 1)})
      add(group, CellType::tetra4, {n[0], n[static_cast<std::size_t>(a)], n[static_cast<std::size_t>(b)], n[6]});
  }

  std::shared_ptr<const Load> loads(const Mesh& mesh) const {
    auto made = std::make_shared<Load>();
    const auto hold = [&](int axis, double where) {
      for (int node = 0; node < mesh.node_count(); ++node) {
        if (std::abs(mesh.nodes[node][static_cast<std::size_t>(axis)] - where) > 1e-12) continue;
        LinearRelation relation;
        relation.terms = {{node, static_cast<Component>(axis), 1.0}};
        relation.origin = std::make_shared<const std::string>("held in the test");
        made->relations.push_back(relation);
      }
    };
    for (int axis = 0; axis < dimension_; ++axis) hold(axis, 0.0);
    for (const int cell : mesh.cell_group("UPPER_TOP")) {
      PressureLoad push;
      push.cell = cell;
      push.pressure = load;
      made->pressures.push_back(push);
    }
    return made;
  }

  int dimension_;
  bool is_simplex_;
  Mesh mesh_;
  Result result_;
};

/// The vertical stress is uniform, and so is the pressure of contact.
void check_uniform(const Result& result, const char* vertical_stress) {
  const ResultStep& last = result.steps.back();
  const auto& stress = std::get<ElementField>(last.fields.at("SIEF_ELGA"));
  const int column = stress.component(vertical_stress);
  double worst = 0.0;
  for (std::size_t i = static_cast<std::size_t>(column); i < stress.values.size(); i += stress.components.size())
    worst = std::max(worst, std::abs(stress.values[i] + load));
  CHECK(worst < 1e-10 * load);
  const auto& moved = std::get<NodalField>(last.fields.at("DEPL"));
  const int pressure = moved.component("LAGS_C");
  REQUIRE(pressure >= 0);
  int count = 0;
  for (std::size_t i = static_cast<std::size_t>(pressure); i < moved.values.size(); i += moved.components.size()) {
    if (std::isnan(moved.values[i])) continue;
    CHECK(moved.values[i] == Approx(-load).epsilon(1e-10));
    ++count;
  }
  CHECK(count > 0);
  const auto& state = std::get<ElementField>(last.fields.at("CONT_ELEM"));
  for (std::size_t i = static_cast<std::size_t>(state.component("COEFSURF")); i < state.values.size();
       i += state.components.size())
    CHECK(state.values[i] == Approx(1.0).epsilon(1e-10));
}

TEST_CASE("Local average contact passes the patch test in the plane") {
  for (const bool is_simplex : {false, true})
    for (const bool is_quadratic : {false, true})
      for (const bool upper_is_slave : {false, true}) {
        CAPTURE(is_simplex, is_quadratic, upper_is_slave);
        Stack stack(2, 5, 7, is_simplex);
        if (is_quadratic) stack.convert(Conversion::to_quadratic);
        check_uniform(stack.solve(upper_is_slave), "SIYY");
      }
}

TEST_CASE("Local average contact passes the patch test in space") {
  for (const bool is_simplex : {false, true})
    for (const bool upper_is_slave : {false, true}) {
      CAPTURE(is_simplex, upper_is_slave);
      Stack stack(3, 2, 3, is_simplex);
      check_uniform(stack.solve(upper_is_slave), "SIZZ");
    }
  Stack stack(3, 2, 3, false);
  check_uniform(stack.solve(true, HexaCut::hexahedra), "SIZZ");
}

TEST_CASE("Local average contact passes the patch test in space on quadratic cells") {
  Stack tetrahedra(3, 1, 2, true);
  tetrahedra.convert(Conversion::to_quadratic);
  check_uniform(tetrahedra.solve(true), "SIZZ");
  Stack hexahedra(3, 1, 2, false);
  hexahedra.convert(Conversion::to_quadratic);
  hexahedra.convert(Conversion::hexa20_to_27);
  check_uniform(hexahedra.solve(true), "SIZZ");
}

}  // namespace local_average_test
