// The formulas are written once, on a scalar type S: with S = double they give values, with S = Dual values and
// gradients.
#include "solver/mesh/reference_element.hpp"

namespace comma::solver {

namespace {

/// A value with its gradient in the reference coordinates.
struct Dual {
  double value = 0.0;
  std::array<double, 3> gradient{};

  Dual() = default;
  Dual(double v) : value(v) {}  // NOLINT: constants mix with variables in the formulas

  friend Dual operator+(const Dual& a, const Dual& b) { return combine(a.value + b.value, 1.0, a, 1.0, b); }
  friend Dual operator-(const Dual& a, const Dual& b) { return combine(a.value - b.value, 1.0, a, -1.0, b); }
  friend Dual operator*(const Dual& a, const Dual& b) { return combine(a.value * b.value, b.value, a, a.value, b); }
  friend Dual operator/(const Dual& a, const Dual& b) {
    const double quotient = a.value / b.value;
    return combine(quotient, 1.0 / b.value, a, -quotient / b.value, b);
  }

 private:
  static Dual combine(double value, double da, const Dual& a, double db, const Dual& b) {
    Dual result(value);
    for (int j = 0; j < 3; ++j) result.gradient[j] = da * a.gradient[j] + db * b.gradient[j];
    return result;
  }
};

double value_of(double x) { return x; }
double value_of(const Dual& x) { return x.value; }

template <class S>
using Point3 = std::array<S, 3>;

// Node coordinates, corners, then mid-edges, mid-faces, centre.
constexpr ReferencePoint point_nodes[] = {{0, 0, 0}};
constexpr ReferencePoint segment_nodes[] = {{-1, 0, 0}, {1, 0, 0}, {0, 0, 0}};
constexpr ReferencePoint segment4_nodes[] = {{-1, 0, 0}, {1, 0, 0}, {-1.0 / 3, 0, 0}, {1.0 / 3, 0, 0}};
constexpr ReferencePoint triangle_nodes[] = {
    {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.5, 0, 0}, {0.5, 0.5, 0}, {0, 0.5, 0}, {1.0 / 3, 1.0 / 3, 0}};
constexpr ReferencePoint quadrangle_nodes[] = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0},  {-1, 1, 0}, {0, -1, 0},
                                               {1, 0, 0},   {0, 1, 0},  {-1, 0, 0}, {0, 0, 0}};
constexpr ReferencePoint tetrahedron_nodes[] = {{0, 1, 0},   {0, 0, 1},   {0, 0, 0},     {1, 0, 0},     {0, 0.5, 0.5},
                                                {0, 0, 0.5}, {0, 0.5, 0}, {0.5, 0.5, 0}, {0.5, 0, 0.5}, {0.5, 0, 0}};
constexpr ReferencePoint pyramid_nodes[] = {
    {1, 0, 0},       {0, 1, 0},      {-1, 0, 0},    {0, -1, 0},    {0, 0, 1},      {0.5, 0.5, 0}, {-0.5, 0.5, 0},
    {-0.5, -0.5, 0}, {0.5, -0.5, 0}, {0.5, 0, 0.5}, {0, 0.5, 0.5}, {-0.5, 0, 0.5}, {0, -0.5, 0.5}};
constexpr ReferencePoint pentahedron_nodes[] = {{-1, 1, 0},    {-1, 0, 1},     {-1, 0, 0},    {1, 1, 0},    {1, 0, 1},
                                                {1, 0, 0},     {-1, 0.5, 0.5}, {-1, 0, 0.5},  {-1, 0.5, 0}, {0, 1, 0},
                                                {0, 0, 1},     {0, 0, 0},      {1, 0.5, 0.5}, {1, 0, 0.5},  {1, 0.5, 0},
                                                {0, 0.5, 0.5}, {0, 0, 0.5},    {0, 0.5, 0}};
constexpr ReferencePoint hexahedron_nodes[] = {
    {-1, -1, -1}, {1, -1, -1}, {1, 1, -1},  {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1},  {-1, 1, 1}, {0, -1, -1},
    {1, 0, -1},   {0, 1, -1},  {-1, 0, -1}, {-1, -1, 0}, {1, -1, 0},  {1, 1, 0},  {-1, 1, 0}, {0, -1, 1}, {1, 0, 1},
    {0, 1, 1},    {-1, 0, 1},  {0, 0, -1},  {0, -1, 0},  {1, 0, 0},   {0, 1, 0},  {-1, 0, 0}, {0, 0, 1},  {0, 0, 0}};

/// The one-dimensional quadratic Lagrange function that is 1 at `node` (-1, 0 or 1) and 0 at the other two.
template <class S>
S lagrange(double node, const S& x) {
  if (node == 0.0) return (S(1.0) - x) * (S(1.0) + x);
  return S(0.5) * x * (x + S(node));
}

/// (1 + x x_a), the linear factor that vanishes on the side opposite to node a.
template <class S>
S side(double node, const S& x) {
  return S(1.0) + S(node) * x;
}

