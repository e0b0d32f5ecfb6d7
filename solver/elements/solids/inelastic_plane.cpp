// Plane and axisymmetric bodies whose material has a memory.
#include "solver/elements/cell_choice.hpp"
#include "solver/elements/solids/inelastic_block.hpp"

namespace comma::solver {

std::unique_ptr<ElementBlock> make_inelastic_plane_block(const BlockInput& input, std::vector<int> cells) {
  return make_for_plane_cells(
      input, std::move(cells),
      []<int Nodes>(const BlockInput& of, std::vector<int> its) -> std::unique_ptr<ElementBlock> {
        if (is_axisymmetric(of.model.formulations[its.front()]))
          return std::make_unique<InelasticBlock<2, Nodes, true>>(of, std::move(its));
        return std::make_unique<InelasticBlock<2, Nodes, false>>(of, std::move(its));
      });
}

}  // namespace comma::solver
