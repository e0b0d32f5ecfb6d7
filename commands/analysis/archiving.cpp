#include "commands/analysis/archiving.hpp"

#include <algorithm>
#include <cmath>

namespace comma::commands {

using interpreter::Keywords;

Archive::Archive(const interpreter::Call& call) {
  if (!call.has("ARCHIVAGE")) return;
  const Keywords& archive = call.factor("ARCHIVAGE");
  instants_ = archive.has("LIST_INST") ? archive.data<ListConcept>("LIST_INST").values : archive.reals("INST");
  tolerance_ = instant_tolerance(archive);
  if (archive.has("PAS_ARCH")) every_ = static_cast<int>(archive.integer("PAS_ARCH"));
  left_out_ = archive.texts("CHAM_EXCLU");
}

bool Archive::is_wanted(double instant, int number) const {
  if (instants_.empty()) return number % every_ == 0;
  return std::ranges::any_of(instants_, [&](double wanted) { return tolerance_.meets(wanted, instant); });
}

std::vector<double> Archive::missed(std::span<const double> computed) const {
  return missed_instants(tolerance_, instants_, computed);
}

void Archive::update(solver::Result& result) {
  auto& steps = result.steps;
  const bool is_initial = steps.size() == 1;
  if (!is_initial) ++steps_;
  if (!last_wanted_) {
    steps.back().order = steps[steps.size() - 2].order;
    steps.erase(steps.end() - 2);
  } else if (has_own_) {
    for (const std::string& name : left_out_) steps[steps.size() - 2].fields.erase(name);
  }
  has_own_ = true;
  last_wanted_ = is_initial || is_wanted(steps.back().instant, steps_);
}

}  // namespace comma::commands
