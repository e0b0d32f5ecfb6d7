#include "solver/linear/multigrid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "solver/linear/aggregation.hpp"
#include "solver/linear/block_matrix.hpp"
#include "solver/model/component.hpp"

namespace comma::solver {
namespace {

/// A node is a neighbour when its block is at least this large against the diagonal blocks: Vanek et al. take 0.08 and
/// halve it on each coarser grid; elastic blocks of a regular mesh lie between 0.02 and 0.3.
constexpr double strong_connection = 0.02;
/// Below this many nodes a grid is the coarsest: its dense factor costs less than another grid.
constexpr int coarsest_size = 150;
/// What is left of a motion after the others are taken out of it, below which an aggregate is too small to carry it.
constexpr double dependent_motion = 1e-8;
/// Damping of the prolongator's Jacobi step, over the largest eigenvalue of D^-1 A.
constexpr double prolongator_damping = 4.0 / 3.0;
constexpr int smoother_power_steps = 10;

/// The rigid motions' values on each node.
template <int N>
using Motions = std::vector<Eigen::Matrix<double, N, motion_count>>;

template <int N>
std::vector<Eigen::Matrix<double, N, N>> inverse_diagonal(const BlockMatrix<N, N>& matrix) {
  std::vector<Eigen::Matrix<double, N, N>> result(static_cast<std::size_t>(matrix.rows()));
  for (int i = 0; i < matrix.rows(); ++i) result[i] = matrix.find(i, i)->inverse();
  return result;
}

/// Inverse diagonal blocks for a smoother whose parts do not wait for each other: to the diagonal come the sizes of
/// what couples a node to other parts, without which the smoother could overshoot there (Baker, Falgout, Kolev and
/// Yang, SIAM Journal on Scientific Computing 33, 2011).
template <int N>
std::vector<Eigen::Matrix<double, N, N>> smoothing_inverse(const BlockMatrix<N, N>& matrix,
                                                           std::vector<Eigen::Matrix<double, N, N>> inverse) {
  for (int part = 0; part < matrix.part_count(); ++part) {
    const int first = matrix.part_start(part);
    const int last = matrix.part_start(part + 1);
    for (int i = first; i < last; ++i) {
      Eigen::Matrix<double, N, 1> coupled = Eigen::Matrix<double, N, 1>::Zero();
      for (int k = matrix.starts[i]; k < matrix.starts[i + 1]; ++k)
        if (matrix.columns[k] < first || matrix.columns[k] >= last)
          coupled += matrix.blocks[k].cwiseAbs().rowwise().sum();
      if (coupled.isZero(0.0)) continue;
      Eigen::Matrix<double, N, N> diagonal = *matrix.find(i, i);
      diagonal.diagonal() += coupled;
      inverse[i] = diagonal.inverse();
    }
  }
  return inverse;
}

template <int N>
NodeGraph strong_graph(const BlockMatrix<N, N>& matrix) {
  std::vector<double> sizes(static_cast<std::size_t>(matrix.rows()));
  for (int i = 0; i < matrix.rows(); ++i) sizes[i] = matrix.find(i, i)->norm();
  NodeGraph graph;
  for (int i = 0; i < matrix.rows(); ++i) {
    for (int k = matrix.starts[i]; k < matrix.starts[i + 1]; ++k) {
      const int j = matrix.columns[k];
      if (j != i && matrix.blocks[k].squaredNorm() > strong_connection * strong_connection * sizes[i] * sizes[j])
        graph.neighbours.push_back(j);
    }
    graph.starts.push_back(static_cast<int>(graph.neighbours.size()));
  }
  return graph;
}

/// Each aggregate's motions made orthonormal, in place; returns what they were in terms of the new ones.
template <int N>
Motions<motion_count> orthonormalise(const Aggregates& aggregates, Motions<N>& motions) {
  std::vector<std::vector<int>> members(static_cast<std::size_t>(aggregates.count));
  for (std::size_t node = 0; node < motions.size(); ++node)
    members[aggregates.of_node[node]].push_back(static_cast<int>(node));
  Motions<motion_count> coarse(members.size());
  for (std::size_t a = 0; a < members.size(); ++a) {
    auto& triangle = coarse[a];
    triangle.setZero();
    for (int c = 0; c < motion_count; ++c) {
      double before = 0.0;
      for (const int node : members[a]) before += motions[node].col(c).squaredNorm();
      for (int round = 0; round < 2; ++round) {
        for (int b = 0; b < c; ++b) {
          double product = 0.0;
          for (const int node : members[a]) product += motions[node].col(b).dot(motions[node].col(c));
          for (const int node : members[a]) motions[node].col(c) -= product * motions[node].col(b);
          triangle(b, c) += product;
        }
      }
      double after = 0.0;
      for (const int node : members[a]) after += motions[node].col(c).squaredNorm();
      const bool independent = after > dependent_motion * before;
      triangle(c, c) = independent ? std::sqrt(after) : 0.0;
      for (const int node : members[a]) motions[node].col(c) *= independent ? 1.0 / triangle(c, c) : 0.0;
    }
  }
  return coarse;
}

/// The largest eigenvalue of D^-1 A, by the power method from a fixed rough vector.
template <int N>
double largest_eigenvalue(const BlockMatrix<N, N>& matrix, const std::vector<Eigen::Matrix<double, N, N>>& inverse) {
  Eigen::VectorXd x(static_cast<Eigen::Index>(matrix.rows()) * N);
  for (Eigen::Index k = 0; k < x.size(); ++k) x[k] = std::sin(1.0 + 7.0 * static_cast<double>(k));
  Eigen::VectorXd y(x.size());
  double value = 1.0;
  for (int step = 0; step < smoother_power_steps; ++step) {
    x.normalize();
    run_parts(matrix.part_count(), [&](int part) {
      for (int i = matrix.part_start(part); i < matrix.part_start(part + 1); ++i)
        y.segment<N>(static_cast<Eigen::Index>(i) * N).noalias() = inverse[i] * matrix.row_times(i, x);
    });
    value = y.norm();
    std::swap(x, y);
  }
  // The power method stays below; a tenth covers it.
  return 1.1 * value;
}

/// (1 - damping D^-1 A) times the tentative prolongator, whose block on node i is motions[i] in the column of its
/// aggregate.
template <int N>
BlockMatrix<N, motion_count> smoothed_prolongator(const BlockMatrix<N, N>& matrix,
                                                  const std::vector<Eigen::Matrix<double, N, N>>& inverse,
                                                  const Aggregates& aggregates, const Motions<N>& motions) {
  const double damping = prolongator_damping / largest_eigenvalue(matrix, inverse);
  BlockMatrix<N, motion_count> result;
  std::vector<int> slots(static_cast<std::size_t>(aggregates.count), -1);
  for (int i = 0; i < matrix.rows(); ++i) {
    const int first = result.starts.back();
    const auto slot = [&](int aggregate) {
      if (slots[aggregate] < first) {
        slots[aggregate] = static_cast<int>(result.columns.size());
        result.columns.push_back(aggregate);
        result.blocks.push_back(Eigen::Matrix<double, N, motion_count>::Zero());
      }
      return slots[aggregate];
    };
    for (int k = matrix.starts[i]; k < matrix.starts[i + 1]; ++k) {
      const int j = matrix.columns[k];
      result.blocks[slot(aggregates.of_node[j])].noalias() += matrix.blocks[k] * motions[j];
    }
    for (std::size_t k = static_cast<std::size_t>(first); k < result.blocks.size(); ++k)
      result.blocks[k] = -damping * (inverse[i] * result.blocks[k]).eval();
    result.blocks[slot(aggregates.of_node[i])] += motions[i];
    result.starts.push_back(static_cast<int>(result.columns.size()));
  }
  return result;
}

using CoarseMatrix = BlockMatrix<motion_count, motion_count>;

/// Rows under construction: a block column beside its block.
struct CoarseRows {
  std::vector<std::vector<int>> columns;
  std::vector<std::vector<CoarseMatrix::Block>> blocks;

