#include "commands/cli/export_file.hpp"

#include <charconv>
#include <memory>
#include <sstream>

#include "interpreter/diagnostic.hpp"
#include "interpreter/source.hpp"

namespace comma::commands {

namespace fs = std::filesystem;
using interpreter::DiagnosticError;
using interpreter::SourceFile;
using interpreter::Span;

namespace {

std::vector<std::string> words_of(std::string_view line) {
  std::istringstream stream{std::string(line)};
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

// Several command files run in the order of their extension: .comm, .com1, .com2 ... that is the order of the lines.
void read_file_line(const std::vector<std::string>& words, const Span& span, const fs::path& folder,
                    const fs::path& output_folder, Study& study) {
  if (words.size() < 4) {
    throw DiagnosticError("bad-export", "this line of the .export is too short", span,
                          "write: F type file D|R|DR|RC unit");
  }
  const std::string& access = words[3];
  ExportFile file;
  file.type = words[1];
  file.input = access.find('D') != std::string::npos;
  file.output = access.find('R') != std::string::npos;
  file.path = (file.input ? folder : output_folder) / words[2];
  if (words.size() > 4) {
    const auto [end, error] = std::from_chars(words[4].data(), words[4].data() + words[4].size(), file.unit);
    if (error != std::errc() || *end != '\0') {
      throw DiagnosticError("bad-export", "\"" + words[4] + "\" is no unit number", span,
                            "write: F type file D|R|DR|RC unit");
    }
  }
  if (file.type != "comm") {
    study.files.push_back(std::move(file));
    return;
  }
  if (!fs::is_regular_file(file.path)) {
    throw DiagnosticError("missing-file",
                          "the command file " + file.path.string() +
                              (fs::exists(file.path) ? " is not a regular file" : " does not exist"),
                          span);
  }
  study.command_files.push_back(file.path);
}

}  // namespace

Study read_export(const fs::path& path, const fs::path& output_folder) {
  const auto source = SourceFile::read(path.string());
  const std::string_view text = source->text();
  Study study;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const auto words = words_of(text.substr(begin, end - begin));
    const Span span{source, static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end)};
    if (!words.empty() && words[0] == "F") read_file_line(words, span, path.parent_path(), output_folder, study);
    begin = end + 1;
  }
  if (study.command_files.empty()) {
    throw DiagnosticError("bad-export", path.string() + " names no command file", Span{source, 0, 0},
                          "add: F comm FILE.comm D 1");
  }
  return study;
}

}  // namespace comma::commands
