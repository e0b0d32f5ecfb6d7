#include "commands/loads/multiplier_sum.hpp"

#include <iterator>
#include <map>

namespace comma::commands {

namespace {

void add_multiple(std::vector<double>& sum, double factor, const std::vector<double>& term, bool is_first) {
  if (is_first) sum.resize(term.size());
  if (term.size() != sum.size()) sum.clear();
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += factor * term[i];
}

}  // namespace

MultiplierSum::~MultiplierSum() {
  auto open = std::move(terms_);
  while (!open.empty()) {
    const auto last = std::move(open.back().second);
    open.pop_back();
    if (last.use_count() > 1) continue;
    std::move(last->terms_.begin(), last->terms_.end(), std::back_inserter(open));
    last->terms_.clear();
  }
}

MultiplierSum::Values MultiplierSum::values() const {
  std::map<const MultiplierSum*, Values> known;
  std::vector<const MultiplierSum*> open = {this};
  while (!open.empty()) {
    const MultiplierSum* sum = open.back();
    const std::size_t waiting = open.size();
    if (!known.contains(sum)) {
      for (const auto& [factor, term] : sum->terms_)
        if (!known.contains(term.get())) open.push_back(term.get());
    }
    if (open.size() > waiting) continue;
    open.pop_back();
    if (known.contains(sum)) continue;
    Values total = sum->source_ ? sum->source_() : Values();
    for (std::size_t i = 0; i < sum->terms_.size(); ++i)
      add_multiple(total, sum->terms_[i].first, known.at(sum->terms_[i].second.get()), i == 0);
    known.emplace(sum, std::move(total));
  }
  return known.at(this);
}

}  // namespace comma::commands
