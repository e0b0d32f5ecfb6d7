#include "interpreter/catalogue/message_pack.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using comma::interpreter::Packed;
using Json = nlohmann::ordered_json;

namespace {

bool same(const Packed& packed, const Json& json) {
  if (json.is_null()) return packed.is_null();
  if (json.is_boolean()) return packed.is_flag() && packed.flag() == json.get<bool>();
  if (json.is_number_integer()) return packed.is_integer() && packed.integer() == json.get<std::int64_t>();
  if (json.is_number()) return packed.is_real() && packed.number() == json.get<double>();
  if (json.is_string()) return packed.is_text() && packed.text() == json.get<std::string>();
  if (json.is_array()) {
    if (!packed.is_list() || packed.list().size() != json.size()) return false;
    for (std::size_t i = 0; i < json.size(); ++i)
      if (!same(packed.list()[i], json[i])) return false;
    return true;
  }
  if (!packed.is_map() || packed.map().size() != json.size()) return false;
  std::size_t i = 0;
  for (const auto& [key, value] : json.items()) {
    if (packed.map()[i].first != key || !same(packed.map()[i].second, value)) return false;
    ++i;
  }
  return true;
}

}  // namespace

TEST_CASE("What an independent writer packs is read back, of every size of number, text, list and mapping") {
  Json json = Json::parse(R"({"b": [true, false, null], "a": {"nested": {"x": 1.5e300, "y": 0.1, "z": 0.5}}})");
  for (const std::int64_t number :
       {0L, 1L, 127L, 128L, 255L, 256L, 65535L, 65536L, 4294967295L, 4294967296L, 9007199254740993L})
    json["numbers"].push_back(number), json["numbers"].push_back(-number);
  for (const std::size_t size : {0U, 31U, 32U, 255U, 256U, 70000U}) json["texts"].push_back(std::string(size, 'x'));
  for (int i = 0; i < 70000; ++i) json["long"].push_back(i % 3);
  for (int i = 0; i < 40; ++i) json["wide"][std::to_string(i)] = i;
  const auto bytes = Json::to_msgpack(json);
  CHECK(same(Packed::read(bytes), json));
}

TEST_CASE("Damaged bytes are refused, wherever they end") {
  const auto bytes = Json::to_msgpack(Json::parse(R"({"a": [1, 2.5, "text"], "b": {"c": null}})"));
  for (std::size_t size = 0; size < bytes.size(); ++size)
    CHECK_THROWS_AS(Packed::read(std::span(bytes).first(size)), std::runtime_error);
  const std::vector<std::uint8_t> huge{0xdd, 0xff, 0xff, 0xff, 0xff};
  CHECK_THROWS_AS(Packed::read(huge), std::runtime_error);
  const std::vector<std::uint8_t> deep(1000, 0x91);
  CHECK_THROWS_AS(Packed::read(deep), std::runtime_error);
}