template <class S>
void segment4(const S& x, S* n) {
  const S inner = (x - S(1.0 / 3)) * (x + S(1.0 / 3));
  const S outer = (x - S(1.0)) * (x + S(1.0));
  n[0] = S(-9.0 / 16) * (x - S(1.0)) * inner;
  n[1] = S(9.0 / 16) * (x + S(1.0)) * inner;
  n[2] = S(27.0 / 16) * outer * (x - S(1.0 / 3));
  n[3] = S(-27.0 / 16) * outer * (x + S(1.0 / 3));
}

/// Barycentric coordinates l[0..corners) to linear or quadratic functions; mid-edge k lies between edges[k].
template <class S, std::size_t Edges>
void simplex(const S* l, int corners, const std::array<std::array<int, 2>, Edges>& edges, bool quadratic, S* n) {
  for (int a = 0; a < corners; ++a) n[a] = quadratic ? l[a] * (S(2.0) * l[a] - S(1.0)) : l[a];
  if (!quadratic) return;
  for (std::size_t e = 0; e < Edges; ++e) n[corners + e] = S(4.0) * l[edges[e][0]] * l[edges[e][1]];
}

constexpr std::array<std::array<int, 2>, 3> triangle_edges = {{{0, 1}, {1, 2}, {2, 0}}};
constexpr std::array<std::array<int, 2>, 6> tetrahedron_edges = {{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};

template <class S>
void triangle(CellType type, const Point3<S>& x, S* n) {
  const S l[3] = {S(1.0) - x[0] - x[1], x[0], x[1]};
  simplex(l, 3, triangle_edges, type != CellType::tria3, n);
  if (type != CellType::tria7) return;
  // The bubble takes from corners and mid-edges what they have at the centre: -1/9 and 4/9.
  const S bubble = S(27.0) * l[0] * l[1] * l[2];
  for (int a = 0; a < 3; ++a) n[a] = n[a] + S(1.0 / 9) * bubble;
  for (int a = 3; a < 6; ++a) n[a] = n[a] - S(4.0 / 9) * bubble;
  n[6] = bubble;
}

template <class S>
void tetrahedron(CellType type, const Point3<S>& x, S* n) {
  const S l[4] = {x[1], x[2], S(1.0) - x[0] - x[1] - x[2], x[0]};
  simplex(l, 4, tetrahedron_edges, type == CellType::tetra10, n);
}

/// Serendipity functions of quadrangles (dim 2) and hexahedra (dim 3): corners, then mid-edges.
template <class S>
void serendipity(std::span<const ReferencePoint> nodes, int dim, const Point3<S>& x, S* n) {
  const int corners = 1 << dim;
  for (std::size_t a = 0; a < nodes.size(); ++a) {
    const ReferencePoint& node = nodes[a];
    const bool corner = static_cast<int>(a) < corners;
    S product = S(corner ? 1.0 / corners : 2.0 / corners);
    S sum = S(1.0 - dim);
    for (int j = 0; j < dim; ++j) {
      product = product * (node[j] == 0.0 ? (S(1.0) - x[j]) * (S(1.0) + x[j]) : side(node[j], x[j]));
      sum = sum + S(node[j]) * x[j];
    }
    n[a] = corner ? product * sum : product;
  }
}

template <class S>
void tensor(std::span<const ReferencePoint> nodes, int dim, bool quadratic, const Point3<S>& x, S* n) {
  for (std::size_t a = 0; a < nodes.size(); ++a) {
    n[a] = S(1.0);
    for (int j = 0; j < dim; ++j) {
      n[a] = n[a] * (quadratic ? lagrange(nodes[a][j], x[j]) : S(0.5) * side(nodes[a][j], x[j]));
    }
  }
}

/// Triangle functions in (y, z) times segment functions in x; the 15-node cell drops the mid-face functions
/// (serendipity).
template <class S>
void pentahedron(CellType type, const Point3<S>& x, S* n) {
  const S l[3] = {x[1], x[2], S(1.0) - x[1] - x[2]};
  const S bottom = S(0.5) * (S(1.0) - x[0]);
  const S top = S(0.5) * (S(1.0) + x[0]);
  const S middle = (S(1.0) - x[0]) * (S(1.0) + x[0]);
  if (type == CellType::penta6) {
    for (int a = 0; a < 3; ++a) n[a] = bottom * l[a], n[a + 3] = top * l[a];
    return;
  }
  S q[6];
  simplex(l, 3, triangle_edges, true, q);
  if (type == CellType::penta15) {
    for (int a = 0; a < 3; ++a) {
      n[a] = bottom * q[a] - S(0.5) * middle * l[a];
      n[a + 3] = top * q[a] - S(0.5) * middle * l[a];
      n[a + 6] = bottom * q[a + 3];
      n[a + 9] = middle * l[a];
      n[a + 12] = top * q[a + 3];
    }
    return;
  }
  const S below = lagrange(-1.0, x[0]);
  const S above = lagrange(1.0, x[0]);
  for (int a = 0; a < 3; ++a) {
    n[a] = below * q[a], n[a + 3] = above * q[a];
    n[a + 6] = below * q[a + 3], n[a + 12] = above * q[a + 3];
    n[a + 9] = middle * q[a], n[a + 15] = middle * q[a + 3];
  }
}

/// Rational functions of the pyramid (R3.01.01, section 4.4). f[k] vanishes on the lateral face through corners k and
/// k+1; at the apex they are continued by their limit.
template <class S>
void pyramid(CellType type, const Point3<S>& x, S* n) {
  const S height = S(1.0) - x[2];
  if (value_of(height) == 0.0) {
    for (int a = 0; a < node_count(type); ++a) n[a] = S(a == 4 ? 1.0 : 0.0);
    return;
  }
  const S f[4] = {height - x[0] - x[1], height + x[0] - x[1], height + x[0] + x[1], height - x[0] + x[1]};
  const S half = S(0.5) / height;
  if (type == CellType::pyram5) {
    for (int a = 0; a < 4; ++a) n[a] = S(0.5) * half * f[(a + 1) % 4] * f[(a + 2) % 4];
    n[4] = x[2];
    return;
  }
  const S along[4] = {x[0], x[1], S(0.0) - x[0], S(0.0) - x[1]};
  for (int a = 0; a < 4; ++a) {
    const S opposite = f[(a + 1) % 4] * f[(a + 2) % 4];
    n[a] = half * opposite * (along[a] - S(0.5));
    n[a + 5] = half * opposite * f[(a + 3) % 4];
    n[a + 9] = S(2.0) * half * x[2] * opposite;
  }
  n[4] = S(2.0) * x[2] * (x[2] - S(0.5));
}

template <class S>
void evaluate(CellType type, const Point3<S>& x, S* n) {
  const auto nodes = reference_nodes(type);
  switch (type) {
    case CellType::poi1:
      n[0] = S(1.0);
      return;
    case CellType::seg2:
    case CellType::quad4:
    case CellType::hexa8:
      return tensor(nodes, dimension(type), false, x, n);
    case CellType::seg3:
    case CellType::quad9:
    case CellType::hexa27:
      return tensor(nodes, dimension(type), true, x, n);
    case CellType::seg4:
      return segment4(x[0], n);
    case CellType::tria3:
    case CellType::tria6:
    case CellType::tria7:
      return triangle(type, x, n);
    case CellType::quad8:
    case CellType::hexa20:
      return serendipity(nodes, dimension(type), x, n);
    case CellType::tetra4:
    case CellType::tetra10:
      return tetrahedron(type, x, n);
    case CellType::pyram5:
    case CellType::pyram13:
      return pyramid(type, x, n);
    case CellType::penta6:
    case CellType::penta15:
    case CellType::penta18:
      return pentahedron(type, x, n);
  }
}

std::span<const ReferencePoint> all_nodes(CellType type) {
  switch (type) {
    case CellType::poi1:
      return point_nodes;
    case CellType::seg2:
    case CellType::seg3:
      return segment_nodes;
    case CellType::seg4:
      return segment4_nodes;
    case CellType::tria3:
    case CellType::tria6:
    case CellType::tria7:
      return triangle_nodes;
    case CellType::quad4:
    case CellType::quad8:
    case CellType::quad9:
      return quadrangle_nodes;
    case CellType::tetra4:
    case CellType::tetra10:
      return tetrahedron_nodes;
    case CellType::pyram5:
    case CellType::pyram13:
      return pyramid_nodes;
    case CellType::penta6:
    case CellType::penta15:
    case CellType::penta18:
      return pentahedron_nodes;
    case CellType::hexa8:
    case CellType::hexa20:
    case CellType::hexa27:
      return hexahedron_nodes;
  }
  return {};
}

}  // namespace

