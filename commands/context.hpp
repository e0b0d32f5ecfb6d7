// What a command function reaches beside its keywords: files, the console, the list of verdicts, counters.
#pragma once

#include <cstdio>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "commands/files.hpp"
#include "commands/verdict.hpp"
#include "interpreter/diagnostic.hpp"
#include "solver/nonlinear/static_analysis.hpp"

namespace comma::commands {

enum class Verbosity : std::uint8_t { quiet, normal, verbose };

/// Plain text lines, on standard output, written out as they come: a run that is stopped leaves all that it said.
class Console {
 public:
  explicit Console(Verbosity verbosity) : verbosity_(verbosity) {}

  Verbosity verbosity() const { return verbosity_; }
  /// Text as it is: what the file's own print() says.
  void print(std::string_view text) const {
    std::fwrite(text.data(), 1, text.size(), stdout);
    std::fflush(stdout);
  }
  /// A line that every run shows; `detail` one that only -v shows, `progress` one that -q leaves out.
  void line(std::string_view text) const { print_line(text); }
  void progress(std::string_view text) const {
    if (verbosity_ != Verbosity::quiet) print_line(text);
  }
  void detail(std::string_view text) const {
    if (verbosity_ == Verbosity::verbose) print_line(text);
  }

 private:
  static void print_line(std::string_view text) {
    std::fwrite(text.data(), 1, text.size(), stdout);
    std::fputc('\n', stdout);
    std::fflush(stdout);
  }
  Verbosity verbosity_;
};

/// A mesh in a file, and its name there.
struct WrittenMesh {
  std::shared_ptr<const solver::Mesh> mesh;
  std::string name;
};

/// What a file of the format MED holds so far: its meshes, and which concept each step of a field, by its order, is of.
struct WrittenMedFile {
  std::vector<WrittenMesh> meshes;
  std::map<std::string, std::map<int, int>> steps;
};

struct Context {
  Files files;
  Console console;
  interpreter::Diagnostics& diagnostics;
  std::vector<Verdict> verdicts = {};
  solver::Counters counters = {};
  bool only_checks = false;  ///< nothing will be solved
  /// Outputs that this run has opened: the first writing replaces, later ones append.
  std::set<std::string> written = {};
  std::set<int> renewed_units = {};                      ///< IMPR_RESU begins anew what these hold
  std::map<std::string, WrittenMedFile> med_files = {};  ///< outputs of the format MED, likewise

  /// Appends text to the output of a unit; the first time in a run the file starts anew.
  void write(const std::filesystem::path& path, std::string_view text);

  /// The same to the output of a unit (see Files::output), or to the terminal.
  void write(int unit, const std::string& extension, int default_unit, std::string_view text);

  /// Of IMPR_RESU: starts the output of a unit anew if DEFI_FICHIER has associated it so.
  void begin_anew_if_renewed(int unit, const std::filesystem::path& path);

  /// Keeps a verdict and shows it.
  void report(Verdict verdict);
};

}  // namespace comma::commands
