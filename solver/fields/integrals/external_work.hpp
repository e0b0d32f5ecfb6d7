// The work that forces on the nodes have done since the start (POST_ELEM TRAV_EXT, U4.81.22).
#pragma once

#include <vector>

#include "solver/fields/data/field.hpp"

namespace comma::solver {

/// At each step of a result, with its displacements u (DEPL) and nodal forces F (FORC_NODA): `elastic` = F . u / 2, the
/// work had they grown in proportion; `real` = the sum over the steps so far of (F_n + F_(n-1)) . (u_n - u_(n-1)) / 2.
/// The first step has done no `real` work, whatever its forces (so has it Code_Aster 17.3). The components that both
/// fields have count. Throws Error `unknown-field` naming what a step lacks.
struct ExternalWork {
  double elastic = 0.0;
  double real = 0.0;
};
std::vector<ExternalWork> external_work(const Result& result);

/// The same step by step, for steps that are not kept.
class RunningWork {
 public:
  /// `real`: what steps before the first one have done.
  explicit RunningWork(double real = 0.0) : work_{0.0, real} {}
  /// Goes on from a step that has these fields.
  RunningWork(const NodalField& displacement, const NodalField& force, double real);

  ExternalWork add(const NodalField& displacement, const NodalField& force);

 private:
  /// Displacements and forces of the step before, paired by node and component, 0 where either is absent.
  struct Pairs {
    std::vector<double> displacements, forces;
  };
  static Pairs pairs_of(const NodalField& displacement, const NodalField& force);

  Pairs before_;
  ExternalWork work_;
};

}  // namespace comma::solver
