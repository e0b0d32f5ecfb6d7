// Solid bodies that hardly change their volume.
#include "solver/elements/solids/mixed_block.hpp"

namespace comma::solver {

std::unique_ptr<ElementBlock> make_mixed_solid_block(const BlockInput& input, std::vector<int> cells) {
  switch (input.model.mesh->cell_types[cells.front()]) {
    case CellType::tetra10:
      return std::make_unique<MixedBlock<3, 10, false>>(input, std::move(cells));
    case CellType::penta15:
      return std::make_unique<MixedBlock<3, 15, false>>(input, std::move(cells));
    case CellType::hexa20:
      return std::make_unique<MixedBlock<3, 20, false>>(input, std::move(cells));
    default:
      throw_unsupported_element(input.model, cells.front());
  }
}

}  // namespace comma::solver
