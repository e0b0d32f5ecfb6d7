#include "solver/mesh/reference_element.hpp"

#include <catch2/catch.hpp>

using namespace comma::solver;

namespace {

// A formula of a dozen terms of order one rounds to some 1e-15.
constexpr double rounding = 1e-13;

/// A point inside the reference cell: the mean of its corners, moved towards one of them.
ReferencePoint inner_point(CellType type, int towards) {
  ReferencePoint at{};
  const auto nodes = reference_nodes(type);
  for (int a = 0; a < corner_count(type); ++a) {
    const double weight = (1.0 + (a == towards ? 0.7 : 0.0)) / (corner_count(type) + 0.7);
    for (int j = 0; j < 3; ++j) at[j] += weight * nodes[a][j];
  }
  return at;
}

}  // namespace

TEST_CASE("shape functions are 1 at their node and 0 at the others", "[elements]") {
  for (int t = 0; t < cell_type_count; ++t) {
    const auto type = static_cast<CellType>(t);
    CAPTURE(name_of(type));
    const auto nodes = reference_nodes(type);
    REQUIRE(static_cast<int>(nodes.size()) == node_count(type));
    for (std::size_t b = 0; b < nodes.size(); ++b) {
      const Eigen::VectorXd values = shape_functions(type, nodes[b]);
      CHECK((values - Eigen::VectorXd::Unit(values.size(), static_cast<Eigen::Index>(b))).cwiseAbs().maxCoeff() <
            rounding);
    }
  }
}

TEST_CASE("shape functions add up to 1 and reproduce the coordinates", "[elements]") {
  for (int t = 0; t < cell_type_count; ++t) {
    const auto type = static_cast<CellType>(t);
    CAPTURE(name_of(type));
    for (int towards = 0; towards < corner_count(type); ++towards) {
      const ReferencePoint at = inner_point(type, towards);
      const Eigen::VectorXd values = shape_functions(type, at);
      CHECK(values.sum() == Approx(1.0).margin(rounding));
      const auto nodes = reference_nodes(type);
      for (int j = 0; j < dimension(type); ++j) {
        double x = 0.0;
        for (std::size_t a = 0; a < nodes.size(); ++a) x += values[a] * nodes[a][j];
        CHECK(x == Approx(at[j]).margin(rounding));
      }
    }
  }
}

TEST_CASE("shape derivatives agree with finite differences", "[elements]") {
  const double h = 1e-5;
  for (int t = 1; t < cell_type_count; ++t) {
    const auto type = static_cast<CellType>(t);
    CAPTURE(name_of(type));
    const ReferencePoint at = inner_point(type, 1);
    const Eigen::MatrixXd derivatives = shape_derivatives(type, at);
    for (int j = 0; j < dimension(type); ++j) {
      ReferencePoint before = at;
      ReferencePoint after = at;
      before[j] -= h;
      after[j] += h;
      const Eigen::VectorXd difference = (shape_functions(type, after) - shape_functions(type, before)) / (2 * h);
      // Central differences: h^2 times a third derivative of order 10.
      CHECK((difference - derivatives.col(j)).cwiseAbs().maxCoeff() < 1e-8);
    }
  }
}

TEST_CASE("boundary facets of a reference cell carry the functions of their own type", "[elements]") {
  // The trace of the shape functions on a facet depends on the facet's nodes alone: else neighbours would not fit.
  for (int t = 1; t < cell_type_count; ++t) {
    const auto type = static_cast<CellType>(t);
    const auto nodes = reference_nodes(type);
    for (const BoundaryFacet& facet : boundary_facets(type)) {
      CAPTURE(name_of(type), name_of(facet.type));
      const ReferencePoint on_facet = inner_point(facet.type, 0);
      const Eigen::VectorXd facet_values = shape_functions(facet.type, on_facet);
      ReferencePoint at{};
      for (int a = 0; a < facet_values.size(); ++a) {
        for (int j = 0; j < 3; ++j) at[j] += facet_values[a] * nodes[facet.nodes[a]][j];
      }
      Eigen::VectorXd expected = Eigen::VectorXd::Zero(node_count(type));
      for (int a = 0; a < facet_values.size(); ++a) expected[facet.nodes[a]] = facet_values[a];
      CHECK((shape_functions(type, at) - expected).cwiseAbs().maxCoeff() < rounding);
    }
  }
}
