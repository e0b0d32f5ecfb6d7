// Plane and axisymmetric bodies that hardly change their volume.
#include "solver/elements/solids/mixed_block.hpp"

namespace comma::solver {

namespace {

template <int Nodes>
std::unique_ptr<ElementBlock> make(const BlockInput& input, std::vector<int> cells) {
  if (is_axisymmetric(input.model.formulations[cells.front()]))
    return std::make_unique<MixedBlock<2, Nodes, true>>(input, std::move(cells));
  return std::make_unique<MixedBlock<2, Nodes, false>>(input, std::move(cells));
}

}  // namespace

std::unique_ptr<ElementBlock> make_mixed_plane_block(const BlockInput& input, std::vector<int> cells) {
  switch (input.model.mesh->cell_types[cells.front()]) {
    case CellType::tria6:
      return make<6>(input, std::move(cells));
    case CellType::quad8:
      return make<8>(input, std::move(cells));
    default:
      throw_unsupported_element(input.model, cells.front());
  }
}

}  // namespace comma::solver
