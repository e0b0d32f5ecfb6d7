#include "solver/io/med_library.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <filesystem>
#include <fstream>
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
    {{poi1, MED_POINT1},     {seg2, MED_SEG2},       {seg3, MED_SEG3},       {seg4, MED_SEG4},       {tria3, MED_TRIA3},
     {tria6, MED_TRIA6},     {tria7, MED_TRIA7},     {quad4, MED_QUAD4},     {quad8, MED_QUAD8},     {quad9, MED_QUAD9},
     {tetra4, MED_TETRA4},   {tetra10, MED_TETRA10}, {pyram5, MED_PYRA5},    {pyram13, MED_PYRA13},  {penta6, MED_PENTA6},
     {penta15, MED_PENTA15}, {penta18, MED_PENTA18}, {hexa8, MED_HEXA8},     {hexa20, MED_HEXA20},   {hexa27, MED_HEXA27}}};

constexpr std::array<CellType, cell_type_count> numbering = {
    poi1,   seg2,    seg3,   seg4,    tria3,   tria6,  tria7,   quad4, quad8,  quad9,
    tetra4, tetra10, penta6, penta15, penta18, pyram5, pyram13, hexa8, hexa20, hexa27};

constexpr std::array<std::int8_t, 10> tetra_order = {0, 2, 1, 3, 6, 5, 4, 7, 9, 8};
constexpr std::array<std::int8_t, 13> pyram_order = {0, 3, 2, 1, 4, 8, 7, 6, 5, 9, 12, 11, 10};
constexpr std::array<std::int8_t, 18> penta_order = {0, 2, 1, 3, 5, 4, 8, 7, 6, 12, 14, 13, 11, 10, 9, 17, 16, 15};
constexpr std::array<std::int8_t, 27> hexa_order = {0,  3,  2,  1,  4,  7,  6,  5,  11, 10, 9,  8,  16, 19,
                                                    18, 17, 15, 14, 13, 12, 20, 24, 23, 22, 21, 25, 26};

std::span<const std::int8_t> whole_order(CellType type) {
  switch (type) {
    case tetra4:
    case tetra10: return tetra_order;
    case pyram5:
    case pyram13: return pyram_order;
    case penta6:
    case penta15:
    case penta18: return penta_order;
    case hexa8:
    case hexa20:
    case hexa27: return hexa_order;
    default: return {};
  }
}

[[noreturn]] void throw_unreadable(const std::string& path, const std::string& why, const std::string& hint = {}) {
  throw Error("unreadable-file", fmt::format("{}: {}", path, why), hint);
}

void check_readable(const std::string& path) {
  std::error_code failure;
  if (!std::filesystem::exists(path, failure)) throw_unreadable(path, "there is no such file");
  if (!std::filesystem::is_regular_file(path, failure)) throw_unreadable(path, "this is not a file");
  med_bool is_hdf = MED_FALSE;
  med_bool is_med = MED_FALSE;
  if (MEDfileCompatibility(path.c_str(), &is_hdf, &is_med) < 0 || !is_hdf) {
    throw_unreadable(path, "this is not a MED file (nor any other HDF5 file), or it is cut off");
  }
  if (is_med) return;
  throw_unreadable(path, fmt::format("this HDF5 file is not a MED file that the MED library {} can read", MED_VERSION_STR),
                   "a file of MED 2.1 or 2.2 is brought up to date by medimport");
}

}  // namespace

QuietHdf5::QuietHdf5() {
  H5Eget_auto2(H5E_DEFAULT, &handler_, &client_data_);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

QuietHdf5::~QuietHdf5() { H5Eset_auto2(H5E_DEFAULT, handler_, client_data_); }

MedFile::MedFile(std::string path, med_access_mode mode) : path_(std::move(path)) {
  if (mode == MED_ACC_RDONLY) check_readable(path_);
  id_ = MEDfileOpen(path_.c_str(), mode);
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
