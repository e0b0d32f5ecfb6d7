// Fuzz target: a damaged MED file is a mesh or an error of the reader. An input is either a whole file (it starts with
// HDF5's signature), or says how to damage a sound one: four bytes a change, three of position and one that is added
// there. So the fuzzer does not waste its time on files that are broken at the first byte, nor on the zeros that HDF5
// pads with.
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "solver/error.hpp"
#include "solver/fuzz/sound_mesh.hpp"
#include "solver/io/med_file.hpp"

using namespace comma::solver;

namespace {

/// A file in memory, where the system has such a folder, that goes with the process.
class ScratchFile {
 public:
  ScratchFile() {
    namespace fs = std::filesystem;
    const fs::path folder = fs::is_directory("/dev/shm") ? "/dev/shm" : fs::temp_directory_path();
    path_ = folder / ("comma-med-fuzz-" + std::to_string(getpid()) + ".med");
  }
  ~ScratchFile() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;

  std::string path() const { return path_; }
  std::string bytes() const {
    std::ifstream file(path_, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  void fill(std::string_view bytes) const {
    std::ofstream file(path_, std::ios::binary | std::ios::trunc);
    file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  }

 private:
  std::filesystem::path path_;
};

const ScratchFile& scratch() {
  static const ScratchFile file;
  return file;
}

/// Two squares, a bar between them, groups of nodes and of cells.
std::string sound_file() {
  Mesh mesh;
  mesh.dimension = 2;
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0}};
  mesh.add_cell(CellType::seg2, std::vector{1, 4});
  mesh.add_cell(CellType::quad4, std::vector{0, 1, 4, 3});
  mesh.add_cell(CellType::quad4, std::vector{1, 2, 5, 4});
  mesh.cell_groups["SQUARES"] = {1, 2};
  mesh.cell_groups["BAR"] = {0};
  mesh.node_groups["ENDS"] = {0, 2};
  write_med_mesh(scratch().path(), mesh, "M");
  return scratch().bytes();
}

/// Where the file says something, that is, has anything but zeros.
std::vector<std::size_t> telling_places(std::string_view bytes) {
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    if (bytes[i] != 0) places.push_back(i);
  }
  return places;
}

/// A position counts the telling bytes, from 1 << 23 on all of them.
std::string damaged(std::string bytes, const std::vector<std::size_t>& telling, std::string_view changes) {
  constexpr std::size_t length = 4;
  constexpr std::size_t all = 1U << 23;
  for (; changes.size() >= length; changes.remove_prefix(length)) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(changes[i]); };
    const std::size_t position = byte(0) | std::size_t{byte(1)} << 8 | std::size_t{byte(2)} << 16;
    const std::size_t place = position < all ? telling[position % telling.size()] : (position - all) % bytes.size();
    bytes[place] = static_cast<char>(bytes[place] + static_cast<char>(byte(3)));
  }
  return bytes;
}

// The HDF5 library loses some of its own memory when it meets a damaged file.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:H5FL_\nleak:H5MM_\n"; }
extern "C" const char* __lsan_default_options();
extern "C" const char* __lsan_default_options() { return "print_suppressions=0"; }

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::string sound = sound_file();
  static const std::vector<std::size_t> telling = telling_places(sound);
  const std::string_view input(reinterpret_cast<const char*>(data), size);
  scratch().fill(input.starts_with("\x89HDF") ? std::string(input) : damaged(sound, telling, input));
  try {
    fuzz::require_sound(read_med_mesh(scratch().path()));
  } catch (const Error&) {
  }
  return 0;
}
