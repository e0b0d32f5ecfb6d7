// CONT_ELEM: the state of local average contact on slave faces.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "solver/fields/data/field.hpp"

namespace comma::solver {

/// Contact of a patch.
struct PatchContact {
  bool is_closed = false;
  double gap = absent;    ///< mean, positive when open; absent where nothing faces the patch
  double pressure = 0.0;  ///< on the part that faces the master, positive in compression
  double covered = 0.0;   ///< that part, as a share of the patch's faces that face the master somewhere
};

/// One value a face, the same on all faces of a patch. Components: CONT: 0 open, 1 closed; JEU: gap; PRES: minus the
/// pressure, as LAGS_C; COEFSURF: `covered`; PRESCOOR: PRES times that, the force over
/// the area of those faces.
ElementField patch_field(std::span<const std::pair<std::vector<int>, PatchContact>> patches, int cell_count);

}  // namespace comma::solver
