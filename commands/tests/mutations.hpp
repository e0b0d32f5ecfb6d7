// Plants one error at a time into a sound command file, guided by the catalogue: each mutant knows which diagnostic it must
// get, and where.
#pragma once

#include <string>
#include <vector>

#include "interpreter/catalogue.hpp"

namespace comma::commands::tests {

struct Mutant {
  std::string kind;  ///< "misspelt command"
  std::string text;  ///< the whole file with the error in it
  int line = 0;      ///< where the diagnostic must be
  std::string code;
  std::string hint;  ///< what the hint must contain; empty: anything
};

/// Every mutant of a file that is known to be sound.
std::vector<Mutant> plant_errors(const std::string& text, const interpreter::Catalogue& catalogue);

}  // namespace comma::commands::tests
