// Meshes in Code_Aster's own text format (.mail), U3.01.00.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "solver/mesh/mesh.hpp"

namespace comma::solver {

/// A name of the file that is another node's or cell's afterwards.
struct MisleadingName {
  std::string in_file;
  std::string afterwards;
};

/// Parses the text of a .mail file; `path` is for messages. Nodes and cells are numbered in the order of the file;
/// their names hold within the file only, as in today's Code_Aster: afterwards they are N<i> and M<i>. The first name
/// that then misleads goes to `misleading`. Errors say line and column: Error `damaged-mesh`, `unsupported-cell`,
/// `unknown-node`, `unknown-cell`.
Mesh parse_aster_mesh(std::string_view text, const std::string& path,
                      std::optional<MisleadingName>* misleading = nullptr);
Mesh read_aster_mesh(const std::string& path, std::optional<MisleadingName>* misleading = nullptr);
/// The text of a .mail file that reads back as the same mesh. Throws Error `invalid-name`, `name-too-long`.
std::string format_aster_mesh(const Mesh& mesh);

}  // namespace comma::solver
