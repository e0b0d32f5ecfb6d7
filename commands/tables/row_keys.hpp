// Rows of tables that name the same place or instant in some of their columns, found without a look at every other row.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "commands/tables/fortran_format.hpp"
#include "commands/tables/table.hpp"

namespace comma::commands {

/// Whether cells name the same: texts and empty cells where they are equal, numbers where they differ by less than
/// rounding (1e-9 of their size), or look alike in a format.
class SameKey {
 public:
  explicit SameKey(std::optional<RealFormat> format = std::nullopt) : format_(std::move(format)) {}
  bool operator()(const Cell& a, const Cell& b) const;

  /// Words such that cells which name the same have one in common: the first stands for the cell itself, a second for
  /// what lies just beyond it.
  std::vector<std::string> words(const Cell& cell) const;

 private:
  std::optional<RealFormat> format_;
};

/// Numbers keys from 0 in the order in which they first come; equal ones have one number.
class FirstComers {
 public:
  std::size_t number_of(const std::vector<Cell>& key);

 private:
  struct Hash {
    std::size_t operator()(const std::vector<Cell>& key) const;
  };
  std::unordered_map<std::vector<Cell>, std::size_t, Hash> numbers_;
};

/// Rows by what stands in their key columns.
class RowKeys {
 public:
  /// `columns`: those of the keys in the rows that are added.
  RowKeys(std::vector<int> columns, SameKey same) : columns_(std::move(columns)), same_(std::move(same)) {}

  /// Adds a row under its index; the row must outlive this.
  void add(const std::vector<Cell>& row, std::size_t index);
  /// The least index of the rows that agree with this one, whose keys stand in `columns`; nothing where none does.
  std::optional<std::size_t> find(const std::vector<Cell>& row, std::span<const int> columns);
  /// The same, and takes that row out.
  std::optional<std::size_t> take(const std::vector<Cell>& row, std::span<const int> columns);

 private:
  struct Entry {
    const std::vector<Cell>* row;
    std::size_t index;
    bool taken = false;
  };
  struct Bucket {
    std::vector<Entry> entries;
    std::size_t first = 0;  ///< those before are taken
  };

  Entry* find_entry(const std::vector<Cell>& row, std::span<const int> columns);

  std::vector<int> columns_;
  SameKey same_;
  std::unordered_map<std::string, Bucket> buckets_;
};

}  // namespace comma::commands
