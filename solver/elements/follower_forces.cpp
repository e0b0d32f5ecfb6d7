#include "solver/elements/follower_forces.hpp"

#include "solver/elements/external_forces.hpp"
#include "solver/functions/deformed_place.hpp"
#include "solver/mesh/place.hpp"

namespace comma::solver {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

double value_of(double number, const FieldFunction& function, const CellPoint& initial, const CellPoint& now,
                double time) {
  return function ? value_of_moved(function, to_point(initial.at), to_point(now.at), time) : number;
}

Matrix3d cross_matrix(const Vector3d& v) {
  Matrix3d matrix;
  matrix << 0, -v[2], v[1], v[2], 0, -v[0], -v[1], v[0], 0;
  return matrix;
}

/// d(normal) / d(place of node b): see CellPoint::normal.
Matrix3d normal_change(const CellPoint& now, const CellSample& sample, Eigen::Index b) {
  if (sample.derivatives.cols() == 1) {
    Matrix3d turn = Matrix3d::Zero();
    turn(0, 1) = sample.derivatives(b, 0);
    turn(1, 0) = -sample.derivatives(b, 0);
    return turn;
  }
  return sample.derivatives(b, 1) * cross_matrix(now.tangents.col(0)) -
         sample.derivatives(b, 0) * cross_matrix(now.tangents.col(1));
}

}  // namespace

/// What acts on a unit of reference measure, but for the radius.
struct FollowerForces::Traction {
  double pressure = 0.0;
  double shear = 0.0;
  Vector3d density = Vector3d::Zero();  ///< of a distributed force, for a unit of the moved boundary
  Vector3d force = Vector3d::Zero();
};

/// One of the two, with its multiplier.
struct FollowerForces::SkinLoad {
  int cell;
  const PressureLoad* pressure;
  const DistributedForce* force;
  double factor;
};

FollowerForces::FollowerForces(const Model& model, const DofMap& dofs, std::span<const AppliedLoad> loads)
    : model_(model), dofs_(dofs), loads_(loads) {
  for (const AppliedLoad& applied : loads) {
    for (const PressureLoad& pressure : applied.load->pressures) check_pressure(model, pressure);
    for (const DistributedForce& force : applied.load->distributed_forces) check_distributed_force(model, force);
  }
}

/// visit(load, sample, initial point, moved point) at each point of each load.
template <class Visit>
void FollowerForces::each_point(const Eigen::VectorXd& u, Visit&& visit) const {
  for (const AppliedLoad& applied : loads_) {
    const double factor = applied.multiplier ? applied.multiplier(time_) : 1.0;
    if (factor == 0.0) continue;
    for (const PressureLoad& load : applied.load->pressures)
      each_point_of({load.cell, &load, nullptr, factor}, u, visit);
    for (const DistributedForce& load : applied.load->distributed_forces)
      each_point_of({load.cell, nullptr, &load, factor}, u, visit);
  }
}

template <class Visit>
void FollowerForces::each_point_of(const SkinLoad& load, const Eigen::VectorXd& u, Visit&& visit) const {
  const Mesh& mesh = *model_.mesh;
  const NodeColumns places = node_places(mesh, load.cell);
  NodeColumns moved = places;
  for (Eigen::Index a = 0; a < moved.cols(); ++a) {
    for (int c = 0; c < 3; ++c) {
      const int dof = dofs_.dof(mesh.cell(load.cell)[static_cast<std::size_t>(a)], static_cast<Component>(c));
      if (dof >= 0) moved(c, a) += u[dof];
    }
  }
  for (const CellSample& sample : samples_.of(mesh.cell_types[load.cell], CellRole::skin))
    visit(load, sample, locate(places, sample), locate(moved, sample));
}

FollowerForces::Traction FollowerForces::traction(const SkinLoad& skin, const CellSample& sample,
                                                  const CellPoint& initial, const CellPoint& now) const {
  Traction traction;
  const int own = dimension(model_.mesh->cell_types[skin.cell]);
  if (skin.force != nullptr) {
    traction.density =
        skin.factor * distributed_force_at(*skin.force, *model_.mesh, sample, to_point(initial.at), time_);
    traction.force = now.measure(own) * traction.density;
    return traction;
  }
  const PressureLoad& load = *skin.pressure;
  const double pressure = is_of_deformed_place(load.pressure_function)
                              ? value_of(load.pressure, load.pressure_function, initial, now, time_)
                              : pressure_at(load, *model_.mesh, sample, to_point(initial.at), time_);
  traction.pressure = skin.factor * pressure;
  traction.shear = skin.factor * value_of(load.shear, load.shear_function, initial, now, time_);
  traction.force = traction.shear * now.tangents.col(0) - traction.pressure * now.normal(own);
  return traction;
}

