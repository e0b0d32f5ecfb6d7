// Solid bodies whose material has a memory.
#include "solver/elements/cell_choice.hpp"
#include "solver/elements/solids/inelastic_block.hpp"

namespace comma::solver {

std::unique_ptr<ElementBlock> make_inelastic_solid_block(const BlockInput& input, std::vector<int> cells) {
  return make_for_solid_cells(
      input, std::move(cells),
      []<int Nodes>(const BlockInput& of, std::vector<int> its) -> std::unique_ptr<ElementBlock> {
        return std::make_unique<InelasticBlock<3, Nodes, false>>(of, std::move(its));
      });
}

}  // namespace comma::solver
