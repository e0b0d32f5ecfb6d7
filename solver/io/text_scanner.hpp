// Words and numbers of a text file one after the other; errors say where.
#pragma once

#include <string>
#include <string_view>

namespace comma::solver {

/// Reads a text that must outlive it. Every reading function throws Error `damaged-mesh` with file, line and column,
/// and with what it was to read, when the text ends or holds something else.
class TextScanner {
 public:
  TextScanner(std::string_view text, std::string path) : text_(text), path_(std::move(path)) {}

  /// Whether only white space is left.
  bool at_end();
  /// The next word without passing it; empty at the end.
  std::string_view peek();
  std::string_view word(std::string_view what);
  int integer(std::string_view what);
  /// An integer in [least, most].
  int integer(std::string_view what, int least, int most);
  double real(std::string_view what);
  /// The rest of the line, without its end.
  std::string_view rest_of_line();
  /// Passes lines until one begins with the word, and that word; false at the end.
  bool skip_to(std::string_view line_start);

  [[noreturn]] void fail(const std::string& what, const char* code = "damaged-mesh",
                         const std::string& hint = {}) const;

 private:
  void skip_space();

  std::string_view text_;
  std::string path_;
  std::size_t at_ = 0;
  std::size_t word_start_ = 0;  ///< of the word last read, for messages
};

/// The whole of a file; throws Error `missing-file`.
std::string read_text_file(const std::string& path);

/// Throws Error `unreadable-file` for a folder, a device or a pipe: these may have no end.
void require_regular_file(const std::string& path);

}  // namespace comma::solver