Eigen::VectorXd FollowerForces::at(const Eigen::VectorXd& u) const {
  std::vector<long double> sums(static_cast<std::size_t>(dofs_.size()), 0.0L);
  each_point(u, [&](const SkinLoad& load, const CellSample& sample, const CellPoint& initial, const CellPoint& now) {
    const double radius = is_axisymmetric(model_.formulations[load.cell]) ? now.at[0] : 1.0;
    const Vector3d force = radius * sample.weight * traction(load, sample, initial, now).force;
    const auto nodes = model_.mesh->cell(load.cell);
    for (std::size_t a = 0; a < nodes.size(); ++a) {
      for (int c = 0; c < 3; ++c) {
        const int dof = dofs_.dof(nodes[a], static_cast<Component>(c));
        if (dof >= 0) sums[static_cast<std::size_t>(dof)] += sample.values[static_cast<Eigen::Index>(a)] * force[c];
      }
    }
  });
  Eigen::VectorXd forces(dofs_.size());
  for (int dof = 0; dof < dofs_.size(); ++dof) forces[dof] = static_cast<double>(sums[static_cast<std::size_t>(dof)]);
  return forces;
}

Vector3d FollowerForces::pressure_gradient(const PressureLoad& load, double factor, const CellPoint& initial,
                                           const CellPoint& now) const {
  Vector3d gradient = Vector3d::Zero();
  if (!is_of_deformed_place(load.pressure_function)) return gradient;
  // Half of the digits go into the difference, half into its accuracy.
  constexpr double share = 1e-7;
  const double step = share * now.tangents.colwise().norm().maxCoeff();
  const int directions = model_.mesh->dimension;
  for (int c = 0; c < directions; ++c) {
    Vector3d before = now.at, after = now.at;
    before[c] -= step;
    after[c] += step;
    const auto value = [&](const Vector3d& place) {
      return value_of_moved(load.pressure_function, to_point(initial.at), to_point(place), time_);
    };
    gradient[c] = factor * (value(after) - value(before)) / (2.0 * step);
  }
  return gradient;
}

Eigen::SparseMatrix<double> FollowerForces::tangent(const Eigen::VectorXd& u) const {
  std::vector<Eigen::Triplet<double>> entries;
  each_point(u, [&](const SkinLoad& load, const CellSample& sample, const CellPoint& initial, const CellPoint& now) {
    const bool axisymmetric = is_axisymmetric(model_.formulations[load.cell]);
    const double radius = axisymmetric ? now.at[0] : 1.0;
    const Traction acting = traction(load, sample, initial, now);
    const Vector3d normal = now.normal(dimension(model_.mesh->cell_types[load.cell]));
    const Vector3d gradient = load.pressure != nullptr ? pressure_gradient(*load.pressure, load.factor, initial, now)
                                                       : Vector3d(Vector3d::Zero());
    const auto nodes = model_.mesh->cell(load.cell);
    for (std::size_t b = 0; b < nodes.size(); ++b) {
      const auto column = static_cast<Eigen::Index>(b);
      const Matrix3d turn = normal_change(now, sample, column);
      Matrix3d change = -acting.pressure * turn - sample.values[column] * normal * gradient.transpose();
      if (load.force != nullptr) change += acting.density * normal.normalized().transpose() * turn;
      if (acting.shear != 0.0) change += acting.shear * sample.derivatives(column, 0) * Matrix3d::Identity();
      change *= radius;
      if (axisymmetric) change.row(0) += sample.values[column] * acting.force.transpose();
      for (std::size_t a = 0; a < nodes.size(); ++a) {
        const double weight = sample.weight * sample.values[static_cast<Eigen::Index>(a)];
        for (int i = 0; i < 3; ++i) {
          for (int j = 0; j < 3; ++j) {
            const int row = dofs_.dof(nodes[a], static_cast<Component>(i)),
                      other = dofs_.dof(nodes[b], static_cast<Component>(j));
            if (row >= 0 && other >= 0 && change(i, j) != 0.0) entries.emplace_back(row, other, weight * change(i, j));
          }
        }
      }
    }
  });
  Eigen::SparseMatrix<double> matrix(dofs_.size(), dofs_.size());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace comma::solver
