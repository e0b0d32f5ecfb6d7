#include "commands/files.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>

#include <fmt/format.h>

#include "interpreter/diagnostic.hpp"

namespace comma::commands {

namespace fs = std::filesystem;

Files::Files(fs::path command_file, std::vector<ExportFile> exported, fs::path output_folder)
    : command_file_(std::move(command_file)),
      exported_(std::move(exported)),
      output_folder_(std::move(output_folder)) {}

namespace {

// The files of a folder that have one of the extensions.
std::vector<fs::path> files_with(const fs::path& folder, const std::vector<std::string>& extensions) {
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(folder.empty() ? fs::path(".") : folder)) {
    for (const std::string& extension : extensions) {
      std::error_code unreadable;  // a link that leads nowhere
      if (entry.is_regular_file(unreadable) && entry.path().extension() == "." + extension)
        found.push_back(entry.path());
    }
  }
  return found;
}

// The name of a file in the folder, by whatever path it is called; nothing for one that lies elsewhere.
std::optional<std::string> name_in(const fs::path& folder, const std::string& path) {
  fs::path wanted = fs::path(path).lexically_normal();
  std::error_code absent;
  if (wanted.is_absolute() && fs::equivalent(wanted.parent_path(), folder.empty() ? "." : folder, absent))
    wanted = wanted.filename();
  const bool is_bare = wanted.filename() == wanted && !wanted.empty() && wanted != "." && wanted != "..";
  return is_bare ? std::optional(wanted.string()) : std::nullopt;
}

// A link leads out of the folder that a file of somebody else may use.
void require_no_link(const fs::path& path, const interpreter::Span& where) {
  std::error_code absent;
  if (fs::is_symlink(path, absent))
    throw interpreter::DiagnosticError(
        "forbidden-file", fmt::format("{} is a link, which could lead out of the folder", path.filename().string()),
        where, "put the file itself there, or name it in an .export");
}

}  // namespace

// The unit of "fort.20", under which a file of the .export or beside the command file stands anyway.
std::optional<int> Files::unit_in(const std::string& name) {
  constexpr std::string_view prefix = "fort.";
  int unit = 0;
  if (!name.starts_with(prefix)) return std::nullopt;
  const auto [end, error] = std::from_chars(name.data() + prefix.size(), name.data() + name.size(), unit);
  return error == std::errc{} && end == name.data() + name.size() ? std::optional(unit) : std::nullopt;
}

std::optional<fs::path> Files::named_input(int unit) const {
  const auto own = named_.find(unit);
  if (own == named_.end() || unit_in(own->second.string())) return std::nullopt;
  for (const ExportFile& file : exported_)
    if (file.input && file.path.filename() == own->second) return file.path;
  for (const fs::path& folder : {output_folder_, command_file_.parent_path()})
    if (fs::is_regular_file(folder / own->second)) return folder / own->second;
  throw interpreter::DiagnosticError(
      "missing-file",
      fmt::format("DEFI_FICHIER gives unit {} the file {}, and there is none", unit, own->second.string()), {},
      "put it beside the command file, or give the unit back (DEFI_FICHIER, ACTION='LIBERER')");
}

fs::path Files::input(int unit, const std::vector<std::string>& extensions) const {
  if (auto named = named_input(unit)) {
    read_.push_back(*named);
    return *named;
  }
  if (const auto own = named_.find(unit); own != named_.end()) unit = unit_in(own->second.string()).value_or(unit);
  for (const ExportFile& file : exported_) {
    if (file.unit == unit && file.input) return file.path;
  }
  if (const auto own = written_.find(unit); own != written_.end() && fs::is_regular_file(own->second))
    return own->second;
  const fs::path file = found(unit, extensions);
  const int known = units_.emplace(file, unit).first->second;
  if (known == unit) return file;
  throw interpreter::DiagnosticError(
      "missing-file",
      fmt::format("no file stands for unit {}: {} is that of unit {}", unit, file.filename().string(), known), {},
      fmt::format("put {}.{} beside the command file, or name both in an .export", command_file_.stem().string(),
                  unit));
}

// Of the command file, and less the letter of the modelisation.
std::vector<std::string> Files::stems() const {
  std::vector<std::string> result = {command_file_.stem().string()};
  if (const std::string& stem = result.front();
      stem.size() > 1 && std::isalpha(static_cast<unsigned char>(stem.back())))
    result.push_back(stem.substr(0, stem.size() - 1));
  return result;
}

std::optional<fs::path> Files::candidate(const std::vector<std::string>& extensions) const {
  for (const std::string& stem : stems())
    for (const std::string& extension : extensions)
      if (const fs::path path = command_file_.parent_path() / (stem + "." + extension); fs::is_regular_file(path))
        return path;
  if (const auto others = files_with(command_file_.parent_path(), extensions); others.size() == 1)
    return others.front();
  return std::nullopt;
}

