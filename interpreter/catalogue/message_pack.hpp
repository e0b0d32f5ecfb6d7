// A reader of MessagePack for the catalogue's pages. It copies no text and keeps the order of mappings: a page is read
// in a fraction of what a general JSON tree costs, and a run reads some twenty of them at each start.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace comma::interpreter {

/// A value of the tree; its texts point into the bytes that it was read from.
class Packed {
 public:
  using List = std::vector<Packed>;
  using Map = std::vector<std::pair<std::string_view, Packed>>;

  /// Reads one value that fills all the bytes. Throws std::runtime_error on anything else.
  static Packed read(std::span<const std::uint8_t> bytes);

  bool is_null() const { return std::holds_alternative<std::monostate>(content_); }
  bool is_flag() const { return std::holds_alternative<bool>(content_); }
  bool is_integer() const { return std::holds_alternative<std::int64_t>(content_); }
  bool is_real() const { return std::holds_alternative<double>(content_); }
  bool is_text() const { return std::holds_alternative<std::string_view>(content_); }
  bool is_list() const { return std::holds_alternative<List>(content_); }
  bool is_map() const { return std::holds_alternative<Map>(content_); }

  /// Each throws std::bad_variant_access on a value of another kind.
  bool flag() const { return std::get<bool>(content_); }
  std::int64_t integer() const { return std::get<std::int64_t>(content_); }
  double number() const;  ///< an integer or a real
  std::string_view text() const { return std::get<std::string_view>(content_); }
  const List& list() const { return std::get<List>(content_); }
  const Map& map() const { return std::get<Map>(content_); }

  /// The value of a key of a mapping, or null when it is absent.
  const Packed* find(std::string_view key) const;

 private:
  friend class PackedReader;
  std::variant<std::monostate, bool, std::int64_t, double, std::string_view, List, Map> content_;
};

}  // namespace comma::interpreter