  explicit CoarseRows(int count) : columns(static_cast<std::size_t>(count)), blocks(columns.size()) {}

  CoarseMatrix::Block& at(int row, int column) {
    auto& known = columns[row];
    const auto found = std::ranges::find(known, column);
    const auto index = static_cast<std::size_t>(found - known.begin());
    if (found == known.end()) {
      known.push_back(column);
      blocks[row].push_back(CoarseMatrix::Block::Zero());
    }
    return blocks[row][index];
  }

  CoarseMatrix matrix() const {
    CoarseMatrix result;
    for (std::size_t row = 0; row < columns.size(); ++row) {
      result.columns.insert(result.columns.end(), columns[row].begin(), columns[row].end());
      result.blocks.insert(result.blocks.end(), blocks[row].begin(), blocks[row].end());
      result.starts.push_back(static_cast<int>(result.columns.size()));
    }
    return result;
  }
};

/// A motion that an aggregate cannot carry has a row of zeros: a unit diagonal keeps it at rest.
void hold_absent_motions(CoarseRows& rows) {
  for (int row = 0; row < static_cast<int>(rows.columns.size()); ++row) {
    CoarseMatrix::Block& diagonal = rows.at(row, row);
    for (int c = 0; c < motion_count; ++c)
      if (diagonal(c, c) == 0.0) diagonal(c, c) = 1.0;
  }
}

/// What fine rows first .. last - 1 give to P^T A P.
template <int N>
void add_coarse_rows(const BlockMatrix<N, N>& matrix, const BlockMatrix<N, motion_count>& prolongator, int first,
                     int last, CoarseRows& rows) {
  std::vector<int> slots(rows.columns.size(), -1);
  std::vector<int> columns;
  std::vector<Eigen::Matrix<double, N, motion_count>> products;
  for (int i = first; i < last; ++i) {
    columns.clear();
    products.clear();
    for (int k = matrix.starts[i]; k < matrix.starts[i + 1]; ++k) {
      const int j = matrix.columns[k];
      for (int l = prolongator.starts[j]; l < prolongator.starts[j + 1]; ++l) {
        const int column = prolongator.columns[l];
        if (slots[column] < 0) {
          slots[column] = static_cast<int>(columns.size());
          columns.push_back(column);
          products.push_back(Eigen::Matrix<double, N, motion_count>::Zero());
        }
        products[slots[column]].noalias() += matrix.blocks[k] * prolongator.blocks[l];
      }
    }
    for (int k = prolongator.starts[i]; k < prolongator.starts[i + 1]; ++k)
      for (std::size_t l = 0; l < columns.size(); ++l)
        rows.at(prolongator.columns[k], columns[l]).noalias() += prolongator.blocks[k].transpose() * products[l];
    for (const int column : columns) slots[column] = -1;
  }
}

/// P^T A P.
template <int N>
CoarseMatrix coarse_matrix(const BlockMatrix<N, N>& matrix, const BlockMatrix<N, motion_count>& prolongator,
                           int count) {
  std::vector<CoarseRows> parts(static_cast<std::size_t>(matrix.part_count()), CoarseRows(count));
  run_parts(matrix.part_count(), [&](int part) {
    add_coarse_rows(matrix, prolongator, matrix.part_start(part), matrix.part_start(part + 1),
                    parts[static_cast<std::size_t>(part)]);
  });
  CoarseRows& rows = parts.front();
  for (std::size_t part = 1; part < parts.size(); ++part)
    for (int row = 0; row < count; ++row)
      for (std::size_t k = 0; k < parts[part].columns[row].size(); ++k)
        rows.at(row, parts[part].columns[row][k]) += parts[part].blocks[row][k];
  hold_absent_motions(rows);
  return rows.matrix();
}

template <int N>
struct Level {
  BlockMatrix<N, N> matrix;
  std::vector<Eigen::Matrix<double, N, N>> smoothing;  ///< inverse diagonal blocks of the smoother
  BlockMatrix<N, motion_count> prolongator;            ///< from the next coarser level
  Eigen::VectorXd residual, coarse_rhs, coarse_solution;

