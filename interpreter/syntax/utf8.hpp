// Python counts text in characters; memory holds UTF-8. The few functions that bridge the two.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace comma::interpreter {

bool is_ascii(std::string_view text);
bool is_valid_utf8(std::string_view text);
/// Every byte taken as a Latin-1 character: the encoding of command files from before UTF-8.
std::string utf8_from_latin1(std::string_view text);

std::size_t count_code_points(std::string_view text);
std::vector<char32_t> decode_utf8(std::string_view text);
void append_utf8(std::string& text, char32_t code_point);
std::string encode_utf8(const std::vector<char32_t>& code_points);
/// The character that starts at `offset`, and its length in bytes.
char32_t code_point_at(std::string_view text, std::size_t offset, std::size_t& length);

/// White space as str.split() and str.strip() understand it.
bool is_blank_character(char32_t c);

}  // namespace comma::interpreter
