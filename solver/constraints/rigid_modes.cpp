#include "solver/constraints/rigid_modes.hpp"
#include "solver/linear/symmetric_eigen.hpp"
#include "solver/mesh/place.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace comma::solver {

namespace {

constexpr int mode_count = 6;  // translations along X, Y, Z, then rotations about them
using ModeMatrix = Eigen::Matrix<double, mode_count, mode_count>;
using ModeVector = Eigen::Matrix<double, mode_count, 1>;

/// Squares of singular values below this mark rigid motions that the unknowns do not see (a rotation of a single node).
constexpr double rank_tolerance = 1e-12;
/// How far from the null space a motion along an axis may lie and still be called free.
constexpr double membership_tolerance = 1e-4;
/// Components below this beside the largest are rounding when a motion is put into words.
constexpr double negligible = 1e-6;

/// The rigid modes of a part; lengths are measured in units of its size.
struct PartModes {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double size = 1.0;
  Eigen::MatrixXd values;  ///< unknowns x modes
  /// Modes x k, orthonormal: the modes that the conditions let all nodes of the part follow.
  Eigen::MatrixXd admissible;
};

/// What each mode gives to a degree of freedom.
ModeVector mode_values(const Mesh& mesh, const DofMap& dofs, int dof, const PartModes& part) {
  const int component = static_cast<int>(dofs.component_of(dof));
  ModeVector values = ModeVector::Zero();
  if (component >= motion_count) return values;  // no motion changes a pressure
  if (component >= 3) {
    values[component] = 1.0 / part.size;
    return values;
  }
  values[component] = 1.0;
  const Eigen::Vector3d arm = (place(mesh, dofs.node_of(dof)) - part.centre) / part.size;
  for (int axis = 0; axis < 3; ++axis) values[3 + axis] = Eigen::Vector3d::Unit(axis).cross(arm)[component];
  return values;
}

void place_centre(const Mesh& mesh, std::span<const int> nodes, PartModes& part) {
  for (const int node : nodes) part.centre += place(mesh, node) / static_cast<double>(nodes.size());
  double size = 0.0;
  for (const int node : nodes) size = std::max(size, (place(mesh, node) - part.centre).norm());
  if (size > 0.0) part.size = size;
}

/// The modes for which the conditions give every degree of freedom of the part's nodes what the mode gives it.
Eigen::MatrixXd admissible_modes(const Mesh& mesh, const DofMap& dofs, const Elimination& elimination,
                                 std::span<const int> nodes, std::span<const int> unknowns, const PartModes& part) {
  Eigen::MatrixXd followed = Eigen::MatrixXd::Zero(dofs.size(), mode_count);
  for (std::size_t k = 0; k < unknowns.size(); ++k) {
    for (Eigen::SparseMatrix<double>::InnerIterator entry(elimination.transformation(), unknowns[k]); entry; ++entry) {
      followed.row(entry.row()) += entry.value() * part.values.row(static_cast<Eigen::Index>(k));
    }
  }
  ModeMatrix mismatch = ModeMatrix::Zero();
  double scale = 0.0;
  for (const int node : nodes) {
    for (int c = 0; c < motion_count; ++c) {
      const int dof = dofs.dof(node, static_cast<Component>(c));
      if (dof < 0) continue;
      const ModeVector rigid = mode_values(mesh, dofs, dof, part);
      const ModeVector difference = followed.row(dof).transpose() - rigid;
      mismatch += difference * difference.transpose();
      scale += rigid.squaredNorm();
    }
  }
  const SymmetricEigen spectrum = symmetric_eigen(mismatch);
  const auto count = (spectrum.values.array() <= rank_tolerance * scale).count();
  return spectrum.vectors.leftCols(count);
}

PartModes modes_of(const Mesh& mesh, const DofMap& dofs, const Elimination& elimination,
                   std::span<const int> unknowns) {
  PartModes part;
  const std::vector<int> nodes = nodes_moved(dofs, elimination, unknowns);
  place_centre(mesh, nodes, part);
  part.values.resize(static_cast<Eigen::Index>(unknowns.size()), mode_count);
  for (std::size_t k = 0; k < unknowns.size(); ++k) {
    part.values.row(static_cast<Eigen::Index>(k)) =
        mode_values(mesh, dofs, elimination.kept()[unknowns[k]], part).transpose();
  }
  part.admissible = admissible_modes(mesh, dofs, elimination, nodes, unknowns, part);
  return part;
}

struct ModeEnergies {
  ModeMatrix energy = ModeMatrix::Zero();  ///< R^T K R
  /// Of rotations times 1 / size^2, as the modes have them: whatever the unit of length.
  double largest_diagonal = 0.0;
};

/// Rows outside the part do not couple with it, so only its own columns are walked.
ModeEnergies energies_of(const SymmetricMatrix& stiffness, std::span<const int> unknowns,
                         const Eigen::MatrixXd& values) {
  std::vector<int> place(static_cast<std::size_t>(stiffness.rows()), -1);
  for (std::size_t k = 0; k < unknowns.size(); ++k) place[unknowns[k]] = static_cast<int>(k);
  Eigen::MatrixXd forces = Eigen::MatrixXd::Zero(values.rows(), mode_count);
  ModeEnergies result;
  for (const int column : unknowns) {
    for (SymmetricMatrix::InnerIterator entry(stiffness, column); entry; ++entry) {
      const int row = static_cast<int>(entry.row());
      if (place[row] < 0) continue;
      forces.row(place[row]) += entry.value() * values.row(place[column]);
      if (row != column)
        forces.row(place[column]) += entry.value() * values.row(place[row]);
      else
        result.largest_diagonal = std::max(result.largest_diagonal,
                                           std::abs(entry.value()) * values.row(place[column]).cwiseAbs2().maxCoeff());
    }
  }
  result.energy = values.transpose() * forces;
  return result;
}

/// Removes a unit direction from an orthonormal basis.
Eigen::MatrixXd without(const Eigen::MatrixXd& basis, const Eigen::VectorXd& direction) {
  const Eigen::VectorXd inside = basis.transpose() * direction;
  const Eigen::MatrixXd rotation = inside.householderQr().householderQ();
  return basis * rotation.rightCols(basis.cols() - 1);
}

/// Combines motions so that their rotations lie along the axes as far as they can: Gauss-Jordan on the rotations.
void align_rotations(std::vector<ModeVector>& motions) {
  std::size_t done = 0;
  for (int axis = 3; axis < mode_count && done < motions.size(); ++axis) {
    std::size_t best = done;
    for (std::size_t k = done; k < motions.size(); ++k) {
      if (std::abs(motions[k][axis]) > std::abs(motions[best][axis])) best = k;
    }
    if (std::abs(motions[best][axis]) <= negligible * motions[best].norm()) continue;
    std::swap(motions[done], motions[best]);
    motions[done] /= motions[done][axis];
    for (std::size_t k = 0; k < motions.size(); ++k) {
      if (k != done) motions[k] -= motions[k][axis] * motions[done];
    }
    ++done;
  }
}

RigidMotion to_motion(const ModeVector& mode, const PartModes& part) {
  RigidMotion motion;
  motion.translation = mode.head<3>();
  motion.rotation = mode.tail<3>() / part.size;
  motion.centre = part.centre;
  if (mode.tail<3>().norm() <= negligible * mode.norm()) {
    motion.rotation.setZero();
    return motion;
  }
  // The axis: where the translation across it vanishes.
  motion.centre += motion.rotation.cross(motion.translation) / motion.rotation.squaredNorm();
  motion.translation = motion.rotation * motion.rotation.dot(motion.translation) / motion.rotation.squaredNorm();
  return motion;
}

std::string coordinates(const Eigen::Vector3d& at, double scale, int dimension) {
  const auto shown = [scale](double value) { return std::abs(value) <= negligible * scale ? 0.0 : value; };
  if (dimension == 2) return fmt::format("({:.4g}, {:.4g})", shown(at[0]), shown(at[1]));
  return fmt::format("({:.4g}, {:.4g}, {:.4g})", shown(at[0]), shown(at[1]), shown(at[2]));
}

std::string direction(const Eigen::Vector3d& vector, int dimension) {
  Eigen::Vector3d unit = vector.normalized();
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(unit[axis]) > 1.0 - negligible) return std::string(1, static_cast<char>('X' + axis));
  }
  Eigen::Index largest;
  unit.cwiseAbs().maxCoeff(&largest);
  if (unit[largest] < 0.0) unit = -unit;
  return coordinates(unit, 1.0, dimension);
}

