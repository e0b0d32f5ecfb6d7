// What a value finds in the file only when it is used. A command runs after the whole file has been read, but the file
// means the state that its variables have where the command stands: what a formula gets of functions and lists of the
// file must therefore be known before they change.
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "interpreter/graph/command_graph.hpp"
#include "interpreter/values/value.hpp"

namespace comma::interpreter {

struct LateReads {
  std::set<std::string, std::less<>> names;  ///< the variables that are looked up
  bool changes_unseen = false;  ///< it, or what those hold, can change without a variable being bound: a list, an
                                ///< iterator; or its use itself changes or prints something
};

/// Follows functions into those that they call, as far as the variables hold them now.
LateReads late_reads(const Value& value);

/// Whether its use may give something else later: a function of the file is in it, or what can change.
bool may_change(const Value& value);

/// The calls that wait in the graph and use such values, their own (FORMULE) or those of calls that they build on.
class LateCalls {
 public:
  /// Takes note of the last call of the graph. `has_own`: its keywords may hold such values. Returns whether it is to
  /// run at once, since nothing would tell when what it uses changes.
  bool note_last(const CommandGraph& graph, bool has_own);

  /// The calls that must run before this variable is bound anew, in order. They are forgotten here.
  std::vector<int> take_before_binding(std::string_view name);

 private:
  struct Source {
    int node;
    std::vector<Value> values;
  };
  std::vector<Source> sources_;
  std::vector<int> waiting_;
  std::set<std::string, std::less<>> names_;  ///< that the waiting calls look up
};

}  // namespace comma::interpreter
