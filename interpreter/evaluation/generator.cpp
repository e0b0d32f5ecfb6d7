#include "interpreter/evaluation/generator.hpp"

#include <utility>

#include "interpreter/values/operations.hpp"

namespace comma::interpreter {

/// The generator's own variables are the current ones for as long as this lives.
struct Evaluator::Generator::Scope {
  explicit Scope(Generator& generator)
      : self(generator),
        frame(std::exchange(self.evaluator_.frame_, self.frame_)),
        file(std::exchange(self.evaluator_.file_, self.file_)),
        code(std::exchange(self.evaluator_.code_, self.code_)) {
    self.running_ = true;
  }
  ~Scope() {
    self.evaluator_.frame_ = std::move(frame);
    self.evaluator_.file_ = std::move(file);
    self.evaluator_.code_ = std::move(code);
    self.running_ = false;
  }
  Scope(const Scope&) = delete;
  Scope& operator=(const Scope&) = delete;
  Generator& self;
  std::shared_ptr<Frame> frame;
  std::shared_ptr<const SourceFile> file;
  std::shared_ptr<const FunctionCode> code;
};

Evaluator::Generator::Generator(Evaluator& evaluator, const ComprehensionNode& node, std::shared_ptr<Iterator> first)
    : Iterator("generator"),
      evaluator_(evaluator),
      node_(node),
      frame_(std::make_shared<Frame>()),
      file_(evaluator.file_),
      code_(evaluator.code_),
      run_token_(evaluator.run_token_) {
  frame_->outer = evaluator.frame_;
  frame_->slots.resize(node.slots.size());
  loops_.push_back(std::move(first));
}

Evaluator::Generator::~Generator() {
  for (auto& loop : loops_) release_later(std::move(loop));
  release_later(std::move(frame_));
}

std::optional<Value> Evaluator::Generator::next() {
  if (!code_ && run_token_.expired()) return std::nullopt;
  if (loops_.empty()) return std::nullopt;
  if (running_) raise(ErrorKind::value, "generator already executing");
  evaluator_.check_stack();  // a generator may draw from one that draws from one ...
  const Scope scope(*this);
  try {
    return advance();
  } catch (...) {
    loops_.clear();
    throw;
  }
}

std::optional<Value> Evaluator::Generator::advance() {
  while (!loops_.empty()) {
    evaluator_.meter_.step();
    const std::size_t level = loops_.size() - 1;
    const ComprehensionNode::Clause& clause = node_.clauses[level];
    const auto item = loops_.back()->next();
    if (!item) {
      loops_.pop_back();
      continue;
    }
    evaluator_.assign(*clause.target, *item);
    if (!passes(clause)) continue;
    if (level + 1 == node_.clauses.size()) {
      Value element = evaluator_.evaluate(*node_.element);
      if (node_.value) value_ = evaluator_.evaluate(*node_.value);
      return element;
    }
    const Value inner = evaluator_.evaluate(*node_.clauses[level + 1].iterable);
    met_unknown_ = met_unknown_ || inner.is_unknown();
    if (!inner.is_unknown()) loops_.push_back(iterate(inner));
  }
  return std::nullopt;
}

bool Evaluator::Generator::passes(const ComprehensionNode::Clause& clause) {
  for (const NodePtr& condition : clause.conditions) {
    const Value value = evaluator_.evaluate(*condition);
    met_unknown_ = met_unknown_ || value.is_unknown();
    if (value.is_unknown()) evaluator_.doubt();
    if (value.is_unknown() || !truth(value)) return false;
  }
  return true;
}

}  // namespace comma::interpreter
