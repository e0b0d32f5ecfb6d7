#include "solver/io/med_library.hpp"

#include <fmt/format.h>

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cassert>
#include <compare>
#include <filesystem>
#include <fstream>
#include <optional>
#include <utility>

#include "solver/error.hpp"

namespace comma::solver {
namespace {

using enum CellType;

struct Geometry {
  CellType type;
  med_geometry_type code;
};

constexpr std::array<Geometry, cell_type_count> geometries = {
    {{poi1, MED_POINT1},     {seg2, MED_SEG2},       {seg3, MED_SEG3},    {seg4, MED_SEG4},      {tria3, MED_TRIA3},
     {tria6, MED_TRIA6},     {tria7, MED_TRIA7},     {quad4, MED_QUAD4},  {quad8, MED_QUAD8},    {quad9, MED_QUAD9},
     {tetra4, MED_TETRA4},   {tetra10, MED_TETRA10}, {pyram5, MED_PYRA5}, {pyram13, MED_PYRA13}, {penta6, MED_PENTA6},
     {penta15, MED_PENTA15}, {penta18, MED_PENTA18}, {hexa8, MED_HEXA8},  {hexa20, MED_HEXA20},  {hexa27, MED_HEXA27}}};

constexpr std::array<CellType, cell_type_count> numbering = {poi1,    seg2,   seg3,    seg4,   tria3,   tria6,  tria7,
                                                             quad4,   quad8,  quad9,   tetra4, tetra10, penta6, penta15,
                                                             penta18, pyram5, pyram13, hexa8,  hexa20,  hexa27};

constexpr std::array<std::int8_t, 10> tetra_order = {0, 2, 1, 3, 6, 5, 4, 7, 9, 8};
constexpr std::array<std::int8_t, 13> pyram_order = {0, 3, 2, 1, 4, 8, 7, 6, 5, 9, 12, 11, 10};
constexpr std::array<std::int8_t, 18> penta_order = {0, 2, 1, 3, 5, 4, 8, 7, 6, 12, 14, 13, 11, 10, 9, 17, 16, 15};
constexpr std::array<std::int8_t, 27> hexa_order = {0,  3,  2,  1,  4,  7,  6,  5,  11, 10, 9,  8,  16, 19,
                                                    18, 17, 15, 14, 13, 12, 20, 24, 23, 22, 21, 25, 26};

std::span<const std::int8_t> whole_order(CellType type) {
  switch (type) {
    case tetra4:
    case tetra10:
      return tetra_order;
    case pyram5:
    case pyram13:
      return pyram_order;
    case penta6:
    case penta15:
    case penta18:
      return penta_order;
    case hexa8:
    case hexa20:
    case hexa27:
      return hexa_order;
    default:
      return {};
  }
}

[[noreturn]] void throw_unreadable(const std::string& path, const std::string& why, const std::string& hint = {}) {
  throw Error("unreadable-file", fmt::format("{}: {}", path, why), hint);
}

struct MedVersion {
  int major = -1;
  int minor = -1;
  auto operator<=>(const MedVersion&) const = default;
};

int attribute(hid_t group, const char* name) {
  if (H5Aexists(group, name) <= 0) return -1;
  int value = -1;
  const hid_t id = H5Aopen(group, name, H5P_DEFAULT);
  if (id < 0) return -1;
  const hid_t space = H5Aget_space(id);
  if (H5Sget_simple_extent_npoints(space) != 1 || H5Aread(id, H5T_NATIVE_INT, &value) < 0) value = -1;
  H5Sclose(space);
  H5Aclose(id);
  return value;
}

/// The version is looked up here rather than by MEDfileCompatibility, which writes to the screen about files that are
/// not MED and leaves them open.
MedVersion version_in(const std::string& path) {
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  if (file < 0) throw_unreadable(path, "this is not a MED file (nor any other HDF5 file), or it is cut off");
  MedVersion version;
  const hid_t group =
      H5Lexists(file, "INFOS_GENERALES", H5P_DEFAULT) > 0 ? H5Gopen2(file, "INFOS_GENERALES", H5P_DEFAULT) : -1;
  if (group >= 0) {
    version = {attribute(group, "MAJ"), attribute(group, "MIN")};
    H5Gclose(group);
  }
  H5Fclose(file);
  if (version.major < 0 || version.minor < 0)
    throw_unreadable(path, "this HDF5 file is not a MED file, or it is damaged");
  return version;
}

/// A file that a later minor version wrote, which the library refuses by its stamp alone: a copy of it with the
/// library's own. It is gone from the folder once it is open.
class StampedCopy {
 public:
  explicit StampedCopy(const std::string& path) {
    std::error_code failure;
    const std::filesystem::path folder = std::filesystem::temp_directory_path(failure);
    if (failure)
      throw_unreadable(path,
                       "of a file of a later MED version a copy is read, and there is no folder for temporary files",
                       "set TMPDIR to one that exists");
    path_ = (folder / fmt::format("comma-{}-{}.med", getpid(), ++count)).string();
    std::filesystem::copy_file(path, path_, std::filesystem::copy_options::overwrite_existing, failure);
    if (failure)
      throw_unreadable(path,
                       fmt::format("of a file of a later MED version a copy is read, and {} cannot be written", path_),
                       "make room there, or set TMPDIR");
    std::filesystem::permissions(path_, std::filesystem::perms::owner_read | std::filesystem::perms::owner_write,
                                 failure);
    const hid_t file = H5Fopen(path_.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    const hid_t group = file < 0 ? -1 : H5Gopen2(file, "INFOS_GENERALES", H5P_DEFAULT);
    const hid_t minor = group < 0 ? -1 : H5Aopen(group, "MIN", H5P_DEFAULT);
    const int own = MED_MINOR_NUM;
    const bool stamped = minor >= 0 && H5Awrite(minor, H5T_NATIVE_INT, &own) >= 0;
    if (minor >= 0) H5Aclose(minor);
    if (group >= 0) H5Gclose(group);
    if (file >= 0) H5Fclose(file);
    if (stamped) return;
    std::filesystem::remove(path_, failure);
    throw_unreadable(path, "the version that the file is stamped with cannot be changed in a copy of it");
  }
  ~StampedCopy() {
    std::error_code failure;
    std::filesystem::remove(path_, failure);
  }
  StampedCopy(const StampedCopy&) = delete;
  StampedCopy& operator=(const StampedCopy&) = delete;

  const std::string& path() const { return path_; }

 private:
  inline static std::atomic<int> count = 0;
  std::string path_;
};

/// The version of the file.
MedVersion check_readable(const std::string& path) {
  std::error_code failure;
  if (!std::filesystem::exists(path, failure)) throw_unreadable(path, "there is no such file");
  if (!std::filesystem::is_regular_file(path, failure)) throw_unreadable(path, "this is not a file");
  const MedVersion version = version_in(path);
  const bool too_old = version < MedVersion{2, 2};
  if (!too_old && version.major <= MED_MAJOR_NUM) return version;
  throw_unreadable(path,
                   fmt::format("the file is of MED version {}.{}, which the MED library {} cannot read", version.major,
                               version.minor, MED_VERSION_STR),
                   too_old ? "medimport brings an old file up to date" : "");
}

}  // namespace

QuietHdf5::QuietHdf5() {
  // Files are closed when their reader or writer ends, so the library has nothing left to do at exit; after a damaged
  // file its clean-up would write about memory that it lost. Only the first call, before the library starts, has an
  // effect.
  H5dont_atexit();
  H5Eget_auto2(H5E_DEFAULT, &handler_, &client_data_);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

QuietHdf5::~QuietHdf5() { H5Eset_auto2(H5E_DEFAULT, handler_, client_data_); }

MedFile::MedFile(std::string path, med_access_mode mode) : path_(std::move(path)) {
  std::optional<StampedCopy> copy;
  if (mode != MED_ACC_CREAT && check_readable(path_) > MedVersion{MED_MAJOR_NUM, MED_MINOR_NUM}) {
    if (mode != MED_ACC_RDONLY)
      throw Error("unwritable-file",
                  fmt::format("{}: a later version of MED than {} wrote it, and nothing is added to it", path_,
                              MED_VERSION_STR));
    copy.emplace(path_);
  }
  id_ = MEDfileOpen(copy ? copy->path().c_str() : path_.c_str(), mode);
  if (id_ >= 0) return;
  if (mode == MED_ACC_RDONLY) throw_unreadable(path_, "the MED library cannot open it");
  throw Error("unwritable-file", fmt::format("{}: the MED library cannot write it", path_));
}

MedFile MedFile::open_for_reading(const std::string& path) { return {path, MED_ACC_RDONLY}; }

MedFile MedFile::create(const std::string& path) {
  // The MED library writes to the screen when it cannot create a file, so we try first.
  if (!std::ofstream(path)) throw Error("unwritable-file", fmt::format("{}: the file cannot be written", path));
  return {path, MED_ACC_CREAT};
}

MedFile MedFile::open_for_adding(const std::string& path) { return {path, MED_ACC_RDWR}; }

MedFile::~MedFile() {
  if (id_ >= 0) MEDfileClose(id_);
}

med_geometry_type med_geometry(CellType type) {
  const Geometry& geometry = geometries[static_cast<std::size_t>(type)];
  assert(geometry.type == type);
  return geometry.code;
}

std::optional<CellType> cell_type_of(med_geometry_type geometry) {
  const auto* found = std::ranges::find(geometries, geometry, &Geometry::code);
  if (found == geometries.end()) return std::nullopt;
  return found->type;
}

std::span<const std::int8_t> med_node_order(CellType type) {
  const auto whole = whole_order(type);
  return whole.empty() ? whole : whole.first(static_cast<std::size_t>(node_count(type)));
}

std::span<const CellType> numbering_order() { return numbering; }

std::string trimmed(std::string_view padded) {
  padded = padded.substr(0, padded.find('\0'));
  const std::size_t last = padded.find_last_not_of(' ');
  return last == std::string_view::npos ? std::string() : std::string(padded.substr(0, last + 1));
}

std::string padded(std::span<const std::string> names, std::size_t width) {
  std::string result;
  for (const std::string& name : names) {
    assert(name.size() <= width);
    result += name;
    result.append(width - name.size(), ' ');
  }
  return result;
}

}  // namespace comma::solver
