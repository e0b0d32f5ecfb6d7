// Strains of flat plates on three or four nodes: DKT, DKQ, DST and DSQ (R3.07.03; Batoz and Dhatt, Modelisation des
// structures par elements finis, volume 2).
//
// Own axes: x and y in the plane, z along the normal. The normal turns by beta: u(z) = u + z beta_x, v(z) = v + z
// beta_y, so that beta_x = theta_y and beta_y = -theta_x. beta is linear (bilinear) between the corners, and along each
// side k of direction t_k a bubble of amplitude alpha_k turns it further:
//
//     beta = sum N_i beta_i + sum P_k t_k alpha_k.
//
// The amplitudes follow from one condition a side of length L, the mean of the shear along it:
//
//     integral of (dw/ds + beta_s) = w_j - w_i + L (beta_s,i + beta_s,j) / 2 + 2/3 L alpha_k = L gamma_s,k.
//
// The shear force is the divergence of the moments of beta about the surface of the nodes, T = div M(beta), its mean
// over the two Gauss points of the side: gamma = T / (k G h). With an offset e the rigidity of these moments is D + e^2
// A (R3.07.06). A plate without shear has gamma = 0 (Kirchhoff's condition, side by side), which is all that tells the
// two theories apart.
#pragma once

#include <array>
#include <numbers>

#include <Eigen/Dense>

#include "solver/mesh/reference_element.hpp"

namespace comma::solver {

/// How a plate of unit width resists.
struct PlateRigidity {
  double membrane = 0.0;  ///< E h / (1 - nu^2)
  double bending = 0.0;   ///< E h^3 / 12 / (1 - nu^2)
  double poisson = 0.0;
  double offset = 0.0;            ///< of the mid-surface from the surface of the nodes
  double shear_compliance = 0.0;  ///< 1 / (k G h); 0: the plate does not shear
};

/// Rows of strains for the degrees of freedom u v w theta_x theta_y theta_z of each node, in own axes.
template <int Nodes>
struct PlateRows {
  using Row = Eigen::Matrix<double, 1, 6 * Nodes>;

  double measure = 0.0;                             ///< area for a unit of reference area
  Eigen::Matrix<double, 3, 6 * Nodes> membrane;     ///< e_xx, e_yy, 2 e_xy of the surface that the nodes lie on
  Eigen::Matrix<double, 3, 6 * Nodes> curvature;    ///< beta_x,x  beta_y,y  beta_x,y + beta_y,x
  Eigen::Matrix<double, 2, 6 * Nodes> shear_force;  ///< T, force / length
  /// theta_z - (v,x - u,y) / 2, the second part in the middle of the cell: what varies of it in a quadrangle comes with
  /// the parasitic shear of bilinear functions, not with a rotation of the surface.
  Row spin;
};

/// The plate whose corners lie at (x, y) = the columns of `corners`, counter-clockwise.
template <int Nodes>
class PlateKinematics {
  static_assert(Nodes == 3 || Nodes == 4);
  static constexpr int dof_count = 6 * Nodes;
  static constexpr int wide_count = dof_count + Nodes;  // with the amplitudes alpha
  using Corners = Eigen::Matrix<double, 2, Nodes>;
  using Amplitudes = Eigen::Matrix<double, Nodes, dof_count>;
  using WideRow = Eigen::Matrix<double, 1, wide_count>;
  // Functions N_1 .. N_n P_1 .. P_n, with their derivatives.
  enum Derivative { x, y, xx, yy, xy, derivative_count };
  using Derivatives = Eigen::Matrix<double, 2 * Nodes, derivative_count>;

 public:
  PlateKinematics(const Corners& corners, const PlateRigidity& rigidity) : corners_(corners), rigidity_(rigidity) {
    for (int k = 0; k < Nodes; ++k) {
      const Eigen::Vector2d side = corners_.col(next(k)) - corners_.col(k);
      lengths_[k] = side.norm();
      directions_.col(k) = side / lengths_[k];
    }
    amplitudes_ = side_conditions();
    derivatives(centre(), at_centre_);
  }

