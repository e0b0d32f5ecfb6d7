// What is made of concepts that a command may change in place afterwards (reuse=).
#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "interpreter/graph/concept.hpp"

namespace comma::commands {

/// Made at once, and anew whenever one of the sources has been written since: as Code_Aster, which keeps the names of
/// concepts and reads them when it needs them. Making it may throw.
template <class Inside>
class Renewed {
 public:
  using Make = std::function<std::shared_ptr<const Inside>()>;

  Renewed() = default;
  Renewed(std::vector<interpreter::ConceptPtr> sources, Make make)
      : sources_(std::move(sources)), make_(std::move(make)), versions_(versions()), inside_(make_()), made_{inside_} {}

  const std::shared_ptr<const Inside>& get() const {
    if (auto now = versions(); now != versions_) {
      inside_ = make_();
      made_.push_back(inside_);
      versions_ = std::move(now);
    }
    return inside_;
  }
  /// Whether this is what get() gives, or has given.
  bool has_made(const std::shared_ptr<const Inside>& inside) const {
    return std::ranges::any_of(made_, [&](const auto& each) { return each.lock() == inside; });
  }

 private:
  std::vector<int> versions() const {
    std::vector<int> found;
    for (const auto& source : sources_) found.push_back(source->version);
    return found;
  }

  std::vector<interpreter::ConceptPtr> sources_;
  Make make_;
  mutable std::vector<int> versions_;
  mutable std::shared_ptr<const Inside> inside_;
  mutable std::vector<std::weak_ptr<const Inside>> made_;
};

}  // namespace comma::commands
