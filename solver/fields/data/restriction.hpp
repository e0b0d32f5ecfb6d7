// Fields on a part of their mesh (EXTR_RESU, RESTREINT; U4.71.04).
#pragma once

#include "solver/fields/data/field.hpp"
#include "solver/mesh/part_of.hpp"

namespace comma::solver {

/// What the nodes and cells of the part have in the whole.
Field on_part(const Field& field, const PartOfMesh& part);

}  // namespace comma::solver
