// Which variable a name means. Python decides this before a function runs: a name that is bound anywhere in a function
// is local to it everywhere; other names are looked for in the functions around it, then among the globals.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "interpreter/syntax/ast.hpp"

namespace comma::interpreter {

/// The scopes open while a file is parsed. Names are noted as they are met and resolved when their scope closes; what a
/// function does not bind is handed to the scope around it, one hop further.
class ScopeStack {
 public:
  struct OuterName {
    std::string name;
    std::uint32_t begin = 0, end = 0;
  };
  struct Scope {
    bool function = true;  ///< false: the file itself
    bool comprehension = false;
    std::vector<std::string> slots;
    std::map<std::string, int, std::less<>> slot_numbers;
    std::vector<NameNode*> uses;
    std::set<std::string, std::less<>> globals, outer;  ///< `global x`, `nonlocal x`
    std::vector<OuterName> required;                    ///< `nonlocal` names that a function around must bind
    int slot_of(std::string_view name) const;
    void add_slot(const std::string& name);
  };

  ScopeStack() { scopes_.emplace_back().function = false; }

  void open(bool comprehension = false);
  struct Closed {
    std::vector<std::string> slots;    ///< the names that the scope binds
    std::vector<OuterUse> outer_uses;  ///< those that it leaves to the scopes around it
    bool changes_outer = false;        ///< it declares some of them global or nonlocal
  };
  /// Resolves what the innermost scope binds.
  Closed close();

  void use(NameNode* name) { scopes_.back().uses.push_back(name); }
  /// The name is bound in the innermost scope.
  void bind(const NameNode& name);
  void bind_parameter(const std::string& name) { scopes_.back().add_slot(name); }

  /// Marks a place in the innermost scope's uses; `move_uses` later hands all uses after it to a newly opened scope.
  std::size_t mark() const { return scopes_.back().uses.size(); }
  void move_uses(std::size_t mark);
  void forget_uses(std::size_t mark) { scopes_.back().uses.resize(mark); }

  /// A broken statement takes its names with it: what was opened or noted since the checkpoint is forgotten.
  struct Checkpoint {
    std::size_t scopes, uses;
  };
  Checkpoint checkpoint() const { return {scopes_.size(), scopes_.back().uses.size()}; }
  void roll_back(Checkpoint checkpoint);

  bool in_function() const;
  bool declare_global(const std::string& name);  ///< false when the name is already a parameter or bound
  bool declare_outer(const OuterName& name);     ///< likewise, or when there is no function around
  /// The `nonlocal` names that no function binds, once all scopes but the file's are closed.
  const std::vector<OuterName>& unbound_outer() const { return scopes_.front().required; }

  /// The names that no closed scope bound, in the order of use, repeated ones repeated.
  std::vector<std::string> free_names() const;

  /// For a part that belongs to the scope around a comprehension: its first iterable.
  Scope take_innermost();
  void put_back(Scope scope) { scopes_.push_back(std::move(scope)); }

 private:
  std::vector<Scope> scopes_;
};

}  // namespace comma::interpreter