/// Free motions along and about the axes, as far as they are independent; `rest` keeps what they do not span.
class NullSpace {
 public:
  explicit NullSpace(const Eigen::MatrixXd& basis) : null_(basis), rest_(basis) {}

  bool take(const Eigen::VectorXd& candidate) {
    const double norm = candidate.norm();
    if (norm * norm <= rank_tolerance || rest_.cols() == 0) return false;
    if ((candidate - null_ * (null_.transpose() * candidate)).norm() > membership_tolerance * norm) return false;
    const Eigen::VectorXd fresh = rest_ * (rest_.transpose() * candidate);
    if (fresh.norm() <= membership_tolerance * norm) return false;
    rest_ = without(rest_, fresh.normalized());
    return true;
  }

  const Eigen::MatrixXd& rest() const { return rest_; }

 private:
  Eigen::MatrixXd null_, rest_;
};

/// Puts the null space into motions along and about the axes first, then whatever is left of it.
std::vector<RigidMotion> readable_motions(NullSpace null, const PartModes& part, const Eigen::MatrixXd& from_basis,
                                          const Eigen::MatrixXd& to_basis) {
  std::vector<RigidMotion> motions;
  bool free_along[3] = {};
  for (int mode = 0; mode < mode_count; ++mode) {
    const ModeVector unit = ModeVector::Unit(mode);
    const bool admissible =
        (unit - part.admissible * (part.admissible.transpose() * unit)).norm() <= membership_tolerance;
    if (!admissible || !null.take(to_basis.col(mode))) continue;
    RigidMotion motion = to_motion(unit, part);
    if (mode < 3)
      free_along[mode] = true;
    else
      motion.anywhere = free_along[(mode + 1) % 3] && free_along[(mode + 2) % 3];
    motions.push_back(motion);
  }
  std::vector<ModeVector> others;
  for (Eigen::Index k = 0; k < null.rest().cols(); ++k) others.emplace_back(from_basis * null.rest().col(k));
  align_rotations(others);
  for (const ModeVector& mode : others) motions.push_back(to_motion(mode, part));
  return motions;
}

}  // namespace

