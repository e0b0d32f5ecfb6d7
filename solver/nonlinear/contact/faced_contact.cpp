#include "solver/nonlinear/contact/faced_contact.hpp"

#include <algorithm>

namespace comma::solver {

std::vector<char> FacedContact::closed_points() const {
  std::vector<char> closed;
  for (const ContactStatus status : state.statuses) closed.push_back(status != ContactStatus::open);
  return closed;
}

int FacedContact::closed_count() const {
  return static_cast<int>(
      std::ranges::count_if(state.statuses, [](ContactStatus each) { return each != ContactStatus::open; }));
}

}  // namespace comma::solver
