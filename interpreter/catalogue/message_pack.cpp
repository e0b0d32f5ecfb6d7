#include "interpreter/catalogue/message_pack.hpp"

#include <bit>
#include <cstddef>
#include <stdexcept>

namespace comma::interpreter {

/// One pass over the bytes. The leading byte of each value says its kind and, for short ones, its size.
class PackedReader {
 public:
  explicit PackedReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  Packed read_all() {
    Packed value = read(0);
    if (position_ != bytes_.size()) fail();
    return value;
  }

 private:
  [[noreturn]] static void fail() { throw std::runtime_error("catalogue: a page is damaged"); }

  Packed read(int depth) {
    constexpr int deepest = 64;  // pages nest some twenty levels
    if (depth > deepest) fail();
    const std::uint8_t lead = byte();
    Packed value;
    if (lead <= 0x7f) return value.content_ = std::int64_t{lead}, value;
    if (lead >= 0xe0) return value.content_ = std::int64_t{static_cast<std::int8_t>(lead)}, value;
    if (lead <= 0x8f) return value.content_ = map(lead & 0x0fU, depth), value;
    if (lead <= 0x9f) return value.content_ = list(lead & 0x0fU, depth), value;
    if (lead <= 0xbf) return value.content_ = text(lead & 0x1fU), value;
    switch (lead) {
      case 0xc0:
        break;
      case 0xc2:
        value.content_ = false;
        break;
      case 0xc3:
        value.content_ = true;
        break;
      case 0xca:
        value.content_ = static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(big_endian(4))));
        break;
      case 0xcb:
        value.content_ = std::bit_cast<double>(big_endian(8));
        break;
      case 0xcc:
        value.content_ = static_cast<std::int64_t>(big_endian(1));
        break;
      case 0xcd:
        value.content_ = static_cast<std::int64_t>(big_endian(2));
        break;
      case 0xce:
        value.content_ = static_cast<std::int64_t>(big_endian(4));
        break;
      case 0xcf:
        value.content_ = static_cast<std::int64_t>(big_endian(8));
        break;
      case 0xd0:
        value.content_ = std::int64_t{static_cast<std::int8_t>(big_endian(1))};
        break;
      case 0xd1:
        value.content_ = std::int64_t{static_cast<std::int16_t>(big_endian(2))};
        break;
      case 0xd2:
        value.content_ = std::int64_t{static_cast<std::int32_t>(big_endian(4))};
        break;
      case 0xd3:
        value.content_ = static_cast<std::int64_t>(big_endian(8));
        break;
      case 0xd9:
        value.content_ = text(big_endian(1));
        break;
      case 0xda:
        value.content_ = text(big_endian(2));
        break;
      case 0xdb:
        value.content_ = text(big_endian(4));
        break;
      case 0xdc:
        value.content_ = list(big_endian(2), depth);
        break;
      case 0xdd:
        value.content_ = list(big_endian(4), depth);
        break;
      case 0xde:
        value.content_ = map(big_endian(2), depth);
        break;
      case 0xdf:
        value.content_ = map(big_endian(4), depth);
        break;
      default:
        fail();
    }
    return value;
  }

  std::uint8_t byte() {
    if (position_ >= bytes_.size()) fail();
    return bytes_[position_++];
  }

  std::uint64_t big_endian(int count) {
    std::uint64_t value = 0;
    for (int i = 0; i < count; ++i) value = value << 8U | byte();
    return value;
  }

  /// `size` bytes must be left: an element takes at least one, so a damaged size cannot ask for more memory than that.
  void demand(std::uint64_t size) const {
    if (size > bytes_.size() - position_) fail();
  }

  std::string_view text(std::uint64_t size) {
    demand(size);
    const std::string_view result(reinterpret_cast<const char*>(bytes_.data()) + position_, size);
    position_ += size;
    return result;
  }

  Packed::List list(std::uint64_t size, int depth) {
    demand(size);
    Packed::List items;
    items.reserve(size);
    for (std::uint64_t i = 0; i < size; ++i) items.push_back(read(depth + 1));
    return items;
  }

  Packed::Map map(std::uint64_t size, int depth) {
    demand(size);
    Packed::Map entries;
    entries.reserve(size);
    for (std::uint64_t i = 0; i < size; ++i) {
      const Packed key = read(depth + 1);
      if (!key.is_text()) fail();
      entries.emplace_back(key.text(), read(depth + 1));
    }
    return entries;
  }

  std::span<const std::uint8_t> bytes_;
  std::size_t position_ = 0;
};

Packed Packed::read(std::span<const std::uint8_t> bytes) { return PackedReader(bytes).read_all(); }

double Packed::number() const { return is_integer() ? static_cast<double>(integer()) : std::get<double>(content_); }

const Packed* Packed::find(std::string_view key) const {
  for (const auto& [name, value] : map())
    if (name == key) return &value;
  return nullptr;
}

}  // namespace comma::interpreter
