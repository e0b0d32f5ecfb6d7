// What STAT_NON_LINE leaves of every step in the table PARA_CALC, that of the steps that ARCHIVAGE does not keep too.
#pragma once

#include "commands/concepts.hpp"
#include "interpreter/graph/call.hpp"
#include "solver/fields/integrals/external_work.hpp"

namespace comma::commands {

/// Fills ResultConcept::computed: NUME_REUSE, INST, with ENERGIE the work of external and internal forces so far, and
/// the parameters of the step.
class StepRecorder {
 public:
  /// `call`: STAT_NON_LINE, which begins at the instant `start`. Keeps a reference to what is computed, and goes on
  /// with its table.
  StepRecorder(const interpreter::Call& call, ResultConcept& computed, double start);

  /// Adds the row of the last step.
  void take();

 private:
  solver::NodalField forces_of_last_step() const;
  void add_energies(Row& row);

  ResultConcept& computed_;
  bool with_energies_;
  solver::RunningWork work_;
};

}  // namespace comma::commands
