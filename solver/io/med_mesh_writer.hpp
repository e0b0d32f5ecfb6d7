// Writing a mesh into an open MED file, for the files of meshes and of results.
#pragma once

#include <string>
#include <vector>

#include "solver/io/med_library.hpp"
#include "solver/mesh/mesh.hpp"

namespace comma::solver {

/// The cells of each type in the order in which they are written; types without cells are left out.
struct MedBlock {
  CellType type;
  std::vector<int> cells;
};
std::vector<MedBlock> med_blocks(const Mesh& mesh);

/// Throws Error `name-too-long` / `invalid-name` if MED cannot hold the name as the name of `what`.
void check_med_name(const std::string& name, std::size_t limit, std::string_view what);
/// Throws Error `unwritable-file` if a call of the MED library failed.
void check_written(med_err result, const MedFile& file, std::string_view what);

/// Throws what check_med_name throws for any of the mesh's names, and Error `unwritable-mesh` for a mesh without nodes.
void check_writable(const Mesh& mesh, const std::string& name);
/// The mesh must have been found writable.
void write_mesh(const MedFile& file, const Mesh& mesh, const std::string& name);

}  // namespace comma::solver
