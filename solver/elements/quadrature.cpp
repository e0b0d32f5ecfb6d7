#include "solver/elements/quadrature.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "solver/error.hpp"

namespace comma::solver {

namespace {

struct Rule {
  std::string_view name;
  int degree;
  Quadrature (*make)();
};

const double third = 1.0 / 3;
const double gauss2 = 1.0 / std::sqrt(3.0);
const double gauss3 = std::sqrt(0.6);

/// The n-point Gauss rule as (abscissa, weight) with rising abscissae.
std::vector<std::array<double, 2>> gauss(int points) {
  if (points == 1) return {{0.0, 2.0}};
  if (points == 2) return {{-gauss2, 1.0}, {gauss2, 1.0}};
  if (points == 3) return {{-gauss3, 5.0 / 9}, {0.0, 8.0 / 9}, {gauss3, 5.0 / 9}};
  const double inner = std::sqrt(3.0 / 7 - 2.0 / 7 * std::sqrt(1.2));
  const double outer = std::sqrt(3.0 / 7 + 2.0 / 7 * std::sqrt(1.2));
  const double inner_weight = (18.0 + std::sqrt(30.0)) / 36;
  const double outer_weight = (18.0 - std::sqrt(30.0)) / 36;
  return {{-outer, outer_weight}, {-inner, inner_weight}, {inner, inner_weight}, {outer, outer_weight}};
}

// --- segments (R3.01.01, section 2)

Quadrature segment1() { return {{{0, 0, 0}, 2.0}}; }
Quadrature segment2() { return {{{gauss2, 0, 0}, 1.0}, {{-gauss2, 0, 0}, 1.0}}; }
Quadrature segment3() { return {{{-gauss3, 0, 0}, 5.0 / 9}, {{0, 0, 0}, 8.0 / 9}, {{gauss3, 0, 0}, 5.0 / 9}}; }

Quadrature segment4() {
  const auto rule = gauss(4);
  Quadrature points;
  for (const int i : {2, 1, 3, 0}) points.push_back({{rule[i][0], 0, 0}, rule[i][1]});
  return points;
}

// --- triangles (section 3.1)

/// (a, a), (1 - 2a, a), (a, 1 - 2a): the three images of a point on a median.
void add_median(Quadrature& points, double a, double weight) {
  points.push_back({{a, a, 0}, weight});
  points.push_back({{1 - 2 * a, a, 0}, weight});
  points.push_back({{a, 1 - 2 * a, 0}, weight});
}

Quadrature triangle1() { return {{{third, third, 0}, 0.5}}; }

Quadrature triangle3() {
  Quadrature points;
  add_median(points, 1.0 / 6, 1.0 / 6);
  return points;
}

Quadrature triangle4() {
  Quadrature points;
  add_median(points, 0.2, 25.0 / 96);
  points.push_back({{third, third, 0}, -27.0 / 96});
  return points;
}

/// Degree 4 of Dunavant (1985), in closed form: a and b are the roots of the moment equations on the two medians.
Quadrature triangle6() {
  const double root = std::sqrt(10.0);
  const double inner = std::sqrt(38.0 - 44.0 * std::sqrt(0.4));
  const double a = (8.0 - root + inner) / 18;
  const double b = (8.0 - root - inner) / 18;
  const double spread = std::sqrt(213125.0 - 53320.0 * root);
  const double a_weight = (620.0 + spread) / 7440;
  const double b_weight = (620.0 - spread) / 7440;
  Quadrature points;
  add_median(points, b, b_weight);
  points.push_back({{a, 1 - 2 * a, 0}, a_weight});
  points.push_back({{a, a, 0}, a_weight});
  points.push_back({{1 - 2 * a, a, 0}, a_weight});
  return points;
}

/// Degree 5 of Radon.
Quadrature triangle7() {
  const double root = std::sqrt(15.0);
  Quadrature points = {{{third, third, 0}, 9.0 / 80}};
  add_median(points, (6 + root) / 21, (155 + root) / 2400);
  add_median(points, (6 - root) / 21, (155 - root) / 2400);
  return points;
}

// --- quadrangles (section 3.2): round the corners, then round the sides, then the centre

Quadrature quadrangle1() { return {{{0, 0, 0}, 4.0}}; }

Quadrature quadrangle4() {
  Quadrature points;
  for (const auto& node : reference_nodes(CellType::quad4))
    points.push_back({{gauss2 * node[0], gauss2 * node[1], 0}, 1.0});
  return points;
}

Quadrature quadrangle9() {
  Quadrature points;
  for (const auto& node : reference_nodes(CellType::quad9)) {
    const double weight = (node[0] == 0 ? 8.0 : 5.0) * (node[1] == 0 ? 8.0 : 5.0) / 81;
    points.push_back({{gauss3 * node[0], gauss3 * node[1], 0}, weight});
  }
  return points;
}

// --- tetrahedra (section 4.1)

/// (a, a, a), (a, a, c), (a, c, a), (c, a, a).
void add_vertex_orbit(Quadrature& points, double a, double c, double weight) {
  points.push_back({{a, a, a}, weight});
  points.push_back({{a, a, c}, weight});
  points.push_back({{a, c, a}, weight});
  points.push_back({{c, a, a}, weight});
}

Quadrature tetrahedron1() { return {{{0.25, 0.25, 0.25}, 1.0 / 6}}; }

Quadrature tetrahedron4() {
  const double root = std::sqrt(5.0);
  Quadrature points;
  add_vertex_orbit(points, (5 - root) / 20, (5 + 3 * root) / 20, 1.0 / 24);
  return points;
}

Quadrature tetrahedron5() {
  Quadrature points = {{{0.25, 0.25, 0.25}, -2.0 / 15}};
  add_vertex_orbit(points, 1.0 / 6, 0.5, 3.0 / 40);
  return points;
}

/// Degree 5 of Keast.
Quadrature tetrahedron15() {
  const double root = std::sqrt(15.0);
  Quadrature points = {{{0.25, 0.25, 0.25}, 8.0 / 405}};
  add_vertex_orbit(points, (7 + root) / 34, (13 - 3 * root) / 34, (2665 - 14 * root) / 226800);
  add_vertex_orbit(points, (7 - root) / 34, (13 + 3 * root) / 34, (2665 + 14 * root) / 226800);
  const double d = (5 - root) / 20;
  const double e = (5 + root) / 20;
  const double weight = 5.0 / 567;
  for (const ReferencePoint& at : {ReferencePoint{d, d, e}, {d, e, d}, {e, d, d}, {d, e, e}, {e, d, e}, {e, e, d}}) {
    points.push_back({at, weight});
  }
  return points;
}

// --- pentahedra (section 4.2): for each level of the axis, the points of a triangle family in (y, z)

Quadrature levels(const std::vector<std::array<double, 2>>& axis, const Quadrature& triangle) {
  Quadrature points;
  for (const auto& [x, weight] : axis) {
    for (const auto& point : triangle) points.push_back({{x, point.at[0], point.at[1]}, weight * point.weight});
  }
  return points;
}

Quadrature pentahedron6() {
  const double w = 1.0 / 6;
  return levels(gauss(2), {{{0.5, 0.5, 0}, w}, {{0, 0.5, 0}, w}, {{0.5, 0, 0}, w}});
}

Quadrature pentahedron8() {
  const Quadrature triangle = triangle4();
  return levels(gauss(2), {triangle[3], triangle[1], triangle[2], triangle[0]});
}

Quadrature pentahedron21() { return levels(gauss(3), triangle7()); }

// --- pyramids (section 4.4)

Quadrature pyramid5() {
  const double low = 0.1531754163448146;
  const double high = 0.6372983346207416;
  const double w = 2.0 / 15;
  return {{{0.5, 0, low}, w}, {{0, 0.5, low}, w}, {{-0.5, 0, low}, w}, {{0, -0.5, low}, w}, {{0, 0, high}, w}};
}

/// The one symmetric rule of degree 4 with 10 points inside and positive weights (Witherden, Vincent, "On the
/// identification of symmetric quadrature rules for finite element methods", Comput. Math. Appl. 69, 2015): two points
/// on the axis, four towards the lateral faces, four towards the lateral edges, in Code_Aster's order.
Quadrature pyramid10() {
  const double lower = 0.1251369531087467, lower_weight = 0.13792226839303498;
  const double upper = 0.67723278888613725, upper_weight = 0.07582792211376134;
  const double face = 0.65058155639823279, face_z = 0.32238414957821382, face_weight = 0.07088305859288356;
  const double edge = 0.65796699712168982, edge_z = 0.039248283898815378, edge_weight = 0.04234606044708402;
  const double half = 0.5 * face;
  return {{{0, 0, upper}, upper_weight},         {{0, 0, lower}, lower_weight},
          {{-half, -half, face_z}, face_weight}, {{-half, half, face_z}, face_weight},
          {{half, half, face_z}, face_weight},   {{half, -half, face_z}, face_weight},
          {{-edge, 0, edge_z}, edge_weight},     {{0, -edge, edge_z}, edge_weight},
          {{0, edge, edge_z}, edge_weight},      {{edge, 0, edge_z}, edge_weight}};
}

/// Gauss points of the cube, collapsed on the apex and turned by 45 degrees; the height has the Gauss-Jacobi weight
/// (1-z)^2.
Quadrature pyramid27() {
  const std::array<std::array<double, 2>, 3> heights = {{{0.07299402407314973, 0.15713636106488667},
                                                         {0.34700376603835188, 0.14624626925986602},
                                                         {0.70500220988849838, 0.02995070300858064}}};
  const auto rule = gauss(3);
  Quadrature points;
  for (const auto& [z, height_weight] : heights) {
    for (const auto& [s, s_weight] : rule) {
      for (const auto& [t, t_weight] : rule) {
        const double x = 0.5 * (s - t) * (1 - z);
        const double y = 0.5 * (s + t) * (1 - z);
        points.push_back({{x, y, z}, 0.5 * s_weight * t_weight * height_weight});
      }
    }
  }
  return points;
}

// --- hexahedra (section 4.3): x is the slowest

Quadrature cube(int points_per_side) {
  const auto rule = gauss(points_per_side);
  Quadrature points;
  for (const auto& [x, wx] : rule) {
    for (const auto& [y, wy] : rule) {
      for (const auto& [z, wz] : rule) points.push_back({{x, y, z}, wx * wy * wz});
    }
  }
  return points;
}

Quadrature hexahedron1() { return cube(1); }
Quadrature hexahedron8() { return cube(2); }
Quadrature hexahedron27() { return cube(3); }

constexpr Rule segment_rules[] = {
    {"FPG1", 1, segment1}, {"FPG2", 3, segment2}, {"FPG3", 5, segment3}, {"FPG4", 7, segment4}};
constexpr Rule triangle_rules[] = {{"FPG1", 1, triangle1},
                                   {"FPG3", 2, triangle3},
                                   {"FPG4", 3, triangle4},
                                   {"FPG6", 4, triangle6},
                                   {"FPG7", 5, triangle7}};
constexpr Rule quadrangle_rules[] = {{"FPG1", 1, quadrangle1}, {"FPG4", 3, quadrangle4}, {"FPG9", 5, quadrangle9}};
constexpr Rule tetrahedron_rules[] = {
    {"FPG1", 1, tetrahedron1}, {"FPG4", 2, tetrahedron4}, {"FPG5", 3, tetrahedron5}, {"FPG15", 5, tetrahedron15}};
constexpr Rule pentahedron_rules[] = {
    {"FPG6", 2, pentahedron6}, {"FPG8", 3, pentahedron8}, {"FPG21", 5, pentahedron21}};
constexpr Rule pyramid_rules[] = {{"FPG5", 2, pyramid5}, {"FPG10", 4, pyramid10}, {"FPG27", 5, pyramid27}};
constexpr Rule hexahedron_rules[] = {{"FPG1", 1, hexahedron1}, {"FPG8", 3, hexahedron8}, {"FPG27", 5, hexahedron27}};

std::span<const Rule> rules(CellType type) {
  switch (type) {
    case CellType::poi1:
      return {};
    case CellType::seg2:
    case CellType::seg3:
    case CellType::seg4:
      return segment_rules;
    case CellType::tria3:
    case CellType::tria6:
    case CellType::tria7:
      return triangle_rules;
    case CellType::quad4:
    case CellType::quad8:
    case CellType::quad9:
      return quadrangle_rules;
    case CellType::tetra4:
    case CellType::tetra10:
      return tetrahedron_rules;
    case CellType::pyram5:
    case CellType::pyram13:
      return pyramid_rules;
    case CellType::penta6:
    case CellType::penta15:
    case CellType::penta18:
      return pentahedron_rules;
    case CellType::hexa8:
    case CellType::hexa20:
    case CellType::hexa27:
      return hexahedron_rules;
  }
  return {};
}

const Rule& rule_named(CellType type, std::string_view name) {
  const auto known = rules(type);
  const auto found = std::find_if(known.begin(), known.end(), [&](const Rule& rule) { return rule.name == name; });
  if (found == known.end()) {
    throw Error("unknown-family", fmt::format("a {} has no integration family {}", name_of(type), name));
  }
  return *found;
}

std::string_view full_family(CellType type) {
  switch (type) {
    case CellType::poi1:
    case CellType::tria3:
    case CellType::tetra4:
      return "FPG1";
    case CellType::seg2:
    case CellType::seg3:
      return "FPG2";
    case CellType::tria6:
      return "FPG3";
    case CellType::seg4:
    case CellType::quad4:
      return "FPG4";
    case CellType::tetra10:
    case CellType::pyram5:
      return "FPG5";
    case CellType::penta6:
    case CellType::tria7:
      return "FPG6";
    case CellType::hexa8:
      return "FPG8";
    case CellType::quad8:
    case CellType::quad9:
      return "FPG9";
    case CellType::penta15:
    case CellType::penta18:
      return "FPG21";
    case CellType::pyram13:
      return "FPG10";
    case CellType::hexa20:
    case CellType::hexa27:
      return "FPG27";
  }
  return {};
}

/// As Code_Aster's cases have it (docs/conformance/incompressible.md).
std::string_view mixed_family(CellType type, Formulation formulation) {
  if (type == CellType::hexa20) return "FPG8";
  if (type == CellType::tetra10) return "FPG4";
  const bool is_reduced = mixed_field_count(formulation) == 2 && is_axisymmetric(formulation);
  return type == CellType::quad8 && is_reduced ? "FPG4" : full_family(type);
}

}  // namespace

Quadrature quadrature(CellType type, std::string_view name) {
  if (name == "NOEU") {
    const auto nodes = reference_nodes(type);
    Quadrature points;
    for (const auto& node : nodes)
      points.push_back({node, reference_measure(type) / static_cast<double>(nodes.size())});
    return points;
  }
  if (type == CellType::poi1 && name == "FPG1") return {{{0, 0, 0}, 1.0}};
  return rule_named(type, name).make();
}

int quadrature_degree(CellType type, std::string_view name) {
  return name == "NOEU" ? -1 : rule_named(type, name).degree;
}

std::string_view stiffness_family(CellType type, Formulation formulation) {
  if (mixed_field_count(formulation) > 0) return mixed_family(type, formulation);
  // The radius raises the degree by one; on quadrangles the full family has it to spare.
  if (is_axisymmetric(formulation) && type == CellType::tria6) return "FPG6";
  if (!is_reduced(formulation)) return full_family(type);
  // Reduced integration exists on these cells alone (U3.14.01, U3.13.05); others keep their full family.
  if (type == CellType::tetra10 || type == CellType::quad8) return "FPG4";
  if (type == CellType::hexa8) return "FPG1";
  return type == CellType::hexa20 ? "FPG8" : full_family(type);
}

// Exact for the squares of curvatures, which are linear in triangles.
std::string_view plate_family(CellType type) { return type == CellType::tria3 ? "FPG3" : "FPG4"; }

std::string_view mass_family(CellType type) {
  switch (type) {
    case CellType::tria3:
      return "FPG3";
    case CellType::tria6:
      return "FPG6";
    case CellType::tetra4:
      return "FPG4";
    case CellType::tetra10:
      return "FPG15";
    case CellType::seg3:
      return "FPG4";
    default:
      return full_family(type);
  }
}

std::string_view boundary_family(CellType type) {
  switch (type) {
    case CellType::seg2:
      return "FPG2";
    case CellType::seg3:
    case CellType::seg4:
      return "FPG4";
    default:
      return mass_family(type);
  }
}

std::string_view edge_family(CellType type) { return type == CellType::seg2 ? "FPG2" : "FPG3"; }

}  // namespace comma::solver
