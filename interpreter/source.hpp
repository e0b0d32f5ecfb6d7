// Where characters come from: a command file in memory, and the spans that point into it.
// First page of the story source -> tokens -> tree -> values -> command calls -> graph.
// Everything that can be wrong in a file is reported through a Span of this page.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace comma::interpreter {

/// A place in a file as an editor shows it: line and column count from 1, columns count characters (UTF-8 code points).
struct Position {
  int line = 0;
  int column = 0;
};

/// The text of one command file. Immutable; lives as long as anything points into it (hold it by shared_ptr).
class SourceFile {
 public:
  SourceFile(std::string path, std::string text);

  /// Reads a file from disk. Throws DiagnosticError `unreadable-file`, also for what is no text.
  static std::shared_ptr<const SourceFile> read(const std::string& path);

  const std::string& path() const { return path_; }
  std::string_view text() const { return text_; }

  /// Line and column of a byte offset (clamped to the end of the text).
  Position position(std::uint32_t offset) const;

  /// The text of a line (from 1), without its line break.
  std::string_view line(int number) const;

 private:
  std::string path_;
  std::string text_;
  std::vector<std::uint32_t> line_starts_;
};

/// A half-open range of bytes [begin, end) of a file. A default Span points nowhere.
struct Span {
  std::shared_ptr<const SourceFile> file;
  std::uint32_t begin = 0;
  std::uint32_t end = 0;

  explicit operator bool() const { return file != nullptr; }
  bool operator==(const Span&) const = default;
};

}  // namespace comma::interpreter
