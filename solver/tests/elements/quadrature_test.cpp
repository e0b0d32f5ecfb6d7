#include "solver/elements/quadrature.hpp"

#include <cmath>

#include <catch2/catch.hpp>

#include "solver/error.hpp"

using namespace comma::solver;

namespace {

constexpr std::string_view names[] = {"FPG1", "FPG2", "FPG3",  "FPG4",  "FPG5",  "FPG6", "FPG7",
                                      "FPG8", "FPG9", "FPG15", "FPG21", "FPG27", "NOEU"};

double factorial(int n) { return std::tgamma(n + 1.0); }

/// Integral of s^n over [-1, 1].
double segment_moment(int n) { return n % 2 == 0 ? 2.0 / (n + 1) : 0.0; }

/// Integral of y^i z^j over the unit triangle.
double triangle_moment(int i, int j) { return factorial(i) * factorial(j) / factorial(i + j + 2); }

/// Integral of x^i y^j over |x| + |y| <= 1, times that of z^k (1 - z)^(i + j + 2).
double pyramid_moment(int i, int j, int k) {
  if (i % 2 != 0 || j % 2 != 0) return 0.0;
  return 4 * triangle_moment(i, j) * factorial(k) * factorial(i + j + 2) / factorial(i + j + k + 3);
}

double moment(CellType type, int i, int j, int k) {
  switch (type) {
    case CellType::seg2:
      return segment_moment(i);
    case CellType::tria3:
      return triangle_moment(i, j);
    case CellType::quad4:
      return segment_moment(i) * segment_moment(j);
    case CellType::tetra4:
      return factorial(i) * factorial(j) * factorial(k) / factorial(i + j + k + 3);
    case CellType::penta6:
      return segment_moment(i) * triangle_moment(j, k);
    case CellType::pyram5:
      return pyramid_moment(i, j, k);
    default:
      return segment_moment(i) * segment_moment(j) * segment_moment(k);
  }
}

bool within_degree(CellType type, int degree, int i, int j, int k) {
  if (type == CellType::quad4 || type == CellType::hexa8 || type == CellType::seg2)
    return i <= degree && j <= degree && k <= degree;
  if (type == CellType::penta6) return i <= degree && j + k <= degree;
  return i + j + k <= degree;
}

}  // namespace

TEST_CASE("integration families are exact up to their degree", "[elements]") {
  for (const CellType type : {CellType::seg2, CellType::tria3, CellType::quad4, CellType::tetra4, CellType::penta6,
                              CellType::pyram5, CellType::hexa8}) {
    const int dim = dimension(type);
    for (const auto name : names) {
      Quadrature points;
      try {
        points = quadrature(type, name);
      } catch (const Error&) {
        continue;
      }
      const int degree = name == "NOEU" ? 0 : quadrature_degree(type, name);
      CAPTURE(name_of(type), name);
      for (int i = 0; i <= degree; ++i) {
        for (int j = 0; j <= (dim > 1 ? degree : 0); ++j) {
          for (int k = 0; k <= (dim > 2 ? degree : 0); ++k) {
            if (!within_degree(type, degree, i, j, k)) continue;
            CAPTURE(i, j, k);
            double sum = 0.0;
            for (const auto& p : points)
              sum += p.weight * std::pow(p.at[0], i) * std::pow(p.at[1], j) * std::pow(p.at[2], k);
            // Constants are given to 16 digits.
            CHECK(sum == Approx(moment(type, i, j, k)).margin(1e-14));
          }
        }
      }
    }
  }
}

TEST_CASE("every cell type has the families that its elements use", "[elements]") {
  for (int t = 0; t < cell_type_count; ++t) {
    const auto type = static_cast<CellType>(t);
    CAPTURE(name_of(type));
    for (const auto family :
         {stiffness_family(type, Formulation::solid), stiffness_family(type, Formulation::solid_reduced),
          mass_family(type), boundary_family(type)}) {
      double sum = 0.0;
      for (const auto& point : quadrature(type, family)) sum += point.weight;
      CHECK(sum == Approx(reference_measure(type)).epsilon(1e-14));
    }
  }
}

TEST_CASE("a family that a cell does not have is named", "[elements]") {
  CHECK_THROWS_WITH(quadrature(CellType::tria3, "FPG27"), "a TRIA3 has no integration family FPG27");
}

TEST_CASE("points of the usual families come in the documented order", "[elements]") {
  // R3.01.01: a quadrangle's four points go round like its corners; a hexahedron's first coordinate changes last.
  const auto quad = quadrature(CellType::quad4, "FPG4");
  CHECK((quad[1].at[0] > 0 && quad[1].at[1] < 0));
  CHECK((quad[3].at[0] < 0 && quad[3].at[1] > 0));
  const auto hexa = quadrature(CellType::hexa8, "FPG8");
  CHECK((hexa[1].at[0] < 0 && hexa[1].at[1] < 0 && hexa[1].at[2] > 0));
  CHECK(quadrature(CellType::seg2, "FPG2")[0].at[0] > 0);
}

TEST_CASE("stiffness families leave room for the radius of axisymmetric triangles and keep pyramids to ten points") {
  CHECK(stiffness_family(CellType::tria6, Formulation::plane_strain) == "FPG3");
  CHECK(stiffness_family(CellType::tria6, Formulation::axisymmetric) == "FPG6");
  CHECK(stiffness_family(CellType::pyram13, Formulation::solid) == "FPG10");
  // Strain energy of a quadratic field in a straight cell is of degree 2, times the radius 3.
  CHECK(quadrature_degree(CellType::tria6, "FPG6") >= 3);
  CHECK(quadrature_degree(CellType::pyram13, "FPG10") == 4);
}
