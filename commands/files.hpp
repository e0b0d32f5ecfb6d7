// Which file a logical unit number stands for: as an .export says, else by the name of the command file.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "interpreter/source.hpp"

namespace comma::commands {

/// Where commands write text that name no unit.
inline constexpr int text_unit = 8;
/// Where Code_Aster writes its messages.
inline constexpr int message_unit = 6;

/// One line `F type name D|R|DR|RC unit` of an .export.
struct ExportFile {
  std::string type;
  std::filesystem::path path;  ///< absolute or relative to the .export's folder
  bool input = false;
  bool output = false;
  int unit = 0;
};

/// Files by unit. Outputs go into `output_folder` unless the .export names them.
class Files {
 public:
  Files(std::filesystem::path command_file, std::vector<ExportFile> exported, std::filesystem::path output_folder);

  /// The input file of a unit: the one that DEFI_FICHIER names (beside the command file, or written before), else the
  /// .export's, else what has been written under that unit, else a file beside the command file with its stem and the
  /// unit or one of the extensions, or with its stem less the letter of the modelisation (zzzz237b.comm finds
  /// zzzz237.mmed), else the only file there with one of the extensions. Throws DiagnosticError `missing-file` listing
  /// what was looked for, or where the file stands for another unit already.
  std::filesystem::path input(int unit, const std::vector<std::string>& extensions) const;

  /// A file that `input` would find by one of these extensions for some unit; nothing where there is none.
  std::optional<std::filesystem::path> candidate(const std::vector<std::string>& extensions) const;

  /// The command file that INCLUDE reads by unit (the .export's, else `<stem>.<unit>`) or by name (one of the folder of
  /// the command file, or one that the .export names). Throws DiagnosticError `missing-file`; `forbidden-file` for a
  /// name that leads elsewhere, and for a link.
  std::filesystem::path included(int unit, const interpreter::Span& where) const;
  std::filesystem::path included(const std::string& name, const interpreter::Span& where) const;

  /// The output file of a unit: the .export's, else `<stem>.<extension>` for the unit that is the default of its
  /// format,
  /// `<stem>.<unit>.<extension>` for another, or where the file has been read.
  /// Throws DiagnosticError `overwritten-input` where that file is read by the study and was not written by it,
  /// `forbidden-file` where it is a link.
  std::filesystem::path output(int unit, const std::string& extension, int default_unit) const;

  /// Whether what is written to the unit is shown where the run tells what it does: unit 6, which is Code_Aster's file
  /// of messages, unless the .export or DEFI_FICHIER have a file for it.
  bool is_terminal(int unit) const;

  /// From now on the file of the unit has this name (of an output: unless the .export has one for it); an empty name
  /// gives the unit back. Throws DiagnosticError `unsupported` for a name that leads out of the current folder.
  void name_output(int unit, const std::string& name);

 private:
  static std::optional<int> unit_in(const std::string& name);
  std::optional<std::filesystem::path> named_input(int unit) const;
  bool is_read(const std::filesystem::path& path) const;
  std::filesystem::path included_by_unit(int unit, const interpreter::Span& where) const;
  std::filesystem::path safe_output(std::filesystem::path path) const;
  std::vector<std::string> stems() const;
  std::filesystem::path found(int unit, const std::vector<std::string>& extensions) const;

  std::filesystem::path command_file_;
  std::vector<ExportFile> exported_;
  std::filesystem::path output_folder_;
  mutable std::map<std::filesystem::path, int> units_;    ///< of files that were found by their names
  mutable std::map<int, std::filesystem::path> written_;  ///< by unit
  mutable std::vector<std::filesystem::path> read_;       ///< what DEFI_FICHIER names as input, and what INCLUDE reads
  std::map<int, std::filesystem::path> named_;            ///< outputs that the command file names, by unit
};

}  // namespace comma::commands
