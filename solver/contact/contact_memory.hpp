// What of a contact a computation that goes on from a step needs beside its fields.
#pragma once

#include <array>
#include <vector>

#include "solver/contact/raised_penalties.hpp"

namespace comma::solver {

/// At the end of a step. A contact that is defined otherwise begins anew.
struct ContactMemory {
  std::vector<std::array<double, 3>> zones;  ///< how each is defined: 1 if it is bilateral, its penalties of contact and of friction as given
  std::vector<char> closed;                  ///< points, in their order: those of bilateral zones (GLISSIERE) do not open again
  RaisedPenalties penalties;
};

}  // namespace comma::solver
