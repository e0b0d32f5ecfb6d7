// Which steps and fields of a nonlinear computation its result keeps (STAT_NON_LINE, ARCHIVAGE; U4.51.03).
#pragma once

#include <span>
#include <vector>

#include "commands/analysis/result_reading.hpp"
#include "commands/concepts.hpp"
#include "interpreter/graph/call.hpp"

namespace comma::commands {

/// The initial state and the last step are kept in any case, the last with all of its fields: a computation goes on
/// from it (Code_Aster 17.3).
class Archive {
 public:
  /// `call`: STAT_NON_LINE, with ARCHIVAGE or without (everything is kept).
  explicit Archive(const interpreter::Call& call);

  /// To be called each time a step has been appended to `result`: drops the step before if it is not to be kept, or its
  /// fields that are not wanted. Steps are numbered as they are kept.
  void update(solver::Result& result);

  /// Of the instants named, those among the `computed` ones of all steps at which none has ended.
  std::vector<double> missed(std::span<const double> computed) const;

 private:
  bool is_wanted(double instant, int number) const;

  std::vector<double> instants_;  ///< empty: by `every_`
  InstantTolerance tolerance_;
  int every_ = 1;
  std::vector<std::string> left_out_;
  int steps_ = 0;            ///< computed so far, the initial state aside
  bool last_wanted_ = true;  ///< of the last step
  bool has_own_ = false;     ///< the last step is of this computation
};

}  // namespace comma::commands
