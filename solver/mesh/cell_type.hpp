// The cell types, with the order of nodes of Code_Aster (R3.01.01): corners first, then mid-edges, then mid-faces, then
// centre.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace comma::solver {

enum class CellType : std::uint8_t {
  poi1,
  seg2,
  seg3,
  seg4,
  tria3,
  tria6,
  tria7,
  quad4,
  quad8,
  quad9,
  tetra4,
  tetra10,
  pyram5,
  pyram13,
  penta6,
  penta15,
  penta18,
  hexa8,
  hexa20,
  hexa27
};
inline constexpr int cell_type_count = 20;

int node_count(CellType type);
int corner_count(CellType type);
/// 0 for a point, 1 for a line, 2 for a face, 3 for a solid.
int dimension(CellType type);
/// "TRIA3" and so on, as in ASTER text meshes.
std::string_view name_of(CellType type);
std::optional<CellType> cell_type_named(std::string_view name);

/// The faces (of a solid) or edges (of a face cell) on its boundary as local node indices, each turned outwards: the
/// normal of a solid's face points out of the solid; a face's edge goes round the face counter-clockwise.
struct BoundaryFacet {
  CellType type;
  std::array<std::int8_t, 9> nodes;
};
std::span<const BoundaryFacet> boundary_facets(CellType type);

}  // namespace comma::solver