  /// A step of Gauss and Seidel's method at a node, within part first .. last - 1 of the nodes; the others stand as in
  /// `elsewhere`: parts do not wait for each other, and forwards and backwards stay the transposes that conjugate
  /// gradients need.
  void sweep(int i, int first, int last, const Eigen::VectorXd& b, const Eigen::VectorXd& elsewhere,
             Eigen::VectorXd& x) const {
    const Eigen::Index at = static_cast<Eigen::Index>(i) * N;
    const Eigen::Matrix<double, N, 1> left = b.template segment<N>(at) - matrix.row_times(i, x, elsewhere, first, last);
    x.template segment<N>(at).noalias() += smoothing[i] * left;
  }

  /// From x = 0.
  void smooth_forwards(const Eigen::VectorXd& b, Eigen::VectorXd& x) const {
    x.setZero(b.size());
    const Eigen::VectorXd elsewhere = x;
    run_parts(matrix.part_count(), [&](int part) {
      const int first = matrix.part_start(part);
      const int last = matrix.part_start(part + 1);
      for (int i = first; i < last; ++i) sweep(i, first, last, b, elsewhere, x);
    });
  }

  void smooth_backwards(const Eigen::VectorXd& b, Eigen::VectorXd& x) const {
    const Eigen::VectorXd elsewhere = x;
    run_parts(matrix.part_count(), [&](int part) {
      const int first = matrix.part_start(part);
      const int last = matrix.part_start(part + 1);
      for (int i = last - 1; i >= first; --i) sweep(i, first, last, b, elsewhere, x);
    });
  }

