// A comprehension at work: the nest of its loops, advanced one element at a time.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "interpreter/evaluation/evaluator.hpp"

namespace comma::interpreter {

class Evaluator::Generator : public Iterator {
 public:
  Generator(Evaluator& evaluator, const ComprehensionNode& node, std::shared_ptr<Iterator> first);
  ~Generator() override;
  Generator(const Generator&) = delete;
  Generator& operator=(const Generator&) = delete;

  std::optional<Value> next() override;
  const Value& value() const { return value_; }  ///< that goes with the last key of a dict comprehension
  bool met_unknown() const { return met_unknown_; }
  const std::shared_ptr<Frame>& frame() const { return frame_; }

 private:
  struct Scope;
  std::optional<Value> advance();
  bool passes(const ComprehensionNode::Clause& clause);

  Evaluator& evaluator_;
  const ComprehensionNode& node_;
  std::shared_ptr<Frame> frame_;
  std::shared_ptr<const SourceFile> file_;
  std::shared_ptr<const FunctionCode> code_;  ///< keeps the tree of its function alive
  std::weak_ptr<int> run_token_;              ///< ... or tells that the tree of its file is gone
  std::vector<std::shared_ptr<Iterator>> loops_;
  Value value_;
  bool met_unknown_ = false;
  bool running_ = false;
};

}  // namespace comma::interpreter
