#include "interpreter/source.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <utility>

#include "interpreter/diagnostic.hpp"
#include "interpreter/syntax/utf8.hpp"

namespace comma::interpreter {

namespace {

bool continues_character(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }

}  // namespace

SourceFile::SourceFile(std::string path, std::string text) : path_(std::move(path)), text_(std::move(text)) {
  // Some editors mark UTF-8 so; Python passes over it.
  if (text_.starts_with("\xEF\xBB\xBF")) text_.erase(0, 3);
  // Command files from before UTF-8 are Latin-1; what follows may count on UTF-8.
  if (!is_valid_utf8(text_)) text_ = utf8_from_latin1(text_);
  line_starts_.push_back(0);
  for (std::size_t i = 0; i < text_.size(); ++i) {
    const bool lone_return = text_[i] == '\r' && (i + 1 == text_.size() || text_[i + 1] != '\n');
    if (text_[i] == '\n' || lone_return) line_starts_.push_back(static_cast<std::uint32_t>(i + 1));
  }
}

std::shared_ptr<const SourceFile> SourceFile::read(const std::string& path) {
  std::error_code absent;
  const auto kind = std::filesystem::status(path, absent).type();
  if (kind != std::filesystem::file_type::not_found && kind != std::filesystem::file_type::regular &&
      kind != std::filesystem::file_type::none) {
    throw DiagnosticError("unreadable-file", path + " is not a regular file", {},
                          "name a text file on a disk: folders, devices and pipes are not read");
  }
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream text;
  if (stream) text << stream.rdbuf();
  if (!stream) throw DiagnosticError("unreadable-file", "the file " + path + " cannot be read");
  std::string characters = std::move(text).str();
  // Of a mesh or a picture every second character would be an error of its own.
  if (characters.find('\0') != std::string::npos)
    throw DiagnosticError("unreadable-file", path + " is no text: it holds characters of value 0", {},
                          "name the command file; if this is it, save it as UTF-8");
  return std::make_shared<const SourceFile>(path, std::move(characters));
}

Position SourceFile::position(std::uint32_t offset) const {
  offset = std::min<std::uint32_t>(offset, static_cast<std::uint32_t>(text_.size()));
  const auto next = std::upper_bound(line_starts_.begin(), line_starts_.end(), offset);
  const std::uint32_t start = *(next - 1);
  Position place;
  place.line = static_cast<int>(next - line_starts_.begin());
  place.column = 1;
  for (std::uint32_t i = start; i < offset; ++i) {
    if (!continues_character(text_[i])) ++place.column;
  }
  return place;
}

std::string_view SourceFile::line(int number) const {
  if (number < 1 || number > static_cast<int>(line_starts_.size())) return {};
  const std::size_t begin = line_starts_[static_cast<std::size_t>(number) - 1];
  std::size_t end = begin;
  while (end < text_.size() && text_[end] != '\n' && text_[end] != '\r') ++end;
  return std::string_view(text_).substr(begin, end - begin);
}

}  // namespace comma::interpreter
