// Points of contact, each on a node of its own, on bodies that are a dense matrix.
#pragma once

#include <array>
#include <cmath>

#include "solver/contact_law/condensed_contact.hpp"

namespace comma::solver {

/// Of weight one, alone on the node of its number.
inline CondensedPoint point_on_node(int node, int rows, double friction) {
  CondensedPoint point;
  point.first_row = rows * node;
  point.rows = point.components = rows;
  point.nodes[0] = node;
  point.shape[0] = 1.0;
  point.node_count = 1;
  point.weight = 1.0;
  point.law.friction = friction;
  point.law.augmentation = point.law.friction_augmentation = 1.0;
  return point;
}

inline RowMatrix identity_rows(int size) {
  RowMatrix rows(size, size);
  rows.setIdentity();
  return rows;
}

/// A problem of `count` multipliers and points of three rows each, all open and without forces; the points are still to
/// come.
inline void make_room(int count, CondensedProblem& problem, CondensedState& state) {
  problem.node_count = count;
  problem.components = 3;
  problem.free = problem.held = Eigen::VectorXd::Zero(3 * count);
  state.multipliers = Eigen::VectorXd::Zero(3 * count);
  state.statuses.assign(static_cast<std::size_t>(count), ContactStatus::open);
}

/// `count` points of three rows each, coupled by a compliance that is dense and positive definite.
struct Coupled {
  CondensedProblem problem;
  CondensedState state;
  SchurComplement schur;

  Coupled(int count, double friction) : schur(identity_rows(3 * count), compliance(3 * count)) {
    make_room(count, problem, state);
    for (int p = 0; p < count; ++p) {
      problem.points.push_back(point_on_node(p, 3, friction));
      problem.free.segment<3>(3 * p) << -1.0 + 0.3 * p, 0.2 * p, 0.5;
    }
  }

  static SchurComplement::ApplyInverse compliance(int size) {
    Eigen::MatrixXd matrix(size, size);
    for (int i = 0; i < size; ++i)
      for (int j = 0; j < size; ++j) matrix(i, j) = (i == j ? 1.0 : 0.0) + 0.3 / (1.0 + std::abs(i - j));
    return [matrix](Eigen::Ref<Eigen::MatrixXd> columns) { columns = matrix * columns; };
  }
};

/// Points on the nodes of a square grid of a surface, each with a force on it, whose compliance falls off with the
/// distance as that of a half-space does.
struct CoupledSurface {
  static constexpr double friction = 0.4;
  CondensedProblem problem;
  CondensedState state;
  SchurComplement schur;

  explicit CoupledSurface(int edge) : schur(identity_rows(3 * edge * edge), inverse(edge)) {
    const int count = edge * edge;
    make_room(count, problem, state);
    for (int p = 0; p < count; ++p) {
      CondensedPoint point = point_on_node(p, 3, friction);
      point.weight = 1.0 / count;
      point.law.augmentation = point.law.friction_augmentation = count;
      problem.points.push_back(point);
      // Pressed on one side more than on the other, which stands open, and pulled along.
      const double x = static_cast<double>(p % edge) / edge;
      problem.free.segment<3>(3 * p) << -1.0 + 1.3 * x, 0.3, 0.1 * std::sin(p);
    }
  }

  static SchurComplement::ApplyInverse inverse(int edge) {
    const int count = edge * edge;
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(3 * count, 3 * count);
    for (int a = 0; a < count; ++a)
      for (int b = 0; b < count; ++b) {
        const double distance = std::hypot(a % edge - b % edge, a / edge - b / edge);
        matrix.block<3, 3>(3 * a, 3 * b) = (a == b ? 2.5 : 1.0 / distance) * Eigen::Matrix3d::Identity();
      }
    return [matrix](Eigen::Ref<Eigen::MatrixXd> columns) { columns = matrix * columns; };
  }

  /// Multipliers on a grid twice as coarse, from which they are interpolated to the points.
  void share_multipliers(int edge) {
    const int cells = edge / 2;
    problem.node_count = (cells + 1) * (cells + 1);
    state.multipliers = Eigen::VectorXd::Zero(3 * problem.node_count);
    for (int p = 0; p < edge * edge; ++p) {
      const int column = p % edge, row = p / edge;
      const int first = row / 2 * (cells + 1) + column / 2;
      const double x = column % 2 ? 0.75 : 0.25, y = row % 2 ? 0.75 : 0.25;
      CondensedPoint& point = problem.points[static_cast<std::size_t>(p)];
      point.node_count = 4;
      point.nodes = {first, first + 1, first + cells + 1, first + cells + 2};
      point.shape = {(1 - x) * (1 - y), x * (1 - y), (1 - x) * y, x * y};
    }
  }

  std::array<int, 3> counts() const {
    std::array<int, 3> result{};
    for (const ContactStatus status : state.statuses) ++result[static_cast<std::size_t>(status)];
    return result;
  }
};

}  // namespace comma::solver
