#include "interpreter/graph/late_values.hpp"

#include <algorithm>
#include <utility>

#include "interpreter/evaluation/evaluator.hpp"
#include "interpreter/values/objects.hpp"

namespace comma::interpreter {

namespace {

class LateSearch {
 public:
  void visit(const Value& value) {
    if (reads.changes_unseen) return;
    if (value.is_tuple()) {
      for (const Value& item : value.items()) visit(item);
    } else if (const auto* function = value.as_object<FunctionObject>()) {
      if (seen_.insert(function).second) visit_function(*function);
    } else {
      reads.changes_unseen = can_change(value);
    }
  }

  LateReads reads;

 private:
  static bool can_change(const Value& value) {
    if (value.is_list() || value.is_dict() || value.is_set()) return true;
    if (const auto* builtin = value.as_object<BuiltinObject>()) return builtin->name == "print";
    const bool is_object = std::holds_alternative<std::shared_ptr<Object>>(value.storage());
    const bool stays = value.as_object<UnboundMethod>() != nullptr || value.as_object<ConceptMethod>() != nullptr ||
                       value.as_object<CommandObject>() != nullptr || value.as_object<TypeObject>() != nullptr ||
                       value.as_object<ModuleObject>() != nullptr || value.as_object<AbsentObject>() != nullptr ||
                       value.as_object<RangeObject>() != nullptr || value.as_object<ExceptionClassObject>() != nullptr;
    return is_object && !stays;
  }

  void visit_function(const FunctionObject& function) {
    reads.changes_unseen = function.code->changes_outer;
    for (const Value& value : function.defaults) visit(value);
    for (const OuterUse& use : function.code->outer_uses) {
      if (const auto value = value_of(function, use)) visit(*value);
    }
  }

  /// The variable's value now. What is no variable of the file (a builtin, a command) has none, and is no name to note.
  std::optional<Value> value_of(const FunctionObject& function, const OuterUse& use) {
    if (!use.name->global) {
      reads.names.insert(use.name->id);
      const Frame* frame = function.outer.get();
      for (int hop = use.level; hop < use.name->hops; ++hop) frame = frame->outer.get();
      return frame->slots[static_cast<std::size_t>(use.name->slot)];
    }
    const Evaluator* home = function.home ? function.home->evaluator : nullptr;
    const Value* value = home != nullptr ? home->global(use.name->id) : nullptr;
    if (value == nullptr) {
      reads.changes_unseen = reads.changes_unseen || use.name->id == "print";
      return std::nullopt;
    }
    reads.names.insert(use.name->id);
    return *value;
  }

  std::set<const FunctionObject*> seen_;
};

}  // namespace

bool may_change(const Value& value) {
  if (value.is_tuple()) return std::ranges::any_of(value.items(), may_change);
  return value.as_object<FunctionObject>() != nullptr || late_reads(value).changes_unseen;
}

LateReads late_reads(const Value& value) {
  LateSearch search;
  search.visit(value);
  return std::move(search.reads);
}

bool LateCalls::note_last(const CommandGraph& graph, bool has_own) {
  const CommandNode& last = graph.nodes().back();
  if (has_own) {
    Source source{last.id, {}};
    for (const Keyword& keyword : last.call.items) {
      if (may_change(keyword.value)) source.values.push_back(keyword.value);
    }
    if (!source.values.empty()) sources_.push_back(std::move(source));
  }
  if (sources_.empty()) return false;
  bool uses_any = false;
  const std::vector<int> required = graph.required_by(last.id);
  for (const Source& source : sources_) {
    if (std::ranges::find(required, source.node) == required.end()) continue;
    uses_any = true;
    for (const Value& value : source.values) {
      LateReads reads = late_reads(value);
      if (reads.changes_unseen) return true;
      names_.merge(reads.names);
    }
  }
  if (uses_any) waiting_.push_back(last.id);
  return false;
}

std::vector<int> LateCalls::take_before_binding(std::string_view name) {
  if (!names_.contains(name)) return {};
  names_.clear();
  return std::exchange(waiting_, {});
}

}  // namespace comma::interpreter
