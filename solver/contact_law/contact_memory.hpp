// What of a contact a computation that goes on from a step needs beside its fields.
#pragma once

#include <array>
#include <vector>

#include "solver/contact_law/raised_penalties.hpp"

namespace comma::solver {

struct ZoneMemory {
  bool bilateral = false;                ///< GLISSIERE
  std::vector<char> closed;              ///< its points, in their order: those of bilateral zones do not open again
  std::array<double, 5> penalties = {};  ///< of contact and of friction, as given, 0 where there is none; 1 where
                                         ///< either grows by a limit; 1 of the mixed formulation
};

/// At the end of a step, zone by zone. What a zone remembers counts where it is defined alike: elsewhere it begins
/// anew.
struct ContactMemory {
  std::vector<ZoneMemory> zones;
  RaisedPenalties penalties;
};

}  // namespace comma::solver
