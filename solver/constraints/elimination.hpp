// Kinematic conditions by elimination: u = T q + g. What is symmetric positive definite stays so.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Dense>
#include <Eigen/Sparse>

#include "solver/constraints/congruence.hpp"
#include "solver/constraints/gauss_jordan.hpp"
#include "solver/linear/linear_solver.hpp"
#include "solver/linear/unsymmetric_solver.hpp"
#include "solver/loads/load.hpp"
#include "solver/model/model.hpp"

namespace comma::solver {

/// Sparse Gauss-Jordan elimination with pivoting on the largest coefficient. Coefficients do not change with time; the
/// right-hand sides c(t) do, so g(t) = G c(t). Redundant relations are found and dropped; a contradictory pair is an
/// error that names both origins. What several loads without multipliers (AFFE_CHAR_CINE) impose on one degree of
/// freedom adds up (17.3). Keeps the loads alive, nothing else of its arguments. Not for use from several threads at
/// once (reduce caches its plan).
class Elimination {
 public:
  /// `mesh`: for the points at which functions are evaluated and for the names of nodes in messages.
  /// Throws Error `unknown-dof` when a relation uses a component that its node does not carry, naming node, component,
  /// origin; Error `contradictory-conditions` when a relation reads 0 = c, or when conditions that do not change with
  /// time disagree.
  Elimination(const Mesh& mesh, const DofMap& dofs, std::span<const AppliedLoad> loads);

  int full_size() const { return static_cast<int>(transformation_.rows()); }
  int reduced_size() const { return static_cast<int>(kept_.size()); }
  /// T, full_size x reduced_size.
  const Eigen::SparseMatrix<double>& transformation() const { return transformation_; }
  /// The displacements (full_size) from which the conditions of differential loads count from now on; zero before.
  void measure_from(const Eigen::VectorXd& reference);
  /// g at a time (full_size). Throws Error `contradictory-conditions` naming both origins when redundant relations
  /// disagree at that time by more than `contradiction_tolerance` relative to the largest value involved.
  Eigen::VectorXd offset(double time) const;
  /// The full degree of freedom behind each reduced one (for messages); its row of T is a unit row.
  std::span<const int> kept() const { return kept_; }

  /// T^T K T, lower triangle; the pattern depends on K's pattern alone. Its plan is made anew when K's pattern changes.
  /// Where conditions only hold single unknowns, it is a part of K and takes K's memory over.
  SymmetricMatrix reduce(SymmetricMatrix stiffness) const;
  /// T^T W T of a skew-symmetric W, its strict lower triangle.
  SkewMatrix reduce_skew(const SkewMatrix& stiffness) const;

  /// Twelve digits typed by hand, or a function's interpolation, agree better than this; different intentions do not.
  static constexpr double contradiction_tolerance = 1e-9;

 private:
  static constexpr int unit_count = 4;

  /// One relation with what its right-hand side needs.
  struct Addend {
    std::shared_ptr<const Load> load;  ///< keeps `relation` alive
    const LinearRelation* relation;
    TimeFunction multiplier;
    double value(const Point& at, double time) const;
  };
  /// A row, and all that its right-hand side adds up.
  struct Condition {
    std::vector<Addend> addends;  ///< the row is that of the first
    Point at;
    int unit;          ///< see unit_of()
    std::string text;  ///< "DX at N3", "DX at N1 - DX at N2"
    bool constant;
    SparseRow differential;  ///< its coefficients, if it counts from the initial state
    double reference = 0.0;  ///< what they give there

    double value(double time) const;
    std::string origin() const;
  };

  /// Index of the row that a load without multipliers has for a degree of freedom.
  using KinematicRows = std::map<int, std::size_t>;
  void add_condition(const Mesh& mesh, const DofMap& dofs, const AppliedLoad& applied, const LinearRelation& relation,
                     std::vector<SparseRow>& rows, KinematicRows& kinematic);
  void set_transformation(const GaussJordan& reduction, int full_size);
  Eigen::VectorXd values(double time) const;
  /// The largest values that conditions of each unit prescribe.
  using Scales = std::array<double, unit_count>;
  Scales scales_of(const Eigen::VectorXd& values) const;
  void check(const SparseRow& dependency, const Eigen::VectorXd& values, const Scales& scales, double time) const;
  void check_constant_dependencies() const;
  [[noreturn]] void contradict(const SparseRow& dependency, const Eigen::VectorXd& values, double time) const;

  std::vector<Condition> conditions_;
  std::vector<SparseRow> dependencies_;
  std::vector<int> kept_;
  std::vector<int> selected_;  ///< the reduced unknown of each degree of freedom (-1: held) where T does nothing else;
                               ///< empty otherwise
  Eigen::SparseMatrix<double> transformation_;
  Eigen::SparseMatrix<double> offsets_;  ///< G, full_size x conditions
  mutable std::unique_ptr<Congruence> plan_;
};

}  // namespace comma::solver
