// A mapping that remembers the order of insertion, as Python's dict does; the keys of a set use it too.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "interpreter/values/value.hpp"

namespace comma::interpreter {

/// Python's hash() in its meaning: equal values hash alike (1 == 1.0 == True). Raises TypeError for lists, dicts, sets.
std::size_t hash_of(const Value& value);

/// Python's == (1 == 1.0, (1, 2) != [1, 2]); concepts and functions are equal when they are the same object.
bool equal(const Value& a, const Value& b);

class Dict {
 public:
  struct Entry {
    Value key;
    Value value;
    bool live = true;  ///< false: removed, its place is kept until the next compaction
  };

  Dict() = default;
  Dict(const Dict&) = delete;
  Dict& operator=(const Dict&) = delete;
  ~Dict();

  std::size_t size() const { return live_; }
  const Value* find(const Value& key) const;
  void set(const Value& key, Value value);
  bool erase(const Value& key);
  /// Takes over the entries of another one, also instead of its own.
  void update(const Dict& more);
  void clear();

  /// Raw entries in order, dead ones included: iteration by index stays valid while values are replaced.
  const std::vector<Entry>& entries() const { return entries_; }
  std::vector<Value> keys() const;
  std::vector<Value> values() const;

  /// Of _F(...); else null.
  std::shared_ptr<const FactorPlaces> factor = nullptr;
  /// Of a defaultdict: what makes the value of a key that is read and missing; else null.
  std::shared_ptr<const Value> factory = nullptr;

 private:
  std::size_t index_of(const Value& key, std::size_t hash) const;
  void compact();

  std::vector<Entry> entries_;
  std::unordered_multimap<std::size_t, std::size_t> places_;
  std::size_t live_ = 0;
};

/// A mapping of texts as keywords, each at its place in the file; what has none stands at `otherwise`. Nothing where a
/// key is no text.
std::optional<std::vector<Argument>> keywords_of(const Dict& dict, const Span& otherwise);

}  // namespace comma::interpreter
