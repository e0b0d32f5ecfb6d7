#include "interpreter/formulas/expression.hpp"

#include <algorithm>

#include "interpreter/evaluation/evaluator.hpp"
#include "interpreter/library/builtins.hpp"
#include "interpreter/syntax/parser.hpp"
#include "interpreter/values/operations.hpp"

namespace comma::interpreter {

namespace {

/// A host without commands.
class NoCommands : public CommandHost {
 public:
  bool is_command(std::string_view) const override { return false; }
  std::vector<std::string> command_names() const override { return {}; }
  Value call(const CommandCall& call, bool) override {
    throw DiagnosticError("not-supported", "an expression calls no commands", call.name_span);
  }
  bool force(const ConceptPtr& handle) override { return handle->data != nullptr; }
};

}  // namespace

struct Expression::Tree {
  std::shared_ptr<const SourceFile> file;
  NodePtr root;
};

Expression::Expression(std::string text, std::string origin) : text_(std::move(text)) {
  auto tree = std::make_shared<Tree>();
  // In brackets a text may run over several lines, as in FORMULE(VALE="""...""").
  tree->file = std::make_shared<const SourceFile>(std::move(origin), text_);
  Diagnostics diagnostics;
  std::vector<std::string> names;
  tree->root = parse_expression(tree->file, diagnostics, &names);
  if (diagnostics.has_errors()) {
    Diagnostic first = diagnostics.items().front();
    first.code = "syntax";
    throw DiagnosticError(std::move(first));
  }
  if (!tree->root)
    throw DiagnosticError("syntax", "this is no expression", {tree->file, 0, static_cast<std::uint32_t>(text_.size())});
  for (const std::string& name : names) {
    if (std::find(names_.begin(), names_.end(), name) == names_.end()) names_.push_back(name);
    const bool known = builtin_value(name) != nullptr || math_value(name) != nullptr;
    if (!known && std::find(variables_.begin(), variables_.end(), name) == variables_.end()) variables_.push_back(name);
  }
  tree_ = std::move(tree);
}

const Node& Expression::root() const { return *tree_->root; }

const std::shared_ptr<const SourceFile>& Expression::file() const { return tree_->file; }

Value Expression::evaluate(const VariableLookup& lookup) const {
  NoCommands host;
  Diagnostics diagnostics;
  Evaluator evaluator(host, diagnostics, [](std::string_view) {});
  Value value = evaluator.evaluate(*tree_->root, tree_->file, lookup);
  if (value.as_object<Iterator>() != nullptr || value.as_object<FunctionObject>() != nullptr) {
    throw DiagnosticError("type-error", "this expression gives a " + value.type_name() + ", not a value",
                          {tree_->file, 0, static_cast<std::uint32_t>(text_.size())}, "write list(...) around it");
  }
  return value;
}

bool Expression::holds(const VariableLookup& lookup) const {
  const Value value = evaluate(lookup);
  return !value.is_unknown() && truth(value);
}

}  // namespace comma::interpreter