  /// Builds the prolongator; `motions` becomes the coarse grid's. Returns the coarse matrix.
  CoarseMatrix coarsen(Motions<N>& motions, Motions<motion_count>& coarse_motions) {
    const auto inverse = inverse_diagonal(matrix);
    smoothing = smoothing_inverse(matrix, inverse);
    const Aggregates aggregates = aggregate(strong_graph(matrix));
    coarse_motions = orthonormalise(aggregates, motions);
    prolongator = smoothed_prolongator(matrix, inverse, aggregates, motions);
    const Eigen::Index size = static_cast<Eigen::Index>(aggregates.count) * motion_count;
    residual.resize(static_cast<Eigen::Index>(matrix.rows()) * N);
    coarse_rhs.resize(size);
    coarse_solution.resize(size);
    return coarse_matrix(matrix, prolongator, aggregates.count);
  }

  template <typename Coarse>
  void cycle(const Eigen::VectorXd& b, Eigen::VectorXd& x, Coarse&& solve_coarse) {
    smooth_forwards(b, x);
    matrix.multiply(x, residual);
    residual = b - residual;
    coarse_rhs.setZero();
    prolongator.add_transposed(residual, coarse_rhs);
    solve_coarse(coarse_rhs, coarse_solution);
    prolongator.multiply(coarse_solution, residual);
    x += residual;
    smooth_backwards(b, x);
  }
};

Eigen::MatrixXd dense(const CoarseMatrix& matrix) {
  const Eigen::Index size = static_cast<Eigen::Index>(matrix.rows()) * motion_count;
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(size, size);
  for (int i = 0; i < matrix.rows(); ++i)
    for (int k = matrix.starts[i]; k < matrix.starts[i + 1]; ++k)
      result.block<motion_count, motion_count>(static_cast<Eigen::Index>(i) * motion_count,
                                               static_cast<Eigen::Index>(matrix.columns[k]) * motion_count) =
          matrix.blocks[k];
  return result;
}

/// The full matrix from its lower triangle, three unknowns a node; a node that lacks one has a unit diagonal in its
/// place.
BlockMatrix<3, 3> nodal_blocks(const SymmetricMatrix& matrix, const SolidUnknowns& unknowns) {
  const auto count = unknowns.places.size();
  std::vector<std::vector<int>> neighbours(count);
  for (Eigen::Index column = 0; column < matrix.outerSize(); ++column) {
    const int j = unknowns.nodes[column];
    for (SymmetricMatrix::InnerIterator it(matrix, column); it; ++it) {
      const int i = unknowns.nodes[it.row()];
      if (neighbours[j].empty() || neighbours[j].back() != i) neighbours[j].push_back(i);
      if (i != j && (neighbours[i].empty() || neighbours[i].back() != j)) neighbours[i].push_back(j);
    }
  }
  BlockMatrix<3, 3> result;
  for (auto& of_node : neighbours) {
    std::ranges::sort(of_node);
    of_node.erase(std::unique(of_node.begin(), of_node.end()), of_node.end());
    result.columns.insert(result.columns.end(), of_node.begin(), of_node.end());
    result.starts.push_back(static_cast<int>(result.columns.size()));
  }
  result.blocks.assign(result.columns.size(), Eigen::Matrix3d::Zero());
  const auto block = [&](int i, int j) -> Eigen::Matrix3d& {
    const auto first = result.columns.begin() + result.starts[i];
    const auto last = result.columns.begin() + result.starts[i + 1];
    return result.blocks[static_cast<std::size_t>(std::lower_bound(first, last, j) - result.columns.begin())];
  };
  for (std::size_t node = 0; node < count; ++node) block(static_cast<int>(node), static_cast<int>(node)).setIdentity();
  for (Eigen::Index column = 0; column < matrix.outerSize(); ++column) {
    const int j = unknowns.nodes[column];
    const int b = unknowns.axes[column];
    for (SymmetricMatrix::InnerIterator it(matrix, column); it; ++it) {
      const int i = unknowns.nodes[it.row()];
      const int a = unknowns.axes[it.row()];
      block(i, j)(a, b) = it.value();
      block(j, i)(b, a) = it.value();
    }
  }
  return result;
}

/// The nodes in the order of their places along the body, so that parts of rows are slices of it.
SolidUnknowns sorted_along(const SolidUnknowns& unknowns) {
  Eigen::Vector3d low = unknowns.places.front();
  Eigen::Vector3d high = low;
  for (const Eigen::Vector3d& place : unknowns.places) {
    low = low.cwiseMin(place);
    high = high.cwiseMax(place);
  }
  int axis = 0;
  (high - low).maxCoeff(&axis);
  std::vector<int> order(unknowns.places.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](int node) { return unknowns.places[node][axis]; });
  std::vector<int> rank(order.size());
  SolidUnknowns sorted = unknowns;
  for (std::size_t k = 0; k < order.size(); ++k) {
    rank[order[k]] = static_cast<int>(k);
    sorted.places[k] = unknowns.places[order[k]];
  }
  for (int& node : sorted.nodes) node = rank[node];
  return sorted;
}

/// Zero where a node lacks the unknown. Places count from their centre over their extent, so that motions are of like
/// size.
Motions<3> rigid_motions(const SolidUnknowns& unknowns) {
  Eigen::Vector3d low = unknowns.places.front();
  Eigen::Vector3d high = low;
  for (const Eigen::Vector3d& place : unknowns.places) {
    low = low.cwiseMin(place);
    high = high.cwiseMax(place);
  }
  const Eigen::Vector3d centre = 0.5 * (low + high);
  const double extent = std::max((high - low).norm(), 1e-300);
  Motions<3> result(unknowns.places.size(), Motions<3>::value_type::Zero());
  for (std::size_t row = 0; row < unknowns.nodes.size(); ++row) {
    const int axis = unknowns.axes[row];
    const Eigen::Vector3d arm = (unknowns.places[unknowns.nodes[row]] - centre) / extent;
    auto& motion = result[unknowns.nodes[row]];
    motion(axis, axis) = 1.0;
    const int next = (axis + 1) % 3;
    const int last = (axis + 2) % 3;
    motion(axis, 3 + next) = arm[last];
    motion(axis, 3 + last) = -arm[next];
  }
  return result;
}

}  // namespace

