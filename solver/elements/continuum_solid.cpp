// Solid bodies, from the continuum template.
#include "solver/elements/large_strain_block.hpp"

namespace comma::solver {

namespace {

template <int Dim, int Nodes, bool Axisymmetric>
std::unique_ptr<ElementBlock> of_behaviour(const BlockInput& input, std::vector<int> cells) {
  if (input.behaviour_of(cells.front()).kinematics == Kinematics::green_lagrange)
    return std::make_unique<LargeStrainBlock<Dim, Nodes, Axisymmetric>>(input, std::move(cells));
  return std::make_unique<ContinuumBlock<Dim, Nodes, Axisymmetric>>(input, std::move(cells));
}

template <int Nodes>
std::unique_ptr<ElementBlock> make(const BlockInput& input, std::vector<int> cells) {
  return of_behaviour<3, Nodes, false>(input, std::move(cells));
}

}  // namespace

std::unique_ptr<ElementBlock> make_solid_block(const BlockInput& input, std::vector<int> cells) {
  switch (input.model.mesh->cell_types[cells.front()]) {
    case CellType::tetra4: return make<4>(input, std::move(cells));
    case CellType::tetra10: return make<10>(input, std::move(cells));
    case CellType::pyram5: return make<5>(input, std::move(cells));
    case CellType::pyram13: return make<13>(input, std::move(cells));
    case CellType::penta6: return make<6>(input, std::move(cells));
    case CellType::penta15: return make<15>(input, std::move(cells));
    case CellType::penta18: return make<18>(input, std::move(cells));
    case CellType::hexa8: return make<8>(input, std::move(cells));
    case CellType::hexa20: return make<20>(input, std::move(cells));
    case CellType::hexa27: return make<27>(input, std::move(cells));
    default: throw_unsupported_element(input.model, cells.front());
  }
}

}  // namespace comma::solver
