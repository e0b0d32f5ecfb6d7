#include "solver/elements/geometric_stiffness.hpp"

#include <cmath>

#include "solver/elements/cell_quadrature.hpp"

namespace comma::solver {

namespace {

using Row = Eigen::Matrix<double, 12, 1>;  ///< a quantity by the degrees of freedom of a beam

/// Slope of the deflection and curvature in one plane, by deflection and rotation at both ends.
struct PlaneRows {
  Eigen::Vector4d slope, curvature;
};

PlaneRows plane_rows(double s, double l) {
  const double first = 6.0 * (s * s - s) / l, second = (12.0 * s - 6.0) / (l * l);
  PlaneRows rows;
  rows.slope << first, 3 * s * s - 4 * s + 1, -first, 3 * s * s - 2 * s;
  rows.curvature << second, (6 * s - 4) / l, -second, (6 * s - 2) / l;
  return rows;
}

Row placed(const Eigen::Vector4d& plane, const std::array<int, 4>& places, double of_deflections, double of_rotations) {
  Row row = Row::Zero();
  for (int i = 0; i < 4; ++i)
    row[places[static_cast<std::size_t>(i)]] = (i % 2 == 0 ? of_deflections : of_rotations) * plane[i];
  return row;
}

/// Adds factor (a b + b a) / 2 to a matrix of twice the energy.
void add_product(BeamMatrix& k, double factor, const Row& a, const Row& b) {
  k += 0.5 * factor * (a * b.transpose() + b * a.transpose());
}

struct BeamRows {
  Row v_slope, v_curvature, w_slope, w_curvature, torsion, twist;
};

BeamRows beam_rows(double s, double l) {
  constexpr std::array<int, 4> in_xy = {1, 5, 7, 11}, in_xz = {2, 4, 8, 10};
  const PlaneRows plane = plane_rows(s, l);
  BeamRows rows;
  rows.v_slope = placed(plane.slope, in_xy, 1.0, 1.0);
  rows.v_curvature = placed(plane.curvature, in_xy, 1.0, 1.0);
  rows.w_slope = placed(plane.slope, in_xz, 1.0, -1.0);
  rows.w_curvature = placed(plane.curvature, in_xz, 1.0, -1.0);
  rows.torsion = (1.0 - s) * Row::Unit(3) + s * Row::Unit(9);
  rows.twist = (Row::Unit(9) - Row::Unit(3)) / l;
  return rows;
}

Eigen::Matrix3d stress_tensor(const double* s, int dimension) {
  Eigen::Matrix3d tensor = Eigen::Matrix3d::Zero();
  tensor.diagonal() << s[0], s[1], s[2];
  tensor(0, 1) = tensor(1, 0) = s[3];
  if (dimension == 3) {
    tensor(0, 2) = tensor(2, 0) = s[4];
    tensor(1, 2) = tensor(2, 1) = s[5];
  }
  return tensor;
}

/// Adds what the stress at one point makes of one cell's matrix.
void add_point(const NodeColumns& places, const CellSample& sample, const Eigen::Matrix3d& stress, int dimension,
               bool axisymmetric, Eigen::MatrixXd& k) {
  const CellPoint point = locate(places, sample);
  const double weight = sample.weight * point.measure(dimension) * (axisymmetric ? point.at[0] : 1.0);
  const Eigen::MatrixXd gradients = sample.derivatives * point.tangents.topLeftCorner(dimension, dimension).inverse();
  const Eigen::MatrixXd pairs = weight * gradients * stress.topLeftCorner(dimension, dimension) * gradients.transpose();
  for (Eigen::Index a = 0; a < pairs.rows(); ++a) {
    for (Eigen::Index b = 0; b < pairs.cols(); ++b) {
      for (int c = 0; c < dimension; ++c) k(a * dimension + c, b * dimension + c) += pairs(a, b);
      if (axisymmetric)
        k(a * dimension, b * dimension) +=
            weight * stress(2, 2) * sample.values[a] * sample.values[b] / (point.at[0] * point.at[0]);
    }
  }
}

}  // namespace

BeamMatrix beam_geometric_stiffness(const BeamSection& section, double length,
                                    const std::array<SectionForces, 2>& ends) {
  const double polar = (section.inertia_y + section.inertia_z) / section.area;
  BeamMatrix k = BeamMatrix::Zero();
  // Polynomials of degree 4 at most: three points of Gauss are exact.
  const double reach = std::sqrt(0.6);
  constexpr std::array<double, 3> weights = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
  for (int g = 0; g < 3; ++g) {
    const double s = 0.5 * (1.0 + (g - 1) * reach);
    const BeamRows at = beam_rows(s, length);
    const auto between = [&](double SectionForces::*part) { return (1.0 - s) * ends[0].*part + s * ends[1].*part; };
    const double w = weights[static_cast<std::size_t>(g)] * length;
    const double n = between(&SectionForces::n);
    add_product(k, w * n, at.v_slope, at.v_slope);
    add_product(k, w * n, at.w_slope, at.w_slope);
    add_product(k, w * n * polar, at.twist, at.twist);
    add_product(k, 2.0 * w * between(&SectionForces::mfy), at.torsion, at.v_curvature);
    add_product(k, 2.0 * w * between(&SectionForces::mfz), at.torsion, at.w_curvature);
    add_product(k, w * between(&SectionForces::mt), at.v_slope, -at.w_curvature);
    add_product(k, w * between(&SectionForces::mt), at.w_slope, at.v_curvature);
  }
  const auto unbalanced = [&](double shear, double SectionForces::*moment) {
    return length * shear - (ends[1].*moment - ends[0].*moment);
  };
  const Row torsion = Row::Unit(9) - Row::Unit(3);
  add_product(k, -unbalanced(ends[0].vz, &SectionForces::mfy) / 3.0, torsion, Row::Unit(11) - Row::Unit(5));
  add_product(k, unbalanced(-ends[0].vy, &SectionForces::mfz) / 3.0, torsion, Row::Unit(10) - Row::Unit(4));
  for (int end = 0; end < 2; ++end) {
    const double sign = end == 0 ? -1.0 : 1.0;
    const SectionForces& own = ends[static_cast<std::size_t>(end)];
    add_product(k, -sign * own.mfy, Row::Unit(6 * end + 3), Row::Unit(6 * end + 5));
    add_product(k, sign * own.mfz, Row::Unit(6 * end + 3), Row::Unit(6 * end + 4));
  }
  return k;
}

void add_continuum_geometric_stiffness(const Mesh& mesh, Formulation formulation, std::span<const int> cells,
                                       const ElementMap& map, std::span<const double> stresses,
                                       std::span<const int> column_starts, double* values) {
  const int dimension = continuum_dimension(formulation);
  const int components = dimension == 3 ? 6 : 4;
  CellSamples samples;
  const auto& points = samples.of_stiffness(mesh.cell_types[static_cast<std::size_t>(cells.front())], formulation);
  const double* stress = stresses.data();
  for (std::size_t element = 0; element < cells.size(); ++element) {
    const NodeColumns places = node_places(mesh, cells[element]);
    Eigen::MatrixXd k = Eigen::MatrixXd::Zero(places.cols() * dimension, places.cols() * dimension);
    for (const CellSample& sample : points) {
      add_point(places, sample, stress_tensor(stress, dimension), dimension, is_axisymmetric(formulation), k);
      stress += components;
    }
    map.add(static_cast<int>(element), k.data(), column_starts, values);
  }
}

}  // namespace comma::solver