struct Multigrid::Hierarchy {
  std::vector<Eigen::Index> positions;  ///< of each row among the padded unknowns
  Level<3> finest;
  std::vector<Level<motion_count>> coarser;
  Eigen::LLT<Eigen::MatrixXd> coarsest;

  void solve(std::size_t level, const Eigen::VectorXd& b, Eigen::VectorXd& x) {
    if (level == coarser.size()) {
      x = coarsest.solve(b);
      return;
    }
    coarser[level].cycle(
        b, x, [&](const Eigen::VectorXd& rhs, Eigen::VectorXd& solution) { solve(level + 1, rhs, solution); });
  }
};

Multigrid::Multigrid(const SymmetricMatrix& matrix, const SolidUnknowns& given)
    : hierarchy_(std::make_unique<Hierarchy>()) {
  const SolidUnknowns unknowns = sorted_along(given);
  Hierarchy& h = *hierarchy_;
  for (std::size_t row = 0; row < unknowns.nodes.size(); ++row)
    h.positions.push_back(static_cast<Eigen::Index>(unknowns.nodes[row]) * 3 + unknowns.axes[row]);
  h.finest.matrix = nodal_blocks(matrix, unknowns);
  Motions<3> motions = rigid_motions(unknowns);
  Motions<motion_count> coarse_motions;
  CoarseMatrix coarse = h.finest.coarsen(motions, coarse_motions);
  while (coarse.rows() > coarsest_size) {
    const int before = coarse.rows();
    auto& level = h.coarser.emplace_back();
    level.matrix = std::move(coarse);
    Motions<motion_count> own = std::move(coarse_motions);
    coarse = level.coarsen(own, coarse_motions);
    if (coarse.rows() >= before) break;
  }
  h.coarsest.compute(dense(coarse));
}

