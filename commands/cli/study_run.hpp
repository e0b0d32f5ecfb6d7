// One pass over a study: its command files parsed, evaluated, checked and, if wanted, executed.
#pragma once

#include <filesystem>
#include <list>
#include <memory>
#include <string>

#include "commands/cli/export_file.hpp"
#include "commands/cli/report.hpp"
#include "commands/context.hpp"
#include "commands/unit_numbers.hpp"
#include "interpreter/evaluation/evaluator.hpp"
#include "interpreter/evaluation/meter.hpp"
#include "interpreter/graph/session.hpp"
#include "interpreter/syntax/ast.hpp"

namespace comma::commands {

/// The command files and other files behind a `.comm` or an `.export`.
Study open_study(const std::filesystem::path& file);

/// What a pass needs and what it leaves: the graph, the verdicts, the diagnostics.
class StudyRun {
 public:
  StudyRun(Study study, Verbosity verbosity, interpreter::SessionOptions options, interpreter::Limits limits = {});

  /// Parses, evaluates, checks, and executes as far as the options say. Everything that is wrong ends up in
  /// diagnostics(). Before the first solution that the file needs in order to be read on, the rest is checked as far as
  /// that can be done without: what is wrong there ends the run.
  void run();

  const interpreter::CommandGraph& graph() const { return session_.graph(); }
  const interpreter::Diagnostics& diagnostics() const { return diagnostics_; }
  const Context& context() const { return context_; }

 private:
  void read_files();
  void look_ahead();
  interpreter::Ast read(const std::filesystem::path& file);
  void warn_of_unused_loads();
  /// INCLUDE: runs another file at its place.
  void include(const interpreter::Call& call);
  /// POURSUITE: has nothing to do, but something must be there to go on from.
  void go_on(const interpreter::Call& call) const;

  Study study_;
  interpreter::Limits limits_;
  interpreter::Diagnostics diagnostics_;
  Context context_;
  interpreter::CommandTable commands_, preparations_;
  UnitNumbers units_;
  interpreter::Catalogue catalogue_;
  interpreter::Session session_;
  std::unique_ptr<interpreter::Evaluator> evaluator_;
  std::list<interpreter::Ast> trees_;  ///< of the included files: functions defined there refer to them
  std::size_t files_begun_ = 0;
  int include_depth_ = 0;
  bool unreadable_ = false;  ///< a file has a syntax error: it is evaluated for its errors only, and says nothing
};

/// Prints the diagnostics, errors last so that they stay in sight. `alarms` false: errors only.
void print_diagnostics(const interpreter::Diagnostics& diagnostics, bool alarms);

/// The exit status that the errors call for; 0 if there are none.
int status_of(const interpreter::Diagnostics& diagnostics);

/// The status word of the report for an exit status.
std::string status_word(int exit_status);

}  // namespace comma::commands
