// Meshes and results in MED files, through the MED library.
#pragma once

#include <span>
#include <string>

#include "solver/fields/data/field.hpp"
#include "solver/mesh/mesh.hpp"

namespace comma::solver {

/// Reads a mesh: the named one, or the file's only / first mesh when `name` is empty. Files of MED 2.3 to 4.1. Families
/// become groups, their members by rising index; a group without members does not come up. Cells are numbered type by
/// type in the order of med_library's numbering_order(). Names and numbers that the file gives to nodes and cells are
/// not kept, as in today's Code_Aster: N<i> and M<i> count them in the order of the mesh. Throws Error
/// `unreadable-file`, `damaged-mesh` (what and where), `unknown-mesh` (with the names in the file), `unsupported-cell`
/// naming the type.
Mesh read_med_mesh(const std::string& path, const std::string& name = "");

/// Groups become families. Names longer than MED's limits are an Error `name-too-long`, those that MED cannot hold
/// `invalid-name`. The order inside a group is not kept: MED knows groups as sets.
void write_med_mesh(const std::string& path, const Mesh& mesh, const std::string& name);

/// A result under the name that it has in the file; a field called "" has that name alone.
struct NamedResult {
  Result result;
  std::string name;
};

/// The mesh and all nodal and element fields of results, one MED field per name ("RESU____DEPL" for the field DEPL of
/// RESU, U7.05.21), one computation step per order. Nodes and cells that do not carry a field are left out by a
/// profile; a component that a carrier lacks is written as 0. Fields at Gauss points come with the scheme of R3.01.01
/// that has their number of points; Error `unsupported` names a number that has none. Other errors as for
/// write_med_mesh.
void write_med_results(const std::string& path, const Mesh& mesh, const std::string& mesh_name,
                       std::span<const NamedResult> results);
/// The same into a file that write_med_results has made; `has_mesh`: the mesh is there under that name. A field that is
/// there goes on with further steps; a step that it has already is replaced. Throws Error `unsupported` for one of
/// another mesh or of other components.
void add_med_results(const std::string& path, const Mesh& mesh, const std::string& mesh_name, bool has_mesh,
                     std::span<const NamedResult> results);
/// The same for one result.
void write_med_result(const std::string& path, const Mesh& mesh, const std::string& mesh_name, const Result& result,
                      const std::string& result_name);

}  // namespace comma::solver
