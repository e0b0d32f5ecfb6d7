// The multipliers that stand beside displacements taken of a result, and beside sums of such displacements.
#pragma once

#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace comma::commands {

/// Immutable, and computed when asked for. Sums may be long chains, each of the one before: nothing here follows them
/// by recursion.
class MultiplierSum {
 public:
  using Values = std::vector<double>;

  explicit MultiplierSum(std::function<Values()> source) : source_(std::move(source)) {}
  /// Factors and what they multiply, none of them null.
  explicit MultiplierSum(std::vector<std::pair<double, std::shared_ptr<const MultiplierSum>>> terms)
      : terms_(std::move(terms)) {}
  MultiplierSum(const MultiplierSum&) = delete;
  MultiplierSum& operator=(const MultiplierSum&) = delete;
  ~MultiplierSum();

  /// None where the terms have not as many.
  Values values() const;

 private:
  std::function<Values()> source_;
  /// Taken apart when it is let go of.
  mutable std::vector<std::pair<double, std::shared_ptr<const MultiplierSum>>> terms_;
};

}  // namespace comma::commands