  PlateRows<Nodes> at(const ReferencePoint& place) const {
    PlateRows<Nodes> rows;
    Derivatives d;
    rows.measure = derivatives(place, d);
    const auto [xi, yi] = rotation_rows(d);
    rows.curvature.row(0) = condensed(xi[x]);
    rows.curvature.row(1) = condensed(yi[y]);
    rows.curvature.row(2) = condensed(xi[y] + yi[x]);
    const auto shear = shear_rows(xi, yi);
    for (int c = 0; c < 2; ++c) rows.shear_force.row(c) = condensed(shear[c]);
    rows.membrane.setZero();
    rows.spin.setZero();
    const std::array<double, 4> values = corner_values(place);
    for (int i = 0; i < Nodes; ++i) {
      rows.membrane(0, 6 * i) = rows.membrane(2, 6 * i + 1) = d(i, x);
      rows.membrane(1, 6 * i + 1) = rows.membrane(2, 6 * i) = d(i, y);
      rows.spin[6 * i] = 0.5 * at_centre_(i, y);
      rows.spin[6 * i + 1] = -0.5 * at_centre_(i, x);
      rows.spin[6 * i + 5] = values[i];
    }
    return rows;
  }

 private:
  static int next(int k) { return (k + 1) % Nodes; }

  /// Coordinates of the corners of the reference cell, those of a quadrangle being -1 and 1.
  static constexpr std::array<std::array<double, 2>, 4> quadrangle = {{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};

  static constexpr ReferencePoint centre() {
    if constexpr (Nodes == 3) return {1.0 / 3, 1.0 / 3, 0.0};
    return {0.0, 0.0, 0.0};
  }

  static ReferencePoint middle(int k) {
    if constexpr (Nodes == 3) {
      constexpr std::array<std::array<double, 2>, 3> middles = {{{0.5, 0.0}, {0.5, 0.5}, {0.0, 0.5}}};
      return {middles[k][0], middles[k][1], 0.0};
    } else {
      const auto &a = quadrangle[k], &b = quadrangle[next(k)];
      return {0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]), 0.0};
    }
  }

  static std::array<double, 4> corner_values(const ReferencePoint& at) {
    if constexpr (Nodes == 3) return {1.0 - at[0] - at[1], at[0], at[1], 0.0};
    std::array<double, 4> values{};
    for (int i = 0; i < Nodes; ++i)
      values[i] = 0.25 * (1.0 + at[0] * quadrangle[i][0]) * (1.0 + at[1] * quadrangle[i][1]);
    return values;
  }

  /// Derivatives by the reference coordinates r, s, in the order r s rr ss rs.
  static Derivatives reference_derivatives(const ReferencePoint& at) {
    Derivatives d;
    const double r = at[0], s = at[1];
    if constexpr (Nodes == 3) {
      d << -1, -1, 0, 0, 0,                        //
          1, 0, 0, 0, 0,                           //
          0, 1, 0, 0, 0,                           //
          4 * (1 - 2 * r - s), -4 * r, -8, 0, -4,  // 4 (1 - r - s) r
          4 * s, 4 * r, 0, 0, 4,                   // 4 r s
          -4 * s, 4 * (1 - r - 2 * s), 0, -8, -4;  // 4 (1 - r - s) s
    } else {
      for (int i = 0; i < Nodes; ++i) {
        const double ri = quadrangle[i][0], si = quadrangle[i][1];
        d.row(i) << 0.25 * ri * (1 + s * si), 0.25 * si * (1 + r * ri), 0, 0, 0.25 * ri * si;
        const ReferencePoint at_side = middle(i);
        const double rm = at_side[0], sm = at_side[1];
        if (rm == 0.0)
          d.row(4 + i) << -r * (1 + s * sm), 0.5 * (1 - r * r) * sm, -(1 + s * sm), 0, -r * sm;
        else
          d.row(4 + i) << 0.5 * (1 - s * s) * rm, -s * (1 + r * rm), 0, -(1 + r * rm), -s * rm;
      }
    }
    return d;
  }

  /// Derivatives by x and y; returns the determinant of the map.
  double derivatives(const ReferencePoint& at, Derivatives& d) const {
    const Derivatives reference = reference_derivatives(at);
    // Rows x, y; columns r s rr ss rs.
    const Eigen::Matrix<double, 2, derivative_count> map = corners_ * reference.template topRows<Nodes>();
    const Eigen::Matrix2d jacobian = map.template leftCols<2>();  // d(x, y) / d(r, s)
    d.template leftCols<2>() = reference.template leftCols<2>() * jacobian.inverse();
    // f_rr = x_r^2 f_xx + y_r^2 f_yy + 2 x_r y_r f_xy, and so on: Code_Aster leaves out what the map of a quadrangle
    // adds that is no parallelogram, x_rs f_x + y_rs f_y.
    const double xr = map(0, 0), xs = map(0, 1), yr = map(1, 0), ys = map(1, 1);
    Eigen::Matrix3d second;               // columns rr ss rs
    second << xr * xr, xs * xs, xr * xs,  //
        yr * yr, ys * ys, yr * ys,        //
        2 * xr * yr, 2 * xs * ys, xr * ys + xs * yr;
    d.template rightCols<3>() = reference.template rightCols<3>() * second.inverse();
    return jacobian.determinant();
  }

