#include "interpreter/syntax/scope.hpp"

#include <algorithm>

namespace comma::interpreter {

int ScopeStack::Scope::slot_of(std::string_view name) const {
  const auto found = slot_numbers.find(name);
  return found == slot_numbers.end() ? -1 : found->second;
}

void ScopeStack::Scope::add_slot(const std::string& name) {
  if (slot_numbers.emplace(name, static_cast<int>(slots.size())).second) slots.push_back(name);
}

void ScopeStack::open(bool comprehension) { scopes_.emplace_back().comprehension = comprehension; }

ScopeStack::Closed ScopeStack::close() {
  Scope scope = take_innermost();
  Scope& around = scopes_.back();
  Closed closed;
  closed.changes_outer = !scope.globals.empty() || !scope.outer.empty();
  for (NameNode* name : scope.uses) {
    if (scope.globals.contains(name->id)) {
      closed.outer_uses.push_back({name, 0});
      continue;  // stays global
    }
    const int slot = scope.slot_of(name->id);
    if (slot >= 0) {
      name->global = false;
      name->slot = slot;
    } else {
      ++name->hops;
      around.uses.push_back(name);
      closed.outer_uses.push_back({name, name->hops});
    }
  }
  for (OuterName& name : scope.required) {
    if (scope.slot_of(name.name) < 0) around.required.push_back(std::move(name));
  }
  closed.slots = std::move(scope.slots);
  return closed;
}

void ScopeStack::bind(const NameNode& name) {
  Scope& scope = scopes_.back();
  if (!scope.function || scope.globals.contains(name.id) || scope.outer.contains(name.id)) return;
  scope.add_slot(name.id);
}

void ScopeStack::move_uses(std::size_t mark) {
  Scope& around = scopes_[scopes_.size() - 2];
  const auto from = around.uses.begin() + static_cast<std::ptrdiff_t>(std::min(mark, around.uses.size()));
  scopes_.back().uses.assign(from, around.uses.end());
  around.uses.erase(from, around.uses.end());
}

bool ScopeStack::in_function() const {
  for (auto scope = scopes_.rbegin(); scope != scopes_.rend(); ++scope) {
    if (!scope->comprehension) return scope->function;
  }
  return false;
}

bool ScopeStack::declare_global(const std::string& name) {
  Scope& scope = scopes_.back();
  if (!scope.function) return true;
  if (scope.slot_of(name) >= 0) return false;
  scope.globals.insert(name);
  return true;
}

bool ScopeStack::declare_outer(const OuterName& name) {
  Scope& scope = scopes_.back();
  if (!scope.function || scope.slot_of(name.name) >= 0) return false;
  scope.outer.insert(name.name);
  scopes_[scopes_.size() - 2].required.push_back(name);
  return true;
}

void ScopeStack::roll_back(Checkpoint checkpoint) {
  scopes_.resize(std::min(checkpoint.scopes, scopes_.size()));
  scopes_.back().uses.resize(std::min(checkpoint.uses, scopes_.back().uses.size()));
}

std::vector<std::string> ScopeStack::free_names() const {
  std::vector<std::string> names;
  for (const NameNode* name : scopes_.back().uses) names.push_back(name->id);
  return names;
}

ScopeStack::Scope ScopeStack::take_innermost() {
  Scope scope = std::move(scopes_.back());
  scopes_.pop_back();
  return scope;
}

}  // namespace comma::interpreter
