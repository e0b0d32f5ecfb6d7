#include "interpreter/values/dict.hpp"

#include <limits>

namespace comma::interpreter {

namespace {

constexpr std::size_t nowhere = std::numeric_limits<std::size_t>::max();

}  // namespace

std::size_t Dict::index_of(const Value& key, std::size_t hash) const {
  const auto [first, last] = places_.equal_range(hash);
  for (auto place = first; place != last; ++place) {
    if (equal(entries_[place->second].key, key)) return place->second;
  }
  return nowhere;
}

const Value* Dict::find(const Value& key) const {
  const std::size_t index = index_of(key, hash_of(key));
  return index == nowhere ? nullptr : &entries_[index].value;
}

void Dict::set(const Value& key, Value value) {
  const std::size_t hash = hash_of(key);
  const std::size_t index = index_of(key, hash);
  if (index != nowhere) {
    entries_[index].value = std::move(value);
    return;
  }
  places_.emplace(hash, entries_.size());
  entries_.push_back({key, std::move(value), true});
  ++live_;
}

void Dict::update(const Dict& more) {
  if (&more == this) return;
  for (const Entry& entry : more.entries_)
    if (entry.live) set(entry.key, entry.value);
}

bool Dict::erase(const Value& key) {
  const std::size_t hash = hash_of(key);
  const auto [first, last] = places_.equal_range(hash);
  for (auto place = first; place != last; ++place) {
    Entry& entry = entries_[place->second];
    if (!equal(entry.key, key)) continue;
    entry = {Value(), Value(), false};
    places_.erase(place);
    --live_;
    if (entries_.size() > 32 && live_ < entries_.size() / 2) compact();
    return true;
  }
  return false;
}

void Dict::compact() {
  std::vector<Entry> kept;
  kept.reserve(live_);
  places_.clear();
  for (Entry& entry : entries_) {
    if (!entry.live) continue;
    places_.emplace(hash_of(entry.key), kept.size());
    kept.push_back(std::move(entry));
  }
  entries_ = std::move(kept);
}

void Dict::clear() {
  entries_.clear();
  places_.clear();
  live_ = 0;
}

std::vector<Value> Dict::keys() const {
  std::vector<Value> keys;
  keys.reserve(live_);
  for (const Entry& entry : entries_) {
    if (entry.live) keys.push_back(entry.key);
  }
  return keys;
}

std::vector<Value> Dict::values() const {
  std::vector<Value> values;
  values.reserve(live_);
  for (const Entry& entry : entries_) {
    if (entry.live) values.push_back(entry.value);
  }
  return values;
}

std::optional<std::vector<Argument>> keywords_of(const Dict& dict, const Span& otherwise) {
  std::vector<Argument> keywords;
  for (const Dict::Entry& entry : dict.entries()) {
    if (!entry.live) continue;
    if (!entry.key.is_text()) return std::nullopt;
    Argument& keyword = keywords.emplace_back(
        Argument{entry.key.as_text(), otherwise, std::make_shared<const Value>(entry.value), otherwise});
    if (!dict.factor) continue;
    const auto place = dict.factor->of_keywords.find(keyword.name);
    if (place == dict.factor->of_keywords.end()) continue;
    keyword.name_span = place->second.name;
    keyword.value_span = place->second.value;
  }
  return keywords;
}

}  // namespace comma::interpreter