std::span<const ReferencePoint> reference_nodes(CellType type) {
  return all_nodes(type).first(static_cast<std::size_t>(node_count(type)));
}

double reference_measure(CellType type) {
  const int corners = corner_count(type);
  if (corners == 1 << dimension(type)) return corners;  // products of [-1, 1]
  if (dimension(type) == 2) return 0.5;
  if (corners == 4) return 1.0 / 6;
  return corners == 5 ? 2.0 / 3 : 1.0;
}

Eigen::VectorXd shape_functions(CellType type, const ReferencePoint& at) {
  Eigen::VectorXd values(node_count(type));
  evaluate<double>(type, at, values.data());
  return values;
}

Eigen::MatrixXd shape_derivatives(CellType type, const ReferencePoint& at) {
  Point3<Dual> x;
  for (int j = 0; j < 3; ++j) {
    x[j].value = at[j];
    x[j].gradient[j] = 1.0;
  }
  std::array<Dual, max_nodes> n;
  evaluate<Dual>(type, x, n.data());
  Eigen::MatrixXd derivatives(node_count(type), dimension(type));
  for (int a = 0; a < derivatives.rows(); ++a) {
    for (int j = 0; j < derivatives.cols(); ++j) derivatives(a, j) = n[a].gradient[j];
  }
  return derivatives;
}

}  // namespace comma::solver
