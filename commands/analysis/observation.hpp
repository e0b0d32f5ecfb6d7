// Values followed through the steps of a nonlinear computation (STAT_NON_LINE, OBSERVATION; U4.51.03).
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "commands/analysis/result_reading.hpp"
#include "commands/concepts.hpp"
#include "interpreter/graph/call.hpp"
#include "solver/fields/field_computation.hpp"

namespace comma::commands {

/// Fills a table with the values that OBSERVATION asks for, step by step.
class Observer {
 public:
  /// `call`: STAT_NON_LINE. Keeps copies of its occurrences. Throws DiagnosticError for a place that the mesh lacks.
  /// Keeps a reference to what is computed.
  Observer(const interpreter::Call& call, const ResultConcept& computed);

  bool empty() const { return observations_.empty(); }
  /// Appends the rows of the last step: node by node or point by point, NUME_OBSE counting the rows of a computation
  /// and NUME_REUSE computations; `number` counts the steps, 0 being the initial state. Fields that the step does not
  /// hold are computed as CALC_CHAMP does. Throws DiagnosticError `unknown-field`, `unknown-component`, `wrong-type`.
  void observe(int number, Table& table);

  /// Tells of occurrences that have given no row, and of instants among the `computed` ones of all steps at which none
  /// ended.
  void warn_of_nothing(std::span<const double> computed, interpreter::Diagnostics& diagnostics) const;

 private:
  struct Observation {
    interpreter::Keywords keywords;
    std::string name;  ///< in the column NOM_OBSERVATION
    std::vector<int> nodes, cells;
    std::vector<double> instants;            ///< empty: every step
    InstantTolerance tolerance;              ///< of these
    bool was_due = false, at_nodes = false;  ///< whether the field has its values there
    std::size_t rows = 0;
  };

  bool is_due(const Observation& observation, double instant, int number) const;
  /// The last step's fields that it does not hold, made when the first is asked for.
  using Computation = std::optional<solver::FieldComputation>;

  void observe(Observation& observation, const solver::ResultStep& step, int number, Computation& computation,
               Table& table) const;
  /// The field whose components are watched: that of the step, one by names of internal variables, or the values of a
  /// formula; `made` holds what the step does not.
  const solver::Field& watched(const interpreter::Keywords& keywords, const solver::ResultStep& step,
                               Computation& computation, solver::Field& made) const;

  const ResultConcept& computed_;
  const solver::Mesh& mesh_;
  std::size_t rows_before_;  ///< rows of earlier computations of the same result: NUME_OBSE counts from them
  std::vector<Observation> observations_;
};

}  // namespace comma::commands
