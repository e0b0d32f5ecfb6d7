#include "solver/nonlinear/critical_modes.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "solver/elements/imposed_strains.hpp"
#include "solver/error.hpp"
#include "solver/linear/generalised_eigen.hpp"

namespace comma::solver {

namespace {

/// The reduced unknowns that take part.
std::vector<int> kept_unknowns(const StabilityAnalysis& analysis, const Elimination& elimination, const DofMap& dofs) {
  std::vector<int> kept;
  for (int i = 0; i < elimination.reduced_size(); ++i) {
    const Component component = dofs.component_of(elimination.kept()[static_cast<std::size_t>(i)]);
    if (std::ranges::find(analysis.excluded, component) == analysis.excluded.end()) kept.push_back(i);
  }
  return kept;
}

/// The rows and columns of a lower triangle.
template <class Matrix>
Matrix part_of(const Matrix& whole, const std::vector<int>& kept) {
  std::vector<int> place(static_cast<std::size_t>(whole.rows()), -1);
  for (std::size_t k = 0; k < kept.size(); ++k) place[static_cast<std::size_t>(kept[k])] = static_cast<int>(k);
  std::vector<Eigen::Triplet<double>> entries;
  for (int column = 0; column < whole.outerSize(); ++column)
    for (typename Matrix::InnerIterator it(whole, column); it; ++it) {
      const int i = place[static_cast<std::size_t>(it.row())], j = place[static_cast<std::size_t>(column)];
      if (i >= 0 && j >= 0) entries.emplace_back(i, j, it.value());
    }
  Matrix part(static_cast<Eigen::Index>(kept.size()), static_cast<Eigen::Index>(kept.size()));
  part.setFromTriplets(entries.begin(), entries.end());
  return part;
}

SymmetricMatrix identity(Eigen::Index size) {
  SymmetricMatrix matrix(size, size);
  matrix.setIdentity();
  return matrix;
}

NodalField shape_of(const Eigen::VectorXd& vector, const std::vector<int>& kept, const Elimination& elimination,
                    const DofMap& dofs) {
  Eigen::VectorXd reduced = Eigen::VectorXd::Zero(elimination.reduced_size());
  for (std::size_t k = 0; k < kept.size(); ++k) reduced[kept[k]] = vector[static_cast<Eigen::Index>(k)];
  return to_field(elimination.transformation() * reduced, dofs, "DEPL_R");
}

bool has_sign(double value, InstabilitySign sign) {
  return sign == InstabilitySign::either || (value > 0.0) == (sign == InstabilitySign::positive);
}

/// With the stiffness of stresses apart the load itself is critical from a factor of 1 down; without, a stiffness below
/// zero tells.
bool is_instability(const StabilityAnalysis& analysis, double value) {
  if (!analysis.geometric) return value < 0.0;
  return has_sign(value, analysis.sign) && std::abs(value) <= 1.0 + analysis.precision;
}

}  // namespace

void require_modes(const StabilityAnalysis& analysis, const StaticProblem& problem) {
  if (problem.contact || !problem.unilateral.empty() || !problem.followers.empty())
    throw Error("unsupported",
                "modes of buckling are not known together with contact, unilateral conditions or loads that follow",
                "leave out CRIT_STAB");
  if (std::ranges::any_of(problem.driven, [](const AppliedLoad& each) { return gives_initial_strains(*each.load); }))
    throw Error(
        "unsupported",
        "modes of buckling are not known together with initial strains (PRE_EPSI) whose intensity PILOTAGE finds",
        "leave out CRIT_STAB");
  if (!problem.behaviours || !analysis.geometric) return;
  for (std::size_t cell = 0; cell < problem.behaviours->size(); ++cell) {
    if (problem.model->formulations[cell] == Formulation::none ||
        (*problem.behaviours)[cell].kinematics == Kinematics::small)
      continue;
    throw Error("unsupported",
                fmt::format("cell {}: in large displacements what stresses add is part of the stiffness already",
                            problem.model->mesh->cell_name(static_cast<int>(cell))),
                "give RIGI_GEOM='NON' in CRIT_STAB, or DEFORMATION='PETIT'");
  }
}

bool is_stability_due(const StabilityAnalysis& analysis, double instant, int number) {
  if (analysis.instants.empty()) return number % std::max(1, analysis.period) == 0;
  return std::ranges::any_of(analysis.instants, [&](double each) {
    const double scale = analysis.absolute_tolerance ? 1.0 : std::max(std::abs(each), std::abs(instant));
    return std::abs(each - instant) <= analysis.instant_tolerance * scale;
  });
}

StabilityReport critical_modes(const StabilityAnalysis& analysis, double instant, const Eigen::VectorXd& u,
                               const Assembler& assembler, const Elimination& elimination, const DofMap& dofs) {
  const std::vector<int> kept = kept_unknowns(analysis, elimination, dofs);
  const SymmetricMatrix stiffness = part_of(SymmetricMatrix(elimination.reduce(assembler.stiffness(u))), kept);
  const SymmetricMatrix other =
      analysis.geometric
          ? SymmetricMatrix(-part_of(SymmetricMatrix(elimination.reduce(assembler.geometric_stiffness(u))), kept))
          : identity(stiffness.rows());
  SkewMatrix skew;
  if (!assembler.is_symmetric()) skew = part_of(elimination.reduce_skew(assembler.skew_stiffness(u)), kept);
  const Pencil pencil{stiffness, assembler.is_symmetric() ? nullptr : &skew, other};
  const EigenPairs pairs = analysis.selection == ModeSelection::band
                               ? eigenvalues_between(pencil, analysis.first, analysis.last)
                               : smallest_eigenvalues(pencil, analysis.count);
  StabilityReport report;
  report.instant = instant;
  for (std::size_t k = 0; k < pairs.values.size(); ++k) {
    report.modes.push_back(
        {pairs.values[k], shape_of(pairs.vectors.col(static_cast<Eigen::Index>(k)), kept, elimination, dofs)});
    report.unstable = report.unstable || is_instability(analysis, pairs.values[k]);
  }
  return report;
}

}  // namespace comma::solver