bool RigidMotion::is_rotation() const { return rotation.squaredNorm() > 0.0; }

std::string RigidMotion::text(int dimension) const {
  if (!is_rotation()) return "translation along " + direction(translation, dimension);
  std::string result = "rotation about " + direction(rotation, 3);
  if (!anywhere) result += " through " + coordinates(centre, std::max(centre.norm(), 1.0 / rotation.norm()), dimension);
  return result;
}

std::vector<int> nodes_moved(const DofMap& dofs, const Elimination& elimination, std::span<const int> unknowns) {
  std::vector<int> nodes;
  for (const int unknown : unknowns) {
    for (Eigen::SparseMatrix<double>::InnerIterator entry(elimination.transformation(), unknown); entry; ++entry) {
      nodes.push_back(dofs.node_of(static_cast<int>(entry.row())));
    }
  }
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

std::vector<RigidMotion> free_rigid_motions(const Mesh& mesh, const DofMap& dofs, const Elimination& elimination,
                                            const SymmetricMatrix& stiffness, std::span<const int> unknowns,
                                            double tolerance) {
  const PartModes part = modes_of(mesh, dofs, elimination, unknowns);
  if (part.admissible.cols() == 0) return {};
  const ModeEnergies energies = energies_of(stiffness, unknowns, part.values);

  // An orthonormal basis of the admissible motions that the unknowns see: R W V / sqrt(Lambda).
  const Eigen::MatrixXd seen = part.values * part.admissible;
  const SymmetricEigen gram = symmetric_eigen(seen.transpose() * seen);
  const auto rank = (gram.values.array() > rank_tolerance * static_cast<double>(unknowns.size())).count();
  const Eigen::VectorXd lengths = gram.values.tail(rank).cwiseSqrt();
  const Eigen::MatrixXd directions = part.admissible * gram.vectors.rightCols(rank);
  const Eigen::MatrixXd from_basis = directions * lengths.cwiseInverse().asDiagonal();
  const Eigen::MatrixXd to_basis = lengths.asDiagonal() * directions.transpose();
  if (rank == 0) return {};

  const SymmetricEigen spectrum = symmetric_eigen(from_basis.transpose() * energies.energy * from_basis);
  const double limit = tolerance * energies.largest_diagonal / static_cast<double>(unknowns.size());
  const auto free_count = (spectrum.values.array() <= limit).count();
  return readable_motions(NullSpace(spectrum.vectors.leftCols(free_count)), part, from_basis, to_basis);
}

}  // namespace comma::solver
