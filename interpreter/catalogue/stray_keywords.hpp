// Keywords that a level does not have, or not now: which of its own each was probably meant to be, and what to say.
#pragma once

#include <string>
#include <vector>

#include "interpreter/catalogue/catalogue.hpp"
#include "interpreter/catalogue/check_rules.hpp"
#include "interpreter/catalogue/keyword_scope.hpp"
#include "interpreter/diagnostic.hpp"

namespace comma::interpreter {

/// A keyword that the level does not have, and the one of the level that it probably stands for.
struct KeywordGuess {
  std::string written;
  std::string meant;
};

/// Guesses for the `written` names (the catalogue's where an older one was written) that are not the level's, in their
/// order; no keyword is meant that is written as well, nor by two. `label` names the level ("DEFI_CONTACT/ZONE");
/// `scope` holds what is written, for the conditions of blocks.
std::vector<KeywordGuess> guesses_of_misspelt(const LevelPage& level, const std::string& label,
                                              const std::vector<std::string>& written, const KeywordScope& scope);

/// Reports a keyword that the level does not have, or has under other conditions alone. `meant` is the guess for it,
/// or empty. Code: unknown-keyword.
void report_stray_keyword(const LevelPage& level, const std::string& label, const GivenKeyword& stray,
                          const std::vector<std::string>& written, const std::string& meant, Diagnostics& diagnostics);

}  // namespace comma::interpreter
