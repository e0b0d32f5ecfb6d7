// The template of an element block that suits the number of nodes of its cells.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "solver/elements/element_block.hpp"

namespace comma::solver {

/// `make.operator()<Nodes>(input, cells)` for the type of the cells, all the same. Throws what
/// throw_unsupported_element throws for others than solids.
template <class Make>
std::unique_ptr<ElementBlock> make_for_solid_cells(const BlockInput& input, std::vector<int> cells, const Make& make) {
  switch (input.model.mesh->cell_types[cells.front()]) {
    case CellType::tetra4:
      return make.template operator()<4>(input, std::move(cells));
    case CellType::tetra10:
      return make.template operator()<10>(input, std::move(cells));
    case CellType::pyram5:
      return make.template operator()<5>(input, std::move(cells));
    case CellType::pyram13:
      return make.template operator()<13>(input, std::move(cells));
    case CellType::penta6:
      return make.template operator()<6>(input, std::move(cells));
    case CellType::penta15:
      return make.template operator()<15>(input, std::move(cells));
    case CellType::penta18:
      return make.template operator()<18>(input, std::move(cells));
    case CellType::hexa8:
      return make.template operator()<8>(input, std::move(cells));
    case CellType::hexa20:
      return make.template operator()<20>(input, std::move(cells));
    case CellType::hexa27:
      return make.template operator()<27>(input, std::move(cells));
    default:
      throw_unsupported_element(input.model, cells.front());
  }
}

/// The same for triangles and quadrangles.
template <class Make>
std::unique_ptr<ElementBlock> make_for_plane_cells(const BlockInput& input, std::vector<int> cells, const Make& make) {
  switch (input.model.mesh->cell_types[cells.front()]) {
    case CellType::tria3:
      return make.template operator()<3>(input, std::move(cells));
    case CellType::tria6:
      return make.template operator()<6>(input, std::move(cells));
    case CellType::tria7:
      return make.template operator()<7>(input, std::move(cells));
    case CellType::quad4:
      return make.template operator()<4>(input, std::move(cells));
    case CellType::quad8:
      return make.template operator()<8>(input, std::move(cells));
    case CellType::quad9:
      return make.template operator()<9>(input, std::move(cells));
    default:
      throw_unsupported_element(input.model, cells.front());
  }
}

}  // namespace comma::solver
