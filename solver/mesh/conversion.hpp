// Meshes made from others: more or fewer nodes in the cells, cells doubled, points, a part of a mesh (CREA_MAILLAGE,
// U4.23.02).
#pragma once

#include <span>
#include <string>

#include "solver/mesh/mesh.hpp"

namespace comma::solver {

/// The type of a cell with the corners alone.
CellType straight_type(CellType type);

/// What becomes of a cell's type.
enum class Conversion {
  to_quadratic,   ///< SEG2, TRIA3, QUAD4, TETRA4, PYRAM5, PENTA6, HEXA8 get mid-edge nodes
  to_linear,      ///< only corners stay
  hexa20_to_27,   ///< HEXA20 get the middles of their faces and their own; QUAD8 their middle
  penta15_to_18,  ///< PENTA15 get the middles of their quadrangular faces; QUAD8 their middle
  quad8_to_9,     ///< QUAD8 get their middle
  tria6_to_7,     ///< TRIA6 get their middle
};

/// The mesh with the cells converted; others stay, groups hold the same cells and, as far as they remain, the same
/// nodes. New nodes are shared by the cells that share an edge or a face: mid-edge nodes halve the edge, middles of
/// faces and solids lie where the serendipity shape functions of the cell put them, so that its geometry stays. They
/// are numbered as Code_Aster does: those of lines first, then of faces, then of solids, each in the order of the
/// cells, whether these are converted or only share the node.
Mesh converted(const Mesh& mesh, std::span<const int> cells, Conversion conversion);

/// Cuts quadrangles into TRIA3 that stand in their places and groups: QUAD4 along the diagonal from the first node to
/// the third; QUAD8 into four at the corners and two between the mid-edge nodes, along the diagonal from the fifth to
/// the seventh; QUAD9 into eight around its middle.
Mesh with_triangles(const Mesh& mesh, std::span<const int> cells);

/// Doubles cells, on the same nodes, into a new cell group. Throws Error `group-exists`.
void double_cells(Mesh& mesh, std::span<const int> cells, const std::string& group);

/// Makes a point cell at each of the nodes, in the order of their numbers; into a new cell group unless its name is
/// empty. Throws Error `group-exists`.
void add_points(Mesh& mesh, std::span<const int> nodes, const std::string& group);

/// The cells alone, in the order of the mesh, and their nodes, in the order in which these cells meet them, under their
/// names. All groups stay as far as their members do; empty ones go.
Mesh restricted(const Mesh& mesh, std::span<const int> cells);

}  // namespace comma::solver