  /// Over the two Gauss points of a side; in triangles second derivatives, which alone count there, are the same all
  /// over.
  Derivatives mean_derivatives(int side) const {
    Derivatives d;
    const ReferencePoint at = middle(side);
    if constexpr (Nodes == 3) {
      derivatives(at, d);
      return d;
    }
    Derivatives sum = Derivatives::Zero();
    const int along = at[0] == 0.0 ? 0 : 1;
    for (const double place : {-std::numbers::inv_sqrt3, std::numbers::inv_sqrt3}) {
      ReferencePoint point = at;
      point[static_cast<std::size_t>(along)] = place;
      derivatives(point, d);
      sum += d;
    }
    return 0.5 * sum;
  }

  using Gradients = std::array<WideRow, derivative_count>;

  /// The derivatives of beta_x and of beta_y.
  std::pair<Gradients, Gradients> rotation_rows(const Derivatives& d) const {
    std::pair<Gradients, Gradients> rows;
    for (int c = 0; c < derivative_count; ++c) {
      rows.first[c].setZero();
      rows.second[c].setZero();
      for (int i = 0; i < Nodes; ++i) {
        rows.first[c][6 * i + 4] = d(i, c);
        rows.second[c][6 * i + 3] = -d(i, c);
        rows.first[c][dof_count + i] = directions_(0, i) * d(Nodes + i, c);
        rows.second[c][dof_count + i] = directions_(1, i) * d(Nodes + i, c);
      }
    }
    return rows;
  }

  /// T = div M, with the moments of beta about the surface of the nodes.
  std::array<WideRow, 2> shear_rows(const Gradients& a, const Gradients& b) const {
    const double nu = rigidity_.poisson, half = 0.5 * (1.0 - nu);
    const double bending = rigidity_.bending + rigidity_.offset * rigidity_.offset * rigidity_.membrane;
    return {bending * (a[xx] + nu * b[xy] + half * (a[yy] + b[xy])),
            bending * (b[yy] + nu * a[xy] + half * (b[xx] + a[xy]))};
  }

  Amplitudes side_conditions() const {
    Eigen::Matrix<double, Nodes, Nodes> factors = Eigen::Matrix<double, Nodes, Nodes>::Zero();
    Amplitudes sides = Amplitudes::Zero();
    for (int k = 0; k < Nodes; ++k) {
      const int j = next(k);
      factors(k, k) = 2.0 / 3.0 * lengths_[k];
      sides(k, 6 * k + 2) = 1.0;
      sides(k, 6 * j + 2) = -1.0;
      for (const int i : {k, j}) {
        sides(k, 6 * i + 4) = -0.5 * lengths_[k] * directions_(0, k);
        sides(k, 6 * i + 3) = 0.5 * lengths_[k] * directions_(1, k);
      }
      if (rigidity_.shear_compliance == 0.0) continue;
      const auto [xi, yi] = rotation_rows(mean_derivatives(k));
      const auto shear = shear_rows(xi, yi);
      const WideRow along =
          rigidity_.shear_compliance * lengths_[k] * (directions_(0, k) * shear[0] + directions_(1, k) * shear[1]);
      factors.row(k) -= along.template tail<Nodes>();
      sides.row(k) += along.template head<dof_count>();
    }
    return factors.inverse() * sides;
  }

  typename PlateRows<Nodes>::Row condensed(const WideRow& row) const {
    return row.template head<dof_count>() + row.template tail<Nodes>() * amplitudes_;
  }

  Corners corners_;
  PlateRigidity rigidity_;
  std::array<double, Nodes> lengths_{};
  Corners directions_;
  Derivatives at_centre_;
  Amplitudes amplitudes_;  ///< alpha for the degrees of freedom
};

}  // namespace comma::solver
