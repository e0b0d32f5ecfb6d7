// Meshes and results in MED files, through the MED library.
#pragma once

#include <string>

#include "solver/fields/field.hpp"
#include "solver/mesh/mesh.hpp"

namespace comma::solver {

/// Reads a mesh: the named one, or the file's only / first mesh when `name` is empty. Families become groups.
/// Throws Error `unreadable-file`, `damaged-mesh` (what and where), `unknown-mesh` (with the names in the file),
/// `unsupported-cell` naming the type.
Mesh read_med_mesh(const std::string& path, const std::string& name = "");

/// Names longer than MED's limits are an Error `name-too-long`.
void write_med_mesh(const std::string& path, const Mesh& mesh, const std::string& name);

/// The mesh and all nodal and element fields of a result, one MED field per name, one computation step per order.
void write_med_result(const std::string& path, const Mesh& mesh, const std::string& mesh_name, const Result& result,
                      const std::string& result_name);

}  // namespace comma::solver