fs::path Files::found(int unit, const std::vector<std::string>& extensions) const {
  const fs::path own = command_file_.parent_path() / (command_file_.stem().string() + "." + std::to_string(unit));
  if (fs::is_regular_file(own)) return own;
  if (const auto named = candidate(extensions)) return *named;
  std::string tried = own.filename().string();
  for (const std::string& stem : stems())
    for (const std::string& extension : extensions) tried += ", " + stem + "." + extension;
  throw interpreter::DiagnosticError("missing-file", "no file stands for unit " + std::to_string(unit), {},
                                     "put one of " + tried + " beside the command file, or name it in an .export");
}

fs::path Files::included(int unit, const interpreter::Span& where) const {
  const fs::path file = included_by_unit(unit, where);
  read_.push_back(file);
  return file;
}

fs::path Files::included_by_unit(int unit, const interpreter::Span& where) const {
  if (auto named = named_input(unit)) {
    require_no_link(*named, where);
    return *named;
  }
  for (const ExportFile& file : exported_) {
    if (file.unit == unit && file.input) return file.path;
  }
  const fs::path name = command_file_.stem().string() + "." + std::to_string(unit);
  const fs::path candidate = command_file_.parent_path() / name;
  if (fs::is_regular_file(candidate)) return candidate;
  throw interpreter::DiagnosticError("missing-file", "no file stands for unit " + std::to_string(unit), where,
                                     "put " + name.string() + " beside the command file, or name it in an .export");
}

fs::path Files::included(const std::string& name, const interpreter::Span& where) const {
  const auto wanted = name_in(command_file_.parent_path(), name);
  if (!wanted) {
    throw interpreter::DiagnosticError("forbidden-file", "a command file reads only what lies in its own folder", where,
                                       "write the bare name of a file beside the command file");
  }
  for (const ExportFile& file : exported_) {
    if (file.input && file.path.filename() == *wanted) return file.path;
  }
  const fs::path candidate = command_file_.parent_path() / *wanted;
  if (fs::is_regular_file(candidate)) {
    require_no_link(candidate, where);
    read_.push_back(candidate);
    return candidate;
  }
  throw interpreter::DiagnosticError("missing-file", "there is no file " + *wanted + " beside the command file", where);
}

bool Files::is_read(const fs::path& path) const {
  std::error_code absent;
  const auto same = [&](const fs::path& other) { return fs::equivalent(path, other, absent); };
  return std::ranges::any_of(units_, [&](const auto& entry) { return same(entry.first); }) ||
         std::ranges::any_of(exported_, [&](const ExportFile& file) { return file.input && same(file.path); }) ||
         std::ranges::any_of(read_, same) || same(command_file_);
}

fs::path Files::safe_output(fs::path path) const {
  require_no_link(path, {});
  const bool is_own = std::ranges::any_of(written_, [&](const auto& entry) { return entry.second == path; });
  if (is_own || !is_read(path)) return path;
  throw interpreter::DiagnosticError(
      "overwritten-input", fmt::format("{} is read by this study, and would be written over", path.filename().string()),
      {}, "give what is written another unit, or another name (DEFI_FICHIER)");
}

fs::path Files::output(int unit, const std::string& extension, int default_unit) const {
  const auto exported =
      std::ranges::find_if(exported_, [&](const ExportFile& file) { return file.unit == unit && file.output; });
  if (exported != exported_.end()) return written_[unit] = exported->path;
  if (const auto own = named_.find(unit); own != named_.end())
    return written_[unit] = safe_output(output_folder_ / own->second);
  const auto named = [&](const std::string& middle) {
    return output_folder_ / (command_file_.stem().string() + middle + extension);
  };
  const std::string numbered = "." + std::to_string(unit) + ".";
  const bool plain = unit == default_unit && !is_read(named("."));
  return written_[unit] = safe_output(named(plain ? "." : numbered));
}

bool Files::is_terminal(int unit) const {
  const auto is_file = [&](const ExportFile& file) { return file.unit == unit && file.output; };
  return unit == message_unit && !named_.contains(unit) && std::ranges::none_of(exported_, is_file);
}

void Files::name_output(int unit, const std::string& name) {
  if (name.empty()) {
    named_.erase(unit);
    return;
  }
  const auto wanted = name_in(output_folder_, name);
  if (!wanted)
    throw interpreter::DiagnosticError("unsupported", "comma writes into the current folder alone, and not to " + name,
                                       {}, "write the bare name of a file");
  named_[unit] = *wanted;
}

}  // namespace comma::commands
