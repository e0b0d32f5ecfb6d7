#include "commands/tables/row_keys.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "commands/tables/table_filter.hpp"

namespace comma::commands {

namespace {

// Reals that went through different computations still name one place or one instant.
constexpr double key_precision = 1e-9;

// Coarser than the precision, so that nearly all numbers have one word only.
std::string rounded_text(double number) { return fmt::format("{:.5e}", number == 0.0 ? 0.0 : number); }

}  // namespace

bool SameKey::operator()(const Cell& a, const Cell& b) const {
  const auto x = number_in(a), y = number_in(b);
  if (!x || !y) return a == b;
  if (format_) return (*format_)(*x) == (*format_)(*y);
  return std::abs(*x - *y) <= key_precision * std::max(std::abs(*x), std::abs(*y));
}

std::vector<std::string> SameKey::words(const Cell& cell) const {
  if (const auto* text = std::get_if<std::string>(&cell)) return {"t" + *text};
  const auto number = number_in(cell);
  if (!number) return {""};
  if (format_) return {(*format_)(*number)};
  std::vector<std::string> found = {rounded_text(*number)};
  for (const double side : {1.0 - 2.0 * key_precision, 1.0 + 2.0 * key_precision})
    if (std::string beyond = rounded_text(*number * side); beyond != found.front()) found.push_back(std::move(beyond));
  return found;
}

std::size_t FirstComers::Hash::operator()(const std::vector<Cell>& key) const {
  constexpr std::size_t spread = 0x9e3779b97f4a7c15;  // 2^64 over the golden ratio
  std::size_t sum = 0;
  for (const Cell& cell : key) sum = (sum ^ std::hash<Cell>()(cell)) * spread;
  return sum ^ (sum >> 32);
}

std::size_t FirstComers::number_of(const std::vector<Cell>& key) {
  return numbers_.try_emplace(key, numbers_.size()).first->second;
}

void RowKeys::add(const std::vector<Cell>& row, std::size_t index) {
  std::string key;
  for (const int column : columns_) key += same_.words(row[static_cast<std::size_t>(column)]).front() + '\n';
  buckets_[key].entries.push_back({&row, index});
}

RowKeys::Entry* RowKeys::find_entry(const std::vector<Cell>& row, std::span<const int> columns) {
  std::vector<std::string> keys = {""};
  for (const int column : columns) {
    std::vector<std::string> longer;
    for (const std::string& word : same_.words(row[static_cast<std::size_t>(column)]))
      for (const std::string& key : keys) longer.push_back(key + word + '\n');
    keys = std::move(longer);
  }
  const auto agrees = [&](const Entry& entry) {
    for (std::size_t i = 0; i < columns.size(); ++i)
      if (!same_(row[static_cast<std::size_t>(columns[i])], (*entry.row)[static_cast<std::size_t>(columns_[i])]))
        return false;
    return true;
  };
  Entry* least = nullptr;
  for (const std::string& key : keys) {
    const auto found = buckets_.find(key);
    if (found == buckets_.end()) continue;
    Bucket& bucket = found->second;
    while (bucket.first < bucket.entries.size() && bucket.entries[bucket.first].taken) ++bucket.first;
    const auto entry =
        std::find_if(bucket.entries.begin() + static_cast<std::ptrdiff_t>(bucket.first), bucket.entries.end(),
                     [&](const Entry& each) { return !each.taken && agrees(each); });
    if (entry != bucket.entries.end() && (least == nullptr || entry->index < least->index)) least = &*entry;
  }
  return least;
}

std::optional<std::size_t> RowKeys::find(const std::vector<Cell>& row, std::span<const int> columns) {
  const Entry* entry = find_entry(row, columns);
  return entry == nullptr ? std::nullopt : std::optional(entry->index);
}

std::optional<std::size_t> RowKeys::take(const std::vector<Cell>& row, std::span<const int> columns) {
  Entry* entry = find_entry(row, columns);
  if (entry == nullptr) return std::nullopt;
  entry->taken = true;
  return entry->index;
}

}  // namespace comma::commands
