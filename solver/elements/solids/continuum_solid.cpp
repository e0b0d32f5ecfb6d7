// Solid bodies, from the continuum template.
#include "solver/elements/cell_choice.hpp"
#include "solver/elements/solids/large_strain_block.hpp"

namespace comma::solver {

std::unique_ptr<ElementBlock> make_solid_block(const BlockInput& input, std::vector<int> cells) {
  return make_for_solid_cells(input, std::move(cells), []<int Nodes>(const BlockInput& of, std::vector<int> its) {
    return make_elastic_block<3, Nodes, false>(of, std::move(its));
  });
}

}  // namespace comma::solver
