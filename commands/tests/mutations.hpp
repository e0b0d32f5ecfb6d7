// Plants one error at a time into a sound command file, guided by the catalogue: each mutant knows which diagnostic it
// must get, and where.
#pragma once

#include <string>
#include <vector>

#include "interpreter/catalogue/catalogue.hpp"

namespace comma::commands::tests {

struct Mutant {
  std::string kind;  ///< "misspelt command"
  std::string text;  ///< the whole file with the error in it
  int line = 0;      ///< where the diagnostic must be
  std::string code;
  std::string hint;      ///< what the hint must contain; empty: anything
  int statement = 0;     ///< the number of the statement with the error
  bool readable = true;  ///< false: a syntax error
  std::uint32_t begin = 0, end = 0;
  std::string replacement;  ///< of the sound text's [begin, end)
};

/// Every mutant of a file that is known to be sound.
std::vector<Mutant> plant_errors(const std::string& text, const interpreter::Catalogue& catalogue);

/// Two errors in one file: a syntax error in one statement, an error of another kind in another. Both must be told:
/// behind the syntax error, only errors that do not hang on the names lost with it are planted.
struct Pair {
  Mutant unreadable, other;
  std::string text;  ///< the whole file with both errors
};
std::vector<Pair> plant_pairs(const std::string& text, const interpreter::Catalogue& catalogue);

}  // namespace comma::commands::tests
