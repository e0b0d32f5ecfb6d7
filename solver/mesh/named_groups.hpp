// The groups of a mesh by their names, in the order in which they came: that of the file, then of the commands.
#pragma once

#include <deque>
#include <initializer_list>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace comma::solver {

/// Names and their members (indices of nodes or cells). Used as std::map is, whose order is another; references to
/// members stay valid until something is erased, iterators until something is added.
class Groups {
 public:
  using value_type = std::pair<std::string, std::vector<int>>;
  using iterator = std::deque<value_type>::iterator;
  using const_iterator = std::deque<value_type>::const_iterator;

  Groups() = default;
  Groups(std::initializer_list<value_type> groups);

  iterator begin() { return list_.begin(); }
  iterator end() { return list_.end(); }
  const_iterator begin() const { return list_.begin(); }
  const_iterator end() const { return list_.end(); }
  std::size_t size() const { return list_.size(); }
  bool empty() const { return list_.empty(); }

  bool contains(std::string_view name) const { return places_.contains(name); }
  iterator find(std::string_view name);
  const_iterator find(std::string_view name) const;
  /// Throws std::out_of_range.
  const std::vector<int>& at(std::string_view name) const { return list_[places_.at(std::string(name))].second; }
  std::vector<int>& operator[](const std::string& name) { return try_emplace(name).first->second; }
  /// Whether it is new, and where it is.
  std::pair<iterator, bool> try_emplace(const std::string& name, std::vector<int> members = {});
  /// The one behind it.
  iterator erase(iterator group);
  bool erase(std::string_view name);

  /// Whether names and members are the same, in whatever order the groups came.
  bool operator==(const Groups& other) const;

 private:
  std::deque<value_type> list_;
  std::map<std::string, std::size_t, std::less<>> places_;
};

}  // namespace comma::solver
