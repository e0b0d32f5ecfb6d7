// Fuzz target: any text is a mesh or an error of the reader, and a mesh that was read can be written and read again.
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "solver/error.hpp"
#include "solver/fuzz/sound_mesh.hpp"
#include "solver/io/aster_mesh_file.hpp"

using namespace comma::solver;

namespace {

/// The text of the mesh, or nothing where the format cannot hold its names.
std::string text_of(const Mesh& mesh) {
  try {
    return format_aster_mesh(mesh);
  } catch (const Error& error) {
    fuzz::require(error.code() == "name-too-long" || error.code() == "invalid-name",
                  "only names keep a mesh from being written");
    return {};
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Mesh mesh;
  try {
    mesh = parse_aster_mesh({reinterpret_cast<const char*>(data), size}, "fuzz.mail");
  } catch (const Error&) {
    return 0;
  }
  fuzz::require_sound(mesh);
  if (const std::string text = text_of(mesh); !text.empty()) {
    fuzz::require_same(parse_aster_mesh(text, "written.mail"), mesh);
  }
  return 0;
}
