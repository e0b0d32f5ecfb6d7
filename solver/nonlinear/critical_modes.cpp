#include "solver/nonlinear/critical_modes.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "solver/elements/solids/imposed_strains.hpp"
#include "solver/error.hpp"
#include "solver/linear/generalised_eigen.hpp"

namespace comma::solver {

namespace {

/// One at each reduced unknown that takes part, zero at those of excluded components.
SymmetricMatrix participation(const StabilityAnalysis& analysis, const Elimination& elimination, const DofMap& dofs) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < elimination.reduced_size(); ++i) {
    const Component component = dofs.component_of(elimination.kept()[static_cast<std::size_t>(i)]);
    if (std::ranges::find(analysis.excluded, component) == analysis.excluded.end()) entries.emplace_back(i, i, 1.0);
  }
  SymmetricMatrix matrix(elimination.reduced_size(), elimination.reduced_size());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

bool has_sign(double value, InstabilitySign sign) {
  return sign == InstabilitySign::either || (value > 0.0) == (sign == InstabilitySign::positive);
}

/// With the stiffness of stresses apart the load itself is critical from a factor of 1 down; without, an eigenvalue of
/// the stiffness below zero tells.
bool is_instability(const StabilityAnalysis& analysis, double value) {
  if (!analysis.geometric) return value > 0.0;
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

StabilityReport critical_modes(const StabilityAnalysis& analysis, TangentKind kind, double instant,
                               const Eigen::VectorXd& u, const Assembler& assembler, const Elimination& elimination,
                               const DofMap& dofs) {
  const bool is_elastic = kind == TangentKind::elastic, is_symmetric = is_elastic || assembler.is_symmetric();
  const SymmetricMatrix stiffness =
      elimination.reduce(is_elastic ? assembler.initial_stiffness(u) : assembler.stiffness(u));
  const SymmetricMatrix other =
      analysis.geometric ? SymmetricMatrix(-SymmetricMatrix(elimination.reduce(assembler.geometric_stiffness(u))))
                         : SymmetricMatrix(-participation(analysis, elimination, dofs));
  StabilityReport report;
  report.instant = instant;
  if (other.nonZeros() == 0) return report;
  SkewMatrix skew;
  if (!is_symmetric) skew = elimination.reduce_skew(assembler.skew_stiffness(u));
  const Pencil pencil{stiffness, is_symmetric ? nullptr : &skew, other};
  const EigenPairs pairs = analysis.selection == ModeSelection::band
                               ? eigenvalues_between(pencil, analysis.first, analysis.last)
                               : smallest_eigenvalues(pencil, analysis.count);
  for (std::size_t k = 0; k < pairs.values.size(); ++k) {
    const Eigen::VectorXd shape = elimination.transformation() * pairs.vectors.col(static_cast<Eigen::Index>(k));
    report.modes.push_back({pairs.values[k], to_field(shape, dofs, "DEPL_R")});
    report.unstable = report.unstable || is_instability(analysis, pairs.values[k]);
  }
  return report;
}

}  // namespace comma::solver
