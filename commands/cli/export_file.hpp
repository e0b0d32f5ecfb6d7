// Code_Aster's .export: which files a study is made of (U1.03.02).
#pragma once

#include <filesystem>
#include <vector>

#include "commands/files.hpp"

namespace comma::commands {

struct Study {
  std::vector<std::filesystem::path> command_files;  ///< run one after the other
  std::vector<ExportFile> files;                     ///< the others
};

/// Reads an .export: lines `P name value` (times and memory, of no meaning to comma) and `F type file D|R|DR|RC unit`;
/// `#` starts a comment. Paths are relative to its folder; outputs land in `output_folder` unless their path is
/// absolute. Throws DiagnosticError `bad-export` with the line, `missing-file` for a command file that is not there.
Study read_export(const std::filesystem::path& path, const std::filesystem::path& output_folder);

}  // namespace comma::commands
