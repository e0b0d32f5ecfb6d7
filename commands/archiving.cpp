#include "commands/archiving.hpp"

#include <algorithm>
#include <cmath>

namespace comma::commands {

using interpreter::Keywords;

Archive::Archive(const interpreter::Call& call) {
  if (!call.has("ARCHIVAGE")) return;
  const Keywords& archive = call.factor("ARCHIVAGE");
  instants_ = archive.has("LIST_INST") ? archive.data<ListConcept>("LIST_INST").values : archive.reals("INST");
  precision_ = archive.real("PRECISION");
  relative_ = archive.text("CRITERE") == "RELATIF";
  if (archive.has("PAS_ARCH")) every_ = static_cast<int>(archive.integer("PAS_ARCH"));
  left_out_ = archive.texts("CHAM_EXCLU");
}

bool Archive::is_at(double wanted, double instant) const {
  return std::abs(wanted - instant) <= precision_ * (relative_ && wanted != 0.0 ? std::abs(wanted) : 1.0);
}

bool Archive::is_wanted(double instant, int number) const {
  if (instants_.empty()) return number % every_ == 0;
  return std::ranges::any_of(instants_, [&](double wanted) { return is_at(wanted, instant); });
}

std::vector<double> Archive::missed() const {
  std::vector<double> missed;
  for (const double wanted : instants_)
    if (!computed_.empty() && wanted > computed_.front() && wanted < computed_.back() && std::ranges::none_of(computed_, [&](double instant) { return is_at(wanted, instant); }))
      missed.push_back(wanted);
  return missed;
}

void Archive::update(solver::Result& result) {
  auto& steps = result.steps;
  computed_.push_back(steps.back().instant);
  for (const std::string& name : left_out_) steps.back().fields.erase(name);
  const bool is_initial = steps.size() == 1;
  if (!is_initial) ++steps_;
  if (!last_wanted_) {
    steps.back().order = steps[steps.size() - 2].order;
    steps.erase(steps.end() - 2);
  }
  last_wanted_ = is_initial || is_wanted(steps.back().instant, steps_);
}

}  // namespace comma::commands
