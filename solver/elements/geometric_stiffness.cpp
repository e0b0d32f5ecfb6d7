#include "solver/elements/geometric_stiffness.hpp"

#include <cmath>

#include "solver/elements/cell_quadrature.hpp"

namespace comma::solver {

namespace {

using Row = Eigen::Matrix<double, 12, 1>;  ///< a quantity by the degrees of freedom of a beam

/// Deflection's slope, rotation and its slope in one plane, by deflection and rotation at both ends.
struct PlaneRows {
  Eigen::Vector4d slope, rotation, curvature;
};

PlaneRows plane_rows(double s, double l, double softening) {
  const double scale = 1.0 / (1.0 + softening), half = 0.5 * softening;
  const double first = 6.0 * (s * s - s);
  PlaneRows rows;
  rows.slope << scale / l * (first - softening), scale * (3 * s * s - (4 + softening) * s + 1 + half),
      -scale / l * (first - softening), scale * (3 * s * s - (2 - softening) * s - half);
  rows.rotation << scale / l * first, scale * (3 * s * s - (4 + softening) * s + 1 + softening), -scale / l * first,
      scale * (3 * s * s - (2 - softening) * s);
  rows.curvature << scale / (l * l) * (12 * s - 6), scale / l * (6 * s - 4 - softening),
      -scale / (l * l) * (12 * s - 6), scale / l * (6 * s - 2 + softening);
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
  Row v_slope, w_slope, torsion, twist, b, b_slope, c, c_slope;
};

BeamRows beam_rows(double s, double l, double softening_xy, double softening_xz) {
  constexpr std::array<int, 4> in_xy = {1, 5, 7, 11}, in_xz = {2, 4, 8, 10};
  const PlaneRows xy = plane_rows(s, l, softening_xy), xz = plane_rows(s, l, softening_xz);
  BeamRows rows;
  rows.v_slope = placed(xy.slope, in_xy, 1.0, 1.0);
  rows.c = placed(xy.rotation, in_xy, 1.0, 1.0);
  rows.c_slope = placed(xy.curvature, in_xy, 1.0, 1.0);
  rows.w_slope = placed(xz.slope, in_xz, 1.0, -1.0);
  rows.b = placed(xz.rotation, in_xz, -1.0, 1.0);
  rows.b_slope = placed(xz.curvature, in_xz, -1.0, 1.0);
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

BeamMatrix beam_geometric_stiffness(const BeamSection& section, const IsotropicModuli& material, double length,
                                    bool shear, const std::array<SectionForces, 2>& ends) {
  const double shear_modulus = material.young / (2 * (1 + material.poisson));
  const double scale = shear ? 12 * material.young / (shear_modulus * section.area * length * length) : 0.0;
  const double softening_xy = scale * section.inertia_z * section.shear_y,
               softening_xz = scale * section.inertia_y * section.shear_z;
  const double polar = (section.inertia_y + section.inertia_z) / section.area;
  BeamMatrix k = BeamMatrix::Zero();
  // Polynomials of degree 5 at most: three points of Gauss are exact.
  const double reach = std::sqrt(0.6);
  constexpr std::array<double, 3> weights = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
  for (int g = 0; g < 3; ++g) {
    const double s = 0.5 * (1.0 + (g - 1) * reach);
    const BeamRows at = beam_rows(s, length, softening_xy, softening_xz);
    const auto between = [&](double SectionForces::*part) { return (1.0 - s) * ends[0].*part + s * ends[1].*part; };
    const double w = weights[static_cast<std::size_t>(g)] * length;
    const double n = between(&SectionForces::n);
    add_product(k, w * n, at.v_slope, at.v_slope);
    add_product(k, w * n, at.w_slope, at.w_slope);
    add_product(k, w * n * polar, at.twist, at.twist);
    add_product(k, -2.0 * w * between(&SectionForces::mfy), at.v_slope, at.twist);
    add_product(k, -2.0 * w * between(&SectionForces::mfz), at.w_slope, at.twist);
    add_product(k, 2.0 * w * between(&SectionForces::vy), at.w_slope, at.torsion);
    add_product(k, -2.0 * w * between(&SectionForces::vz), at.v_slope, at.torsion);
    add_product(k, w * between(&SectionForces::mt), at.c, at.b_slope);
    add_product(k, -w * between(&SectionForces::mt), at.b, at.c_slope);
  }
  for (int end = 0; end < 2; ++end) {
    const double sign = end == 0 ? -1.0 : 1.0;
    const SectionForces& own = ends[static_cast<std::size_t>(end)];
    add_product(k, sign * own.mfy, Row::Unit(6 * end + 3), Row::Unit(6 * end + 5));
    add_product(k, -sign * own.mfz, Row::Unit(6 * end + 3), Row::Unit(6 * end + 4));
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