Multigrid::~Multigrid() = default;

bool Multigrid::usable() const { return hierarchy_->coarsest.info() == Eigen::Success; }

Eigen::Index Multigrid::size() const { return static_cast<Eigen::Index>(hierarchy_->finest.matrix.rows()) * 3; }

Eigen::VectorXd Multigrid::padded(const Eigen::Ref<const Eigen::VectorXd>& x) const {
  Eigen::VectorXd result = Eigen::VectorXd::Zero(size());
  for (Eigen::Index row = 0; row < x.size(); ++row) result[hierarchy_->positions[row]] = x[row];
  return result;
}

Eigen::VectorXd Multigrid::unpadded(const Eigen::VectorXd& x) const {
  Eigen::VectorXd result(static_cast<Eigen::Index>(hierarchy_->positions.size()));
  for (Eigen::Index row = 0; row < result.size(); ++row) result[row] = x[hierarchy_->positions[row]];
  return result;
}

void Multigrid::multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const {
  hierarchy_->finest.matrix.multiply(x, y);
}

void Multigrid::precondition(const Eigen::VectorXd& b, Eigen::VectorXd& x) {
  Hierarchy& h = *hierarchy_;
  h.finest.cycle(b, x, [&](const Eigen::VectorXd& rhs, Eigen::VectorXd& solution) { h.solve(0, rhs, solution); });
}

}  // namespace comma::solver
