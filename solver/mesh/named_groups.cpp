#include "solver/mesh/named_groups.hpp"

#include <algorithm>

namespace comma::solver {

Groups::Groups(std::initializer_list<value_type> groups) {
  for (const auto& [name, members] : groups) try_emplace(name, members);
}

Groups::iterator Groups::find(std::string_view name) {
  const auto place = places_.find(name);
  return place == places_.end() ? end() : begin() + static_cast<std::ptrdiff_t>(place->second);
}

Groups::const_iterator Groups::find(std::string_view name) const {
  const auto place = places_.find(name);
  return place == places_.end() ? end() : begin() + static_cast<std::ptrdiff_t>(place->second);
}

std::pair<Groups::iterator, bool> Groups::try_emplace(const std::string& name, std::vector<int> members) {
  const auto [place, is_new] = places_.try_emplace(name, list_.size());
  if (is_new) list_.emplace_back(name, std::move(members));
  return {begin() + static_cast<std::ptrdiff_t>(place->second), is_new};
}

Groups::iterator Groups::erase(iterator group) {
  const auto gone = static_cast<std::size_t>(group - begin());
  places_.erase(group->first);
  for (auto& [name, place] : places_)
    if (place > gone) --place;
  return list_.erase(group);
}

bool Groups::erase(std::string_view name) {
  const auto group = find(name);
  if (group == end()) return false;
  erase(group);
  return true;
}

bool Groups::operator==(const Groups& other) const {
  return size() == other.size() && std::ranges::all_of(list_, [&](const value_type& own) {
           const auto found = other.find(own.first);
           return found != other.end() && found->second == own.second;
         });
}

}  // namespace comma::solver
