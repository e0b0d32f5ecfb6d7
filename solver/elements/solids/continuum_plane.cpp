// Plane and axisymmetric bodies, from the continuum template.
#include "solver/elements/cell_choice.hpp"
#include "solver/elements/solids/large_strain_block.hpp"

namespace comma::solver {

std::unique_ptr<ElementBlock> make_plane_block(const BlockInput& input, std::vector<int> cells) {
  return make_for_plane_cells(input, std::move(cells), []<int Nodes>(const BlockInput& of, std::vector<int> its) {
    if (is_axisymmetric(of.model.formulations[its.front()]))
      return make_elastic_block<2, Nodes, true>(of, std::move(its));
    return make_elastic_block<2, Nodes, false>(of, std::move(its));
  });
}

}  // namespace comma::solver
