#include "solver/io/gmsh_cells.hpp"

namespace comma::solver {

using enum CellType;

const std::vector<GmshType>& gmsh_types() {
  static const std::vector<GmshType> table = {
      {1, seg2},
      {2, tria3},
      {3, quad4},
      {4, tetra4},
      {5, hexa8},
      {6, penta6},
      {7, pyram5},
      {8, seg3},
      {9, tria6},
      {10, quad9},
      {11, tetra10, {0, 1, 2, 3, 4, 5, 6, 7, 9, 8}},
      {12, hexa27, {0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 13, 9, 10, 12, 14, 15, 16, 18, 19, 17, 20, 21, 23, 24, 22, 25, 26}},
      {13, penta18, {0, 1, 2, 3, 4, 5, 6, 9, 7, 8, 10, 11, 12, 14, 13, 15, 17, 16}},
      {15, poi1},
      {16, quad8},
      {17, hexa20, {0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 13, 9, 10, 12, 14, 15, 16, 18, 19, 17}},
      {18, penta15, {0, 1, 2, 3, 4, 5, 6, 9, 7, 8, 10, 11, 12, 14, 13}},
      {19, pyram13, {0, 1, 2, 3, 4, 5, 8, 10, 6, 7, 9, 11, 12}},
      {26, seg4}};
  return table;
}

CellType kept_type(CellType type) { return type == quad9 ? quad8 : type; }

}  // namespace comma::solver
