// Points of contact, each on a node of its own, on bodies that are a dense matrix.
#pragma once

#include <cmath>

#include "solver/contact/condensed_contact.hpp"

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

/// A problem of `count` multipliers and points of three rows each, all open and without forces; the points are still to come.
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

}  // namespace comma::solver
