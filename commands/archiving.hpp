// Which steps and fields of a nonlinear computation its result keeps (STAT_NON_LINE, ARCHIVAGE; U4.51.03).
#pragma once

#include <vector>

#include "commands/concepts.hpp"
#include "interpreter/call.hpp"

namespace comma::commands {

/// The initial state and the last step are kept in any case.
class Archive {
 public:
  /// `call`: STAT_NON_LINE, with ARCHIVAGE or without (everything is kept).
  explicit Archive(const interpreter::Call& call);

  /// To be called each time a step has been appended to `result`: drops the step before if it is not to be kept, and
  /// the fields that are not wanted. Steps are numbered as they are kept.
  void update(solver::Result& result);

  /// Of the instants named, those between the first step of the computation and its last one at which no step has ended.
  std::vector<double> missed() const;

 private:
  bool is_at(double wanted, double instant) const;
  bool is_wanted(double instant, int number) const;

  std::vector<double> instants_;  ///< empty: by `every_`
  double precision_ = 0.0;
  bool relative_ = true;
  int every_ = 1;
  std::vector<std::string> left_out_;
  std::vector<double> computed_;  ///< instants of all steps
  int steps_ = 0;            ///< computed so far, the initial state aside
  bool last_wanted_ = true;  ///< of the last step
};

}  // namespace comma::commands
